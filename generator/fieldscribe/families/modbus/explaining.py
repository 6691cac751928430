"""How a point is read and written over Modbus, each with one request as an example."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.families.frame_results import WriteMethod
from fieldscribe.families.modbus.functions import SPACES, framings_of, profile_of
from fieldscribe.families.modbus.requests import Request, build
from fieldscribe.families.modbus.sending import function_for, words_of
from fieldscribe.wording.buses import counted
from fieldscribe.wording.exact import hex_text

if TYPE_CHECKING:
    from fieldscribe.model import Device, Point


def read_text(device: Device, point: Point) -> str:
    """How to read the point: function, count, and a request in hexadecimal; empty if it cannot be read."""
    if point.space not in SPACES:
        return ""
    function, count = SPACES[point.space].read, len(point.addresses)
    how = f"function {hex_text(function, 2)}, {counted(count, 'bit' if point.type == 'bit' else 'word')}"
    return how + _example(device, function, min(point.addresses), count, ())


def way_to_write(device: Device, point: Point) -> WriteMethod | None:
    """How to write the point; None if it cannot be written."""
    addresses = point.written.addresses
    function = function_for(device, point.space, len(addresses)) if point.space in SPACES else None
    if function is None:
        return None
    how = f"function {hex_text(function, 2)}"
    if point.bits is not None:
        return WriteMethod(
            f"{how}; read the word first, replace the bits and write it back, for other points share the word"
        )
    return WriteMethod(
        how,
        lambda raw: _example(device, function, min(addresses), len(addresses), words_of(point, raw, addresses)),
    )


def _example(device: Device, function: int, address: int, count: int, values: tuple[int, ...]) -> str:
    """An example request to unit 1, or to the lowest unit where the device cannot be unit 1."""
    unit = device.bus.usual_unit
    framing = framings_of(device.bus)[0]
    status, data = build(profile_of(device.bus), framing, Request(unit, function, address, count, values))
    if status != "ok":
        return (
            " (the device does not allow this function)" if status == "bad_function" else f" (not possible: {status})"
        )
    return f"; request to unit {unit} ({framing}): {data.hex(' ').upper()}"
