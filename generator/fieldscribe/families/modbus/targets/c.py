"""The view of the Modbus header: the profile of the device, block reads, the requests of each point, commands."""

import textwrap
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import chain
from typing import Any

from fieldscribe.families.modbus import BIT_LISTS, FUNCTIONS, SPACES, Profile, profile_of
from fieldscribe.families.modbus.targets.c_rows import IdentifyView, Selections, identifies
from fieldscribe.model import Base, Block, Command, Device, Found, Point, SteppedCommand
from fieldscribe.targets.c import frames
from fieldscribe.targets.c.calls import Transfer
from fieldscribe.targets.c.groups import Members, Part, StructView, facts_of, has_row, is_written_by_row
from fieldscribe.targets.c.point_views import GeneratedPoint
from fieldscribe.targets.c.scope import HeaderScope, PointView
from fieldscribe.targets.c.syntax import called, hexadecimal, unsigned
from fieldscribe.targets.c.word_functions import is_plain_long, places_of
from fieldscribe.targets.identifiers import Named, Owner
from fieldscribe.text import c_comment, upper
from fieldscribe.wording.rules import run_text, steps_texts

_WIDTH = 114


@dataclass(frozen=True, slots=True)
class SteppedView:
    """The tables of a command: its words, its steps, and the numbers of its arguments."""

    command: SteppedCommand
    steps: str
    macro: str

    @property
    def names(self) -> tuple[str, ...]:
        """The identifiers."""
        return self.steps, f"{self.steps}_words", f"{self.macro}_STEPS", *(name for name, _, _ in self.arguments)

    @property
    def comment(self) -> Iterator[str]:
        """The lines of its comment."""
        texts = [f"{number}. {text}" for number, text in enumerate(steps_texts(self.command), 1)]
        for text in (f"{self.command.title['en']}: {run_text(self.command)}", *texts):
            yield from textwrap.wrap(c_comment(text), _WIDTH)

    @property
    def arguments(self) -> list[tuple[str, str, str]]:
        """The macro of each argument, its number, and its range."""
        ends = enumerate(self.command.arguments.items())
        return [(f"{self.macro}_{upper(name)}", f"{at}U", f"{low}..{high}") for at, (name, (low, high)) in ends]

    @property
    def words(self) -> Iterator[str]:
        """The rows of the words of all steps."""
        numbers = {name: at for at, name in enumerate(self.command.arguments)}
        for step in self.command.steps:
            for word in step.words:
                parts = hexadecimal(word.constant & 0xFFFF), hexadecimal(word.factor & 0xFFFF), hexadecimal(word.mask)
                yield f"{{{', '.join(parts)}, {numbers.get(word.argument or '', 0)}U}}"

    @property
    def rows(self) -> Iterator[str]:
        """The rows of the steps."""
        first = 0
        for step in self.command.steps:
            place = f"{hexadecimal(step.address)}, {len(step.words)}U"
            ways = ", ".join(f"{{{unsigned(function or 0)}, {place}}}" for function in (step.read, step.write))
            whether = ", ".join("true" if fact else "false" for fact in (step.when, step.base))
            yield f"{{{ways}, &{self.steps}_words[{first}], {unsigned(step.within or 0)}, {whether}}}"
            first += len(step.words)

    @property
    def case(self) -> str:
        """The macro of the conformance program that checks it."""
        given = "".join(f'(uint16_t)fieldscribe_with(v, "{name}"), ' for name in self.command.arguments)
        return f'"{self.command.name}", {self.steps}, {{{given}0U}}'


def _stepped(command: SteppedCommand, scope: HeaderScope) -> SteppedView:
    name = f"{scope.prefix}_command_{command.name}_steps"
    return SteppedView(command, name, f"{scope.upper}_COMMAND_{upper(command.name)}")


_LAST = 0xFFFF
_MOVED = {"r": "READ", "w": "WRITE", "u": "UPDATE"}


