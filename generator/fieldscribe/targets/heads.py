"""The command line in the head of every generated file."""

from __future__ import annotations

from shlex import quote
from typing import TYPE_CHECKING

from fieldscribe.text import line

if TYPE_CHECKING:
    from collections.abc import Callable

    from fieldscribe.model import Device

LEFT_OUT = "..."
"""Replaces a word that is too long for a head, or that a comment would change."""


def command(device: Device, target: str, encode: Callable[[str], str] = line) -> str:
    """Return the shell command that makes the output again, encoded for a comment of the language."""
    words = map(quote, device.command or ("fieldscribe", "generate", device.id, "--target", target))
    return " ".join(word if encode(word) == word else LEFT_OUT for word in words)
