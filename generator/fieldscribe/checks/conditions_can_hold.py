"""Every point can exist: its `when` can be true without depending on itself, and `until` does not precede `since`."""

from fieldscribe import wording
from fieldscribe.checks.coexistence import Coexistence, clauses
from fieldscribe.conditions import Clause, Domain, ends_before
from fieldscribe.resolve.analysis import Analysis
from fieldscribe.resolve.points import ResolvedPoint
from fieldscribe.wording.rules import band_text

_MOST_SHOWN = 12


def check(analysis: Analysis) -> None:
    """Report comparisons and clauses that can never be true, and conditions that need each other."""
    _circles(analysis)
    coexistence = Coexistence(analysis)
    known: dict[Clause, bool] = {}
    rows: set[int] = set()
    for resolved in analysis.resolved:
        point = resolved.point
        if ends_before(point.until, point.since):
            message = f"`{point.name}` ends with {point.until}, before it begins with {point.since}"
            hint = "`since` is the first firmware that has it, `until` the last"
            analysis.report.error("never-true", message, resolved.facts.span("until"), hint)
        if point.when is None or analysis.report.full:
            continue
        for clause in clauses(point):
            if clause not in known:
                known[clause] = coexistence.possible(clause)
            if not known[clause] and id(resolved.facts.node) not in rows:
                _report_never_true(analysis, resolved, coexistence, clause)
                rows.update([id(resolved.facts.node)] if resolved.facts.element else [])


def _circles(analysis: Analysis) -> None:
    """Report conditions in a circle, such as two points of which each exists only if the other does."""
    from graphlib import CycleError, TopologicalSorter

    expanded = {resolved.point.name: resolved for resolved in analysis.resolved if resolved.point.when is not None}
    needs = {name: resolved.point.when.names for name, resolved in expanded.items() if resolved.point.when is not None}
    while needs and not analysis.report.full:
        try:
            TopologicalSorter(needs).prepare()
        except CycleError as error:
            circle: list[str] = error.args[1][::-1]
            message = f"a condition that needs itself: {' needs '.join(f'`{name}`' for name in circle)}"
            hint = "break the circle: one of them exists whatever the others hold"
            analysis.report.error("condition-cycle", message, expanded[circle[0]].facts.span("when"), hint)
            needs = {name: others for name, others in needs.items() if name not in circle}
        else:
            return


def _report_never_true(analysis: Analysis, resolved: ResolvedPoint, coexistence: Coexistence, clause: Clause) -> None:
    """Report the first comparison that is never true, or all of them together."""
    points = {name: points_of_name[0] for name, points_of_name in coexistence.points.items()}
    alone = next((part for part in clause if not coexistence.possible((part,))), None)
    text = wording.clause_text(clause if alone is None else (alone,), points)
    hint = "a point has one value at a time: correct the condition, or join its parts with `or`"
    if alone is not None:
        hint = f"`{alone.of}` can be {_domain_text(coexistence.domain(alone.of))}"
    is_selection = alone is not None and (alone.of, alone.than[0]) in resolved.point.selects
    place = resolved.facts.span("select" if is_selection else "when")
    analysis.report.error("never-true", f"`{text}` is never true", place, hint)


def _domain_text(domain: Domain) -> str:
    parts = [part if isinstance(part, str) else band_text(part) for part in domain[:_MOST_SHOWN]]
    raw = "" if isinstance(domain[0], str) else " (raw)"
    return ", ".join(parts) + (", ..." if len(domain) > _MOST_SHOWN else "") + raw
