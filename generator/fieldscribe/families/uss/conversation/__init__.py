"""What people and USS devices say to each other: pasted telegrams into words, values into telegrams."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.conversation.hexadecimal import rejoined, typed_bytes
from fieldscribe.families.uss.conversation.explaining import read_text, write_text
from fieldscribe.families.uss.conversation.links import asked, link_of
from fieldscribe.families.uss.conversation.listener import UssListener
from fieldscribe.families.uss.conversation.sending import frames_for

if TYPE_CHECKING:
    from collections.abc import Sequence

    from fieldscribe.arithmetic.codec import Settings
    from fieldscribe.conversation.answers import Heard
    from fieldscribe.conversation.options import Options
    from fieldscribe.model import Device

__all__ = ["decode", "frames_for", "read_text", "write_text"]


def decode(device: Device, settings: Settings, texts: Sequence[str], options: Options) -> list[Heard]:
    """What pasted telegrams say; with `--request` all of them answer that one. Raises UnclearError."""
    frames = [_bytes(text) for text in rejoined(texts, 2, 4)]
    listening = UssListener(device, settings, link_of(device, options), options.framing or "uss")
    if options.request is None:
        return [listening.hear(data, asked(options).direction) for data in frames]
    heard = [listening.hear(_bytes(options.request), "request")]
    return heard + [listening.hear(data, asked(options).direction or "response", keep=True) for data in frames]


def _bytes(text: str) -> bytes:
    return typed_bytes(text, "telegram", "02 0E 01 143A 0000 0000 0000 0000 0000 23")
