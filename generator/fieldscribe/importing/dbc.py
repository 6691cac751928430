"""Drafts a description from a CAN database (DBC), as cantools reads it: messages, signals, and a count of what is lost.

A signal whose name occurs in several messages gets the name of the message in front. A unique name in the database
becomes the code.
"""

import re
from collections import Counter
from collections.abc import Iterator, Mapping
from decimal import Decimal
from fractions import Fraction
from typing import Any

from fieldscribe.importing.draft_text import DraftGroup, DraftPoint, Names, label_map, scalar, snake
from fieldscribe.importing.readers import UnreadableError
from fieldscribe.language.units import shipped_unit
from fieldscribe.model.point import message_bits
from fieldscribe.text import counted

_LONGEST, _USUAL_LENGTH, _WIDEST, _LONGEST_WHEN = 64, 8, 64, 200
_EXTENDED_BITS, _USUAL_BITS = 29, 11
_MESSAGE, _SIGNAL = re.compile(r"\s*BO_\s+([0-9]{1,10})\b"), re.compile(r"\s*SG_\s+(\w+)\b")
_CODE = re.compile(r"[A-Za-z_][A-Za-z0-9_]{0,39}")


class DbcDraft:
    """The draft of a database: its groups of points, the lines of its head, and counts of what is not carried.

    With a node, the device sends the messages of that node; without one, it sends all.
    """

    def __init__(self, database: Any, text: str, node: str | None = None) -> None:
        known = [each.name for each in database.nodes]
        if node is not None and node not in known:
            raise UnreadableError(
                f"the database has no node `{node}`", hint=f"it has {', '.join(known[:30]) or 'none'}"
            )
        self.lost: Counter[str] = Counter()
        self.groups: list[DraftGroup] = []
        self._node, self._names, self._units = node, _names(), dict[str, None]()
        signals = [signal for message in database.messages for signal in message.signals]
        self._count, self._of_name = len(signals), Counter(_name(signal.name) for signal in signals)
        self._codes = Counter(signal.name for signal in signals)
        extended = sum(message.is_extended_frame for message in database.messages)
        self._bits = _EXTENDED_BITS if 2 * extended > len(database.messages) else _USUAL_BITS
        self._of_messages, self._lines = _names(), _lines(text)
        self._messages = [text for message in database.messages for text in self._message(message)]

    def bus(self) -> list[str]:
        """Return the lines of the bus and of the messages."""
        return [f"bus: {{identifier_bits: {self._bits}, units: 0..0}}", "messages:", *self._messages]

    def head(self) -> list[str]:
        """Return further lines of the head: the certainty, and units that are not shipped."""
        units = [f"  {scalar(unit)}: {{name: {scalar(unit)}, quantity: unknown}}" for unit in self._units]
        return ["certainty: imported", *(["units:", *units] if units else [])]

    def report(self) -> Iterator[str]:
        """Yield how many signals are carried, and what is not."""
        points = sum(len(group.points) for group in self.groups)
        yield f"{points} of {counted(self._count, 'signal')} in {counted(len(self.groups), 'message')}"
        yield from (f"not carried: {what} ({number})" for what, number in self.lost.most_common() if number)

    def _message(self, message: Any) -> Iterator[str]:
        """Yield the line of a message, and draft the group of its signals."""
        if not message.signals or message.length > _LONGEST:
            what = (
                f"signals in messages of more than {_LONGEST} bytes" if message.signals else "messages without signals"
            )
            self.lost[what] += len(message.signals) or 1
            return
        name = self._of_messages.give(_name(message.name))
        sent = self._node is None or self._node in message.senders
        usual = 2 * sum(signal.byte_order == "little_endian" for signal in message.signals) > len(message.signals)
        facts = {"message": name} | ({"bytes": "low first"} if usual else {})
        group = DraftGroup(message.name, "signal", message.name, name=name, document="database", facts=facts)
        self._add(group, message, sent)
        if not group.points:
            return
        self.groups.append(group)
        bits = _EXTENDED_BITS if message.is_extended_frame else _USUAL_BITS
        keys = {
            "name": name,
            "title": f"{{en: {scalar(message.name)}}}",
            "direction": "cyclic" if sent else "request",
            "can_id": f"0{message.frame_id:X}h",
            "identifier_bits": str(bits) if bits != self._bits else "",
            "length": str(message.length) if message.length != _USUAL_LENGTH else "",
            "every": f"{message.cycle_time} ms" if message.cycle_time else "",
        }
        yield f"- {{{', '.join(f'{key}: {text}' for key, text in keys.items() if text)}}}"
        self.lost["comments of messages"] += bool(message.comment)

    def _add(self, group: DraftGroup, message: Any, sent: bool) -> None:
        names = {
            signal.name: self._names.give(
                name if self._of_name[name := _name(signal.name)] == 1 else f"{group.name}_{name}"
            )
            for signal in message.signals
        }
        by_name = {signal.name: signal for signal in message.signals}
        for signal in message.signals:
            when = _when(signal, by_name, names)
            if signal.length > _WIDEST or len(when) > _LONGEST_WHEN:
                self.lost["signals of more than 64 bits, or of many multiplexer values"] += 1
                continue
            line = self._lines.get((message.frame_id, signal.name), 1)
            point = DraftPoint(line, "signal", _title(signal.name), name=names[signal.name])
            if self._codes[signal.name] == 1 and signal.name != point.name and _CODE.fullmatch(signal.name):
                point.code = signal.name
            point.facts = {"at": str(signal.start), "access": "r" if sent else "w", "type": _type(signal)}
            low_first = signal.byte_order == "little_endian"
            if low_first != ("bytes" in group.facts):
                point.facts["bytes"] = "low first" if low_first else "high first"
            point.facts |= {"when": scalar(when)} if when else {}
            self._meaning(point, signal)
            group.points.append(point)
        drafted = {point.name: point for point in group.points}
        for signal, other in _views([each for each in message.signals if names[each.name] in drafted], by_name):
            drafted[names[signal.name]].facts["view_of"] = names[other.name]

    def _meaning(self, point: DraftPoint, signal: Any) -> None:
        """Draft scale, unit, names of numbers, limits and comment."""
        factor, offset = Fraction(_decimal(signal.scale)), Fraction(_decimal(signal.offset))
        plain = factor == 1 and not offset
        if not plain and (not factor or signal.is_float):
            self.lost["scales of floating-point numbers, or of 0"] += 1
            point.facts["scale"] = "~"
        elif not plain:
            sign, amount = ("-" if offset < 0 else "+"), _decimal(abs(signal.offset))
            rule = f"value = raw * {_decimal(signal.scale)}" if factor != 1 else "value = raw"
            point.facts["scale"] = scalar(rule + (f" {sign} {amount}" if offset else ""))
        if signal.unit and signal.unit.strip():
            unit = signal.unit.strip()[:20]
            point.facts["unit"] = scalar(unit)
            if shipped_unit(unit) is None:
                self._units[unit] = None
        choices = {int(raw): str(name) for raw, name in (signal.choices or {}).items()}
        fitting = {raw: name for raw, name in choices.items() if _fits(signal, raw)}
        self.lost["names of numbers that the signal cannot hold"] += len(choices) - len(fitting)
        if signal.is_float:
            self.lost["names of floating-point numbers"] += len(fitting)
        elif not plain and len(fitting) >= 1 << signal.length:
            self.lost["names of all numbers of a signal with a scale"] += len(fitting)
        elif fitting:
            table = label_map({str(raw): fitting[raw] for raw in sorted(fitting)}, "", "en")
            point.facts |= {"enum": table, "open": "yes"} if plain else {"special": table}
        self._limits(point, signal, factor, offset, fitting)
        comment = signal.comment if isinstance(signal.comment, str) else ""
        point.facts |= {"note": f"{{en: {scalar(comment[:400])}}}"} if comment.strip() else {}
        self.lost["first values"] += bool(signal.raw_initial)
        self.lost["receivers"] += bool(signal.receivers) and self._node is None

    def _limits(
        self, point: DraftPoint, signal: Any, factor: Fraction, offset: Fraction, names: Mapping[int, str]
    ) -> None:
        """Draft the range in raw numbers; a range without some named numbers is not carried."""
        if signal.minimum is None or signal.maximum is None or signal.is_float or not factor:
            return
        ends = [(Fraction(_decimal(end)) - offset) / factor for end in (signal.minimum, signal.maximum)]
        low, high = sorted(ends)
        whole = low.denominator == high.denominator == 1 and low < high
        if not whole or not (_fits(signal, int(low)) and _fits(signal, int(high))) or signal.is_multiplexer:
            self.lost["limits that are no raw numbers of the signal"] += signal.minimum != signal.maximum
        elif "enum" not in point.facts or all(low <= raw <= high for raw in names):
            size = 1 << signal.length
            if high - low + 1 < size:
                point.facts["range"] = f"{low}..{high}"
        else:
            self.lost["limits that leave out named numbers"] += 1


