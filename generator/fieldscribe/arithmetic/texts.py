"""Texts and the words that hold them."""

from __future__ import annotations

from fieldscribe.model import Text

_BLANK = " "


def text_of(layout: Text, pattern: int) -> str:
    """Return the text that all words as one number hold, without what fills it up; each byte is one character."""
    data = _swapped(layout, pattern.to_bytes(2 * layout.words, "big"))
    codes = (data if layout.per_word > 1 else data[1::2])[: layout.characters]
    return (codes if layout.padding else codes.partition(b"\0")[0]).decode("latin-1").rstrip(_BLANK)


def pattern_of_text(layout: Text, text: str) -> int:
    """Return all words of a text that fits as one number, filled up."""
    codes = text.rstrip(_BLANK).encode("latin-1").ljust(layout.per_word * layout.words, bytes([layout.padding]))
    data = codes if layout.per_word > 1 else b"".join(bytes((0, code)) for code in codes)
    return int.from_bytes(_swapped(layout, data), "big")


def _swapped(layout: Text, data: bytes) -> bytes:
    """Return the bytes, those of each word the other way round where the low one comes first."""
    return b"".join(data[at : at + 2][::-1] for at in range(0, len(data), 2)) if layout.low_first else data
