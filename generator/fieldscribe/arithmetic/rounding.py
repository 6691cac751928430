"""Rounding to nearest, halves away from zero: the only way in which exact numbers become raw numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from fractions import Fraction


def half_away(number: Fraction) -> int:
    """The nearest whole number, halves away from zero."""
    return nearest(number.numerator, number.denominator)


def nearest(number: int, divisor: int) -> int:
    """The quotient rounded to the nearest whole number, halves away from zero; the divisor may be negative."""
    size = (2 * abs(number) + abs(divisor)) // (2 * abs(divisor))
    return size if (number < 0) == (divisor < 0) else -size
