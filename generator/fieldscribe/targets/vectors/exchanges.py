"""Vectors of whole exchanges: the requests that read or write a point, the answers, and the result."""

from collections.abc import Mapping
from typing import NamedTuple

from fieldscribe.arithmetic.words import joined
from fieldscribe.model import Point
from fieldscribe.targets.vectors import samples
from fieldscribe.targets.vectors.dates import typical_date
from fieldscribe.targets.vectors.frames import Script, Wire
from fieldscribe.targets.vectors.lines import Lines, script_text
from fieldscribe.targets.vectors.oracle import Oracle, admit, as_raw, bits_of, code_of, outer_bounds
from fieldscribe.targets.vectors.samples import PointEncoding, PointEncodings, ascending
from fieldscribe.targets.vectors.texts import letters, words_of_text
from fieldscribe.targets.vectors.words import words_of


class _Typical(NamedTuple):
    """The contents of exchanges for points with one encoding: raw numbers with their words, and reads of other points.

    `needs` reads the points that these need. Whole words that need no other point can be tried with bad answers.
    """

    encoding: PointEncoding
    settings: dict[str, int]
    needs: Script
    received: list[tuple[int, ...]]
    sent: list[tuple[int, tuple[int, ...]]]


class Exchanges:
    """The exchanges of one device over one wire."""

    def __init__(
        self, lines: Lines, oracle: Oracle, encodings: PointEncodings, points: Mapping[str, Point], wire: Wire
    ) -> None:
        self.lines, self.oracle, self.encodings, self.points, self.wire = lines, oracle, encodings, points, wire
        self.spoiled: set[tuple[str, str]] = set()
        """The kinds and spaces that have vectors with bad answers already."""
        self._typical: dict[PointEncoding, _Typical | None] = {}

    def of_each_space(self) -> None:
        """Add exchanges for the first readable and the first writable point of each space."""
        for point in self.points.values():
            kinds = (("read", point.readable), ("write", point.writable))
            new = {(kind, point.space) for kind, does in kinds if does} - self.spoiled
            if new and point.bits is None and point.text is None and not (point.arguments or point.selects):
                self.lines.set("point", point.item)
                self.of(point, self.encodings.of(point))

    def of(self, point: Point, encoding: PointEncoding) -> None:
        """Add the exchanges of the point that is set: read, write, and write permanently."""
        if encoding not in self._typical:
            self._typical[encoding] = self._of_encoding(encoding)
        typical = self._typical[encoding]
        if typical is None:
            return
        if typical.settings:
            self.lines.set("with", typical.settings)
        if encoding.shape.readable:
            for sent, received in zip(typical.sent, typical.received, strict=True):
                self._add("read", point, typical, sent, self.wire.reads(point, received))
        if point.write_with:
            if encoding.shape.text is None:
                self.lines.add("alone", typical.sent[0][0], "not_together")
        elif encoding.shape.writable:
            self._writes(point, encoding, typical)

    def _writes(self, point: Point, encoding: PointEncoding, typical: _Typical) -> None:
        """Add the exchanges that write a point, also permanently."""
        for kind in ("write", "store"):
            for raw, words in typical.sent:
                put = words
                if point.write_place is not None:  # if the words may be in another order
                    put = words_of(encoding, ascending(encoding.shape, point.write_place.addresses), raw)
                script = self.wire.writes(point, put, keep=kind == "store")
                if script is not None and encoding.bits is not None:
                    script = self._read_and_write(point, encoding, raw, script)
                self._add(kind, point, typical, (raw, words), script)

    def _of_encoding(self, encoding: PointEncoding) -> _Typical | None:
        """Return the contents of exchanges; None without an address, or if a needed point cannot be read."""
        if encoding.order is None:
            return None
        settings = samples.settings(self.oracle, encoding)[0]
        needs = self._needs(settings)
        raw = None if needs is None else typical(self.oracle, encoding, settings)
        if needs is None or raw is None:
            return None
        shape, order = encoding.shape, encoding.order
        switch = shape.type == "bit" and outer_bounds(shape, encoding.allowed) == (0, 1)
        sent = [(put, words_of(encoding, order, put)) for put in ((raw, 0) if switch else (raw,))]
        received = [words_of(encoding, order, put, received=True) for put, _ in sent]
        return _Typical(encoding, settings, needs, received, sent)

    def _read_and_write(self, point: Point, encoding: PointEncoding, raw: int, script: Script) -> Script | None:
        """Return the exchange that writes a bit group after reading its word."""
        if not encoding.shape.readable:
            return None
        other = as_raw(encoding.shape, ~raw)
        before = self.wire.reads(point, words_of(encoding, (0,), other, received=True))
        return None if before is None else before + script

    def _needs(self, settings: dict[str, int]) -> Script | None:
        """Return the exchanges that read the points that another needs; None if one cannot be read this way."""
        script: Script = []
        for name, raw in settings.items():
            other = self.points.get(name)
            if other is None or not other.readable or not other.addresses or other.scale_arguments:
                return None
            encoding = self.encodings.of(other)
            read = self.wire.reads(other, words_of(encoding, encoding.order or (), raw))
            if read is None:
                return None
            script += read
        return script

    def _selecting(self, point: Point) -> Script:
        """Return the exchanges that write what other points must hold before; clients send them first."""
        script: Script = []
        for name, raw in point.selects:
            other = self.points[name]
            encoding = self.encodings.of(other)
            written = self.wire.writes(other, words_of(encoding, encoding.order or (), raw), keep=False) or []
            script += written if encoding.bits is None else self._read_and_write(other, encoding, raw, written) or []
        return script

    def _add(
        self, kind: str, point: Point, typical: _Typical, sent: tuple[int, tuple[int, ...]], script: Script | None
    ) -> None:
        """Add an exchange, and if it is the first of its kind and space, also with bad answers."""
        if script is None:
            return
        is_text, first = typical.encoding.shape.text is not None, (kind, point.space)
        raw, words = (None, sent[1]) if is_text else (sent[0], None)
        selecting = self._selecting(point) if point.selects else []
        if is_text or typical.needs:
            self.lines.add(kind, selecting + script, "ok", raw, words, typical.needs or None)
        else:  # most exchanges
            self.lines.add_written(kind, (f"{kind}\t{script_text(selecting + script)}\tok\t{raw}",))
        if is_text or typical.encoding.bits is not None or typical.needs or selecting or first in self.spoiled:
            return
        self.spoiled.add(first)
        for status, bad in self.wire.bad_answers(point, script, writes=kind != "read"):
            self.lines.add(kind, bad, status, None if kind == "read" else raw)


