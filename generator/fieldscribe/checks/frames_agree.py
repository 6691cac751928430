"""The manual's worked examples are frames of this device and mean what the manual says; else an erratum explains it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NamedTuple

from fieldscribe.checks.subject import Printed, Subject
from fieldscribe.families import modbus
from fieldscribe.language.nodes import Map

if TYPE_CHECKING:
    from fieldscribe.families.modbus import Request
    from fieldscribe.model import Frame, Point
    from fieldscribe.resolve.frames import OpenFrame


@dataclass(slots=True)
class _Seen:
    """What one frame turned out to be."""

    frame: Frame
    request: Request | None


class _Carried(NamedTuple):
    """What a frame brings: the values from an address on, by which function."""

    function: int
    address: int
    values: tuple[int, ...]


def check(subject: Subject) -> None:
    """Frames with a wrong checksum, count or length, answers that do not fit, meanings that the bytes do not have."""
    if not subject.bus_is_whole:
        return
    seen: dict[str, _Seen] = {}
    points = {resolved.point.item: resolved.point for resolved in subject.resolved}
    for one in subject.open_frames:
        found, carried = _request(subject, one) if one.frame.direction == "request" else _reply(subject, one, seen)
        if carried is not None:
            _meaning(subject, one, carried, points)
        ids = tuple(erratum.erratum.id for erratum in subject.cited.get(f"frame:{one.frame.name}", ()))
        seen[one.frame.name] = found
        subject.frames.append(replace(found.frame, errata=ids))


def _checked(subject: Subject, one: OpenFrame) -> Frame:
    """The frame with its checksum put right."""
    frame = one.frame
    if frame.framing != "rtu" or len(frame.printed) < 4:
        return frame
    right = modbus.crc16(frame.printed[:-2]).to_bytes(2, "little")
    if right == frame.printed[-2:]:
        return frame
    printed, taken = _hex(frame.printed[-2:]), _hex(right)
    message = f"the CRC {printed} is printed, the bytes give {taken}"
    subject.disagrees(Printed(f"frame:{frame.name}", "crc", printed, taken, one.raw.span("bytes"), message))
    return replace(frame, corrected=frame.printed[:-2] + right, valid=False)


def _no_frame(subject: Subject, one: OpenFrame, message: str) -> None:
    """The bytes are none that could be sent: what is right follows from nothing here."""
    printed = _hex(one.frame.printed)
    subject.disagrees(Printed(f"frame:{one.frame.name}", "form", printed, None, one.raw.span("bytes"), message))


def _request(subject: Subject, one: OpenFrame) -> tuple[_Seen, _Carried | None]:
    frame = _checked(subject, one)
    request = modbus.parse_request(frame.framing, frame.corrected)
    if isinstance(request, str):
        _no_frame(subject, one, f"this is no request: {request}")
        return _Seen(replace(frame, valid=False), None), None
    profile = modbus.profile_of(subject.bus)
    most = profile.most.get(request.function, 0)
    if request.function in profile.most and request.count > most:
        message = f"{request.count} items are asked for, function {request.function:02X}h takes at most {most}"
        span = one.raw.span("bytes")
        subject.disagrees(Printed(f"frame:{frame.name}", "count", request.count, None, span, message))
        request = replace(request, count=_taken(subject, frame.name, "count", most))
        frame = replace(frame, valid=False)
    status, rebuilt = modbus.build(profile, frame.framing, request)
    if status != "ok":
        _no_frame(subject, one, f"this device takes no such request: {status.replace('_', ' ')}")
        return _Seen(replace(frame, valid=False), None), None
    if frame.valid and rebuilt != frame.printed:
        _no_frame(subject, one, f"this request would be {_hex(rebuilt)}")
        frame = replace(frame, valid=False)
    carried = _Carried(request.function, request.address, request.values)
    return _Seen(replace(frame, corrected=rebuilt), request), carried


def _reply(subject: Subject, one: OpenFrame, seen: dict[str, _Seen]) -> tuple[_Seen, _Carried | None]:
    frame = _checked(subject, one)
    asked = seen.get(frame.answers or "")
    if frame.answers is None:
        message = f"the response `{frame.name}` answers nothing"
        subject.report.error("unknown-frame", message, one.raw.span("name"), "name the request under `answers`")
    if asked is None or asked.request is None:
        return _Seen(replace(frame, valid=False), None), None
    request = asked.request
    reply = modbus.parse_reply(frame.framing, request, frame.corrected)
    if reply.status not in ("ok", "exception"):
        _no_frame(subject, one, f"this does not answer `{frame.answers}`: {reply.status.replace('_', ' ')}")
        return _Seen(replace(frame, valid=False), None), None
    return _Seen(frame, request), _Carried(request.function, request.address, reply.values or request.values)


def _meaning(subject: Subject, one: OpenFrame, carried: _Carried, points: dict[str, Point]) -> None:
    says = one.raw.get("says")
    if not isinstance(says, Map):
        return
    spaces = {
        space
        for space, known in modbus.SPACES.items()
        if carried.function in (known.read, known.write_one, known.write_many)
    }
    for word in says:
        draft = subject.index.find(word)
        point = points.get(draft.item) if draft is not None else None
        if draft is None or point is None or point.item not in one.frame.meaning or "at" in draft.failed:
            continue
        wanted = one.frame.meaning[point.item]
        found = _raw(point, carried) if point.space in spaces else None
        if found != wanted:
            shown = "does not carry it" if found is None else f"carries raw {found}"
            message = f"`{word}` is said to be raw {wanted}, the frame {shown}"
            subject.disagrees(Printed(f"frame:{one.frame.name}", "says", says[word], None, says.span(word), message))


def _raw(point: Point, carried: _Carried) -> int | None:
    if not point.addresses:
        return None
    raw = 0
    for word in point.addresses:
        if not carried.address <= word < carried.address + len(carried.values):
            return None
        raw = raw << 16 | carried.values[word - carried.address]
    if point.bits is not None:
        raw = raw >> point.bits[1] & ((1 << point.width) - 1)
    return raw - (1 << point.width) if raw > point.greatest else raw


def _taken(subject: Subject, name: str, key: str, otherwise: int) -> int:
    for erratum in subject.cited.get(f"frame:{name}", ()):
        taken = erratum.raw["taken"]
        if isinstance(taken, Map) and isinstance(taken.get(key), int):
            return int(taken[key])
    return otherwise


def _hex(data: bytes) -> str:
    return data.hex(" ").upper()
