"""The requests that read and write a point, if the family of the device has any."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from fieldscribe.families import family
from fieldscribe.user_errors import UnclearError
from fieldscribe.wording.samples import sample_raw, sample_said

if TYPE_CHECKING:
    from fieldscribe.arithmetic.codec import Settings
    from fieldscribe.families.frame_results import BuiltFrames, WriteMethod
    from fieldscribe.model import Device, Point
    from fieldscribe.user_errors import Options


def part_of(device: Device, name: str) -> Any:
    """A part of the device's family, such as `frame_builder`. Raises UnclearError."""
    part = family(device.family).part(name)
    if part is None:
        message = f"frames of the family {device.family} are not known here"
        raise UnclearError(message, "ask for raw numbers, without frames")
    return part


def frames_for(device: Device, point: Point, raw: int, settings: Settings, options: Options) -> BuiltFrames:
    """The frames that write a raw number. Raises RefusedError, UnclearError."""
    sent: BuiltFrames = part_of(device, "frame_builder").frames_for(device, point, raw, settings, options)
    return sent


def read_text(device: Device, point: Point) -> str:
    """How the point is read, with an example; empty if it cannot be read."""
    part = family(device.family).part("frame_builder")
    return str(part.read_text(device, point)) if part and point.readable and point.addresses else ""


def write_text(device: Device, point: Point) -> str:
    """How the point is written, with an example; empty if it cannot be written."""
    part = family(device.family).part("frame_builder")
    way: WriteMethod | None = part.way_to_write(device, point) if part and point.writable and point.addresses else None
    if way is None:
        return ""
    raw = None if way.example is None else sample_raw(point)
    shown = "" if way.example is None or raw is None else way.example(raw)
    return way.how if raw is None or not shown else f"{way.how}{way.joint}{sample_said(point, raw)}{shown}"
