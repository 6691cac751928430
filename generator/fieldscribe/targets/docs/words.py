"""Words of bits, drawn as a row of bits, and the flags in them."""

from __future__ import annotations

import re
from itertools import groupby, zip_longest
from typing import TYPE_CHECKING, NamedTuple

from fieldscribe import wording
from fieldscribe.records import dataclass
from fieldscribe.targets.docs.cells import LINE_BREAK, MAY_BREAK, by_rows, cell, code, target

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Flag, Point

_BREAKS = re.compile("<w?br>")
_BROKEN_ROW = 8
"""A word that is too wide for one row is drawn in rows of so many cells."""
_WIDEST = 1200
_SIGN, _BORDERS = 9, 18
"""About how many pixels a page of 1,280 leaves to a row, and how many a sign and the borders of a cell take."""


@dataclass(frozen=True, slots=True)
class WordView:
    """The bits of a word, and the points that have just these."""

    points: str
    bits: str
    flags: str


class Words:
    """The words of a group: bits that several points have alike are drawn once."""

    def __init__(self) -> None:
        self._points: dict[object, list[Point]] = {}

    def take(self, point: Point) -> None:
        """One more point of the group."""
        if point.shape.flags:
            alike = id(point.shape.flags), point.terms.bits, point.shape.fixed
            self._points.setdefault(alike, []).append(point)

    def views(self) -> Iterator[WordView]:
        """The words, in the order of their first points."""
        for points in self._points.values():
            named = ", ".join(target("bits", point.item) for point in points)
            yield WordView(named, _drawn(points[0]), _flag_table(points[0]))


class _Field(NamedTuple):
    """Neighbouring bits that have a name together, or none."""

    bits: str
    name: str

    @property
    def pixels(self) -> int:
        parts = (self.bits, *_BREAKS.split(self.name))
        return _BORDERS + _SIGN * max(map(len, parts))


def _drawn(point: Point) -> str:
    """The word as a table, the highest bit first, in as few rows as fit a page."""
    fields = list(_fields(point))
    count = len(fields) if sum(field.pixels for field in fields) <= _WIDEST else _BROKEN_ROW
    runs = [fields[start : start + count] for start in range(0, len(fields), count)]
    rows = [row for run in runs for row in ([f"**{field.bits}**" for field in run], [field.name for field in run])]
    columns = list(zip_longest(*rows, fillvalue=""))
    heads = [bits.strip("*") for bits, *_ in columns]
    return by_rows(heads, list(zip(*(column[1:] for column in columns), strict=True)), always=heads)


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
    """Bits without a name: those that are always written as a constant are apart from the others."""
    mask = point.shape.fixed.mask if point.shape.fixed else 0
    for _, run in groupby(range(above - 1, lowest - 1, -1), key=lambda bit: mask >> bit & 1):
        bits = [*run]
        yield _field(point, bits[0], bits[-1])


def _field(point: Point, high: int, low: int, name: str = "") -> _Field:
    always = _constant(point, high, low)
    said = LINE_BREAK.join(filter(None, (name, f"always {always}" if always else "")))
    return _Field(str(low) if high == low else f"{high}..{low}", said)


def _constant(point: Point, high: int, low: int) -> str:
    """The bits that are always written as a constant; empty unless all of these are."""
    fixed, mask = point.shape.fixed, (1 << high - low + 1) - 1
    if fixed is None or fixed.mask >> low & mask != mask:
        return ""
    return f"{fixed.bits >> low & mask:0{high - low + 1}b}"


def _flag_table(point: Point) -> str:
    rows = [
        (
            wording.flag_bits(flag, point),
            code(flag.name),
            cell(wording.title_text(flag.title)),
            str(flag.active) if flag.width == 1 else "",
            *(_meaning_of(flag, number) for number in (0, 1)),
            LINE_BREAK.join(cell(wording.flag_value_text(entry)) for entry in flag.values) if flag.width > 1 else "",
        )
        for flag in point.flags
    ]
    return by_rows(("Bits", "Name", "Title", "True at", "0 means", "1 means", "Numbers"), rows)


def _meaning_of(flag: Flag, number: int) -> str:
    """What a single bit says at 0 or at 1."""
    entry = next((entry for entry in flag.values if flag.width == 1 and entry.raw == number), None)
    if entry is None:
        return ""
    return cell(wording.title_text(entry.title) if entry.name in ("zero", "one") else wording.entry_meaning(entry))
