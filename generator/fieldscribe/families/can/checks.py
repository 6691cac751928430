"""What only a CAN device can get wrong: messages that look the same, missing messages, its worked frames."""

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, replace

from fieldscribe.checks import frames_agree
from fieldscribe.checks.addresses_do_not_overlap import APART
from fieldscribe.checks.coexistence import Coexistence, report_missing
from fieldscribe.checks.frames_agree import Seen, Words
from fieldscribe.diagnostics import Span
from fieldscribe.families.can import frames, identifier_bits, identifier_of, signals
from fieldscribe.language.nodes import Map
from fieldscribe.model import Field, Frame, Message, Point
from fieldscribe.resolve.analysis import Analysis
from fieldscribe.resolve.frames import LocatedFrame
from fieldscribe.resolve.points import ResolvedPoint

_WIDEST_SELECTOR, _MOST_VIEWS = 16, 64
_MOST_COMPARED = 64
"""The most messages of one identifier with which each message is compared."""


def messages_differ(subject: Analysis) -> None:
    """Report messages of the same identifier that differ in no constant byte."""
    nodes = {str(node["name"]): node for node in reversed(list(subject.scope.listed("messages")))}
    by_identifier: dict[tuple[int, int], list[Message]] = {}
    low, high = subject.bus.units
    for message in subject.messages:
        reported: set[str] = set()
        units = range(low, high + 1) if message.adds_unit else (0,)
        bits = message.bits or identifier_bits(subject.bus)
        for identifier in (message.identifier + unit for unit in units):
            earlier = by_identifier.setdefault((bits, identifier), [])
            for other in earlier:
                if other.name in reported or subject.report.full or not _look_the_same(other, message):
                    continue
                reported.add(other.name)
                text = f"`{message.name}` and `{other.name}` cannot be told apart under the identifier {identifier:X}h"
                here, there = (_place(nodes[each.name]) for each in (message, other))
                related = [(there, f"`{other.name}` stands here")]
                hint = "a constant byte must differ, or the identifiers; which there are with + unit, `units` says"
                subject.report.error("messages-alike", text, here, hint, related)
            if len(earlier) < _MOST_COMPARED:
                earlier.append(message)


def _place(node: Map) -> Span:
    return node.span("can_id" if "can_id" in node else "pgn")


def _look_the_same(message: Message, other: Message) -> bool:
    pairs = zip(message.roles, other.roles, strict=False)  # messages of signals have none
    return not any(mine.kind == theirs.kind == "constant" and mine.number != theirs.number for mine, theirs in pairs)


def parameters_are_reachable(subject: Analysis) -> None:
    """Report each message that parameters need and that the device does not have."""
    report_missing(subject, _missing_messages)


def _missing_messages(subject: Analysis, points: list[Point]) -> Iterator[tuple[int, str, str, str]]:
    described = list(subject.scope.listed("messages"))
    if subject.scope.is_lost("messages", "messages") or len(subject.messages) < len(described):
        return  # the missing message may have a finding
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
    known = identifier_of(frame)
    can_frame = frames.CanFrame(-1 if known is None else known, frame.printed)
    for carrier in subject.messages:
        if carrier.fields and frames.is_of(carrier, subject.bus.units, can_frame):
            return Seen(frame, None, _words_of_signals(carrier, frame.printed))
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
    """Yield the frame as read by each message that it could be."""
    read_frame = frames.CanFrame(number, frame.printed)
    for message in subject.messages:
        fits = request is None or message.answers == request.message.name
        if message.roles and message.direction == frame.direction and fits:
            unit = frames.unit_of(message, read_frame)
            unit = subject.bus.units[0] if unit is None else unit
            yield _Reading(message, unit, frames.parse(message, unit, read_frame))


def _with_right_checksum(
    subject: Analysis, open_frame: LocatedFrame, number: int, readings: list[_Reading]
) -> tuple[Frame, _Reading | None]:
    """Return the frame with its checksum corrected, and how it is read; None if it is none of the messages."""
    frame = open_frame.frame
    by_status = {reading.parsed.status: reading for reading in reversed(readings)}
    wrong = by_status.get("wrong_check")
    if "ok" in by_status or wrong is None:
        return frame, by_status.get("ok")
    data = frames.summed(wrong.message, frame.printed)
    frames_agree.report_wrong_sum(subject, open_frame, "xor", *frames.sums(wrong.message, frame.printed))
    parsed = frames.parse(wrong.message, wrong.unit, frames.CanFrame(number, data))
    return replace(frame, corrected=data, valid=False), replace(wrong, parsed=parsed)


