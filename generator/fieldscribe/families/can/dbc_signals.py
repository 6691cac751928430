"""The messages of a CAN device for a database: the bits of each signal, and the multiplexer that selects it."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from itertools import groupby, pairwise
from typing import TYPE_CHECKING

from fieldscribe.export import ExportError
from fieldscribe.families.can.dbc_points import Meaning, signals_of_point
from fieldscribe.text import line
from fieldscribe.wording.exact import hex_text

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from fieldscribe.model import Device, Message, Point, Role, Telegram


_MOST_NAME = 32
_BYTES = 8


@dataclass(frozen=True, slots=True)
class Signal:
    """A signal of a database. `switch` is (the multiplexing signal, its value); `start` is the database's start bit."""

    name: str
    start: int
    size: int
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
    switches: bool = False
    short: str = ""

    @property
    def multiplexing(self) -> str:
        """The mark of a signal that a multiplexer value selects (`m3`), of a multiplexer (`M`), or of both (`m3M`)."""
        return ("" if self.switch is None else f"m{self.switch[1]}") + ("M" if self.switches else "")


@dataclass(slots=True)
class DbcMessage:
    """All messages of one identifier."""

    name: str
    id: int
    length: int
    from_master: bool
    comment: str
    signals: list[Signal] = field(default_factory=list)
    short: str = ""


def messages_of(device: Device, unit: int) -> list[DbcMessage]:
    """The messages of a database for one unit. Raises ExportError."""
    by_identifier: dict[tuple[int, bool], list[Message]] = {}
    for message in device.messages:
        by_identifier.setdefault((message.identifier, message.adds_unit), []).append(message)
    shorts: set[str] = set()
    dbc_messages = [_message(device, unit, group) for group in by_identifier.values()]
    for dbc_message in dbc_messages:
        dbc_message.short = _unique(dbc_message.name, shorts, _MOST_NAME)
    return dbc_messages


def _message(device: Device, unit: int, group: list[Message]) -> DbcMessage:
    first = group[0]
    number = first.identifier + unit if first.adds_unit else first.identifier
    masters = all(message.direction == "request" for message in group)
    kinds = "requests" if masters else f"unit_{unit}_messages" if first.adds_unit else f"messages_{number:X}"
    name = first.name if len(group) == 1 else kinds
    titles = "; ".join(f"{message.name}: {message.title['en']}" for message in group)
    result = DbcMessage(name, number, len(first.roles), masters, line(titles))
    selector = _selector(group) if len(group) > 1 else None
    if selector is not None:
        values = tuple((message.roles[selector].number, message.name) for message in group)
        kind = Signal("message", 8 * selector + 7, 8, values=values, switches=True)
        comment = f"Byte {selector} says which message it is"
        kind = replace(kind, least=str(min(values)[0]), greatest=str(max(values)[0]), comment=comment)
        result.signals.append(kind)
    for message in group:
        switch = None if selector is None else ("message", message.roles[selector].number)
        result.signals += [
            signal if signal.switch is not None else replace(signal, switch=switch)
            for signal in _signals(device, message, unit, skip=selector)
        ]
    result.signals = _named(result.signals)
    return result


def _selector(group: list[Message]) -> int:
    """The byte that has a different constant in each message. Raises ExportError."""
    for place in range(_BYTES):
        roles = [message.roles[place] for message in group if place < len(message.roles)]
        numbers = {role.number for role in roles if role.kind == "constant"}
        if len(numbers) == len(group) == len(roles):
            return place
    names = ", ".join(message.name for message in group)
    raise ExportError(f"no byte tells the messages {names} apart")


