"""Vectors of texts and of bytes: what words hold, and the words to write."""

from collections.abc import Iterator, Sequence

from fieldscribe.arithmetic.texts import notated
from fieldscribe.model import Shape, Text
from fieldscribe.targets.vectors.dates import dates
from fieldscribe.targets.vectors.lines import Lines

_BESIDE = 0x3F
"""Bytes outside a text, when it is received."""
_WRITABLE = {"ascii": frozenset(range(0x20, 0x7F)), "latin-1": frozenset((*range(0x20, 0x7F), *range(0xA0, 0x100)))}
_MALFORMED = {
    "utf-8": (
        *((0x80,), (0xC3,), (0xC0, 0xAF), (0xC1, 0xBF), (0xE2, 0x82), (0xE2, 0x41, 0x42), (0xE0, 0x9F, 0xBF)),
        *((0xED, 0xA0, 0x80), (0xED, 0xBF, 0xBF), (0xF0, 0x8F, 0xBF, 0xBF), (0xF4, 0x90, 0x80, 0x80)),
        *((0xF5, 0x80, 0x80, 0x80), (0xF9, 0x90, 0x80, 0x80), (0xFF,), (0xF0, 0x9D, 0x84)),
    ),
    "utf-16": ((0xD800,), (0xDBFF, 0x0041), (0xDC00,), (0xDFFF, 0xD800), (0xD834, 0xD834, 0xDD1E)),
}
"""Bytes that are not a text, by encoding."""
_TEXTS = (
    *("", "A", "AB", " B", "A ", "\u00a0", "\u00e4\u00df", "\u07ff", "\u0800", "\u20ac", "\ud7ff", "\ue000", "\uffff"),
    *("\U00010000", "A\U0001d11e", "\U0010ffff", "\u2020", "\u0120", "\x7f", "\x80", "\x9f", "\x1f", "A\0"),
)


def text(lines: Lines, shape: Shape) -> None:
    """Add vectors of a text, of bytes, or of a date and time in parts."""
    if shape.text is None:
        return
    if shape.text.parts:
        dates(lines, shape, shape.text)
    elif shape.text.is_bytes:
        _bytes(lines, shape, shape.text)
    elif shape.text.is_unicode:
        _unicode(lines, shape, shape.text)
    else:
        _characters(lines, shape, shape.text)


def _characters(lines: Lines, shape: Shape, layout: Text) -> None:
    """Add vectors of a text of single bytes: full, shorter, empty, too long, with blanks, with no characters."""
    size, alphabet = layout.characters, letters(layout)
    received = [alphabet, alphabet[:1], alphabet[:-1], b"", b"A " * (size // 2), b" B"[:size], bytes(range(256))[:size]]
    received += [b"\xff\x80\0"[:size].ljust(size), b"\0" * size, bytes(0xA0 + place % 0x60 for place in range(size))]
    for data in dict.fromkeys(received) if shape.readable else ():
        seen = data if layout.padding else data.split(b"\0")[0]
        lines.add("text_decode", words_of_text(layout, data, _BESIDE), seen.rstrip(b" "))
    tried = [*received, alphabet + b"Z", alphabet + b" ", b" ~", b"\x7f", b"\x1f", b"A\0", b"\xe4", b"\xff"]
    for data in dict.fromkeys(tried) if shape.writable else ():
        good = len(data) <= size and _WRITABLE[layout.encoding].issuperset(data)
        words = words_of_text(layout, data.rstrip(b" ")) if good else None
        lines.add("text_encode", data, "ok" if good else "out_of_range", words)


def letters(layout: Text) -> bytes:
    """Return a full text of different letters."""
    return bytes(0x41 + place % 26 for place in range(layout.characters))


def _bytes(lines: Lines, shape: Shape, layout: Text) -> None:
    """Add vectors of bytes: as an array, which C and Rust have, and in their notation, which Python has."""
    size = layout.characters
    mixed = bytes((0xF7 - place * 0x1D) % 0x100 for place in range(size))
    for data in (bytes(size), b"\xff" * size, bytes(range(1, size + 1)), mixed):
        words = words_of_text(layout, data)
        lines.add("notation", words, notated(layout.encoding, data))
        if shape.readable:
            lines.add("bytes_decode", words_of_text(layout, data, _BESIDE), data)
        if shape.writable:
            lines.add("bytes_encode", data, words)


def _unicode(lines: Lines, shape: Shape, layout: Text) -> None:
    """Add vectors of a text of UTF-8 or UTF-16: all lengths of a character, invalid ones, and texts that do not fit."""
    wide, size = layout.encoding == "utf-16", layout.characters
    last = "\U0001d11e" if wide else "\u20ac"
    full = (
        "Z" * size,
        "Z" * (size + 1),
        "Z" * (size - 1) + last,
        "Z" * (size - len([*_codes(last, wide=wide)])) + last,
    )
    codes = {text: [*_codes(text, wide=wide)] for text in (*_TEXTS, *full)}
    for text, data in codes.items() if shape.readable else ():
        if len(data) <= size:
            seen = text if layout.padding else text.split("\0")[0]
            seen_bytes = bytes(_codes(seen.rstrip(" "), wide=False))
            lines.add("unicode_decode", words_of_text(layout, data, _BESIDE), "ok", seen_bytes)
    for wrong in _MALFORMED[layout.encoding] if shape.readable else ():
        for spoiled in (wrong, (0x41, *wrong)):
            if len(spoiled) <= size:
                lines.add("unicode_decode", words_of_text(layout, spoiled), "malformed")
    for text, data in codes.items() if shape.writable else ():
        good = len(data) <= size and not any(ord(char) < 0x20 or 0x7F <= ord(char) < 0xA0 for char in text)
        words = words_of_text(layout, [*_codes(text.rstrip(" "), wide=wide)]) if good else None
        lines.add("unicode_encode", bytes(_codes(text, wide=False)), "ok" if good else "out_of_range", words)


def _codes(text: str, *, wide: bool) -> Iterator[int]:
    """Yield the bytes of UTF-8, or the 16-bit units of UTF-16, by arithmetic."""
    for number in map(ord, text):
        if wide:
            yield from (number,) if number < 0x10000 else (0xD7C0 + (number >> 10), 0xDC00 | number & 0x3FF)
        else:
            more = (number > 0x7F) + (number > 0x7FF) + (number > 0xFFFF)
            yield number >> 6 * more | (0xFF00 >> more + 1 & 0xFF if more else 0)
            yield from (0x80 | number >> 6 * place & 0x3F for place in reversed(range(more)))


def words_of_text(layout: Text, data: Sequence[int], beside: int | None = None) -> list[int]:
    """Return the words of a text, padded; `beside` is the value of bytes outside the text, None for the written one."""
    codes = [*data, *[layout.padding] * (layout.characters - len(data))]
    if layout.encoding == "utf-16":
        pairs = [divmod(code, 0x100) for code in codes]
    elif layout.per_word == 1:
        pairs = [(beside or 0, code) for code in codes]
    else:
        codes += [layout.padding if beside is None else beside]
        pairs = list(zip(codes[::2], codes[1::2], strict=False))
    return [low << 8 | high if layout.low_first else high << 8 | low for high, low in pairs]
