"""Points of devices with frames of their own, and such frames built by hand."""

from __future__ import annotations

from fieldscribe.families.can.frames import build
from fieldscribe.families.uss.telegrams import telegram
from fieldscribe.model import Device, Point


def coded(device: Device, code: str) -> Point:
    """The first point of that code."""
    return next(one for one in device.points if one.code == code)


def at(device: Device, address: int) -> Point:
    """The first parameter at that address."""
    return next(one for one in device.points if one.space == "parameter" and address in one.addresses)


def can_frame(device: Device, message: str, unit: int, address: int, raw: int = 0) -> str:
    """A frame in the notation of candump."""
    found = next(one for one in device.messages if one.name == message)
    status, frame = build(found, device.bus.units, unit, address, raw)
    assert status == "ok"
    return f"{frame.id:03X}#{frame.data.hex().upper()}"


def uss_bytes(unit: int, words: str) -> str:
    """A telegram in hexadecimal with its length and its check byte."""
    data = bytes.fromhex(words)
    return telegram(unit, [int.from_bytes(data[place : place + 2], "big") for place in range(0, len(data), 2)]).hex()
