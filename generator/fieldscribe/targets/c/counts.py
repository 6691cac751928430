"""Counts into raw numbers and back, as C expressions whose integers are proven to fit."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.targets.c.literals import INT32, INT64, bare, signed, unsigned
from fieldscribe.targets.c.reciprocals import Numbers, reciprocal

if TYPE_CHECKING:
    from fieldscribe.targets.c.plans import Plan


def linear(name: str, factor: int, add: int, cast: str) -> str:
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


def raw_of_count(plan: Plan) -> str:
    """The raw number of a count that lies in the limits."""
    first, last = plan.counts
    wider = "int64_t" if plan.encode_wide and not plan.count_wide else ""
    line = linear("count", plan.p, plan.q, wider)
    if plan.r == 1:
        return line
    if plan.q == 0:
        numbers = Numbers(first, last, plan.p, plan.r)
        narrow, wide = ("(int32_t)count", "count") if plan.count_wide else ("count", "(int64_t)count")
        found = _quotient(narrow, numbers, wide=False) or _quotient(wide, numbers, wide=True)
    else:
        numbers = _line(first, last, plan.p, plan.q, plan.r)
        found = "" if plan.encode_wide or plan.count_wide else _quotient(line, numbers, wide=False)
        found = found or _quotient(line, numbers, wide=True)
    return found or f"fieldscribe_divide({line}, {plan.r})"


def _line(first: int, last: int, factor: int, add: int, divisor: int) -> Numbers:
    """The numbers number * factor + add that are to be divided."""
    low, high = sorted(number * factor + add for number in (first, last))
    return Numbers(low, high, 1, divisor)


def _quotient(number: str, numbers: Numbers, *, wide: bool) -> str:
    """A number times num / den to the nearest integer without a division; empty where that is not proven."""
    most = (INT64 if wide else INT32)[1]
    if numbers.size > most:
        return ""
    if numbers.num < 0:
        turned = Numbers(-numbers.high, -numbers.low, -numbers.num, numbers.den)
        return _quotient(f"-{number}", turned, wide=wide)
    tail, bits = "_wide" if wide else "", numbers.den.bit_length() - 1
    if numbers.den == 1 << bits and numbers.size * numbers.num + numbers.den <= most:
        return f"fieldscribe_halves{tail}({linear(number, numbers.num, 0, '')}, {bits}U)"
    found = reciprocal(numbers, most)
    if found is None:
        return ""
    much, little, fine, shift = found
    return f"fieldscribe_nearly{tail}({number}, {much}, {little}, {fine}U, {shift}U)"


def count_fits(plan: Plan) -> str:
    """Whether the count of a raw number, which no range allows, needs no more than 64 bits."""
    if plan.beyond is None:
        return ""
    low, high = plan.beyond
    if max(plan.raws) > INT64[1]:
        return f"fieldscribe_within_u64(raw, {unsigned(low)}, {unsigned(high)})"
    return f"fieldscribe_within_wide(raw, {bare(low)}, {bare(high)})"


def count_of_raw(plan: Plan) -> tuple[str, bool]:
    """The count of a raw number, and whether the expression has 64 bits."""
    wide = plan.decode_wide
    if (plan.p, plan.q, plan.r) == (1, 0, 1):
        return "raw", wide
    sign = 1 if plan.p > 0 else -1
    low, high = plan.beyond or plan.raws
    line = linear("raw", plan.r * sign, -plan.q * sign, "int64_t" if wide else "int32_t")
    if abs(plan.p) == 1:
        return line, wide
    numbers = _line(low, high, plan.r * sign, -plan.q * sign, abs(plan.p))
    narrow = "" if wide else _quotient(line, numbers, wide=False)
    if narrow:
        return narrow, False
    return _quotient(line, numbers, wide=True) or f"fieldscribe_divide({line}, {abs(plan.p)})", True
