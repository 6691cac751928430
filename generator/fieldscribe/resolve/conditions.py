"""Resolves `when`: from the author's condition to comparisons of raw numbers and of variants."""

from fractions import Fraction
from math import ceil, floor

from fieldscribe import conditions
from fieldscribe.conditions import (
    ANY,
    Clause,
    Clauses,
    Condition,
    TooManyClausesError,
    all_of,
    any_of,
    ends_before,
    opposite,
    possible,
    version_of,
)
from fieldscribe.language.formula.conditions import (
    EXISTS,
    NOT_EXISTS,
    Comparison,
    Constant,
    parse_condition,
    wrong_number,
)
from fieldscribe.language.formula.normal import Affine
from fieldscribe.language.formula.suggestions import suggest_condition
from fieldscribe.language.formula.syntax import FormulaError
from fieldscribe.language.numbers import integer_in
from fieldscribe.resolve.point_facts import PointFacts
from fieldscribe.resolve.scales import Scales
from fieldscribe.resolve.scope import Scope
from fieldscribe.resolve.values import FactError, Written, formula_finding
from fieldscribe.resolve.word_contents import enum_of

_MOST_STEPS = 16
"""The longest chain of points whose existence depends on the next one."""

_TURNED = {"<": ">", "<=": ">=", ">": "<", ">=": "<="}
"""The test of the raw number for each test of the value, if the raw number falls as the value rises."""


def condition_of(facts: PointFacts, scales: Scales) -> Condition | None:
    """Return the condition for the point to exist; None if it always does, or after a finding."""
    if not facts.conditions:
        return None
    clauses = _clauses_of(facts, scales, (facts,))
    if clauses:
        return Condition(clauses)
    facts.failed.add("when")
    return None


def _clauses_of(facts: PointFacts, scales: Scales, asking: tuple[PointFacts, ...]) -> Clauses:
    """Return the clauses of a point's conditions; none after a finding. `asking` are the points that need them."""
    parts = [_clauses(facts, scales, key, Written(text, facts.span(key)), asking) for text, key in facts.conditions]
    try:
        return all_of(parts)
    except TooManyClausesError as error:
        formula_finding(FormulaError(str(error), 0, "simplify it"), facts.span("when"), scales.symbols.scope.report)
        return ()


def _clauses(facts: PointFacts, scales: Scales, key: str, written: Written, asking: tuple[PointFacts, ...]) -> Clauses:
    """Return the clauses of a condition under a key; none after a finding."""
    text, report = written.text, scales.symbols.scope.report
    try:
        stated = parse_condition(text)
        if key == "select" and [len(clause) for clause in stated] != [1]:
            raise FormulaError("a selection compares once", 0)
    except FormulaError as error:
        if key == "select":
            hint = "write the name of the point alone, and a number, a name of it or a formula: `select: {page: 3}`"
            report.error("bad-formula", "this is not a point with what it must hold", written.span, hint)
            return ()
        suggestion = suggest_condition(text)
        error.hint = f"write `{suggestion}`" if suggestion else error.hint
        formula_finding(error, written.span, report)
        return ()
    comparisons = dict.fromkeys(comparison for clause in stated for comparison in clause)
    resolved = {each: _resolved(facts, scales, each, written, asking) for each in comparisons}
    if not all(resolved.values()):
        return ()
    try:
        clauses = any_of([all_of([resolved[comparison] for comparison in clause]) for clause in stated])
    except TooManyClausesError as error:
        formula_finding(FormulaError(str(error), 0, "simplify it"), written.span, report)
        return ()
    if any(comparison.op in (EXISTS, NOT_EXISTS) for comparison in comparisons):
        return tuple(clause for clause in clauses if not _contradicts_itself(clause)) or clauses
    return clauses


def _contradicts_itself(clause: Clause) -> bool:
    """Return True if comparisons of raw numbers exclude each other, as the conditions of several points may do."""
    return not possible((each for each in clause if isinstance(each.than[0], int)), lambda _: ANY)


def _resolved(
    facts: PointFacts, scales: Scales, comparison: Comparison, written: Written, asking: tuple[PointFacts, ...]
) -> Clauses:
    """Return a comparison as the model has it, as clauses; none after a finding."""
    scope = scales.symbols.scope
    try:
        if comparison.op in (EXISTS, NOT_EXISTS):
            clauses = _existence(scales, comparison, written, asking)
            return clauses if comparison.op == EXISTS else opposite(clauses)
        return ((_comparison(scope, facts, scales, comparison, written),),)
    except FormulaError as error:
        formula_finding(error, written.span, scope.report)
    except TooManyClausesError as error:
        formula_finding(FormulaError(str(error), comparison.column, "simplify it"), written.span, scope.report)
    except FactError as error:
        error.report(scope.report)
    return ()


