"""A warning for numbers that someone cut off."""

from __future__ import annotations

import re
from bisect import bisect_left
from fractions import Fraction
from functools import cache, lru_cache

from fieldscribe.language.numbers import LONGEST

_DECIMAL = re.compile(r"(?<![0-9A-Za-z_.,'])[0-9]+\.[0-9]+(?![0-9A-Za-z_]|\.[0-9])")
_FEWEST_DIGITS = 5
_NUMERATORS = range(1, 17)
_EXPONENTS_OF_TWO = range(8, 21)
_EXPONENTS_OF_TEN = range(-4, 6)


@lru_cache(maxsize=16384)
def looks_like_cut_binary_fraction(text: str) -> str | None:
    """A suggestion if a decimal in the text (a number or a formula) is almost, but not quite, n / 2^k * 10^m.

    Almost is within half a unit of the last digit typed; fewer than five digits could be anything.
    """
    if "." not in text:
        return None
    for found in _DECIMAL.finditer(text[:2000]):
        typed = found[0]
        if len(typed) <= LONGEST and len(typed.replace(".", "").lstrip("0")) >= _FEWEST_DIGITS:
            exact = _almost(typed)
            if exact is not None:
                return f"{typed} looks like {exact}, cut off: write {exact} to keep it exact"
    return None


def _almost(typed: str) -> str | None:
    """The fraction that a decimal is almost equal to, as text; None if there is none or the decimal is exact."""
    whole, _, decimals = typed.partition(".")
    number = Fraction(int(whole + decimals), 10 ** len(decimals))
    half = Fraction(1, 2 * 10 ** len(decimals))
    fractions, texts = _table()
    at = bisect_left(fractions, number - half)
    while at < len(fractions) and fractions[at] <= number + half:
        if fractions[at] == number:
            return None
        at += 1
    first = bisect_left(fractions, number - half)
    return texts[first] if first < at else None


@cache
def _table() -> tuple[list[Fraction], list[str]]:
    """All candidates in ascending order, each with its simplest writing."""
    texts: dict[Fraction, str] = {}
    for numerator in _NUMERATORS:
        for two in _EXPONENTS_OF_TWO:
            for ten in _EXPONENTS_OF_TEN:
                top, bottom = numerator * 10 ** max(ten, 0), 2**two * 10 ** max(-ten, 0)
                texts.setdefault(Fraction(top, bottom), f"{top} / {bottom}")
    ordered = sorted(texts)
    return ordered, [texts[fraction] for fraction in ordered]
