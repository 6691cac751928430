"""Texts of devices: two characters in each word, the first in the high byte, padded with spaces."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.text import line
from fieldscribe.user_errors import RefusedError
from fieldscribe.wording import label

if TYPE_CHECKING:
    from fieldscribe.model import Point

_SENT = {"ascii": ((0x20, 0x7E),), "latin-1": ((0x20, 0x7E), (0xA0, 0xFF))}
"""The ranges of characters that may be written, by encoding."""


def text_of(pattern: int, words: int) -> str:
    """The text as an instrument shows it, without padding; each byte is one character."""
    return pattern.to_bytes(2 * words, "big").rstrip(b" ").decode("latin-1")


def shown(text: str) -> str:
    """A received text in quotes; unprintable characters and repeated spaces are escaped."""
    pairs = zip(f'"{text}', text, strict=False)
    plain = [char.isprintable() and char not in '"\\' and before + char != "  " for before, char in pairs]
    escaped = (char if fine else f"\\x{ord(char):02X}" for char, fine in zip(text, plain, strict=True))
    return f'"{"".join(escaped)}"'


def pattern_of_text(point: Point, typed: str) -> int:
    """The words of a typed text as one number, the first characters in the highest bits. Raises RefusedError."""
    layout = point.text
    if layout is None:
        raise RefusedError("out_of_range", f"{label(point)} is no text")
    spans = _SENT.get(layout.encoding, _SENT["ascii"])
    strange = next((char for char in typed if not any(low <= ord(char) <= high for low, high in spans)), None)
    if strange is not None:
        said = line(strange) or f"U+{ord(strange):04X}"
        message = f"{label(point)} cannot hold `{said}`: its characters are {layout.encoding}"
        raise RefusedError("out_of_range", message)
    if len(typed) > layout.characters:
        message = f"{label(point)} has {layout.characters} characters, here are {len(typed)}"
        raise RefusedError("out_of_range", message)
    return int.from_bytes(typed.ljust(layout.characters).encode("latin-1"), "big")
