"""The names of numbers, beside the points that use them: in the row, as of a row above, or below the table."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe import wording
from fieldscribe.targets.docs.cells import LINE_BREAK, anchor, by_rows, cell, code, link, narrow, narrow_link

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Enum, Point

SHORT_LIST = 4
"""A list of at most so many names stands in the row of every point that uses it; a longer one stands once a group."""
_LONGEST_CELL = 24
"""A list of more names would make a row longer than a page: it has a table below that of the points."""


@dataclass(frozen=True, slots=True)
class ListView:
    """A long list of names, and the points that use it."""

    anchor: str
    points: str
    rows: str


class Lists:
    """The lists of names of a group: each is shown once, at the first point that uses it."""

    def __init__(self) -> None:
        self._first: dict[int, str] = {}
        self._users: dict[str, tuple[Enum, list[str]]] = {}

    def said(self, point: Point) -> str:
        """What the row of a point says of its list; empty without one, and for a short one, which kin share."""
        shape = point.shape
        enum = shape.digits.enum if shape.digits else shape.enum
        if enum is None or (shape.digits is None and len(enum.entries) <= SHORT_LIST):
            return ""
        before = "each digit: " if shape.digits else ""
        first = self._first.setdefault(id(enum.entries), point.item)
        if len(enum.entries) > _LONGEST_CELL:
            self._users.setdefault(first, (enum, []))[1].append(point.item)
            return f"{before}[numbers below](#{anchor('numbers', first)})"
        return before + (listed(enum) if first == point.item else f"numbers as of {narrow_link('point', first)}")

    def views(self) -> Iterator[ListView]:
        """The lists that stand below the table."""
        for first, (enum, users) in self._users.items():
            points = ", ".join(link("point", item) for item in users)
            yield ListView(anchor("numbers", first), points, _table(enum))


def listed(enum: Enum) -> str:
    """The names of an enum, each on its line."""
    return LINE_BREAK.join(narrow(cell(wording.entry_text(entry))) for entry in enum.entries)


def _table(enum: Enum) -> str:
    rows = [
        (str(entry.raw), code(entry.name), cell(wording.title_text(entry.title)), cell(entry.quantity or ""))
        for entry in enum.entries
    ]
    return by_rows(("Raw", "Name", "Title", "Quantity"), rows)
