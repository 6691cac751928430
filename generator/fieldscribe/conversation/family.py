"""What conversation must know of one family, and what is said where a family does not offer it yet."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.conversation.selection import UnclearError
from fieldscribe.families import family

if TYPE_CHECKING:
    from collections.abc import Sequence

    from fieldscribe.arithmetic.codec import Settings
    from fieldscribe.conversation.answers import Heard, Sent
    from fieldscribe.conversation.options import Options
    from fieldscribe.model import Device, Point


class Conversation:
    """What the part `conversation` of a family offers; what is here holds where it offers nothing."""

    def decode(self, device: Device, settings: Settings, texts: Sequence[str], options: Options) -> list[Heard]:
        """What pasted frames say, in their order; any bytes are safe. Raises UnclearError for what is no frame."""
        del settings, texts, options
        raise _unknown(device)

    def frames_for(self, device: Device, point: Point, raw: int, settings: Settings, options: Options) -> Sent:
        """The frames that write a raw number. Raises RefusedError."""
        del point, raw, settings, options
        raise _unknown(device)

    def read_text(self, device: Device, point: Point) -> str:
        """How the point is read, with an example; empty if it cannot be read."""
        del device, point
        return ""

    def write_text(self, device: Device, point: Point) -> str:
        """How the point is written, with an example; empty if it cannot be written."""
        del device, point
        return ""


def conversation_of(device: Device) -> Conversation:
    """What the device's family knows of frames."""
    offered: Conversation = family(device.family).part("conversation") or Conversation()
    return offered


def _unknown(device: Device) -> UnclearError:
    return UnclearError(
        f"frames of the family {device.family} are not known here", "ask for raw numbers, without frames"
    )
