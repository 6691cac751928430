"""What the head of every output says alike."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from fieldscribe.model import Device


def command(device: Device, target: str) -> str:
    """The command line that makes the output anew; targets encode it as every other text."""
    return device.asked or f"fieldscribe generate {device.id} --target {target}"
