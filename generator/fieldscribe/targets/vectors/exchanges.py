"""Vectors of whole exchanges: the requests that read or write a point, the answers, and the result."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from fieldscribe.targets.vectors import samples
from fieldscribe.targets.vectors.computations import ascending
from fieldscribe.targets.vectors.integers import with_fixed, words_of
from fieldscribe.targets.vectors.kinds import Written, line_of, script_text
from fieldscribe.targets.vectors.numbers import as_raw, bits32, bits64
from fieldscribe.targets.vectors.oracle import Oracle, admit, code_of, outer_bounds

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fieldscribe.model import Point, Shape
    from fieldscribe.targets.vectors.computations import Computation, Computations
    from fieldscribe.targets.vectors.family_vectors import Script, Wire
    from fieldscribe.targets.vectors.lines import Lines


class _Exchange(NamedTuple):
    """One exchange, shared by all points with one computation; only the script differs."""

    kind: str
    raw: int
    words: tuple[int, ...]
    """The words of the number, where the point is read."""
    result: str
    """The rest of the line after the script."""


class _Usual(NamedTuple):
    """The exchanges that all points with one computation share."""

    settings: dict[str, int]
    read: _Exchange | None
    written: tuple[_Exchange, ...]
    alone: bool
    """True for whole words that need no other point: these are also tried with bad answers."""


class Exchanges:
    """The exchanges of one device."""

    def __init__(
        self, lines: Lines, oracle: Oracle, computations: Computations, points: Mapping[str, Point], wire: Wire
    ) -> None:
        self.lines, self.oracle, self.computations, self.points, self.wire = lines, oracle, computations, points, wire
        self.spoiled: set[tuple[str, str]] = set()
        """The kinds and spaces that already have vectors with bad answers."""
        self._usual: dict[Computation, _Usual | None] = {}

    def open(self) -> None:
        """Set the unit and the line of all exchanges."""
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
                self.of(point, self.computations.of(point))

    def of(self, point: Point, computation: Computation) -> None:
        """Add the exchanges of the point that is set: read, write, and write permanently."""
        if computation not in self._usual:
            self._usual[computation] = self._of_meaning(computation)
        usual = self._usual[computation]
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
                words = words_of(computation, ascending(computation.shape, point.write_place.addresses), raw)
            script = self.wire.writes(point, words, keep=kind == "store")
            if script is not None and computation.bits is not None:
                script = self._beside(point, computation, raw, script)
            if script is not None:
                self._add(exchange, point, usual, script)

    def _of_meaning(self, computation: Computation) -> _Usual | None:
        """Return the shared exchanges; None without an address, or if a point that it needs cannot be read."""
        if computation.order is None:
            return None
        settings = samples.settings(self.oracle, computation)[0]
        needs = self._needs(settings)
        raw = None if needs is None else typical(self.oracle, computation, settings)
        if needs is None or raw is None:
            return None
        shape, order = computation.shape, computation.order
        switch = shape.type == "bit" and outer_bounds(shape, computation.allowed) == (0, 1)
        sent = [(put, words_of(computation, order, put)) for put in ((raw, 0) if switch else (raw,))]
        told = [(put, words, _result(shape, put, words, needs)) for put, words in sent]
        received = sent[0][1] if shape.fixed is None else words_of(computation, order, raw, received=True)
        return _Usual(
            settings,
            _Exchange("read", raw, received, told[0][2]) if shape.readable else None,
            tuple([_Exchange(kind, *write) for kind in _WRITING for write in told]) if shape.writable else (),
            shape.text is None and computation.bits is None and not needs,
        )

    def _beside(self, point: Point, computation: Computation, raw: int, script: Script) -> Script | None:
        """Return the exchange that writes a bit group: it reads the word first."""
        if not computation.shape.readable:
            return None
        other = as_raw(computation.shape, ~raw)
        before = self.wire.reads(point, words_of(computation, (0,), other, received=True))
        return None if before is None else before + script

    def _needs(self, settings: dict[str, int]) -> Script | None:
        """Return the exchanges that read the points in `settings`; None if one of them cannot be read this way."""
        script: Script = []
        for name, raw in settings.items():
            other = self.points.get(name)
            if other is None or not other.readable or not other.addresses or other.scale_arguments:
                return None
            computation = self.computations.of(other)
            read = self.wire.reads(other, words_of(computation, computation.order or (), raw))
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
    """Return the fields after the script: status, raw number or words of a text, and the reads before it."""
    if shape.text is None and not needs:
        return f"\tok\t{raw}"
    told = (None, words) if shape.text is not None else (raw, None)
    return line_of("read", Written(""), "ok", *told, needs).removeprefix("read\t")


def typical(oracle: Oracle, computation: Computation, settings: dict[str, int]) -> int | None:
    """A typical raw number to write: two thirds up the range, odd if possible."""
    shape = computation.shape
    if shape.text is not None:
        return int.from_bytes(bytes(0x41 + place % 26 for place in range(shape.text.characters)), "big")
    if shape.digits is not None:
        known = sorted(entry.raw for entry in shape.digits.enum.entries if entry.raw < 10)
        digits = [known[place % len(known)] for place in range(shape.digits.count)]
        return int("".join(map(str, digits))) & 0xFFFF
    if shape.form == "float":
        return _typical_pattern(computation)
    ratio = oracle.ratio(shape, settings) if shape.scale is not None else None
    limits = oracle.limits(shape, computation.allowed, settings)
    if isinstance(ratio, str) or isinstance(limits, str):
        return None
    low, high = limits[0] if len(limits) == 1 else max(limits, key=lambda limit: limit[1] - limit[0])
    upper = high - (high - low) // 3
    for raw in (upper | 1, upper, *(raw for interval in limits for raw in interval)):
        put = with_fixed(computation, raw)
        if admit(shape, put, limits) == "ok" and code_of(shape, put) is None:
            return put
    return None


def _typical_pattern(computation: Computation) -> int:
    low, high = computation.allowed.units[0] if computation.allowed.units else (0, 100)
    value = float(low) + (float(high) - float(low)) / 3
    return bits64(value) if computation.shape.width == 64 else bits32(value) or 0
