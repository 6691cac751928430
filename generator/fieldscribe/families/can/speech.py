"""Decodes CAN frames: cyclic telegrams, requests, and answers to the last request of each unit."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.families.answers import Heard
from fieldscribe.families.can import remarks
from fieldscribe.families.can.frames import carries
from fieldscribe.families.can.notation import read_frames
from fieldscribe.families.can.receiver import Receiver
from fieldscribe.families.can.recognition import Recognised, recognise, senders
from fieldscribe.families.spoken import Piece, Speech, Spoken, Word
from fieldscribe.records import replace
from fieldscribe.wording.buses import strange_unit
from fieldscribe.wording.exact import hex_text

if TYPE_CHECKING:
    from collections.abc import Sequence

    from fieldscribe.asked import Options
    from fieldscribe.families.can.notation import Pasted
    from fieldscribe.families.directory import Directory
    from fieldscribe.families.spoken import Course
    from fieldscribe.model import Device, Message, Telegram

_KINDS = {"request": "request", "response": "reply"}


class CanSpeech(Speech):
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
        details = {"message": message.name, **({"parameter": known.address} if telegram is None else {})}
        details |= {} if telegram is None else {"multiplexer": known.slot}
        kind = "cyclic" if telegram is not None else _KINDS.get(message.direction, "cyclic")
        said, checks = remarks.message_text(known, telegram), remarks.checks_text(known)
        faults = tuple(remarks.faults(known, self._device.bus))
        heard = Heard(known.frame.data, "can", kind, known.unit, None, said, (), checks, faults, details=details)
        return self._parameter(heard, known, course) if telegram is None else self._cyclic(heard, known, telegram)

    def _cyclic(self, heard: Heard, known: Recognised, telegram: Telegram) -> Spoken:
        per_frame = known.message.words
        first = known.slot * per_frame
        if first >= telegram.words or per_frame == 0:
            return Spoken(replace(heard, findings=(remarks.multiplexer_finding(known.message, telegram),)))
        fresh = Receiver(telegram, known.message, known.unit or 0)
        receiver = self._receivers.setdefault((known.unit, telegram.name), fresh)
        if not receiver.take(known.frame):
            return Spoken(replace(heard, notes=(remarks.DAMAGED,)))
        positions = range(first, min(first + per_frame, telegram.words))
        return Spoken(heard, (Piece(telegram, positions, receiver),), known.unit)

    def _parameter(self, heard: Heard, known: Recognised, course: Course) -> Spoken:
        if known.address is None:
            return Spoken(heard, party=known.unit)
        message, sound = known.message, not known.flaws
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
        odd = () if asked is None else tuple(remarks.answer_findings(asked, known))
        answers = asked is not None and asked.address == known.address
        return Spoken(replace(heard, findings=odd), (word,), known.unit, exchange, answers=answers)

    def _writes(self, message: Message) -> bool:
        """Whether a message is a request that carries a value, or the answer to one."""
        asked = next((request for request in self._device.messages if request.name == message.answers), message)
        return asked.direction == "request" and carries(asked, "raw")

    def _unknown(self, pasted: Pasted) -> Spoken:
        """The result for a frame that is no message of the device, or an incomplete one."""
        frame = pasted.frame
        base = Heard(frame.data, "can", "other", None, None, f"CAN {hex_text(frame.id, 3)}")
        here = list(senders(self._device, frame))
        if not here:
            note = remarks.foreign_note(self._device)
            return Spoken(replace(base, summary=f"{base.summary}: not of this device", notes=(note,)))
        fault = remarks.unknown_kind(pasted, [message for message, _ in here])
        summary = f"{base.summary}: not readable"
        return Spoken(replace(base, kind="unreadable", unit=here[0][1], summary=summary, faults=(fault,)))


def speech_of(device: Device, options: Options) -> CanSpeech:
    """The decoder for the frames of the device."""
    return CanSpeech(device, options.own.get("can_id"))
