"""Scales and limits whose factors are read at run time."""

from __future__ import annotations

from math import prod
from typing import TYPE_CHECKING

from fieldscribe.targets.c.literals import INT32, INT64, bare, raw_bounds, sign_and_size, signed
from fieldscribe.targets.c.views import LimitView, RuleCase, RuledView, Step

if TYPE_CHECKING:
    from fieldscribe.model import Factor, Limit, Linear, Point, ScaleCase
    from fieldscribe.targets.c.scope import Scope

_MANTISSA = 1 << 24
"""No mantissa of a binary32 number is larger."""


def ruled_view(point: Point, scope: Scope) -> RuledView:
    """The rule function of a point, case by case."""
    cases = tuple(_case(case, scope) for case in point.scale or ())
    scope.used.add("rules")
    wide = point.readable and not point.encodes_values
    if wide:
        scope.used.update(("quotient", "rules_wide"))
    return RuledView(
        cases=cases,
        total=any(not case.test for case in cases),
        tens=signed(10 ** (point.decimals or 0)),
        pass_scale=scope.place(point.scale_arguments),
        beyond=_too_large(point),
        parts=sign_and_size(point) if wide else None,
    )


def _too_large(point: Point) -> str:
    if point.most_raw is None:
        return ""
    above = f"raw > {bare(point.most_raw)}"
    return f"raw < {bare(-point.most_raw)} || {above}" if point.least < 0 else above


def limit_view(limit: Limit, name: str, is_low: bool, scope: Scope) -> LimitView:
    """The statements' parts that compute one limit into the variable `name`."""
    start = limit.least if is_low else limit.greatest
    tests = [_is_no_code(point, *band, scope) for point, codes in limit.unless for band in codes]
    applies, clamp = " && ".join(tests), f"{name} {'<' if is_low else '>'} {bare(start)}"
    simple = _simple(limit.rule, scope)
    if simple is None:
        scope.used.add("rules")
        rule = _rule(limit.rule, scope, of_limit=True)
        return LimitView(name, signed(start), applies, (), "number_of_rule", clamp, rule)
    if _stays_inside(limit, scope, is_low=is_low):
        clamp = ""
    return LimitView(name, signed(start), applies, simple[1], simple[0], clamp, None)


def _stays_inside(limit: Limit, scope: Scope, *, is_low: bool) -> bool:
    """Whether a computed limit is never beyond the outer one, whatever the arguments hold."""
    rule = limit.rule
    if not _never_negative(rule, scope):
        return False
    if is_low:
        return limit.least <= 0
    if any(factor.power < 0 for factor in rule.factors):
        return False
    most = rule.ratio * prod(_bounds(factor, scope)[1] for factor in rule.factors) + rule.offset
    return 2 * most < 2 * limit.greatest + 1


def _is_no_code(point: str, low: int, high: int, scope: Scope) -> str:
    least, greatest = raw_bounds(scope.points[point])
    if low == high:
        return f"{point}_raw != {bare(low)}"
    tests = [f"{point}_raw < {bare(low)}"] if low > least else []
    tests += [f"{point}_raw > {bare(high)}"] if high < greatest else []
    return f"({' || '.join(tests)})" if len(tests) > 1 else tests[0]


def limit_is_wide(limit: Limit, scope: Scope) -> bool:
    """Whether a limit may need more than 32 bits on its way."""
    return _simple(limit.rule, scope) is None or _reach(limit.rule, scope) > INT32[1]


def _never_negative(rule: Linear, scope: Scope) -> bool:
    return min(rule.ratio, rule.offset) >= 0 and all(_bounds(factor, scope)[0] >= 0 for factor in rule.factors)


def _case(case: ScaleCase, scope: Scope) -> RuleCase:
    test = f"{case.point}_raw == {bare(case.raw or 0)}" if case.point is not None else ""
    return _rule(case.rule, scope, test)


def _rule(rule: Linear, scope: Scope, test: str = "", *, of_limit: bool = False) -> RuleCase:
    """The steps of a rule. A scale takes no factor of zero, a limit only none to divide by."""
    ends = {1: abs(rule.ratio.numerator), -1: rule.ratio.denominator}
    steps, tens = [], []
    for factor in rule.factors:
        number = _number(factor, "int64_t")
        if _floats(factor, scope):
            ends[factor.power] *= _MANTISSA
            kind = "plain" if ends[factor.power] <= INT64[1] else "checked"
            side = "num" if factor.power > 0 else "den"
            steps.append(Step(kind, side, "mantissa", False, "", f"{factor.point}_raw"))
            continue
        if factor.ten_to:
            exponent = f"-{number}" if factor.power < 0 else number
            scope.used.add("times_ten_to")
            tens.append(Step("ten", "rule", exponent, False, _beyond(factor, scope)))
            continue
        ends[factor.power] *= _reach_of(factor, scope)
        kind = "plain" if ends[factor.power] <= INT64[1] else "checked"
        zero = factor.power < 0 or not of_limit
        steps.append(Step(kind, "num" if factor.power > 0 else "den", number, zero, ""))
    return RuleCase(
        test,
        signed(rule.ratio.numerator),
        signed(rule.ratio.denominator),
        signed(rule.offset.numerator),
        signed(rule.offset.denominator),
        (*steps, *tens),
        scope.shifts,
        scope.lifts,
        "" if of_limit else _codes(rule, scope),
    )


