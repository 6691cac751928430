"""Raw numbers in the words or bits of a frame, and the request that writes a point."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.arithmetic.words import group_mask, split
from fieldscribe.arithmetic.words import raw_of as raw_of_words
from fieldscribe.conversation.refusals import RefusedError
from fieldscribe.conversation.remarks import units_text
from fieldscribe.conversation.selection import label
from fieldscribe.families.modbus.functions import BROADCAST, SPACES, framings_of, profile_of
from fieldscribe.families.modbus.requests import Request, build
from fieldscribe.wording.exact import hex_text

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fieldscribe.model import Device, Place, Point


def raw_of(point: Point, addresses: tuple[int, ...], words: Mapping[int, int]) -> int:
    """The raw number of a point out of words by address; `addresses` has the high part first."""
    return raw_of_words(point, [words[address] for address in addresses])


def words_of(point: Point, raw: int, addresses: tuple[int, ...]) -> tuple[int, ...]:
    """The unsigned words (or the bit) of a raw number, in ascending order of their addresses."""
    if point.type == "bit":
        return (raw,)
    return tuple(word for _, word in sorted(zip(addresses, split(raw, len(addresses)), strict=True)))


def write_request(
    device: Device, point: Point, raw: int, unit: int | None, framing: str | None
) -> tuple[Request, bytes]:
    """The request that writes a raw number, and its bytes. Raises RefusedError."""
    place = point.write_place or point.places[0]
    if point.bits is not None:
        mask = group_mask(point)
        raise RefusedError(
            "shared_word",
            f"{label(point)} shares its word with other points, so no single request can write it",
            f"read {hex_text(min(place.addresses))}, replace the bits of mask {hex_text(mask)} "
            f"by {hex_text(raw << point.bits[1] & mask)}, and write the word back",
        )
    chosen = framing or (device.bus.framings[0] if device.bus.framings else "rtu")
    values = words_of(point, raw, place.addresses)
    request = Request(
        device.bus.usual_unit if unit is None else unit,
        _function(device, place),
        min(place.addresses),
        len(values),
        values,
    )
    status, data = build(profile_of(device.bus), chosen, request)
    if status != "ok":
        raise RefusedError(status, f"{label(point)}: {_STATUS_WORDS.get(status, status)}", _status_hint(device, status))
    return request, data


def _function(device: Device, place: Place) -> int:
    if place.function in BROADCAST:
        return place.function
    space = SPACES[place.space]
    single = space.write_one if len(place.addresses) == 1 else None
    most = profile_of(device.bus).most
    usable = [one for one in (single, space.write_many) if one is not None]
    return next((one for one in usable if one in most), usable[0] if usable else 0)


_STATUS_WORDS = {
    "bad_framing": "the device does not speak this framing",
    "bad_unit": "the device cannot have this unit number",
    "bad_function": "the device allows no function that writes it",
    "bad_count": "it has more words than the device takes in one request",
    "bad_address": "it lies beyond the last address",
}


def _status_hint(device: Device, status: str) -> str:
    if status == "bad_framing":
        return f"it speaks {' and '.join(framings_of(device.bus))}"
    if status != "bad_unit":
        return ""
    everyone = "" if device.bus.broadcast is None else f", or {device.bus.broadcast} for all units at once"
    return f"{units_text(device.bus)}{everyone}"
