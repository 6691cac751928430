"""The messages and signals of a CAN database: scale, limits, names and bits of each point, and its multiplexer.

`messages_of` returns what `dbc.py` writes.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from itertools import groupby, pairwise
from typing import Any

from fieldscribe import wording
from fieldscribe.arithmetic.exact import SAME
from fieldscribe.arithmetic.words import mask_of
from fieldscribe.export import ExportError
from fieldscribe.families.can import USUAL_BITS, identifier_bits
from fieldscribe.families.can.frames import LENGTH, carries, frame_count, identifier, places
from fieldscribe.families.can.signals import selectors
from fieldscribe.grouping import grouped
from fieldscribe.model import Device, Field, Flag, Message, Point
from fieldscribe.text import line
from fieldscribe.wording.numbers import fixed_rule, hex_text

_EXTENDED = 1 << 31
"""The bit that marks an extended identifier (29 bits)."""
_MOST_NAME = 32
_MOST_CODES = 32
"""A longer band of special codes goes to the comment only: a database names single numbers."""
_NUMBERS = {
    "unit": ("unit", "The unit"),
    "address": ("parameter", "The id of the parameter"),
    "raw": ("value", "The raw word of the parameter"),
}
"""The names and comments of the signals of a parameter's message."""


@dataclass(frozen=True, slots=True)
class Signal:
    """A signal of a database. `switch` is (the multiplexing signal, its value); `start` is the database's start bit."""

    name: str
    start: int = 0
    size: int = 8
    big_endian: bool = True
    signed: bool = False
    factor: str = "1"
    offset: str = "0"
    least: str = "0"
    greatest: str = "0"
    unit: str = ""
    comment: str = ""
    values: tuple[tuple[int, str], ...] = ()
    switch: tuple[str, int] | None = None
    also: tuple[int, ...] = ()
    """Further numbers of the multiplexer that select the signal."""
    switches: bool = False
    floating: bool = False
    short: str = ""

    @property
    def multiplexing(self) -> str:
        """The mark of a signal that a multiplexer value selects (`m3`), of a multiplexer (`M`), or of both (`m3M`)."""
        return ("" if self.switch is None else f"m{self.switch[1]}") + ("M" if self.switches else "")


@dataclass(slots=True)
class DbcMessage:
    """All messages of one identifier; `id` is the identifier as databases write it."""

    name: str
    id: int
    length: int
    from_master: bool
    comment: str
    signals: list[Signal] = field(default_factory=list)
    short: str = ""
    every: int | None = None


def messages_of(device: Device, unit: int) -> list[DbcMessage]:
    """Return the messages of a database for one unit. Raises ExportError."""
    keys = ((each.identifier, each.adds_unit, each.bits, bool(each.roles)) for each in device.messages)
    by_identifier = grouped(zip(keys, device.messages, strict=True))
    shorts: set[str] = set()
    dbc_messages = [_message(device, unit, group) for group in by_identifier.values()]
    for dbc_message in dbc_messages:
        dbc_message.short = _unique(dbc_message.name, shorts, _MOST_NAME)
    return dbc_messages


def _message(device: Device, unit: int, group: list[Message]) -> DbcMessage:
    """Return the message of one identifier; if several share it, a signal `message` selects which one it is."""
    first = group[0]
    if first.fields:
        return _of_fields(device, unit, first)
    number = first.identifier + unit if first.adds_unit else first.identifier
    masters = all(message.direction == "request" for message in group)
    kinds = "requests" if masters else f"unit_{unit}_messages" if first.adds_unit else f"messages_{number:X}"
    titles = line("; ".join(f"{message.name}: {message.title['en']}" for message in group))
    name = first.name if len(group) == 1 else kinds
    result = DbcMessage(name, _written(device, first, unit), len(first.roles), masters, titles)
    selector = _selector(group) if len(group) > 1 else None
    signals: list[Signal] = []
    if selector is not None:
        values = tuple((message.roles[selector].number, message.name) for message in group)
        low, high = str(min(values)[0]), str(max(values)[0])
        comment = f"Byte {selector} says which message it is"
        name, start = "message", 8 * selector + 7
        signals = [Signal(name, start, least=low, greatest=high, comment=comment, values=values, switches=True)]
    for message in group:
        switch = None if selector is None else ("message", message.roles[selector].number)
        for signal in (*_head_signals(device, message, unit, selector), *_telegram_signals(device, message)):
            signals.append(signal if signal.switch is not None else replace(signal, switch=switch))
    result.signals = _with_unique_names(signals)
    return result


