"""Sentences about CAN frames: the message, faults, findings and notes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from fieldscribe.families.can.frames import LENGTH, Head, ParameterWord, carries, places
from fieldscribe.families.can.notation import Pasted
from fieldscribe.model import Bus, Device, Message, Telegram
from fieldscribe.text import line
from fieldscribe.wording import address_text
from fieldscribe.wording.exact import hex_text
from fieldscribe.wording.frames import hex_words, strange_unit

DAMAGED = "its words are not read, for the frame is damaged"


def message_text(head: Head, identifier: int, telegram: Telegram | None) -> str:
    """Return a frame in one line: `CAN 321h, unit 1, visualisation: multiplexer 0, words 0 to 2 (nr 1 to 3)`."""
    message = head.message
    unit = "" if head.unit is None else f", unit {head.unit}"
    name = f"CAN {hex_text(identifier, 3)}{unit}, {message.name}"
    if head.address is not None:
        return f"{name}: parameter {address_text(head.address)}"
    if telegram is None:
        return line(f"{name}: {message.title['en']}")
    first = head.slot * message.words
    where = f"multiplexer {head.slot}, " if carries(message, "multiplexer") else ""
    return f"{name}: {where}words {first} to {first + message.words - 1} of {telegram.name}"


def foreign_note(device: Device) -> str:
    """Return the identifiers of the messages: `33Fh read_request, write_request; 320h to 33Eh visualisation, ...`."""
    low, high = device.bus.units
    names: dict[str, list[str]] = {}
    for message in device.messages:
        where = hex_text(message.identifier, 3)
        if message.adds_unit:
            where = f"{hex_text(message.identifier + low, 3)} to {hex_text(message.identifier + high, 3)}"
        names.setdefault(where, []).append(message.name)
    known = "; ".join(f"{where} {', '.join(here)}" for where, here in names.items())
    return f"no message of {device.id} has this identifier: {known}"


def faults(head: Head, bus: Bus) -> Iterator[str]:
    """Yield what is wrong with a frame as this message."""
    if head.foreign:
        yield strange_unit(bus, head.unit or 0)
    for byte in head.differences:
        here, due = hex_text(byte.here, 2), hex_text(byte.due, 2)
        yield f"byte {byte.place} is {here}, in this message it is {due}"
    if head.wrong_sum:
        yield "the checksum is wrong"


def multiplexer_finding(message: Message, telegram: Telegram) -> str:
    """Return the finding that a telegram has no words at a multiplexer."""
    last = -(-telegram.words // max(1, message.words)) - 1
    return f"the manual knows multiplexers 0 to {last} only"


def answer_findings(request: ParameterWord, answer: ParameterWord) -> Iterator[str]:
    """Yield how an answer contradicts the request before it."""
    if request.address != answer.address:
        yield f"the request before asked for parameter {request.address}, this answers {answer.address}"
    elif request.raw is not None and request.raw != answer.raw:
        was, came = (hex_words((word or 0,)) for word in (request.raw, answer.raw))
        yield f"it does not repeat what was written: {was} was, {came} came back"


def unknown_kind(pasted: Pasted, messages: Sequence[Message]) -> str:
    """Return why a frame is none of the messages with its identifier."""
    frame = pasted.frame
    if pasted.remote:
        return "a remote request carries no data, and the manual knows none"
    if len(frame.data) != LENGTH:
        return f"every message has {LENGTH} bytes, here are {len(frame.data)}"
    known = [(at, message) for message in messages for at in places(message, "constant")[:1]]
    place = known[0][0] if known else 0
    names = ", ".join(f"{hex_text(message.roles[at].number, 2)} {message.name}" for at, message in known)
    return f"byte {place} is {hex_text(frame.data[place], 2)}; on this identifier it is {names}"
