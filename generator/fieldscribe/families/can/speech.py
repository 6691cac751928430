"""Decodes CAN frames: cyclic telegrams, requests, and answers to the last request of each unit."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.families.answers import Heard
from fieldscribe.families.can import remarks
from fieldscribe.families.can.frames import carried, carries
from fieldscribe.families.can.notation import read_frames, read_identifier
from fieldscribe.families.can.receiver import Receiver
from fieldscribe.families.can.recognition import Asked, Recogniser, senders
from fieldscribe.families.spoken import Piece, Recent, Speech, Spoken, Word
from fieldscribe.records import replace
from fieldscribe.wording.buses import strange_unit
from fieldscribe.wording.exact import hex_text

if TYPE_CHECKING:
    from collections.abc import Sequence

    from fieldscribe.asked import Options
    from fieldscribe.families.can.frames import CanFrame
    from fieldscribe.families.can.notation import Pasted
    from fieldscribe.families.can.recognition import Head, Known
    from fieldscribe.families.directory import Directory
    from fieldscribe.families.spoken import Course
    from fieldscribe.model import Device, Telegram

_KINDS = {"request": "request", "response": "reply"}


class CanSpeech(Speech):
    """Decodes the frames of one device; keeps the words of telegrams that come in several frames."""

    def __init__(self, device: Device, can_id: str | None = None) -> None:
        self._device = device
        self._identifier = None if can_id is None else read_identifier(can_id)
        self._receivers: Recent[tuple[int | None, str], Receiver] = Recent()
        self._recogniser = Recogniser(device, self._said)
        self._telegrams = {telegram.message: telegram for telegram in reversed(device.telegrams)}
        asks = [message for message in device.messages if message.direction == "request" and carries(message, "raw")]
        writing = {message.name for message in asks}
        self._writing = writing | {message.name for message in device.messages if message.answers in writing}
        """The requests that carry a value, and the answers to them."""

    def frames(self, texts: Sequence[str]) -> list[Pasted]:
        """The frames that people pasted. Raises UnclearError."""
        return read_frames(texts, self._identifier)

    def hear(self, frame: Pasted, course: Course, directory: Directory, *, expecting: bool = False) -> Spoken:
        """What a frame is; any bytes are safe."""
        del directory, expecting  # the messages themselves tell which frame answers which
        known = None if frame.remote else self._recogniser.recognise(frame.frame)
        if known is None:
            return self._unknown(frame)
        heard, telegram = _captured(known, frame), self._telegrams.get(known.head.message.name)
        if telegram is None:
            return self._parameter(heard, known.head, frame.frame, course)
        return self._cyclic(heard, known.head, frame.frame, telegram)

    def _said(self, head: Head, identifier: int) -> Heard:
        """What the head of a frame says, whatever words it carries."""
        message = head.message
        telegram = self._telegrams.get(message.name)
        own = {"parameter": head.address} if telegram is None else {"multiplexer": head.slot}
        kind = "cyclic" if telegram is not None else _KINDS.get(message.direction, "cyclic")
        said, faults = remarks.message_text(head, identifier, telegram), tuple(remarks.faults(head, self._device.bus))
        details = {"message": message.name, **own}
        heard = Heard(b"", "can", kind, head.unit, None, said, faults=faults, details=details)
        if telegram is not None and head.slot * message.words >= (telegram.words if message.words else 0):
            return replace(heard, findings=(remarks.multiplexer_finding(message, telegram),))
        damaged = telegram is not None and (head.differences or head.wrong_sum)
        return replace(heard, notes=(remarks.DAMAGED,)) if damaged else heard

    def _cyclic(self, heard: Heard, head: Head, frame: CanFrame, telegram: Telegram) -> Spoken:
        if heard.findings or heard.notes:
            return Spoken(heard)
        whose = head.unit, telegram.name
        receiver = self._receivers.of(whose, lambda: Receiver(telegram, head.message, head.unit or 0))
        words = receiver.keep(head.slot, frame)
        return Spoken(heard, (Piece(telegram, receiver.positions[head.slot], words, receiver),), head.unit)

    def _parameter(self, heard: Heard, head: Head, frame: CanFrame, course: Course) -> Spoken:
        if head.address is None:
            return Spoken(heard, party=head.unit)
        message, sound = head.message, not head.flaws
        raw = carried(message, frame, "raw") if carries(message, "raw") else None
        known = Asked(head.address, raw)
        asks = message.direction == "request"
        writes = message.name in self._writing
        learned = raw is not None and sound and not asks
        # an answer reports what the device holds, so it is not checked against limits
        word = Word(head.address, raw, asked=writes and asks, learned=learned, stale=writes and sound)
        if asks:
            strange = "" if head.unit is None else strange_unit(self._device.bus, head.unit)
            heard = replace(heard, findings=(strange,) if strange else ())
            return Spoken(heard, (word,), head.unit, message.name, asks=known)
        exchange = message.answers or ""
        asked: Asked | None = course.asked(head.unit, exchange)
        odd = () if asked is None else tuple(remarks.answer_findings(asked, known))
        answers = asked is not None and asked.address == known.address
        return Spoken(replace(heard, findings=odd), (word,), head.unit, exchange, answers=answers)

    def _unknown(self, pasted: Pasted) -> Spoken:
        """The result for a frame that is no message of the device, or an incomplete one."""
        frame = pasted.frame
        base = Heard(frame.data, "can", "other", None, None, f"CAN {hex_text(frame.id, 3)}")
        base = replace(base, shown=pasted.shown, details=pasted.details)
        here = list(senders(self._device, frame))
        if not here:
            note = remarks.foreign_note(self._device)
            return Spoken(replace(base, summary=f"{base.summary}: not of this device", notes=(note,)))
        fault = remarks.unknown_kind(pasted, [message for message, _ in here])
        summary = f"{base.summary}: not readable"
        return Spoken(replace(base, kind="unreadable", unit=here[0][1], summary=summary, faults=(fault,)))


def _captured(known: Known, frame: Pasted) -> Heard:
    """What the head says, with all that is known of this very frame."""
    heard, captured = known.heard, frame.details
    details = {"can_id": frame.frame.id, **heard.details, **captured}
    return replace(heard, data=frame.frame.data, shown=frame.shown, checks=known.checks, details=details)


def speech_of(device: Device, options: Options) -> CanSpeech:
    """The decoder for the frames of the device."""
    return CanSpeech(device, options.own.get("can_id"))
