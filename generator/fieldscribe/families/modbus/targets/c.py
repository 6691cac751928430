"""The view of the Modbus header: the device's profile, reads block by block, requests point by point, commands."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.families.modbus import framings_of, of_bus
from fieldscribe.names import upper
from fieldscribe.targets.c.frames import (
    Descriptor,
    Frame,
    Frames,
    Layouts,
    exceptions_of,
    kind_of,
    lies,
    names_of,
    names_of_exceptions,
    old_names_of,
    places_of,
    shares,
)
from fieldscribe.targets.c.literals import hexadecimal, unsigned
from fieldscribe.targets.identifiers import Owner
from fieldscribe.text import c_comment

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from fieldscribe.model import Block, Command, Device, Point
    from fieldscribe.targets.c.kinds import Placed
    from fieldscribe.targets.c.scope import HeaderScope
    from fieldscribe.targets.c.views import AliasView, Define, PointView
    from fieldscribe.targets.identifiers import Named

_MOST = {1: 2000, 2: 2000, 3: 125, 4: 125, 5: 1, 6: 1, 8: 1, 15: 1968, 16: 123}
"""The functions that the runtime supports, with the limits of the protocol."""

_BROADCAST = (5, 6, 15, 16)
"""The functions that may be broadcast unless the manual says otherwise."""

_READS = {"coil": 1, "discrete": 2, "holding": 3, "input": 4}


NAMED_CODES: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class BlocksView:
    """The reads that fetch the points of a group."""

    name: str
    array: str
    rows: tuple[tuple[str, str, str, str], ...]
    """Function, address and count of each, and what it holds."""


@dataclass(frozen=True, slots=True)
class CommandView:
    """A command: a write of a constant, with a name."""

    descriptor: Descriptor
    comment: str
    defines: tuple[Define, ...]


@dataclass(frozen=True, slots=True)
class BusView:
    """The Modbus header of a device."""

    guard: str
    functions: tuple[tuple[str, str, str, str], ...]
    units: tuple[int, int]
    broadcast: str
    pads: str
    rtu: str
    tcp: str
    blocks: tuple[BlocksView, ...]
    block_most: Define
    """The items of the largest block."""
    layouts: tuple[Descriptor, ...]
    frames: Frames
    commands: tuple[CommandView, ...]
    exceptions: tuple[tuple[str, str, str], ...]
    aliases: tuple[AliasView, ...]


def bus_view(device: Device, placed: Sequence[Placed], scope: HeaderScope) -> BusView:
    """The view of `<device>_modbus.h`."""
    bus = device.bus
    functions = tuple(
        (
            unsigned(code.number),
            f"{min(code.most or _MOST[code.number], _MOST[code.number])}U",
            "true" if code.number in _BROADCAST and code.broadcast is not False else "false",
            c_comment(code.name),
        )
        for code in bus.functions
        if code.number in _MOST
    )
    numbers = frozenset(code.number for code in bus.functions)
    layouts = Layouts(scope)
    labels = {point.name: point.code or point.name for point in device.points}
    all_blocks = [block for blocks in device.blocks.values() for block in blocks]
    frames = Frames(placed, lambda point, view: _frame(point, view, numbers, layouts) if point.addresses else None)
    return BusView(
        guard=f"{scope.upper}_MODBUS_H",
        functions=functions,
        units=bus.units,
        broadcast="FIELDSCRIBE_MODBUS_NO_BROADCAST" if bus.broadcast is None else f"{bus.broadcast}U",
        pads="true" if of_bus(bus).pad_coil_bytes == "even" else "false",
        rtu="true" if "rtu" in framings_of(bus) else "false",
        tcp="true" if "tcp" in framings_of(bus) else "false",
        blocks=tuple(_blocks(group, blocks, labels, scope) for group, blocks in device.blocks.items() if blocks),
        block_most=(f"{scope.upper}_BLOCK_MOST", unsigned(max((block.count for block in all_blocks), default=0))),
        layouts=layouts.descriptors,
        frames=frames,
        commands=tuple(_command(command, scope) for command in device.commands),
        exceptions=exceptions_of(device, scope),
        aliases=tuple(frames.aliases(scope)),
    )


def identifiers(device: Device, bus: BusView, scope: HeaderScope) -> Iterator[Named]:
    """Every identifier of the header, with what it belongs to."""
    own = (f"{scope.prefix}_modbus_functions", f"{scope.prefix}_modbus_profile")
    yield Owner("target", "what the header of frames needs"), (bus.guard, *own)
    if bus.blocks:
        yield Owner("target", "the largest block"), (bus.block_most[0],)
    for blocks in bus.blocks:
        yield Owner("group", blocks.name), (blocks.array,)
    for command, command_view in zip(device.commands, bus.commands, strict=True):
        yield (
            Owner("command", command.name),
            (command_view.descriptor.name, *(name for name, _ in command_view.defines)),
        )
    yield from names_of_exceptions(device, bus.exceptions)
    yield from names_of(bus.layouts, [bus.frames])
    yield from old_names_of(bus.aliases)


def sections(bus: BusView) -> dict[str, Frames]:
    """The requests of points."""
    return {"frames": bus.frames}


def _cases(point: Point, view: PointView, access: str) -> Iterator[str]:
    """The macros by which a point runs the vectors of whole exchanges."""
    name, text = f"{view.function}_frame", point.text is not None
    what = f"{name}, {point.words}U" if text else f"{name}, {kind_of(point)}, {view.raw_type}"
    if not text:
        yield f"LIES({name}, {lies(point)})"
    for letter, way in (("r", "READ"), ("w", "WRITE"), ("u", "UPDATE")):
        if letter in access:
            yield f"{way}{'_TEXT' if text else ''}({what})"


def _frame(point: Point, view: PointView, functions: frozenset[int], layouts: Layouts) -> Frame | None:
    """The requests of a point; None if no function of the device reaches it or its word must be read before a write."""
    read = _READS.get(point.space, 0) if point.readable else 0
    write = _writing(point, functions) if point.writable else 0
    read = read if read in functions else 0
    if point.bits is not None and not read:
        write = 0
    if not read and not write:
        return None
    address = view.words.address
    to = address if point.write_place is None else hexadecimal(min(point.write_place.addresses))
    text = f"{{{view.function}_addresses, {address}, {point.words}U}}" if point.text is not None else ""
    parts = [text or layouts.of(point, places_of(point))]
    parts += [_place(read, address, point.words)] if read else []
    parts += [_place(write, to, point.words)] if write else []
    access = f"{'r' if read else ''}{('u' if shares(point) else 'w') if write else ''}"
    kind = f"fieldscribe_modbus_{'text_' if text else ''}{access}"
    descriptor = Descriptor(kind, f"{view.function}_frame", f"{{{', '.join(parts)}}}", "_frame")
    return Frame((descriptor,), tuple(_cases(point, view, access)))


def _place(function: int, address: str, words: int) -> str:
    return f"{{{unsigned(function)}, {address}, {words}U}}"


def _writing(point: Point, functions: frozenset[int]) -> int:
    """The function that writes a point: the one for one item, else that for several; 0 if the device has neither."""
    if point.space == "coil":
        wanted = (5, 15)
    elif point.space == "holding":
        wanted = (6, 16) if point.words == 1 else (16, 16)
    else:
        return 0
    return next((number for number in wanted if number in functions), 0)


def _blocks(group: str, blocks: tuple[Block, ...], labels: Mapping[str, str], scope: HeaderScope) -> BlocksView:
    rows = tuple(
        (unsigned(block.function), hexadecimal(block.address), unsigned(block.count), _holds(block, labels))
        for block in blocks
    )
    return BlocksView(group, f"{scope.prefix}_{group}_blocks", rows)


def _holds(block: Block, labels: Mapping[str, str]) -> str:
    """The first and the last point of a block, by their codes where they have some."""
    ends = dict.fromkeys(labels[name] for name in (block.points[0], block.points[-1]))
    return c_comment("..".join(ends))


def _command(command: Command, scope: HeaderScope) -> CommandView:
    macro = f"{scope.upper}_COMMAND_{upper(command.name)}"
    value = "1U" if command.value is None else unsigned(command.value)
    comment = c_comment(command.title["en"]) + (": any value does" if command.value is None else "")
    if command.wears is not None:
        comment += f"; the memory stands {command.wears} writes"
    defines = ((f"{macro}_ADDRESS", hexadecimal(command.address)), (f"{macro}_VALUE", value))
    write = f"{{{unsigned(command.function)}, {macro}_ADDRESS, 1U}}"
    name = f"{scope.prefix}_command_{command.name}"
    descriptor = Descriptor("fieldscribe_modbus_command", name, f"{{{write}, {macro}_VALUE}}")
    return CommandView(descriptor, f"{comment}.", defines)
