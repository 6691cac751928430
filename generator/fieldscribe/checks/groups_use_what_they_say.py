"""The `telegram` and the `addressing` of a group apply to points of it."""

from __future__ import annotations

from fractions import Fraction

from fieldscribe.language.formula.normal import evaluate
from fieldscribe.language.formula.parser import parse_expression
from fieldscribe.language.formula.syntax import FormulaError
from fieldscribe.language.nodes import Map
from fieldscribe.resolve.analysis import Analysis
from fieldscribe.resolve.telegrams import SPACE
from fieldscribe.resolve.values import formula_finding

_KNOWN = dict.fromkeys(("number", "index", "set", "sets", "indices"), Fraction(1))


def check(analysis: Analysis) -> None:
    """Report a telegram without points, and an address rule that cannot be read."""
    groups: dict[int, Map] = {}
    with_words: set[int] = set()
    for resolved in analysis.resolved:
        group = resolved.facts.group
        groups.setdefault(id(group), group)
        if resolved.point.space == SPACE or "space" in resolved.facts.failed:
            with_words.add(id(group))
    for key, group in groups.items():
        if "telegram" in group and key not in with_words and SPACE in analysis.scope.family.spaces:
            message = f"no point of the group is a word of the telegram `{group['telegram']}`"
            hint = "write `space: telegram`, or leave `telegram` out"
            analysis.report.error("two-meanings", message, group.key_span("telegram"), hint)
        if "addressing" in group:
            _check_rule(analysis, group)


def _check_rule(analysis: Analysis, group: Map) -> None:
    try:
        evaluate(parse_expression(group["addressing"]), _KNOWN)
    except FormulaError as error:
        if "is not known" in error.message:
            error.hint = "a rule knows number, index, set, sets and indices"
        if "division by zero" not in error.message:  # it was evaluated with ones; the real numbers may be fine
            formula_finding(error, group.span("addressing"), analysis.report)