def _written(device: Device, message: Message, unit: int) -> int:
    """Return the identifier of a message in the form of databases."""
    bits = message.bits or identifier_bits(device.bus)
    return identifier(message, unit) | (_EXTENDED if bits > USUAL_BITS else 0)


def _of_fields(device: Device, unit: int, message: Message) -> DbcMessage:
    """Return the message of signals."""
    points = {point.addresses[0]: point for point in _points(device, message.name)}
    selecting = set(selectors(message))
    named = {place: points[each.word] for place, each in enumerate(message.fields) if each.word in points}
    found = [
        replace(
            _scaled_signal(point, _comment(device, point)),
            name=_name_of(point),
            start=message.fields[place].start,
            size=point.width,
            big_endian=not message.fields[place].low_first,
            floating=point.shape.wire_type[0] == "f",
            switches=place in selecting,
            **_switch(message, message.fields[place], named),
        )
        for place, point in named.items()
    ]
    written, from_master = _written(device, message, unit), message.direction == "request"
    result = DbcMessage(message.name, written, message.length, from_master, line(message.title["en"]))
    result.every, result.signals = message.every, _with_unique_names(found)
    return result


def _with_unique_names(signals: list[Signal]) -> list[Signal]:
    """Return the signals of a message with unique names, long and short."""
    names, shorts = set[str](), set[str]()
    return [
        replace(each, name=_unique(each.name, names), short=_unique(each.name, shorts, _MOST_NAME)) for each in signals
    ]


def _switch(message: Message, placed: Field, named: Mapping[int, Point]) -> dict[str, Any]:
    """Return the selector of a signal; of several, the one that the others select."""
    if not placed.when:
        return {}
    place, raws = max(placed.when, key=lambda choice: len(message.fields[choice[0]].when))
    return {"switch": (_name_of(named[place]), raws[0]), "also": raws[1:]}


def _name_of(point: Point) -> str:
    """Return the name of a signal: its code, if that is a valid name in a database."""
    return point.code if point.code and point.code.isascii() and point.code.isidentifier() else point.name


def _selector(group: list[Message]) -> int:
    """Return the byte that has a different constant in each message. Raises ExportError."""
    for place in range(LENGTH):
        numbers = {message.roles[place].number for message in group if place in places(message, "constant")}
        if len(numbers) == len(group):
            return place
    names = ", ".join(message.name for message in group)
    raise ExportError(f"no byte tells the messages {names} apart")


def _head_signals(device: Device, message: Message, unit: int, selector: int | None) -> Iterator[Signal]:
    """Yield the signals of all bytes but the selector and the words of a telegram."""
    fields = [place for place, role in enumerate(message.roles) if place != selector and role.kind != "word"]
    runs = groupby(enumerate(fields), lambda numbered: (message.roles[numbered[1]].kind, numbered[1] - numbered[0]))
    for (kind, _), run in runs:
        run_places = [place for _, place in run]
        start, size = 8 * run_places[0] + 7, 8 * len(run_places)
        if kind == "constant":
            for place in run_places:
                constant, text = str(message.roles[place].number), f"Always {hex_text(message.roles[place].number, 2)}"
                name = f"{message.name}_byte_{place}"
                yield Signal(name, 8 * place + 7, least=constant, greatest=constant, comment=text)
        elif kind == "xor":
            sums = [f"byte {place} is bytes {_bytes_of_mask(message.roles[place].number)}" for place in run_places]
            comment = "; ".join(f"{text} combined by exclusive or" for text in sums)
            yield Signal(f"{message.name}_checksum", start, size, greatest=str((1 << size) - 1), comment=comment)
        elif kind == "multiplexer":
            telegram = next((candidate for candidate in device.telegrams if candidate.message == message.name), None)
            slots = frame_count(telegram, message) if telegram is not None and message.words else 256
            comment = "Which words of the telegram follow"
            name = f"{message.name}_multiplexer"
            yield Signal(name, start, greatest=str(slots - 1), comment=comment, switches=True)
        else:
            units = (unit, unit) if message.adds_unit else device.bus.units
            yield _number(device, message, kind, run_places, units)


def _number(device: Device, message: Message, kind: str, run: list[int], units: tuple[int, int]) -> Signal:
    """Return the signal of the unit, the parameter's id or the parameter's word."""
    name, comment = _NUMBERS[kind]
    start, size, big = span_of({message.roles[place].number: place for place in run}, message.name)
    low, high = units if kind == "unit" else (0, (1 << size) - 1)
    values = tuple(_parameter_names(device)) if kind == "address" else ()
    least, greatest, name = str(low), str(high), f"{message.name}_{name}"
    return Signal(name, start, size, big, least=least, greatest=greatest, comment=comment, values=values)


