"""What only a CAN device can get wrong: messages that look the same, missing messages, its worked frames."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from fieldscribe.checks import frames_agree
from fieldscribe.checks.frames_agree import Seen, Words
from fieldscribe.checks.reachability import report_missing
from fieldscribe.families.can import frames, identifier_of
from fieldscribe.model import Frame, Message, Point
from fieldscribe.resolve.analysis import Analysis
from fieldscribe.resolve.frames import LocatedFrame

_MOST_COMPARED = 64
"""With how many messages of its identifier each message is compared."""


def messages_differ(subject: Analysis) -> None:
    """Report messages of the same identifier that differ in no constant byte."""
    nodes = {str(node["name"]): node for node in reversed(list(subject.scope.listed("messages")))}
    by_identifier: dict[int, list[Message]] = {}
    low, high = subject.bus.units
    for message in subject.messages:
        reported: set[str] = set()
        units = range(low, high + 1) if message.adds_unit else (0,)
        for identifier in (message.identifier + unit for unit in units):
            earlier = by_identifier.setdefault(identifier, [])
            for other in earlier:
                if other.name in reported or subject.report.full or not _look_the_same(other, message):
                    continue
                reported.add(other.name)
                text = f"nobody can tell `{message.name}` from `{other.name}` under the identifier {identifier:X}h"
                related = [(nodes[other.name].span("can_id"), f"`{other.name}` stands here")]
                hint = "a constant byte must differ, or the identifiers; which there are with + unit, `units` says"
                subject.report.error("messages-alike", text, nodes[message.name].span("can_id"), hint, related)
            if len(earlier) < _MOST_COMPARED:
                earlier.append(message)


def _look_the_same(message: Message, other: Message) -> bool:
    pairs = zip(message.roles, other.roles, strict=True)
    return not any(mine.kind == theirs.kind == "constant" and mine.number != theirs.number for mine, theirs in pairs)


def parameters_are_reachable(subject: Analysis) -> None:
    """Report each message that parameters need and that the device does not have."""
    report_missing(subject, _missing_messages)


def _missing_messages(subject: Analysis, points: list[Point]) -> Iterator[tuple[int, str, str, str]]:
    described = list(subject.scope.listed("messages"))
    if subject.scope.is_lost("messages", "messages") or len(subject.messages) < len(described):
        return  # the missing message may be one that could not be read
    answered = {message.answers for message in subject.messages if frames.carries(message, "raw")}
    requests = [
        message for message in subject.messages if message.direction == "request" and frames.carries(message, "address")
    ]
    reads = any(not frames.carries(message, "raw") and message.name in answered for message in requests)
    write_request, _ = frames.request_and_answer(subject.messages, writes=True)
    hint = "add {} under `messages`, or correct `access`"
    if not reads:
        what_to_add = hint.format("a request with `address`, and a response with `raw` that answers it")
        yield sum(point.readable for point in points), "no message reads a parameter", "messages", what_to_add
    if write_request is None:
        what_to_add = hint.format("a request with `address` and `raw`")
        yield sum(point.writable for point in points), "no message writes a parameter", "messages", what_to_add


@dataclass(frozen=True, slots=True)
class _Reading:
    """A frame read as a message to or from a unit."""

    message: Message
    unit: int
    parsed: frames.Parsed


def read(subject: Analysis, open_frame: LocatedFrame, seen: dict[str, Seen]) -> Seen:
    """Read a worked frame as a message of the device; `Seen.request` is a `_Reading`."""
    frame = open_frame.frame
    if len(frame.printed) != frames.LENGTH:
        message = f"a frame has {frames.LENGTH} bytes, {len(frame.printed)} are printed"
        return frames_agree.report_no_frame(subject, open_frame, message)
    request: _Reading | None = None
    if frame.direction == "response":
        frames_agree.report_no_request(subject, open_frame)
        before = seen.get(frame.answers or "")
        request = before.request if before is not None else None
    number = identifier_of(frame)
    if number is None or (frame.direction == "response" and request is None):
        return Seen(replace(frame, valid=False))
    readings = list(_readings(subject, frame, number, request))
    frame, reading = _with_right_checksum(subject, open_frame, number, readings)
    low, high = subject.bus.units
    if reading is not None and not low <= reading.unit <= high:
        return frames_agree.report_refused(subject, open_frame, "bad_unit", reading.unit)
    fault = _fault(frame, readings, reading, request)
    if fault is not None or reading is None:
        return frames_agree.report_no_frame(subject, open_frame, fault or "")
    return Seen(frame, reading, _words(subject, reading, frame))


def _readings(subject: Analysis, frame: Frame, number: int, request: _Reading | None) -> Iterator[_Reading]:
    """Yield the frame read as each message that it could be."""
    read_frame = frames.CanFrame(number, frame.printed)
    for message in subject.messages:
        if message.direction == frame.direction and (request is None or message.answers == request.message.name):
            unit = frames.unit_of(message, read_frame)
            unit = subject.bus.units[0] if unit is None else unit
            yield _Reading(message, unit, frames.parse(message, unit, read_frame))


def _with_right_checksum(
    subject: Analysis, open_frame: LocatedFrame, number: int, readings: list[_Reading]
) -> tuple[Frame, _Reading | None]:
    """Return the frame with its checksum corrected, and as which message it is read; None if it is none of them."""
    frame = open_frame.frame
    by_status = {reading.parsed.status: reading for reading in reversed(readings)}
    wrong = by_status.get("wrong_check")
    if "ok" in by_status or wrong is None:
        return frame, by_status.get("ok")
    data, (here, right) = bytearray(frame.printed), frames.sums(wrong.message, frame.printed)
    for place, due in zip(frames.places(wrong.message, "xor"), right, strict=True):
        data[place] = due
    frames_agree.report_wrong_sum(subject, open_frame, "xor", here, right)
    parsed = frames.parse(wrong.message, wrong.unit, frames.CanFrame(number, bytes(data)))
    return replace(frame, corrected=bytes(data), valid=False), replace(wrong, parsed=parsed)


def _fault(frame: Frame, readings: list[_Reading], reading: _Reading | None, request: _Reading | None) -> str | None:
    """Return why the frame is no message of the device, or does not answer its request."""
    what = f"does not answer `{frame.answers}`" if request is not None else "is no message of this device"
    if reading is None:
        faults = {tried.parsed.status.replace("_", " ") for tried in readings} or {"wrong id"}
        return f"this {what}: {', '.join(sorted(faults))}"
    if request is not None and (reading.unit, reading.parsed.address) != (request.unit, request.parsed.address):
        return f"this {what}: another unit or another parameter"
    return None


def _words(subject: Analysis, reading: _Reading, frame: Frame) -> Words:
    """Return the word of a parameter, and the words of telegrams in a frame."""
    message, parsed = reading.message, reading.parsed
    words = frames.telegram_words(message, frames.CanFrame(0, frame.corrected))
    telegrams = [name for name, (telegram, _) in subject.places.telegrams.items() if telegram.message == message.name]
    carried = {(name, address, 0): (word,) for name in telegrams for address, word in words.items()}
    return carried | ({("parameter", parsed.address, 0): (parsed.raw,)} if frames.carries(message, "raw") else {})


CHECKS = (messages_differ, parameters_are_reachable)
