"""Functions suffice: for the printed number of bytes, for each space with points, for all words of a point."""

from __future__ import annotations

from collections import Counter
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
from fieldscribe.families.modbus import PROTOCOL_MOST, SPACE_OF, SPACES, profile_of
from fieldscribe.families.modbus.exchange import build, parse_reply, parse_request
from fieldscribe.families.modbus.frames import Flaw, unwrap
from fieldscribe.families.modbus.remarks import flaw_text
from fieldscribe.language.nodes import Map
from fieldscribe.model import Named
from fieldscribe.resolve.analysis import Analysis, PrintedFact

if TYPE_CHECKING:
    from fieldscribe.checks.frames_agree import Carries
    from fieldscribe.model import Frame, Point
    from fieldscribe.resolve.analysis import Analysis
    from fieldscribe.resolve.frames import LocatedFrame
    from fieldscribe.resolve.points import ResolvedPoint


_COILS = frozenset({0x01, 0x02, 0x05, 0x0F})


def functions_agree(subject: Analysis) -> None:
    """Findings for printed numbers of bytes that do not follow from the largest count, and for unreachable spaces."""
    bus = subject.scope.bus
    _elsewhere(subject)
    if bus is None:
        return
    if subject.bus_is_whole:
        _reached(subject, bus)
        _at_once(subject)
    by_name = {code.name: code for code in subject.bus.functions}
    for key, node in bus.get("functions", {}).items():
        printed = node.get("printed", {}).get("bytes") if not isinstance(node, str) else None
        code = by_name.get(node if isinstance(node, str) else node["name"])
        if printed is None or code is None or code.most is None:
            continue
        right = (code.most + 7) // 8 if code.number in _COILS else 2 * code.most
        if printed != right:
            message = f"{printed} bytes are printed for {key}, {code.most} items are {right} bytes"
            span = node["printed"].span("bytes")
            subject.disagrees(PrintedFact(Named("function", code.number), "bytes", printed, right, span, message))


def _reached(subject: Analysis, bus: Map) -> None:
    """One finding for each space with points that no function of the device can read, or write."""
    known = {code.number for code in subject.bus.functions}
    points = (resolved.point for resolved in subject.resolved)
    needed = Counter((point.terms.space, point.shape.access) for point in points if point.terms.generated)
    for space, functions in SPACES.items():
        writers = {functions.write_one, functions.write_many} - {None}
        for verb, letter, able in (
            ("reads", "r", functions.read in known),
            ("writes", "w", bool(writers & known) or not writers),
        ):
            count = 0 if able else sum(needed[space, access] for access in (letter, "rw"))
            if count:
                message = f"no function {verb} `{space}`, where {count} point{'s' * (count > 1)} would need it"
                hint = "list the function under `functions`, or correct `access` or `space`"
                subject.report.error("no-function", message, bus.key_span("functions"), hint)


def _elsewhere(subject: Analysis) -> None:
    """Findings for points that are written at another address, in a space that no function writes."""
    for resolved in subject.resolved:
        if resolved.point.write_place is None:
            continue
        functions = SPACES.get(resolved.point.space)
        if functions is not None and functions.write_many is None:
            message = f"`{resolved.point.name}` cannot be written: no function writes `{resolved.point.space}`"
            hint = "leave `write_at` out; what is written in another space is a point of its own"
            subject.report.error("write-address", message, resolved.facts.span("write_at"), hint)


def _at_once(subject: Analysis) -> None:
    """One finding for each function whose requests have too few words for points that only it can read or write."""
    most = profile_of(subject.bus).most
    too_long: dict[tuple[str, int], list[ResolvedPoint]] = {}
    for resolved in subject.resolved:
        point = resolved.point
        if len(point.place.addresses) == 1:
            continue  # any function carries one item
        if not point.generated or "type" in resolved.facts.failed or point.space not in SPACES:
            continue
        functions = SPACES[point.space]
        if point.readable and functions.read in most and _span(point) > most[functions.read]:
            too_long.setdefault(("read", functions.read), []).append(resolved)
        many = functions.write_many
        if point.writable and many is not None and point.words > 1 and point.words > most.get(many, 1):
            too_long.setdefault(("write", many), []).append(resolved)
    for (verb, function), points in too_long.items():
        _report_too_long(subject, verb, function, points, most.get(function))


