"""Scales and limits whose factors are read at run time."""

from __future__ import annotations

from math import prod
from typing import TYPE_CHECKING

from fieldscribe.targets.c.literals import INT64, bare, raw_bounds, signed

if TYPE_CHECKING:
    from fieldscribe.model import Factor, Limit, Linear, Point
    from fieldscribe.targets.c.scope import Scope

_MANTISSA = 1 << 24
"""No mantissa of a binary32 number is larger."""


def rule_name(point: Point, scope: Scope) -> str:
    """The function that gives the rule of a point; points with the same rule share it."""
    struct = tuple(scope.parameters(point, point.scale_arguments))
    return scope.tables.setdefault((struct, rule_of(point, scope)), f"{scope.prefix}_{point.item}_rule")


def rule_of(point: Point, scope: Scope) -> str:
    """The rule of a point, case by case, as what other points hold makes it."""
    rules, depth = "", 0
    for case in point.scale or ():
        rule = _rule(case.rule, scope)
        codes = _codes(case.rule, scope)
        if codes:
            rule = f"{codes} ? fieldscribe_no_rule(FIELDSCRIBE_ZERO_FACTOR) : {rule}"
        if case.point is None:
            return f"{rules}{rule}{')' * depth}"
        rule = f"({rule})" if codes else rule
        rules += f"({scope.raw(case.point)} == {bare(case.raw or 0)}) ? {rule} : ("
        depth += 1
    return f"{rules}fieldscribe_no_rule(FIELDSCRIBE_NO_CASE){')' * depth}"


def limit(bound: Limit, scope: Scope, *, is_low: bool) -> str:
    """A limit that other points set; the outer one stands where one of them holds a code that is no quantity."""
    start = bound.least if is_low else bound.greatest
    text = _bare_limit(bound.rule, scope)
    if _simple(bound.rule, scope) is None or not _stays_inside(bound, scope, is_low=is_low):
        text = f"fieldscribe_no_{'less' if is_low else 'more'}({text}, {bare(start)})"
    tests = [_is_no_code(point, *band, scope) for point, codes in bound.unless for band in codes]
    if not tests:
        return text
    applies = tests[0] if len(tests) == 1 else f"({' && '.join(tests)})"
    return f"{applies} ? {text} : fieldscribe_whole_of({bare(start)})"


def _bare_limit(rule: Linear, scope: Scope) -> str:
    simple = _simple(rule, scope)
    if simple is None:
        floats = any(_floats(factor, scope) for factor in rule.factors)
        return f"fieldscribe_limit{'_f32' if floats else ''}({_rule(rule, scope, of_limit=True)})"
    top, bottom = simple
    if bottom == "1":
        return f"fieldscribe_whole_of({top})"
    return f"fieldscribe_limit_ratio({top}, {bottom})"


def _stays_inside(bound: Limit, scope: Scope, *, is_low: bool) -> bool:
    """Whether a computed limit is never beyond the outer one, whatever the arguments hold."""
    rule = bound.rule
    if not _never_negative(rule, scope):
        return False
    if is_low:
        return bound.least <= 0
    if any(factor.power < 0 for factor in rule.factors):
        return False
    most = rule.ratio * prod(_bounds(factor, scope)[1] for factor in rule.factors) + rule.offset
    return 2 * most < 2 * bound.greatest + 1


def _is_no_code(point: str, low: int, high: int, scope: Scope) -> str:
    least, greatest = raw_bounds(scope.points[point])
    raw = scope.raw(point)
    if low == high:
        return f"({raw} != {bare(low)})"
    tests = [f"({raw} < {bare(low)})"] if low > least else []
    tests += [f"({raw} > {bare(high)})"] if high < greatest else []
    return f"({' || '.join(tests)})" if len(tests) > 1 else tests[0]


def _never_negative(rule: Linear, scope: Scope) -> bool:
    return min(rule.ratio, rule.offset) >= 0 and all(_bounds(factor, scope)[0] >= 0 for factor in rule.factors)


