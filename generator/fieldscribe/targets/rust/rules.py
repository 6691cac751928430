"""Scales and limits that depend on other points, as Rust expressions with the runtime's `Rule`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.targets.rust.layout import chained, filled
from fieldscribe.targets.rust.literals import integer, value_name
from fieldscribe.text import rust_string

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.lowered import Lowered, Operand, Rule
    from fieldscribe.model import Limit, Point

Lines = tuple[str, ...]


def rule_lines(point: Point, lowered: Lowered) -> Lines:
    """The lines that choose the case in force: in order, up to one that always holds."""
    otherwise: Lines = ("Err(runtime::Error::NoCase(None))",)
    cases: list[tuple[str, list[str], Lines]] = []
    for case in point.scale or ():
        result = rule_of(lowered.rule(case.rule))
        if case.point is None:
            otherwise = result
            break
        raw, code = f"runtime::Raw::to_i64({_raw_of(case.point)})", integer(case.raw or 0)
        if cases and (cases[-1][0], cases[-1][2]) == (raw, result):
            cases[-1][1].append(code)
        else:
            cases.append((raw, [code], result))
    if not cases:
        return chained(otherwise)
    arms = (line for case in cases for line in _arm(*case))
    return "match () {", *arms, f"    () => {'?'.join(otherwise)},", "}"


def _arm(raw: str, codes: list[str], result: Lines) -> Iterator[str]:
    """An arm for raw numbers that are one of these codes."""
    yield from (f"    {line}" for line in filled(f"() if matches!({raw}, ", " | ", codes, ") => {"))
    yield from (f"        {line}" for line in chained(result))
    yield "    }"


def rule_of(rule: Rule) -> Lines:
    """The lines that compute a scale with its factors; special codes of factors are refused first."""
    codes = [code for operand in rule.steps for code in _codes(operand)]
    steps = [f".unless({' || '.join(codes)})"] if codes else []
    steps += [_step(operand, limit=False) for operand in rule.steps]
    return (f"{_start(rule)}{steps[0]}", *steps[1:]) if steps else (f"Ok({_start(rule)})",)


def limit_lines(limit: Limit, lowered: Lowered, *, lower: bool) -> Lines:
    """The lines that compute a limit within its outermost bound; the bound itself if a special code lifts the limit."""
    rule = lowered.rule(limit.rule)
    factors = (_step(operand, limit=True) for operand in rule.steps)
    bound = integer(limit.outermost(low=lower))
    first, *steps = (*factors, ".limit()", f".{'max' if lower else 'min'}({bound})")
    terms = (f"{_start(rule)}{first}", *steps)
    aside = [
        f"matches!(runtime::Raw::to_i64({_raw_of(name)}), {' | '.join(interval(*band) for band in codes)})"
        for name, codes in limit.unless
        if codes
    ]
    if not aside:
        return chained(terms)
    head = filled("if ", " || ", aside, " {")
    return *head, f"    {bound}", "} else {", *(f"    {line}" for line in chained(terms)), "}"


def interval(low: int, high: int) -> str:
    """A pattern for the numbers from `low` to `high`."""
    return integer(low) if low == high else f"{integer(low)}..={integer(high)}"


def _start(rule: Rule) -> str:
    ratio, offset = rule.ratio, rule.offset
    start = f"runtime::Rule::new({integer(ratio.numerator)}, {integer(ratio.denominator)})"
    return f"{start}.plus({integer(offset.numerator)}, {integer(offset.denominator)})" if offset else start


def _codes(operand: Operand) -> Iterator[str]:
    """The condition that the factor's point holds a special code."""
    if operand.codes:
        bands = (interval(*band) for band in sorted(operand.codes))
        yield f"matches!({_raw_of(operand.point)}, {' | '.join(bands)})"


def _step(operand: Operand, *, limit: bool) -> str:
    """The call that puts a factor into a rule."""
    raw, times = _raw_of(operand.point), "limited_by" if limit and not operand.ten_to else "times"
    if operand.floating:
        return f".{'over' if operand.over else times}_f32({raw})"
    if operand.exponents is not None:
        low, high = operand.exponents
        raw = f"runtime::arithmetic::exponent({rust_string(operand.point)}, {raw}, {integer(low)}, {integer(high)})?"
    if (operand.slope, operand.intercept) != (1, 0):
        raw = f"runtime::arithmetic::line({raw}, {integer(operand.slope)}, {integer(operand.intercept)})?"
    return f".{'over' if operand.over else times}{'_ten_to' if operand.ten_to else ''}({raw})"


def _raw_of(name: str) -> str:
    return f"with.{value_name(name)}"
