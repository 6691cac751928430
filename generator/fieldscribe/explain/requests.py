"""How a point is read and written, as its family does it, each with an example."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.dialogue import dialogue_of

if TYPE_CHECKING:
    from fieldscribe.model import Device, Point


def read_text(device: Device, point: Point) -> str:
    """How to read the point, with a request; empty if it cannot be read."""
    return dialogue_of(device).read_text(device, point)


def write_text(device: Device, point: Point) -> str:
    """How to write the point, with a request for one allowed number; empty if it cannot be written."""
    return dialogue_of(device).write_text(device, point)