def _rule(rule: Linear, scope: Scope, *, of_limit: bool = False) -> str:
    """The steps of a rule. A scale takes no factor of zero, a limit only none to divide by."""
    ratio, offset = rule.ratio, rule.offset
    numbers = (ratio.numerator, ratio.denominator, offset.numerator, offset.denominator)
    text = f"fieldscribe_rule_of({', '.join(map(bare, numbers))})"
    for factor in sorted(rule.factors, key=lambda one: one.ten_to):
        text = _step(text, factor, scope, of_limit=of_limit)
    return text


def _step(rule: str, factor: Factor, scope: Scope, *, of_limit: bool) -> str:
    """A rule with one more factor."""
    number, raw = _number(factor, "int64_t", scope), scope.raw(factor.point)
    if _floats(factor, scope):
        return f"fieldscribe_rule_f32({rule}, {raw}, {'true' if factor.power < 0 else 'false'})"
    if not factor.ten_to:
        how = "over" if factor.power < 0 else "scaled" if of_limit else "times"
        return f"fieldscribe_rule_{how}({rule}, {number})"
    point = scope.points[factor.point]
    low, high = factor.exponents or point.outer
    least, greatest = raw_bounds(point)
    if low > least or high < greatest:
        rule = f"fieldscribe_rule_within({rule}, (int64_t){raw}, {bare(low)}, {bare(high)})"
    return f"fieldscribe_rule_ten_to({rule}, {'-' if factor.power < 0 else ''}{number})"


def _codes(rule: Linear, scope: Scope) -> str:
    """Whether what is no quantity stands for a factor."""
    names = dict.fromkeys(factor.point for factor in rule.factors)
    tests = [_is_code(name, one.low, one.high, scope) for name in names for one in scope.points[name].specials]
    return f"({' || '.join(f'({test})' if ' && ' in test else test for test in tests)})" if tests else ""


def _is_code(point: str, low: int, high: int, scope: Scope) -> str:
    least, greatest = raw_bounds(scope.points[point])
    raw = scope.raw(point)
    if low == high:
        return f"({raw} == {bare(low)})"
    tests = [f"({raw} >= {bare(low)})"] if low > least else []
    return " && ".join(tests + ([f"({raw} <= {bare(high)})"] if high < greatest else []))


def _floats(factor: Factor, scope: Scope) -> bool:
    """Whether a factor is the number of an f32 point: a mantissa of 24 bits times a power of two."""
    floating = scope.points[factor.point].info.floating
    assert not floating or (factor.slope, factor.intercept, factor.ten_to) == (1, 0, False)
    return floating


def _simple(rule: Linear, scope: Scope) -> tuple[str, str] | None:
    """A limit as a number and its divisor; None when 64 bits are not proven to suffice."""
    factors, part = rule.factors, rule.offset.denominator
    if any(_floats(factor, scope) for factor in factors):
        return None
    positive = all(_bounds(factor, scope)[0] >= 0 for factor in factors if factor.power < 0)
    if any(factor.ten_to for factor in factors) or not positive or _reach(rule, scope) > INT64[1]:
        return None
    tops = [_number(factor, "int64_t", scope) for factor in factors if factor.power > 0]
    bottoms = [_number(factor, "int64_t", scope) for factor in factors if factor.power < 0]
    top = _product(rule.ratio.numerator * part, tops)
    bottom = _product(rule.ratio.denominator * part, bottoms)
    if rule.offset:
        lift = _product(rule.offset.numerator * rule.ratio.denominator, bottoms)
        top = f"({top}) + ({lift})"
    return top, bottom


def _product(constant: int, names: list[str]) -> str:
    """A product without factors of one."""
    parts = list(names)
    if constant != 1 or not parts:
        parts.append(bare(constant) if not parts else signed(constant))
    return " * ".join(parts)


def _number(factor: Factor, cast: str, scope: Scope) -> str:
    """Raw * slope + intercept of a factor, in brackets where it is more than a name."""
    text = f"({cast}){scope.raw(factor.point)}"
    if factor.slope != 1:
        text = f"({text} * {signed(factor.slope)})"
    if factor.intercept:
        text = f"({text} {'-' if factor.intercept < 0 else '+'} {abs(factor.intercept)})"
    return text


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