def _fault(frame: Frame, readings: list[_Reading], reading: _Reading | None, request: _Reading | None) -> str | None:
    """Return why the frame is not a message of the device, or does not answer its request."""
    what = f"does not answer `{frame.answers}`" if request is not None else "is no message of this device"
    if reading is None:
        faults = {tried.parsed.status.replace("_", " ") for tried in readings} or {"wrong id"}
        return f"this {what}: {', '.join(sorted(faults))}"
    if request is not None and (reading.unit, reading.parsed.address) != (request.unit, request.parsed.address):
        return f"this {what}: another unit or another parameter"
    return None


def _words_of_signals(message: Message, data: bytes) -> Words:
    words = signals.words_of(message, data)
    came = [part for part, when in signals.parts(message) if signals.comes(message, when, words)]
    return {(message.name, at, 0): (words[at],) for part in came for at in part}


def _words(subject: Analysis, reading: _Reading, frame: Frame) -> Words:
    """Return the word of a parameter, and the words of telegrams in a frame."""
    message, parsed = reading.message, reading.parsed
    words = frames.telegram_words(message, frames.CanFrame(0, frame.corrected))
    telegrams = [name for name, (telegram, _) in subject.places.telegrams.items() if telegram.message == message.name]
    carried = {(name, address, 0): (word,) for name in telegrams for address, word in words.items()}
    return carried | ({("parameter", parsed.address, 0): (parsed.raw,)} if frames.carries(message, "raw") else {})


def signals_fit(subject: Analysis) -> None:
    """Report signals outside their message, signals that share bits, and conditions that cannot select a signal."""
    coexistence = Coexistence(subject)
    viewed = {each.point.name: each.point.view_of for each in subject.resolved}
    for message in (message for message in subject.messages if not message.roles):
        mine = [each for each in subject.resolved if each.point.telegram == message.name and each.point.addresses]
        if not mine:
            node = next(node for node in subject.scope.listed("messages") if node["name"] == message.name)
            hint = f"add `layout: …`, or a group with `space: signal` and `message: {message.name}`"
            text = f"the message `{message.name}` has neither a layout nor signals"
            subject.report.error("missing-key", text, node.span("name"), hint)
        names, fields = {each.point.name for each in mine}, {field.word: field for field in message.fields}
        taken = signals.TakenBits[ResolvedPoint](message)
        for resolved in mine:
            if subject.report.full:
                return
            field = fields[resolved.point.addresses[0]]
            if not _signal_fits(subject, message, resolved, field, names):
                continue
            near = taken.others(field)
            rival = next((each for each in near if _meet(coexistence, viewed, resolved, each)), None)
            if rival is not None:
                text = f"`{rival.point.name}` and `{resolved.point.name}` share bits of `{message.name}`"
                related = [(rival.facts.span("at"), f"`{rival.point.name}` stands here")]
                hint = f"correct `at` or `type`{APART}"
                subject.report.error("bits-overlap", text, resolved.facts.span("at"), hint, related)
            taken.take(field, resolved)


def _signal_fits(
    subject: Analysis, message: Message, resolved: ResolvedPoint, field: Field, names: Collection[str]
) -> bool:
    """Report a condition that selects nothing; return False, with a finding, for a signal outside its message."""
    point, facts = resolved.point, resolved.facts
    wide = any(message.fields[place].width > _WIDEST_SELECTOR for place, _ in field.when)
    if wide or (signals.selected(point, names) is None and "when" not in facts.failed):
        text, hint = "a selector has at most 16 bits", "compare a narrower signal"
        if not wide:
            text = "a signal comes with numbers of other signals: `page == 3`, joined by `and`, or by `or` for one"
            hint = "write it so"
        subject.report.error("bad-formula", text, facts.span("when"), hint)
    ends = (*field.bits[:1], *field.bits[-1:])
    outside = next((bit for bit in ends if not 0 <= bit < 8 * message.length), None)
    if outside is not None:
        text = f"`{point.name}` lies outside the {message.length} bytes of `{message.name}`: bit {outside}"
        hint = "`at` is the bit of the lowest value with `bytes: low first`, else that of the highest one"
        subject.report.error("bit-outside-word", text, facts.span("at"), hint)
    return outside is None


def _meet(
    coexistence: Coexistence, viewed: Mapping[str, str | None], resolved: ResolvedPoint, other: ResolvedPoint
) -> bool:
    """Return True if two signals with common bits can exist in the same frame and are not views of each other."""
    ends = [resolved.point.name, other.point.name]
    for _ in range(_MOST_VIEWS):  # views of views
        ends = [viewed.get(name) or name for name in ends]
    return ends[0] != ends[1] and not coexistence.exclude(resolved, other)


CHECKS = (messages_differ, signals_fit, parameters_are_reachable)
