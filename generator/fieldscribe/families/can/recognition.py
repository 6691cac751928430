"""Finds the message and the unit of a frame, even if the frame is damaged.

What tells them (identifier, constants, unit, address, multiplexer) comes again and again on a bus, so what follows from
these bytes is worked out once and remembered.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

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
from fieldscribe.families.decoded_frame import BoundedMemo
from fieldscribe.wording.buses import check_text

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from fieldscribe.families.frame_results import FrameResult
    from fieldscribe.model import Device, Message

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
