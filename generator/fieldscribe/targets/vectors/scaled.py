"""Vectors of points with a scale: values in binary64, and counts of 10^-decimals units."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cache
from math import inf, nan, nextafter

from fieldscribe.model import Shape
from fieldscribe.targets.vectors import samples
from fieldscribe.targets.vectors.lines import Lines, real, text
from fieldscribe.targets.vectors.oracle import INT64, Oracle, Ratio, admit, code_of, quantity_at_most, quotient
from fieldscribe.targets.vectors.samples import PointEncoding

INT32 = 1 << 31


class Conversions:
    """Converts between raw numbers, values and counts of one shape under one ratio; remembers each number.

    It knows no limits, so points with different limits share it.
    """

    def __init__(self, shape: Shape, ratio: Ratio) -> None:
        self.shape, self.ratio, decimals = shape, ratio, shape.decimals or 0
        self.value = cache(lambda raw: quotient(ratio.numerator(raw), ratio.denominator))
        self.count = cache(lambda raw: ratio.count_of_raw(raw, decimals))
        self.raw_of_value = cache(ratio.raw_of_float)
        self.raw_of_count = cache(lambda count: ratio.raw_of_count(count, decimals))
        self.decode, self.decode_count = cache(self._decode), cache(self._decode_count)

    def outside(self, raw: int, side: int) -> float:
        """Return the value a quarter of a raw step below (side -1) or above it (side 1), which rounds to the number."""
        step = self.ratio.numerator(1) - self.ratio.numerator(0)
        return quotient(4 * self.ratio.numerator(raw) + side * step, 4 * self.ratio.denominator)

    def _decode(self, raw: int) -> str:
        """Return the line with status and value; empty if languages may differ in the last place."""
        shape, ratio = self.shape, self.ratio
        if (code := code_of(shape, raw)) is not None:
            return f"decode\t{raw}\tspecial\t-\t{text(code.name)}"
        if self._is_too_large(raw):
            return f"decode\t{raw}\toverflow"
        if ratio.divides_exactly(raw) or not (shape.scale_arguments and shape.encodes_values):
            return f"decode\t{raw}\tok\t{real(ratio.numerator(raw) / ratio.denominator)}"
        return ""

    def _decode_count(self, raw: int) -> str:
        """Return the line with status and count."""
        if (code := code_of(self.shape, raw)) is not None:
            return f"decode_count\t{raw}\tspecial\t-\t{text(code.name)}"
        count = self.count(raw)
        fits = -INT64 <= count < INT64 and not self._is_too_large(raw)
        return f"decode_count\t{raw}\tok\t{count}" if fits else f"decode_count\t{raw}\toverflow"

    def _is_too_large(self, raw: int) -> bool:
        """Return True if a raw number is too large to compute with."""
        return self.shape.most_raw is not None and abs(raw) > self.shape.most_raw


class Scaled:
    """Writes the vectors of points with a scale."""

    def __init__(self, oracle: Oracle) -> None:
        self._oracle = oracle
        self._conversions: dict[tuple[int, Ratio], Conversions] = {}

    def add(self, lines: Lines, encoding: PointEncoding, *, deep: bool) -> None:
        """Add the vectors for each setting of the points that the encoding depends on; fewer unless `deep`."""
        full, oracle, shape = deep, self._oracle, encoding.shape
        for settings in samples.settings(oracle, encoding, deep=deep):
            if settings:
                lines.set("with", settings)
            ratio = oracle.ratio(shape, settings)
            limits = oracle.limits(shape, encoding.allowed, settings)
            if isinstance(ratio, str):
                _without_rule(lines, shape, ratio)
            elif isinstance(limits, str):
                _without_limits(lines, encoding, ratio, limits)
            else:
                _Vectors(lines, encoding, self._of(shape, ratio), limits, deep, full).write()
                full = False

    def _of(self, shape: Shape, ratio: Ratio) -> Conversions:
        key = id(shape), ratio
        if key not in self._conversions:
            self._conversions[key] = Conversions(shape, ratio)
        return self._conversions[key]


def _without_rule(lines: Lines, shape: Shape, status: str) -> None:
    """Add the vectors for a setting under which nothing can be computed."""
    raw = quantity_at_most(shape, 1)
    if shape.readable:
        lines.add("decode", raw, status)
        if shape.decimals is not None:
            lines.add("decode_count", raw, status)
    if shape.writable:
        if shape.encodes_values:
            lines.add("encode", 1.0, status)
        if shape.decimals is not None:
            lines.add("encode_count", 1, status)
        if shape.encodes_values:
            lines.add("encode", nan, "not_a_number")


def _without_limits(lines: Lines, encoding: PointEncoding, ratio: Ratio, status: str) -> None:
    """Add the vectors for a setting under which values can be computed, but not the limits."""
    shape = encoding.shape
    if shape.writable:
        # inside the outer bounds of the limit, so that only the limit itself can refuse it
        raw = quantity_at_most(shape, samples.limits_of(encoding.allowed)[0].greatest)
        if shape.encodes_values:
            lines.add("encode", quotient(ratio.numerator(raw), ratio.denominator), status)
        if shape.decimals is not None:
            lines.add("encode_count", ratio.count_of_raw(raw, shape.decimals), status)
        lines.add("check", raw, status)


@dataclass(frozen=True, slots=True)
class _Vectors:
    """The vectors of an encoding under one setting that allows computing.

    They are `deep` for the first encoding that is computed in this way, and `full` for its first setting.
    """

    lines: Lines
    encoding: PointEncoding
    by: Conversions
    limits: samples.Limits
    deep: bool
    full: bool

    def write(self) -> None:
        """Add the vectors of all kinds, decoding first."""
        shape, by, limits, lines = self.encoding.shape, self.by, self.limits, self.lines
        if shape.readable:
            raws = samples.raws_to_decode(shape, limits, deep=self.deep)
            dividing = samples.raw_telling_division(by.ratio)
            more = () if dividing is None or not shape.least <= dividing <= shape.greatest else (dividing,)
            lines.add_written("decode", [*filter(None, map(by.decode, dict.fromkeys((*raws, *more))))])
            if shape.decimals is not None:
                lines.add_written("decode_count", [*map(by.decode_count, dict.fromkeys((*raws, *self._widest())))])
        if shape.writable:
            edges = samples.edges(limits if self.deep else samples.limits_to_try(limits))
            if self.deep:
                edges.update(dict.fromkeys(samples.codes(shape)))
            if shape.encodes_values:
                self._encode(edges)
            if shape.decimals is not None:
                self._encode_count(edges, shape.decimals)
            if self.full or not self.deep or self.encoding.allowed.arguments:
                raws = samples.raws_to_check(shape, limits, deep=self.deep)
                lines.add_written("check", [f"check\t{raw}\t{admit(shape, raw, limits)}" for raw in raws])

    def _widest(self) -> list[int]:
        """Return the raw numbers around the first counts of more than 64 bits."""
        by, shape = self.by, self.encoding.shape
        if all(-INT64 <= by.count(raw) < INT64 for raw in (shape.least, shape.greatest)):
            return []
        last = (by.raw_of_count(count) for count in (INT64 - 1, -INT64))
        raws = (raw + more for raw in last for more in (-1, 0, 1))
        return [raw for raw in raws if shape.least <= raw <= shape.greatest]

    def _line(self, start: str, raw: int | None) -> str:
        """Return the line of a value or a count: its status, and its raw number if it may be written."""
        status = "out_of_range" if raw is None else admit(self.encoding.shape, raw, self.limits, by_value=True)
        return f"{start}\tok\t{raw}" if status == "ok" else f"{start}\t{status}"

    def _encoded(self, values: Iterable[float]) -> list[str]:
        return [self._line(f"encode\t{real(value)}", self.by.raw_of_value(value)) for value in values]

    def _encode(self, edges: Iterable[int]) -> None:
        by = self.by
        values = dict.fromkeys(map(by.value, edges))
        values[by.outside(self.limits[0][0], -1)] = None
        values[by.outside(self.limits[-1][1], 1)] = None
        for half in samples.halves(by.ratio, self.limits) if self.deep else ():
            values.update({half: None, nextafter(half, 0.0): None})
        self.lines.add_written("encode", self._encoded(values))
        if self.full:
            self.lines.add_written("encode", self._encoded((-0.0,)))
            self.lines.add_all("encode", ((nan, "not_a_number"), (inf, "out_of_range"), (-inf, "out_of_range")))
            self.lines.add_written("encode", self._encoded((1e300,)))

    def _encode_count(self, edges: Iterable[int], decimals: int) -> None:
        by, shape = self.by, self.encoding.shape
        narrow = all(-INT32 <= by.count(raw) < INT32 for raw in (shape.least, shape.greatest))
        edge = INT32 if narrow else INT64  # the first count beyond the integers that hold all counts of the type
        counts = dict.fromkeys(map(by.count, edges))
        if self.deep:
            counts.update(dict.fromkeys(self._halves(10**decimals)))
        if self.full:
            counts.update({INT32 - 1: None, -INT32: None, edge - 1: None, -edge: None})
        fitting = [count for count in counts if -edge <= count < edge]
        lines = [self._line(f"encode_count\t{count}", by.raw_of_count(count)) for count in fitting]
        self.lines.add_written("encode_count", lines)

    def _halves(self, power: int) -> Iterator[int]:
        """Yield the counts around the halves at the outer limits; none where each count is a raw number."""
        ratio = self.by.ratio
        if ratio.denominator == power * abs(ratio.den) * ratio.under:
            return
        low, high = self.limits[0][0], self.limits[-1][1]
        for raw in (low - 1, low, high - 1, high):
            over = (ratio.numerator(raw) + ratio.numerator(raw + 1)) * power
            below, rest = divmod(over, 2 * ratio.denominator)
            yield from (below, below + 1) if rest else (below - 1, below + 1, below)
