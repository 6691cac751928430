"""What only a bell can get wrong, and how its worked frames are read."""

from __future__ import annotations

from fieldscribe.checks.frames_agree import Seen, report_no_frame
from fieldscribe.resolve.analysis import Analysis
from fieldscribe.resolve.frames import LocatedFrame

from toy_family import of_bus
from toy_family.frames import tone_of

_MOST = 1000


def stays_whole(subject: Analysis) -> None:
    """A bell that is struck too often breaks."""
    if subject.scope.bus is not None and of_bus(subject.bus).strikes > _MOST:
        text = f"no bell stands more than {_MOST} strikes in a minute"
        subject.report.error("too-many-strikes", text, subject.scope.bus.span("strikes"), "write a smaller number")


def read(subject: Analysis, one: LocatedFrame, seen: dict[str, Seen]) -> Seen:
    """A strike carries its tone as the number of the point that stands there."""
    del seen
    tone = tone_of(one.frame.printed)
    if tone is None:
        return report_no_frame(subject, one, "this rings nothing")
    return Seen(one.frame, None, {("tone", tone, 0): (tone,)})


CHECKS = (stays_whole,)