def _names() -> Names:
    """Return a giver of names that differ in more than underscores: in languages without these, others would clash."""
    return Names(lambda name: name.replace("_", ""), "n")


def _views(signals: list[Any], by_name: Mapping[str, Any]) -> Iterator[tuple[Any, Any]]:
    """Yield signals that share bits with others in a frame, each with the one that it is a view of."""
    seen: list[tuple[Any, frozenset[int]]] = []
    for signal in signals:
        low_first = signal.byte_order == "little_endian"
        bits = frozenset(message_bits(signal.start, signal.length, low_first=low_first))
        for other, taken in seen:
            if bits & taken and _may_meet(signal, other, by_name):
                yield signal, other
                break
        seen.append((signal, bits))


def _may_meet(signal: Any, other: Any, by_name: Mapping[str, Any]) -> bool:
    """Return True if a frame may have both signals."""
    mine, theirs = (dict(_selection(each, by_name)) for each in (signal, other))
    return all({*ids} & {*theirs[name]} for name, ids in mine.items() if name in theirs)


def _lines(text: str) -> dict[tuple[int, str], int]:
    """Return the line of each signal of each identifier."""
    lines: dict[tuple[int, str], int] = {}
    identifier = 0
    for number, written in enumerate(text.splitlines(), 1):
        message, signal = _MESSAGE.match(written), _SIGNAL.match(written)
        identifier = int(message[1]) & (1 << _EXTENDED_BITS) - 1 if message else identifier
        if signal:
            lines.setdefault((identifier, signal[1]), number)
    return lines


