"""Scales that are known at compile time, as C expressions whose integers are proven to fit."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

from fieldscribe.arithmetic.words import INT32, INT64
from fieldscribe.lowered import plan_of
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


class Scaled:
    """The expressions of a scale: `raw_of_count` of `count`, `whole` of `value`, the others of `raw`.

    `inside` is the test whether the raw number of a count may be written; it is empty if that is always so, as is
    `count_fits`, the test whether a raw number has a count. `direct` says that a count equals its raw number. `wide`
    says that values are always double.
    """

    def __init__(self, point: Point, plan: Plan) -> None:
        assert point.fixed_scale is not None
        self._point, self._plan, self._rule = point, plan, point.fixed_scale
        self.count_type = "int64_t" if plan.count_wide else "int32_t"
        self.counts = plan.counts
        self.direct = plan.to_raw.does_nothing
        self.wide = not plan.fits_float
        open_ended = plan.counts == (INT64 if plan.count_wide else INT32)
        self.inside = "" if open_ended else f"fieldscribe_within{'_wide' if plan.count_wide else ''}"

    @cached_property
    def count_fits(self) -> str:
        """The test whether a raw number has a count; empty if each has one."""
        return count_fits(self._plan)

    @cached_property
    def raw_of_count(self) -> str:
        """The raw number of a count that is inside."""
        return cast(raw_type(self._point), raw_of_count(self._plan))

    @property
    def count_of_raw(self) -> str:
        """The count of a raw number, cast to its type where C needs that."""
        number, wide = count_of_raw(self._plan)
        becomes = self._plan.raws[1] <= INT64[1] and (self._plan.count_wide or not wide)
        return number if becomes else cast(self.count_type, number)

    @property
    def factor(self) -> str:
        """The factor of a rule that only multiplies, else empty."""
        rule = self._rule
        return bare(rule.ratio.numerator) if rule.ratio.denominator == 1 and not rule.offset else ""

    @property
    def steps(self) -> str:
        """The unrounded raw number of a value: times, divided by, plus; each step is rounded to floating point."""
        return _steps(self._rule, wide=self.wide)

    @property
    def value_of_raw(self) -> str:
        """The value of a raw number."""
        return _value_of_raw(self._plan, self._point, wide=self.wide)


def scaled(point: Point, low: int, high: int) -> Scaled:
    """The expressions of a scale without run-time factors; `low` and `high` are the outer raw limits."""
    return Scaled(point, plan_of(point, low, high))


def _steps(rule: Linear, *, wide: bool) -> str:
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
