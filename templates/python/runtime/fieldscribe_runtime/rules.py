# SPDX-License-Identifier: 0BSD
"""Exact linear rules between values and raw numbers, with rounding to nearest, halves away from zero."""

from __future__ import annotations

import math
import struct
from collections.abc import Mapping
from typing import TYPE_CHECKING

from .arguments import shown, whole
from .errors import (
    CodecError,
    MissingRawError,
    NoCaseError,
    RangeError,
    ResultOverflowError,
    WrongTypeError,
    ZeroFactorError,
)
from .records import Record

if TYPE_CHECKING:
    from collections.abc import Sequence
    from fractions import Fraction

Raws = Mapping[str, int]
"""Raw numbers of other points by name."""

NO_RAWS: Raws = {}

_WIDEST = 64
"""The most bits of a number that other points need."""

Line = tuple[int, int, int]
"""A scale as (times, less, over): value = (raw * times - less) / over, exactly, and `over` is positive."""


def round_ratio(num: int, den: int) -> int:
    """Return the integer nearest to num / den, halves away from zero."""
    size = (2 * abs(num) + abs(den)) // (2 * abs(den))
    return size if (num < 0) == (den < 0) else -size


def decimal_text(num: int, den: int, decimals: int) -> str:
    """Return `num / den` with `decimals` decimals, to nearest, halves away from zero; never `-0`."""
    count = round_ratio(num * 10**decimals, den)
    digits = f"{abs(count):0{decimals + 1}d}"
    sign, split = "-" if count < 0 else "", len(digits) - decimals
    return f"{sign}{digits[:split]}.{digits[split:]}" if decimals else f"{sign}{digits}"


def round_float(value: float) -> int:
    """Return the integer nearest to a finite float, halves away from zero."""
    whole = math.trunc(value)
    rest = value - whole  # exact: both lie within a factor of two, or whole is zero
    return whole + (rest >= 0.5) - (rest <= -0.5)


def raw_of(point: str, raws: Raws) -> int:
    """Return the raw number of another point; raises MissingRawError if it is not there."""
    try:
        raw = raws[point]
    except KeyError:
        raise MissingRawError(f"needs the raw number of {point}: pass raws={{{point!r}: ...}}") from None
    except TypeError:
        raise WrongTypeError(f"raws are raw numbers by name, as {{{point!r}: 1}}, not {shown(raws)}") from None
    if type(raw) is not int:
        try:
            raw = whole(raw)
        except CodecError:
            raise WrongTypeError(f"the raw number of {point} is an integer, not {shown(raw)}") from None
    if raw.bit_length() > _WIDEST:
        raise RangeError(f"{shown(raw)} is no raw number of {point}: it has more than {_WIDEST} bits")
    return raw


def _binary32(pattern: int) -> Fraction:
    """Return the number with this bit pattern; 0 for infinities and NaN."""
    from fractions import Fraction  # only scales by floating-point points need it

    value: float = struct.unpack("<f", struct.pack("<I", pattern & 0xFFFF_FFFF))[0]
    return Fraction(value) if math.isfinite(value) else Fraction(0)


class Factor(Record):
    """raw * slope + intercept of another point, to the power of 1 or -1.

    With `ten_to`, it is ten to that number, and the pair is the range of the point's raw numbers where this holds;
    `within` is the range where the scale is exact, for other factors. With `f32`, the raw number is a binary32 pattern,
    and its number is used (0 if it is no number). `codes` are bands (first, last) of raw numbers that are no quantity.
    """

    point: str
    slope: int = 1
    intercept: int = 0
    power: int = 1
    ten_to: tuple[int, int] | None = None
    f32: bool = False
    codes: tuple[tuple[int, int], ...] = ()
    within: tuple[int, int] | None = None

    def is_code(self, raws: Raws) -> bool:
        """Return True if the point holds a special code, which is no number to compute with."""
        return any(first <= raw_of(self.point, raws) <= last for first, last in self.codes)

    def number(self, raws: Raws) -> int | Fraction:
        """Return the factor (or exponent) before `power`, exactly."""
        raw = raw_of(self.point, raws)
        return (_binary32(raw) if self.f32 else raw) * self.slope + self.intercept

    def require_range(self, raws: Raws) -> None:
        """Raise ResultOverflowError if the raw number is outside the range of the factor."""
        limits, raw = self.ten_to or self.within, raw_of(self.point, raws)
        if limits is not None and not limits[0] <= raw <= limits[1]:
            raise ResultOverflowError(f"{self.point} is {raw}, outside {limits[0]}..{limits[1]}")


