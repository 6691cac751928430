"""Vectors of whole exchanges: the requests that read or write a point, the answers, and the result."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from fieldscribe.records import dataclass
from fieldscribe.targets.vectors import samples
from fieldscribe.targets.vectors.meaning import ascending
from fieldscribe.targets.vectors.numbers import as_raw, bits32, bits64
from fieldscribe.targets.vectors.oracle import Oracle, admit, code_of, outer_bounds
from fieldscribe.targets.vectors.whole import with_fixed
from fieldscribe.targets.vectors.words import words_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from fieldscribe.model import Code, Device, Point
    from fieldscribe.targets.vectors.lines import Lines
    from fieldscribe.targets.vectors.meaning import Meaning, Meanings

Script = list[tuple[bytes, bytes]]
"""The requests of an exchange with their answers."""


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


@dataclass(frozen=True, slots=True)
class _Usual:
    """What the exchanges of all points with one meaning carry."""

    meaning: Meaning
    settings: dict[str, int]
    needs: Script
    """The exchanges that read the settings."""
    raws: tuple[int, ...]
    """The raw numbers that are written; the first one is read."""
    received: tuple[int, ...]
    """The words of the number that is read."""
    sent: tuple[tuple[int, ...], ...]
    """The words of each number, written where the point is read."""

    def words_at(self, point: Point) -> tuple[tuple[int, ...], ...]:
        """The words that are written, which may lie in another order than those that are read."""
        if point.write_place is None:
            return self.sent
        order = ascending(self.meaning.shape, point.write_place.addresses)
        return tuple(words_of(self.meaning, order, raw) for raw in self.raws)


class Exchanges:
    """The exchanges of one device."""

    def __init__(self, lines: Lines, oracle: Oracle, meanings: Meanings, device: Device, wire: Wire) -> None:
        self.lines, self.oracle, self.meanings, self.wire = lines, oracle, meanings, wire
        self.points = {point.item: point for point in device.points if point.generated}
        self.spoiled: set[tuple[str, str]] = set()
        """The kinds and spaces that have vectors with bad answers already."""
        self._usual: dict[Meaning, _Usual | None] = {}

    def open(self) -> None:
        """Set the unit and the line for all exchanges."""
        self.wire.opens(self.lines)

    def of_each_space(self) -> None:
        """Add exchanges for the first readable and the first writable point of each space."""
        for point in self.points.values():
            kinds = (("read", point.readable), ("write", point.writable))
            new = {(kind, point.space) for kind, does in kinds if does} - self.spoiled
            if new and point.bits is None and point.text is None and not point.arguments:
                self.lines.set("point", point.item)
                self.of(point, self.meanings.of(point))

    def of(self, point: Point, meaning: Meaning) -> None:
        """Add the exchanges of the point that is set: read, write, and write permanently."""
        if meaning not in self._usual:
            self._usual[meaning] = self._of_meaning(meaning)
        usual = self._usual[meaning]
        if usual is None:
            return
        if usual.settings:
            self.lines.set("with", usual.settings)
        if meaning.shape.readable:
            self._add("read", point, usual, usual.raws[0], self.wire.reads(point, usual.received))
        if meaning.shape.writable:
            for kind, keep in _WRITING:
                for raw, words in zip(usual.raws, usual.words_at(point), strict=True):
                    script = self.wire.writes(point, words, keep=keep)
                    if script is not None and meaning.bits is not None:
                        script = self._beside(point, meaning, raw, script)
                    self._add(kind, point, usual, raw, script)

    def _of_meaning(self, meaning: Meaning) -> _Usual | None:
        """What exchanges with this meaning carry; None without an address, or if what it needs cannot be read."""
        if meaning.order is None:
            return None
        settings = samples.settings(self.oracle, meaning)[0]
        needs = self._needs(settings)
        raw = None if needs is None else typical(self.oracle, meaning, settings)
        if needs is None or raw is None:
            return None
        switch = meaning.shape.type == "bit" and outer_bounds(meaning.shape, meaning.allowed) == (0, 1)
        raws = (raw, 0) if switch else (raw,)
        sent = tuple(words_of(meaning, meaning.order, raw) for raw in raws)
        return _Usual(meaning, settings, needs, raws, words_of(meaning, meaning.order, raw, received=True), sent)

    def _beside(self, point: Point, meaning: Meaning, raw: int, script: Script) -> Script | None:
        """The exchange that writes a bit group: its word is read before."""
        if not meaning.shape.readable:
            return None
        other = as_raw(meaning.shape, ~raw)
        before = self.wire.reads(point, words_of(meaning, (0,), other, received=True))
        return None if before is None else before + script

    def _needs(self, settings: dict[str, int]) -> Script | None:
        """The exchanges that read the points that another point needs; None if one cannot be read this way."""
        script: Script = []
        for name, raw in settings.items():
            other = self.points.get(name)
            if other is None or not other.readable or not other.addresses or other.scale_arguments:
                return None
            meaning = self.meanings.of(other)
            read = self.wire.reads(other, words_of(meaning, meaning.order or (), raw))
            if read is None:
                return None
            script += read
        return script

    def _add(self, kind: str, point: Point, usual: _Usual, raw: int, script: Script | None) -> None:
        if script is None:
            return
        meaning, needs = usual.meaning, usual.needs
        if meaning.shape.text is not None:
            self.lines.add(kind, script, "ok", None, words_of(meaning, meaning.order or (), raw), needs)
            return
        self.lines.add(kind, script, "ok", raw, *((None, needs) if needs else ()))
        if (kind, point.space) in self.spoiled or meaning.bits is not None or needs:
            return
        self.spoiled.add((kind, point.space))
        for status, bad in self.wire.spoils(point, script, writes=kind != "read"):
            self.lines.add(kind, bad, status, None if kind == "read" else raw)


_WRITING = (("write", False), ("store", True))


def codes(lines: Lines, kind: str, what: str, numbers: Iterable[Code]) -> None:
    """Add vectors for named numbers of the protocol: a `code` that is received, or a `constant` for callers."""
    for code in numbers:
        lines.add(kind, what, code.number, code.name)


def writing_addresses(point: Point) -> tuple[int, ...]:
    """Where a point is written."""
    return point.addresses if point.write_place is None else point.write_place.addresses


def typical(oracle: Oracle, meaning: Meaning, settings: dict[str, int]) -> int | None:
    """A typical raw number to write: two thirds up the range, odd if possible."""
    shape = meaning.shape
    if shape.text is not None:
        return int.from_bytes(bytes(0x41 + place % 26 for place in range(shape.text.characters)), "big")
    if shape.digits is not None:
        known = sorted(entry.raw for entry in shape.digits.enum.entries if entry.raw < 10)
        digits = [known[place % len(known)] for place in range(shape.digits.count)]
        return int("".join(map(str, digits))) & 0xFFFF
    if shape.form == "float":
        return _typical_pattern(meaning)
    ratio = oracle.ratio(shape, settings) if shape.scale is not None else None
    limits = oracle.limits(shape, meaning.allowed, settings)
    if isinstance(ratio, str) or isinstance(limits, str):
        return None
    low, high = max(limits, key=lambda limit: limit[1] - limit[0])
    upper = high - (high - low) // 3
    for raw in (upper | 1, upper, *(raw for interval in limits for raw in interval)):
        put = with_fixed(meaning, raw)
        if admit(shape, put, limits) == "ok" and code_of(shape, put) is None:
            return put
    return None


def _typical_pattern(meaning: Meaning) -> int:
    low, high = meaning.allowed.units[0] if meaning.allowed.units else (0, 100)
    value = float(low) + (float(high) - float(low)) / 3
    return bits64(value) if meaning.shape.width == 64 else bits32(value) or 0
