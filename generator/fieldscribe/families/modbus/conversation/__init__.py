"""What people and Modbus say to each other: pasted frames into words, values into requests."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.conversation.answers import Sent
from fieldscribe.conversation.hexadecimal import rejoined, spaced, typed_bytes
from fieldscribe.families.modbus.conversation.explaining import read_text, write_text
from fieldscribe.families.modbus.conversation.listener import ModbusListener
from fieldscribe.families.modbus.conversation.words import write_request

if TYPE_CHECKING:
    from collections.abc import Sequence

    from fieldscribe.arithmetic.codec import Settings
    from fieldscribe.conversation.answers import Heard
    from fieldscribe.conversation.options import Options
    from fieldscribe.model import Device, Point

__all__ = ["decode", "frames_for", "read_text", "write_text"]


def decode(device: Device, settings: Settings, texts: Sequence[str], options: Options) -> list[Heard]:
    """What pasted frames say. Raises UnclearError."""
    frames = [_bytes(text) for text in rejoined(texts, 2)]
    listening = ModbusListener(device, settings, options.framing)
    heard = [] if options.request is None else [listening.expect_reply_to(_bytes(options.request))]
    return heard + [listening.hear(data) for data in frames]


def frames_for(device: Device, point: Point, raw: int, settings: Settings, options: Options) -> Sent:
    """The request that writes a raw number. Raises RefusedError."""
    del settings  # a Modbus request carries nothing but the point
    return Sent((spaced(write_request(device, point, raw, options.unit, options.framing)[1]),))


def _bytes(text: str) -> bytes:
    return typed_bytes(text, "frame", "05 06 10 28 01 F4 0C 91")
