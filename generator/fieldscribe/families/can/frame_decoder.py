"""Decodes CAN frames: cyclic telegrams, requests, and answers to the last request of each unit."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from fieldscribe.families.can import remarks
from fieldscribe.families.can.frames import (
    LENGTH,
    CanFrame,
    Difference,
    carried,
    carries,
    differences,
    places,
    sums,
    unit_of,
)
from fieldscribe.families.can.notation import read_frames, read_identifier
from fieldscribe.families.can.receiver import Receiver
from fieldscribe.families.decoded_frame import (
    BoundedMemo,
    DecodedFrame,
    FrameBytes,
    FrameDecoder,
    Piece,
    RecentlyUsed,
    Word,
)
from fieldscribe.families.frame_results import FrameResult
from fieldscribe.wording.exact import hex_text
from fieldscribe.wording.frames import check_text, strange_unit

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from fieldscribe.families.can.notation import Pasted
    from fieldscribe.families.decoded_frame import OpenRequests
    from fieldscribe.families.directory import Directory
    from fieldscribe.model import Device, Message, Telegram
    from fieldscribe.user_errors import Options


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


_MOST = 2048
"""How many heads of frames are remembered."""


@dataclass(frozen=True, slots=True)
class Head:
    """A frame read as a message, without its words. `foreign`: it answers for a unit that the device cannot have.

    `slot` is the multiplexer (0 without one), `address` the parameter that the message is about, if it is about one.
    """

    message: Message
    unit: int | None
    slot: int
    address: int | None
    differences: tuple[Difference, ...]
    wrong_sum: bool
    foreign: bool

    @property
    def flaws(self) -> int:
        """How much is wrong; a checksum counts once."""
        return self.foreign + self.wrong_sum + len(self.differences)


@dataclass(frozen=True, slots=True)
class Asked:
    """The parameter that a request or its answer is about, and the word that it carries."""

    address: int
    raw: int | None


@dataclass(frozen=True, slots=True)
class Known:
    """A recognised frame: its head, what the head says, and what its checksum says."""

    head: Head
    heard: FrameResult
    checks: str = ""


class Recogniser:
    """Recognises the frames of a device; `said` puts what the head of a frame with this identifier tells into words."""

    def __init__(self, device: Device, said: Callable[[Head, int], FrameResult]) -> None:
        self._device = device
        self._said = said
        self._candidates: dict[int, list[_Candidate]] = {}
        self._heads: BoundedMemo[tuple[_Candidate, bool, int], Known] = BoundedMemo(_MOST, self._known)

    def recognise(self, frame: CanFrame) -> Known | None:
        """The message with the fewest flaws for this frame, and what it says; None if no message fits."""
        if len(frame.data) != LENGTH:
            return None
        readings = [self._read(candidate, frame) for candidate in self._of(frame) if candidate.is_kind(frame.data)]
        return min(readings, key=lambda known: known.head.flaws) if len(readings) > 1 else next(iter(readings), None)

    def _of(self, frame: CanFrame) -> list[_Candidate]:
        known = self._candidates.get(frame.id)
        if known is None:
            known = [_Candidate(message, frame.id) for message, _ in senders(self._device, frame)]
            if known:  # identifiers of other devices are without number
                self._candidates[frame.id] = known
        return known

    def _read(self, candidate: _Candidate, frame: CanFrame) -> Known:
        telling = int.from_bytes(frame.data, "big") & candidate.telling
        if not candidate.summed:
            return self._heads[candidate, False, telling]
        here, right = sums(candidate.message, frame.data)
        known = self._heads[candidate, here != right, telling]
        return Known(known.head, known.heard, check_text(here, right))

    def _known(self, key: tuple[_Candidate, bool, int]) -> Known:
        candidate, wrong_sum, telling = key
        frame = CanFrame(candidate.identifier, telling.to_bytes(LENGTH, "big"))
        head = _head(self._device, candidate.message, frame, wrong_sum=wrong_sum)
        return Known(head, self._said(head, frame.id))


class _Candidate:
    """A message that an identifier may carry, and which bits of its frames make their heads."""

    def __init__(self, message: Message, identifier: int) -> None:
        self.message, self.identifier = message, identifier
        self.summed = carries(message, "xor")
        self._first = next(iter(places(message, "constant")), None)
        self._constant = 0 if self._first is None else message.roles[self._first].number
        told = [place for place, role in enumerate(message.roles) if role.kind not in ("word", "raw", "xor")]
        self.telling = sum(0xFF << 8 * (LENGTH - 1 - place) for place in told)

    def is_kind(self, data: bytes) -> bool:
        """Whether the first constant byte is that of the message; else it is another message."""
        return self._first is None or data[self._first] == self._constant


def senders(device: Device, frame: CanFrame) -> Iterator[tuple[Message, int | None]]:
    """The messages with the identifier of the frame, and the unit that identifier or bytes give."""
    low, high = device.bus.units
    for message in device.messages:
        numbers = (low, high) if message.adds_unit else (0, 0)
        if numbers[0] <= frame.id - message.identifier <= numbers[1]:
            yield message, unit_of(message, frame)


def _head(device: Device, message: Message, frame: CanFrame, *, wrong_sum: bool) -> Head:
    low, high = device.bus.units
    unit = unit_of(message, frame)
    foreign = unit is not None and message.direction != "request" and not low <= unit <= high
    address = carried(message, frame, "address") if carries(message, "address") else None
    slot = carried(message, frame, "multiplexer")
    return Head(message, unit, slot, address, differences(message, unit or 0, frame), wrong_sum, foreign)