@dataclass(frozen=True, slots=True)
class BlocksView:
    """The reads that fetch the points of a group; `by_name` has its points."""

    name: str
    array: str
    values: StructView
    blocks: Sequence[Block]
    by_name: Mapping[str, Sequence[GeneratedPoint]]

    @property
    def rows(self) -> Iterator[tuple[str, str, str, str]]:
        """The function, address and count of each block, and its points; built as the header is written."""
        for block in self.blocks:
            ends = [self.by_name[name][-1].point for name in (block.points[0], block.points[-1])]
            holds = c_comment("..".join(dict.fromkeys(point.code or point.name for point in ends)))
            yield unsigned(block.function), hexadecimal(block.address), unsigned(block.count), holds


def header(device: Device, placed: Sequence[GeneratedPoint], scope: HeaderScope) -> frames.FramesHeader:
    """Return the header of frames, `<device>_modbus.h`."""
    profile = profile_of(device.bus)
    layouts = frames.Layouts(scope)
    counts = [block.count for blocks in device.blocks.values() for block in blocks]
    by_name: dict[str, list[GeneratedPoint]] = {}
    for each in placed:
        if each.point.readable:
            by_name.setdefault(each.point.name, []).append(each)
    members = Members(scope)
    blocks = [
        _blocks(group, blocks, by_name, members)
        for group, blocks in device.blocks.items()
        if any(len(block.points) > 1 or not scope.calls_only for block in blocks)
    ]
    block_most = f"{scope.upper}_BLOCK_MOST", unsigned(max(counts, default=0))
    commands = [_command(command, scope) for command in device.commands]
    stepped = [_stepped(command, scope) for command in device.stepped_commands]
    bases = [_base(base, device, scope) for base in device.bases if base.block is None]
    found = device.found and f"{scope.prefix}_{device.found.name}"
    selections = Selections(device, profile, scope, bool(device.selecting))
    started = [base for base in device.bases if base.starts_block]
    ids = [(f"{scope.upper}_{upper(base.name)}", unsigned(base.block), base.name) for base in started]
    of_points = frames.Frames(
        placed, lambda point, view: _frame(point, view, layouts, selections) if point.place.addresses else None
    )
    most = [unsigned(profile.most.get(number, 0)) for number in sorted(FUNCTIONS)] if profile.most else []
    to_all = sum(1 << number for number in profile.broadcasts & profile.most.keys())

    identify = IdentifyView(device, scope, placed) if identifies(device) else None

    def identifiers() -> Iterator[Named]:
        target = [f"{scope.prefix}_{name}" for name in ("modbus_profile", "device")]
        yield Owner("target", "what the header of frames needs"), [*target, f"{scope.upper}_ROWS_H"]
        if blocks:
            yield Owner("target", "the largest block"), (block_most[0],)
        for base in (base for base in device.bases if base.block is None or base.starts_block):
            of_block = f"{scope.upper}_{upper(base.name)}", f"{scope.prefix}_{base.name}_base"
            yield Owner("base", base.name), (of_block[base.block is None],)
        if found:
            yield Owner("target", "how blocks are found"), [found, f"{found}_marker", f"{found}_places"]
        yield Owner("target", "what is selected"), list(selections.arrays)
        for view in blocks:
            yield Owner("group", view.name), (view.array, *view.values.names)
        for command, command_view in zip(device.commands, commands, strict=True):
            names = command_view["descriptor"].name, *(name for name, _ in command_view["defines"])
            yield Owner("command", command.name), names
        for each in stepped:
            yield Owner("command", each.command.name), each.names

    return frames.frames_header(
        device,
        layouts,
        {"frames": of_points},
        chain(identifiers(), () if identify is None else [identify.named]),
        most=", ".join(most),
        to_all=hexadecimal(to_all),
        broadcast="FIELDSCRIBE_MODBUS_NO_BROADCAST" if profile.broadcast is None else f"{profile.broadcast}U",
        parts=list(_parts(device, placed, profile)),
        writes=any(each.point.writable for each in placed),
        pads=_bool(profile.pad_coil_bytes_even),
        rtu=_bool("rtu" in profile.framings),
        tcp=_bool("tcp" in profile.framings),
        bases=bases,
        found=found,
        chain=device.found and _chain(device.found),
        block_ids=ids,
        selections=selections,
        blocks=blocks,
        block_most=block_most,
        commands=commands,
        stepped=stepped,
        identify=identify,
        exceptions=frames.exceptions_of(device, scope),
    )


