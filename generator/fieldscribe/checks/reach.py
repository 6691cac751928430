"""What points need of the frames of their family, and what a finding says of it where that is not there."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING

from fieldscribe.resolve.telegrams import SPACE

if TYPE_CHECKING:
    from fieldscribe.model import Point
    from fieldscribe.resolve.subject import Subject

Needs = Callable[["Subject", list["Point"]], Iterable[tuple[int, str, str]]]
"""How many of the points need what is missing, what that is, and a hint."""


def report_missing(subject: Subject, needs: Needs) -> None:
    """One finding for each way to read or write that points outside telegrams need and that is missing."""
    if not subject.bus_is_whole or subject.scope.bus is None:
        return
    sound = [one.point for one in subject.resolved if one.point.generated and "type" not in one.draft.failed]
    for count, message, hint in needs(subject, [point for point in sound if point.space != SPACE]):
        if count:
            needed = f"{count} point{'s need' if count > 1 else ' needs'} it"
            subject.report.error("no-function", f"{message}, and {needed}", subject.scope.bus.span(), hint)
