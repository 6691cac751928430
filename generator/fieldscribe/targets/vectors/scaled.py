"""Raw numbers, values and counts of one shape under one ratio: each is worked out once, however many limits there are.

So are the lines that tell them, as far as they follow from them.
Nothing here knows limits: what may be written is asked anew for every sheet.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from math import inf, nan, nextafter
from typing import TYPE_CHECKING

from fieldscribe.targets.vectors import samples
from fieldscribe.targets.vectors.lines import real, text
from fieldscribe.targets.vectors.oracle import INT64, Oracle, Ratio, admit, code_of, quantity_at_most, quotient

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from fieldscribe.model import Shape
    from fieldscribe.targets.vectors.lines import Lines
    from fieldscribe.targets.vectors.samples import PointEncoding


INT32 = 1 << 31

EncodedLine = tuple[str, int | None, str]
"""The line of a vector up to its status, the raw number (None if there is none), and the line if it may be written."""


class Conversions:
    """Between the raw numbers of a shape, their values, and their counts of 10^-decimals units."""

    def __init__(self, shape: Shape, ratio: Ratio) -> None:
        self.shape, self.ratio, self._decimals = shape, ratio, shape.decimals or 0
        telling = samples.raw_telling_division(ratio)
        self.telling = () if telling is None or not shape.least <= telling <= shape.greatest else (telling,)
        """The raw number that tells a division from a product with the reciprocal."""
        self.value, self.decoded, self.encoded = cache(self._value), cache(self._decoded), cache(self.encode_anew)
        self.count, self.counted = cache(self._count), cache(self._counted)
        self.encoded_count, self.outside = cache(self._encoded_count), cache(self._outside)

    def _value(self, raw: int) -> float:
        """The binary64 nearest to the value of a raw number."""
        return quotient(self.ratio.numerator(raw), self.ratio.denominator)

    def _outside(self, raw: int, side: int) -> float:
        """The value a quarter of a raw step below (side -1) or above it (side 1), which rounds to the number."""
        step = self.ratio.numerator(1) - self.ratio.numerator(0)
        return quotient(4 * self.ratio.numerator(raw) + side * step, 4 * self.ratio.denominator)

    def _decoded(self, raw: int) -> str:
        """The line that tells status and value; empty where languages may differ in the last place."""
        shape, ratio = self.shape, self.ratio
        if (code := code_of(shape, raw)) is not None:
            return f"decode\t{raw}\tspecial\t-\t{text(code.name)}"
        if self._is_too_large(raw):
            return f"decode\t{raw}\toverflow"
        if ratio.divides_exactly(raw) or not (shape.scale_arguments and shape.encodes_values):
            return f"decode\t{raw}\tok\t{real(ratio.numerator(raw) / ratio.denominator)}"
        return ""

    def encode_anew(self, value: float) -> EncodedLine:
        """The lines of a finite value, without a raw number if a step overflows. To a cache, 0 and -0 are the same."""
        told, raw = f"encode\t{real(value)}\t", self.ratio.raw_of_float(value)
        return told, raw, f"{told}ok\t{raw}"

    def _count(self, raw: int) -> int:
        """The count of a raw number, whether or not it fits an integer."""
        return self.ratio.count_of_raw(raw, self._decimals)

    def _counted(self, raw: int) -> str:
        """The line that tells status and count."""
        if (code := code_of(self.shape, raw)) is not None:
            return f"decode_count\t{raw}\tspecial\t-\t{text(code.name)}"
        count = self.count(raw)
        fits = -INT64 <= count < INT64 and not self._is_too_large(raw)
        return f"decode_count\t{raw}\tok\t{count}" if fits else f"decode_count\t{raw}\toverflow"

    def _encoded_count(self, count: int) -> EncodedLine:
        """The lines of a count."""
        told, raw = f"encode_count\t{count}\t", self.ratio.raw_of_count(count, self._decimals)
        return told, raw, f"{told}ok\t{raw}"

    def _is_too_large(self, raw: int) -> bool:
        """Whether a raw number is too large to compute with."""
        return self.shape.most_raw is not None and abs(raw) > self.shape.most_raw

    @property
    def edge(self) -> int:
        """The first count beyond the integers that hold all counts of the type."""
        ends = (self.count(self.shape.least), self.count(self.shape.greatest))
        return INT32 if all(-INT32 <= count < INT32 for count in ends) else INT64


class Scaled:
    """Writes the vectors of points with a scale."""

    def __init__(self, oracle: Oracle) -> None:
        self._oracle = oracle
        self._conversions: dict[tuple[int, Ratio], Conversions] = {}

    def add(self, lines: Lines, encoding: PointEncoding, *, deep: bool) -> None:
        """Add the vectors for each setting of the points that it depends on; fewer unless `deep`."""
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
        # Inside the outer bounds of the limit, so that only the limit itself can refuse it.
        raw = quantity_at_most(shape, samples.limits_of(encoding.allowed)[0].greatest)
        value = quotient(ratio.numerator(raw), ratio.denominator)
        if shape.encodes_values:
            lines.add("encode", value, status)
        if shape.decimals is not None:
            lines.add("encode_count", ratio.count_of_raw(raw, shape.decimals), status)
        lines.add("check", raw, status)


@dataclass(frozen=True, slots=True)
class _Vectors:
    """A encoding under one setting with which it can be computed.

    `deep` for the first of all that are computed alike, and `full` for its first setting; all others get fewer vectors.
    """

    lines: Lines
    encoding: PointEncoding
    by: Conversions
    limits: samples.Limits
    deep: bool
    full: bool

    def write(self) -> None:
        """Add the vectors of all kinds, decoding first."""
        shape = self.encoding.shape
        if shape.readable:
            self._decode(samples.raws_to_decode(shape, self.limits, deep=self.deep))
        if shape.writable:
            edges = self._edges()
            if shape.encodes_values:
                self._encode(edges)
            if shape.decimals is not None:
                self._encode_count(edges, shape.decimals)
            if self.full or not self.deep or self.encoding.allowed.arguments:
                self._check()

    def _decode(self, raws: list[int]) -> None:
        by, told = self.by, dict.fromkeys((*raws, *self.by.telling))
        self.lines.add_written("decode", [*filter(None, map(by.decoded, told))])
        if self.encoding.shape.decimals is not None:
            self.lines.add_written("decode_count", [*map(by.counted, raws)])

    def _encoded(self, encodings: Iterable[EncodedLine]) -> list[str]:
        """The lines of values or counts: each with its status, and its raw number if it may be written."""
        shape, limits, lines = self.encoding.shape, self.limits, []
        for told, raw, written in encodings:
            status = "out_of_range" if raw is None else admit(shape, raw, limits, by_value=True)
            lines.append(written if status == "ok" else told + status)
        return lines

    def _edges(self) -> dict[int, None]:
        """The raw numbers whose values and counts are encoded: limits, special codes, and their neighbours."""
        if not self.deep:
            return samples.edges(samples.limits_to_try(self.limits))
        return {**samples.edges(self.limits), **dict.fromkeys(samples.codes(self.encoding.shape))}

    def _encode(self, edges: dict[int, None]) -> None:
        by = self.by
        values = dict.fromkeys(map(by.value, edges))
        values[by.outside(self.limits[0][0], -1)] = None
        values[by.outside(self.limits[-1][1], 1)] = None
        for half in samples.halves(by.ratio, self.limits) if self.deep else ():
            values.update({half: None, nextafter(half, 0.0): None})
        self.lines.add_written("encode", self._encoded(map(by.encoded, values)))
        if self.full:
            zero, large = self._encoded(map(by.encode_anew, (-0.0, 1e300)))
            self.lines.add_written("encode", [zero])
            self.lines.add_all("encode", ((nan, "not_a_number"), (inf, "out_of_range"), (-inf, "out_of_range")))
            self.lines.add_written("encode", [large])

    def _encode_count(self, edges: dict[int, None], decimals: int) -> None:
        by, edge = self.by, self.by.edge
        counts = dict.fromkeys(map(by.count, edges))
        if self.deep:
            counts.update(dict.fromkeys(self._halves(10**decimals)))
        if self.full:
            counts.update({INT32 - 1: None, -INT32: None, edge - 1: None, -edge: None})
        fitting = [count for count in counts if -edge <= count < edge]
        self.lines.add_written("encode_count", self._encoded(map(by.encoded_count, fitting)))

    def _halves(self, power: int) -> Iterator[int]:
        """The counts around the halves beside the outer limits; none where each count is a raw number."""
        ratio = self.by.ratio
        if ratio.denominator == power * abs(ratio.den) * ratio.under:
            return
        low, high = self.limits[0][0], self.limits[-1][1]
        for raw in (low - 1, low, high - 1, high):
            over = (ratio.numerator(raw) + ratio.numerator(raw + 1)) * power
            below, rest = divmod(over, 2 * ratio.denominator)
            yield from (below, below + 1) if rest else (below - 1, below + 1, below)

    def _check(self) -> None:
        shape, limits = self.encoding.shape, self.limits
        raws = samples.raws_to_check(shape, limits, deep=self.deep)
        self.lines.add_written("check", [f"check\t{raw}\t{admit(shape, raw, limits)}" for raw in raws])
