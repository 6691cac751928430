"""Decodes CAN frames: cyclic telegrams, requests, and answers to the last request of each unit.

The bytes that tell which message a frame is (identifier, constants, unit, address, multiplexer) come again and again on
a bus. What follows from them, the head of a frame, is computed once and remembered.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from fieldscribe.families.can import remarks
from fieldscribe.families.can.frames import (
    LENGTH,
    CanFrame,
    Head,
    ParameterWord,
    carried,
    carries,
    differences,
    places,
    sums,
    unit_of,
)
from fieldscribe.families.can.notation import read_frames, read_identifier
from fieldscribe.families.can.receiver import Receiver
from fieldscribe.families.decoded_frame import BoundedMemo, DecodedFrame, FrameBytes, Piece, RecentlyUsed, Word
from fieldscribe.families.frame_results import FrameResult
from fieldscribe.wording.exact import hex_text
from fieldscribe.wording.frames import check_text, strange_unit

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from fieldscribe.families.can.notation import Pasted
    from fieldscribe.families.decoded_frame import OpenRequests
    from fieldscribe.families.directory import Directory
    from fieldscribe.model import Device, Message, Telegram
    from fieldscribe.user_errors import Options

_MOST_HEADS = 2048
"""How many heads of frames are remembered."""
_KINDS = {"request": "request", "response": "reply"}


@dataclass(frozen=True, slots=True)
class Recognised:
    """A recognised frame: its head, the result of the head, and whether its checksum is right."""

    head: Head
    result: FrameResult
    checks: str = ""


class _Candidate:
    """A message that an identifier may carry, and the mask of the bits that make the head of its frames."""

    def __init__(self, message: Message, identifier: int) -> None:
        self.message, self.identifier = message, identifier
        self.summed = carries(message, "xor")
        self._first = next(iter(places(message, "constant")), None)
        self._constant = 0 if self._first is None else message.roles[self._first].number
        head_places = (place for place, role in enumerate(message.roles) if role.kind not in ("word", "raw", "xor"))
        self.head_mask = sum(0xFF << 8 * (LENGTH - 1 - place) for place in head_places)

    def fits(self, data: bytes) -> bool:
        """Return True if the first constant byte is that of the message; else it is another message."""
        return self._first is None or data[self._first] == self._constant


class CanFrameDecoder:
    """Decodes the frames of one device; keeps the words of telegrams that come in several frames."""

    def __init__(self, device: Device, can_id: str | None = None) -> None:
        self._device = device
        self._identifier = None if can_id is None else read_identifier(can_id)
        self._candidates: dict[int, list[_Candidate]] = {}
        self._heads: BoundedMemo[tuple[_Candidate, bool, int], Recognised] = BoundedMemo(_MOST_HEADS, self._head)
        self._receivers: RecentlyUsed[tuple[int | None, str], Receiver] = RecentlyUsed()
        self._telegrams = {telegram.message: telegram for telegram in reversed(device.telegrams)}
        asks = [message for message in device.messages if message.direction == "request" and carries(message, "raw")]
        writing = {message.name for message in asks}
        self._writing = writing | {message.name for message in device.messages if message.answers in writing}
        """The requests that carry a value, and the answers to them."""

    def frames(self, texts: Sequence[str]) -> list[Pasted]:
        """Return the frames in pasted texts. Raises UnclearError."""
        return read_frames(texts, self._identifier)

    def decode(
        self, frame: Pasted, requests: OpenRequests, directory: Directory, *, expecting: bool = False
    ) -> DecodedFrame:
        """Decode one frame; any bytes are safe."""
        del directory, expecting  # the messages themselves tell which frame answers which
        recognised = None if frame.remote else self.recognise(frame.frame)
        if recognised is None:
            return self._unknown(frame)
        telegram = self._telegrams.get(recognised.head.message.name)
        if telegram is None:
            return self._parameter(recognised, frame, requests)
        return self._cyclic(recognised, frame, telegram)

    def recognise(self, frame: CanFrame) -> Recognised | None:
        """Return the message with the fewest flaws for this frame; None if no message fits."""
        if len(frame.data) != LENGTH:
            return None
        candidates = self._candidates.get(frame.id)
        if candidates is None:
            candidates = [_Candidate(message, frame.id) for message, _ in _senders(self._device, frame)]
            if candidates:  # identifiers of other devices are without number
                self._candidates[frame.id] = candidates
        readings = [self._reading(candidate, frame) for candidate in candidates if candidate.fits(frame.data)]
        return (
            min(readings, key=lambda reading: reading.head.flaws) if len(readings) > 1 else next(iter(readings), None)
        )

    def _reading(self, candidate: _Candidate, frame: CanFrame) -> Recognised:
        head_bits = int.from_bytes(frame.data, "big") & candidate.head_mask
        if not candidate.summed:
            return self._heads[candidate, False, head_bits]
        here, right = sums(candidate.message, frame.data)
        recognised = self._heads[candidate, here != right, head_bits]
        return Recognised(recognised.head, recognised.result, check_text(here, right))

    def _head(self, key: tuple[_Candidate, bool, int]) -> Recognised:
        """Return what the head of a frame says, whatever words the frame carries."""
        candidate, wrong_sum, head_bits = key
        message, frame = candidate.message, CanFrame(candidate.identifier, head_bits.to_bytes(LENGTH, "big"))
        (low, high), unit = self._device.bus.units, unit_of(message, frame)
        foreign = unit is not None and message.direction != "request" and not low <= unit <= high
        address = carried(message, frame, "address") if carries(message, "address") else None
        slot = carried(message, frame, "multiplexer")
        head = Head(message, unit, slot, address, differences(message, unit or 0, frame), wrong_sum, foreign)
        telegram = self._telegrams.get(message.name)
        about = {"parameter": address} if telegram is None else {"multiplexer": slot}
        kind = "cyclic" if telegram is not None else _KINDS.get(message.direction, "cyclic")
        text, faults = remarks.message_text(head, frame.id, telegram), tuple(remarks.faults(head, self._device.bus))
        details = {"can_id": frame.id, "message": message.name, **about}
        result = FrameResult(b"", "can", kind, unit, None, text, faults=faults, details=details)
        if telegram is not None and slot * message.words >= (telegram.words if message.words else 0):
            return Recognised(head, replace(result, findings=(remarks.multiplexer_finding(message, telegram),)))
        damaged = telegram is not None and (head.differences or wrong_sum)
        return Recognised(head, replace(result, notes=(remarks.DAMAGED,)) if damaged else result)

    def _cyclic(self, recognised: Recognised, frame: Pasted, telegram: Telegram) -> DecodedFrame:
        head, result = recognised.head, recognised.result
        own_bytes = FrameBytes(frame.frame.data, recognised.checks, frame)
        if result.findings or result.notes:
            return DecodedFrame(result, frame=own_bytes)
        sender = head.unit, telegram.name
        receiver = self._receivers.of(sender, lambda: Receiver(telegram, head.message, head.unit or 0))
        piece = Piece(telegram, receiver.positions[head.slot], receiver.keep(head.slot, frame.frame), receiver)
        return DecodedFrame(result, (piece,), head.unit, frame=own_bytes)

    def _parameter(self, recognised: Recognised, pasted: Pasted, requests: OpenRequests) -> DecodedFrame:
        head, result, frame = recognised.head, recognised.result, pasted.frame
        own_bytes = FrameBytes(frame.data, recognised.checks, pasted)
        if head.address is None:
            return DecodedFrame(result, unit=head.unit, frame=own_bytes)
        message, sound = head.message, not head.flaws
        raw = carried(message, frame, "raw") if carries(message, "raw") else None
        about = ParameterWord(head.address, raw)
        is_request, writes = message.direction == "request", message.name in self._writing
        # an answer reports what the device holds, so it is not checked against limits
        learned = raw is not None and sound and not is_request
        word = Word(head.address, raw, in_request=writes and is_request, learned=learned, stale=writes and sound)
        if is_request:
            strange = "" if head.unit is None else strange_unit(self._device.bus, head.unit)
            result = replace(result, findings=(strange,) if strange else ())
            return DecodedFrame(result, (word,), head.unit, message.name, request=about, frame=own_bytes)
        exchange = message.answers or ""
        open_request: ParameterWord | None = requests.request(head.unit, exchange)
        findings = () if open_request is None else tuple(remarks.answer_findings(open_request, about))
        answers = open_request is not None and open_request.address == about.address
        result = replace(result, findings=findings) if findings else result
        return DecodedFrame(result, (word,), head.unit, exchange, answers=answers, frame=own_bytes)

    def _unknown(self, pasted: Pasted) -> DecodedFrame:
        """Return the result of a frame that is no message of the device, or an incomplete one."""
        frame = pasted.frame
        text = f"CAN {hex_text(frame.id, 3)}"
        result = FrameResult(frame.data, "can", "other", None, None, text, details={"can_id": frame.id})
        senders = list(_senders(self._device, frame))
        if senders:
            fault = remarks.unknown_kind(pasted, [message for message, _ in senders])
            text, unit = f"{text}: not readable", senders[0][1]
            result = replace(result, kind="unreadable", unit=unit, summary=text, faults=(fault,))
        else:
            notes = (remarks.foreign_note(self._device),)
            result = replace(result, summary=f"{text}: not of this device", notes=notes)
        return DecodedFrame(result, frame=FrameBytes(frame.data, captured=pasted))


def decoder_of(device: Device, options: Options) -> CanFrameDecoder:
    """Return the decoder for the frames of the device."""
    return CanFrameDecoder(device, options.own.get("can_id"))


def _senders(device: Device, frame: CanFrame) -> Iterator[tuple[Message, int | None]]:
    """Yield the messages with the identifier of the frame, and the unit that identifier or bytes give."""
    low, high = device.bus.units
    for message in device.messages:
        first, last = (low, high) if message.adds_unit else (0, 0)
        if first <= frame.id - message.identifier <= last:
            yield message, unit_of(message, frame)
