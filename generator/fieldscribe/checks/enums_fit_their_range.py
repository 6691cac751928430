"""Named numbers can occur: enum entries lie inside the range and the type, special codes inside the type."""

from __future__ import annotations

from fieldscribe.checks.subject import Subject
from fieldscribe.language.nodes import Map
from fieldscribe.model import Interval
from fieldscribe.resolve.points import Resolved


def check(subject: Subject) -> None:
    """Entries and special codes that the range or the type excludes, and steps outside the type."""
    for resolved in subject.resolved:
        point = resolved.point
        if point.enum is not None:
            _entries(subject, resolved)
        for special in point.specials:
            if special.low < point.least or special.high > point.greatest:
                message = (
                    f"the special code {special.low} lies outside the type, which holds {point.least}..{point.greatest}"
                )
                key = "no_value" if special.no_value else "special"
                subject.report.error(
                    "range-outside-type", message, resolved.draft.span(key), "correct the code or the `type`"
                )


def _entries(subject: Subject, resolved: Resolved) -> None:
    point, draft = resolved.point, resolved.draft
    assert point.enum is not None
    raw = draft.get("enum")
    ranged = draft.layer("range") is not None
    for entry in point.enum.entries:
        key = (
            next((key for key in raw if isinstance(raw, Map) and _is(key, entry.raw)), None)
            if isinstance(raw, Map)
            else None
        )
        span = raw.key_span(key) if isinstance(raw, Map) and key is not None else draft.span("enum")
        if not point.least <= entry.raw <= point.greatest:
            message = f"`{entry.name}` is {entry.raw}, outside the type, which holds {point.least}..{point.greatest}"
            subject.report.error("enum-outside-range", message, span, "correct the number or the `type`")
        elif ranged and not any(_inside(entry.raw, one) for one in point.allowed.intervals):
            related = [(draft.span("range"), "the range")]
            message = f"`{entry.name}` is {entry.raw}, which the range does not allow"
            subject.report.error("enum-outside-range", message, span, "correct the number or the range", related)


def _is(key: str, number: int) -> bool:
    from fieldscribe.language.numbers import NumberError, parse_integer

    try:
        return parse_integer(key) == number
    except NumberError:
        return False


def _inside(number: int, interval: Interval) -> bool:
    low = interval.low if isinstance(interval.low, int) else interval.low.least
    high = interval.high if isinstance(interval.high, int) else interval.high.greatest
    return low <= number <= high
