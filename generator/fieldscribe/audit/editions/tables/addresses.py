"""The addresses of rows: all numbers that a row prints for its place, and which of them is the one on the wire.

A manual prints an address in several bases and numberings. Each place where one can stand (a column, and the first or
second number in its cell) is a slot; over all rows the slots keep their distances. The lowest numbering is the wire's,
unless its numbers are references such as 40001.
"""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from fieldscribe.audit.editions.tables.columns import Columns
    from fieldscribe.audit.editions.tables.tables import Row

_MARKED = re.compile(
    r"(?<![0-9A-GI-Za-gi-z])(?:0[xX]([0-9A-Fa-f]{1,8})|[Hh]'([0-9A-Fa-f]{1,8})|([0-9A-Fa-f]{1,8})\s?[hH](?![A-Za-z]))"
)
_HEX, _DECIMAL = re.compile(r"(?<![0-9A-Za-z])[0-9A-Fa-f]{1,8}(?![0-9A-Za-z])"), re.compile(r"(?<![\w.])\d{1,6}(?!\w)")
REFERENCES = {0: "coil", 1: "discrete", 3: "input", 4: "holding"}
"""The spaces that the first digit of a reference of five or six digits stands for."""
_MOST_SLOTS, _LONGEST = 8, 200


@dataclass(frozen=True, slots=True)
class Number:
    """A printed number: its slot (column, place in the cell), its value, and how a description writes it."""

    slot: tuple[int, int]
    value: int
    shown: str


@dataclass(frozen=True, slots=True)
class Numberings:
    """How far the numbers of each slot are from the wire address, and what the numbering is called."""

    offsets: dict[tuple[int, int], int]
    names: dict[int, str]
    space: str | None = None

    def wire(self, numbers: Iterable[Number]) -> list[int]:
        """What each printed number says that the wire address is."""
        return [number.value - self.offsets.get(number.slot, 0) for number in numbers]


def numbers_in(row: Row, columns: Columns) -> list[Number]:
    """The numbers that a row prints for its place."""
    found: list[Number] = []
    for place in columns.places.get("address", ()):
        cell = row.cells[place] if place < len(row.cells) else ""
        base = columns.base(place)
        found += [
            Number((place, index), value, shown) for index, (value, shown) in enumerate(_numbers(cell[:_LONGEST], base))
        ]
    return found[:_MOST_SLOTS]


def _numbers(cell: str, base: int | None) -> list[tuple[int, str]]:
    """The numbers of a cell; one that a line break cuts in two is put together again."""
    whole = "".join(cell.split())
    marked = list(_MARKED.finditer(whole))
    if marked and (base == 16 or not re.search(r"\d{3,}(?![0-9A-Fa-f]*[hH])", _MARKED.sub(" ", whole))):
        numbers = [_hexadecimal(found[1] or found[2] or found[3]) for found in marked]
        rest = _MARKED.sub(" ", whole)
        return numbers + ([_hexadecimal(found) for found in _HEX.findall(rest)] if base == 16 else [])
    if base == 16:
        return [_hexadecimal(found) for found in _HEX.findall(whole)]
    mixed = [(found.start(), *_hexadecimal(found[1] or found[2] or found[3])) for found in _MARKED.finditer(cell)]
    plain = _MARKED.sub(lambda found: " " * len(found[0]), cell)
    mixed += [(found.start(), int(found[0]), str(int(found[0]))) for found in _DECIMAL.finditer(plain)]
    if not mixed and base is None and re.fullmatch(r"[0-9A-Fa-f]{3,5}", whole):
        return [_hexadecimal(whole)]
    return [(value, shown) for _, value, shown in sorted(mixed)]


def _hexadecimal(digits: str) -> tuple[int, str]:
    value = int(digits, 16)
    return value, f"{value:0{max(4, len(digits.lstrip('0')))}X}h"


def numberings_of(rows: Sequence[Sequence[Number]]) -> Numberings:
    """The numberings of a table, from the numbers of all its rows."""
    first = next((numbers[0].slot for numbers in rows if numbers), None)
    if first is None:
        return Numberings({}, {})
    apart: dict[tuple[int, int], Counter[int]] = {}
    for numbers in rows:
        start = next((number.value for number in numbers if number.slot == first), None)
        if start is not None:
            for number in numbers:
                apart.setdefault(number.slot, Counter())[number.value - start] += 1
    usual = {slot: counts.most_common(1)[0] for slot, counts in apart.items()}
    most = max((count for _, count in usual.values()), default=0)
    steady = {slot: offset for slot, (offset, count) in usual.items() if count * 2 > most or count * 2 > len(rows)}
    return _named(steady, [number for numbers in rows for number in numbers if number.slot == first])


def _named(steady: dict[tuple[int, int], int], firsts: list[Number]) -> Numberings:
    """The lowest numbering is the wire's; references of five or six digits count from 1 behind their first digit."""
    lowest = min(steady.values(), default=0)
    offsets = {slot: offset - lowest for slot, offset in steady.items()}
    lows = [number.value + lowest for number in firsts]
    kind = {reference_of(low) for low in lows}
    if lows and len(kind) == 1 and (reference := kind.pop()) is not None:
        origin, space = reference
        return Numberings({slot: offset + origin for slot, offset in offsets.items()}, {origin: "reference"}, space)
    names = {offset: "modicon" if offset == 1 else "reference" for offset in offsets.values() if offset}
    return Numberings(offsets, names)


def reference_of(number: int) -> tuple[int, str] | None:
    """The number that stands for wire address 0, and the space, if a number looks like 40001 or 400001."""
    for size, most in ((10_000, 9_999), (100_000, 65_536)):
        digit = number // size
        if digit in REFERENCES and digit and 1 <= number % size <= most:
            return digit * size + 1, REFERENCES[digit]
    return None


def settled(votes: Sequence[int], before: int | None, after: int | None) -> tuple[int | None, str]:
    """The address that most printed numbers say; between equals the one that keeps the table in order.

    None, and why, if the numbers leave it open.
    """
    counts = Counter(vote for vote in votes if vote >= 0).most_common()
    if not counts:
        return None, ""
    best = [vote for vote, count in counts if count == counts[0][1]]
    if len(best) > 1:
        low, high = -1 if before is None else before, 1 << 62 if after is None else after
        best = [vote for vote in best if low < vote < high]
    if len(best) != 1:
        return None, "the printed numbers of the address disagree"
    return best[0], "" if len(counts) == 1 else "the printed numbers of the address disagree; most say this one"
