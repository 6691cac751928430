"""Finds the message and the unit of a frame, even if the frame is damaged."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.families.can.frames import LENGTH, CanFrame, carried, carries, checksum
from fieldscribe.wording.buses import check_text, strange_unit
from fieldscribe.wording.exact import hex_text

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Bus, Device, Message


@dataclass(frozen=True, slots=True)
class Recognised:
    """A frame read as a message. `checks` describes its checksum, `faults` what is wrong."""

    message: Message
    unit: int | None
    frame: CanFrame
    checks: str = ""
    faults: tuple[str, ...] = ()

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
    """The message with the fewest faults for this frame; None if no message fits."""
    readings = [_read(message, unit, frame, device.bus) for message, unit in senders(device, frame)]
    whole = [reading for reading in readings if reading is not None]
    return min(whole, key=lambda reading: len(reading.faults), default=None)


def senders(device: Device, frame: CanFrame) -> Iterator[tuple[Message, int | None]]:
    """The messages with the identifier of the frame, and the unit that the identifier gives."""
    low, high = device.bus.units
    for message in device.messages:
        if message.adds_unit:
            if low <= frame.id - message.identifier <= high:
                yield message, frame.id - message.identifier
        elif frame.id == message.identifier:
            yield message, carried(message, frame, "unit") if carries(message, "unit") else None


def _read(message: Message, unit: int | None, frame: CanFrame, bus: Bus) -> Recognised | None:
    """The frame read as this message; None where the first constant byte shows that it is another message."""
    if len(frame.data) != LENGTH:
        return None
    bytes_by_role = list(zip(message.roles, frame.data, strict=True))
    fixed = [(role.number, byte) for role, byte in bytes_by_role if role.kind == "constant"]
    if fixed and fixed[0][0] != fixed[0][1]:
        return None
    faults = []
    if unit is not None and message.direction != "request" and (strange := strange_unit(bus, unit)):
        faults.append(strange)
    for place, (role, byte) in enumerate(bytes_by_role):
        right = byte
        if role.kind == "constant":
            right = role.number
        elif role.kind == "unit" and unit is not None:
            right = unit >> role.number & 0xFF
        if byte != right:
            faults.append(f"byte {place} is {hex_text(byte, 2)}, in this message it is {hex_text(right, 2)}")
    sums = [(byte, checksum(frame.data, role.number)) for role, byte in bytes_by_role if role.kind == "xor"]
    checks = ""
    if sums:
        there, right_sums = (bytes(pair[at] for pair in sums) for at in (0, 1))
        checks = check_text(there, right_sums)
        faults += ["the checksum is wrong"] if there != right_sums else []
    return Recognised(message, unit, frame, checks, tuple(faults))
