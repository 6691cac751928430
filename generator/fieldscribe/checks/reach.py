"""Findings for points that no frame of the device can read or write."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING

from fieldscribe.resolve.telegrams import SPACE

if TYPE_CHECKING:
    from fieldscribe.model import Point
    from fieldscribe.resolve.subject import Subject

Needs = Callable[["Subject", list["Point"]], Iterable[tuple[int, str, str]]]
"""Yields what the device lacks: how many of the points need it, what it is, and a hint."""


def report_missing(subject: Subject, needs: Needs) -> None:
    """One finding for each missing way to read or write points outside telegrams."""
    if not subject.bus_is_whole or subject.scope.bus is None:
        return
    sound = [
        resolved.point
        for resolved in subject.resolved
        if resolved.point.generated and "type" not in resolved.draft.failed
    ]
    for count, message, hint in needs(subject, [point for point in sound if point.space != SPACE]):
        if count:
            needed = f"{count} point{'s need' if count > 1 else ' needs'} it"
            subject.report.error("no-function", f"{message}, and {needed}", subject.scope.bus.span(), hint)
