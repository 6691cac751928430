"""The factory setting: raw, by name, or in the unit; each follows from the other where no other point is needed."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

from fieldscribe.language.numbers import NumberError, parse_number
from fieldscribe.model import Linear
from fieldscribe.resolve.values import integer, number

if TYPE_CHECKING:
    from fieldscribe.model import Shape
    from fieldscribe.resolve.point_facts import PointFacts
    from fieldscribe.resolve.scope import Scope

_MOST_NAMES = 12
_PLAIN = Linear(Fraction(1), Fraction(0), ())


def default_of(scope: Scope, facts: PointFacts, shape: Shape) -> tuple[Fraction | None, int | None]:
    """The factory setting in the unit and as raw number; None where it is not given or depends on other points."""
    if facts.text:
        return None, None
    rule = None if facts.floating else _rule(facts, shape)
    if facts.layer("default_in_units") is not None:
        value = number(facts.get("default_in_units"), facts.span("default_in_units"), scope.report)
        exact = None if value is None or rule is None else rule.at(value)
        return value, exact.numerator if exact is not None and exact.denominator == 1 else None
    raw = None if facts.layer("default") is None else _raw(scope, facts, shape)
    return None if raw is None or rule is None else (raw - rule.offset) / rule.ratio, raw


def _raw(scope: Scope, facts: PointFacts, shape: Shape) -> int | None:
    """The raw number that `default` says; None after a finding."""
    default, span, enum = facts.get("default"), facts.span("default"), shape.enum
    if facts.floating:
        message = "`default` is in raw numbers, which are bit patterns here"
        scope.report.error("float-fact", message, span, f"write `default_in_units: {default}`")
        return None
    named = {special.name: special.low for special in shape.specials if special.low == special.high}
    named |= {entry.name: entry.raw for entry in (() if enum is None else enum.entries)}
    if default in named:
        return named[default]
    if isinstance(default, str) and enum is not None and default.isidentifier():
        if "enum" in facts.failed:
            return None  # it may be one of the names that could not be read
        hint = f"write a number, or one of {', '.join(entry.name for entry in enum.entries[:_MOST_NAMES])}"
        scope.report.error("bad-number", f"`{default}` is no name of this enum", span, hint)
        return None
    if _has_a_fraction(default):
        message = f"`{default}` has a decimal point, and `default` is in raw numbers"
        scope.report.error("bad-number", message, span, f"write `default_in_units: {default}`, or the raw number")
        return None
    return integer(default, span, scope.report)


def _has_a_fraction(default: object) -> bool:
    try:
        return isinstance(default, str) and "." in default and parse_number(default) is not None
    except NumberError:
        return False


def _rule(facts: PointFacts, shape: Shape) -> Linear | None:
    """The rule between raw number and value; None where it depends on other points or is not known."""
    if shape.scale is not None:
        return shape.fixed_scale
    unsettled = facts.untyped is not None or (facts.layer("scale") is not None and facts.get("scale") is None)
    return None if unsettled and facts.get("unit") is not None else _PLAIN
