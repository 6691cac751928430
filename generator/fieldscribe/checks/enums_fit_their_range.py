"""Every entry of an enum can occur: it lies in the range and the type, and it is no special code."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.language.nodes import Map
from fieldscribe.language.numbers import NumberError, parse_integer

if TYPE_CHECKING:
    from fieldscribe.diagnostics import Span
    from fieldscribe.model import Point
    from fieldscribe.resolve.points import Resolved
    from fieldscribe.resolve.subject import Subject

_UNKNOWN = {"type", "bits"}
"""Keys without which nothing is known of a point's numbers."""


def check(subject: Subject) -> None:
    """Entries that the range or the type excludes or that are special codes too, and steps outside the type."""
    for resolved in subject.resolved:
        if not resolved.draft.failed.isdisjoint(_UNKNOWN):
            continue
        shape = resolved.point.shape
        if shape.enum is not None:
            _entries(subject, resolved)
        if shape.specials:
            _specials(subject, resolved)
        for start, _ in resolved.point.terms.steps:
            if not resolved.point.least <= start <= resolved.point.greatest:
                message = f"steps from {start} on lie outside the type, which holds {_held(resolved.point)}"
                hint = "steps are counted in raw numbers"
                subject.report.error("range-outside-type", message, resolved.draft.span("steps"), hint)


def _held(point: Point) -> str:
    return f"{point.least}..{point.greatest}"


def _specials(subject: Subject, resolved: Resolved) -> None:
    """Findings for numbers that are an entry of the enum and a special code."""
    point, draft = resolved.point, resolved.draft
    for entry in point.enum.entries if point.enum is not None else ():
        special = point.special(entry.raw)
        if special is not None:
            place = draft.span("special") if draft.layer("special") is not None else None
            related = [(place, "the special codes")] if place is not None else []
            message = f"{entry.raw} is `{entry.name}` of the enum and the special code `{special.name}`"
            hint = "remove one of them; `special: {code: ~}` takes an inherited code away"
            subject.report.error("special-twice", message, _place(resolved, entry.raw), hint, related)


def _entries(subject: Subject, resolved: Resolved) -> None:
    point, draft = resolved.point, resolved.draft
    least, greatest = point.least, point.greatest
    ranged = draft.layer("range") is not None and "range" not in draft.failed
    for entry in point.enum.entries if point.enum is not None else ():
        if not least <= entry.raw <= greatest:
            message = f"`{entry.name}` is {entry.raw}, outside the type, which holds {_held(point)}"
            hint = "correct the number or the `type`"
            subject.report.error("enum-outside-range", message, _place(resolved, entry.raw), hint)
        elif ranged and not point.allowed.holds(entry.raw) and point.special(entry.raw) is None:
            related = [(draft.span("range"), "the range")]
            message = f"`{entry.name}` is {entry.raw}, which the range does not allow"
            hint = "correct the number or the range; a code beside the numbers goes under `special`"
            subject.report.error("enum-outside-range", message, _place(resolved, entry.raw), hint, related)


def _place(resolved: Resolved, number: int) -> Span:
    node = resolved.draft.get("enum")
    key = next((key for key in node if _is(key, number)), None) if isinstance(node, Map) else None
    return resolved.draft.span("enum") if key is None else node.key_span(key)


def _is(key: str, number: int) -> bool:
    try:
        return parse_integer(key) == number
    except NumberError:
        return False
