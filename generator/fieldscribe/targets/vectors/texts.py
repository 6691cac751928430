"""Vectors of texts and bytes, and of dates in parts: what words hold, and the words to write.

Dates are ends of months and years, leap years, invalid dates, and dates without room.
"""

import datetime
from collections.abc import Iterator, Sequence

from fieldscribe.arithmetic.texts import notated
from fieldscribe.model import DatePart, Shape, Text
from fieldscribe.targets.vectors.lines import Lines

_BESIDE = 0x3F
"""Bytes outside a text, when it is received."""
_WRITABLE = {"ascii": frozenset(range(0x20, 0x7F)), "latin-1": frozenset((*range(0x20, 0x7F), *range(0xA0, 0x100)))}
_MALFORMED = {
    "utf-8": (
        *((0x80,), (0xC3,), (0xC0, 0xAF), (0xC1, 0xBF), (0xE2, 0x82), (0xE2, 0x41, 0x42), (0xE0, 0x9F, 0xBF)),
        *((0xED, 0xA0, 0x80), (0xED, 0xBF, 0xBF), (0xF0, 0x8F, 0xBF, 0xBF), (0xF4, 0x90, 0x80, 0x80)),
        *((0xF5, 0x80, 0x80, 0x80), (0xF9, 0x90, 0x80, 0x80), (0xFF,), (0xF0, 0x9D, 0x84), (0xF0, 0x9D, 0x84, 0x41)),
        *((0xC3, 0xC0), (0xE2, 0x82, 0x7F), (0xE2, 0x82, 0xC0)),
    ),
    "utf-16": (
        *((0xD800,), (0xDBFF, 0x0041), (0xDC00,), (0xDFFF,), (0xD800, 0xDBFF), (0xDBFF, 0xE000)),
        *((0xDFFF, 0xD800), (0xDC00, 0xDC00), (0xD834, 0xD834, 0xDD1E)),
    ),
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


def words_of_text(layout: Text, data: Sequence[int], outside: int | None = None) -> list[int]:
    """Return the words of a text, padded; `outside` is the value of the bytes outside it, None for the written one."""
    codes = [*data, *[layout.padding] * (layout.characters - len(data))]
    if layout.encoding == "utf-16":
        pairs = [divmod(code, 0x100) for code in codes]
    elif layout.per_word == 1:
        pairs = [(outside or 0, code) for code in codes]
    else:
        codes += [layout.padding if outside is None else outside]
        pairs = list(zip(codes[::2], codes[1::2], strict=False))
    return [low << 8 | high if layout.low_first else high << 8 | low for high, low in pairs]


# Dates.


_FIELDS = ("year", "month", "day", "hour", "minute", "second", "millisecond")
_ZEROS = (0,) * len(_FIELDS)
_DATES = (
    *((2000, 2, 29, 0, 0, 0, 0), (2024, 2, 29, 23, 59, 59, 999), (2023, 12, 31, 12, 30, 45, 250)),
    *((2099, 10, 10, 10, 10, 10, 10), (1999, 9, 9, 9, 9, 9, 9), (1, 1, 1, 0, 0, 0, 1), (9999, 12, 31, 19, 19, 19, 0)),
    *((1980, 4, 30, 20, 0, 58, 999), (2255, 1, 31, 1, 2, 3, 4), (2107, 11, 30, 8, 7, 6, 5), (2010, 8, 28, 0, 59, 0, 0)),
    *((2000 + number, 3, 1 + number, 5, 5, 5, 500) for number in range(7)),
)
_INVALID = (
    *((2023, 2, 29, 0, 0, 0, 0), (1900, 2, 29, 0, 0, 0, 0), (2100, 2, 29, 0, 0, 0, 0), (2024, 2, 30, 0, 0, 0, 0)),
    *((2024, 4, 31, 0, 0, 0, 0), (2024, 13, 1, 0, 0, 0, 0), (2024, 0, 1, 0, 0, 0, 0), (2024, 1, 0, 0, 0, 0, 0)),
    *((2024, 1, 32, 0, 0, 0, 0), (2024, 1, 1, 24, 0, 0, 0), (2024, 1, 1, 0, 60, 0, 0), (2024, 1, 1, 0, 0, 60, 0)),
    *((2024, 1, 1, 0, 0, 0, 1000), (0, 1, 1, 0, 0, 0, 0), (10000, 1, 1, 0, 0, 0, 0), _ZEROS),
)
"""Invalid dates and times, each for one reason."""


def dates(lines: Lines, shape: Shape, layout: Text) -> None:
    """Add vectors of a date or time: decoding, encoding, and invalid ones."""
    for numbers in (*_DATES, *_INVALID):
        held = _held(layout, numbers)
        words = _words(layout, held)
        if shape.readable and words is not None:
            read = _decoded(layout, held)
            for received in (words, _with_other_bits(layout, words)):
                lines.add("date_decode", received, "malformed" if read is None else "ok", read)
        if shape.writable:
            good = words is not None and _is_real(layout, _written(layout, numbers))
            lines.add("date_encode", numbers, "ok" if good else "out_of_range", words if good else None)
    for word in (0, 0xFFFF, 0x9999, 0x0A0A, 0xAAAA) if shape.readable else ():
        read = _read(layout, word)
        lines.add("date_decode", [word] * layout.words, "malformed" if read is None else "ok", read)


def typical_date(layout: Text) -> list[int]:
    """Return the words of a date and time that fits its parts; narrow parts may hold the first days of few years."""
    bases = [part.base for part in layout.parts if part.name == "year"]
    narrow = ((base + after, 1, day, 0, 0, 0, 0) for base in bases for after in range(7) for day in range(1, 8))
    real = (numbers for numbers in (*_DATES, *narrow) if _is_real(layout, numbers))
    return next(words for numbers in real if (words := _words(layout, _held(layout, numbers))) is not None)


def _written(layout: Text, numbers: Sequence[int]) -> list[int]:
    """Return the numbers with 0 for what is not written; a second may be in the milliseconds."""
    names = {part.name for part in layout.parts}
    names |= {"second"} if "millisecond" in names else set()
    return [number if name in names else 0 for name, number in zip(_FIELDS, numbers, strict=True)]


def _held(layout: Text, numbers: Sequence[int]) -> dict[str, int]:
    """Return the number of each part, without its base."""
    named = dict(zip(_FIELDS, numbers, strict=True))
    if not _has(layout, "second"):
        named["millisecond"] += 1000 * named["second"]
    return {
        part.name: _weekday(numbers, part.base) if part.name == "weekday" else named[part.name] - part.base
        for part in layout.parts
    }


def _has(layout: Text, name: str) -> bool:
    return any(part.name == name for part in layout.parts)


def _words(layout: Text, held: dict[str, int]) -> list[int] | None:
    """Return the words of the numbers; None if a part has no room for its number."""
    words = [0] * layout.words
    for part in layout.parts:
        number, width = held[part.name], part.bits[0] - part.bits[1] + 1
        digits = "".join(f"{int(digit):04b}" for digit in str(max(number, 0)))
        bits = int(digits, 2) if layout.bcd else number
        if not 0 <= bits < 1 << width or number < 0:
            return None
        words[part.word] |= bits << part.bits[1]
    return _swapped(layout, words)


def _swapped(layout: Text, words: Sequence[int]) -> list[int]:
    return [word % 256 * 256 + word // 256 for word in words] if layout.low_first else [*words]


def _with_other_bits(layout: Text, words: Sequence[int]) -> list[int]:
    """Return the words with ones in all bits outside the parts, and in those of the weekday."""
    outside = [0xFFFF] * layout.words
    for part in layout.parts:
        if part.name != "weekday":
            outside[part.word] &= ~_mask(part)
    return [word | other for word, other in zip(words, _swapped(layout, outside), strict=True)]


def _mask(part: DatePart) -> int:
    return sum(1 << bit for bit in range(part.bits[1], part.bits[0] + 1))


def _read(layout: Text, word: int) -> list[int] | None:
    """Return the date and time if all words are the same, whose two bytes are too."""
    held = {}
    for part in layout.parts:
        bits = f"{word:016b}"[15 - part.bits[0] : 16 - part.bits[1]]
        digits = [int(bits[place : place + 4], 2) for place in range(0, len(bits), 4)]
        if layout.bcd and max(digits) > 9 and part.name != "weekday":
            return None
        held[part.name] = int("".join(map(str, digits))) if layout.bcd else int(bits, 2)
    return _decoded(layout, held)


def _decoded(layout: Text, held: dict[str, int]) -> list[int] | None:
    """Return the seven numbers of a date and time; None if it does not exist."""
    base = {part.name: part.base for part in layout.parts}
    numbers = [held[name] + base[name] if name in held else 0 for name in _FIELDS]
    if not _has(layout, "second"):
        numbers[5:] = divmod(numbers[6], 1000)
    return numbers if _is_real(layout, numbers) else None


def _is_real(layout: Text, numbers: Sequence[int]) -> bool:
    """Return True if the date and the time of a layout exist."""
    *_, hour, minute, second, millisecond = numbers
    try:
        if _has(layout, "day"):
            datetime.date(*numbers[:3])
        if _has(layout, "hour"):
            datetime.time(hour, minute, second, 1000 * millisecond)
    except ValueError:
        return False
    return True


def _weekday(numbers: Sequence[int], sunday: int) -> int:
    """Return the weekday of a date in a count with this Sunday; that of no date is any."""
    try:
        after_sunday = datetime.date(*numbers[:3]).isoweekday() % 7
    except ValueError:
        after_sunday = 0
    first = sunday % 6  # the weekdays count from 0 or from 1
    return (after_sunday + sunday - first) % 7 + first
