"""Counts into raw numbers and back, as C expressions whose integers are proven to fit."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.arithmetic.words import INT32, INT64
from fieldscribe.targets.c.literals import bare, signed, unsigned
from fieldscribe.targets.c.reciprocals import Numbers, reciprocal

if TYPE_CHECKING:
    from fieldscribe.arithmetic.lines import Line
    from fieldscribe.lowered import Plan


def linear(name: str, factor: int, add: int, cast: str) -> str:
    """`name * factor + add`, without a factor of 1 and an addend of 0."""
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
    factor, add, divisor = plan.to_raw
    wider = "int64_t" if plan.encode_wide and not plan.count_wide else ""
    line = linear("count", factor, add, wider)
    if divisor == 1:
        return line
    if add == 0:
        numbers = Numbers(*plan.counts, factor, divisor)
        narrow, wide = ("(int32_t)count", "count") if plan.count_wide else ("count", "(int64_t)count")
        quotient = _quotient(narrow, numbers, wide=False) or _quotient(wide, numbers, wide=True)
    else:
        numbers = _numerators(plan.counts, plan.to_raw)
        quotient = "" if plan.encode_wide or plan.count_wide else _quotient(line, numbers, wide=False)
        quotient = quotient or _quotient(line, numbers, wide=True)
    return quotient or f"fieldscribe_divide({line}, {divisor})"


def _numerators(ends: tuple[int, int], line: Line) -> Numbers:
    """The numerators of the line's division, for the arguments between two ends."""
    low, high = sorted(end * line.factor + line.add for end in ends)
    return Numbers(low, high, 1, line.divisor)


def _quotient(number: str, numbers: Numbers, *, wide: bool) -> str:
    """An expression for number * num / den, rounded, without a division; empty if none is proven exact."""
    most = (INT64 if wide else INT32)[1]
    if numbers.size > most:
        return ""
    if numbers.num < 0:
        turned = Numbers(-numbers.high, -numbers.low, -numbers.num, numbers.den)
        return _quotient(f"-{number}", turned, wide=wide)
    tail, bits = "_wide" if wide else "", numbers.den.bit_length() - 1
    if numbers.den == 1 << bits and numbers.size * numbers.num + numbers.den <= most:
        return f"fieldscribe_halves{tail}({linear(number, numbers.num, 0, '')}, {bits}U)"
    factors = reciprocal(numbers, most)
    if factors is None:
        return ""
    much, little, fine, shift = factors
    return f"fieldscribe_nearly{tail}({number}, {much}, {little}, {fine}U, {shift}U)"


def count_fits(plan: Plan) -> str:
    """A test whether the count of a raw number fits 64 bits; empty if all do. Numbers in the range always do."""
    if plan.beyond is None:
        return ""
    low, high = plan.beyond
    if max(plan.raws) > INT64[1]:
        return f"fieldscribe_within_u64(raw, {unsigned(low)}, {unsigned(high)})"
    return f"fieldscribe_within_wide(raw, {bare(low)}, {bare(high)})"


def count_of_raw(plan: Plan) -> tuple[str, bool]:
    """The expression for the count of a raw number, and whether its type has 64 bits."""
    wide = plan.decode_wide
    if plan.to_raw.does_nothing:
        return "raw", wide
    to_count = plan.to_raw.inverse
    line = linear("raw", to_count.factor, to_count.add, "int64_t" if wide else "int32_t")
    if to_count.divisor == 1:
        return line, wide
    numbers = _numerators(plan.beyond or plan.raws, to_count)
    narrow = "" if wide else _quotient(line, numbers, wide=False)
    if narrow:
        return narrow, False
    return _quotient(line, numbers, wide=True) or f"fieldscribe_divide({line}, {to_count.divisor})", True
