"""The integers of a scale that is known at compile time, and how wide they are."""

from __future__ import annotations

from math import gcd
from typing import TYPE_CHECKING, NamedTuple

from fieldscribe.targets.c.literals import EXACT_FLOAT, INT32, INT64, raw_bounds

if TYPE_CHECKING:
    from fieldscribe.model import Linear, Point


class Plan(NamedTuple):
    """The integers of a scale: raw = (count * p + q) / r and value = (raw * a - b) / c, with r and c above 0.

    `counts` are the counts whose raw numbers lie in the outer limits, `numerator` is the largest that decoding to a
    value meets, `beyond` the raw numbers whose counts fit; each `_wide` says that 32 bits do not suffice.
    """

    p: int
    q: int
    r: int
    a: int
    b: int
    c: int
    raws: tuple[int, int]
    count_wide: bool
    encode_wide: bool
    decode_wide: bool
    numerator: int
    counts: tuple[int, int]
    beyond: tuple[int, int] | None


def plan_of(point: Point, low: int, high: int) -> Plan:
    """The plan of a scale without run-time factors; `low` and `high` are the outer raw limits."""
    assert point.scale is not None
    return _plan(point.scale[0].rule, point.decimals or 0, raw_bounds(point), low, high)


def _plan(rule: Linear, decimals: int, raws: tuple[int, int], low: int, high: int) -> Plan:
    ratio, offset = rule.ratio, rule.offset
    p = ratio.numerator * offset.denominator
    r = ratio.denominator * offset.denominator * 10**decimals
    p, q, r = _reduced(p, offset.numerator * ratio.denominator * 10**decimals, r)
    a, b, c = _reduced(
        offset.denominator * ratio.denominator,
        offset.numerator * ratio.denominator,
        offset.denominator * ratio.numerator,
    )
    ends = [_divided(raw * r - q, p) for raw in raws]
    count_wide = not (INT32[0] <= min(ends) and max(ends) <= INT32[1])
    limits = INT64 if count_wide else INT32
    first, last = _counts(p, q, r, low, high)
    most = (INT64[1] - abs(q)) // abs(p)  # beyond that are special codes alone
    counts = max(first, limits[0], -most), min(last, limits[1], most)
    encoded = [abs(value) for count in counts for value in (count, count * p, count * p + q)]
    decoded = [abs(value) for raw in raws for value in (raw, raw * r, raw * r - q)]
    numerators = [abs(value) for raw in raws for value in (raw, raw * a, raw * a - b)]
    return Plan(
        p, q, r, a, b, c, raws, count_wide,
        encode_wide=max(encoded) + r > INT32[1],
        decode_wide=max(decoded) + abs(p) > INT32[1],
        numerator=max(numerators),
        counts=counts,
        beyond=_countable(p, q, r, raws),
    )  # fmt: skip


def _countable(p: int, q: int, r: int, raws: tuple[int, int]) -> tuple[int, int] | None:
    """The raw numbers between which counts are computed in 64 bits; None where that is all that the type holds."""
    most = INT64[1] - abs(p) // 2
    low, high = -((most - q) // r), (most + q) // r
    return None if (low <= raws[0] or p == r == 1) and raws[1] <= high else (max(low, raws[0]), min(high, raws[1]))


def _reduced(factor: int, add: int, divisor: int) -> tuple[int, int, int]:
    """The same linear rule in the smallest integers, the divisor above 0."""
    common = gcd(factor, add, divisor) * (1 if divisor > 0 else -1)
    return factor // common, add // common, divisor // common


def _divided(number: int, divisor: int) -> int:
    """The quotient, rounded to nearest, halves away from zero."""
    if divisor < 0:
        number, divisor = -number, -divisor
    quotient = (2 * abs(number) + divisor) // (2 * divisor)
    return -quotient if number < 0 else quotient


def _counts(p: int, q: int, r: int, low: int, high: int) -> tuple[int, int]:
    """The least and the greatest count whose rounded raw number lies in low..high."""
    if p < 0:
        first, last = _counts(-p, q, r, low, high)
        return -last, -first
    # a half rounds away from zero: it belongs to a limit above zero from below, and to one below zero from above
    below, above = (2 * low - 1) * r - 2 * q, (2 * high + 1) * r - 2 * q
    first = -(-below // (2 * p)) if low > 0 else below // (2 * p) + 1
    last = above // (2 * p) if high < 0 else -(-above // (2 * p)) - 1
    return first, last


def is_float(plan: Plan, rule: Linear, low: int, high: int) -> bool:
    """Whether binary32 holds every integer that the two conversions meet."""
    largest = max(abs(low), abs(high)) + 1
    encode = max(abs(rule.ratio.numerator), rule.ratio.denominator, largest) <= EXACT_FLOAT
    return encode and max(plan.c, plan.numerator) <= EXACT_FLOAT
