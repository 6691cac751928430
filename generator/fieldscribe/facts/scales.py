"""Scales and computed limits in the form of the exported model."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

from fieldscribe.model import Bound, Factor, Limit, Linear, Point
from fieldscribe.wording.exact import fixed_rule, value_multiple

PointsByName = Mapping[str, Point]
"""The points that rules refer to."""

_MOST_REPEATS = 8
_MOST_DIGITS = 1000


def scale_of(point: Point, by_name: PointsByName) -> list[dict[str, object]] | None:
    """The cases of a scale: `raw = value * num / den + offset`, `uses` beside `num`."""
    if point.scale is None:
        return None
    cases: list[dict[str, object]] = []
    for case in point.scale:
        ratio, uses = rule_of(case.rule, by_name)
        cases.append(
            {
                "when": None if case.point is None else {"point": case.point, "raw": case.raw},
                "num": str(ratio.numerator),
                "den": str(ratio.denominator),
                "offset": str(case.rule.offset),
                "uses": uses,
            }
        )
    return cases


def rule_of(rule: Linear, by_name: PointsByName) -> tuple[Fraction, list[dict[str, object]]]:
    """The constant of a rule, which those of its factors are multiplied into, and its uses."""
    ratio, uses = rule.ratio, []
    for factor in rule.factors:
        constant, used = use_of(factor, by_name[factor.point])
        ratio *= constant
        uses += used
    return ratio, uses


def use_of(factor: Factor, point: Point) -> tuple[Fraction, list[dict[str, object]]]:
    """A run-time factor as a constant times `point`'s raw number or value.

    `raw * slope + intercept` is said as the raw number, as a multiple of the value or of the raw number, or as it is.
    """
    if factor.ten_to:
        return _power_of_ten(factor, point)
    if point.info.floating:
        return Fraction(1), [_use(factor, "value", "power", factor.power)]
    if factor.slope == 1 and factor.intercept == 0:
        return Fraction(1), [_use(factor, "raw", "power", factor.power)]
    multiple = value_multiple(factor, point)
    if multiple:
        return multiple**factor.power, [_use(factor, "value", "power", factor.power)]
    if factor.intercept == 0:
        return Fraction(factor.slope) ** factor.power, [_use(factor, "raw", "power", factor.power)]
    return Fraction(1), [_whole_use(factor, "power")]


def bound_of(bound: Bound, is_low: bool, point: Point) -> int | str:
    """The end of a range: a number, or an exact expression in the raw numbers of other points."""
    if isinstance(bound, int):
        return bound
    text = _limit(bound.rule)
    fixed = bound.outermost(low=is_low)
    if fixed != (point.least if is_low else point.greatest):
        text = f"{'max' if is_low else 'min'}({fixed}, {text})"
    return f"{fixed} if {_lifted(bound)} else {text}" if bound.unless else text


def _power_of_ten(factor: Factor, point: Point) -> tuple[Fraction, list[dict[str, object]]]:
    """Ten to `raw * slope + intercept`, as a power of the raw number, of the value, or of repeated raw numbers."""
    rule = fixed_rule(point)
    if factor.slope not in (1, -1) and rule is not None and Fraction(rule.factor, rule.divisor) == factor.slope:
        rest = factor.intercept - Fraction(rule.add, rule.divisor)
        if rest.denominator == 1 and abs(rest) <= _MOST_DIGITS:
            return _ten_to(factor, int(rest)), [_use(factor, "value", "ten_to", factor.power)]
    if not 1 <= abs(factor.slope) <= _MOST_REPEATS or abs(factor.intercept) > _MOST_DIGITS:
        return Fraction(1), [_whole_use(factor, "ten_to")]
    sign = 1 if factor.slope > 0 else -1
    return _ten_to(factor, factor.intercept), [_use(factor, "raw", "ten_to", sign * factor.power)] * abs(factor.slope)


def _ten_to(factor: Factor, exponent: int) -> Fraction:
    return Fraction(10) ** (exponent * factor.power)


def _use(factor: Factor, part: str, kind: str, sign: int) -> dict[str, object]:
    return {"point": factor.point, "part": part, kind: sign}


def _whole_use(factor: Factor, kind: str) -> dict[str, object]:
    """A factor with all its numbers, where it is no plain multiple."""
    return {"point": factor.point, "part": "raw", "times": factor.slope, "plus": factor.intercept, kind: factor.power}


def _limit(rule: Linear) -> str:
    """The rule applied to 1, as an arithmetic expression."""
    above = [_factor(factor) for factor in rule.factors if factor.power > 0]
    below = [_factor(factor) for factor in rule.factors if factor.power < 0]
    if rule.ratio.numerator != 1 or not above:
        above.append(str(rule.ratio.numerator))
    if rule.ratio.denominator != 1:
        below.append(str(rule.ratio.denominator))
    text = " * ".join(above) + "".join(f" / {factor}" for factor in below)
    if rule.offset:
        text += f" {'+' if rule.offset > 0 else '-'} {abs(rule.offset.numerator)}"
        text += f" / {rule.offset.denominator}" if rule.offset.denominator != 1 else ""
    return text


def _factor(factor: Factor) -> str:
    text = f"{factor.point}.raw"
    if factor.slope != 1:
        text = f"{text} * {factor.slope}"
    if factor.intercept:
        text = f"{text} {'+' if factor.intercept > 0 else '-'} {abs(factor.intercept)}"
    plain = factor.slope == 1 and not factor.intercept
    if factor.ten_to:
        return f"10 ** {text}" if plain else f"10 ** ({text})"
    return text if plain else f"({text})"


def _lifted(limit: Limit) -> str:
    """When the limit does not apply."""
    cases = (_is_code(f"{name}.raw", *band) for name, codes in limit.unless for band in codes)
    return " or ".join(cases)


def _is_code(raw: str, low: int, high: int) -> str:
    return f"{raw} == {low}" if low == high else f"{low} <= {raw} <= {high}"
