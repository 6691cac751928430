"""Scales and limits that need other points, as Rust expressions over the runtime's `Rule`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.targets.rust.layout import chained, filled
from fieldscribe.targets.rust.literals import integer, value_name

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from fieldscribe.model import Bound, Factor, Limit, Linear, Point

    Points = Mapping[str, Point]

Lines = tuple[str, ...]


def rule_lines(point: Point, points: Points) -> Lines:
    """The rule that holds now: the cases in their order, up to one that always holds."""
    otherwise = "Err(runtime::Error::NoCase(None))"
    found: list[tuple[str, list[str], str]] = []
    for case in point.scale or ():
        result = rule_of(case.rule, points)
        if case.point is None:
            otherwise = result
            break
        raw, code = f"runtime::Raw::to_i64({_raw_of(case.point)})", integer(case.raw or 0)
        if found and (found[-1][0], found[-1][2]) == (raw, result):
            found[-1][1].append(code)
        else:
            found.append((raw, [code], result))
    if not found:
        return chained(otherwise)
    arms = (line for one in found for line in _arm(*one))
    return "match () {", *arms, f"    () => {otherwise},", "}"


def _arm(raw: str, codes: list[str], result: str) -> Iterator[str]:
    """An arm of a match over nothing, by whether a raw number is one of these codes."""
    yield from (f"    {line}" for line in filled(f"() if matches!({raw}, ", " | ", codes, ") => {"))
    yield from (f"        {line}" for line in chained(result))
    yield "    }"


def rule_of(rule: Linear, points: Points) -> str:
    """A scale with its factors; where one is a special code there is no number to compute with."""
    factors = _in_order(rule)
    codes = [code for factor in factors for code in _codes(factor, points)]
    steps = [f".unless({' || '.join(codes)})"] if codes else []
    steps += [_step(factor, points, limit=False) for factor in factors]
    return _start(rule) + "?".join(steps) if steps else f"Ok({_start(rule)})"


def limit_lines(limit: Limit, points: Points, *, lower: bool) -> Lines:
    """A limit as a raw number within its outermost bound, which holds where a code sets the limit aside."""
    steps = "?".join(_step(factor, points, limit=True) for factor in _in_order(limit.rule))
    bound = integer(outer(limit, lower=lower))
    found = f"{_start(limit.rule)}{steps}{'?' if steps else ''}.limit()?.{'max' if lower else 'min'}({bound})"
    aside = [
        f"matches!(runtime::Raw::to_i64({_raw_of(name)}), {' | '.join(interval(*band) for band in codes)})"
        for name, codes in limit.unless
        if codes
    ]
    if not aside:
        return chained(found)
    head = filled("if ", " || ", aside, " {")
    return *head, f"    {bound}", "} else {", *(f"    {line}" for line in chained(found)), "}"


def interval(low: int, high: int) -> str:
    """A pattern for the numbers from `low` to `high`."""
    return integer(low) if low == high else f"{integer(low)}..={integer(high)}"


def outer(bound: Bound, *, lower: bool) -> int:
    """The number that a bound never goes beyond."""
    if isinstance(bound, int):
        return bound
    return bound.least if lower else bound.greatest


def _start(rule: Linear) -> str:
    ratio, offset = rule.ratio, rule.offset
    start = f"runtime::Rule::new({integer(ratio.numerator)}, {integer(ratio.denominator)})"
    return f"{start}.plus({integer(offset.numerator)}, {integer(offset.denominator)})" if offset else start


def _in_order(rule: Linear) -> list[Factor]:
    """Exponents last: a zero factor is reported before an exponent that is out of its bounds."""
    return sorted(rule.factors, key=lambda factor: factor.ten_to)


def _codes(factor: Factor, points: Points) -> Iterator[str]:
    """The condition under which the factor's point holds a special code."""
    source = points.get(factor.point)
    if source is not None and source.specials:
        bands = sorted((one.low, one.high) for one in source.specials)
        yield f"matches!({_raw_of(factor.point)}, {' | '.join(interval(*band) for band in bands)})"


def _step(factor: Factor, points: Points, *, limit: bool) -> str:
    """The call that puts a factor into a rule."""
    source, raw = points.get(factor.point), _raw_of(factor.point)
    times = "limited_by" if limit else "times"
    if source is not None and source.type == "f32":
        return f".{times if factor.power > 0 else 'over'}_f32({raw})"
    if factor.ten_to and source is not None:
        low, high = factor.exponents or source.outer
        raw = f"runtime::arithmetic::exponent({raw}, {integer(low)}, {integer(high)})?"
    if (factor.slope, factor.intercept) != (1, 0):
        raw = f"runtime::arithmetic::line({raw}, {integer(factor.slope)}, {integer(factor.intercept)})?"
    if factor.ten_to:
        raw = raw if raw.endswith("?") else f"runtime::Raw::to_i64({raw})"
        return f".{'times' if factor.power > 0 else 'over'}_ten_to({raw})"
    return f".{times if factor.power > 0 else 'over'}({raw})"


def _raw_of(name: str) -> str:
    return f"with.{value_name(name)}"