def _name(text: str) -> str:
    """Return a name of the database in snake_case: `EngSpeed_RPM` becomes eng_speed_rpm."""
    parted = re.sub(r"(?<=[a-z0-9])(?=[A-Z][a-z])", "_", text)
    words = "_".join(re.findall(r"[a-z0-9]+", parted.lower()))
    return words if words[:1].isalpha() else snake(f"signal {words}", "signal")


def _title(text: str) -> str:
    return text.replace("_", " ").strip() or text


def _decimal(number: float) -> str:
    """Return a number of the database as a decimal without an exponent."""
    text = f"{Decimal(repr(number)) if isinstance(number, float) else Decimal(number):f}"
    return text.rstrip("0").rstrip(".") if "." in text else text


def _type(signal: Any) -> str:
    return f"{'f' if signal.is_float else 's' if signal.is_signed else 'u'}{signal.length}"


def _fits(signal: Any, raw: int) -> bool:
    size = 1 << int(signal.length)
    low = -size // 2 if signal.is_signed else 0
    return low <= raw < low + size


def _selection(signal: Any, by_name: Mapping[str, Any]) -> Iterator[tuple[str, list[int]]]:
    """Yield the multiplexers that select a signal, each with its numbers, the direct one first."""
    seen: set[str] = set()
    while signal.multiplexer_signal in by_name and signal.multiplexer_ids and signal.name not in seen:
        seen.add(signal.name)
        yield signal.multiplexer_signal, sorted(signal.multiplexer_ids)
        signal = by_name[signal.multiplexer_signal]


def _when(signal: Any, by_name: Mapping[str, Any], names: Mapping[str, str]) -> str:
    """Return the condition of multiplexer numbers that selects a signal; empty if it is always present."""
    several = [(names[name], ids) for name, ids in _selection(signal, by_name)]
    return " and ".join(
        f"{name} == {ids[0]}" if len(ids) == 1 else f"{name} in ({', '.join(map(str, ids))})"
        for name, ids in reversed(several)
    )
