"""Finds the message and the unit of a frame, even if the frame is damaged."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.families.can.frames import LENGTH, CanFrame, Difference, carried, carries, differences, places, unit_of
from fieldscribe.records import dataclass

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Device, Message


@dataclass(frozen=True, slots=True)
class Recognised:
    """A frame read as a message. `foreign`: it answers for a unit that the device cannot have."""

    message: Message
    unit: int | None
    frame: CanFrame
    differences: tuple[Difference, ...]
    foreign: bool

    @property
    def flaws(self) -> int:
        """How much is wrong; a checksum counts once."""
        wrong = [difference.kind for difference in self.differences]
        return self.foreign + len(wrong) - max(0, wrong.count("xor") - 1)

    @property
    def slot(self) -> int:
        """The multiplexer; 0 without one."""
        return carried(self.message, self.frame, "multiplexer")

    @property
    def address(self) -> int | None:
        """The parameter that the message is about."""
        return carried(self.message, self.frame, "address") if carries(self.message, "address") else None

    @property
    def raw(self) -> int | None:
        """The word that the message carries."""
        return carried(self.message, self.frame, "raw") if carries(self.message, "raw") else None


def recognise(device: Device, frame: CanFrame) -> Recognised | None:
    """The message with the fewest flaws for this frame; None if no message fits."""
    if len(frame.data) != LENGTH:
        return None
    readings = [_read(device, message, unit, frame) for message, unit in senders(device, frame)]
    return min((reading for reading in readings if _is_kind(reading)), key=lambda reading: reading.flaws, default=None)


def senders(device: Device, frame: CanFrame) -> Iterator[tuple[Message, int | None]]:
    """The messages with the identifier of the frame, and the unit that identifier or bytes give."""
    low, high = device.bus.units
    for message in device.messages:
        numbers = (low, high) if message.adds_unit else (0, 0)
        if numbers[0] <= frame.id - message.identifier <= numbers[1]:
            yield message, unit_of(message, frame)


def _read(device: Device, message: Message, unit: int | None, frame: CanFrame) -> Recognised:
    low, high = device.bus.units
    foreign = unit is not None and message.direction != "request" and not low <= unit <= high
    return Recognised(message, unit, frame, differences(message, unit or 0, frame), foreign)


def _is_kind(reading: Recognised) -> bool:
    """Whether the first constant byte is that of the message; else it is another message."""
    first = places(reading.message, "constant")[:1]
    return all(difference.place not in first for difference in reading.differences)