def _signals(device: Device, message: Message, unit: int, skip: int | None) -> Iterator[Signal]:
    """The signals of one message; those of a telegram know their multiplexer already."""
    for kind, places in _fields(message.roles, skip):
        roles = [message.roles[place] for place in places]
        if kind == "constant":
            for place, role in zip(places, roles, strict=True):
                number = str(role.number)
                comment = f"Always {hex_text(role.number, 2)}"
                yield Signal(
                    f"{message.name}_byte_{place}", 8 * place + 7, 8, least=number, greatest=number, comment=comment
                )
        elif kind == "xor":
            summed = "; ".join(f"byte {place} is bytes {_mask(role.number)} combined by exclusive or"
                               for place, role in zip(places, roles, strict=True))  # fmt: skip
            size = 8 * len(places)
            start = 8 * places[0] + 7
            yield Signal(f"{message.name}_checksum", start, size, comment=summed, greatest=str((1 << size) - 1))
        elif kind in ("unit", "address", "raw"):
            units = (unit, unit) if message.adds_unit else device.bus.units
            yield _number(device, message, kind, places, units)
        elif kind == "multiplexer":
            telegram = next((candidate for candidate in device.telegrams if candidate.message == message.name), None)
            slots = -(-telegram.words // message.words) if telegram is not None and message.words else 256
            yield Signal(f"{message.name}_multiplexer", 8 * places[0] + 7, 8, greatest=str(slots - 1), switches=True,
                         comment="Which words of the telegram follow")  # fmt: skip
    for telegram in device.telegrams:
        if telegram.message == message.name:
            yield from _telegram(device, message, telegram)


def _fields(roles: Sequence[Role], skip: int | None) -> Iterator[tuple[str, list[int]]]:
    """The runs of neighbouring bytes of one kind, without the words of a telegram."""
    places = [place for place in range(len(roles)) if place != skip and roles[place].kind != "word"]
    for (kind, _), run in groupby(
        enumerate(places), lambda numbered: (roles[numbered[1]].kind, numbered[1] - numbered[0])
    ):
        yield kind, [place for _, place in run]


def _number(device: Device, message: Message, kind: str, places: list[int], units: tuple[int, int]) -> Signal:
    """The signal for the unit, the parameter's id or the parameter's word."""
    name = {"unit": "unit", "address": "parameter", "raw": "value"}[kind]
    start, size, big = span_of({message.roles[place].number: place for place in places}, message.name)
    low, high = units if kind == "unit" else (0, (1 << size) - 1)
    values = tuple(_parameter_names(device)) if kind == "address" else ()
    comment = {"unit": "The unit", "address": "The id of the parameter", "raw": "The raw word of the parameter"}[kind]
    return Signal(
        f"{message.name}_{name}", start, size, big, least=str(low), greatest=str(high), values=values, comment=comment
    )


def span_of(bytes_by_shift: dict[int, int], name: str) -> tuple[int, int, bool]:
    """(start bit, size, big endian) of bytes, each given by its distance from bit 0. Raises ExportError."""
    shifts = sorted(bytes_by_shift, reverse=True)
    places = [bytes_by_shift[shift] for shift in shifts]
    size = 8 * len(places)
    if shifts != list(range(size - 8, -8, -8)):
        raise ExportError(f"message {name}: a number has a hole between its bytes")
    if all(after == before + 1 for before, after in pairwise(places)):
        return 8 * places[0] + 7, size, True
    if all(after == before - 1 for before, after in pairwise(places)):
        return 8 * places[-1], size, False
    raise ExportError(f"message {name}: a number lies in bytes that are not neighbours")


def _parameter_names(device: Device) -> Iterator[tuple[int, str]]:
    """The names of parameters by id: all names where several share a word; with the number of the word for texts."""
    names: dict[int, dict[str, None]] = {}
    for point in device.points:
        if point.space != "parameter" or not point.generated:
            continue
        for place, address in enumerate(point.addresses, 1):
            part = f" {place}" if len(point.addresses) > 1 else ""
            names.setdefault(address, {})[point.name + part] = None
    for address in sorted(names):
        yield address, ", ".join(names[address])


def _telegram(device: Device, message: Message, telegram: Telegram) -> Iterator[Signal]:
    """The signals for the points of a telegram."""
    taken: dict[tuple[int, int], str] = {}
    multiplexed = any(role.kind == "multiplexer" for role in message.roles)
    for point in _points(device, telegram):
        for meaning in signals_of_point(device, point, message.words, joins=_joins(message)):
            slot, word = divmod(meaning.address, message.words)
            bits = {(slot, 16 * word + bit) for bit in range(16 * meaning.words)}
            if meaning.bits is not None:
                bits = {(slot, 16 * word + bit) for bit in range(meaning.bits[1], meaning.bits[0] + 1)}
            other = next((taken[bit] for bit in sorted(bits) if bit in taken), None)
            if other is not None:
                raise ExportError(f"{meaning.name} and {other} share bits; choose with --variant")
            taken.update(dict.fromkeys(bits, meaning.name))
            yield _placed(message, meaning, word, (f"{message.name}_multiplexer", slot) if multiplexed else None)
    for address in range(telegram.words):
        slot, word = divmod(address, message.words)
        if not any((slot, 16 * word + bit) in taken for bit in range(16)):
            name, comment = f"{telegram.name}_word_{address}", "No point is described here"
            meaning = Meaning(name, address, 1, None, False, "1", "0", "0", "65535", "", comment, ())
            yield _placed(message, meaning, word, (f"{message.name}_multiplexer", slot) if multiplexed else None)


def _joins(message: Message) -> bool:
    """Whether the words of a frame lie side by side with the high byte first, as in one big-endian number."""
    places = [place for place, role in enumerate(message.roles) if role.kind == "word"]
    numbers = [message.roles[place].number for place in places]
    return numbers == list(range(len(numbers))) and places[-1] - places[0] == len(places) - 1


def _points(device: Device, telegram: Telegram) -> Iterator[Point]:
    """The points of a telegram, also reserved ones; of variants that mean the same only the first."""
    seen: dict[str, Point] = {}
    for point in device.points:
        if point.telegram != telegram.name or not point.addresses:
            continue
        facts = ("addresses", "type", "bits", "unit", "scale", "enum")
        if point.name in seen and all(getattr(point, fact) == getattr(seen[point.name], fact) for fact in facts):
            continue
        seen[point.name] = point
        yield point


def _placed(message: Message, meaning: Meaning, word: int, switch: tuple[str, int] | None) -> Signal:
    """The signal at its bits in the frame."""
    bytes_of = {16 * (meaning.words - 1 - (role.number // 2 - word)) + (0 if role.number & 1 else 8): place
                for place, role in enumerate(message.roles)
                if role.kind == "word" and word <= role.number // 2 < word + meaning.words}  # fmt: skip
    if meaning.bits is None:
        start, size, big = span_of(bytes_of, message.name)
    else:
        high, low = meaning.bits
        size = high - low + 1
        if high >> 3 == low >> 3:
            start, big = 8 * bytes_of[high & 8] + (high & 7), True
        else:
            _, _, big = span_of(bytes_of, message.name)
            start = 8 * bytes_of[8] + (high & 7) if big else 8 * bytes_of[0] + low
    return Signal(
        meaning.name, start, size, big, meaning.signed, meaning.factor, meaning.offset, meaning.least, meaning.greatest,
        meaning.unit, meaning.comment, meaning.values, switch,
    )  # fmt: skip


def _mask(mask: int) -> str:
    return ", ".join(str(place) for place in range(_BYTES) if mask >> place & 1)


def _named(signals: list[Signal]) -> list[Signal]:
    """The signals, each with a unique name and a unique short name."""
    names: set[str] = set()
    shorts: set[str] = set()
    return [
        replace(signal, name=_unique(signal.name, names), short=_unique(signal.name, shorts, _MOST_NAME))
        for signal in signals
    ]


def _unique(name: str, taken: set[str], most: int | None = None) -> str:
    """A unique name, at most so long; it gets a number if another has it."""
    free_name, count = name[:most], 1
    while free_name in taken:
        count += 1
        free_name = f"{name[: None if most is None else most - 1 - len(str(count))]}_{count}"
    taken.add(free_name)
    return free_name
