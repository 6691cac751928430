"""Scales and limits whose factors are read at run time."""

from __future__ import annotations

from math import prod
from typing import TYPE_CHECKING

from fieldscribe.arithmetic.words import INT64
from fieldscribe.targets.c.literals import bare, signed

if TYPE_CHECKING:
    from fieldscribe.lowered import Operand, Rule
    from fieldscribe.model import Limit, Point
    from fieldscribe.targets.c.scope import HeaderScope


def rule_name(point: Point, scope: HeaderScope) -> str:
    """The function that gives the rule of a point; points with the same rule share it."""
    struct = tuple(scope.parameters(point, point.scale_arguments))
    return scope.tables.setdefault((struct, rule_of(point, scope)), f"{scope.prefix}_{point.item}_rule")


def rule_of(point: Point, scope: HeaderScope) -> str:
    """The rule of a point, case by case, as what other points hold makes it."""
    rules, depth = "", 0
    for case in point.scale or ():
        lowered = scope.lowered.rule(case.rule)
        rule, codes = _steps(lowered, scope), _codes(lowered, scope)
        if codes:
            rule = f"{codes} ? fieldscribe_no_rule(FIELDSCRIBE_ZERO_FACTOR) : {rule}"
        if case.point is None:
            return f"{rules}{rule}{')' * depth}"
        rule = f"({rule})" if codes else rule
        rules += f"({scope.raw(case.point)} == {bare(case.raw or 0)}) ? {rule} : ("
        depth += 1
    return f"{rules}fieldscribe_no_rule(FIELDSCRIBE_NO_CASE){')' * depth}"


def limit(bound: Limit, scope: HeaderScope, *, is_low: bool) -> str:
    """A limit that other points set; the outer one stands where one of them holds a code that is no quantity."""
    start, rule = bound.outermost(low=is_low), scope.lowered.rule(bound.rule)
    text = _bare_limit(rule, scope)
    if not _fits(rule) or not _stays_inside(rule, start, is_low=is_low):
        text = f"fieldscribe_no_{'less' if is_low else 'more'}({text}, {bare(start)})"
    tests = [_is_no_code(point, *band, scope) for point, codes in bound.unless for band in codes]
    if not tests:
        return text
    applies = tests[0] if len(tests) == 1 else f"({' && '.join(tests)})"
    return f"{applies} ? {text} : fieldscribe_whole_of({bare(start)})"


def _bare_limit(rule: Rule, scope: HeaderScope) -> str:
    if not _fits(rule):
        floats = any(operand.floating for operand in rule.operands)
        return f"fieldscribe_limit{'_f32' if floats else ''}({_steps(rule, scope, of_limit=True)})"
    top, bottom = _simple(rule, scope)
    return f"fieldscribe_whole_of({top})" if bottom == "1" else f"fieldscribe_limit_ratio({top}, {bottom})"


def _stays_inside(rule: Rule, outermost: int, *, is_low: bool) -> bool:
    """Whether a computed limit is never beyond the outermost one, whatever the arguments hold.

    Where nothing is negative, the limit is at least 0, and at most what the largest arguments give; rounded, that is no
    more than the outermost limit if it lies less than a half above it. What is divided by may be as small as it likes.
    """
    if min(rule.ratio, rule.offset) < 0 or any(operand.ends[0] < 0 for operand in rule.operands):
        return False
    if is_low:
        return outermost <= 0
    if any(operand.over for operand in rule.operands):
        return False
    return 2 * (rule.ratio * prod(operand.ends[1] for operand in rule.operands) + rule.offset) < 2 * outermost + 1


def _is_no_code(point: str, low: int, high: int, scope: HeaderScope) -> str:
    (least, greatest), raw = scope.points[point].held, scope.raw(point)
    if low == high:
        return f"({raw} != {bare(low)})"
    tests = [f"({raw} < {bare(low)})"] if low > least else []
    tests += [f"({raw} > {bare(high)})"] if high < greatest else []
    return f"({' || '.join(tests)})" if len(tests) > 1 else tests[0]


