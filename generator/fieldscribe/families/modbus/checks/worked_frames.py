"""The worked examples of a Modbus device."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from fieldscribe.checks.frames_agree import (
    Seen,
    from_words,
    hex_of,
    report_no_frame,
    report_no_request,
    report_wrong_error,
)
from fieldscribe.families.modbus.functions import SPACES, profile_of
from fieldscribe.families.modbus.replies import parse_reply
from fieldscribe.families.modbus.requests import build, crc16, parse_request
from fieldscribe.language.nodes import Map
from fieldscribe.resolve.subject import Printed, Subject

if TYPE_CHECKING:
    from fieldscribe.checks.frames_agree import Carries
    from fieldscribe.model import Frame, Point
    from fieldscribe.resolve.frames import OpenFrame


def read(subject: Subject, open_frame: OpenFrame, seen: dict[str, Seen]) -> Seen:
    """The frame as the device reads it; `Seen.request` is a `Request`."""
    return (
        _request(subject, open_frame) if open_frame.frame.direction == "request" else _reply(subject, open_frame, seen)
    )


def _checked(subject: Subject, open_frame: OpenFrame) -> Frame:
    """The frame with its checksum corrected."""
    frame = open_frame.frame
    if frame.framing != "rtu" or len(frame.printed) < 4:
        return frame
    right = crc16(frame.printed[:-2]).to_bytes(2, "little")
    if right == frame.printed[-2:]:
        return frame
    printed, taken = hex_of(frame.printed[-2:]), hex_of(right)
    message = f"the CRC {printed} is printed, the bytes give {taken}"
    subject.disagrees(Printed(open_frame.about, "crc", printed, taken, open_frame.raw.span("bytes"), message))
    return replace(frame, corrected=frame.printed[:-2] + right, valid=False)


def _request(subject: Subject, open_frame: OpenFrame) -> Seen:
    frame = _checked(subject, open_frame)
    request = parse_request(frame.framing, frame.corrected)
    if isinstance(request, str):
        return _no_frame(subject, open_frame, frame, f"this is no request: {request}")
    profile = profile_of(subject.bus)
    most = profile.most.get(request.function, 0)
    if request.function in profile.most and request.count > most:
        message = f"{request.count} items are asked for, function {request.function:02X}h takes at most {most}"
        span = open_frame.raw.span("bytes")
        subject.disagrees(Printed(open_frame.about, "count", request.count, None, span, message))
        request = replace(request, count=_taken(subject, open_frame, "count", most))
        frame = replace(frame, valid=False)
    status, rebuilt = build(profile, frame.framing, request)
    if status != "ok":
        return _no_frame(subject, open_frame, frame, f"this device takes no such request: {status.replace('_', ' ')}")
    if frame.valid and rebuilt != frame.printed:
        frame = _no_frame(subject, open_frame, frame, f"this request would be {hex_of(rebuilt)}").frame
    carries = _carries(request.function, request.address, request.values)
    return Seen(replace(frame, corrected=rebuilt), request, carries)


def _reply(subject: Subject, open_frame: OpenFrame, seen: dict[str, Seen]) -> Seen:
    frame = _checked(subject, open_frame)
    asked = seen.get(frame.answers or "")
    report_no_request(subject, open_frame)
    if asked is None or asked.request is None:
        return Seen(replace(frame, valid=False))
    request = asked.request
    reply = parse_reply(frame.framing, request, frame.corrected)
    if reply.status not in ("ok", "exception"):
        return _no_frame(
            subject, open_frame, frame, f"this does not answer `{frame.answers}`: {reply.status.replace('_', ' ')}"
        )
    report_wrong_error(subject, open_frame, reply.exception if reply.status == "exception" else None)
    return Seen(frame, request, _carries(request.function, request.address, reply.values or request.values))


def _no_frame(subject: Subject, open_frame: OpenFrame, frame: Frame, message: str) -> Seen:
    report_no_frame(subject, open_frame, message)
    return Seen(replace(frame, valid=False))


def _carries(function: int, first: int, values: tuple[int, ...]) -> Carries:
    """Finds the raw numbers in a frame: values from an address on, in the space of its function."""
    spaces = {space for space, by in SPACES.items() if function in (by.read, by.write_one, by.write_many)}
    writes = function not in {by.read for by in SPACES.values()}

    def carries(point: Point) -> int | None:
        addresses = point.written.addresses if writes else point.addresses
        if not addresses or point.space not in spaces:
            return None
        inside = (first <= word < first + len(values) for word in addresses)
        if not all(inside):
            return None
        return from_words(point, tuple(values[word - first] for word in addresses))

    return carries


def _taken(subject: Subject, open_frame: OpenFrame, key: str, otherwise: int) -> int:
    for erratum in subject.cited.get(open_frame.about, ()):
        taken = erratum.raw["taken"]
        if isinstance(taken, Map) and isinstance(taken.get(key), int):
            return int(taken[key])
    return otherwise
