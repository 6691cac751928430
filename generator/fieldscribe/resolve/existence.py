"""`when`: from the author's condition to comparisons of raw numbers and of variants."""

from __future__ import annotations

from fractions import Fraction
from math import ceil, floor
from typing import TYPE_CHECKING

from fieldscribe import existence
from fieldscribe.existence import Condition
from fieldscribe.language.formula import Comparison, FormulaError, clauses_of, parse_condition, wrong_number
from fieldscribe.resolve.enums import enum_of
from fieldscribe.resolve.rules import Scales, UnknownError
from fieldscribe.resolve.values import Written, formula_finding

if TYPE_CHECKING:
    from fieldscribe.language.formula import Affine, Constant
    from fieldscribe.resolve.drafts import Draft
    from fieldscribe.resolve.scope import Scope

_TURNED = {"<": ">", "<=": ">=", ">": "<", ">=": "<="}


def existence_of(scope: Scope, draft: Draft, scales: Scales) -> Condition | None:
    """When the point exists; None for always, or after a finding."""
    text = draft.get("when")
    if text is None:
        return None
    written = Written(text, draft.span("when"))
    try:
        said = clauses_of(parse_condition(text))
    except FormulaError as error:
        formula_finding(error, written.span, scope.report)
        said = ()
    found = {one: _resolved(scope, draft, scales, one, written) for clause in said for one in clause}
    clauses = tuple([tuple([one for each in clause if (one := found[each]) is not None]) for clause in said])
    if said and None not in found.values():
        return Condition(clauses)
    draft.failed.add("when")
    return None


def _resolved(
    scope: Scope, draft: Draft, scales: Scales, one: Comparison, written: Written
) -> existence.Comparison | None:
    """One comparison as the model has it; None after a finding."""
    try:
        return _comparison(scope, draft, scales, one, written)
    except FormulaError as error:
        formula_finding(error, written.span, scope.report)
    except UnknownError:
        pass
    return None


def _comparison(scope: Scope, draft: Draft, scales: Scales, one: Comparison, written: Written) -> existence.Comparison:
    """One comparison in whole raw numbers, or of a variant. Raises UnknownError after a finding, else FormulaError."""
    name = one.name.name
    if name in scope.axes:
        return existence.Comparison(name, one.op, tuple([_value(scope, name, each, written) for each in one.constants]))
    used = scales.index.find(name, draft.variant)
    if used is None:
        scales.index.unknown(name, written.of(name), scope.axes)
        raise UnknownError
    if used.floating:
        message = f"`{name}` is a floating-point number"
        raise FormulaError(message, one.name.column, "a condition compares whole numbers and names")
    if used.name == draft.name:
        raise FormulaError(f"`{name}` cannot say itself whether it exists", one.name.column, "name another point")
    rule = scales.affine(draft, name, one.name.part, written)
    raws = [_raw(scope, used, rule, each, written) for each in one.constants]
    return _whole(rule.point, _TURNED.get(one.op, one.op) if rule.slope < 0 else one.op, raws, one)


def _value(scope: Scope, axis: str, given: Constant, written: Written) -> str:
    """The value of an axis that a constant names, in digits too."""
    values = scope.axes[axis]["values"]
    if given.text not in values:
        place = written.span._replace(column=written.span.column + given.column)
        scope.unknown("variant", given.text, place, [*values])
        raise UnknownError
    return given.text


def _raw(scope: Scope, used: Draft, rule: Affine, given: Constant, written: Written) -> Fraction:
    """The raw number that a constant means: a number, or a name in the enum of the point."""
    if not isinstance(given.value, str):
        return (given.value - rule.intercept) / rule.slope
    if given.value[0].isdigit():
        raise wrong_number(given.value, given.column)
    enum = None if used.text else enum_of(scope, used, closed=True)
    entries = {} if enum is None else {entry.name: entry.raw for entry in enum.entries}
    if given.value in entries:
        return Fraction(entries[given.value])
    place = written.span._replace(column=written.span.column + given.column)
    hint = None if entries else f"`{used.name}` has no names: compare it with numbers"
    scope.unknown("entry", given.value, place, entries, hint)
    raise UnknownError


def _whole(point: str, test: str, raws: list[Fraction], one: Comparison) -> existence.Comparison:
    """The comparison with whole raw numbers that is true of the same ones."""
    broken = next((place for place, raw in enumerate(raws) if raw.denominator != 1), None)
    if broken is None:
        return existence.Comparison(point, test, tuple([raw.numerator for raw in raws]))
    if test in ("<", "<="):
        return existence.Comparison(point, "<=", (floor(raws[0]),))
    if test in (">", ">="):
        return existence.Comparison(point, ">=", (ceil(raws[0]),))
    column = one.constants[broken].column
    raise FormulaError(f"`{one.name.name}` is never just that: it moves in steps", column, "compare with < or >")
