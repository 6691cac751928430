"""The worked examples of a USS device: whole telegrams, or the words of one part alone."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from fieldscribe.arithmetic.words import words_in
from fieldscribe.checks.frames_agree import (
    Seen,
    from_words,
    report_no_frame,
    report_no_request,
    report_refused,
    report_wrong_error,
    report_wrong_sum,
)
from fieldscribe.families.uss.facts import of_bus, of_frame
from fieldscribe.families.uss.parts import MASKS, VARIABLE, Link, part_of
from fieldscribe.families.uss.remarks import words_printed
from fieldscribe.families.uss.telegrams import (
    LEAST_BYTES,
    Request,
    answer_in,
    broadcast,
    build,
    check_byte,
    parse,
    request_in,
)

if TYPE_CHECKING:
    from fieldscribe.checks.frames_agree import Carries
    from fieldscribe.model import Frame, Point
    from fieldscribe.resolve.frames import OpenFrame
    from fieldscribe.resolve.subject import Subject

_SHORT = 3


@dataclass(frozen=True, slots=True)
class _Asked:
    """A request with the link that it was sent over."""

    link: Link
    request: Request


def read(subject: Subject, open_frame: OpenFrame, seen: dict[str, Seen]) -> Seen:
    """The frame as the device reads it; `Seen.request` is the request with its link."""
    frame = open_frame.frame
    if frame.framing == "broadcast":
        return _broadcast(subject, open_frame)
    if frame.framing == "uss":
        frame = _checked(subject, open_frame)
        if len(frame.corrected) < LEAST_BYTES or len(frame.corrected) % 2:
            return report_no_frame(subject, open_frame, "this is no telegram: STX, LGE, ADR, words and BCC")
        return _telegram(subject, replace(open_frame, frame=frame), words_in(frame.corrected[3:-1]), seen)
    if len(frame.printed) % 2:
        return report_no_frame(subject, open_frame, "the part is made of words")
    words = words_in(frame.printed)
    if frame.framing == "pzd":
        return _process_data(subject, open_frame, words)
    return _telegram(subject, open_frame, words, seen)


def _checked(subject: Subject, open_frame: OpenFrame) -> Frame:
    """The frame with its length byte and its check byte corrected."""
    frame = open_frame.frame
    if len(frame.printed) < LEAST_BYTES:
        return frame
    body = frame.printed[:1] + bytes((len(frame.printed) - 2 & 0xFF,)) + frame.printed[2:-1]
    right = body + bytes((check_byte(body),))
    report_wrong_sum(subject, open_frame, "lge", frame.printed[1:2], right[1:2])
    report_wrong_sum(subject, open_frame, "bcc", frame.printed[-1:], right[-1:])
    return replace(frame, corrected=right, valid=right == frame.printed)


def _telegram(subject: Subject, open_frame: OpenFrame, words: tuple[int, ...], seen: dict[str, Seen]) -> Seen:
    """Read a telegram, or a parameter part alone, which is read as a telegram without process data."""
    frame = open_frame.frame
    if frame.direction == "request":
        return _request(subject, open_frame, words)
    report_no_request(subject, open_frame)
    asked = seen.get(frame.answers or "")
    if asked is None or not isinstance(asked.request, _Asked):
        return Seen(replace(frame, valid=False))
    link, request = asked.request.link, asked.request.request
    if frame.framing == "uss":
        reply = parse(subject.bus, link, request, frame.corrected)
    else:
        reply = answer_in(subject.bus, link, request, words)
    if reply.status not in ("ok", "refused", "no_rights"):
        return report_refused(subject, open_frame, reply.status)
    report_wrong_error(subject, open_frame, reply.error if reply.status == "refused" else None)
    known = {code.number: code for code in subject.bus.exceptions}
    if reply.status == "refused" and known:
        error = known.get(reply.error)
        if error is None or (error.answers and request.task not in error.answers):
            what = "does not exist" if error is None else f"is not for the task {request.task}"
            return report_no_frame(subject, open_frame, f"the error {reply.error} {what}")
    value = (reply.width, reply.value) if reply.status == "ok" and reply.width else None
    return Seen(frame, asked.request, _carries(subject, request, value, reply.words, "response"))


def _request(subject: Subject, open_frame: OpenFrame, words: tuple[int, ...]) -> Seen:
    frame = open_frame.frame
    unit = frame.corrected[2] if frame.framing == "uss" else subject.bus.units[0]
    setting = _setting(frame)
    short = frame.framing == "pkw" and setting == VARIABLE and len(words) == _SHORT
    sent = len(words) if short else Link(setting, 0).sent
    if len(words) < sent or (frame.framing == "pkw" and len(words) != sent):
        return report_no_frame(subject, open_frame, f"the parameter part has {sent} words, {len(words)} are printed")
    part, rest = words[:sent], words[sent:]
    link = Link(setting, len(rest))
    named = part_of(part)
    request = Request(unit, 0, words=rest) if named is None else request_in(unit, named, link, rest)
    status, data = build(subject.bus, link, request)
    if status != "ok":
        return report_refused(subject, open_frame, status)
    built = words_in(data[3:-1])[: len(words)] if short else words_in(data[3:-1])
    if built != words:
        return report_no_frame(subject, open_frame, f"this request would be {words_printed(built)}")
    value = (request.width, request.value) if request.width else None
    return Seen(frame, _Asked(link, request), _carries(subject, request, value, rest, "request"))


def _setting(frame: Frame) -> int:
    """The length of the parameter part that the link is set to."""
    setting = of_frame(frame).pkw
    return VARIABLE if setting is None else setting


def _process_data(subject: Subject, open_frame: OpenFrame, words: tuple[int, ...]) -> Seen:
    low, high = of_bus(subject.bus).pzd
    if not low <= len(words) <= high:
        return report_no_frame(subject, open_frame, f"there are {low}..{high} words of process data, not {len(words)}")
    return Seen(open_frame.frame, None, _carries(subject, None, None, words, open_frame.frame.direction))


def _broadcast(subject: Subject, open_frame: OpenFrame) -> Seen:
    """Read a broadcast: four words of masks, then the process data."""
    words = words_in(open_frame.frame.printed)
    if len(open_frame.frame.printed) % 2 or len(words) < MASKS:
        return report_no_frame(subject, open_frame, "a broadcast starts with four words of masks")
    link = Link(MASKS, len(words) - MASKS)
    status, _ = broadcast(subject.bus, link, words[:MASKS], words[MASKS:])
    if status != "ok":
        return report_no_frame(subject, open_frame, f"this device takes no such broadcast: {status.replace('_', ' ')}")
    return Seen(open_frame.frame, None, _carries(subject, None, None, words[MASKS:], "request"))


def _carries(
    subject: Subject,
    request: Request | None,
    value: tuple[int, int] | None,
    words: tuple[int, ...],
    direction: str,
) -> Carries:
    """Finds the raw numbers in a telegram: a parameter's value (number of words, number) and process data."""
    telegrams = {name for name, (telegram, _) in subject.places.telegrams.items() if telegram.direction == direction}

    def carries(point: Point) -> int | None:
        if not point.addresses:
            return None
        if point.telegram is not None:
            known = point.telegram in telegrams and max(point.addresses) < len(words)
            return from_words(point, tuple(words[place] for place in point.addresses)) if known else None
        if request is None or value is None:
            return None
        if (point.addresses[0], point.index or 0) != (request.parameter, request.index) or value[0] != point.words:
            return None
        number = value[1]
        return from_words(point, (number >> 16, number & 0xFFFF) if value[0] == 2 else (number,))

    return carries
