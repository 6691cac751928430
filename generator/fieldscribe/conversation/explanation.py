"""Explains what a user names, for `explain`: points with all facts, commands, errata, messages, codes, units, gaps."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import partial
from typing import NamedTuple

from fieldscribe import wording
from fieldscribe.arithmetic.exact import float_of, pattern_of
from fieldscribe.arithmetic.words import ends_of, number_of, with_fixed
from fieldscribe.conversation.decode_state import Directory
from fieldscribe.conversation.meanings import Meanings, raw_form
from fieldscribe.conversation.point_items import Doubts
from fieldscribe.facts.points import POINT
from fieldscribe.facts.table import Context, Row
from fieldscribe.facts.texts import place_in_manual
from fieldscribe.families import Codes, family
from fieldscribe.families.frame_results import WriteMethod
from fieldscribe.language.units import shipped, shipped_unit
from fieldscribe.model import Code, Command, Device, Erratum, Message, Point, Step, SteppedCommand
from fieldscribe.pasted_numbers import number_of as typed_number
from fieldscribe.text import line
from fieldscribe.wording.numbers import hex_text, rounded
from fieldscribe.wording.rules import run_text, steps_texts

_ROWS = {
    "wire": "Wire address",
    "low_wire": "Addresses",
    "range": "Raw range",
    "range_in_units": "Range",
    "default_in_units": "Default",
}
"""The row of a printed fact, if its label differs from its key."""


class Explanation(NamedTuple):
    """The explanation of a point: a heading and rows of label and text, without control characters."""

    heading: str
    rows: tuple[Row, ...]

    def as_data(self) -> dict[str, object]:
        """Return the same for JSON."""
        return {"heading": self.heading, "rows": [{"label": label, "text": text} for label, text in self.rows]}


def explain_point(device: Device, point: Point, *, as_documented: bool = False, raw: int | None = None) -> Explanation:
    """Return all facts of a point; with `as_documented`, as the manual prints them, without errata.

    Rows about the raw number, if there is one, come first.
    """
    errata = [erratum for erratum in device.errata if erratum.id in point.errata]
    printed = errata if as_documented else []
    rows = [*_rows_of_number(device, point, raw), *(row for row in _rows(device, point, errata, printed) if row[1])]
    head = f"{point.code} {point.item}" if point.code else point.item
    heading = line(f"{head}: {wording.title_text(point.title)}")
    return Explanation(heading, tuple((line(label), line(text)) for label, text in rows))


def _rows_of_number(device: Device, point: Point, raw: int | None) -> Iterator[Row]:
    """Return the meaning of a raw number, and if it is out of range, other readings of it."""
    if raw is None or point.text is not None:
        return
    signed = raw < 0
    if not ends_of(point.width, signed=signed)[0] <= raw <= ends_of(point.width, signed=signed)[1]:
        yield f"Raw {raw}", f"it does not fit into the {point.width} bits of the point"
        return
    raw = number_of(raw, point.width, signed=point.info.signed) if raw > 0 else raw
    meaning = Meanings(device, point).text(raw, {})
    yield f"R{raw_form(point)(raw)[1:]}", meaning
    variant = replace(point, variant=None)  # numbers of other variants are out of range here
    doubts = Doubts(device, variant, partial(Directory(device).neighbours, point))
    yield from (("Doubt", text) for text in doubts.of(raw, {}, meaning))


def _rows(device: Device, point: Point, errata: list[Erratum], printed: list[Erratum]) -> Iterator[Row]:
    """Return the rows of the facts in the table, those of `printed` errata as printed; texts may be empty."""
    context = Context(device)
    rows: list[Row] = []
    for fact in POINT:
        if fact.key == "errata":
            yield from _with_printed_facts([row for row in rows if row[1]], printed)
            yield from (("Erratum", _erratum_text(erratum)) for erratum in errata if not printed)
            rows.clear()
        rows += fact.rows_of(point, context)
        if fact.key == "access" and point.generated and not printed:
            rows += [("Read", read_text(device, point)), ("Write", write_text(device, point))]
    yield from rows


def read_text(device: Device, point: Point) -> str:
    """Return how the point is read, with an example; empty if it cannot be read."""
    part = family(device.family).part("frame_builder")
    return str(part.read_text(device, point)) if part and point.readable and point.addresses else ""


def write_text(device: Device, point: Point) -> str:
    """Return how the point is written, with an example; empty if it cannot be written."""
    part = family(device.family).part("frame_builder")
    way: WriteMethod | None = part.way_to_write(device, point) if part and point.writable and point.addresses else None
    if way is None:
        return ""
    raw = None if way.example is None else sample_raw(point)
    frames = "" if way.example is None or raw is None else way.example(raw)
    return way.how if raw is None or not frames else f"{way.how}{way.joint}{_sample_text(point, raw)}{frames}"


def sample_raw(point: Point) -> int | None:
    """Return a raw number for an example that certainly may be written, and moves a machine least; None without one.

    It is the default, else the allowed number nearest to zero.
    """
    if point.text is not None:
        return None
    if point.info.floating:
        first = point.allowed.units[0][0] if point.allowed.units else 0
        number = first if point.default is None else point.default
        return pattern_of(number, point.info.bits)
    raw = point.default_raw
    if raw is not None:
        special = point.special(raw)
        if special is None or special.writable:
            return with_fixed(point, raw) if special is None else raw
    ends = [
        end for interval in point.allowed.intervals for end in (interval.low, interval.high) if isinstance(end, int)
    ]
    return with_fixed(point, min(ends, key=abs)) if ends else None


def _sample_text(point: Point, raw: int) -> str:
    """Return the example: its meaning, and the raw number."""
    if point.info.floating:
        number = float_of(raw, point.info.bits)
        text = f"{number:g}" if point.display is None else rounded(*number.as_integer_ratio(), point.display)
        return f"for example {wording.with_unit(text, point)} is the pattern {hex_text(raw, point.width // 4)}"
    meaning = wording.meaning_text(point, raw)
    return f"for example {meaning} is raw {raw}" if meaning else f"for example raw {raw}"


def _erratum_text(erratum: Erratum) -> str:
    printed, taken, why = (text.rstrip(". ") for text in (erratum.printed, erratum.taken, erratum.why))
    doubts = ", ".join(text for _, text in erratum.leaves_open)
    tail = f" The manual leaves open {doubts}." if doubts else ""
    return f"{erratum.id} ({erratum.certainty}): the manual prints: {printed}. Taken: {taken}. {why}.{tail}"


def _with_printed_facts(rows: list[Row], errata: list[Erratum]) -> list[Row]:
    """Return the rows with the printed facts of errata in place of the corrected ones; facts without a row follow."""
    replaced, further = list(rows), []
    for erratum in errata:
        facts = [(_ROWS.get(key, key.replace("_", " ").capitalize()), text) for key, text in erratum.facts]
        for label, text in facts or [("The manual says", erratum.printed)]:
            remark = f"{text} (as printed; {erratum.id})"
            at = next((place for place, row in enumerate(rows) if row[0].lower() == label.lower()), None)
            if at is None:
                further.append((label, remark))
            else:
                replaced[at] = replaced[at][0], remark
    return replaced + further


_MOST_POINTS = 20
_ROLES = {"address": "address", "raw": "value"}


def explain_other_items(device: Device, what: str) -> list[tuple[list[str], Explanation]]:
    """Return reading and explanation of each item with this name, or kind and number: `task:1`, `can:321`."""
    prefix, colon, rest = what.strip().partition(":")
    forced = prefix.strip().lower() if colon else ""
    text = (rest if colon else prefix).strip()
    items = _units(device, text) if forced == "unit" else _items(device, text, forced)
    return [
        ([reading], Explanation(line(heading), tuple((label, line(cell)) for label, cell in rows if cell)))
        for reading, heading, rows in items
    ]


OtherItem = tuple[str, str, list[Row]]
"""The reading of the text, a heading, and rows; empty rows are left out."""


def _items(device: Device, text: str, forced: str) -> Iterator[OtherItem]:
    name = text.lower() if forced in ("", "name") else None
    number = typed_number(text) if forced in ("", "wire") else None
    for command in device.commands:
        if reading := _reading_of(device, command, text, forced):
            yield reading, *_command(device, command)
    for stepped in device.stepped_commands:
        reading = (
            f"command {stepped.name}" if name == stepped.name else _reading_of_steps(device, stepped, text, forced)
        )
        if reading:
            yield reading, *_stepped(device, stepped)
    for erratum in device.errata:
        if name == erratum.id:
            yield f"erratum {erratum.id}", *_erratum(device, erratum)
    yield from _codes(device, text, forced)
    yield from _messages(device, text, forced)
    for space, gaps in device.bus.gaps.items():
        for low, high in gaps:
            if number is not None and low <= number <= high:
                yield f"wire address {wording.address_text(number)}, {space}", *_gap(space, low, high)


def _reading_of(device: Device, command: Command, text: str, forced: str) -> str:
    """Return how the text names a command: by its name, its address, or a usual number for that."""
    if forced in ("", "name") and text.lower() == command.name:
        return f"command {command.name}"
    return _reading_of_address(device, command.space, command.address, text, forced)


def _reading_of_steps(device: Device, command: SteppedCommand, text: str, forced: str) -> str:
    """Return how the text names a word that steps of a command write and no point has."""
    readings: dict[str, list[str]] = {}
    for number, step in enumerate(command.steps, 1):
        for address in range(step.address, step.address + len(step.words)):
            reading = _reading_of_address(device, step.space, address, text, forced)
            if reading and not _has_point(device, step, address):
                readings.setdefault(reading, []).append(f"step {number}")
    return "; ".join(f"{reading}: {', '.join(steps)}" for reading, steps in readings.items())


def _has_point(device: Device, step: Step, address: int) -> bool:
    here = [point for point in device.points if (point.space, point.base) == (step.space, step.base)]
    return any(address in place.addresses for point in here for place in point.places)


def _reading_of_address(device: Device, space: str, address: int, text: str, forced: str) -> str:
    """Return how the text names an address: as it travels, or by a usual number for it; empty if it does not."""
    numbers = {"wire": address, **family(device.family).numbers(space, address)}
    key = next((key for key, number in numbers.items() if number == typed_number(text) and forced in ("", key)), "")
    if key == "wire":
        return f"wire address {wording.address_text(address)}, {space}"
    return key and f"{key} {numbers[key]}"


def _command(device: Device, command: Command) -> tuple[str, list[Row]]:
    value = "any value" if command.value is None else f"{command.value} ({hex_text(command.value)})"
    where = f"{command.space} {wording.address_text(command.address)}"
    return _heading(command), [
        ("Write", f"{value} to {where}, function {hex_text(command.function, 2)}"),
        ("Memory", f"stands {command.wears} writes" if command.wears else ""),
        ("Busy", f"while {command.busy} is set" if command.busy else ""),
        ("Note", wording.title_text(command.note) if command.note else ""),
        ("Source", place_in_manual(command.source, device)),
    ]


def _stepped(device: Device, command: SteppedCommand) -> tuple[str, list[Row]]:
    texts = steps_texts(command, {point.name: point for point in device.points})
    frames_of = family(device.family).part("frame_builder").frames_of_step
    lowest = {name: low for name, (low, _) in command.arguments.items()}
    rows = [("Run", run_text(command))]
    for number, (step, text) in enumerate(zip(command.steps, texts, strict=True), 1):
        rows += [(f"Step {number}", text), *((f"Frame {number}", frame) for frame in frames_of(device, step, lowest))]
    note = ("Note", wording.title_text(command.note) if command.note else "")
    return _heading(command), [*rows, note, ("Source", place_in_manual(command.source, device))]


def _heading(command: Command | SteppedCommand) -> str:
    return f"command {command.name}: {wording.title_text(command.title)}"


def _erratum(device: Device, erratum: Erratum) -> tuple[str, list[Row]]:
    return f"erratum {erratum.id} ({erratum.certainty})", [
        ("About", ", ".join(erratum.points) or str(erratum.where)),
        ("Printed", erratum.printed),
        ("Taken", erratum.taken),
        ("Why", erratum.why),
        ("Leaves open", "; ".join(text for _, text in erratum.leaves_open)),
        ("Source", place_in_manual(erratum.source, device)),
    ]


def _gap(space: str, low: int, high: int) -> tuple[str, list[Row]]:
    where = f"{wording.address_text(low)} to {wording.address_text(high)}"
    meaning = "the manual gives these addresses no meaning; no request may reach across them"
    return f"{space} {where}: closed", [("Meaning", meaning)]


def _codes(device: Device, text: str, forced: str) -> Iterator[OtherItem]:
    """Return functions, tasks, responses, errors, ... with this name, or with this number after their kind."""
    for codes in family(device.family).codes:
        for code in device.bus.codes(codes.section):
            by_number = forced == codes.kind and typed_number(text) == code.number
            if by_number or (forced in ("", "name", codes.kind) and text.lower() == code.name):
                heading = f"{codes.kind} {code.number} {code.name}: {wording.title_text(code.title)}"
                yield f"{codes.kind} {code.number}", heading, list(_code_rows(device, codes, code))


def _code_rows(device: Device, codes: Codes, code: Code) -> Iterator[Row]:
    if code.most is not None:
        yield "At most", f"{code.most} in one request"
    if code.broadcast is not None:
        yield "Broadcast", "yes" if code.broadcast else "no"
    for other in family(device.family).codes:
        if other.section == codes.belongs_to:
            names = {other_code.number: other_code.name for other_code in device.bus.codes(other.section)}
            none = "none" if codes.section == "functions" else ""  # a request without an answer gets a row, too
            yield f"{other.kind.capitalize()}s", _named(code.answers, names) or none
            yield "Refused by", _named(code.refusals, names)


def _named(numbers: tuple[int, ...], names: Mapping[int, str]) -> str:
    return ", ".join(f"{number} {names.get(number, '')}".strip() for number in numbers)


def _messages(device: Device, text: str, forced: str) -> Iterator[OtherItem]:
    """Return messages with this name, or with this identifier after the name of the family."""
    protocol = family(device.family)
    number = _identifier(text) if protocol.lays_out_messages and forced == protocol.name else None
    for message in device.messages:
        if forced in ("", "name") and text.lower() == message.name:
            yield f"message {message.name}", *_message(device, message)
        low, high = device.bus.units if message.adds_unit else (0, 0)
        if number is not None and message.identifier + low <= number <= message.identifier + high:
            unit = f" of unit {number - message.identifier}" if message.adds_unit else ""
            yield f"{protocol.name.upper()} identifier {hex_text(number, 3)}{unit}", *_message(device, message)


def _identifier(text: str) -> int | None:
    """Return an identifier, hexadecimal as in the tools of the bus: `321`, `0x321`, `321h`."""
    digits = text.lower().removeprefix("0x").removesuffix("h")
    plain = 0 < len(digits) <= 8 and all(digit in "0123456789abcdef" for digit in digits)
    return int(digits, 16) if plain else None


def _message(device: Device, message: Message) -> tuple[str, list[Row]]:
    low, high = device.bus.units
    where = hex_text(message.identifier, 3)
    if message.adds_unit:
        where = f"{where} + unit: {hex_text(message.identifier + low, 3)} to {hex_text(message.identifier + high, 3)}"
    telegrams = [telegram.name for telegram in device.telegrams if telegram.message == message.name]
    return f"message {message.name}: {wording.title_text(message.title)}", [
        (f"{device.family.upper()} identifier", where),
        ("Direction", message.direction),
        ("Answers", message.answers or ""),
        *((f"Byte {place}", _role_text(role.kind, role.number)) for place, role in enumerate(message.roles)),
        ("Telegram", ", ".join(telegrams)),
    ]


def _role_text(kind: str, number: int) -> str:
    if kind == "constant":
        return f"always {hex_text(number, 2)}"
    if kind == "xor":
        places = [str(place) for place in range(8) if number >> place & 1]
        return f"bytes {', '.join(places)} combined by exclusive or"
    if kind == "word":
        return f"word {number // 2} of the frame, {'low' if number & 1 else 'high'} byte"
    if kind in _ROLES:
        return f"{_ROLES[kind]}, {'high' if number else 'low'} byte"
    return {"unit": "unit number", "multiplexer": "multiplexer: which words of the telegram follow"}.get(kind, kind)


def _units(device: Device, symbol: str) -> Iterator[OtherItem]:
    """Return the unit with this symbol: that of the device, else the shipped one."""
    used = {point.unit.symbol: point.unit for point in device.points if point.unit.symbol}
    unit = used.get(symbol) or shipped_unit(symbol)
    if unit is None:
        return
    known = shipped().get(unit.symbol)
    declared = known is None or known.unit != unit
    names = list(dict.fromkeys(point.name for point in device.points if point.unit == unit))
    rest = f" and {len(names) - _MOST_POINTS} more" if len(names) > _MOST_POINTS else ""
    yield (
        f"unit {unit.symbol}",
        f"{unit.symbol}: {unit.name}",
        [
            ("Quantity", unit.quantity),
            ("Means", f"{known.factor} {known.base}" if known is not None and known.prefix and not declared else ""),
            ("Declared", "by the description" if declared else "no need: it comes with fieldscribe"),
            ("Points", ", ".join(names[:_MOST_POINTS]) + rest if names else "none"),
        ],
    )
