"""Texts, and words whose decimal digits each mean something."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.targets.c.limits import any_of, interval_test
from fieldscribe.targets.c.literals import hexadecimal, raw_bounds, unsigned
from fieldscribe.targets.c.views import DigitsView, TextView

if TYPE_CHECKING:
    from fieldscribe.model import Point

_REFUSED_CHARACTERS = {
    "ascii": "character < 0x20U || character > 0x7EU",
    "latin-1": "character < 0x20U || (character > 0x7EU && character < 0xA0U)",
}


def text_view(point: Point) -> TextView:
    """The conversions of a text."""
    assert point.text is not None
    addresses = ", ".join(hexadecimal(address) for address in point.addresses)
    characters = point.text.characters
    return TextView(point.words, characters, _REFUSED_CHARACTERS[point.text.encoding], addresses)


def digits_view(point: Point) -> DigitsView:
    """The conversions of digits. Only the first can be more than 9: it takes what is left."""
    assert point.digits is not None
    count = point.digits.count
    largest = raw_bounds(point)[1] // 10 ** (count - 1)
    numbers = sorted({entry.raw for entry in point.digits.enum.entries})
    kind = "uint8_t" if max(largest, 9) < 256 else "uint16_t"
    bounds = (0, 255 if kind == "uint8_t" else 65535)
    tests = [interval_test("digit", low, high, bounds, unsigned) for low, high in _runs(numbers)]
    return DigitsView(count, kind, any_of(tests))


def _runs(numbers: list[int]) -> list[tuple[int, int]]:
    """Ascending numbers as intervals without holes."""
    runs: list[tuple[int, int]] = []
    for number in numbers:
        if runs and runs[-1][1] == number - 1:
            runs[-1] = (runs[-1][0], number)
        else:
            runs.append((number, number))
    return runs
