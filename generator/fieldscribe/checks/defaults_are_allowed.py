"""The factory setting of a point can be written to it."""

from __future__ import annotations

from fieldscribe.checks.subject import Subject
from fieldscribe.model import Point


def check(subject: Subject) -> None:
    """Defaults that the range excludes."""
    for resolved in subject.resolved:
        point = resolved.point
        if point.default is None or point.info.floating:
            continue
        exact = point.default
        if point.scale is not None:
            if len(point.scale) > 1 or point.scale[0].rule.factors:
                continue
            exact = exact * point.scale[0].rule.ratio + point.scale[0].rule.offset
        if exact.denominator != 1 or not _allowed(point, exact.numerator):
            message = f"the default {point.default} is no value that the range allows"
            subject.report.error(
                "default-outside-range",
                message,
                resolved.draft.span("default"),
                "defaults are in the unit; correct it or the range",
            )


def _allowed(point: Point, raw: int) -> bool:
    for one in point.allowed.intervals:
        low = one.low if isinstance(one.low, int) else one.low.least
        high = one.high if isinstance(one.high, int) else one.high.greatest
        if low <= raw <= high:
            return True
    return False