def _codes(rule: Linear, scope: Scope) -> str:
    """Whether what is no quantity stands for a factor."""
    names = dict.fromkeys(factor.point for factor in rule.factors)
    codes = [(name, one) for name in names for one in scope.points[name].specials]
    tests = [_is_code(name, one.low, one.high, scope) for name, one in codes]
    return " || ".join(f"({test})" if " && " in test and len(tests) > 1 else test for test in tests)


def _is_code(point: str, low: int, high: int, scope: Scope) -> str:
    least, greatest = raw_bounds(scope.points[point])
    if low == high:
        return f"{point}_raw == {bare(low)}"
    tests = [f"{point}_raw >= {bare(low)}"] if low > least else []
    return " && ".join(tests + ([f"{point}_raw <= {bare(high)}"] if high < greatest else []))


def _floats(factor: Factor, scope: Scope) -> bool:
    """Whether a factor is the number of an f32 point: a mantissa of 24 bits times a power of two."""
    floating = scope.points[factor.point].info.floating
    assert not floating or (factor.slope, factor.intercept, factor.ten_to) == (1, 0, False)
    return floating


def _beyond(factor: Factor, scope: Scope) -> str:
    """Whether an exponent is more than its own point may hold."""
    point = scope.points[factor.point]
    low, high = factor.exponents or point.outer
    least, greatest = raw_bounds(point)
    tests = [f"{factor.point}_raw < {bare(low)}"] if low > least else []
    tests += [f"{factor.point}_raw > {bare(high)}"] if high < greatest else []
    return " || ".join(tests)


def _simple(rule: Linear, scope: Scope) -> tuple[str, tuple[str, ...]] | None:
    """A limit as one expression and the factors that must not be zero; None when 64 bits are not proven to suffice."""
    factors, part = rule.factors, rule.offset.denominator
    if any(_floats(factor, scope) for factor in factors):
        return None
    positive = all(_bounds(factor, scope)[0] >= 0 for factor in factors if factor.power < 0)
    if any(factor.ten_to for factor in factors) or not positive or _reach(rule, scope) > INT64[1]:
        return None
    cast = "int64_t" if _reach(rule, scope) > INT32[1] else "int32_t"
    tops = [_number(factor, cast) for factor in factors if factor.power > 0]
    bottoms = [_number(factor, cast) for factor in factors if factor.power < 0]
    top = _product(rule.ratio.numerator * part, tops, cast)
    bottom = _product(rule.ratio.denominator * part, bottoms, cast)
    if rule.offset:
        lift = _product(rule.offset.numerator * rule.ratio.denominator, bottoms, cast)
        top = f"{top} + {lift}"
    if bottom == "1":
        return top, ()
    return f"{scope.helper('divide_wide' if cast == 'int64_t' else 'divide')}({top}, {bottom})", tuple(bottoms)


def _product(constant: int, names: list[str], cast: str) -> str:
    """A product without factors of one; a lone constant keeps the type of its surroundings by itself."""
    parts = list(names)
    if constant != 1 or not parts:
        parts.append(f"({cast}){signed(constant)}" if not parts and abs(constant) > INT32[1] else signed(constant))
    return " * ".join(parts)


def _number(factor: Factor, cast: str) -> str:
    """Raw * slope + intercept of a factor, in brackets where it is more than a name."""
    text = f"({cast}){factor.point}_raw"
    if factor.slope != 1:
        text = f"{text} * {signed(factor.slope)}"
    if factor.intercept:
        text = f"{text} {'-' if factor.intercept < 0 else '+'} {abs(factor.intercept)}"
    return f"({text})" if " " in text else text


def _bounds(factor: Factor, scope: Scope) -> tuple[int, int]:
    if _floats(factor, scope):
        return -_MANTISSA, _MANTISSA
    ends = [raw * factor.slope + factor.intercept for raw in raw_bounds(scope.points[factor.point])]
    return min(ends), max(ends)


def _reach_of(factor: Factor, scope: Scope) -> int:
    low, high = _bounds(factor, scope)
    return max(abs(low), abs(high), 1)


def _reach(rule: Linear, scope: Scope) -> int:
    """A number that no intermediate of a limit's expression exceeds in size, whatever the arguments hold."""
    top, bottom = abs(rule.ratio.numerator) * rule.offset.denominator, rule.ratio.denominator * rule.offset.denominator
    for factor in rule.factors:
        if factor.power > 0:
            top *= _reach_of(factor, scope)
        else:
            bottom *= _reach_of(factor, scope)
    return top + bottom * (abs(rule.offset.numerator) + 1)
