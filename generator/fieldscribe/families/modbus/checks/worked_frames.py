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
    report_refused,
    report_wrong_error,
    report_wrong_sum,
)
from fieldscribe.families.modbus.frames import Flaw, unwrap
from fieldscribe.families.modbus.functions import SPACE_OF, SPACES, profile_of
from fieldscribe.families.modbus.remarks import flaw_text
from fieldscribe.families.modbus.replies import parse_reply
from fieldscribe.families.modbus.requests import build, parse_request
from fieldscribe.language.nodes import Map
from fieldscribe.resolve.subject import Printed, Subject

if TYPE_CHECKING:
    from fieldscribe.checks.frames_agree import Carries
    from fieldscribe.model import Frame, Point
    from fieldscribe.resolve.frames import OpenFrame


def read(subject: Subject, open_frame: OpenFrame, seen: dict[str, Seen]) -> Seen:
    """The frame as the device reads it; `Seen.request` is a `Request`."""
    whole = replace(open_frame, frame=_checked(subject, open_frame))
    return _request(subject, whole) if whole.frame.direction == "request" else _reply(subject, whole, seen)


def _checked(subject: Subject, open_frame: OpenFrame) -> Frame:
    """The frame with its checksum corrected."""
    frame = open_frame.frame
    flaw = unwrap(frame.framing, frame.printed).flaw
    if flaw is None or flaw.status != "bad_crc":
        return frame
    right = flaw.due.to_bytes(2, "little")
    report_wrong_sum(subject, open_frame, "crc", frame.printed[-2:], right)
    return replace(frame, corrected=frame.printed[:-2] + right, valid=False)


def _request(subject: Subject, open_frame: OpenFrame) -> Seen:
    frame = open_frame.frame
    request = parse_request(frame.framing, frame.corrected)
    if isinstance(request, Flaw):
        return report_no_frame(subject, open_frame, f"this is no request: {flaw_text(request)}")
    profile = profile_of(subject.bus)
    most = profile.most.get(request.function, 0)
    if request.function in profile.most and request.count > most:
        message = f"{request.count} items are asked for, function {request.function:02X}h takes at most {most}"
        span = open_frame.node.span("bytes")
        subject.disagrees(Printed(open_frame.about, "count", request.count, None, span, message))
        request = replace(request, count=_taken(subject, open_frame, "count", most))
        frame = replace(frame, valid=False)
    status, rebuilt = build(profile, frame.framing, request)
    if status != "ok":
        return report_refused(subject, open_frame, status)
    if frame.valid and rebuilt != frame.printed:
        frame = report_no_frame(subject, open_frame, f"this request would be {hex_of(rebuilt)}").frame
    carries = _carries(request.function, request.address, request.values)
    return Seen(replace(frame, corrected=rebuilt), request, carries)


def _reply(subject: Subject, open_frame: OpenFrame, seen: dict[str, Seen]) -> Seen:
    frame = open_frame.frame
    asked = seen.get(frame.answers or "")
    report_no_request(subject, open_frame)
    if asked is None or asked.request is None:
        return Seen(replace(frame, valid=False))
    request = asked.request
    reply = parse_reply(frame.framing, request, frame.corrected)
    if reply.status not in ("ok", "exception"):
        return report_refused(subject, open_frame, reply.status)
    report_wrong_error(subject, open_frame, reply.exception if reply.status == "exception" else None)
    return Seen(frame, request, _carries(request.function, request.address, reply.values or request.values))


def _carries(function: int, first: int, values: tuple[int, ...]) -> Carries:
    """Finds the raw numbers in a frame: values from an address on, in the space of its function."""
    writes = function not in {by.read for by in SPACES.values()}

    def carries(point: Point) -> int | None:
        addresses = point.written.addresses if writes else point.addresses
        if not addresses or point.space != SPACE_OF.get(function):
            return None
        inside = (first <= word < first + len(values) for word in addresses)
        if not all(inside):
            return None
        return from_words(point, tuple(values[word - first] for word in addresses))

    return carries


def _taken(subject: Subject, open_frame: OpenFrame, key: str, otherwise: int) -> int:
    for erratum in subject.cited.get(open_frame.about, ()):
        taken = erratum.node["taken"]
        if isinstance(taken, Map) and isinstance(taken.get(key), int):
            return int(taken[key])
    return otherwise
