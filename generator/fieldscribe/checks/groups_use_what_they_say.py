"""The `telegram`, the `block` and the `addressing` of a group apply to points of it."""

from __future__ import annotations

from fractions import Fraction

from fieldscribe.language.nodes import Map
from fieldscribe.resolve.addresses import RULE_KNOWS
from fieldscribe.resolve.analysis import Analysis
from fieldscribe.resolve.telegrams import SPACE
from fieldscribe.resolve.values import FactError, formula_value

_KNOWN = dict.fromkeys(("number", "index", "set", "sets", "indices"), Fraction(1))


def check(analysis: Analysis) -> None:
    """Report a telegram without points, points outside of a block, and an address rule that cannot be read."""
    groups: dict[int, Map] = {}
    with_words: set[int] = set()
    for resolved in analysis.resolved:
        group = resolved.facts.group
        groups.setdefault(id(group), group)
        found = analysis.scope.found
        if (
            "block" in group
            and found is not None
            and resolved.point.space != found.space
            and "space" in resolved.facts.node
        ):
            message = (
                f"`{resolved.point.name}` is in no block: those of `{found.name}` are in the space `{found.space}`"
            )
            hint = "write it in another group, or leave `space` out"
            analysis.report.error("two-meanings", message, resolved.facts.span("space"), hint)
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
        formula_value(group["addressing"], _KNOWN, group.span("addressing"), RULE_KNOWS)
    except FactError as error:
        if "division by zero" not in error.args[1]:  # it was evaluated with ones; the real numbers may be fine
            error.report(analysis.report)