def _existence(scales: Scales, comparison: Comparison, written: Written, asking: tuple[PointFacts, ...]) -> Clauses:
    """Return when another point exists: in its variants, under its own condition. Raises FactError or FormulaError."""
    name, column = comparison.name.name, comparison.name.column
    points = scales.symbols.all(name)
    if not points:
        scales.symbols.unknown(name, written.of(name))
        raise FactError
    if len(asking) > _MOST_STEPS:
        message = f"`{name}` exists under more than {_MOST_STEPS} conditions, each naming the next"
        raise FormulaError(message, column, "compare what the first of them compares")
    if any(point in asking for point in points):
        raise FormulaError(f"`{name}` exists under a condition that leads back to itself", column, "write it out")
    versions = next((key for point in points for key in ("since", "until") if _is_open(key, point, asking[0])), None)
    if versions is not None:
        raise FormulaError(
            f"`{name}` has `{versions}`, which no condition can tell", column, f"write `{versions}` at this point, too"
        )
    if any(point.variant is None and not point.conditions for point in points):
        raise FormulaError(f"`{name}` always exists", column, "leave this out, or name a point that has `when`")
    parts = [_clauses_of_point(scales, point, (*asking, point)) for point in points]
    if not all(parts):
        raise FactError
    return any_of(parts)


def _is_open(key: str, point: PointFacts, asking: PointFacts) -> bool:
    """Return True if a point has a first or last version, and the point that names it exists in others too."""
    version, mine = point.get(key), asking.get(key)
    if version is None:
        return False
    first, last = (version, mine) if key == "since" else (mine, version)
    words = [found and found[0] for found in (version_of(version), version_of(mine or ""))]
    return words[0] != words[1] or ends_before(last, first)


def _clauses_of_point(scales: Scales, point: PointFacts, asking: tuple[PointFacts, ...]) -> Clauses:
    clauses = _clauses_of(point, scales, asking)
    variant = point.variant
    of_variant = () if variant is None else (conditions.Comparison(variant.axis, "==", (variant.value,)),)
    return tuple(of_variant + clause for clause in clauses)


def _comparison(
    scope: Scope, facts: PointFacts, scales: Scales, comparison: Comparison, written: Written
) -> conditions.Comparison:
    """Return a comparison of whole raw numbers or of a variant. Raises FactError or FormulaError."""
    name = comparison.name.name
    if name in scope.axes:
        if comparison.key:
            return _by_property(scope, comparison)
        values = [_value(scope, name, constant, written) for constant in comparison.constants]
        return conditions.Comparison(name, comparison.op, tuple(values))
    if comparison.key:
        message = f"`{name}.{comparison.key}`: a point has `.raw` and `.value` only"
        hint = "leave it out; a single bit or flag is a point of its own, with `bits`"
        raise FormulaError(message, comparison.name.column, hint)
    used = scales.symbols.find(name, facts)
    if used is None:
        scales.symbols.unknown(name, written.of(name), scope.axes)
        raise FactError
    if used.floating:
        message = f"`{name}` is a floating-point number"
        raise FormulaError(message, comparison.name.column, "a condition compares whole numbers and names")
    if used.name == facts.name:
        raise FormulaError(
            f"the condition of `{name}` cannot name the point itself", comparison.name.column, "name another point"
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


def _by_property(scope: Scope, comparison: Comparison) -> conditions.Comparison:
    """Return which variants have a property that makes the comparison true. Raises FormulaError."""
    axis, key, column = comparison.name.name, comparison.key, comparison.name.column
    stated = {value: facts[key] for value, facts in scope.axes[axis]["values"].items() if key in facts}
    if not stated:
        raise FormulaError(f"no variant of `{axis}` has a property `{key}`", column, "write it at its values")
    than = tuple(_whole(constant.value) for constant in comparison.constants)
    test = conditions.Comparison(axis, comparison.op, than)  # type: ignore[arg-type]  # words or numbers
    fitting = [value for value, text in stated.items() if test.holds(_whole(text))]
    if not fitting:
        raise FormulaError(f"no variant of `{axis}` makes this true", column, "correct the property or the constant")
    return conditions.Comparison(axis, "in", tuple(fitting))


def _whole(stated: Fraction | str | int) -> int | str:
    """Return a property or a constant as a whole number, else as a word."""
    number = integer_in(stated)
    return str(stated) if number is None else number


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