def _span(point: Point) -> int:
    return max(point.addresses) - min(point.addresses) + 1


def _report_too_long(
    subject: Analysis, verb: str, function: int, points: list[ResolvedPoint], most: int | None
) -> None:
    first, others = points[0].point, len(points) - 1
    also = f" (and so do {others} more points)" if others > 1 else " (and so does one more point)" if others else ""
    if most is None:
        message = f"no function {verb}s several words at once, and `{first.name}` has {first.words}{also}"
        hint = f"list {function:02X}h under `functions`, or correct the type or `access`"
    else:
        message = f"`{first.name}` has {first.words} words, and {function:02X}h {verb}s {most} at once{also}"
        hint = (
            f"correct `max` of {function:02X}h or the type; what the device {verb}s in parts has a point for each part"
        )
        if most == PROTOCOL_MOST[function]:
            hint = "no request of Modbus is longer: give each part a point of its own, or correct `access`"
    draft = points[0].facts
    key = "characters" if first.text is not None else "type"
    subject.report.error("too-long", message, draft.span(key if draft.layer(key) is not None else None), hint)


def read(subject: Analysis, open_frame: LocatedFrame, seen: dict[str, Seen]) -> Seen:
    """The frame as the device reads it; `Seen.request` is a `Request`."""
    whole = replace(open_frame, frame=_checked(subject, open_frame))
    return _request(subject, whole) if whole.frame.direction == "request" else _reply(subject, whole, seen)


def _checked(subject: Analysis, open_frame: LocatedFrame) -> Frame:
    """The frame with its checksum corrected."""
    frame = open_frame.frame
    flaw = unwrap(frame.framing, frame.printed).flaw
    if flaw is None or flaw.status != "bad_crc":
        return frame
    right = flaw.due.to_bytes(2, "little")
    report_wrong_sum(subject, open_frame, "crc", frame.printed[-2:], right)
    return replace(frame, corrected=frame.printed[:-2] + right, valid=False)


def _request(subject: Analysis, open_frame: LocatedFrame) -> Seen:
    frame = open_frame.frame
    request = parse_request(frame.framing, frame.corrected)
    if isinstance(request, Flaw):
        return report_no_frame(subject, open_frame, f"this is no request: {flaw_text(request)}")
    profile = profile_of(subject.bus)
    most = profile.most.get(request.function, 0)
    if request.function in profile.most and request.count > most:
        message = f"{request.count} items are asked for, function {request.function:02X}h takes at most {most}"
        span = open_frame.node.span("bytes")
        subject.disagrees(PrintedFact(open_frame.about, "count", request.count, None, span, message))
        request = replace(request, count=_taken(subject, open_frame, "count", most))
        frame = replace(frame, valid=False)
    status, rebuilt = build(profile, frame.framing, request)
    if status != "ok":
        return report_refused(subject, open_frame, status)
    if frame.valid and rebuilt != frame.printed:
        frame = report_no_frame(subject, open_frame, f"this request would be {hex_of(rebuilt)}").frame
    carries = _carries(request.function, request.address, request.values)
    return Seen(replace(frame, corrected=rebuilt), request, carries)


def _reply(subject: Analysis, open_frame: LocatedFrame, seen: dict[str, Seen]) -> Seen:
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


def _taken(subject: Analysis, open_frame: LocatedFrame, key: str, otherwise: int) -> int:
    for erratum in subject.cited.get(open_frame.about, ()):
        taken = erratum.node["taken"]
        if isinstance(taken, Map) and isinstance(taken.get(key), int):
            return int(taken[key])
    return otherwise


CHECKS = (functions_agree,)
