"""Vectors of points with a scale: values in binary64, and counts of 10^-decimals units."""

from __future__ import annotations

from math import inf, nan, nextafter
from typing import TYPE_CHECKING

from fieldscribe.records import dataclass
from fieldscribe.targets.vectors import samples
from fieldscribe.targets.vectors.numbers import quotient
from fieldscribe.targets.vectors.oracle import INT64, Oracle, Ratio, admit, code_of, quantity_at_most

if TYPE_CHECKING:
    from fieldscribe.model import Point
    from fieldscribe.targets.vectors.lines import Lines

INT32 = 1 << 31


def scaled(lines: Lines, oracle: Oracle, point: Point, *, deep: bool) -> None:
    """Add the vectors of a scaled point, for each setting of the points that it depends on; fewer unless `deep`."""
    full = deep
    for settings in samples.settings(oracle, point, deep=deep) if point.arguments else [{}]:
        lines.set("with", settings)
        ratio = oracle.ratio(point, settings)
        limits = oracle.limits(point, settings)
        if isinstance(ratio, str):
            _without_rule(lines, point, ratio)
        elif isinstance(limits, str):
            _without_limits(lines, point, ratio, limits)
        else:
            _Vectors(lines, point, ratio, limits, deep, full).write()
            full = False


def _without_rule(lines: Lines, point: Point, status: str) -> None:
    """Add the vectors for a setting under which nothing can be computed."""
    raw = quantity_at_most(point, 1)
    if point.readable:
        lines.add("decode", raw, status)
        if point.decimals is not None:
            lines.add("decode_count", raw, status)
    if point.writable:
        if point.encodes_values:
            lines.add("encode", 1.0, status)
        if point.decimals is not None:
            lines.add("encode_count", 1, status)
        if point.encodes_values:
            lines.add("encode", nan, "not_a_number")


def _without_limits(lines: Lines, point: Point, ratio: Ratio, status: str) -> None:
    """Add the vectors for a setting under which values can be computed, but not the limits."""
    if point.writable:
        # Inside the outer bounds of the limit, so that only the limit itself can refuse it.
        raw = quantity_at_most(point, samples.limits_of(point)[0].greatest)
        value = quotient(ratio.numerator(raw), ratio.denominator)
        if point.encodes_values:
            lines.add("encode", value, status)
        if point.decimals is not None:
            lines.add("encode_count", ratio.count_of_raw(raw, point.decimals), status)
        lines.add("check", raw, status)


def _is_too_large(point: Point, raw: int) -> bool:
    """Whether a raw number is too large to compute with."""
    return point.most_raw is not None and abs(raw) > point.most_raw


@dataclass(frozen=True, slots=True)
class _Vectors:
    """A point under one setting with which it can be computed.

    `deep` for the first point of a shape and `full` for its first setting; all others get fewer vectors.
    """

    lines: Lines
    point: Point
    ratio: Ratio
    limits: samples.Limits
    deep: bool
    full: bool

    def write(self) -> None:
        """Add the vectors of all kinds, decoding first."""
        if self.point.readable:
            raws = samples.raws_to_decode(self.point, self.limits, deep=self.deep)
            self._decode(raws)
            if self.point.decimals is not None:
                self._decode_count(raws, self.point.decimals)
        if self.point.writable:
            if self.point.encodes_values:
                self._encode()
            if self.point.decimals is not None:
                self._encode_count(self.point.decimals)
            if self.full or not self.deep or self.point.limit_arguments:
                self._check()

    def _decode(self, raws: list[int]) -> None:
        ratio, add, under = self.ratio, self.lines.add, self.ratio.denominator
        telling = samples.raw_telling_division(ratio)
        held = telling is not None and self.point.least <= telling <= self.point.greatest
        for raw in dict.fromkeys((*raws, telling) if held and telling is not None else raws):
            if (code := code_of(self.point, raw)) is not None:
                add("decode", raw, "special", None, code.name)
            elif _is_too_large(self.point, raw):
                add("decode", raw, "overflow")
            elif ratio.divides_exactly(raw) or not (self.point.scale_arguments and self.point.encodes_values):
                add("decode", raw, "ok", ratio.numerator(raw) / under)

    def _decode_count(self, raws: list[int], decimals: int) -> None:
        ratio, add = self.ratio, self.lines.add
        for raw in raws:
            if (code := code_of(self.point, raw)) is not None:
                add("decode_count", raw, "special", None, code.name)
                continue
            count = ratio.count_of_raw(raw, decimals)
            fits = -INT64 <= count < INT64 and not _is_too_large(self.point, raw)
            add("decode_count", raw, *(("ok", count) if fits else ("overflow",)))

    def _encoded(self, raw: int | None) -> tuple[object, ...]:
        status = "out_of_range" if raw is None else admit(self.point, raw, self.limits, by_value=True)
        return (status, raw if status == "ok" else None)

    def _edges(self) -> dict[int, None]:
        """The raw numbers whose values and counts are encoded: limits, special codes, and their neighbours."""
        if not self.deep:
            return samples.edges(samples.limits_to_try(self.limits))
        return {**samples.edges(self.limits), **dict.fromkeys(samples.codes(self.point))}

    def _encode(self) -> None:
        ratio, add = self.ratio, self.lines.add
        values = {quotient(ratio.numerator(raw), ratio.denominator): None for raw in self._edges()}
        values.update(dict.fromkeys(quotient(over, under) for over, under in samples.just_outside(ratio, self.limits)))
        for half in samples.halves(ratio, self.limits) if self.deep else ():
            values.update({half: None, nextafter(half, 0.0): None})
        for value in values:
            add("encode", value, *self._encoded(ratio.raw_of_float(value)))
        if self.full:
            add("encode", -0.0, *self._encoded(ratio.raw_of_float(-0.0)))
            add("encode", nan, "not_a_number")
            add("encode", inf, "out_of_range")
            add("encode", -inf, "out_of_range")
            add("encode", 1e300, *self._encoded(ratio.raw_of_float(1e300)))

    def _encode_count(self, decimals: int) -> None:
        ratio, add = self.ratio, self.lines.add
        for count in self._counts(decimals):
            add("encode_count", count, *self._encoded(ratio.raw_of_count(count, decimals)))

    def _counts(self, decimals: int) -> list[int]:
        """Counts to encode: of limits and their neighbours, around the halves beside them, ends of the integers."""
        point, ratio, power = self.point, self.ratio, 10**decimals
        counts = {ratio.count_of_raw(raw, decimals): None for raw in self._edges()}
        if self.deep and ratio.denominator != power * abs(ratio.den) * ratio.under:  # else each count is a raw number
            low, high = self.limits[0][0], self.limits[-1][1]
            for raw in (low - 1, low, high - 1, high):
                over = (ratio.numerator(raw) + ratio.numerator(raw + 1)) * power
                below, rest = divmod(over, 2 * ratio.denominator)
                counts.update({below if rest else below - 1: None, below + 1: None})
                if not rest:
                    counts[below] = None
        ends = [ratio.count_of_raw(raw, decimals) for raw in (point.least, point.greatest)]
        edge = INT32 if all(-INT32 <= count < INT32 for count in ends) else INT64
        if self.full:
            counts.update({INT32 - 1: None, -INT32: None, edge - 1: None, -edge: None})
        return [count for count in counts if -edge <= count < edge]

    def _check(self) -> None:
        for raw in samples.raws_to_check(self.point, self.limits, deep=self.deep):
            self.lines.add("check", raw, admit(self.point, raw, self.limits))
