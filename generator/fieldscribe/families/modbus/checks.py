"""What only a Modbus device can get wrong: too few functions or items for its points, and its worked frames."""

from collections.abc import Iterator
from dataclasses import replace

from fieldscribe.checks import frames_agree
from fieldscribe.checks.coexistence import report_missing
from fieldscribe.checks.frames_agree import Seen
from fieldscribe.families.modbus import BIT_LISTS, FUNCTIONS, READS, SPACES, profile_of
from fieldscribe.families.modbus.frames import Flaw, Request, build, data_size, parse_reply, parse_request, unwrap
from fieldscribe.families.modbus.remarks import flaw_text
from fieldscribe.language.nodes import Map
from fieldscribe.model import Frame, Named, Point
from fieldscribe.resolve.analysis import Analysis
from fieldscribe.resolve.errata import PrintedFact
from fieldscribe.resolve.frames import LocatedFrame
from fieldscribe.resolve.points import ResolvedPoint


def write_addresses_are_writable(subject: Analysis) -> None:
    """Report points that are written at another address, in a space that no function writes."""
    for resolved in subject.resolved:
        space = resolved.point.space
        if resolved.point.write_place is not None and space in SPACES and SPACES[space].write_many is None:
            message = f"`{resolved.point.name}` cannot be written: no function writes `{space}`"
            hint = "leave `write_at` out; what is written in another space is a point of its own"
            subject.report.error("write-address", message, resolved.facts.span("write_at"), hint)


def spaces_are_reachable(subject: Analysis) -> None:
    """Report each space with points that no function of the device can read, or write."""
    report_missing(subject, _missing_functions)


def _missing_functions(subject: Analysis, points: list[Point]) -> Iterator[tuple[int, str, str, str]]:
    known = {code.number for code in subject.bus.functions}
    hint = "list the function under `functions`, or correct `access` or `space`"
    for space, functions in SPACES.items():
        here = [point for point in points if point.space == space]
        writers = {functions.write_one, functions.write_many} - {None}
        if functions.read not in known:
            yield sum(point.readable for point in here), f"no function reads `{space}`", "functions", hint
        if writers and not writers & known:
            yield sum(point.writable for point in here), f"no function writes `{space}`", "functions", hint


def points_fit_into_one_request(subject: Analysis) -> None:
    """Report each function whose requests have too few words for points that only it can read or write."""
    if subject.scope.bus is None or not subject.bus_is_whole:
        return
    most = profile_of(subject.bus).most
    too_long: dict[tuple[str, int], list[ResolvedPoint]] = {}
    for resolved in subject.resolved:
        point, addresses = resolved.point, resolved.point.place.addresses
        if len(addresses) == 1 or point.space not in SPACES:
            continue  # any function carries one item
        if not point.generated or "type" in resolved.facts.failed:
            continue
        functions, span = SPACES[point.space], point.words
        in_parts = point.text is not None and not point.text.parts  # a long text takes several requests, no date does
        if point.readable and not in_parts and functions.read in most and span > most[functions.read]:
            too_long.setdefault(("read", functions.read), []).append(resolved)
        many = functions.write_many
        if in_parts and many in most:
            continue
        if point.writable and many is not None and point.words > 1 and point.words > most.get(many, 1):
            too_long.setdefault(("write", many), []).append(resolved)
    for (verb, function), points in too_long.items():
        _report_too_long(subject, verb, function, points, most.get(function))


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
        parts = f"what the device {verb}s in parts has a point for each part"
        hint = f"correct `max` of {function:02X}h or the type; {parts}"
        if most == FUNCTIONS[function].most:
            hint = "no request of Modbus is longer: give each part a point of its own, or correct `access`"
    draft = points[0].facts
    key = "type" if first.text is None else "parts" if first.text.parts else "characters"
    subject.report.error("too-long", message, draft.span(key if draft.layer(key) is not None else None), hint)


