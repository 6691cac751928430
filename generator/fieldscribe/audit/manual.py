"""The text of a manual: lines, the section and the table row around each, and the numbers that stand in it."""

from __future__ import annotations

import re
from bisect import bisect_right
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

_NUMBER = re.compile(
    r"""(?<![A-Za-z0-9_.,'])(?:
        0[xX](?P<long>[0-9A-Fa-f]{4})
      | (?:0[xX]|[Hh]'|[Hh]ex[ ])(?P<marked>[0-9A-Fa-f]+)
      | (?P<parted>[01]+(?:\\?_[01]+)+)(?![A-Za-z0-9_])
      | (?P<spaced>[0-9A-F](?:[ ][0-9A-F]){1,3})[ ]h(?![A-Za-z0-9_])
      | (?P<tailed>[0-9A-Fa-f]+)[hH](?![A-Za-z0-9_])
      | (?P<bare>[0-9A-F]*[0-9][0-9A-F]*[A-F][0-9A-F]*|[A-F][0-9A-F]*[0-9][0-9A-F]*|[A-F]{2}|[A-F]{4})(?![A-Za-z0-9_])
      | (?P<decimal>[0-9]+(?:[.,][0-9]+)*)
    )""",
    re.VERBOSE,
)
_HEADING = re.compile(r"#{1,6}\s+\S|[0-9]+(?:\.[0-9]+)+\.?[ \t]*[^\W\d]")
_NUMBERED = re.compile(r"(?:#{1,6}\s+)?([0-9]+(?:\.[0-9]+)+)\.?(?=[ \t]*[^\W\d])")
_RULE = re.compile(r"[|\s:-]+")
_CONTENTS = re.compile(r"\.{4,}[\s|]*[0-9]+[\s|]*$|\t[0-9]+\s*$")
_WORD = re.compile(r"[^\W_]+")
_LONG_ROW = 40
"""A row or paragraph that is not a section is not looked for beyond so many lines."""


@dataclass(frozen=True, slots=True)
class Token:
    """A number in the text: how it is written, where, and what it can mean: as decimal, as hexadecimal, as bits."""

    text: str
    line: int
    column: int
    readings: frozenset[Fraction]


@dataclass(frozen=True, slots=True)
class Extent:
    """Lines first..last (from 1) that belong together: a row of a table, a section, a paragraph."""

    first: int
    last: int
    kind: str

    def __contains__(self, line: int) -> bool:
        return self.first <= line <= self.last


class Manual:
    """A manual's text, read once."""

    def __init__(self, text: str) -> None:
        self.lines = text.splitlines()

    def __len__(self) -> int:
        return len(self.lines)

    def line(self, number: int) -> str:
        """The text of a line counted from 1; empty outside."""
        return self.lines[number - 1] if 1 <= number <= len(self.lines) else ""

    @cached_property
    def headings(self) -> list[int]:
        """The lines that open a section; lines of a table of contents do not."""
        return [
            number
            for number, text in enumerate(self.lines, 1)
            if _HEADING.match(text) and not _CONTENTS.search(text) and "|" not in text
        ]

    @cached_property
    def numbered(self) -> dict[str, int]:
        """The line of each numbered section."""
        found: dict[str, int] = {}
        for number in self.headings:
            match = _NUMBERED.match(self.line(number))
            if match:
                found.setdefault(match[1], number)
        return found

    @cached_property
    def tokens(self) -> list[list[Token]]:
        """The numbers of each line."""
        return [tokens_of(text, number) for number, text in enumerate(self.lines, 1)]

    @cached_property
    def lines_of(self) -> dict[Fraction, list[int]]:
        """Where each number stands, in whatever notation."""
        found: dict[Fraction, list[int]] = {}
        for number, tokens in enumerate(self.tokens, 1):
            for reading in {reading for token in tokens for reading in token.readings}:
                found.setdefault(reading, []).append(number)
        return found

    @cached_property
    def words(self) -> dict[str, list[int]]:
        """Where each word stands, in small letters."""
        found: dict[str, list[int]] = {}
        for number, text in enumerate(self.lines, 1):
            for word in {match[0].lower() for match in _WORD.finditer(text)}:
                found.setdefault(word, []).append(number)
        return found

    def is_row(self, number: int) -> bool:
        """Whether a line is a row of a table with contents."""
        text = self.line(number)
        if _CONTENTS.search(text):
            return False
        return (text.startswith("|") and not _RULE.fullmatch(text)) or "\t" in text.strip()

    def section_of(self, number: int) -> Extent:
        """The section around a line."""
        place = bisect_right(self.headings, number)
        first = self.headings[place - 1] if place else 1
        last = self.headings[place] - 1 if place < len(self.headings) else len(self.lines)
        return Extent(first, last, "section")

    def extent(self, number: int, following: int | None) -> Extent:
        """What a cited line opens: the section of a heading, else the row or paragraph, up to the next cited line."""
        section = self.section_of(number)
        if number == section.first and number in self.headings:
            return section
        last = min(section.last, number + _LONG_ROW)
        if following is not None:
            last = min(last, following - 1)
        if self.line(number).startswith("|"):
            last = min(last, self._end_of_table(number))
        return Extent(number, max(number, last), "row" if self.is_row(number) else "lines")

    def _end_of_table(self, number: int) -> int:
        last = number
        while self.line(last + 1).startswith("|"):
            last += 1
        return last

    def merged_cells(self, number: int) -> list[tuple[int, str]]:
        """The cells above a row's empty cells, with their lines: such a cell is merged with the one above it."""
        text = self.line(number)
        if not text.startswith("|"):
            return []
        empty = {place for place, cell in enumerate(text.split("|")) if not cell.strip()}
        found: list[tuple[int, str]] = []
        above = number - 1
        while empty and self.line(above).startswith("|") and not _RULE.fullmatch(self.line(above)):
            cells = self.line(above).split("|")
            for place in [place for place in empty if place < len(cells) and cells[place].strip()]:
                found.append((above, cells[place]))
                empty.discard(place)
            above -= 1
        return found


def tokens_of(text: str, number: int) -> list[Token]:
    """The numbers in a piece of text of a line."""
    return [Token(match[0], number, match.start() + 1, frozenset(_readings(match))) for match in _NUMBER.finditer(text)]


def _readings(match: re.Match[str]) -> set[Fraction]:
    if marked := match["long"] or match["marked"] or match["tailed"]:
        return {Fraction(int(marked, 16))}
    if parted := match["parted"]:
        return {Fraction(int(parted.replace("_", "").replace("\\", ""), 2))}
    if spaced := match["spaced"]:
        return {Fraction(int(spaced.replace(" ", ""), 16))}
    if bare := match["bare"]:
        return {Fraction(int(bare, 16))}
    text = match["decimal"]
    found = set(_decimals(text))
    if text.isdigit() and len(text) in (2, 4, 8):
        found.add(Fraction(int(text, 16)))
    if set(text) <= {"0", "1"} and len(text) > 1:
        found.add(Fraction(int(text, 2)))
    return found


def _decimals(text: str) -> set[Fraction]:
    """A number with points or commas, which may part decimals or thousands; a list of numbers gives each of them."""
    parts = re.split(r"[.,]", text)
    if len(parts) == 1:
        return {Fraction(int(text))}
    found = {Fraction(int(part)) for part in parts}
    if len(parts) == 2:
        found.add(Fraction(int("".join(parts)), 10 ** len(parts[1])))
    if all(len(part) == 3 for part in parts[1:]):
        found.add(Fraction(int("".join(parts))))
    return found
