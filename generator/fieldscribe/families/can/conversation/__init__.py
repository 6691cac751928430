"""What people and CAN devices say to each other: pasted frames into words, values into frames."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.families.can.conversation import sending
from fieldscribe.families.can.conversation.explaining import read_text, write_text
from fieldscribe.families.can.conversation.listener import CanListener
from fieldscribe.families.can.conversation.notation import read_frames

if TYPE_CHECKING:
    from collections.abc import Sequence

    from fieldscribe.arithmetic.codec import Settings
    from fieldscribe.conversation.answers import Heard, Sent
    from fieldscribe.conversation.options import Options
    from fieldscribe.model import Device, Point

__all__ = ["decode", "frames_for", "read_text", "write_text"]


def decode(device: Device, settings: Settings, texts: Sequence[str], options: Options) -> list[Heard]:
    """What pasted frames say; the request of `--request` comes before them. Raises UnclearError."""
    known: str | None = options.own.get("can_id")
    before = [] if options.request is None else read_frames([options.request], known)
    pasted = before + read_frames(texts, known)
    listening = CanListener(device, settings)
    return [listening.hear(one) for one in pasted]


def frames_for(device: Device, point: Point, raw: int, settings: Settings, options: Options) -> Sent:
    """The frames that write a raw number. Raises RefusedError, UnclearError."""
    del settings  # a message carries one parameter alone
    return sending.frames_for(device, point, raw, options)
