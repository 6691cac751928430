"""How a point is read and written over Modbus, each with one request as an example."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.conversation.samples import sample_raw, sample_said
from fieldscribe.families.modbus.conversation.words import words_of
from fieldscribe.families.modbus.functions import SPACES, profile_of
from fieldscribe.families.modbus.requests import Request, build
from fieldscribe.wording.exact import hex_text

if TYPE_CHECKING:
    from fieldscribe.model import Device, Point


def read_text(device: Device, point: Point) -> str:
    """How to read the point: function, count, and a request in hexadecimal; empty if it cannot be read."""
    if not point.readable or not point.places:
        return ""
    place = point.places[0]
    function = place.function or (SPACES[place.space].read if place.space in SPACES else None)
    if function is None:
        return ""
    count = len(place.addresses)
    items = "bit" if point.type == "bit" else "word"
    how = f"function {hex_text(function, 2)}, {count} {items}{'' if count == 1 else 's'}"
    return how + _example(device, function, min(place.addresses), count, ())


def write_text(device: Device, point: Point) -> str:
    """How to write the point, with a request for one allowed number; empty if it cannot be written."""
    place = point.write_place
    space = SPACES.get(place.space) if place else None
    if not point.writable or place is None or space is None:
        return ""
    count = len(place.addresses)
    allowed = profile_of(device.bus).most
    single = space.write_one if count == 1 and space.write_one in allowed else None
    function = place.function or single or space.write_many
    if function is None:
        return ""
    how = f"function {hex_text(function, 2)}"
    if point.bits is not None:
        return f"{how}; read the word first, replace the bits and write it back, for other points share the word"
    raw = sample_raw(point)
    if raw is None:
        return how
    words = words_of(point, raw, place.addresses)
    return f"{how}; {sample_said(point, raw)}{_example(device, function, min(place.addresses), count, words)}"


def _example(device: Device, function: int, address: int, count: int, values: tuple[int, ...]) -> str:
    """A request to the first of unit 1 and the lowest unit that the device answers to."""
    unit = device.bus.usual_unit
    framing = device.bus.framings[0] if device.bus.framings else "rtu"
    status, data = build(profile_of(device.bus), framing, Request(unit, function, address, count, values))
    if status != "ok":
        return (
            " (the device does not allow this function)" if status == "bad_function" else f" (not possible: {status})"
        )
    return f"; request to unit {unit} ({framing}): {data.hex(' ').upper()}"
