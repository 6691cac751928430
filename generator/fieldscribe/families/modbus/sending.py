"""The request that writes a point."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.arithmetic.words import group_mask, split
from fieldscribe.asked import RefusedError
from fieldscribe.families.frame_results import BuiltFrames, refused
from fieldscribe.families.modbus.functions import SPACES, framings_of, profile_of
from fieldscribe.families.modbus.requests import Request, build
from fieldscribe.wording import label
from fieldscribe.wording.buses import spaced, units_text
from fieldscribe.wording.exact import hex_text

if TYPE_CHECKING:
    from fieldscribe.arithmetic.codec import Settings
    from fieldscribe.asked import Options
    from fieldscribe.model import Device, Point


def frames_for(device: Device, point: Point, raw: int, settings: Settings, options: Options) -> BuiltFrames:
    """The request that writes a raw number. Raises RefusedError."""
    del settings  # a request carries only the point
    return BuiltFrames((spaced(write_request(device, point, raw, options.unit, options.framing)[1]),))


def words_of(point: Point, raw: int, addresses: tuple[int, ...]) -> tuple[int, ...]:
    """The unsigned words (or the bit) of a raw number, in ascending order of their addresses."""
    if point.type == "bit":
        return (raw,)
    return tuple(word for _, word in sorted(zip(addresses, split(raw, len(addresses)), strict=True)))


def write_request(
    device: Device, point: Point, raw: int, unit: int | None, framing: str | None
) -> tuple[Request, bytes]:
    """The request that writes a raw number, and its bytes. Raises RefusedError."""
    addresses = point.written.addresses
    if point.bits is not None:
        mask = group_mask(point)
        raise RefusedError(
            "shared_word",
            f"{label(point)} shares its word with other points, so no single request can write it",
            f"read {hex_text(min(addresses))}, replace the bits of mask {hex_text(mask)} "
            f"by {hex_text(raw << point.bits[1] & mask)}, and write the word back",
        )
    values = words_of(point, raw, addresses)
    to = device.bus.usual_unit if unit is None else unit
    function = function_for(device, point.space, len(addresses)) or 0
    request = Request(to, function, min(addresses), len(values), values)
    chosen = framing or framings_of(device.bus)[0]
    status, data = build(profile_of(device.bus), chosen, request)
    if status != "ok":
        raise refused(device.bus, point, status, _hint(device, status))
    return request, data


def function_for(device: Device, space_name: str, count: int) -> int | None:
    """The function that writes a place of so many words or bits: that for a single item, else that for several."""
    space = SPACES[space_name]
    single = count == 1 and space.write_one in profile_of(device.bus).most
    return space.write_one if single else space.write_many or space.write_one


def _hint(device: Device, status: str) -> str:
    if status == "bad_framing":
        return f"it speaks {' and '.join(framings_of(device.bus))}"
    if status == "bad_unit" and device.bus.broadcast is not None:
        return f"{units_text(device.bus)}, or {device.bus.broadcast} for all units at once"
    return ""
