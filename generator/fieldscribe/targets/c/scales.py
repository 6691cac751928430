"""Scales that are known at compile time, as C expressions whose integers are proven to fit."""

from __future__ import annotations

from math import gcd
from typing import TYPE_CHECKING, NamedTuple

from fieldscribe.targets.c.literals import (
    EXACT_FLOAT,
    INT32,
    INT64,
    bare,
    raw_bounds,
    raw_type,
    real,
    sign_and_size,
    signed,
    unsigned,
)
from fieldscribe.targets.c.views import ScaledView

if TYPE_CHECKING:
    from fieldscribe.model import Linear, Point
    from fieldscribe.targets.c.scope import Scope


_EXACT = 1 << 53


class Plan(NamedTuple):
    """The integers of a scale: raw = (count * p + q) / r and value = (raw * a - b) / c, with r and c above 0.

    `counts` are the counts whose raw numbers lie in the outer limits, `numerator` is the largest that decoding to a
    value meets; each `_wide` says that 32 bits do not suffice.
    """

    p: int
    q: int
    r: int
    a: int
    b: int
    c: int
    count_wide: bool
    encode_wide: bool
    decode_wide: bool
    numerator: int
    counts: tuple[int, int]
    wide_raw: bool
    beyond: tuple[int, int] | None


def scaled_view(point: Point, scope: Scope, low: int, high: int) -> ScaledView:
    """The functions' expressions for a scale without run-time factors; `low` and `high` are the outer raw limits."""
    assert point.scale is not None
    rule = point.scale[0].rule
    ratio, offset = rule.ratio, rule.offset
    numbers = ratio.numerator, ratio.denominator, offset.numerator, offset.denominator  # hashed faster than fractions
    key = (*numbers, point.decimals, point.encodes_values, point.type, point.access, low, high)
    known = scope.scales.get(key)
    if known is None:
        known = scope.scales[key] = _scaled_view(point, rule, scope, low, high)
    return known


def _scaled_view(point: Point, rule: Linear, scope: Scope, low: int, high: int) -> ScaledView:
    plan = _plan(rule, point.decimals or 0, raw_bounds(point), low, high)
    limits = INT64 if plan.count_wide else INT32
    tests = [f"count < {bare(plan.counts[0])}"] if plan.counts[0] > limits[0] else []
    tests += [f"count > {bare(plan.counts[1])}"] if plan.counts[1] < limits[1] else []
    narrow = _is_float(plan, rule, low, high)
    wide = not narrow
    if wide:
        scope.used.add("double")
    counted, encodes = point.decimals is not None, point.writable and point.encodes_values
    if encodes:
        scope.used.add("round_wide" if wide else "round")
    return ScaledView(
        count_type="int64_t" if plan.count_wide else "int32_t",
        count_beyond=_beyond(plan, raw_bounds(point)) if counted and point.readable else "",
        count_outside=" || ".join(tests),
        raw_of_count=_raw_of_count(plan, scope, raw_type(point)) if counted and point.writable else "",
        count_of_raw=_count_of_raw(plan, scope) if counted and point.readable else "",
        real="double" if wide else scope.helper("real"),
        round=f"{scope.prefix}_round_wide" if wide else f"{scope.prefix}_round",
        whole_type="int64_t" if wide else "int32_t",
        scaled=_scaled(rule, scope, wide) if encodes else "",
        value_of_raw=_value_of_raw(plan, point, scope, "double" if wide else f"{scope.prefix}_real"),
    )


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
        p, q, r, a, b, c, count_wide,
        encode_wide=max(encoded) + r > INT32[1],
        decode_wide=max(decoded) + abs(p) > INT32[1],
        numerator=max(numerators),
        counts=counts,
        wide_raw=max(raws) > INT64[1],
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


def _is_float(plan: Plan, rule: Linear, low: int, high: int) -> bool:
    """Whether binary32 holds every integer that the two conversions meet."""
    largest = max(abs(low), abs(high)) + 1
    encode = max(abs(rule.ratio.numerator), rule.ratio.denominator, largest) <= EXACT_FLOAT
    return encode and max(plan.c, plan.numerator) <= EXACT_FLOAT


