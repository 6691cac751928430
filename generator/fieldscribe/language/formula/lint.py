"""Finds decimals that were cut off, and the fractions that they stand for."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from fractions import Fraction
from functools import lru_cache
from itertools import product
from typing import NamedTuple

from fieldscribe.language.numbers import LONGEST

_DECIMAL = re.compile(r"(?<![0-9A-Za-z_.,'])[0-9]+\.[0-9]+(?![0-9A-Za-z_]|\.[0-9])")
_FEWEST_DIGITS = 5
_NUMERATORS = range(1, 17)
_POWERS_OF_TWO = tuple(2**two for two in range(8, 33))
_EXPONENTS_OF_TEN = range(-4, 6)
_THIRDS = (3, 6, 9, 12, 15, 18, 30, 36, 60, 90)
_REPEATING = re.compile(r"([0-9])\1\1[0-9]?\Z")
_LONGEST_TEXT = 2000


class CutOff(NamedTuple):
    """A decimal that is almost a simple fraction; `line` is the formula with that fraction."""

    typed: str
    exact: str
    line: str


@lru_cache(maxsize=16384)
def cut_off(text: str) -> CutOff | None:
    """Return the first decimal of a formula that is almost n / 2^k * 10^m, or a repeating fraction such as 2 / 3.

    "Almost" is within half a unit of the last digit; decimals with fewer than five digits are left alone.
    """
    if "." not in text:
        return None
    for decimal, exact in _cut(text[:_LONGEST_TEXT]):
        return CutOff(decimal[0], exact, exact_scale(text))
    return None


def exact_scale(text: str) -> str:
    """Return the formula with fractions in place of the decimals that were cut off."""
    for decimal, exact in reversed(list(_cut(text[:_LONGEST_TEXT]))):
        text = _replaced(text, decimal, exact)
    return text


def _cut(text: str) -> Iterator[tuple[re.Match[str], str]]:
    for decimal in _DECIMAL.finditer(text):
        typed = decimal[0]
        if len(typed) <= LONGEST and len(typed.replace(".", "").lstrip("0")) >= _FEWEST_DIGITS:
            exact = _almost(typed)
            if exact is not None:
                yield decimal, exact


def _replaced(text: str, decimal: re.Match[str], exact: str) -> str:
    """Return the text with the fraction in place of the decimal: `raw * 0.33333` becomes `raw / 3`."""
    before, behind = text[: decimal.start()].rstrip(), text[decimal.end() :]
    top, _, bottom = exact.partition(" / ")
    if before.endswith("/"):
        product = f"* {bottom}" + ("" if top == "1" else f" / {top}")
        return f"{before[:-1].rstrip()} {product}{behind}"
    if before.endswith("*") and top == "1":
        return f"{before[:-1].rstrip()} / {bottom}{behind}"
    return f"{text[: decimal.start()]}{exact}{behind}"


def _almost(typed: str) -> str | None:
    """Return the fraction that a decimal almost equals, as text; None if there is none, or if the decimal is exact."""
    number, half = Fraction(typed), Fraction(1, 2 * 10 ** len(typed.partition(".")[2]))
    powers = sorted(_near(number, half, _POWERS_OF_TWO))
    if powers and all(fraction != number for fraction, *_ in powers):
        return f"{powers[0][2]} / {powers[0][3]}"
    thirds = _near(number, half, _THIRDS) if _REPEATING.search(typed) else ()
    least = min((fraction for fraction, *_ in thirds if fraction.denominator % 3 == 0), default=None)
    return None if least is None else f"{least.numerator} / {least.denominator}"


def _near(number: Fraction, half: Fraction, divisors: Iterable[int]) -> Iterator[tuple[Fraction, int, int, int]]:
    """Yield each numerator / divisor * 10^m within `half` of a number, with its numerator and as top / bottom."""
    size = float(number)
    for divisor, ten in product(divisors, _EXPONENTS_OF_TEN):
        numerator = round(size * divisor / 10.0**ten)
        if numerator in _NUMERATORS:
            top, bottom = numerator * 10 ** max(ten, 0), divisor * 10 ** max(-ten, 0)
            if abs(Fraction(top, bottom) - number) <= half:
                yield Fraction(top, bottom), numerator, top, bottom
