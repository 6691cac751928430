"""What the head of every output says alike."""

from __future__ import annotations

from shlex import quote
from typing import TYPE_CHECKING

from fieldscribe.text import line

if TYPE_CHECKING:
    from collections.abc import Callable

    from fieldscribe.model import Device

LEFT_OUT = "..."
"""Stands for a word that is too long for a head, or that would not come out of it again."""


def command(device: Device, target: str, encode: Callable[[str], str] = line) -> str:
    """The command line that makes the output anew, as a shell takes it and a comment of the language holds it."""
    words = map(quote, device.asked or ("fieldscribe", "generate", device.id, "--target", target))
    return " ".join(word if encode(word) == word else LEFT_OUT for word in words)
