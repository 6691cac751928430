"""Decodes CAN frames: cyclic telegrams, requests, and answers to the last request of each unit."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.families.answers import Heard
from fieldscribe.families.can import remarks
from fieldscribe.families.can.frames import carried, carries
from fieldscribe.families.can.notation import read_frames
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
    from fieldscribe.families.can.recognition import Head
    from fieldscribe.families.directory import Directory
    from fieldscribe.families.spoken import Course
    from fieldscribe.model import Device, Message, Telegram

_KINDS = {"request": "request", "response": "reply"}


class CanSpeech(Speech):
    """Decodes the frames of one device; keeps the words of telegrams that come in several frames."""

    def __init__(self, device: Device, can_id: str | None = None) -> None:
        self._device = device
        self._can_id = can_id
        self._receivers: Recent[tuple[int | None, str], Receiver] = Recent()
        self._recogniser = Recogniser(device, self._said)
        self._telegrams = {telegram.message: telegram for telegram in reversed(device.telegrams)}

    def frames(self, texts: Sequence[str]) -> list[Pasted]:
        """The frames that people pasted. Raises UnclearError."""
        return read_frames(texts, self._can_id)

    def hear(self, frame: Pasted, course: Course, directory: Directory, *, expecting: bool = False) -> Spoken:
        """What a frame is; any bytes are safe."""
        del directory, expecting  # the messages themselves tell which frame answers which
        known = None if frame.remote else self._recogniser.recognise(frame.frame)
        if known is None:
            return self._unknown(frame)
        head, heard = known
        return self._message(head, _captured(heard, frame), frame.frame, course)

    def _said(self, head: Head, frame: CanFrame) -> Heard:
        """What the head of a frame says, whatever words it carries."""
        message = head.message
        telegram = self._telegrams.get(message.name)
        own = {"parameter": head.address} if telegram is None else {"multiplexer": head.slot}
        kind = "cyclic" if telegram is not None else _KINDS.get(message.direction, "cyclic")
        said, checks = remarks.message_text(head, frame, telegram), remarks.checks_text(message, frame.data)
        faults = tuple(remarks.faults(head, self._device.bus))
        details = {"message": message.name, **own}
        return Heard(frame.data, "can", kind, head.unit, None, said, (), checks, faults, details=details)

    def _message(self, head: Head, heard: Heard, frame: CanFrame, course: Course) -> Spoken:
        telegram = self._telegrams.get(head.message.name)
        if telegram is None:
            return self._parameter(heard, head, frame, course)
        return self._cyclic(heard, head, frame, telegram)

    def _cyclic(self, heard: Heard, head: Head, frame: CanFrame, telegram: Telegram) -> Spoken:
        per_frame = head.message.words
        first = head.slot * per_frame
        if first >= telegram.words or per_frame == 0:
            return Spoken(replace(heard, findings=(remarks.multiplexer_finding(head.message, telegram),)))
        if head.differences:
            return Spoken(replace(heard, notes=(remarks.DAMAGED,)))
        whose = head.unit, telegram.name
        receiver = self._receivers.of(whose, lambda: Receiver(telegram, head.message, head.unit or 0))
        receiver.keep(head.slot, frame)
        positions = range(first, min(first + per_frame, telegram.words))
        return Spoken(heard, (Piece(telegram, positions, receiver),), head.unit)

    def _parameter(self, heard: Heard, head: Head, frame: CanFrame, course: Course) -> Spoken:
        if head.address is None:
            return Spoken(heard, party=head.unit)
        message, sound = head.message, not head.flaws
        raw = carried(message, frame, "raw") if carries(message, "raw") else None
        known = Asked(head.address, raw)
        asks = message.direction == "request"
        writes = self._writes(message)
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

    def _writes(self, message: Message) -> bool:
        """Whether a message is a request that carries a value, or the answer to one."""
        asked = next((request for request in self._device.messages if request.name == message.answers), message)
        return asked.direction == "request" and carries(asked, "raw")

    def _unknown(self, pasted: Pasted) -> Spoken:
        """The result for a frame that is no message of the device, or an incomplete one."""
        frame = pasted.frame
        base = _captured(Heard(frame.data, "can", "other", None, None, f"CAN {hex_text(frame.id, 3)}"), pasted)
        here = list(senders(self._device, frame))
        if not here:
            note = remarks.foreign_note(self._device)
            return Spoken(replace(base, summary=f"{base.summary}: not of this device", notes=(note,)))
        fault = remarks.unknown_kind(pasted, [message for message, _ in here])
        summary = f"{base.summary}: not readable"
        return Spoken(replace(base, kind="unreadable", unit=here[0][1], summary=summary, faults=(fault,)))


def _captured(heard: Heard, frame: Pasted) -> Heard:
    """What was heard, with all that is known of this very frame."""
    stamp = {"time": frame.stamp.strip("()") or None, "interface": frame.bus or None}
    details = {"can_id": frame.frame.id, **heard.details, **stamp}
    return replace(heard, data=frame.frame.data, shown=frame.shown, details=details)


def speech_of(device: Device, options: Options) -> CanSpeech:
    """The decoder for the frames of the device."""
    return CanSpeech(device, options.own.get("can_id"))
