"""Texts and the words that hold them."""

from __future__ import annotations

from fieldscribe.arithmetic.notations import bytes_of, notated
from fieldscribe.model import Text

_BLANK = " "
_CODECS = {"utf-8": "utf-8", "utf-16": "utf-16-be"}


def text_of(layout: Text, pattern: int) -> str:
    """Return the text that all words as one number hold, without what fills it up. Raises UnicodeDecodeError."""
    data, size = _swapped(layout, pattern.to_bytes(2 * layout.words, "big")), _size(layout)
    codes = (data if layout.per_word * size > 1 else data[1::2])[: layout.characters * size]
    if layout.is_bytes:
        return notated(layout.encoding, codes)
    ends = (at for at in range(0, len(codes), size) if not (layout.padding or any(codes[at : at + size])))
    return codes[: next(ends, len(codes))].decode(_codec(layout)).rstrip(_BLANK)


def length_of(layout: Text, text: str) -> int:
    """Return how many of its characters a text takes: bytes, or words of UTF-16. Raises UnicodeEncodeError."""
    return len(text.encode(_codec(layout))) // _size(layout)


def fits(layout: Text, text: str) -> bool:
    """Return True if the encoding has all characters of a text, and there is room for them."""
    if layout.is_bytes:
        return bytes_of(layout.encoding, text, layout.characters) is not None
    try:
        return length_of(layout, text) <= layout.characters
    except UnicodeEncodeError:
        return False


def pattern_of_text(layout: Text, text: str) -> int:
    """Return all words of a text that fits as one number, filled up."""
    size = _size(layout)
    codes = bytes_of(layout.encoding, text, layout.characters) if layout.is_bytes else None
    codes = text.rstrip(_BLANK).encode(_codec(layout)) if codes is None else codes
    codes += layout.padding.to_bytes(size, "big") * (layout.per_word * layout.words - len(codes) // size)
    data = codes if layout.per_word * size > 1 else b"".join(bytes((0, code)) for code in codes)
    return int.from_bytes(_swapped(layout, data), "big")


def _codec(layout: Text) -> str:
    return _CODECS.get(layout.encoding, "latin-1")


def _size(layout: Text) -> int:
    return 2 if layout.encoding == "utf-16" else 1


def _swapped(layout: Text, data: bytes) -> bytes:
    """Return the bytes, those of each word the other way round where the low one comes first."""
    return b"".join(data[at : at + 2][::-1] for at in range(0, len(data), 2)) if layout.low_first else data