def _linear(name: str, factor: int, add: int, cast: str) -> str:
    """`name * factor + add`, without what does nothing."""
    start = f"({cast}){name}" if cast else name
    if factor == -1:
        start = f"-{start}"
    elif factor != 1:
        start = f"{start} * {signed(factor)}"
    return start if add == 0 else f"{start} {'-' if add < 0 else '+'} {abs(add)}"


def _raw_of_count(plan: Plan, scope: Scope, target: str) -> str:
    cast = ""
    if plan.encode_wide and not plan.count_wide:
        cast = "int64_t"
    elif plan.count_wide and not plan.encode_wide and plan.r != 1:
        cast = "int32_t"
    number = _linear("count", plan.p, plan.q, cast)
    if plan.r != 1:
        helper = scope.helper("divide_wide" if plan.encode_wide else "divide")
        return f"({target}){helper}({number}, {plan.r})"
    return f"({target})({number})" if " " in number else f"({target}){number}"


def _beyond(plan: Plan, raws: tuple[int, int]) -> str:
    """The test of raw numbers, which no range allows, whose counts need more than 64 bits."""
    if plan.beyond is None:
        return ""
    low, high = plan.beyond
    tests = [f"raw < {bare(low)}"] if low > raws[0] else []
    literal = unsigned(high) if plan.wide_raw else bare(high)
    return " || ".join(tests + ([f"raw > {literal}"] if high < raws[1] else []))


def _count_of_raw(plan: Plan, scope: Scope) -> str:
    sign = 1 if plan.p > 0 else -1
    if plan.p == plan.r == 1 and plan.q == 0:
        return "(int64_t)raw" if plan.wide_raw else "raw"
    number = _linear("raw", plan.r * sign, -plan.q * sign, "int64_t" if plan.decode_wide else "int32_t")
    if abs(plan.p) != 1:
        number = f"{scope.helper('divide_wide' if plan.decode_wide else 'divide')}({number}, {abs(plan.p)})"
    return f"(int32_t)({number})" if plan.decode_wide and not plan.count_wide else number


def _scaled(rule: Linear, scope: Scope, wide: bool) -> str:
    """The value in raw steps, before rounding: times, divided by, plus, each rounded by itself."""
    text = "value"
    if rule.ratio.numerator != 1:
        text = f"{scope.helper('times_wide' if wide else 'times')}(value, {_constant(rule.ratio.numerator)})"
    if rule.ratio.denominator != 1:
        text = f"{text} / {_constant(rule.ratio.denominator)}"
    if rule.offset:
        offset = abs(rule.offset)
        number = real(offset) if offset.denominator != 1 else str(offset.numerator)
        text += f" {'-' if rule.offset < 0 else '+'} ({'double' if wide else scope.prefix + '_real'}){number}"
    return text


def _constant(number: int) -> str:
    """An integer as the double that is nearest to it, where none is equal."""
    return signed(number) if abs(number) <= _EXACT else f"{number}.0"


def _value_of_raw(plan: Plan, point: Point, scope: Scope, real_type: str) -> str:
    if point.readable and max(plan.numerator, plan.c) > _EXACT:
        return _quotient(plan, point, scope)
    plain = plan.a == 1 and plan.b == 0
    cast = "int64_t" if plan.numerator > INT32[1] else "int32_t"
    number = "raw" if plain else f"({_linear('raw', plan.a, -plan.b, cast)})"
    text = f"({real_type}){number}"
    return text if plan.c == 1 else f"{text} / {plan.c}"


def _quotient(plan: Plan, point: Point, scope: Scope) -> str:
    """(raw * a - b) / c to the nearest double, where a double does not hold the numerator."""
    below, size = sign_and_size(point)
    above = "raw >= 0" if point.info.signed else "true"
    numbers = [unsigned(abs(plan.a)), "true" if plan.b > 0 else "false", unsigned(abs(plan.b)), unsigned(plan.c)]
    return f"{scope.helper('quotient')}({above if plan.a < 0 else below}, {size}, {', '.join(numbers)})"