def _base(base: Base, device: Device, scope: HeaderScope) -> dict[str, str]:
    """Return a base that follows from given numbers: its function with their ranges, and the sum of their multiples."""
    given = {each.name: each for each in device.given}
    numbers = [given[name] for name, _ in base.terms]
    ends = [f"({each.name}_number >= {each.low}U)" for each in numbers if each.low]
    ends += [f"({each.name}_number <= {each.high}U)" for each in numbers if each.high < _LAST]
    terms = [(factor, f"({abs(factor)}U * (uint32_t){name}_number)") for name, factor in base.terms]
    terms += [(base.offset, f"{abs(base.offset)}U")] if base.offset or not terms else []
    (_, first), *others = sorted(terms, key=lambda term: term[0] < 0)  # one of them is positive and comes first
    function = f"{scope.prefix}_{base.name}_base"
    values = ", ".join([f'fieldscribe_given(v, "{each.name}")' for each in numbers])
    return {
        "function": function,
        "formula": c_comment(base.formula),
        "parameters": ", ".join([f"uint16_t {each.name}_number" for each in numbers]) or "void",
        "known": " && ".join(ends),
        "start": "".join([first, *(f" {'-' if factor < 0 else '+'} {text}" for factor, text in others)]),
        "case": f'"{base.name}", {function}({values})',
    }


def _chain(found: Found) -> dict[str, str]:
    """Return the literals for the search of blocks."""
    return {
        "text": c_comment(found.marker),
        "marker": ", ".join(map(hexadecimal, found.words)),
        "places": ", ".join(map(hexadecimal, found.places)),
        "count": unsigned(len(found.places)),
        "words": unsigned(len(found.words)),
        "end": hexadecimal(found.end),
        "function": unsigned(SPACES[found.space].read),
    }


def _parts(device: Device, placed: Sequence[GeneratedPoint], profile: Profile) -> Iterator[str]:
    """Yield the parts of the runtime that the header relies on, and no name in it brings."""
    of_coils = BIT_LISTS | {SPACES["coil"].write_one}
    if any(SPACES[each.point.space].read in of_coils for each in placed if each.point.space in SPACES) or any(
        command.function in of_coils for command in device.commands
    ):
        yield "FIELDSCRIBE_MODBUS_COILS"
    if profile.broadcast is not None and profile.units[0] <= profile.broadcast <= profile.units[1]:
        yield "FIELDSCRIBE_MODBUS_WRITES"  # it tells the unit that nobody reads from the others


def _bool(value: bool) -> str:
    return "true" if value else "false"


def _frame(point: Point, view: PointView, layouts: frames.Layouts, selections: Selections) -> frames.Frame | None:
    """Return the requests of a point; None if no function of the device reaches it.

    A point that shares its word cannot be written if its word cannot be read. Nothing writes one alone that the device
    takes with others only.
    """
    profile = selections.profile
    read = SPACES[point.space].read if point.readable and point.space in SPACES else 0
    write = profile.write_function(point.space, point.words) if point.writable and point.space in SPACES else 0
    read = read if profile.most.get(read, 0) >= point.words else 0
    if profile.most.get(write or 0, 0) < point.words or (point.bits is not None and not read) or point.write_with:
        write = 0
    if point.place.is_scattered or (not read and not write):
        return None
    name, text = f"{view.function}_frame", point.text is not None
    address = view.fields.address
    to = address if point.write_place is None else hexadecimal(min(point.write_place.addresses))
    selected, is_plain = selections.of(point), not point.selects
    is_long = is_plain_long(point) and not (selected or point.base)
    several = "" if point.words == 1 else f", {unsigned(places_of(point)[0] if is_long else point.words)}"
    transfers = _transfer(read, address, several), _transfer(write, to, several), "", point.base or "", is_plain
    transfer = Transfer("modbus") if selected is None else Transfer("modbus", *transfers, selected, is_long)
    if layouts.scope.calls_only and not text:
        return frames.Frame((), (), transfer)
    text_place = f"{{{view.function}_addresses, {address}, {point.words}U}}"
    parts = [text_place if text else layouts.of(point, places_of(point))]
    parts += [
        f"{{{unsigned(number)}, {at}, {point.words}U}}" for number, at in ((read, address), (write, to)) if number
    ]
    access = f"{'r' if read else ''}{('w' if point.bits is None else 'u') if write else ''}"
    kind = f"fieldscribe_modbus_{'text_' if text else ''}{access}"
    descriptor = frames.Descriptor(kind, name, f"{{{', '.join(parts)}}}", "_frame")
    row = partial(_row, view, parts[0], access, layouts.scope) if has_row(view) and not point.selects else None
    cases = ("NO_FUNCTION",) if selected is None else tuple(_cases(point, view, access, selected))
    return frames.Frame((descriptor,), cases, transfer, row)


