"""Vectors of points with a scale: values in binary64, and counts of 10^-decimals units."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, nan, nextafter
from typing import TYPE_CHECKING

from fieldscribe.targets.vectors import samples
from fieldscribe.targets.vectors.numbers import quotient
from fieldscribe.targets.vectors.oracle import INT64, Oracle, Ratio, is_no_value

if TYPE_CHECKING:
    from fieldscribe.model import Point
    from fieldscribe.targets.vectors.lines import Lines

INT32 = 1 << 31


def scaled(lines: Lines, oracle: Oracle, point: Point) -> None:
    """All vectors of a scaled point, for each setting of what it depends on."""
    full = True
    for settings in samples.settings(oracle, point) if point.arguments else [{}]:
        lines.set("with", settings)
        ratio = oracle.ratio(point, settings)
        limits = oracle.limits(point, settings)
        if isinstance(ratio, str):
            _no_rule(lines, point, ratio)
        elif isinstance(limits, str):
            _no_limits(lines, point, ratio, limits)
        else:
            _Sheet(lines, point, ratio, limits, full).write()
            full = False


def _no_rule(lines: Lines, point: Point, status: str) -> None:
    """A setting with which nothing can be computed."""
    raw = next(raw for raw in (1, 0, point.greatest) if not is_no_value(point, raw))
    if point.readable:
        lines.add("decode", raw, status)
        lines.add("decode_count", raw, status)
    if point.writable:
        lines.add("encode", 1.0, status)
        lines.add("encode_count", 1, status)
        lines.add("encode", nan, "not_a_number")


def _no_limits(lines: Lines, point: Point, ratio: Ratio, status: str) -> None:
    """A setting with which values can be computed but not what may be written."""
    if point.writable:
        # Inside the outer bounds of the limit, so that nothing but the limit can refuse it.
        raw = samples.limits_of(point)[0].greatest
        value = quotient(ratio.numerator(raw), ratio.denominator)
        lines.add("encode", value, status)
        lines.add("encode_count", ratio.count_of_raw(raw, point.decimals), status)
        lines.add("check", raw, status)


@dataclass(frozen=True, slots=True)
class _Sheet:
    """One point with one setting under which it can be computed; `full` for the first setting, others get less."""

    lines: Lines
    point: Point
    ratio: Ratio
    limits: samples.Limits
    full: bool

    def write(self) -> None:
        """All kinds, readable parts first."""
        if self.point.readable:
            raws = samples.raws_to_decode(self.point, self.limits)
            self._decode(raws)
            self._decode_count(raws)
        if self.point.writable:
            self._encode()
            self._encode_count()
            if self.full or self.point.limit_arguments:
                self._check()

    def _decode(self, raws: list[int]) -> None:
        ratio, add, under = self.ratio, self.lines.add, self.ratio.denominator
        telling = samples.telling_raw(ratio)
        held = telling is not None and self.point.least <= telling <= self.point.greatest
        for raw in dict.fromkeys((*raws, telling) if held and telling is not None else raws):
            if is_no_value(self.point, raw):
                add("decode", raw, "no_value")
            elif ratio.divides_exactly(raw):
                add("decode", raw, "ok", ratio.numerator(raw) / under)

    def _decode_count(self, raws: list[int]) -> None:
        ratio, add, decimals = self.ratio, self.lines.add, self.point.decimals
        for raw in raws:
            if is_no_value(self.point, raw):
                add("decode_count", raw, "no_value")
                continue
            count = ratio.count_of_raw(raw, decimals)
            add("decode_count", raw, *(("ok", count) if -INT64 <= count < INT64 else ("overflow",)))

    def _inside(self, raw: int | None) -> bool:
        return raw is not None and any(low <= raw <= high for low, high in self.limits)

    def _encoded(self, raw: int | None) -> tuple[object, ...]:
        return ("ok", raw) if self._inside(raw) else ("out_of_range",)

    def _encode(self) -> None:
        ratio, add = self.ratio, self.lines.add
        values = {quotient(ratio.numerator(raw), ratio.denominator): None for raw in samples.edges(self.limits)}
        values.update(dict.fromkeys(quotient(over, under) for over, under in samples.just_outside(ratio, self.limits)))
        for half in samples.halves(ratio, self.limits):
            values.update({half: None, nextafter(half, 0.0): None})
        for value in values:
            add("encode", value, *self._encoded(ratio.raw_of_float(value)))
        if self.full:
            add("encode", -0.0, *self._encoded(ratio.raw_of_float(-0.0)))
            add("encode", nan, "not_a_number")
            add("encode", inf, "out_of_range")
            add("encode", -inf, "out_of_range")
            add("encode", 1e300, *self._encoded(ratio.raw_of_float(1e300)))

    def _encode_count(self) -> None:
        ratio, add, decimals = self.ratio, self.lines.add, self.point.decimals
        for count in self._counts():
            add("encode_count", count, *self._encoded(ratio.raw_of_count(count, decimals)))

    def _counts(self) -> list[int]:
        """Counts of the limits and beyond, around the halves on both sides of each limit, and ends of the integers."""
        point, ratio, power = self.point, self.ratio, 10**self.point.decimals
        found = {ratio.count_of_raw(raw, point.decimals): None for raw in samples.edges(self.limits)}
        if ratio.denominator != power * abs(ratio.den) * ratio.under:  # else a count is a raw number
            low, high = self.limits[0][0], self.limits[-1][1]
            for raw in (low - 1, low, high - 1, high):
                over = (ratio.numerator(raw) + ratio.numerator(raw + 1)) * power
                below, rest = divmod(over, 2 * ratio.denominator)
                found.update({below if rest else below - 1: None, below + 1: None})
                if not rest:
                    found[below] = None
        ends = [ratio.count_of_raw(raw, point.decimals) for raw in (point.least, point.greatest)]
        edge = INT32 if all(-INT32 <= count < INT32 for count in ends) else INT64
        if self.full:
            found.update({INT32 - 1: None, -INT32: None, edge - 1: None, -edge: None})
        return [count for count in found if -edge <= count < edge]

    def _check(self) -> None:
        for raw in samples.raws_to_check(self.point, self.limits):
            self.lines.add("check", raw, "ok" if self._inside(raw) else "out_of_range")
