"""Texts of exact numbers, and the rule from the raw numbers of a point to its values."""

from fractions import Fraction
from functools import lru_cache
from math import gcd

from fieldscribe.arithmetic.exact import SAME, Line, nearest, value_line
from fieldscribe.model import Factor, Point

_SHORT = 6
"""A factor with at most this many decimals is written as a decimal (`x 0.125`), else as a division (`/ 256`)."""


@lru_cache(maxsize=4096)
def exact(numerator: int, denominator: int = 1) -> str:
    """Return the exact number as text: a decimal if it ends (`0.1`), else a fraction (`7/3`)."""
    if denominator == 1:
        return str(numerator)
    common = gcd(numerator, denominator) * (1 if denominator > 0 else -1)
    numerator, denominator = numerator // common, denominator // common
    if denominator == 1:
        return str(numerator)
    places = decimal_places(denominator)
    if places is None:
        return f"{numerator}/{denominator}"
    return _decimal(numerator * 10**places // denominator, places)


def number_text(number: Fraction) -> str:
    """Return an exact fraction as text, as `exact` does."""
    return exact(number.numerator, number.denominator)


def rounded(numerator: int, denominator: int, decimals: int) -> str:
    """Return the number with this many decimals, rounded to nearest, halves away from zero: `50.00`; never `-0`."""
    return _decimal(nearest(numerator * 10**decimals, denominator), decimals)


def hex_text(number: int, digits: int = 4) -> str:
    """Return a number as manuals print it: `1028h`."""
    return f"{number:0{digits}X}h"


@lru_cache(maxsize=4096)
def times_text(start: str, numerator: int, denominator: int) -> str:
    """Return `start` times a fraction: `raw x 0.1`, `raw / 256`, `raw x 7 / 3`; just `start` for one."""
    if numerator == denominator:
        return start
    if numerator == 1:
        places = decimal_places(denominator)
        return f"{start} / {denominator}" if places is None or places > _SHORT else f"{start} x {exact(1, denominator)}"
    decimal = exact(numerator, denominator)
    if "/" in decimal or len(decimal.partition(".")[2]) > _SHORT:
        return f"{start} x {numerator} / {denominator}"
    return f"{start} x {decimal}"


def plus_text(start: str, numerator: int, denominator: int) -> str:
    """Return `start` plus a fraction: `raw + 2.5`, `raw - 7/3`; just `start` for zero."""
    if numerator == 0:
        return start
    return f"{start} {'-' if numerator < 0 else '+'} {exact(abs(numerator), denominator)}"


def fixed_rule(point: Point) -> Line | None:
    """Return the rule from raw numbers to values; None if it depends on other points or is unknown."""
    if point.scale is None:
        return SAME if point.generated or not point.unit.symbol else None
    return None if point.fixed_scale is None else value_line(point.fixed_scale)


def value_multiple(factor: Factor, point: Point) -> Fraction | None:
    """Return k such that `raw * slope + intercept == k * value` for the factor's point; None if there is none."""
    rule = fixed_rule(point)
    if rule is None or point.info.floating:
        return None
    multiply, add, divide = rule
    return Fraction(factor.slope * divide, multiply) if factor.intercept * multiply == factor.slope * add else None


def _decimal(count: int, places: int) -> str:
    """Return a count of 10^-places as a decimal."""
    digits = str(abs(count)).rjust(places + 1, "0")
    point = "." if places else ""
    return f"{'-' if count < 0 else ''}{digits[: len(digits) - places]}{point}{digits[len(digits) - places :]}"


def shortest(count: int, places: int) -> str:
    """Return a count of 10^-places as a decimal, without zeros at its end."""
    whole, rest = divmod(abs(count), 10**places)
    sign = "-" if count < 0 else ""
    return f"{sign}{whole}.{rest:0{places}}".rstrip("0") if rest else f"{sign}{whole}"


@lru_cache(maxsize=4096)
def decimal_places(denominator: int) -> int | None:
    """Return how many decimals a reduced fraction over `denominator` has; None if they never end."""
    twos = (denominator & -denominator).bit_length() - 1
    rest, fives = denominator >> twos, 0
    while rest % 5 == 0:
        rest, fives = rest // 5, fives + 1
    return max(twos, fives) if rest == 1 else None