def _row(view: PointView, layout: str, access: str, scope: HeaderScope) -> str:
    """Return the row of a point; `update` is in the place of `write`."""
    names = {"r": "read", "w": "write", "u": "update"}
    ways = {way: f"&{view.function}_frame.{names[way]}" for way in access if way == "r" or is_written_by_row(view)}
    read, write = ways.get("r", "NULL"), ways.get("w", ways.get("u", "NULL"))
    facts = f"&{scope.prefix}_modbus_profile", layout, read, write, *facts_of(view, "FIELDSCRIBE_MODBUS_RAW")
    return called(f"FIELDSCRIBE_MODBUS_{'BASED_' if view.point.base else ''}ROW", *facts)


def _transfer(function: int | None, address: str, several: str) -> str:
    """Return the arguments of the runtime's macros for reading or writing a point; empty if no request does.

    `several` is the last argument of those for several words: their number, or of a 32-bit number its high word.
    """
    if not function:
        return ""
    return f"{unsigned(function)}, {address}{several}"


def _cases(point: Point, view: PointView, access: str, selected: str) -> Iterator[str]:
    """Yield the macros by which the conformance program runs the exchanges of a point."""
    name, text = f"{view.function}_frame", point.text is not None
    if point.selects:
        yield f"SELECTED({selected})"
    if point.base:
        yield f'AT_BASE(fieldscribe_modbus_{"text_" if text else ""}{access}, {name}, "{point.base}")'
        yield from (f"{_MOVED[letter]}_AT_BASE" for letter in access)
        name = "moved"
    ways = [_MOVED[letter] for letter in access]
    yield from [f"{way}_TEXT({name}, {point.words}U)" for way in ways] if text else frames.exchanges(view, name, ways)


def _blocks(
    group: str, blocks: tuple[Block, ...], by_name: Mapping[str, Sequence[GeneratedPoint]], members: Members
) -> BlocksView:
    def parts() -> Iterator[Part]:
        for number, block in enumerate(blocks):
            texts = [
                members.of(each, at)
                for name in block.points
                for each in by_name[name]
                if (at := min(each.point.place.addresses, default=-1) - block.address) >= 0
                and at <= block.count - each.point.words
                and each.point.space == block.space
            ]
            yield Part.of(unsigned(number), texts)

    values = StructView(f"{members.scope.prefix}_{group}_group", parts)
    return BlocksView(group, f"{members.scope.prefix}_{group}_blocks", values, blocks, by_name)


def _command(command: Command, scope: HeaderScope) -> dict[str, Any]:
    """Return a command: a write of a constant, with a name."""
    macro = f"{scope.upper}_COMMAND_{upper(command.name)}"
    value = "1U" if command.value is None else unsigned(command.value)
    comment = c_comment(command.title["en"]) + (": any value does" if command.value is None else "")
    if command.wears is not None:
        comment += f"; the memory is rated for {command.wears} writes"
    defines = ((f"{macro}_ADDRESS", hexadecimal(command.address)), (f"{macro}_VALUE", value))
    descriptor = frames.Descriptor(
        "fieldscribe_modbus_command",
        f"{scope.prefix}_command_{command.name}",
        f"{{{{{unsigned(command.function)}, {macro}_ADDRESS, 1U}}, {macro}_VALUE}}",
    )
    return {"descriptor": descriptor, "comment": f"{comment}.", "defines": defines}


IN_C = frames.CFamily(header, has_facts=True, identifies=identifies)
