"""Decodes CAN frames: cyclic telegrams, requests, and answers to the last request of each unit."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from fieldscribe.families.answers import Heard
from fieldscribe.families.can.frames import LENGTH
from fieldscribe.families.can.notation import read_frames
from fieldscribe.families.can.receiver import Receiver
from fieldscribe.families.can.recognition import Recognised, recognise, senders
from fieldscribe.families.can.remarks import identifiers_text, message_text, unknown_kind
from fieldscribe.families.spoken import Piece, Spoken, Word
from fieldscribe.wording.buses import strange_unit, words_text
from fieldscribe.wording.exact import hex_text

if TYPE_CHECKING:
    from collections.abc import Sequence

    from fieldscribe.asked import Options
    from fieldscribe.families.can.notation import Pasted
    from fieldscribe.families.directory import Directory
    from fieldscribe.families.spoken import Course
    from fieldscribe.model import Device, Message, Telegram

_KINDS = {"request": "request", "response": "reply"}


class CanSpeech:
    """Decodes the frames of one device; keeps the words of telegrams that come in several frames."""

    def __init__(self, device: Device, can_id: str | None = None) -> None:
        self._device = device
        self._can_id = can_id
        self._receivers: dict[tuple[int | None, str], Receiver] = {}

    def frames(self, texts: Sequence[str]) -> list[Pasted]:
        """The frames that people pasted. Raises UnclearError."""
        return read_frames(texts, self._can_id)

    def hear(self, frame: Pasted, course: Course, directory: Directory, *, expecting: bool = False) -> Spoken:
        """What a frame is; any bytes are safe."""
        del directory, expecting  # the messages themselves tell which frame answers which
        known = None if frame.remote else recognise(self._device, frame.frame)
        spoken = self._unknown(frame) if known is None else self._message(known, course)
        stamp = {"time": frame.stamp.strip("()") or None, "interface": frame.bus or None}
        details = {"can_id": frame.frame.id, **spoken.heard.details, **stamp}
        return replace(spoken, heard=replace(spoken.heard, shown=frame.shown, details=details))

    def _message(self, known: Recognised, course: Course) -> Spoken:
        message = known.message
        telegram = next((telegram for telegram in self._device.telegrams if telegram.message == message.name), None)
        said = message_text(self._device, known)
        details = {"message": message.name, **({"parameter": known.address} if telegram is None else {})}
        details |= {} if telegram is None else {"multiplexer": known.slot}
        kind = "cyclic" if telegram is not None else _KINDS.get(message.direction, "cyclic")
        heard = Heard(
            known.frame.data, "can", kind, known.unit, None, said, (), known.checks, known.faults, details=details
        )
        return self._parameter(heard, known, course) if telegram is None else self._cyclic(heard, known, telegram)

    def _cyclic(self, heard: Heard, known: Recognised, telegram: Telegram) -> Spoken:
        per_frame = known.message.words
        first = known.slot * per_frame
        if first >= telegram.words or per_frame == 0:
            last = -(-telegram.words // max(1, per_frame)) - 1
            return Spoken(replace(heard, findings=(f"the manual knows multiplexers 0 to {last} only",)))
        fresh = Receiver(telegram, known.message, known.unit or 0)
        receiver = self._receivers.setdefault((known.unit, telegram.name), fresh)
        if not receiver.take(known.frame):
            return Spoken(replace(heard, notes=("its words are not read, for the frame is damaged",)))
        positions = range(first, min(first + per_frame, telegram.words))
        return Spoken(heard, (Piece(telegram, positions, receiver),), known.unit)

    def _parameter(self, heard: Heard, known: Recognised, course: Course) -> Spoken:
        if known.address is None:
            return Spoken(heard, party=known.unit)
        message, sound = known.message, not known.faults
        asks = message.direction == "request"
        writes = self._writes(message)
        learned = known.raw is not None and sound and not asks
        # an answer reports what the device holds, so it is not checked against limits
        word = Word(known.address, known.raw, asked=writes and asks, learned=learned, stale=writes and sound)
        if asks:
            strange = "" if known.unit is None else strange_unit(self._device.bus, known.unit)
            heard = replace(heard, findings=(strange,) if strange else ())
            return Spoken(heard, (word,), known.unit, message.name, asks=known)
        exchange = message.answers or ""
        asked: Recognised | None = course.asked(known.unit, exchange)
        odd = "" if asked is None else _course_finding(asked, known)
        answers = asked is not None and asked.address == known.address
        return Spoken(replace(heard, findings=(odd,) if odd else ()), (word,), known.unit, exchange, answers=answers)

    def _writes(self, message: Message) -> bool:
        """Whether a message is a request that carries a value, or the answer to one."""
        asked = next((request for request in self._device.messages if request.name == message.answers), message)
        return asked.direction == "request" and any(role.kind == "raw" for role in asked.roles)

    def _unknown(self, pasted: Pasted) -> Spoken:
        """The result for a frame that is no message of the device, or an incomplete one."""
        frame = pasted.frame
        base = Heard(frame.data, "can", "other", None, None, f"CAN {hex_text(frame.id, 3)}")
        here = list(senders(self._device, frame))
        if not here:
            note = f"no message of {self._device.id} has this identifier: {identifiers_text(self._device)}"
            return Spoken(replace(base, summary=f"{base.summary}: not of this device", notes=(note,)))
        if pasted.remote:
            fault = "a remote request carries no data, and the manual knows none"
        elif len(frame.data) != LENGTH:
            fault = f"every message has {LENGTH} bytes, here are {len(frame.data)}"
        else:
            fault = unknown_kind(frame, [message for message, _ in here])
        summary = f"{base.summary}: not readable"
        return Spoken(replace(base, kind="unreadable", unit=here[0][1], summary=summary, faults=(fault,)))


def speech_of(device: Device, options: Options) -> CanSpeech:
    """The decoder for the frames of the device."""
    return CanSpeech(device, options.own.get("can_id"))


def _course_finding(asked: Recognised, known: Recognised) -> str:
    """How an answer contradicts the request before it; empty if it does not."""
    if asked.address != known.address:
        return f"the request before asked for parameter {asked.address}, this answers {known.address}"
    if asked.raw is not None and asked.raw != known.raw:
        was, came = (words_text((word or 0,)) for word in (asked.raw, known.raw))
        return f"it does not repeat what was written: {was} was, {came} came back"
    return ""
