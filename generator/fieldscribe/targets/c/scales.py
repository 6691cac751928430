"""Scales that are known at compile time, as C expressions whose integers are proven to fit."""

from __future__ import annotations

from dataclasses import dataclass
from math import gcd
from typing import TYPE_CHECKING, NamedTuple

from fieldscribe.targets.c.literals import (
    EXACT_FLOAT,
    INT32,
    INT64,
    bare,
    cast,
    raw_bounds,
    raw_type,
    real,
    sign_and_size,
    signed,
    unsigned,
)
from fieldscribe.targets.c.reciprocals import reciprocal

if TYPE_CHECKING:
    from fieldscribe.model import Linear, Point

_EXACT = 1 << 53


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


@dataclass(frozen=True, slots=True)
class Scaled:
    """The expressions of a scale: `raw_of_count` of `count`, `whole` of `value`, the others of `raw`.

    `count_inside` tests whether a count is one of a raw number that may be written, `count_fits` whether a raw number
    has a count; both are empty where all do. `direct` says that a count is its raw number.
    """

    count_type: str
    count_inside: str
    count_fits: str
    counts: tuple[int, int]
    direct: bool
    raw_of_count: str
    count_of_raw: str
    wide: bool
    steps: str
    value_of_raw: str


def scaled(point: Point, low: int, high: int) -> Scaled:
    """The expressions of a scale without run-time factors; `low` and `high` are the outer raw limits."""
    assert point.scale is not None
    rule = point.scale[0].rule
    plan = _plan(rule, point.decimals or 0, raw_bounds(point), low, high)
    kind = "int64_t" if plan.count_wide else "int32_t"
    first, last = plan.counts
    open_ended = (first, last) == (INT64 if plan.count_wide else INT32)
    wide, counted = not _is_float(plan, rule, low, high), _count_of_raw(plan)
    return Scaled(
        count_type=kind,
        count_inside="" if open_ended else f"fieldscribe_within{_wide(plan.count_wide)}(count, {bare(first)}, {bare(last)})",
        count_fits=_fits(plan),
        counts=plan.counts,
        direct=(plan.p, plan.q, plan.r) == (1, 0, 1),
        raw_of_count=cast(raw_type(point), _raw_of_count(plan)),
        count_of_raw=counted if _fits_into(kind, counted, plan) else cast(kind, counted),
        wide=wide,
        steps=_steps(rule, wide=wide),
        value_of_raw=_value_of_raw(plan, point, wide=wide),
    )


def _fits_into(kind: str, number: str, plan: Plan) -> bool:
    """Whether an expression has that type, or becomes it by itself."""
    wide = plan.decode_wide or "_wide(" in number or "_divide(" in number
    return plan.raws[1] <= INT64[1] and (kind == "int64_t" or not wide)


def is_double(point: Point, low: int, high: int) -> bool:
    """Whether the values of a scaled point are always double."""
    assert point.scale is not None
    rule = point.scale[0].rule
    return not _is_float(_plan(rule, point.decimals or 0, raw_bounds(point), low, high), rule, low, high)


def count_type(point: Point, low: int, high: int) -> str:
    """The C type of the counts of a scaled point."""
    assert point.scale is not None
    plan = _plan(point.scale[0].rule, point.decimals or 0, raw_bounds(point), low, high)
    return "int64_t" if plan.count_wide else "int32_t"


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
    if add == 0:
        return start
    start = f"({start})" if " * " in start else start
    return f"{start} {'-' if add < 0 else '+'} {abs(add)}"


def _raw_of_count(plan: Plan) -> str:
    """The raw number of a count that lies in the limits."""
    first, last = plan.counts
    if plan.r == 1:
        cast = "int64_t" if plan.encode_wide and not plan.count_wide else ""
        return _linear("count", plan.p, plan.q, cast)
    number = "(int64_t)count" if not plan.count_wide else "count"
    if plan.q == 0:
        narrow = number if plan.count_wide else "count"
        found = _quotient("(int32_t)count" if plan.count_wide else "count", first, last, plan.p, plan.r, wide=False)
        return found or _quotient(narrow, first, last, plan.p, plan.r, wide=True) or _divided_by(plan, number)
    ends = sorted(count * plan.p + plan.q for count in plan.counts)
    cast = "int64_t" if plan.encode_wide and not plan.count_wide else ""
    line = _linear("count", plan.p, plan.q, cast)
    found = "" if plan.encode_wide or plan.count_wide else _quotient(line, *ends, 1, plan.r, wide=False)
    return found or _quotient(line, *ends, 1, plan.r, wide=True) or f"fieldscribe_divide({line}, {plan.r})"


