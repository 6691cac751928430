"""Sentences about CAN frames for people: which message one is, and what is unusual about it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.families.can.frames import carries
from fieldscribe.text import line
from fieldscribe.wording import address_text
from fieldscribe.wording.exact import hex_text

if TYPE_CHECKING:
    from collections.abc import Sequence

    from fieldscribe.families.can.frames import CanFrame
    from fieldscribe.families.can.recognition import Recognised
    from fieldscribe.model import Device, Message


def message_text(device: Device, recognised: Recognised) -> str:
    """A frame in one line: `CAN 321h, unit 1, visualisation: multiplexer 0, words 0 to 2 (nr 1 to 3)`."""
    message = recognised.message
    unit = "" if recognised.unit is None else f", unit {recognised.unit}"
    head = f"CAN {hex_text(recognised.frame.id, 3)}{unit}, {message.name}"
    if recognised.address is not None:
        return f"{head}: parameter {address_text(recognised.address)}"
    telegram = next((telegram for telegram in device.telegrams if telegram.message == message.name), None)
    if telegram is None:
        return line(f"{head}: {message.title['en']}")
    first = recognised.slot * message.words
    where = f"multiplexer {recognised.slot}, " if carries(message, "multiplexer") else ""
    return f"{head}: {where}words {first} to {first + message.words - 1} of {telegram.name}"


def identifiers_text(device: Device) -> str:
    """Which identifiers the messages have: `33Fh read_request, write_request; 320h to 33Eh visualisation, ...`."""
    low, high = device.bus.units
    names: dict[str, list[str]] = {}
    for message in device.messages:
        where = hex_text(message.identifier, 3)
        if message.adds_unit:
            where = f"{hex_text(message.identifier + low, 3)} to {hex_text(message.identifier + high, 3)}"
        names.setdefault(where, []).append(message.name)
    return "; ".join(f"{where} {', '.join(here)}" for where, here in names.items())


def unknown_kind(frame: CanFrame, messages: Sequence[Message]) -> str:
    """Why a frame is none of the messages with its identifier."""
    known = []
    for message in messages:
        at = next((place for place, role in enumerate(message.roles) if role.kind == "constant"), None)
        if at is not None:
            known.append((at, message.roles[at].number, message.name))
    place = known[0][0] if known else 0
    names = ", ".join(f"{hex_text(number, 2)} {name}" for _, number, name in known)
    return f"byte {place} is {hex_text(frame.data[place], 2)}; on this identifier it is {names}"
