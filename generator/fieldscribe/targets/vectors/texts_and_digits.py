"""Vectors of texts, and of words whose decimal digits each mean something."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.targets.vectors.oracle import code_of
from fieldscribe.targets.vectors.samples import codes

if TYPE_CHECKING:
    from collections.abc import Iterable

    from fieldscribe.model import Digits, Shape
    from fieldscribe.targets.vectors.lines import Lines

_WRITABLE = {"ascii": frozenset(range(0x20, 0x7F)), "latin-1": frozenset((*range(0x20, 0x7F), *range(0xA0, 0x100)))}


def text(lines: Lines, shape: Shape) -> None:
    """Vectors of a text: full, shorter, empty, too long, ending in blanks, and with bytes that are no characters."""
    if shape.text is None:
        return
    size = shape.text.characters
    alphabet = bytes(0x41 + place % 26 for place in range(size))
    received = [alphabet, alphabet[:1], alphabet[:-1], b"", b"A " * (size // 2), b" B", bytes(range(size))]
    received += [
        b"\xff\x80\0"[:size].ljust(size),
        b"\0" * size,
        bytes(0xA0 + place % 0x60 for place in range(size)),
    ]
    if shape.readable:
        for data in dict.fromkeys(received):
            lines.add("text_decode", _words(data.ljust(size)), data.rstrip(b" "))
    if not shape.writable:
        return
    tried = [*received, alphabet + b"Z", alphabet + b" ", b" ~", b"\x7f", b"\x1f", b"A\0", b"\xe4", b"\xff"]
    for data in dict.fromkeys(tried):
        good = len(data) <= size and _WRITABLE[shape.text.encoding].issuperset(data)
        lines.add("text_encode", data, *(("ok", _words(data.ljust(size))) if good else ("out_of_range",)))


def _words(data: bytes) -> list[int]:
    return [data[at] << 8 | data[at + 1] for at in range(0, len(data), 2)]


def digits(lines: Lines, shape: Shape) -> None:
    """Vectors of words of digits: each digit with all its numbers and some that it cannot have."""
    layout = shape.digits
    if layout is None:
        return
    allowed = {entry.raw for entry in layout.enum.entries}
    places = [10**place for place in reversed(range(layout.count))]
    numbers = _numbers(layout, allowed)
    raws = dict.fromkeys(
        sum(digit * place for digit, place in zip(digits_of_number, places, strict=True))
        for digits_of_number in numbers
    )
    raws = {
        raw: None
        for raw in (*raws, 0, 10**layout.count - 1, 10**layout.count, 12345, 0x7FFF, 0xFFFF, *codes(shape))
        if raw <= 0xFFFF
    }
    for raw in raws:
        rest, digits_of_raw = raw, []
        for place in places:
            digit, rest = divmod(rest, place)
            digits_of_raw.append(digit)
        code = code_of(shape, raw)
        if shape.readable:
            lines.add("digits", raw, *(("ok", digits_of_raw) if code is None else ("special", None, code.name)))
        if shape.writable:
            coded = None if code is None else "ok" if code.writable else "special"
            lines.add("check", raw, coded or ("ok" if allowed.issuperset(digits_of_raw) else "unknown_value"))
    for digits_of_number in numbers if shape.writable else ():
        raw = sum(digit * place for digit, place in zip(digits_of_number, places, strict=True))
        good = allowed.issuperset(digits_of_number) and raw <= 0xFFFF
        status = "unknown_value" if not good else "ok" if code_of(shape, raw) is None else "special"
        lines.add("digits_encode", digits_of_number, status, raw if status == "ok" else None)


def _numbers(layout: Digits, allowed: Iterable[int]) -> list[tuple[int, ...]]:
    """Digits to try: each place with all its numbers and two that it cannot have, all others at their least."""
    known = sorted(allowed)
    strange = [next(digit for digit in range(256) if digit not in known), 10]
    base = (known[0],) * layout.count
    samples = [base, (known[-1],) * layout.count, tuple(known[place % len(known)] for place in range(layout.count))]
    samples += [
        (*base[:place], digit, *base[place + 1 :]) for place in range(layout.count) for digit in (*known, *strange)
    ]
    return list(dict.fromkeys(samples))
