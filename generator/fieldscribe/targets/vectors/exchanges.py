"""Vectors of whole exchanges: the requests that read or write a point, the answers, and the result."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from fieldscribe.targets.vectors import samples
from fieldscribe.targets.vectors.numbers import as_raw, bits32, bits64
from fieldscribe.targets.vectors.oracle import Oracle, admit
from fieldscribe.targets.vectors.whole import with_fixed

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from fieldscribe.model import Code, Device, Point
    from fieldscribe.targets.vectors.lines import Lines

Script = list[tuple[bytes, bytes]]
"""The requests of an exchange with their answers."""

OTHER_BITS = 0xA5C3
"""The bits of a shared word around those of the point."""


class Wire(Protocol):
    """A way in which a family reads and writes the words of a point."""

    def opens(self, lines: Lines) -> None:
        """Set what all exchanges share: the unit and the settings of the line."""

    def reads(self, point: Point, words: tuple[int, ...]) -> Script | None:
        """The exchange that reads these words, in ascending order of address; None if no request can."""

    def writes(self, point: Point, words: tuple[int, ...], *, keep: bool) -> Script | None:
        """The exchange that writes these words; with `keep` permanently, if another request does that."""

    def spoils(self, point: Point, script: Script, *, writes: bool) -> Iterator[tuple[str, Script]]:
        """The exchange with bad answers, each with the status that it gives."""


class Exchanges:
    """The exchanges of one device."""

    def __init__(self, lines: Lines, oracle: Oracle, device: Device, wire: Wire) -> None:
        self.lines, self.oracle, self.wire = lines, oracle, wire
        self.points = {point.item: point for point in device.points if point.generated}
        self.spoiled: set[tuple[str, str]] = set()
        """The kinds and spaces that have vectors with bad answers already."""

    def open(self) -> None:
        """Set the unit and the line for all exchanges."""
        self.wire.opens(self.lines)

    def of_each_space(self) -> None:
        """Add exchanges for the first readable and the first writable point of each space."""
        for point in self.points.values():
            kinds = (("read", point.readable), ("write", point.writable))
            new = {(kind, point.space) for kind, does in kinds if does} - self.spoiled
            if new and point.bits is None and point.text is None and not point.arguments:
                self.of(point)

    def of(self, point: Point) -> None:
        """Add the exchanges of a point: read, write, and write permanently."""
        if not point.addresses:
            return
        settings = samples.settings(self.oracle, point)[0] if point.arguments else {}
        needs = self._needs(settings)
        raw = None if needs is None else typical(self.oracle, point, settings)
        if raw is None:
            return
        self.lines.set("point", point.item)
        self.lines.set("with", settings)
        if point.readable:
            words = words_of(point, point.addresses, raw, received=True)
            self._add("read", point, raw, self.wire.reads(point, words), needs or [])
        if point.writable:
            for kind, keep in (("write", False), ("store", True)):
                for number in (raw, 0) if point.type == "bit" and point.outer == (0, 1) else (raw,):
                    self._add(kind, point, number, self._writing(point, number, keep=keep), needs or [])

    def _writing(self, point: Point, raw: int, *, keep: bool) -> Script | None:
        words = words_of(point, writing_addresses(point), raw)
        script = self.wire.writes(point, words, keep=keep)
        if script is None or point.bits is None:
            return script
        if not point.readable:
            return None
        before = self.wire.reads(point, words_of(point, point.addresses, as_raw(point, ~raw), received=True))
        return None if before is None else before + script

    def _needs(self, settings: dict[str, int]) -> Script | None:
        """The exchanges that read the points that another point needs; None if one cannot be read this way."""
        script: Script = []
        for name, raw in settings.items():
            other = self.points.get(name)
            if other is None or not other.readable or not other.addresses or other.scale_arguments:
                return None
            read = self.wire.reads(other, words_of(other, other.addresses, raw))
            if read is None:
                return None
            script += read
        return script

    def _add(self, kind: str, point: Point, raw: int, script: Script | None, needs: Script) -> None:
        if script is None:
            return
        words = None if point.text is None else words_of(point, point.addresses, raw)
        number = raw if point.text is None else None
        self.lines.add(kind, script, "ok", number, words, needs)
        if (kind, point.space) in self.spoiled or point.bits is not None or needs or point.text is not None:
            return
        self.spoiled.add((kind, point.space))
        for status, bad in self.wire.spoils(point, script, writes=kind != "read"):
            self.lines.add(kind, bad, status, None if kind == "read" else number)


def codes(lines: Lines, kind: str, what: str, numbers: Iterable[Code]) -> None:
    """Add vectors for named numbers of the protocol: a `code` that is received, or a `constant` for callers."""
    for code in numbers:
        lines.add(kind, what, code.number, code.name)


def writing_addresses(point: Point) -> tuple[int, ...]:
    """Where a point is written."""
    return point.addresses if point.write_place is None else point.write_place.addresses


def words_of(point: Point, addresses: tuple[int, ...], raw: int, *, received: bool = False) -> tuple[int, ...]:
    """The words of a raw number as they travel, in ascending order of address.

    A bit group has other bits beside it. Constant bits are as written when they are sent, and different when received.
    """
    count = len(addresses) if point.text is not None else point.words
    if point.bits is not None:
        low, ones = point.bits[1], (1 << point.width) - 1
        word = OTHER_BITS & ~(ones << low) | (raw & ones) << low
        if point.fixed is None:
            return (word,)
        constant = point.fixed.bits ^ point.fixed.mask if received else point.fixed.bits
        return (word & ~point.fixed.mask | constant,)
    pattern = raw & (1 << 16 * count) - 1
    parts = [pattern >> 16 * (count - 1 - part) & 0xFFFF for part in range(count)]
    if len(addresses) != count:
        return tuple(parts)
    return tuple(part for _, part in sorted(zip(addresses, parts, strict=True)))


def typical(oracle: Oracle, point: Point, settings: dict[str, int]) -> int | None:
    """A typical raw number to write: two thirds up the range, odd if possible."""
    if point.text is not None:
        return int.from_bytes(bytes(0x41 + place % 26 for place in range(point.text.characters)), "big")
    if point.digits is not None:
        known = sorted(entry.raw for entry in point.digits.enum.entries if entry.raw < 10)
        digits = [known[place % len(known)] for place in range(point.digits.count)]
        return int("".join(map(str, digits))) & 0xFFFF
    if point.form == "float":
        return _typical_pattern(point)
    ratio = oracle.ratio(point, settings) if point.scale is not None else None
    limits = oracle.limits(point, settings)
    if isinstance(ratio, str) or isinstance(limits, str):
        return None
    low, high = max(limits, key=lambda limit: limit[1] - limit[0])
    upper = high - (high - low) // 3
    tried = (upper | 1, upper, *(raw for interval in limits for raw in interval))
    candidates = (with_fixed(point, raw) for raw in tried)
    return next((raw for raw in candidates if admit(point, raw, limits) == "ok" and not _is_special(point, raw)), None)


def _typical_pattern(point: Point) -> int:
    low, high = point.allowed.units[0] if point.allowed.units else (0, 100)
    value = float(low) + (float(high) - float(low)) / 3
    return bits64(value) if point.width == 64 else bits32(value) or 0


def _is_special(point: Point, raw: int) -> bool:
    return any(special.low <= raw <= special.high for special in point.specials)
