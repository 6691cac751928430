"""Exact numbers for the oracle: rounding, and binary64 and binary32 patterns."""

import math
import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from math import isfinite

from fieldscribe.model import Allowed, Bound, Factor, Linear, Point, Shape, Special

INFINITY = math.inf
EXACT = 1 << 53
"""Every integer up to this one is a binary64 number."""


def half_away(over: int, under: int) -> int:
    """Return over / under (under > 0) to the nearest integer, halves away from zero."""
    if over < 0:
        return -((-2 * over + under) // (2 * under))
    return (2 * over + under) // (2 * under)


def quotient(over: int, under: int) -> float:
    """Return the binary64 nearest to over / under (under not 0); infinity if that is too large."""
    try:
        return over / under  # division of integers is correctly rounded
    except OverflowError:
        return INFINITY if (over < 0) == (under < 0) else -INFINITY


def as_raw(shape: Shape, pattern: int) -> int:
    """Return the raw number in a pattern of its bits; higher bits are ignored."""
    pattern &= (1 << shape.width) - 1
    if shape.coding:
        return _as_coded(shape, pattern)
    return pattern - (1 << shape.width) if shape.info.signed and pattern >> (shape.width - 1) else pattern


def _as_coded(shape: Shape, pattern: int) -> int:
    """Return the number in a pattern that is neither plain nor in two's complement, digit by digit."""
    if shape.info.signed:
        half = 1 << (shape.width - 1)
        return pattern if pattern < half else half - pattern
    digits = [pattern >> low & 15 for low in range(0, shape.width, 4)]
    beyond = 10 ** len(digits)
    if max(digits) > 9:
        return pattern if pattern > beyond else beyond
    return sum(digit * 10**place for place, digit in enumerate(digits))


def as_pattern(shape: Shape, raw: int) -> int:
    """Return the bits of a raw number; a negative one in two's complement stays negative."""
    if not shape.coding:
        return raw
    if shape.info.signed:
        return raw if raw >= 0 else ((1 << shape.width) - 2 * raw) // 2
    digits = [raw // 10**place % 10 for place in range(shape.width // 4)]
    return sum(digit << 4 * place for place, digit in enumerate(digits)) if raw < 10 ** len(digits) else raw


def bits_of(value: float, width: int) -> int:
    """Return the pattern of the binary32 or binary64 nearest to a value, ties to even; infinity if it is too large."""
    form = ">f" if width == 32 else ">d"
    try:
        data = struct.pack(form, value)
    except OverflowError:
        data = struct.pack(form, math.copysign(INFINITY, value))
    return int.from_bytes(data, "big")


def float_of_bits(bits: int, width: int) -> float:
    """Return the number in a binary32 or binary64 pattern."""
    form, size = (">f", 4) if width == 32 else (">d", 8)
    number: float = struct.unpack(form, bits.to_bytes(size, "big"))[0]
    return math.nan if math.isnan(number) else number


Settings = Mapping[str, int]
"""Raw numbers of the points that a rule or a limit needs."""

Numbers = Mapping[str, Fraction | int]
"""Settings in which the patterns of floating-point points are replaced by their numbers; 0 for NaN and infinity."""

INT64 = 1 << 63


def in_binary64(number: int) -> int:
    """Return an integer rounded to binary64, as all languages round."""
    return number if -EXACT <= number <= EXACT else int(float(number))


@dataclass(frozen=True, slots=True)
class Ratio:
    """A rule with the numbers of its factors: raw = value * num / den + over / under, as integers; under > 0."""

    num: int
    den: int
    over: int
    under: int

    def numerator(self, raw: int) -> int:
        """Return the numerator of the exact value of `raw`; its denominator is `denominator`."""
        return (raw * self.under - self.over) * (self.den if self.num > 0 else -self.den)

    @property
    def denominator(self) -> int:
        """The positive denominator of every raw number's value."""
        return abs(self.num) * self.under

    def raw_of_float(self, value: float) -> int | None:
        """Return the raw number of a finite value, computed in rounded binary64 steps; None if a step overflows."""
        above, below = value.as_integer_ratio()
        if self.num != 1:
            value = quotient(above * in_binary64(self.num), below)
            if abs(value) == INFINITY:
                return None
            above, below = value.as_integer_ratio()
        if self.den != 1:
            above, below = quotient(above, below * in_binary64(self.den)).as_integer_ratio()
        if self.over:
            offset_over, offset_under = quotient(self.over, self.under).as_integer_ratio()
            value = quotient(above * offset_under + offset_over * below, below * offset_under)
            if abs(value) == INFINITY:
                return None
            above, below = value.as_integer_ratio()
        return half_away(above, below)

    def raw_of_count(self, count: int, decimals: int) -> int:
        """Return the raw number of a count of 10^-decimals units."""
        under = self.den * 10**decimals * self.under
        over = count * self.num * self.under + self.over * self.den * 10**decimals
        return half_away(over, under) if under > 0 else half_away(-over, -under)

    def count_of_raw(self, raw: int, decimals: int) -> int:
        """Return the count of 10^-decimals units for a raw number."""
        return half_away(self.numerator(raw) * 10**decimals, self.denominator)

    def divides_exactly(self, raw: int) -> bool:
        """Return True if the value is a single binary64 division: both integers are at most 2^53."""
        return abs(self.numerator(raw)) <= EXACT and self.denominator <= EXACT


WHOLE = Ratio(1, 1, 0, 1)
"""The rule of a number without a scale: its value is the raw number."""


def _number(factor: Factor, numbers: Numbers) -> Fraction | int:
    """The number of a factor, before its power is applied."""
    return factor.slope * numbers[factor.point] + factor.intercept


def _applied(rule: Linear, numbers: Numbers) -> Ratio:
    """The rule with the numbers of its factors; the denominator may be 0 or negative."""
    over, under = rule.ratio.numerator, rule.ratio.denominator
    for factor in rule.factors:
        number = _number(factor, numbers)
        if factor.ten_to:
            power, size, part = factor.power * int(number), 10 ** abs(int(number)), 1
        else:
            power, size, part = factor.power, number.numerator, number.denominator
        over, under = (over * size, under * part) if power >= 0 else (over * part, under * size)
    return Ratio(over, under, rule.offset.numerator, rule.offset.denominator)


@lru_cache(maxsize=4096)
def fixed_ratio(rule: Linear) -> Ratio:
    """Return the ratio of a rule that has no factors."""
    return _applied(rule, {})


class Oracle:
    """Computes the right answers for the points of a device; `points` finds the points that rules refer to."""

    def __init__(self, points: Mapping[str, Point]) -> None:
        self.points = points
        self._fixed: dict[int, Ratio | str] = {}

    def ratio(self, shape: Shape, settings: Settings) -> Ratio | str:
        """Return the rule for these settings, or why there is none: `no_case`, `zero_factor`, `overflow`."""
        if shape.scale_arguments:
            return self._ratio(shape, settings)
        if id(shape) not in self._fixed:
            self._fixed[id(shape)] = self._ratio(shape, settings)
        return self._fixed[id(shape)]

    def _ratio(self, shape: Shape, settings: Settings) -> Ratio | str:
        for case in shape.scale or ():
            if case.point is None or settings[case.point] == case.raw:
                return self._with_factors(case.rule, settings) if case.rule.factors else fixed_ratio(case.rule)
        return "no_case"

    def _with_factors(self, rule: Linear, settings: Settings) -> Ratio | str:
        numbers = self._numbers(settings)
        if any(self._is_code(factor.point, settings[factor.point]) for factor in rule.factors):
            return "zero_factor"
        for factor in [factor for factor in rule.factors if not factor.ten_to]:
            if _number(factor, numbers) == 0:
                return "zero_factor"
            if factor.within is not None and not self.is_in_range(factor, settings):
                return "overflow"
        if any(not self.is_in_range(factor, settings) for factor in rule.factors if factor.ten_to):
            return "overflow"
        return _applied(rule, numbers)

    def _is_code(self, name: str, raw: int) -> bool:
        """Return True if a point holds a special code, with which rules cannot compute."""
        source = self.points.get(name)
        return source is not None and code_of(source.shape, raw) is not None

    def _numbers(self, settings: Settings) -> Numbers:
        return {name: self._value(name, raw) for name, raw in settings.items()}

    def _value(self, name: str, raw: int) -> Fraction | int:
        source = self.points.get(name)
        if source is None or not source.shape.info.floating:
            return raw
        value = float_of_bits(raw, source.shape.width)
        return Fraction(value) if isfinite(value) else 0

    def is_in_range(self, factor: Factor, settings: Settings) -> bool:
        """Return True if the raw number of a factor lies in the range of its point."""
        source = self.points[factor.point]
        low, high = outer_bounds(source.shape, source.allowed)
        return low <= settings[factor.point] <= high

    def limits(self, shape: Shape, allowed: Allowed, settings: Settings) -> list[tuple[int, int]] | str:
        """Return the intervals for these settings, or why a limit cannot be computed: `zero_factor`, `overflow`."""
        spans: list[tuple[int, int]] = []
        for interval in allowed.intervals:
            if isinstance(interval.low, int) and isinstance(interval.high, int):
                spans.append((interval.low, interval.high))
                continue
            low = self._bound(interval.low, settings, lower=True)
            high = self._bound(interval.high, settings, lower=False)
            if isinstance(low, str):
                return low
            if isinstance(high, str):
                return high
            spans.append((low, high))
        return spans or [(shape.least, shape.greatest)]

    def _is_unusable(self, factor: Factor, numbers: Numbers) -> bool:
        """Return True if a limit cannot be computed with the factor: a zero divisor, a floating-point zero or NaN."""
        source = self.points.get(factor.point)
        matters = factor.power < 0 or (source is not None and source.shape.info.floating)
        return matters and not factor.ten_to and _number(factor, numbers) == 0

    def _bound(self, bound: Bound, settings: Settings, *, lower: bool) -> int | str:
        if isinstance(bound, int):
            return bound
        if any(low <= settings[name] <= high for name, codes in bound.unless for low, high in codes):
            return bound.least if lower else bound.greatest
        factors, numbers = bound.rule.factors, self._numbers(settings)
        if any(self._is_unusable(factor, numbers) for factor in factors):
            return "zero_factor"
        if any(factor.ten_to and not self.is_in_range(factor, settings) for factor in factors):
            return "overflow"
        number = _applied(bound.rule, numbers).raw_of_count(1, 0)
        return max(bound.least, number) if lower else min(bound.greatest, number)


def admit(shape: Shape, raw: int, limits: Sequence[tuple[int, int]], *, by_value: bool = False) -> str:
    """Return the status of writing a raw number within these limits: `ok`, `special`, `out_of_range`, `unknown_value`.

    `by_value` says that it was computed from a value, which never means a special code.
    """
    if shape.specials and (code := code_of(shape, raw)) is not None:
        return "ok" if code.writable and not by_value else "special"
    for low, high in limits:
        if low <= raw <= high:
            return "ok"
    closed = shape.enum is not None and shape.enum.closed and shape.form == "enum"
    return "unknown_value" if closed else "out_of_range"


def outer_bounds(shape: Shape, allowed: Allowed) -> tuple[int, int]:
    """Return the least and greatest raw number that may ever be written; without limits, those of the bits."""
    if len(allowed.intervals) == 1:
        low, high = allowed.intervals[0].low, allowed.intervals[0].high
        if isinstance(low, int) and isinstance(high, int):
            return low, high
    lows = [interval.low if isinstance(interval.low, int) else interval.low.least for interval in allowed.intervals]
    highs = [
        interval.high if isinstance(interval.high, int) else interval.high.greatest for interval in allowed.intervals
    ]
    return (min(lows), max(highs)) if lows else (shape.least, shape.greatest)


def code_of(shape: Shape, raw: int) -> Special | None:
    """Return the special code with that raw number, if there is one."""
    for special in shape.specials:
        if special.low <= raw <= special.high:
            return special
    return None


def quantity_at_most(shape: Shape, raw: int) -> int:
    """Return the greatest raw number up to this one that is not a special code."""
    while (code := code_of(shape, raw)) is not None:
        raw = code.low - 1
    return raw
