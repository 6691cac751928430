"""Scales that are known at compile time, as C expressions whose integers are proven to fit."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.arithmetic.words import INT32, INT64
from fieldscribe.lowered import plan_of
from fieldscribe.records import dataclass
from fieldscribe.targets.c.counts import count_fits, count_of_raw, linear, raw_of_count
from fieldscribe.targets.c.literals import (
    bare,
    cast,
    raw_type,
    real,
    sign_and_size,
    unsigned,
)

if TYPE_CHECKING:
    from fieldscribe.lowered import Plan
    from fieldscribe.model import Linear, Point

_EXACT = 1 << 53


@dataclass(frozen=True, slots=True)
class Scaled:
    """The expressions of a scale: `raw_of_count` of `count`, `whole` of `value`, the others of `raw`.

    `count_inside` tests whether the raw number of a count may be written, `count_fits` whether a raw number has one.
    Both are empty if that is always so. `direct` says that a count equals its raw number. `factor` is the factor of a
    rule that only multiplies, else empty.
    """

    count_type: str
    count_inside: str
    count_fits: str
    counts: tuple[int, int]
    direct: bool
    raw_of_count: str
    count_of_raw: str
    wide: bool
    factor: str
    steps: str
    value_of_raw: str


def scaled(point: Point, low: int, high: int) -> Scaled:
    """The expressions of a scale without run-time factors; `low` and `high` are the outer raw limits."""
    assert point.fixed_scale is not None
    rule = point.fixed_scale
    plan = plan_of(point, low, high)
    kind = "int64_t" if plan.count_wide else "int32_t"
    first, last = plan.counts
    open_ended = (first, last) == (INT64 if plan.count_wide else INT32)
    wide = not plan.fits_float
    within = "fieldscribe_within_wide" if plan.count_wide else "fieldscribe_within"
    return Scaled(
        count_type=kind,
        count_inside="" if open_ended else f"{within}(count, {bare(first)}, {bare(last)})",
        count_fits=count_fits(plan),
        counts=plan.counts,
        direct=plan.to_raw.does_nothing,
        raw_of_count=cast(raw_type(point), raw_of_count(plan)),
        count_of_raw=_count(plan, kind),
        wide=wide,
        factor=bare(rule.ratio.numerator) if rule.ratio.denominator == 1 and not rule.offset else "",
        steps=_steps(rule, wide=wide),
        value_of_raw=_value_of_raw(plan, point, wide=wide),
    )


def _count(plan: Plan, kind: str) -> str:
    """The count of a raw number, cast to its type where C needs that."""
    number, wide = count_of_raw(plan)
    becomes = plan.raws[1] <= INT64[1] and (kind == "int64_t" or not wide)
    return number if becomes else cast(kind, number)


def is_double(point: Point, low: int, high: int) -> bool:
    """Whether the values of a scaled point are always double."""
    return not plan_of(point, low, high).fits_float


def _steps(rule: Linear, *, wide: bool) -> str:
    """The unrounded raw number of a value: times, divided by, plus; each step is rounded to floating point."""
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
    """An integer as a constant; beyond 2^53 as the nearest double."""
    return bare(number) if abs(number) <= _EXACT else f"{number}.0"


def _value_of_raw(plan: Plan, point: Point, *, wide: bool) -> str:
    factor, add, divisor = plan.to_value
    if max(plan.numerator, divisor) > _EXACT:
        return _long_quotient(plan, point)
    line = linear("raw", factor, add, "int64_t" if plan.numerator > INT32[1] else "int32_t")
    number = "raw" if factor == 1 and add == 0 else line
    return f"fieldscribe_ratio{'_wide' if wide else ''}({number}, {divisor})"


def _long_quotient(plan: Plan, point: Point) -> str:
    """(raw * factor + add) / divisor rounded to the nearest double, for numerators that exceed 53 bits."""
    factor, add, divisor = plan.to_value
    below, size = sign_and_size(point)
    above = "raw >= 0" if point.info.signed else "true"
    numbers = [unsigned(abs(factor)), "true" if add < 0 else "false", unsigned(abs(add)), unsigned(divisor)]
    return f"fieldscribe_quotient({above if factor < 0 else below}, {size}, {', '.join(numbers)})"
