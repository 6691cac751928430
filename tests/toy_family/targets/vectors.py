"""Vectors of strikes."""

from __future__ import annotations

from fieldscribe.model import Bus, Device
from fieldscribe.targets.vectors.lines import Lines

from toy_family import of_bus
from toy_family.frames import strike

KINDS = {"strike": "unit:int tone:int bytes:bytes"}
"""What rings each tone."""


def limits(lines: Lines, bus: Bus) -> None:
    """How often a bell may be struck."""
    lines.add_limits(strikes=of_bus(bus).strikes)


def frames(lines: Lines, device: Device) -> None:
    """Every tone struck once."""
    for point in device.points:
        for tone in point.addresses:
            lines.add("strike", device.bus.units[0], tone, strike(device.bus.units[0], tone))


def wires(lines: Lines, device: Device) -> tuple[()]:
    """Points do not travel: a bell only rings."""
    del lines, device
    return ()
