"""Exact linear rules as integers, and the rounding of exact numbers to raw numbers and to floating point."""

from __future__ import annotations

import struct
from collections.abc import Iterable, Iterator
from fractions import Fraction
from functools import lru_cache
from math import gcd
from typing import NamedTuple

from fieldscribe.model import Linear

_FORMATS = {32: (">f", ">I"), 64: (">d", ">Q")}


def half_away(number: Fraction) -> int:
    """Return the nearest whole number, halves away from zero."""
    return nearest(number.numerator, number.denominator)


def nearest(number: int, divisor: int) -> int:
    """Return the quotient rounded to the nearest whole number, halves away from zero; the divisor may be negative."""
    size = (2 * abs(number) + abs(divisor)) // (2 * abs(divisor))
    return size if (number < 0) == (divisor < 0) else -size


def float_of(pattern: int, bits: int) -> float:
    """Return the floating-point number of a pattern of 32 or 64 bits."""
    number, whole = _FORMATS[bits]
    result: float = struct.unpack(number, struct.pack(whole, pattern))[0]
    return result


def pattern_of(value: float | Fraction, bits: int) -> int:
    """Return the bit pattern of the nearest number, ties to even. Raises OverflowError if that is infinite."""
    number, whole = _FORMATS[bits]
    result: int = struct.unpack(whole, struct.pack(number, float(value)))[0]
    return result


class Line(NamedTuple):
    """result = (argument * factor + add) / divisor, in lowest terms, with a divisor above 0."""

    factor: int
    add: int
    divisor: int

    @classmethod
    def reduced(cls, factor: int, add: int, divisor: int) -> Line:
        """Return the same rule in lowest terms."""
        common = gcd(factor, add, divisor) * (1 if divisor > 0 else -1)
        return cls(factor // common, add // common, divisor // common)

    @property
    def inverse(self) -> Line:
        """Return the inverse rule; the factor must not be zero."""
        return Line.reduced(self.divisor, -self.add, self.factor)

    @property
    def does_nothing(self) -> bool:
        """Return True if the result always equals the argument."""
        return self == SAME

    def result(self, argument: int | Fraction) -> Fraction:
        """Return the exact result."""
        return (Fraction(argument) * self.factor + self.add) / self.divisor

    def argument(self, result: int | Fraction) -> Fraction:
        """Return the exact argument that gives a result; the factor must not be zero."""
        return (Fraction(result) * self.divisor - self.add) / self.factor

    def meets(self, arguments: Iterable[int]) -> Iterator[int]:
        """Yield every intermediate integer of these arguments, before the division."""
        for argument in arguments:
            yield from (argument, argument * self.factor, argument * self.factor + self.add)

    def largest(self, low: int, high: int) -> int:
        """Return the largest magnitude of the intermediate integers of these arguments, before the division."""
        first, last = low * self.factor, high * self.factor
        met = (low, high, first, last, first + self.add, last + self.add)
        return max(*met, -min(met))


SAME = Line(1, 0, 1)
"""The rule whose result is its argument."""


@lru_cache(maxsize=4096)
def value_line(rule: Linear) -> Line:
    """Return the line from raw numbers to values, for a rule without factors."""
    return count_line(rule, 0).inverse


def count_line(rule: Linear, decimals: int) -> Line:
    """Return the line from counts of 10^-decimals units (0: from values) to raw numbers, for a rule without factors."""
    ratio, offset, power = rule.ratio, rule.offset, 10**decimals
    return Line.reduced(
        ratio.numerator * offset.denominator,
        offset.numerator * ratio.denominator * power,
        ratio.denominator * offset.denominator * power,
    )