def printed_bytes_agree(subject: Analysis) -> None:
    """Report printed numbers of bytes that do not follow from the largest count of a function."""
    bus = subject.scope.bus
    by_name = {code.name: code for code in subject.bus.functions}
    for key, node in ({} if bus is None else bus.get("functions", {})).items():
        printed = node.get("printed", {}).get("bytes") if isinstance(node, Map) else None
        code = by_name.get(node["name"]) if isinstance(node, Map) else None
        if printed is None or code is None or code.most is None:
            continue
        right = (code.most + 7) // 8 if code.number in BIT_LISTS | {0x05} else data_size(code.number, code.most)
        if printed != right:
            message = f"{printed} bytes are printed for {key}, {code.most} items are {right} bytes"
            span = node["printed"].span("bytes")
            subject.report_printed(PrintedFact(Named("function", code.number), "bytes", printed, right, span, message))


def read(subject: Analysis, open_frame: LocatedFrame, seen: dict[str, Seen]) -> Seen:
    """Read a worked frame as the device does; `Seen.request` is a `Request`."""
    whole = replace(open_frame, frame=_with_right_checksum(subject, open_frame))
    return _request(subject, whole) if whole.frame.direction == "request" else _reply(subject, whole, seen)


def _with_right_checksum(subject: Analysis, open_frame: LocatedFrame) -> Frame:
    frame = open_frame.frame
    flaw = unwrap(frame.framing, frame.printed).flaw
    if flaw is None or flaw.status != "bad_crc":
        return frame
    right = flaw.due.to_bytes(2, "little")
    frames_agree.report_wrong_sum(subject, open_frame, "crc", frame.printed[-2:], right)
    return replace(frame, corrected=frame.printed[:-2] + right, valid=False)


def _request(subject: Analysis, open_frame: LocatedFrame) -> Seen:
    frame = open_frame.frame
    request = parse_request(frame.framing, frame.corrected)
    if isinstance(request, Flaw):
        return frames_agree.report_no_frame(subject, open_frame, f"this is no request: {flaw_text(request)}")
    profile = profile_of(subject.bus)
    most = profile.most.get(request.function, 0)
    if request.function in profile.most and request.count > most:
        message = f"{request.count} items are asked for, function {request.function:02X}h takes at most {most}"
        span = open_frame.node.span("bytes")
        subject.report_printed(PrintedFact(open_frame.about, "count", request.count, None, span, message))
        request = replace(request, count=_count_of_erratum(subject, open_frame, most))
        frame = replace(frame, valid=False)
    status, rebuilt = build(profile, frame.framing, request)
    if status != "ok":
        return frames_agree.report_refused(subject, open_frame, status, request.unit)
    if frame.valid and rebuilt != frame.printed:
        message = f"this request would be {frames_agree.hex_of(rebuilt)}"
        frame = frames_agree.report_no_frame(subject, open_frame, message).frame
    return _seen(replace(frame, corrected=rebuilt), request, request.values)


def _reply(subject: Analysis, open_frame: LocatedFrame, seen: dict[str, Seen]) -> Seen:
    frame = open_frame.frame
    answered = seen.get(frame.answers or "")
    frames_agree.report_no_request(subject, open_frame)
    if answered is None or answered.request is None:
        return Seen(replace(frame, valid=False))
    request = answered.request
    reply = parse_reply(frame.framing, request, frame.corrected)
    if reply.status not in ("ok", "exception"):
        return frames_agree.report_refused(subject, open_frame, reply.status)
    frames_agree.report_wrong_error(subject, open_frame, reply.exception if reply.status == "exception" else None)
    return _seen(frame, request, reply.values or request.values)


def _seen(frame: Frame, request: Request, values: tuple[int, ...]) -> Seen:
    """Return the frame with its values from an address on, in the space of its function."""
    space, function = FUNCTIONS[request.function].space, request.function
    words = {(space, address, 0): (value,) for address, value in enumerate(values, request.address)}
    return Seen(frame, request, words, written=function not in READS)


def _count_of_erratum(subject: Analysis, open_frame: LocatedFrame, otherwise: int) -> int:
    """Return the count that an erratum of the frame gives."""
    for erratum in subject.cited.get(open_frame.about, ()):
        taken = erratum.node["taken"]
        if isinstance(taken, Map) and isinstance(taken.get("count"), int):
            return int(taken["count"])
    return otherwise


CHECKS = (write_addresses_are_writable, spaces_are_reachable, points_fit_into_one_request, printed_bytes_agree)
