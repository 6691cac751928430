"""Vectors of texts, of words whose decimal digits each have a meaning, and of values as people see them."""

from collections.abc import Iterable, Iterator, Sequence
from math import inf, isfinite, nan
from operator import mul

from fieldscribe.arithmetic.texts import notated
from fieldscribe.model import Digits, Shape, Text
from fieldscribe.targets.vectors import samples
from fieldscribe.targets.vectors.dates import dates
from fieldscribe.targets.vectors.lines import Lines
from fieldscribe.targets.vectors.oracle import (
    INT64,
    Oracle,
    Ratio,
    bits_of,
    code_of,
    float_of_bits,
    half_away,
    outer_bounds,
)
from fieldscribe.targets.vectors.samples import PointEncoding, codes

_WRITABLE = {"ascii": frozenset(range(0x20, 0x7F)), "latin-1": frozenset((*range(0x20, 0x7F), *range(0xA0, 0x100)))}


def text(lines: Lines, shape: Shape) -> None:
    """Add vectors of a text: full, shorter, empty, too long, ending in blanks, with bytes that are not characters."""
    if shape.text is None:
        return
    layout, size = shape.text, shape.text.characters
    if layout.parts:
        dates(lines, shape, layout)
        return
    if layout.is_bytes:
        _bytes(lines, shape, layout)
        return
    if layout.encoding in _MALFORMED:
        _unicode(lines, shape, layout)
        return
    alphabet = bytes(0x41 + place % 26 for place in range(size))
    received = [
        alphabet,
        alphabet[:1],
        alphabet[:-1],
        b"",
        b"A " * (size // 2),
        b" B"[:size],
        bytes(place % 256 for place in range(size)),
    ]
    received += [
        b"\xff\x80\0"[:size].ljust(size),
        b"\0" * size,
        bytes(0xA0 + place % 0x60 for place in range(size)),
    ]
    if shape.readable:
        for data in dict.fromkeys(received):
            seen = data if layout.padding else data.split(b"\0")[0]
            lines.add("text_decode", words_of_text(layout, data, 0x3F), seen.rstrip(b" "))
    if not shape.writable:
        return
    tried = [*received, alphabet + b"Z", alphabet + b" ", b" ~", b"\x7f", b"\x1f", b"A\0", b"\xe4", b"\xff"]
    for data in dict.fromkeys(tried):
        good = len(data) <= size and _WRITABLE[layout.encoding].issuperset(data)
        lines.add(
            "text_encode", data, *(("ok", words_of_text(layout, data.rstrip(b" "))) if good else ("out_of_range",))
        )


def _bytes(lines: Lines, shape: Shape, layout: Text) -> None:
    """Add vectors of bytes: as an array, which C and Rust have, and in their notation, which Python has."""
    size = layout.characters
    mixed = bytes((0xF7 - place * 0x1D) % 0x100 for place in range(size))
    for data in (bytes(size), b"\xff" * size, bytes(range(1, size + 1)), mixed):
        words = words_of_text(layout, data)
        lines.add("notation", words, notated(layout.encoding, data))
        if shape.readable:
            lines.add("bytes_decode", words_of_text(layout, data, 0x3F), data)
        if shape.writable:
            lines.add("bytes_encode", data, words)


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


def _unicode(lines: Lines, shape: Shape, layout: Text) -> None:
    """Add vectors of a text of UTF-8 or UTF-16: all lengths of a character, invalid ones, and texts that do not fit."""
    wide, size = layout.encoding == "utf-16", layout.characters
    last, texts = "\U0001d11e" if wide else "\u20ac", [*_TEXTS]
    texts += [
        "Z" * size,
        "Z" * (size + 1),
        "Z" * (size - 1) + last,
        "Z" * (size - len([*_codes(last, wide=wide)])) + last,
    ]
    fitting = {text: codes for text in texts if len(codes := [*_codes(text, wide=wide)]) <= size}
    for text, codes in fitting.items() if shape.readable else ():
        seen = text if layout.padding else text.split("\0")[0]
        lines.add(
            "unicode_decode", words_of_text(layout, codes, 0x3F), "ok", bytes(_codes(seen.rstrip(" "), wide=False))
        )
    for wrong in _MALFORMED[layout.encoding] if shape.readable else ():
        for before in ((), (0x41,)):
            if len(before) + len(wrong) <= size:
                lines.add("unicode_decode", words_of_text(layout, (*before, *wrong)), "malformed")
    for text in texts if shape.writable else ():
        good = text in fitting and not any(ord(char) < 0x20 or 0x7F <= ord(char) < 0xA0 for char in text)
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


def digits(lines: Lines, shape: Shape) -> None:
    """Add vectors of words of digits: each digit with all its numbers and some that it cannot have."""
    layout = shape.digits
    if layout is None:
        return
    allowed = {entry.raw for entry in layout.enum.entries}
    places = [10**place for place in reversed(range(layout.count))]
    numbers = {number: sum(map(mul, number, places)) for number in _numbers(layout, allowed)}
    top = 10**layout.count
    raws = dict.fromkeys((*numbers.values(), 0, top - 1, top, 12345, 0x7FFF, 0xFFFF, *codes(shape)))
    for raw in [raw for raw in raws if raw <= 0xFFFF]:
        digits_of_raw = [raw // places[0], *(raw // place % 10 for place in places[1:])]
        code = code_of(shape, raw)
        if shape.readable:
            lines.add("digits", raw, *(("ok", digits_of_raw) if code is None else ("special", None, code.name)))
        if shape.writable:
            coded = None if code is None else "ok" if code.writable else "special"
            lines.add("check", raw, coded or ("ok" if allowed.issuperset(digits_of_raw) else "unknown_value"))
    for digits_of_number, raw in numbers.items() if shape.writable else ():
        good = allowed.issuperset(digits_of_number) and raw <= 0xFFFF
        status = "unknown_value" if not good else "ok" if code_of(shape, raw) is None else "special"
        lines.add("digits_encode", digits_of_number, status, raw if status == "ok" else None)


def _numbers(layout: Digits, allowed: Iterable[int]) -> list[tuple[int, ...]]:
    """Return digits to try: each place with all its numbers and two invalid ones, all others at their least."""
    known = sorted(allowed)
    impossible = [next(digit for digit in range(256) if digit not in known), 10]
    base = (known[0],) * layout.count
    samples = [base, (known[-1],) * layout.count, tuple(known[place % len(known)] for place in range(layout.count))]
    samples += [
        (*base[:place], digit, *base[place + 1 :]) for place in range(layout.count) for digit in (*known, *impossible)
    ]
    return list(dict.fromkeys(samples))


_NEAR = range(-400, 401)
"""The range in which halves of the last decimal are searched."""


def displayed(lines: Lines, oracle: Oracle, encoding: PointEncoding, *, deep: bool) -> None:
    """Add the texts of the values of a point that says how many decimals people see."""
    shape = encoding.shape
    if shape.display is None:
        return
    for settings in samples.settings(oracle, encoding, deep=deep):
        if settings:
            lines.set("with", settings)
        if shape.info.floating:
            _add_texts(lines, encoding, ((raw, *_of_float(shape, raw)) for raw in _patterns(shape)))
            continue
        ratio = oracle.ratio(shape, settings) if shape.scale else Ratio(1, 1, 0, 1)
        raws = [0, 1] if isinstance(ratio, str) else _raws(encoding, ratio, deep=deep)
        _add_texts(lines, encoding, ((raw, *_of_number(shape, ratio, raw)) for raw in raws))


def _add_texts(lines: Lines, encoding: PointEncoding, rows: Iterable[tuple[int, str, str]]) -> None:
    """Add a line for each raw number, its status and its text; a special code has its name."""
    unit = f" {encoding.symbol}" if encoding.symbol else ""
    for raw, status, text in rows:
        code = code_of(encoding.shape, raw)
        seen = f"{text}{unit}" if code is None else code.name
        lines.add("told", raw, "ok" if code is not None else status, seen if code is not None or text else None)


def _raws(encoding: PointEncoding, ratio: Ratio, *, deep: bool) -> list[int]:
    """Return limits; if deep, also the ends of the type, small numbers, halves and special codes."""
    shape = encoding.shape
    found = [*outer_bounds(shape, encoding.allowed), 1]
    if deep:
        found += [0, -1, 5, shape.least, shape.greatest, shape.greatest - 1]
        found += [*_halves(shape, ratio), *samples.codes(shape)]
    return [raw for raw in dict.fromkeys(found) if shape.least <= raw <= shape.greatest]


def _halves(shape: Shape, ratio: Ratio) -> Iterator[int]:
    """Yield the raw numbers next to zero whose value lies in the middle of two texts, above and below zero."""
    power, under = 10 ** (shape.display or 0), ratio.denominator
    middle = [raw for raw in _NEAR if 2 * ratio.numerator(raw) * power % (2 * under) == under]
    yield from [raw for raw in middle if ratio.numerator(raw) > 0][:2]
    yield from [raw for raw in middle if ratio.numerator(raw) < 0][-2:]


def _of_number(shape: Shape, ratio: Ratio | str, raw: int) -> tuple[str, str]:
    """Return the status of a raw number, and its text if there is one."""
    if isinstance(ratio, str):
        return ratio, ""
    count = half_away(ratio.numerator(raw) * 10 ** (shape.display or 0), ratio.denominator)
    beyond = not -INT64 <= count < INT64 or (shape.most_raw is not None and abs(raw) > shape.most_raw)
    return ("overflow", "") if shape.scale_arguments and beyond else ("ok", _decimal(count, shape.display or 0))


def _patterns(shape: Shape) -> list[int]:
    """Return patterns: halves of the last decimal, numbers that round to zero, the largest, and no numbers."""
    half = 0.5 ** ((shape.display or 0) + 1)
    numbers = (0.0, -0.0, 1.0, 0.1, half, -half, 3 * half, half / 2, -half / 2, 1.5e9, -12345678.0, 3e38)
    return [bits_of(number, shape.width) for number in (*numbers, inf, -inf, nan)]


def _of_float(shape: Shape, raw: int) -> tuple[str, str]:
    number = float_of_bits(raw, shape.width)
    if not isfinite(number):
        return "ok", str(number)
    over, under = number.as_integer_ratio()
    decimals = shape.display or 0
    return "ok", _decimal(half_away(over * 10**decimals, under), decimals)


def _decimal(count: int, decimals: int) -> str:
    """Return a count of 10^-decimals units, digit by digit; one that is zero has no sign."""
    whole, part = divmod(abs(count), 10**decimals)
    point = f".{part:0{decimals}d}" if decimals else ""
    return f"{'-' if count < 0 else ''}{whole}{point}"
