"""Vectors of whole exchanges: the requests that read or write a point, the answers, and the result."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, Protocol

from fieldscribe.targets.vectors import samples
from fieldscribe.targets.vectors.kinds import Written, line_of, script_text
from fieldscribe.targets.vectors.meaning import ascending
from fieldscribe.targets.vectors.numbers import as_raw, bits32, bits64
from fieldscribe.targets.vectors.oracle import Oracle, admit, code_of, outer_bounds
from fieldscribe.targets.vectors.whole import with_fixed
from fieldscribe.targets.vectors.words import words_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from fieldscribe.model import Code, Point, Shape
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


class _Exchange(NamedTuple):
    """One exchange of all points with one meaning; only its script differs from point to point."""

    kind: str
    raw: int
    words: tuple[int, ...]
    """The words of the number, where the point is read."""
    result: str
    """The end of the line, behind the script."""


class _Usual(NamedTuple):
    """What the exchanges of all points with one meaning carry."""

    settings: dict[str, int]
    read: _Exchange | None
    written: tuple[_Exchange, ...]
    alone: bool
    """Whether they are whole words that need no other point, so that they can be tried with bad answers."""


class Exchanges:
    """The exchanges of one device."""

    def __init__(
        self, lines: Lines, oracle: Oracle, meanings: Meanings, points: Mapping[str, Point], wire: Wire
    ) -> None:
        self.lines, self.oracle, self.meanings, self.points, self.wire = lines, oracle, meanings, points, wire
        self.spoiled: set[tuple[str, str]] = set()
        """The kinds and spaces that have vectors with bad answers already."""
        self._usual: dict[Meaning, _Usual | None] = {}

    def open(self) -> None:
        """Set the unit and the line for all exchanges."""
        self.wire.opens(self.lines)

    def of_each_space(self) -> None:
        """Add exchanges for the first readable and the first writable point of each space."""
        complete: set[tuple[str, str]] = set()
        for point in self.points.values():
            access, space = point.shape.access, point.terms.space
            if (access, space) in complete:
                continue
            kinds = (("read", point.readable), ("write", point.writable))
            new = {(kind, space) for kind, does in kinds if does} - self.spoiled
            if not new:
                complete.add((access, space))
            elif point.bits is None and point.text is None and not point.arguments:
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
        if usual.read is not None:
            script = self.wire.reads(point, usual.read.words)
            if script is not None:
                self._add(usual.read, point, usual, script)
        for exchange in usual.written:
            kind, raw, words, _ = exchange
            if point.write_place is not None:  # where the words may lie in another order
                words = words_of(meaning, ascending(meaning.shape, point.write_place.addresses), raw)
            script = self.wire.writes(point, words, keep=kind == "store")
            if script is not None and meaning.bits is not None:
                script = self._beside(point, meaning, raw, script)
            if script is not None:
                self._add(exchange, point, usual, script)

    def _of_meaning(self, meaning: Meaning) -> _Usual | None:
        """What exchanges with this meaning carry; None without an address, or if what it needs cannot be read."""
        if meaning.order is None:
            return None
        settings = samples.settings(self.oracle, meaning)[0]
        needs = self._needs(settings)
        raw = None if needs is None else typical(self.oracle, meaning, settings)
        if needs is None or raw is None:
            return None
        shape, order = meaning.shape, meaning.order
        switch = shape.type == "bit" and outer_bounds(shape, meaning.allowed) == (0, 1)
        sent = [(put, words_of(meaning, order, put)) for put in ((raw, 0) if switch else (raw,))]
        told = [(put, words, _result(shape, put, words, needs)) for put, words in sent]
        received = sent[0][1] if shape.fixed is None else words_of(meaning, order, raw, received=True)
        return _Usual(
            settings,
            _Exchange("read", raw, received, told[0][2]) if shape.readable else None,
            tuple([_Exchange(kind, *write) for kind in _WRITING for write in told]) if shape.writable else (),
            shape.text is None and meaning.bits is None and not needs,
        )

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

    def _add(self, exchange: _Exchange, point: Point, usual: _Usual, script: Script) -> None:
        kind, raw, _, result = exchange
        self.lines.add_written(kind, [f"{kind}\t{script_text(script)}{result}"])
        if not usual.alone or (kind, point.terms.space) in self.spoiled:
            return
        self.spoiled.add((kind, point.terms.space))
        for status, bad in self.wire.spoils(point, script, writes=kind != "read"):
            self.lines.add(kind, bad, status, None if kind == "read" else raw)


_WRITING = ("write", "store")


def _result(shape: Shape, raw: int, words: tuple[int, ...], needs: Script) -> str:
    """What stands behind the script: status, raw number or the words of a text, and what is read before."""
    if shape.text is None and not needs:
        return f"\tok\t{raw}"
    told = (None, words) if shape.text is not None else (raw, None)
    return line_of("read", Written(""), "ok", *told, needs).removeprefix("read\t")


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
    low, high = limits[0] if len(limits) == 1 else max(limits, key=lambda limit: limit[1] - limit[0])
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