def typical(oracle: Oracle, encoding: PointEncoding, settings: dict[str, int]) -> int | None:
    """Return a typical raw number to write: two thirds up the range, odd if possible; None if it has no limits."""
    shape = encoding.shape
    if (text := shape.text) is not None:
        return joined(typical_date(text) if text.parts else words_of_text(text, letters(text)))
    if shape.digits is not None:
        known = sorted(entry.raw for entry in shape.digits.enum.entries if entry.raw < 10)
        digits = [known[place % len(known)] for place in range(shape.digits.count)]
        return int("".join(map(str, digits))) & 0xFFFF
    if shape.form == "float":
        return _typical_pattern(encoding)
    ratio = oracle.ratio(shape, settings) if shape.scale is not None else None
    limits = oracle.limits(shape, encoding.allowed, settings)
    if isinstance(ratio, str) or isinstance(limits, str):
        return None
    low, high = limits[0] if len(limits) == 1 else max(limits, key=lambda limit: limit[1] - limit[0])
    upper = high - (high - low) // 3
    for raw in (upper | 1, upper, *(raw for interval in limits for raw in interval)):
        put = encoding.with_fixed(raw)
        if admit(shape, put, limits) == "ok" and code_of(shape, put) is None:
            return put
    return None


def _typical_pattern(encoding: PointEncoding) -> int:
    low, high = encoding.allowed.units[0] if encoding.allowed.units else (0, 100)
    value = float(low) + (float(high) - float(low)) / 3
    return bits_of(value, encoding.shape.width)
