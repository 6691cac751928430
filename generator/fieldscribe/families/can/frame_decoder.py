"""Decodes CAN frames: cyclic telegrams, requests, and answers to the last request of each unit."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from fieldscribe.families.can import remarks
from fieldscribe.families.can.frames import carried, carries
from fieldscribe.families.can.notation import read_frames, read_identifier
from fieldscribe.families.can.receiver import Receiver
from fieldscribe.families.can.recognition import Asked, Recogniser, senders
from fieldscribe.families.decoded_frame import DecodedFrame, FrameBytes, FrameDecoder, Piece, RecentlyUsed, Word
from fieldscribe.families.frame_results import FrameResult
from fieldscribe.wording.buses import strange_unit
from fieldscribe.wording.exact import hex_text

if TYPE_CHECKING:
    from collections.abc import Sequence

    from fieldscribe.asked import Options
    from fieldscribe.families.can.notation import Pasted
    from fieldscribe.families.can.recognition import Head, Known
    from fieldscribe.families.decoded_frame import OpenRequests
    from fieldscribe.families.directory import Directory
    from fieldscribe.model import Device, Telegram

_KINDS = {"request": "request", "response": "reply"}


class CanFrameDecoder(FrameDecoder):
    """Decodes the frames of one device; keeps the words of telegrams that come in several frames."""

    def __init__(self, device: Device, can_id: str | None = None) -> None:
        self._device = device
        self._identifier = None if can_id is None else read_identifier(can_id)
        self._receivers: RecentlyUsed[tuple[int | None, str], Receiver] = RecentlyUsed()
        self._recogniser = Recogniser(device, self._said)
        self._telegrams = {telegram.message: telegram for telegram in reversed(device.telegrams)}
        asks = [message for message in device.messages if message.direction == "request" and carries(message, "raw")]
        writing = {message.name for message in asks}
        self._writing = writing | {message.name for message in device.messages if message.answers in writing}
        """The requests that carry a value, and the answers to them."""

    def frames(self, texts: Sequence[str]) -> list[Pasted]:
        """The frames that people pasted. Raises UnclearError."""
        return read_frames(texts, self._identifier)

    def decode(
        self, frame: Pasted, requests: OpenRequests, directory: Directory, *, expecting: bool = False
    ) -> DecodedFrame:
        """What a frame is; any bytes are safe."""
        del directory, expecting  # the messages themselves tell which frame answers which
        known = None if frame.remote else self._recogniser.recognise(frame.frame)
        if known is None:
            return self._unknown(frame)
        telegram = self._telegrams.get(known.head.message.name)
        if telegram is None:
            return self._parameter(known, frame, requests)
        return self._cyclic(known, frame, telegram)

    def _said(self, head: Head, identifier: int) -> FrameResult:
        """What the head of a frame says, whatever words it carries."""
        message = head.message
        telegram = self._telegrams.get(message.name)
        own = {"parameter": head.address} if telegram is None else {"multiplexer": head.slot}
        kind = "cyclic" if telegram is not None else _KINDS.get(message.direction, "cyclic")
        said, faults = remarks.message_text(head, identifier, telegram), tuple(remarks.faults(head, self._device.bus))
        details = {"can_id": identifier, "message": message.name, **own}
        heard = FrameResult(b"", "can", kind, head.unit, None, said, faults=faults, details=details)
        if telegram is not None and head.slot * message.words >= (telegram.words if message.words else 0):
            return replace(heard, findings=(remarks.multiplexer_finding(message, telegram),))
        damaged = telegram is not None and (head.differences or head.wrong_sum)
        return replace(heard, notes=(remarks.DAMAGED,)) if damaged else heard

    def _cyclic(self, known: Known, frame: Pasted, telegram: Telegram) -> DecodedFrame:
        head, own = known.head, FrameBytes(frame.frame.data, known.checks, frame)
        if known.heard.findings or known.heard.notes:
            return DecodedFrame(known.heard, frame=own)
        whose = head.unit, telegram.name
        receiver = self._receivers.of(whose, lambda: Receiver(telegram, head.message, head.unit or 0))
        piece = Piece(telegram, receiver.positions[head.slot], receiver.keep(head.slot, frame.frame), receiver)
        return DecodedFrame(known.heard, (piece,), head.unit, frame=own)

    def _parameter(self, known: Known, pasted: Pasted, requests: OpenRequests) -> DecodedFrame:
        head, heard, frame = known.head, known.heard, pasted.frame
        own = FrameBytes(frame.data, known.checks, pasted)
        if head.address is None:
            return DecodedFrame(heard, unit=head.unit, frame=own)
        message, sound = head.message, not head.flaws
        raw = carried(message, frame, "raw") if carries(message, "raw") else None
        about = Asked(head.address, raw)
        asks = message.direction == "request"
        writes = message.name in self._writing
        learned = raw is not None and sound and not asks
        # an answer reports what the device holds, so it is not checked against limits
        word = Word(head.address, raw, in_request=writes and asks, learned=learned, stale=writes and sound)
        if asks:
            strange = "" if head.unit is None else strange_unit(self._device.bus, head.unit)
            heard = replace(heard, findings=(strange,) if strange else ())
            return DecodedFrame(heard, (word,), head.unit, message.name, request=about, frame=own)
        exchange = message.answers or ""
        asked: Asked | None = requests.request(head.unit, exchange)
        odd = () if asked is None else tuple(remarks.answer_findings(asked, about))
        answers = asked is not None and asked.address == about.address
        heard = replace(heard, findings=odd) if odd else heard
        return DecodedFrame(heard, (word,), head.unit, exchange, answers=answers, frame=own)

    def _unknown(self, pasted: Pasted) -> DecodedFrame:
        """The result for a frame that is no message of the device, or an incomplete one."""
        frame = pasted.frame
        said = f"CAN {hex_text(frame.id, 3)}"
        base = FrameResult(frame.data, "can", "other", None, None, said, details={"can_id": frame.id})
        here = list(senders(self._device, frame))
        if not here:
            note = remarks.foreign_note(self._device)
            heard = replace(base, summary=f"{said}: not of this device", notes=(note,))
            return DecodedFrame(heard, frame=FrameBytes(frame.data, captured=pasted))
        fault = remarks.unknown_kind(pasted, [message for message, _ in here])
        heard = replace(base, kind="unreadable", unit=here[0][1], summary=f"{said}: not readable", faults=(fault,))
        return DecodedFrame(heard, frame=FrameBytes(frame.data, captured=pasted))


def decoder_of(device: Device, options: Options) -> CanFrameDecoder:
    """The decoder for the frames of the device."""
    return CanFrameDecoder(device, options.own.get("can_id"))
