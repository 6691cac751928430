"""Every point can exist: its `when` can be true and does not need itself, and `until` does not precede `since`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe import wording
from fieldscribe.checks.meetings import Meetings, clauses
from fieldscribe.existence import ends_before

if TYPE_CHECKING:
    from fieldscribe.checks.subject import Subject
    from fieldscribe.existence import Clause, Domain
    from fieldscribe.model import Point
    from fieldscribe.resolve.points import Resolved

_MOST_SHOWN = 12


def check(subject: Subject) -> None:
    """Comparisons and clauses that nothing in the device can make true, and circles of conditions."""
    _circles(subject)
    meetings = Meetings(subject)
    points = {name: found[0] for name, found in meetings.points.items()}
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
                _never(subject, resolved, meetings, clause, points)


def _circles(subject: Subject) -> None:
    """Findings for conditions in a circle: a point that exists only if another does, and that one only if the first."""
    from graphlib import CycleError, TopologicalSorter

    drafts = {one.point.name: one for one in subject.resolved if one.point.when is not None}
    needs = {name: one.point.when.names for name, one in drafts.items() if one.point.when is not None}
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


def _never(subject: Subject, one: Resolved, meetings: Meetings, clause: Clause, points: dict[str, Point]) -> None:
    """A finding about the first comparison that is never true, or about all of them together."""
    alone = next((part for part in clause if not meetings.possible((part,))), None)
    text = wording.clause_text(clause if alone is None else (alone,), points)
    hint = "one thing has one value at a time: correct the condition, or join its parts with `or`"
    if alone is not None:
        hint = f"`{alone.of}` can be {_shown(meetings.domain(alone.of))}"
    subject.report.error("never-true", f"`{text}` is never true", one.draft.span("when"), hint)


def _shown(domain: Domain) -> str:
    parts = [one if isinstance(one, str) else _band(one) for one in domain[:_MOST_SHOWN]]
    raw = "" if isinstance(domain[0], str) else " (raw)"
    return ", ".join(parts) + (", ..." if len(domain) > _MOST_SHOWN else "") + raw


def _band(band: tuple[int, int]) -> str:
    return f"{band[0]}" if band[0] == band[1] else f"{band[0]}..{band[1]}"
