"""Scales and limits that need other points, as Rust expressions over the runtime's `Rule`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.model import Bound, Factor, Limit, Linear, Point
from fieldscribe.targets.rust.literals import integer, value_name

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    Points = Mapping[str, Point]

Lines = tuple[str, ...]


def rule_lines(point: Point, points: Points) -> Lines:
    """The rule that holds now: the cases in their order, up to one that always holds."""
    lines: list[str] = []
    for case in point.scale or ():
        result = rule_of(case.rule, points)
        if case.point is None:
            return (*lines, "{", f"    {result}", "}") if lines else (result,)
        head = f"if runtime::Raw::to_i64({_raw_of(case.point)}) == {integer(case.raw or 0)} {{"
        lines[-1:] = [f"{lines[-1]} {head}" if lines else head]
        lines += [f"    {result}", "} else"]
    return (*lines[:-1], "} else {", "    Err(runtime::Error::NoCase)", "}")


def rule_of(rule: Linear, points: Points) -> str:
    """A scale with its factors; where one is a special code there is no number to compute with."""
    factors = _in_order(rule)
    codes = [code for factor in factors for code in _codes(factor, points)]
    steps = [f".unless({' || '.join(codes)})"] if codes else []
    steps += [_step(factor, points, limit=False) for factor in factors]
    return _start(rule) + "?".join(steps) if steps else f"Ok({_start(rule)})"


def limit_of(limit: Limit, points: Points, *, lower: bool) -> str:
    """A limit as a raw number within its outermost bound, which holds where a code sets the limit aside."""
    steps = "?".join(_step(factor, points, limit=True) for factor in _in_order(limit.rule))
    bound = integer(outer(limit, lower=lower))
    found = f"{_start(limit.rule)}{steps}{'?' if steps else ''}.limit()?.{'max' if lower else 'min'}({bound})"
    aside = [
        f"matches!(runtime::Raw::to_i64({_raw_of(name)}), {' | '.join(interval(*band) for band in codes)})"
        for name, codes in limit.unless
        if codes
    ]
    return f"if {' || '.join(aside)} {{ {bound} }} else {{ {found} }}" if aside else found


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
