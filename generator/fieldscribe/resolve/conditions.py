"""Resolves `when`: from the author's condition to comparisons of raw numbers and of variants."""

from __future__ import annotations

from fractions import Fraction
from math import ceil, floor

from fieldscribe import conditions
from fieldscribe.conditions import Condition
from fieldscribe.language.formula.conditions import Comparison, Constant, parse_condition, wrong_number
from fieldscribe.language.formula.normal import Affine
from fieldscribe.language.formula.suggestions import suggest_condition
from fieldscribe.language.formula.syntax import FormulaError
from fieldscribe.resolve.point_facts import PointFacts
from fieldscribe.resolve.scales import Scales
from fieldscribe.resolve.scope import Scope
from fieldscribe.resolve.values import FactError, Written, formula_finding
from fieldscribe.resolve.word_contents import enum_of

_TURNED = {"<": ">", "<=": ">=", ">": "<", ">=": "<="}
"""The test of raw numbers for a test of values, if raw numbers fall while the value rises."""


def condition_of(scope: Scope, facts: PointFacts, scales: Scales) -> Condition | None:
    """Return the condition for the point to exist; None if it always does, or after a finding."""
    text = facts.get("when")
    if text is None:
        return None
    written = Written(text, facts.span("when"))
    try:
        stated = parse_condition(text)
    except FormulaError as error:
        suggestion = suggest_condition(text)
        error.hint = f"write `{suggestion}`" if suggestion else error.hint
        formula_finding(error, written.span, scope.report)
        stated = ()
    resolved = {
        comparison: _resolved(scope, facts, scales, comparison, written) for clause in stated for comparison in clause
    }
    clauses = tuple(
        [tuple([result for comparison in clause if (result := resolved[comparison]) is not None]) for clause in stated]
    )
    if stated and None not in resolved.values():
        return Condition(clauses)
    facts.failed.add("when")
    return None


def _resolved(
    scope: Scope, facts: PointFacts, scales: Scales, comparison: Comparison, written: Written
) -> conditions.Comparison | None:
    """Return a comparison as the model has it; None after a finding."""
    try:
        return _comparison(scope, facts, scales, comparison, written)
    except FormulaError as error:
        formula_finding(error, written.span, scope.report)
    except FactError as error:
        error.report(scope.report)
    return None


def _comparison(
    scope: Scope, facts: PointFacts, scales: Scales, comparison: Comparison, written: Written
) -> conditions.Comparison:
    """Return a comparison of whole raw numbers or of a variant. Raises FactError or FormulaError."""
    name = comparison.name.name
    if name in scope.axes:
        values = [_value(scope, name, constant, written) for constant in comparison.constants]
        return conditions.Comparison(name, comparison.op, tuple(values))
    used = scales.symbols.find(name, facts.variant)
    if used is None:
        scales.symbols.unknown(name, written.of(name), scope.axes)
        raise FactError
    if used.floating:
        message = f"`{name}` is a floating-point number"
        raise FormulaError(message, comparison.name.column, "a condition compares whole numbers and names")
    if used.name == facts.name:
        raise FormulaError(
            f"`{name}` cannot say itself whether it exists", comparison.name.column, "name another point"
        )
    rule = scales.affine(facts, name, comparison.name.part, written)
    raws = [_raw(scope, used, rule, constant, written) for constant in comparison.constants]
    test = _TURNED.get(comparison.op, comparison.op) if rule.slope < 0 else comparison.op
    return _with_whole_numbers(rule.point, test, raws, comparison)


def _value(scope: Scope, axis: str, constant: Constant, written: Written) -> str:
    """Return the value of a variant axis that a constant names; it may consist of digits."""
    values = scope.axes[axis]["values"]
    if constant.text not in values:
        place = written.span.moved(constant.column)
        scope.unknown("variant", constant.text, place, [*values])
        raise FactError
    return constant.text


def _raw(scope: Scope, used: PointFacts, rule: Affine, constant: Constant, written: Written) -> Fraction:
    """Return the raw number of a constant: of a number, or of a name in the enum of the point."""
    if not isinstance(constant.value, str):
        return (constant.value - rule.intercept) / rule.slope
    if constant.value[0].isdigit():
        raise wrong_number(constant.value, constant.column)
    enum = None if used.text else enum_of(scope, used, closed=True)
    entries = {} if enum is None else {entry.name: entry.raw for entry in enum.entries}
    if constant.value in entries:
        return Fraction(entries[constant.value])
    place = written.span.moved(constant.column)
    hint = None if entries else f"`{used.name}` has no names: compare it with numbers"
    scope.unknown("entry", constant.value, place, entries, hint)
    raise FactError


def _with_whole_numbers(point: str, test: str, raws: list[Fraction], comparison: Comparison) -> conditions.Comparison:
    """Return the same comparison with whole numbers: `raw < 2.5` becomes `raw <= 2`."""
    broken = next((place for place, raw in enumerate(raws) if raw.denominator != 1), None)
    if broken is None:
        return conditions.Comparison(point, test, tuple([raw.numerator for raw in raws]))
    if test in ("<", "<="):
        return conditions.Comparison(point, "<=", (floor(raws[0]),))
    if test in (">", ">="):
        return conditions.Comparison(point, ">=", (ceil(raws[0]),))
    column = comparison.constants[broken].column
    raise FormulaError(f"`{comparison.name.name}` is never just that: it moves in steps", column, "compare with < or >")
