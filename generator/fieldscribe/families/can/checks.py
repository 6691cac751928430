"""A received frame can be only one message: its identifier tells, or a byte that is constant in both."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from fieldscribe.checks.frames_agree import Seen, from_words, report_no_frame, report_no_request, report_wrong_sum
from fieldscribe.checks.reachability import report_missing
from fieldscribe.families.can import identifier_of
from fieldscribe.families.can.frames import (
    LENGTH,
    CanFrame,
    Parsed,
    carries,
    parse,
    places,
    sums,
    telegram_words,
    unit_of,
)

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.checks.frames_agree import Carries
    from fieldscribe.model import Frame, Message, Point
    from fieldscribe.resolve.analysis import Analysis
    from fieldscribe.resolve.frames import LocatedFrame


_MOST = 64
"""With how many messages of its identifier each message is compared."""


def messages_differ(subject: Analysis) -> None:
    """Findings for messages of the same identifier that differ in no constant byte."""
    raws = {str(node["name"]): node for node in reversed(list(subject.scope.listed("messages")))}
    heard: dict[int, list[Message]] = {}
    low, high = subject.bus.units
    for message in subject.messages:
        told_names: set[str] = set()
        for identifier in (
            range(message.identifier + low, message.identifier + high + 1)
            if message.adds_unit
            else (message.identifier,)
        ):
            earlier = heard.setdefault(identifier, [])
            for alike in earlier:
                if alike.name in told_names or subject.report.full or not _alike(alike, message):
                    continue
                told_names.add(alike.name)
                text = f"nobody can tell `{message.name}` from `{alike.name}` under the identifier {identifier:X}h"
                related = [(raws[alike.name].span("can_id"), f"`{alike.name}` stands here")]
                hint = "a constant byte must differ, or the identifiers; which there are with + unit, `units` says"
                subject.report.error("messages-alike", text, raws[message.name].span("can_id"), hint, related)
            if len(earlier) < _MOST:
                earlier.append(message)


def _alike(message: Message, other: Message) -> bool:
    pairs = zip(message.roles, other.roles, strict=True)
    return not any(mine.kind == theirs.kind == "constant" and mine.number != theirs.number for mine, theirs in pairs)


def parameters_are_reachable(subject: Analysis) -> None:
    """One finding for each message that parameters need and that the device does not have."""
    report_missing(subject, _messages)


def _messages(subject: Analysis, points: list[Point]) -> Iterator[tuple[int, str, str]]:
    if subject.scope.is_lost("messages", "messages") or len(subject.messages) < len(
        list(subject.scope.listed("messages"))
    ):
        return  # the missing message may be one that could not be read
    asked = [message for message in subject.messages if message.direction == "request" and carries(message, "address")]
    answered = {
        message.answers for message in subject.messages if message.answers is not None and carries(message, "raw")
    }
    reads = any(not carries(message, "raw") and message.name in answered for message in asked)
    writes = any(carries(message, "raw") for message in asked)
    hint = "add {} under `messages`, or correct `access`"
    if not reads:
        what_to_add = hint.format("a request with `address`, and a response with `raw` that answers it")
        yield sum(point.readable for point in points), "no message reads a parameter", what_to_add
    if not writes:
        what_to_add = hint.format("a request with `address` and `raw`")
        yield sum(point.writable for point in points), "no message writes a parameter", what_to_add


@dataclass(frozen=True, slots=True)
class _Heard:
    """A frame read as a message to or from a unit."""

    message: Message
    unit: int
    parsed: Parsed


def read(subject: Analysis, open_frame: LocatedFrame, seen: dict[str, Seen]) -> Seen:
    """The frame as a message of the device; `Seen.request` is that message."""
    frame = open_frame.frame
    if len(frame.printed) != LENGTH:
        return report_no_frame(subject, open_frame, f"a frame has {LENGTH} bytes, {len(frame.printed)} are printed")
    asked: _Heard | None = None
    if frame.direction == "response":
        report_no_request(subject, open_frame)
        before = seen.get(frame.answers or "")
        asked = before.request if before is not None else None
    if identifier_of(frame) is None or (frame.direction == "response" and asked is None):
        return Seen(replace(frame, valid=False))
    tried = _tried(subject, frame, asked)
    frame, heard = _summed(subject, open_frame, tried)
    fault = _fault(subject, frame, tried, heard, asked)
    if fault is not None or heard is None:
        return report_no_frame(subject, open_frame, fault or "")
    return Seen(frame, heard, _carries(subject, heard, frame))


def _fault(
    subject: Analysis, frame: Frame, tried: list[_Heard], heard: _Heard | None, asked: _Heard | None
) -> str | None:
    """Why the frame is no message of the device, or does not answer its request."""
    what = f"does not answer `{frame.answers}`" if asked is not None else "is no message of this device"
    if heard is None:
        faults = {heard.parsed.status.replace("_", " ") for heard in tried} or {"wrong id"}
        return f"this {what}: {', '.join(sorted(faults))}"
    low, high = subject.bus.units
    if not low <= heard.unit <= high:
        return f"there is no unit {heard.unit}"
    if asked is not None and (heard.unit, heard.parsed.address) != (asked.unit, asked.parsed.address):
        return f"this {what}: another unit or another parameter"
    return None


def _tried(subject: Analysis, frame: Frame, asked: _Heard | None) -> list[_Heard]:
    """The frame read as each message that it could be."""
    result = []
    number = identifier_of(frame)
    for message in subject.messages:
        fits = message.direction == frame.direction and (asked is None or message.answers == asked.message.name)
        if fits and number is not None:
            read_frame = CanFrame(number, frame.printed)
            unit = unit_of(message, read_frame)
            unit = subject.bus.units[0] if unit is None else unit
            result.append(_Heard(message, unit, parse(message, unit, read_frame)))
    return result


def _summed(subject: Analysis, open_frame: LocatedFrame, tried: list[_Heard]) -> tuple[Frame, _Heard | None]:
    """The frame with its checksum corrected, read as one of these messages; None if it is none of them."""
    frame, number = open_frame.frame, identifier_of(open_frame.frame)
    for heard in tried:
        if heard.parsed.status == "ok":
            return frame, heard
    wrong = next((heard for heard in tried if heard.parsed.status == "wrong_check"), None)
    if wrong is None or number is None:
        return frame, None
    data, (here, right) = bytearray(frame.printed), sums(wrong.message, frame.printed)
    for place, due in zip(places(wrong.message, "xor"), right, strict=True):
        data[place] = due
    report_wrong_sum(subject, open_frame, "xor", here, right)
    parsed = parse(wrong.message, wrong.unit, CanFrame(number, bytes(data)))
    return replace(frame, corrected=bytes(data), valid=False), replace(wrong, parsed=parsed)


def _carries(subject: Analysis, heard: _Heard, frame: Frame) -> Carries:
    """Finds the raw numbers in a frame: the word of a parameter, or words of a telegram."""
    raw = (heard.parsed.raw,) if places(heard.message, "raw") else (None,)
    words = telegram_words(heard.message, CanFrame(0, frame.corrected))
    telegrams = {
        name for name, (telegram, _) in subject.places.telegrams.items() if telegram.message == heard.message.name
    }

    def carries(point: Point) -> int | None:
        if point.telegram is not None:
            return from_words(point, tuple(map(words.get, point.addresses))) if point.telegram in telegrams else None
        return from_words(point, raw) if point.addresses == (heard.parsed.address,) else None

    return carries


CHECKS = (messages_differ, parameters_are_reachable)