def _steps(rule: Rule, scope: HeaderScope, *, of_limit: bool = False) -> str:
    """The steps of a rule. A scale takes no factor of zero, a limit only none to divide by."""
    ratio, offset = rule.ratio, rule.offset
    numbers = (ratio.numerator, ratio.denominator, offset.numerator, offset.denominator)
    text = f"fieldscribe_rule_of({', '.join(map(bare, numbers))})"
    for operand in rule.steps:
        text = _step(text, operand, scope, of_limit=of_limit)
    return text


def _step(rule: str, operand: Operand, scope: HeaderScope, *, of_limit: bool) -> str:
    """A rule with one more factor."""
    number, raw = _number(operand, scope), scope.raw(operand.point)
    if operand.floating:
        return f"fieldscribe_rule_f32({rule}, {raw}, {'true' if operand.over else 'false'})"
    if operand.exponents is None:
        how = "over" if operand.over else "scaled" if of_limit else "times"
        return f"fieldscribe_rule_{how}({rule}, {number})"
    (low, high), (least, greatest) = operand.exponents, operand.held
    if low > least or high < greatest:
        rule = f"fieldscribe_rule_within({rule}, (int64_t){raw}, {bare(low)}, {bare(high)})"
    return f"fieldscribe_rule_ten_to({rule}, {'-' if operand.over else ''}{number})"


def _codes(rule: Rule, scope: HeaderScope) -> str:
    """Whether what is no quantity stands for a factor."""
    tests = [_is_code(name, *band, scope) for name, band in rule.coded]
    return f"({' || '.join(f'({test})' if ' && ' in test else test for test in tests)})" if tests else ""


def _is_code(point: str, low: int, high: int, scope: HeaderScope) -> str:
    (least, greatest), raw = scope.points[point].held, scope.raw(point)
    if low == high:
        return f"({raw} == {bare(low)})"
    tests = [f"({raw} >= {bare(low)})"] if low > least else []
    return " && ".join(tests + ([f"({raw} <= {bare(high)})"] if high < greatest else []))


def _fits(rule: Rule) -> bool:
    """Whether a limit is one number over another, both of which 64 bits hold whatever the arguments are.

    The limit is (num * tops * part + lift * den * bottoms) / (den * bottoms * part), of the ratio num / den and the
    offset lift / part, where tops and bottoms are the products of the arguments that multiply and divide. The first sum
    below is no less than either side in size: each argument counts with its largest size, at least 1, so that no
    product on the way is larger than the whole; and bottom * (lift + 1) holds the lift and the divisor with the half
    that rounding adds. A divisor that may be negative would turn the sign of the number, and ten to something is no
    product.
    """
    if any(operand.floating or operand.ten_to or (operand.over and operand.ends[0] < 0) for operand in rule.operands):
        return False
    part, lift = rule.offset.denominator, abs(rule.offset.numerator)
    top = abs(rule.ratio.numerator) * part * prod(one.largest for one in rule.operands if not one.over)
    bottom = rule.ratio.denominator * part * prod(one.largest for one in rule.operands if one.over)
    return top + bottom * (lift + 1) <= INT64[1]


def _simple(rule: Rule, scope: HeaderScope) -> tuple[str, str]:
    """A limit as a number and its divisor."""
    part = rule.offset.denominator
    tops = [_number(operand, scope) for operand in rule.operands if not operand.over]
    bottoms = [_number(operand, scope) for operand in rule.operands if operand.over]
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


def _number(operand: Operand, scope: HeaderScope) -> str:
    """Raw * slope + intercept of a factor, in brackets where it is more than a name."""
    text = f"(int64_t){scope.raw(operand.point)}"
    if operand.slope != 1:
        text = f"({text} * {signed(operand.slope)})"
    if operand.intercept:
        text = f"({text} {'-' if operand.intercept < 0 else '+'} {abs(operand.intercept)})"
    return text