def _divided_by(plan: Plan, number: str) -> str:
    return f"fieldscribe_divide({_linear(number, plan.p, 0, '')}, {plan.r})"


def _quotient(number: str, first: int, last: int, num: int, den: int, *, wide: bool) -> str:
    """number * num / den to the nearest integer by a multiplication and a shift; empty where that is not proven."""
    most, sign = (INT64 if wide else INT32)[1], 1
    if max(abs(first), abs(last)) > most:
        return ""
    if num < 0:
        number, first, last, sign = f"-{number}", -last, -first, -1
    bits = den.bit_length() - 1
    size = max(abs(first), abs(last)) * abs(num) + den
    if den == 1 << bits and size <= most:
        return f"fieldscribe_halves{_wide(wide)}({_linear(number, num * sign, 0, '')}, {bits}U)"
    found = reciprocal(first, last, num * sign, den, most)
    if found is None:
        return ""
    much, little, fine, shift = found
    return f"fieldscribe_nearly{_wide(wide)}({number}, {much}, {little}, {fine}U, {shift}U)"


def _wide(wide: bool) -> str:  # noqa: FBT001 - what it says is its name
    return "_wide" if wide else ""


def _fits(plan: Plan) -> str:
    """Whether the count of a raw number, which no range allows, needs no more than 64 bits."""
    if plan.beyond is None:
        return ""
    low, high = plan.beyond
    if max(plan.raws) > INT64[1]:
        return f"fieldscribe_within_u64(raw, {unsigned(low)}, {unsigned(high)})"
    return f"fieldscribe_within_wide(raw, {bare(low)}, {bare(high)})"


def _count_of_raw(plan: Plan) -> str:
    """The count of a raw number."""
    if (plan.p, plan.q, plan.r) == (1, 0, 1):
        return "raw"
    sign = 1 if plan.p > 0 else -1
    wide = plan.decode_wide
    low, high = plan.beyond or plan.raws
    line = _linear("raw", plan.r * sign, -plan.q * sign, "int64_t" if wide else "int32_t")
    if abs(plan.p) == 1:
        return line
    ends = sorted(raw * plan.r * sign - plan.q * sign for raw in (low, high))
    found = "" if wide else _quotient(line, *ends, 1, abs(plan.p), wide=False)
    return found or _quotient(line, *ends, 1, abs(plan.p), wide=True) or f"fieldscribe_divide({line}, {abs(plan.p)})"


def _steps(rule: Linear, *, wide: bool) -> str:
    """The value in raw steps, before rounding: times, divided by, plus, each rounded by itself."""
    kind, tail = ("double", "_wide") if wide else ("fieldscribe_real", "")
    text = "value"
    if rule.ratio.numerator != 1:
        text = f"fieldscribe_times{tail}(value, {_constant(rule.ratio.numerator)})"
    if rule.ratio.denominator != 1:
        text = f"{text} / ({kind}){_constant(rule.ratio.denominator)}"
    if rule.offset:
        offset = abs(rule.offset)
        number = real(offset) if offset.denominator != 1 else str(offset.numerator)
        text = f"({text})" if " / " in text else text
        text += f" {'-' if rule.offset < 0 else '+'} ({kind}){number}"
    return text


def _constant(number: int) -> str:
    """An integer as the double that is nearest to it, where none is equal."""
    return bare(number) if abs(number) <= _EXACT else f"{number}.0"


def _value_of_raw(plan: Plan, point: Point, *, wide: bool) -> str:
    if max(plan.numerator, plan.c) > _EXACT:
        return _long_quotient(plan, point)
    line = _linear("raw", plan.a, -plan.b, "int64_t" if plan.numerator > INT32[1] else "int32_t")
    number = "raw" if plan.a == 1 and plan.b == 0 else line
    return f"fieldscribe_ratio{_wide(wide)}({number}, {plan.c})"


def _long_quotient(plan: Plan, point: Point) -> str:
    """(raw * a - b) / c to the nearest double, where a double does not hold the numerator."""
    below, size = sign_and_size(point)
    above = "raw >= 0" if point.info.signed else "true"
    numbers = [unsigned(abs(plan.a)), "true" if plan.b > 0 else "false", unsigned(abs(plan.b)), unsigned(plan.c)]
    return f"fieldscribe_quotient({above if plan.a < 0 else below}, {size}, {', '.join(numbers)})"