class Rule(Record):
    """raw = value * num / den * product(factors) + offset; the offset is a pair, numerator and denominator."""

    num: int = 1
    den: int = 1
    offset: tuple[int, int] = (0, 1)
    factors: tuple[Factor, ...] = ()

    def ratio(self, raws: Raws, *, zero_allowed: bool = False) -> tuple[int, int]:
        """Numerator and denominator with all factors; `zero_allowed` lets the numerator be zero.

        Raises ZeroFactorError, ResultOverflowError (an exponent beyond its range) and MissingRawError.
        """
        num, den = self.num, self.den
        if not self.factors:
            return num, den
        numbers = [(factor, factor.number(raws)) for factor in self.factors]
        for factor, _ in numbers:
            if factor.is_code(raws):
                raise ZeroFactorError(f"{factor.point} holds a special code, which is no quantity")
        for factor, number in numbers:
            if factor.ten_to is None:
                if number == 0 and not (zero_allowed and factor.power > 0):
                    raise ZeroFactorError(f"{factor.point} is {'no number or ' if factor.f32 else ''}zero")
                factor.require_range(raws)
        for factor, number in numbers:
            factor.require_range(raws)
            power, over, under = factor.power, number.numerator, number.denominator
            if factor.ten_to is not None:
                power, over = power * over, 10 ** abs(over)
            num, den = (num * over, den * under) if power >= 0 else (num * under, den * over)
        return num, den

    def encode(self, value: float, raws: Raws) -> int | None:
        """Return the raw number by steps in binary64 (times num, divided by den, plus offset); None if infinite."""
        num, den = self.ratio(raws)
        try:
            result = float(value) * num / den + self.offset[0] / self.offset[1]
        except OverflowError:
            return None
        return round_float(result) if math.isfinite(result) else None

    def line(self, raws: Raws) -> Line:
        """Return the rule solved for the value, in lowest terms; raises as `ratio` does."""
        num, den = self.ratio(raws)
        over, under = self.offset
        found = (under * den, over * den, num * under)
        shared = math.gcd(*found) if num > 0 else -math.gcd(*found)
        return found[0] // shared, found[1] // shared, found[2] // shared

    def steps(self) -> tuple[float, float, float] | None:
        """Return the multiplier, the divisor and the addend of a value; None beyond binary64."""
        try:
            return float(self.num), float(self.den), self.offset[0] / self.offset[1]
        except OverflowError:
            return None

    def decode(self, raw: int, raws: Raws) -> float:
        """Return the binary64 nearest to the exact value."""
        times, less, over = self.line(raws)
        try:
            return (raw * times - less) / over  # int / int is correctly rounded
        except OverflowError:
            raise ResultOverflowError(f"raw {raw} gives no binary64") from None

    def is_safe(self, raws: Raws, low: int, high: int) -> bool:
        """Return True if no raw number from `low` to `high` gives a value beyond binary64."""
        times, less, over = self.line(raws)
        return all(abs(raw * times - less) >> 1023 < over for raw in (low, high))

    def encode_count(self, count: int, decimals: int, raws: Raws, *, zero_allowed: bool = False) -> int:
        """Return the raw number of `count` units of 10^-decimals, in integer arithmetic."""
        num, den = self.ratio(raws, zero_allowed=zero_allowed)
        over, under = self.offset
        scale = den * 10**decimals
        return round_ratio(count * num * under + over * scale, scale * under)

    def decode_count(self, raw: int, decimals: int, raws: Raws) -> int:
        """Return the count of 10^-decimals units, in integer arithmetic; raises ResultOverflowError beyond 64 bits."""
        num, den = self.ratio(raws)
        over, under = self.offset
        count = round_ratio((raw * under - over) * den * 10**decimals, num * under)
        if not -(1 << 63) <= count < 1 << 63:
            raise ResultOverflowError(f"raw {raw} gives a count beyond 64 bits")
        return count


class Case(Record):
    """`rule` holds when the raw number of `point` equals `raw`; without a point it always holds."""

    point: str | None
    raw: int | None
    rule: Rule


def chosen(cases: tuple[Case, ...], raws: Raws) -> Rule:
    """Return the first rule whose case fits; raises NoCaseError."""
    for case in cases:
        if case.point is None or raw_of(case.point, raws) == case.raw:
            return case.rule
    points = ", ".join(dict.fromkeys(case.point for case in cases if case.point))
    raise NoCaseError(f"no scale for these raw numbers of {points}")


class Limit(Record):
    """A limit that other points set: `rule` applied to 1.

    It does not apply while a point has a number in one of its bands (first, last) of `unless`.
    """

    rule: Rule
    least: int
    greatest: int
    unless: Mapping[str, tuple[tuple[int, int], ...]]

    def raw(self, raws: Raws) -> int | None:
        """Return the limit as a raw number; None while it does not apply."""
        for point, bands in self.unless.items():
            held = raw_of(point, raws)
            if any(first <= held <= last for first, last in bands):
                return None
        return self.rule.encode_count(1, 0, raws, zero_allowed=True)


Bound = int | Limit


def low_end(bound: Bound, raws: Raws) -> int:
    """Return the lower end of an interval as a raw number."""
    if isinstance(bound, int):
        return bound
    raw = bound.raw(raws)
    return bound.least if raw is None else max(raw, bound.least)


def high_end(bound: Bound, raws: Raws) -> int:
    """Return the upper end of an interval as a raw number."""
    if isinstance(bound, int):
        return bound
    raw = bound.raw(raws)
    return bound.greatest if raw is None else min(raw, bound.greatest)


def outside(intervals: Sequence[tuple[str, str]], unit: str) -> str:
    """Return why a number is refused, with the limits as texts."""
    texts = [low if low == high else f"{low}..{high}" for low, high in intervals]
    if all(low != high for low, high in intervals):
        return f"outside {' or '.join(texts)}{unit}"
    return f"{'not' if len(texts) == 1 else 'none of'} {', '.join(texts)}{unit}"