def span_of(bytes_by_shift: dict[int, int], name: str) -> tuple[int, int, bool]:
    """Return (start bit, size, big endian) of bytes, each given by its distance from bit 0. Raises ExportError."""
    shifts = sorted(bytes_by_shift, reverse=True)
    run = [bytes_by_shift[shift] for shift in shifts]
    size = 8 * len(run)
    if shifts != list(range(size - 8, -8, -8)):
        raise ExportError(f"message {name}: a number has a hole between its bytes")
    if all(after == before + 1 for before, after in pairwise(run)):
        return 8 * run[0] + 7, size, True
    if all(after == before - 1 for before, after in pairwise(run)):
        return 8 * run[-1], size, False
    raise ExportError(f"message {name}: a number lies in bytes that are not neighbours")


def _parameter_names(device: Device) -> Iterator[tuple[int, str]]:
    """Yield the names of parameters by id: all names if several share a word; with the number of the word for texts."""
    names: dict[int, dict[str, None]] = {}
    for point in device.points:
        if point.space == "parameter" and point.generated:
            for place, address in enumerate(point.addresses, 1):
                part = f" {place}" if len(point.addresses) > 1 else ""
                names.setdefault(address, {})[point.name + part] = None
    for address in sorted(names):
        yield address, ", ".join(names[address])


def _telegram_signals(device: Device, message: Message) -> Iterator[Signal]:
    """Yield the signals of the points of a telegram, and of its words without a point."""
    for telegram in (telegram for telegram in device.telegrams if telegram.message == message.name):
        taken: dict[tuple[int, int], str] = {}
        for point in _points(device, telegram.name):
            for signal, address, words in point_signals(device, point, message):
                slot, word = divmod(address, message.words)
                high, low = point.bits or (16 * words - 1, 0)
                bits = [(slot, 16 * word + bit) for bit in range(low, high + 1)]
                other = next((taken[bit] for bit in bits if bit in taken), None)
                if other is not None:
                    raise ExportError(f"{signal.name} and {other} share bits; choose with --variant")
                taken.update(dict.fromkeys(bits, signal.name))
                yield _placed(message, signal, address, words, point)
        for address in range(telegram.words):
            slot, word = divmod(address, message.words)
            if not any((slot, 16 * word + bit) in taken for bit in range(16)):
                comment = "No point is described here"
                signal = Signal(f"{telegram.name}_word_{address}", greatest="65535", comment=comment)
                yield _placed(message, signal, address, 1)


def _points(device: Device, telegram: str) -> Iterator[Point]:
    """Yield the points of a telegram, also reserved ones; of variants with the same facts only the first."""
    seen: dict[str, Point] = {}
    for point in device.points:
        if point.telegram != telegram or not point.addresses:
            continue
        facts = ("addresses", "type", "bits", "unit", "scale", "enum")
        if point.name in seen and all(getattr(point, fact) == getattr(seen[point.name], fact) for fact in facts):
            continue
        seen[point.name] = point
        yield point


def point_signals(device: Device, point: Point, message: Message) -> Iterator[tuple[Signal, int, int]]:
    """Yield the signals of a point without their bits, each with its first word and its number of words.

    A point has one signal for each word where a database cannot join its words: they lie in two frames or in falling
    order, or are no big-endian integer.
    """
    addresses, per_frame = point.addresses, message.words
    comment = _comment(device, point)
    in_order = addresses == tuple(range(addresses[0], addresses[0] + len(addresses)))
    is_plain = not point.info.floating and point.text is None and not point.swapped
    joins = point.words == 1 or (_words_join(message) and is_plain)
    if in_order and joins and addresses[0] // per_frame == addresses[-1] // per_frame:
        yield _scaled_signal(point, comment), addresses[0], point.words
        return
    count = len(addresses)
    for place, address in enumerate(addresses):
        name = ("high", "low")[place] if count == 2 else f"word_{place + 1}"
        remark = f"{comment}. Word {place + 1} of {count}, the high part first; a database cannot put them together"
        yield Signal(f"{point.name}_{name}", greatest="65535", comment=line(remark)), address, 1


def _words_join(message: Message) -> bool:
    """Return True if the words are adjacent in a frame with the high byte first, as one big-endian number."""
    run = places(message, "word")
    return [message.roles[place].number for place in run] == list(range(len(run))) and run[-1] - run[0] == len(run) - 1


