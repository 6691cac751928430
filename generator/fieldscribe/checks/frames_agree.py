"""The manual's worked examples are frames of this device and mean what the manual says; else an erratum explains it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from fieldscribe import wording
from fieldscribe.arithmetic.words import raw_of
from fieldscribe.checks.subject import Printed, Subject
from fieldscribe.language.nodes import Map

if TYPE_CHECKING:
    from fieldscribe.model import Frame, Point
    from fieldscribe.resolve.frames import OpenFrame

Carries = Callable[["Point"], int | None]
"""The raw number of a point that a frame carries; None if it does not."""


@dataclass(slots=True)
class Seen:
    """What one frame turned out to be: `request` is what a family made of it, for its answers.

    `carries` is None where the bytes are no frame of the device.
    """

    frame: Frame
    request: Any = None
    carries: Carries | None = None


Reader = Callable[[Subject, "OpenFrame", dict[str, Seen]], Seen]
"""A frame, with those before it by name, as the family reads it; disagreements are reported."""


def check(subject: Subject) -> None:
    """Frames with a wrong checksum, count or length, answers that do not fit, meanings that the bytes do not have."""
    if not subject.bus_is_whole:
        return
    own = subject.scope.family.part("checks")
    read: Reader = _unread if own is None else own.read
    seen: dict[str, Seen] = {}
    points = {resolved.point.item: resolved.point for resolved in subject.resolved}
    fixed = [point for point in points.values() if point.fixed is not None and point.generated]
    for one in subject.open_frames:
        found = read(subject, one, seen)
        if found.carries is not None:
            _meaning(subject, one, found.carries, points)
            if one.frame.direction == "request":
                _fixed(subject, one, found.carries, fixed)
        ids = tuple(erratum.erratum.id for erratum in subject.cited.get(f"frame:{one.frame.name}", ()))
        seen[one.frame.name] = found
        subject.frames.append(replace(found.frame, errata=ids))


def _unread(subject: Subject, one: OpenFrame, seen: dict[str, Seen]) -> Seen:
    """A frame of a family that does not say how its frames are read."""
    del subject, seen
    return Seen(one.frame)


def _meaning(subject: Subject, one: OpenFrame, carries: Carries, points: dict[str, Point]) -> None:
    says = one.raw.get("says")
    if not isinstance(says, Map):
        return
    for word in says:
        draft = subject.index.find(word.removesuffix(".raw"))
        point = points.get(draft.item) if draft is not None else None
        if draft is None or point is None or point.item not in one.frame.meaning or "at" in draft.failed:
            continue
        wanted, found = one.frame.meaning[point.item], carries(point)
        if found != wanted:
            shown = "does not carry it" if found is None else f"carries raw {found}"
            message = f"`{word}` is said to be raw {wanted}, the frame {shown}"
            subject.disagrees(Printed(f"frame:{one.frame.name}", "says", says[word], None, says.span(word), message))


def _fixed(subject: Subject, one: OpenFrame, carries: Carries, points: list[Point]) -> None:
    """What a request writes has the bits that are always written as a constant."""
    for point in points:
        word = carries(_whole_word(point))
        if word is None or point.fixed is None or word & point.fixed.mask == point.fixed.bits:
            continue
        message = f"the word of `{point.name}` is {word & 0xFFFF:04X}h, {wording.fixed_text(point)}"
        printed = f"{word & 0xFFFF:04X}h"
        subject.disagrees(Printed(f"frame:{one.frame.name}", "fixed", printed, None, one.raw.span("bytes"), message))


def _whole_word(point: Point) -> Point:
    """The word that a bit group lies in, as if it were the point."""
    return point if point.bits is None else replace(point, bits=None, shape=replace(point.shape, type="u16", width=16))


def no_frame(subject: Subject, one: OpenFrame, message: str) -> Seen:
    """A finding for bytes that nobody could send; nothing here tells which would be right."""
    printed = hex_of(one.frame.printed)
    subject.disagrees(Printed(f"frame:{one.frame.name}", "form", printed, None, one.raw.span("bytes"), message))
    return Seen(replace(one.frame, valid=False))


def answers_nothing(subject: Subject, one: OpenFrame) -> None:
    """A finding for a response that does not say what it answers."""
    if one.frame.answers is None:
        message = f"the response `{one.frame.name}` answers nothing"
        subject.report.error("unknown-frame", message, one.raw.span("name"), "name the request under `answers`")


def wrong_error(subject: Subject, one: OpenFrame, carried: int | None) -> None:
    """A disagreement where the frame is said to carry another error than it does."""
    said = one.raw.get("error")
    if said is not None and said != carried:
        shown = "refuses nothing" if carried is None else f"carries {carried}"
        message = f"the error {said} is said to be answered, the frame {shown}"
        subject.disagrees(Printed(f"frame:{one.frame.name}", "error", said, carried, one.raw.span("error"), message))


def from_words(point: Point, words: tuple[int | None, ...]) -> int | None:
    """The raw number of a point from its words, the high part first; None if one is not there."""
    known = [word for word in words if word is not None]
    return raw_of(point, known) if len(known) == len(words) else None


def hex_of(data: bytes) -> str:
    """Bytes as manuals print them."""
    return data.hex(" ").upper()
