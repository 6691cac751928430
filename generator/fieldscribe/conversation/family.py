"""What conversation must know of one family, and what is said where a family does not offer it yet."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from fieldscribe.conversation.selection import UnclearError
from fieldscribe.families import family

if TYPE_CHECKING:
    from collections.abc import Sequence

    from fieldscribe.conversation.answers import Heard, Sent
    from fieldscribe.conversation.codec import Settings
    from fieldscribe.conversation.options import Options
    from fieldscribe.model import Device, Point


class Conversation(Protocol):
    """What the part `conversation` of a family offers."""

    def decode(self, device: Device, settings: Settings, texts: Sequence[str], options: Options) -> list[Heard]:
        """What pasted frames say, in their order; any bytes are safe. Raises UnclearError for what is no frame."""

    def frames_for(self, device: Device, point: Point, raw: int, settings: Settings, options: Options) -> Sent:
        """The frames that write a raw number. Raises RefusedError."""

    def read_text(self, device: Device, point: Point) -> str:
        """How the point is read, with an example; empty if it cannot be read."""

    def write_text(self, device: Device, point: Point) -> str:
        """How the point is written, with an example; empty if it cannot be written."""


class _Speechless:
    """A family whose frames nobody has described to people."""

    def decode(self, device: Device, settings: Settings, texts: Sequence[str], options: Options) -> list[Heard]:
        """Nobody knows."""
        del settings, texts, options
        raise _unknown(device)

    def frames_for(self, device: Device, point: Point, raw: int, settings: Settings, options: Options) -> Sent:
        """Nobody knows."""
        del point, raw, settings, options
        raise _unknown(device)

    def read_text(self, device: Device, point: Point) -> str:
        """Nothing to say."""
        del device, point
        return ""

    write_text = read_text


def conversation_of(device: Device) -> Conversation:
    """What the device's family knows of frames."""
    offered: Conversation | None = family(device.family).part("conversation")
    return _Speechless() if offered is None else offered


def _unknown(device: Device) -> UnclearError:
    return UnclearError(
        f"frames of the family {device.family} are not known here", "ask for raw numbers, without frames"
    )
