"""The manual's worked examples are frames of this device and mean what the manual says; else an erratum explains it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from fieldscribe.checks.subject import Subject
from fieldscribe.families import modbus
from fieldscribe.families.modbus import Request
from fieldscribe.language.nodes import Map
from fieldscribe.model import Frame, Point
from fieldscribe.resolve.frames import OpenFrame


@dataclass(slots=True)
class _Seen:
    """What one frame turned out to be."""

    frame: Frame
    request: Request | None


def check(subject: Subject) -> None:
    """Frames with a wrong checksum, count or length, answers that do not fit, and meanings that the bytes do not have."""
    seen: dict[str, _Seen] = {}
    points = {resolved.point.item: resolved.point for resolved in subject.resolved}
    for one in subject.open_frames:
        found = (
            _request(subject, one, points) if one.frame.direction == "request" else _reply(subject, one, seen, points)
        )
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
    subject.disagrees(f"frame:{frame.name}", "crc", printed, taken, one.raw.span("bytes"), message)
    return replace(frame, corrected=frame.printed[:-2] + right, valid=False)


def _request(subject: Subject, one: OpenFrame, points: Mapping[str, Point]) -> _Seen:
    frame = _checked(subject, one)
    request = modbus.parse_request(frame.framing, frame.corrected)
    if isinstance(request, str):
        subject.disagrees(
            f"frame:{frame.name}",
            "form",
            frame.printed.hex(),
            None,
            one.raw.span("bytes"),
            f"this is no request: {request}",
        )
        return _Seen(replace(frame, valid=False), None)
    profile = modbus.profile_of(subject.bus)
    most = profile.most.get(request.function, 0)
    if request.function in profile.most and request.count > most:
        message = f"{request.count} items are asked for, function {request.function:02X}h takes at most {most}"
        subject.disagrees(f"frame:{frame.name}", "count", request.count, None, one.raw.span("bytes"), message)
        taken = _taken(subject, frame.name, "count")
        request = replace(request, count=taken if taken is not None else most)
        frame = replace(frame, valid=False)
    status, rebuilt = modbus.build(profile, frame.framing, request)
    if status != "ok":
        message = f"this device takes no such request: {status.replace('_', ' ')}"
        subject.disagrees(f"frame:{frame.name}", "form", frame.printed.hex(), None, one.raw.span("bytes"), message)
        return _Seen(replace(frame, valid=False), None)
    if frame.valid and rebuilt != frame.printed:
        message = f"this request would be {_hex(rebuilt)}"
        subject.disagrees(f"frame:{frame.name}", "form", frame.printed.hex(), None, one.raw.span("bytes"), message)
        frame = replace(frame, valid=False)
    _meaning(subject, one, request.address, request.function, request.values, points)
    return _Seen(replace(frame, corrected=rebuilt), request)


def _reply(subject: Subject, one: OpenFrame, seen: Mapping[str, _Seen], points: Mapping[str, Point]) -> _Seen:
    frame = _checked(subject, one)
    asked = seen.get(frame.answers or "")
    if frame.answers is None:
        hint = "name the request under `answers`"
        subject.report.error(
            "unknown-frame", f"the response `{frame.name}` answers nothing", one.raw.span("name"), hint
        )
    if asked is None or asked.request is None:
        return _Seen(replace(frame, valid=False), None)
    reply = modbus.parse_reply(frame.framing, asked.request, frame.corrected)
    if reply.status not in ("ok", "exception"):
        message = f"this does not answer `{frame.answers}`: {reply.status.replace('_', ' ')}"
        subject.disagrees(f"frame:{frame.name}", "form", frame.printed.hex(), None, one.raw.span("bytes"), message)
        return _Seen(replace(frame, valid=False), None)
    values = reply.values or asked.request.values
    _meaning(subject, one, asked.request.address, asked.request.function, values, points)
    return _Seen(frame, asked.request)


def _meaning(
    subject: Subject, one: OpenFrame, address: int, function: int, values: tuple[int, ...], points: Mapping[str, Point]
) -> None:
    says = one.raw.get("says")
    spaces = {
        space for space, known in modbus.SPACES.items() if function in (known.read, known.write_one, known.write_many)
    }
    for word in says or ():
        assert isinstance(says, Map)
        draft = subject.index.find(word)
        point = points.get(draft.item) if draft is not None else None
        if point is None or point.item not in one.frame.meaning:
            continue
        wanted = one.frame.meaning[point.item]
        found = _raw(point, address, values) if point.space in spaces else None
        if found != wanted:
            shown = "does not carry it" if found is None else f"carries raw {found}"
            message = f"`{word}` is said to be raw {wanted}, the frame {shown}"
            subject.disagrees(f"frame:{one.frame.name}", "says", says[word], None, says.span(word), message)


def _raw(point: Point, address: int, values: tuple[int, ...]) -> int | None:
    raw = 0
    for word in point.addresses:
        if not address <= word < address + len(values):
            return None
        raw = raw << 16 | values[word - address]
    if point.bits is not None:
        raw = raw >> point.bits[1] & ((1 << point.width) - 1)
    return raw - (1 << point.width) if raw > point.greatest else raw


def _taken(subject: Subject, name: str, key: str) -> int | None:
    for erratum in subject.cited.get(f"frame:{name}", ()):
        taken = erratum.raw["taken"]
        if isinstance(taken, Map) and isinstance(taken.get(key), int):
            return int(taken[key])
    return None


def _hex(data: bytes) -> str:
    return data.hex(" ").upper()
