"""Words of bits, drawn as a row of bits, and the flags in them."""

import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby
from typing import NamedTuple

from fieldscribe import wording
from fieldscribe.model import Flag, Point
from fieldscribe.targets.docs.cells import LINE_BREAK, MAY_BREAK, Columns, by_rows, cell, code, table, target

_BREAKS = re.compile("<w?br>")
_BYTE = 8
_SAME = "←"
"""Marks a further bit of the name on its left."""
_WIDEST = 1200
_SIGN, _BORDERS = 9, 18
"""Estimated widths in pixels: of a row on a page of 1,280, of a character, of the borders of a cell."""


def word_views(points: Iterable[Point]) -> Iterator[dict[str, str]]:
    """Yield the words of a group in the order of their first points; bits that several points share are drawn once."""
    words: dict[object, list[Point]] = {}
    for point in points:
        if point.shape.flags:
            key = id(point.shape.flags), point.terms.bits, point.shape.fixed
            words.setdefault(key, []).append(point)
    for users in words.values():
        named = ", ".join(target("bits", point.item) for point in users)
        yield {"points": named, "bits": _drawn(users[0]), "flags": _flag_table(users[0])}


class _Field(NamedTuple):
    """Neighbouring bits with one name or none; `always` is the constant written to them, if there is one."""

    high: int
    low: int
    name: str
    always: str

    @property
    def bits(self) -> str:
        return str(self.low) if self.high == self.low else f"{self.high}..{self.low}"

    @property
    def text(self) -> str:
        return _text(self.name, self.always)

    @property
    def pixels(self) -> int:
        parts = (self.bits, *_BREAKS.split(self.text))
        return _BORDERS + _SIGN * max(map(len, parts))

    def bit(self, number: int) -> str:
        """Return the text at one bit: the name at the highest bit, and again at the start of a byte."""
        is_first = number == self.high or number % _BYTE == _BYTE - 1
        name = self.name if is_first or not self.name else _SAME
        return _text(name, self.always[self.high - number] if self.always else "")


def _text(name: str, always: str) -> str:
    return LINE_BREAK.join(filter(None, (name, f"always {always}" if always else "")))


def _drawn(point: Point) -> str:
    """Return the word as a table, the highest bit first: in one row, or byte by byte if that is too wide for a page."""
    fields = list(_fields(point))
    if _is_wide(fields):
        heads, *rows = _bytes(fields)
    else:
        heads, *rows = [field.bits for field in fields], [field.text for field in fields]
    return by_rows(heads, rows, always=heads)


def is_broken(point: Point) -> bool:
    """Return True if the word of a point is drawn byte by byte."""
    return bool(point.flags) and _is_wide(list(_fields(point)))


def _is_wide(fields: Sequence[_Field]) -> bool:
    return sum(field.pixels for field in fields) > _WIDEST


def _bytes(fields: Sequence[_Field]) -> Iterator[list[str]]:
    """Return two rows for each byte: the numbers of its bits and their texts; the first row is the head."""
    texts = {bit: field.bit(bit) for field in fields for bit in range(field.low, field.high + 1)}
    highest = fields[0].high // _BYTE
    for byte in range(highest, fields[-1].low // _BYTE - 1, -1):
        bits = range(byte * _BYTE + _BYTE - 1, byte * _BYTE - 1, -1)
        yield [_numbered(bit, bit in texts, byte < highest) for bit in bits]
        yield [texts.get(bit, "") for bit in bits]


def _numbered(bit: int, is_there: bool, in_body: bool) -> str:
    return "" if not is_there else f"**{bit}**" if in_body else str(bit)


def _fields(point: Point) -> Iterator[_Field]:
    lowest = point.bits[1] if point.bits else 0
    above = lowest + point.width
    for flag in sorted(point.flags, key=lambda flag: -flag.low):
        low = lowest + flag.low
        yield from _nameless(point, above, low + flag.width)
        yield _field(point, low + flag.width - 1, low, cell(flag.name).replace("_", MAY_BREAK))
        above = low
    yield from _nameless(point, above, lowest)


def _nameless(point: Point, above: int, lowest: int) -> Iterator[_Field]:
    """Yield fields of bits without a name, divided at the ends of constant bits."""
    mask = point.shape.fixed.mask if point.shape.fixed else 0
    for _, run in groupby(range(above - 1, lowest - 1, -1), key=lambda bit: mask >> bit & 1):
        bits = [*run]
        yield _field(point, bits[0], bits[-1])


def _field(point: Point, high: int, low: int, name: str = "") -> _Field:
    return _Field(high, low, name, _constant(point, high, low))


def _constant(point: Point, high: int, low: int) -> str:
    """Return the constant of these bits; empty unless all of them are constant."""
    fixed, mask = point.shape.fixed, (1 << high - low + 1) - 1
    if fixed is None or fixed.mask >> low & mask != mask:
        return ""
    return f"{fixed.bits >> low & mask:0{high - low + 1}b}"


def _flag_table(point: Point) -> str:
    columns: Columns[Flag] = {
        "Bits": lambda flag: wording.flag_bits(flag, point),
        "Name": lambda flag: code(flag.name),
        "Title": lambda flag: cell(wording.title_text(flag.title)),
        "True at": lambda flag: str(flag.active) if flag.width == 1 else "",
        "0 means": lambda flag: _meaning_of(flag, 0),
        "1 means": lambda flag: _meaning_of(flag, 1),
        "Numbers": lambda flag: (
            LINE_BREAK.join(cell(wording.flag_value_text(entry)) for entry in flag.values) if flag.width > 1 else ""
        ),
    }
    return table(point.flags, columns)


def _meaning_of(flag: Flag, number: int) -> str:
    """Return the meaning of a single bit at 0 or at 1."""
    entry = next((entry for entry in flag.values if flag.width == 1 and entry.raw == number), None)
    if entry is None:
        return ""
    return cell(wording.title_text(entry.title) if entry.name in ("zero", "one") else wording.entry_meaning(entry))
