"""The worked examples of a USS device: whole telegrams, or the words of one part alone."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from fieldscribe.checks.frames_agree import Seen, from_words, report_no_frame, report_no_request, report_wrong_error
from fieldscribe.families.uss.facts import of_bus, of_frame
from fieldscribe.families.uss.telegrams import (
    VARIABLE,
    Link,
    Request,
    broadcast,
    build,
    check_byte,
    parse,
    telegram,
)
from fieldscribe.resolve.subject import Printed, Subject

if TYPE_CHECKING:
    from fieldscribe.checks.frames_agree import Carries
    from fieldscribe.model import Frame, Point
    from fieldscribe.resolve.frames import OpenFrame

_SINGLE_TASKS = frozenset({2, 7, 12, 14})
_DOUBLE_TASKS = frozenset({3, 8, 11, 13})
_MASKS = 4
_SHORT = 3
_PAGE_BITS = (15, 12, 13, 14)


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
        if len(frame.corrected) < 4 or len(frame.corrected) % 2:
            return report_no_frame(subject, open_frame, "this is no telegram: STX, LGE, ADR, words and BCC")
        return _telegram(subject, replace(open_frame, frame=frame), _words(frame.corrected[3:-1]), seen)
    if len(frame.printed) % 2:
        return report_no_frame(subject, open_frame, "the part is made of words")
    words = _words(frame.printed)
    if frame.framing == "pzd":
        return _process_data(subject, open_frame, words)
    return _telegram(subject, open_frame, words, seen)


def _words(data: bytes) -> tuple[int, ...]:
    return tuple(int.from_bytes(data[at : at + 2], "big") for at in range(0, len(data), 2))


def _checked(subject: Subject, open_frame: OpenFrame) -> Frame:
    """The frame with its length byte and its check byte corrected."""
    frame, span = open_frame.frame, open_frame.raw.span("bytes")
    data = bytearray(frame.printed)
    if len(data) < 4:
        return frame
    if data[1] + 2 != len(data):
        printed, taken = f"{data[1]:02X}", f"{len(data) - 2 & 0xFF:02X}"
        message = f"the LGE {printed} is printed, the bytes give {taken}"
        subject.disagrees(Printed(open_frame.about, "lge", printed, taken, span, message))
        data[1] = len(data) - 2 & 0xFF
    right = check_byte(bytes(data[:-1]))
    if data[-1] != right:
        printed, taken = f"{data[-1]:02X}", f"{right:02X}"
        message = f"the BCC {printed} is printed, the bytes give {taken}"
        subject.disagrees(Printed(open_frame.about, "bcc", printed, taken, span, message))
        data[-1] = right
    return replace(frame, corrected=bytes(data), valid=bytes(data) == frame.printed)


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
    data = frame.corrected if frame.framing == "uss" else telegram(request.unit, words)
    reply = parse(subject.bus, link, request, data)
    if reply.status not in ("ok", "refused", "no_rights"):
        return report_no_frame(
            subject, open_frame, f"this does not answer `{frame.answers}`: {reply.status.replace('_', ' ')}"
        )
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
    request = _asked(part, link, unit, rest) if part else Request(unit, 0, words=rest)
    status, data = build(subject.bus, link, request)
    if status != "ok":
        return report_no_frame(subject, open_frame, f"this device takes no such request: {status.replace('_', ' ')}")
    built = _words(data[3:-1])[: len(words)] if short else _words(data[3:-1])
    if built != words:
        return report_no_frame(
            subject, open_frame, f"this request would be {' '.join(f'{word:04X}' for word in built)}"
        )
    value = (request.width, request.value) if request.width else None
    return Seen(frame, _Asked(link, request), _carries(subject, request, value, rest, "request"))


def _setting(frame: Frame) -> int:
    """The length of the parameter part that the link is set to."""
    setting = of_frame(frame).pkw
    return VARIABLE if setting is None else setting


def _asked(part: tuple[int, ...], link: Link, unit: int, rest: tuple[int, ...]) -> Request:
    """The request in the words of a parameter part."""
    identification, place = part[:2]
    values = (*part[2:], 0, 0)
    task = identification >> 12
    page = sum((place >> bit & 1) << weight for weight, bit in enumerate(_PAGE_BITS))
    parameter = (identification & 0x07FF) + 2000 * page
    width = 1 if task in _SINGLE_TASKS else 2 if task in _DOUBLE_TASKS else 0
    value = 0
    if width == 2:
        value = values[0] << 16 | values[1]
    elif width == 1:
        value = values[1] if link.single_last else values[0]
    return Request(unit, task, parameter, place & 0xFF, width, value, rest)


def _process_data(subject: Subject, open_frame: OpenFrame, words: tuple[int, ...]) -> Seen:
    low, high = of_bus(subject.bus).pzd
    if not low <= len(words) <= high:
        return report_no_frame(subject, open_frame, f"there are {low}..{high} words of process data, not {len(words)}")
    return Seen(open_frame.frame, None, _carries(subject, None, None, words, open_frame.frame.direction))


def _broadcast(subject: Subject, open_frame: OpenFrame) -> Seen:
    """Read a broadcast: four words of masks, then the process data."""
    words = _words(open_frame.frame.printed)
    if len(open_frame.frame.printed) % 2 or len(words) < _MASKS:
        return report_no_frame(subject, open_frame, "a broadcast starts with four words of masks")
    link = Link(_MASKS, len(words) - _MASKS)
    status, _ = broadcast(subject.bus, link, words[:_MASKS], words[_MASKS:])
    if status != "ok":
        return report_no_frame(subject, open_frame, f"this device takes no such broadcast: {status.replace('_', ' ')}")
    return Seen(open_frame.frame, None, _carries(subject, None, None, words[_MASKS:], "request"))


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
