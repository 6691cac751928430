"""The `telegram` or `message`, the `block` and the `addressing` of a group apply to some of its points."""

from fractions import Fraction

from fieldscribe.language.formula.syntax import ZeroDivisorError
from fieldscribe.language.nodes import Map
from fieldscribe.resolve.addresses import RULE_KNOWS
from fieldscribe.resolve.analysis import Analysis
from fieldscribe.resolve.bus import KEY_OF
from fieldscribe.resolve.values import FactError, formula_value

_WORD = {"telegram": "word", "signal": "signal"}
_KNOWN = dict.fromkeys(("number", "index", "set", "sets", "indices"), Fraction(1))


def check(analysis: Analysis) -> None:
    """Report a telegram or message without points, points outside their block, and a rule that cannot be evaluated."""
    groups: dict[int, Map] = {}
    used: set[tuple[int, str]] = set()
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
        spaces = KEY_OF if "space" in resolved.facts.failed else (resolved.point.space,)
        used.update((id(group), space) for space in spaces)
    for number, group in groups.items():
        for space, key in KEY_OF.items():
            if key in group and (number, space) not in used and space in analysis.scope.family.spaces:
                message = f"no point of the group is a {_WORD[space]} of the {key} `{group[key]}`"
                hint = f"write `space: {space}`, or leave `{key}` out"
                analysis.report.error("two-meanings", message, group.key_span(key), hint)
        if "addressing" in group:
            _check_rule(analysis, group)


def _check_rule(analysis: Analysis, group: Map) -> None:
    try:
        formula_value(group["addressing"], _KNOWN, group.span("addressing"), RULE_KNOWS)
    except FactError as error:
        if not isinstance(error.__cause__, ZeroDivisorError):  # it was evaluated with 1 for every name
            error.report(analysis.report)