def _scaled_signal(point: Point, comment: str) -> Signal:
    rule = fixed_rule(point) if point.generated and not point.coding else None
    multiply, add, divide = exact = rule or SAME
    outer = (0, mask_of(point.width)) if point.coding else wording.outer_raw(point) or (point.least, point.greatest)
    least, greatest = sorted(map(exact.result, outer))
    unsettled = (not point.generated and not point.reserved) or bool(point.coding)
    return Signal(
        f"{point.name}_raw" if unsettled else point.name,
        signed=point.info.signed and not point.coding,
        factor=decimal(Fraction(multiply, divide)),
        offset=decimal(Fraction(add, divide)),
        least=decimal(least),
        greatest=decimal(greatest),
        unit=point.unit.symbol if rule is not None else "",
        comment=comment,
        values=() if point.coding else tuple(_names(point)),
    )


def _placed(message: Message, signal: Signal, address: int, words: int, point: Point | None = None) -> Signal:
    """Return the signal at its bits in the frame, with the multiplexer value that selects it."""
    slot, word = divmod(address, message.words)
    bits, low_first = (None, False) if point is None else (point.bits, point.swapped)
    bytes_of = {
        16 * (words - 1 - (role.number // 2 - word)) + (0 if bool(role.number & 1) != low_first else 8): place
        for place, role in enumerate(message.roles)
        if role.kind == "word" and word <= role.number // 2 < word + words
    }
    if bits is None:
        start, size, big = span_of(bytes_of, message.name)
    else:
        high, low = bits
        size, big = high - low + 1, True
        if high >> 3 == low >> 3:
            start = 8 * bytes_of[high & 8] + (high & 7)
        else:
            _, _, big = span_of(bytes_of, message.name)
            start = 8 * bytes_of[8] + (high & 7) if big else 8 * bytes_of[0] + low
    switch = (f"{message.name}_multiplexer", slot) if carries(message, "multiplexer") else None
    return replace(signal, start=start, size=size, big_endian=big, switch=switch)


def decimal(number: Fraction) -> str:
    """Return a number as databases write it: the shortest decimal of the nearest binary64."""
    return str(number.numerator) if number.denominator == 1 else repr(float(number))


def _names(point: Point) -> Iterator[tuple[int, str]]:
    """Yield the names of single numbers: special codes, then entries of the enum."""
    names: dict[int, str] = {}
    for special in point.specials if not point.info.floating else ():
        if special.high - special.low < _MOST_CODES:
            names.update(dict.fromkeys(range(special.low, special.high + 1), special.name))
    for entry in point.enum.entries if point.enum is not None else ():
        names.setdefault(entry.raw, entry.name)
    yield from names.items()


def _comment(device: Device, point: Point) -> str:
    """Return the title, and facts that a database cannot hold: rules that need other points, bits of a word."""
    parts = [point.title["en"]]
    if not point.generated:
        parts.append(f"Raw: {point.reason or 'the manual leaves it open'}")
    elif point.coding:
        parts.append(f"Raw: the number is coded ({point.coding})")
    elif fixed_rule(point) is None:
        by_name = {named.name: named for named in device.points}
        parts.append(f"Raw: the value is {wording.scale_text(point, by_name)}")
    parts += [_flag_text(flag, point) for flag in point.flags]
    for special in point.specials:
        if point.info.floating or special.high - special.low >= _MOST_CODES or len(point.addresses) > 1:
            parts.append(f"No quantity: {wording.special_numbers(special, point.width)} {special.name}")
    if point.references:
        parts.append("In the manual: " + ", ".join(f"{key} {number}" for key, number in point.references.items()))
    return line(". ".join(parts))


def _flag_text(flag: Flag, point: Point) -> str:
    """Return a flag with the meaning of its numbers: `bits 7..6 fault_class_3: 0 Inactive, 3 Active`."""
    head = f"{'bit' if flag.width == 1 else 'bits'} {wording.flag_bits(flag, point)} {flag.name}"
    if flag.values:
        return f"{head}: " + ", ".join(f"{value.raw} {value.title['en']}" for value in flag.values)
    return head + (", true when 0" if flag.width == 1 and flag.active == 0 else "")


def _bytes_of_mask(mask: int) -> str:
    return ", ".join(str(place) for place in range(LENGTH) if mask >> place & 1)


def _unique(name: str, taken: set[str], most: int | None = None) -> str:
    """Return a unique name of at most this length; a taken one gets a number."""
    free_name, count = name[:most], 1
    while free_name in taken:
        count += 1
        free_name = f"{name[: None if most is None else most - 1 - len(str(count))]}_{count}"
    taken.add(free_name)
    return free_name
