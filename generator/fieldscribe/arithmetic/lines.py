"""Linear rules as integers in lowest terms."""

from __future__ import annotations

from fractions import Fraction
from functools import lru_cache
from math import gcd
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from fieldscribe.model import Linear


class Line(NamedTuple):
    """result = (argument * factor + add) / divisor, in lowest terms, with the divisor above 0."""

    factor: int
    add: int
    divisor: int

    @classmethod
    def reduced(cls, factor: int, add: int, divisor: int) -> Line:
        """The same rule in lowest terms."""
        common = gcd(factor, add, divisor) * (1 if divisor > 0 else -1)
        return cls(factor // common, add // common, divisor // common)

    @property
    def inverse(self) -> Line:
        """The inverse rule; the factor must not be zero."""
        return Line.reduced(self.divisor, -self.add, self.factor)

    @property
    def does_nothing(self) -> bool:
        """Whether the result always equals the argument."""
        return self == SAME

    def result(self, argument: int | Fraction) -> Fraction:
        """The exact result."""
        return (Fraction(argument) * self.factor + self.add) / self.divisor

    def argument(self, result: int | Fraction) -> Fraction:
        """The exact argument that gives a result; the factor must not be zero."""
        return (Fraction(result) * self.divisor - self.add) / self.factor

    def meets(self, arguments: Iterable[int]) -> Iterator[int]:
        """Every integer that occurs between these arguments and the division."""
        for argument in arguments:
            yield from (argument, argument * self.factor, argument * self.factor + self.add)

    def largest(self, low: int, high: int) -> int:
        """The largest magnitude that occurs between these arguments and the division."""
        first, last = low * self.factor, high * self.factor
        met = (low, high, first, last, first + self.add, last + self.add)
        return max(*met, -min(met))


SAME = Line(1, 0, 1)
"""The rule whose result is its argument."""


@lru_cache(maxsize=4096)
def value_line(rule: Linear) -> Line:
    """The line from raw numbers to values, for a rule without factors."""
    return count_line(rule, 0).inverse


def count_line(rule: Linear, decimals: int) -> Line:
    """The line from counts of 10^-decimals units (0: from values) to raw numbers, for a rule without factors."""
    ratio, offset, power = rule.ratio, rule.offset, 10**decimals
    return Line.reduced(
        ratio.numerator * offset.denominator,
        offset.numerator * ratio.denominator * power,
        ratio.denominator * offset.denominator * power,
    )
