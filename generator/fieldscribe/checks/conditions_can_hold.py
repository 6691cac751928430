"""Every point can exist: its `when` can be true and does not need itself, and `until` does not precede `since`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe import wording
from fieldscribe.checks.meetings import Meetings, clauses
from fieldscribe.existence import ends_before

if TYPE_CHECKING:
    from fieldscribe.existence import Clause, Domain
    from fieldscribe.resolve.points import Resolved
    from fieldscribe.resolve.subject import Subject

_MOST_SHOWN = 12


def check(subject: Subject) -> None:
    """Comparisons and clauses that nothing in the device can make true, and circles of conditions."""
    _circles(subject)
    meetings = Meetings(subject)
    known: dict[Clause, bool] = {}
    for resolved in subject.resolved:
        point = resolved.point
        if ends_before(point.until, point.since):
            message = f"`{point.name}` ends with {point.until}, before it comes with {point.since}"
            hint = "`since` is the first firmware that has it, `until` the last"
            subject.report.error("never-true", message, resolved.draft.span("until"), hint)
        if point.when is None or subject.report.full:
            continue
        for clause in clauses(point):
            if clause not in known:
                known[clause] = meetings.possible(clause)
            if not known[clause]:
                _report_never_true(subject, resolved, meetings, clause)


def _circles(subject: Subject) -> None:
    """Findings for conditions in a circle: two points of which each exists only if the other does."""
    from graphlib import CycleError, TopologicalSorter

    drafts = {resolved.point.name: resolved for resolved in subject.resolved if resolved.point.when is not None}
    needs = {name: resolved.point.when.names for name, resolved in drafts.items() if resolved.point.when is not None}
    while needs and not subject.report.full:
        try:
            TopologicalSorter(needs).prepare()
        except CycleError as error:
            circle: list[str] = error.args[1][::-1]
            message = f"a condition that needs itself: {' needs '.join(f'`{name}`' for name in circle)}"
            hint = "break the circle: one of them exists whatever the others hold"
            subject.report.error("condition-cycle", message, drafts[circle[0]].draft.span("when"), hint)
            needs = {name: others for name, others in needs.items() if name not in circle}
        else:
            return


def _report_never_true(subject: Subject, resolved: Resolved, meetings: Meetings, clause: Clause) -> None:
    """A finding about the first comparison that is never true, or about all of them together."""
    points = {name: points_of_name[0] for name, points_of_name in meetings.points.items()}
    alone = next((part for part in clause if not meetings.possible((part,))), None)
    text = wording.clause_text(clause if alone is None else (alone,), points)
    hint = "one thing has one value at a time: correct the condition, or join its parts with `or`"
    if alone is not None:
        hint = f"`{alone.of}` can be {_shown(meetings.domain(alone.of))}"
    subject.report.error("never-true", f"`{text}` is never true", resolved.draft.span("when"), hint)


def _shown(domain: Domain) -> str:
    parts = [part if isinstance(part, str) else _band(part) for part in domain[:_MOST_SHOWN]]
    raw = "" if isinstance(domain[0], str) else " (raw)"
    return ", ".join(parts) + (", ..." if len(domain) > _MOST_SHOWN else "") + raw


def _band(band: tuple[int, int]) -> str:
    return f"{band[0]}" if band[0] == band[1] else f"{band[0]}..{band[1]}"
