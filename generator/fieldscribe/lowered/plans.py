"""The integers of a scale that is known at compile time, and their widths."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

from fieldscribe.arithmetic.exact import Line, count_line, nearest, value_line
from fieldscribe.arithmetic.words import INT32, INT64
from fieldscribe.model import Linear, Shape

EXACT_FLOAT = 1 << 24
"""Every integer up to this one is a binary32 number."""


class Plan(NamedTuple):
    """The integers of a scale: `to_raw` leads from counts to raw numbers, `to_count` and `to_value` back.

    `raws` are the raw numbers of the type. `numerator` is the largest integer on the way from a raw number to its
    value. `beyond` are the raw numbers whose counts fit 64 bits, None for all. Each `_wide` says that 32 bits are not
    enough. `fits_float` says that binary32 holds every integer on the way to and from values.

    Every step is linear in its argument, so each intermediate is largest at one end of the arguments. Code divides with
    rounding, for which it adds up to half the divisor to the size of the numerator: each proof leaves room for all of
    the divisor. Decoding is asked for any raw number that the type holds.
    """

    rule: Linear
    raws: tuple[int, int]
    to_raw: Line
    to_count: Line
    to_value: Line
    count_wide: bool
    decode_wide: bool
    numerator: int
    beyond: tuple[int, int] | None
    fits_float: bool

    @property
    def direct(self) -> bool:
        """True if each raw number is its count."""
        return self.to_raw.does_nothing

    def counts(self, low: int, high: int) -> tuple[int, int]:
        """Return the counts whose raw numbers lie in low..high, as far as they can be computed.

        They fit their type, and their numerators fit 64 bits; only special codes lie beyond.
        """
        least, greatest = INT64 if self.count_wide else INT32
        most = (INT64[1] - abs(self.to_raw.add)) // abs(self.to_raw.factor)
        first, last = _counts(self.to_raw, low, high)
        return max(first, least, -most), min(last, greatest, most)

    def encode_wide(self, counts: tuple[int, int]) -> bool:
        """Return True if encoding these counts needs 64 bits; all others are refused before anything is computed."""
        return self.to_raw.largest(*counts) + self.to_raw.divisor > INT32[1]


@lru_cache(maxsize=1024)
def plan_of(shape: Shape) -> Plan:
    """Return the plan of a scale without run-time factors."""
    rule, raws = shape.fixed_scale, shape.held
    assert rule is not None
    to_raw, to_value = count_line(rule, shape.decimals or 0), value_line(rule)
    to_count = to_raw.inverse
    ends = [nearest(raw * to_count.factor + to_count.add, to_count.divisor) for raw in raws]
    numerator = to_value.largest(*raws)
    largest = max(abs(rule.ratio.numerator), rule.ratio.denominator, to_value.divisor, numerator)
    return Plan(
        rule,
        raws,
        to_raw,
        to_count,
        to_value,
        count_wide=not (INT32[0] <= min(ends) and max(ends) <= INT32[1]),
        decode_wide=to_count.largest(*raws) + to_count.divisor > INT32[1],
        numerator=numerator,
        beyond=_countable(to_raw, raws),
        fits_float=largest <= EXACT_FLOAT,
    )


def _countable(to_raw: Line, raws: tuple[int, int]) -> tuple[int, int] | None:
    """Return the raw numbers whose counts are computed in 64 bits; None if those are all of the type.

    A count is (raw * divisor - add) / factor, and rounding adds at most half the factor to the numerator: the product
    leaves room for that and for `add`. Where nothing is computed, the smallest number of 64 bits needs no room for a
    sign that is turned round.
    """
    p, q, r = to_raw
    high = (INT64[1] - abs(p) // 2 - abs(q)) // r
    low = -high
    all_are = (low <= raws[0] or to_raw.does_nothing) and raws[1] <= high
    return None if all_are else (max(low, raws[0]), min(high, raws[1]))


def _counts(to_raw: Line, low: int, high: int) -> tuple[int, int]:
    """Return the least and the greatest count whose rounded raw number lies in low..high.

    A raw number is kept if the exact quotient lies less than a half outside its limit, or just a half on the side from
    which rounding goes towards the limit: a half rounds away from zero, so it belongs to a limit above zero from below,
    and to one below zero from above. Twice the numerator is compared, which is whole.
    """
    p, q, r = to_raw
    if p < 0:
        first, last = _counts(Line(-p, q, r), low, high)
        return -last, -first
    below, above = (2 * low - 1) * r - 2 * q, (2 * high + 1) * r - 2 * q
    first = -(-below // (2 * p)) if low > 0 else below // (2 * p) + 1
    last = above // (2 * p) if high < 0 else -(-above // (2 * p)) - 1
    return first, last
