"""The text of a manual: its lines, and the section and table row around each line.

A passage is a piece of it in which claims are searched for: its numbers in order, and its letters without layout.
"""

from __future__ import annotations

import re
from bisect import bisect_left, bisect_right
from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from functools import cached_property
from typing import NamedTuple

from fieldscribe.audit.numbers import Token, tokens_of

_HEADING = re.compile(r"#{1,6}\s+\S|[0-9]+(?:\.[0-9]+)+\.?[ \t]*[^\W\d]")
_SECTION_NUMBER = re.compile(r"(?:#{1,6}\s+)?([0-9]+(?:\.[0-9]+)+)\.?(?=[ \t]*[^\W\d])")
_CHAPTER = re.compile(r"([0-9]{1,2})\.?[ \t]+([^\W\d].*?)[.\s|]*([0-9]*)\s*")
"""Matches a number and a title. Other lines look alike: only those in the table of contents are chapters."""
_RULE = re.compile(r"[|\s:-]+")
_CONTENTS = re.compile(r"\.{4,}[\s|]*[0-9]+[\s|]*$|\t[0-9]+\s*$")
_BLANKS = str.maketrans(dict.fromkeys("\u00a0\u2007\u2009\u202f", " "))
_DASH = r"\s*[-\u2010-\u2015\u2212]\s*"
_PAGE_REFERENCE = r"(?<!\w)(?:(?:auf )?Seite|(?:on )?page)\s+(?:[A-Z0-9]{1,2}\s*[-\u2013]\s*)?[0-9]+(?!\w)"
_LONGEST_ROW = 40
"""The most lines of a row or paragraph."""
_TALLEST_CELL = 200
"""The most rows of a merged cell."""
_NEAR = 200
"""The number of lines above and below its place in which a missing fact is searched for."""
_LONGEST_HEAD = 120
_PAGE_COUNT = re.compile(
    r"\b(?:Seite|Blatt|page|sheet)\s*[0-9]+\b|\b[A-Z][-\u2013][0-9]+\s*$|[-\u2013]\s*[0-9]+\s*[-\u2013]\s*$|\b[0-9]+\s*(?:/|von|of)\s*[0-9]+\s*$",
    re.IGNORECASE,
)
_FEWEST_PAGES = 3


class Extent(NamedTuple):
    """Lines first..last (from 1) that belong together; `kind` is `row`, `section` or `lines`."""

    first: int
    last: int
    kind: str

    def __contains__(self, line: object) -> bool:
        return isinstance(line, int) and self.first <= line <= self.last

    @property
    def lines(self) -> range:
        """The numbers of its lines."""
        return range(self.first, self.last + 1)


class Manual:
    """A manual's text, read once. `names` are words with digits in them that are not numbers, such as `CRC-16`."""

    def __init__(self, text: str, names: Sequence[str] = ()) -> None:
        self.lines = lines_of(text)
        self._tokens: dict[int, list[Token]] = {}
        self._readings_of: dict[int, frozenset[Fraction]] = {}
        self._names = re.compile("|".join([_PAGE_REFERENCE, *map(_pattern_of_name, names)]))

    def __len__(self) -> int:
        return len(self.lines)

    def line(self, number: int) -> str:
        """Return the text of a line counted from 1; empty outside."""
        return self.lines[number - 1] if 1 <= number <= len(self.lines) else ""

    def tokens(self, number: int) -> list[Token]:
        """Return the numbers of a line."""
        if number not in self._tokens:
            self._tokens[number] = self.tokens_in(self.line(number), number, 0)
        return self._tokens[number]

    def tokens_in(self, text: str, number: int, column: int) -> list[Token]:
        """Return the numbers in a piece of a line that begins after `column` characters, except those in names."""
        tokens = tokens_of(text, number, column)
        names = [match.span() for match in self._names.finditer(text)] if tokens else []
        return [token for token in tokens if not any(first <= token.column - 1 - column < end for first, end in names)]

    def without_names(self, text: str) -> str:
        """Return a text with blanks in place of the words that are not facts."""
        return self._names.sub(lambda name: " " * len(name[0]), text)

    @cached_property
    def page_lines(self) -> frozenset[int]:
        """The heads and feet that count pages: lines that differ only in one number, which rises from page to page."""
        groups: dict[str, list[int]] = {}
        for number, text in enumerate(self.lines, 1):
            if len(text) <= _LONGEST_HEAD and not text.startswith("|") and _PAGE_COUNT.search(text):
                groups.setdefault(re.sub("[0-9]+", "#", " ".join(text.split())), []).append(number)
        return frozenset(number for group in groups.values() if self._counts_up(group) for number in group)

    def _counts_up(self, group: list[int]) -> bool:
        counts = [tuple(map(int, re.findall("[0-9]{1,9}", self.line(number)))) for number in group]
        columns = [column for column in zip(*counts, strict=False) if len(set(column)) > 1]
        rises = len(columns) == 1 and list(columns[0]) == sorted(set(columns[0]))
        return len(group) >= _FEWEST_PAGES and rises

    @cached_property
    def headings(self) -> list[int]:
        """The lines that open a section; lines of a table of contents do not."""
        return [number for number, text in enumerate(self.lines, 1) if self._is_heading(text)]

    def _is_heading(self, text: str) -> bool:
        looks_so = _HEADING.match(text) or (self._chapters and _chapter(text) in self._chapters)
        return bool(looks_so) and not _CONTENTS.search(text) and "|" not in text

    @cached_property
    def _chapters(self) -> set[tuple[str, str]]:
        """The number and title of each chapter in the table of contents."""
        return {chapter for text in self.lines if _CONTENTS.search(text) and (chapter := _chapter(text)) is not None}

    @cached_property
    def line_of_section(self) -> dict[str, int]:
        """The line of each numbered section."""
        lines: dict[str, int] = {}
        for number in self.headings:
            match = _SECTION_NUMBER.match(self.line(number)) or _CHAPTER.match(self.line(number))
            if match:
                lines.setdefault(match[1], number)
        return lines

    def end_of_section(self, section: str) -> int:
        """Return the last line of a numbered section, with the sections below it."""
        start = self.line_of_section[section]
        following = (
            line for other, line in self.line_of_section.items() if line > start and not other.startswith(f"{section}.")
        )
        return min(following, default=len(self.lines) + 1) - 1

    def section_around(self, number: int) -> Extent:
        """Return the section that a line lies in."""
        place = bisect_right(self.headings, number)
        first = self.headings[place - 1] if place else 1
        last = self.headings[place] - 1 if place < len(self.headings) else len(self.lines)
        return Extent(first, last, "section")

    def extent(self, number: int, following: int | None) -> Extent:
        """Return the extent that a cited line opens: a section, row or paragraph before the cited line `following`."""
        section = self.section_around(number)
        if number == section.first and number in self.headings:
            return section
        last = min(section.last, number + _LONGEST_ROW)
        if following is not None:
            last = min(last, following - 1)
        if self.line(number).startswith("|"):
            last = next((line - 1 for line in range(number + 1, last + 1) if not self.line(line).startswith("|")), last)
        return Extent(number, max(number, last), "row" if self.is_row(number) else "lines")

    def is_row(self, number: int) -> bool:
        """Return True for a row of a table that has contents."""
        text = self.line(number)
        if _CONTENTS.search(text):
            return False
        return (text.startswith("|") and not _RULE.fullmatch(text)) or "\t" in text.strip()

    def opens_row(self, number: int) -> bool:
        """Return True for a row of a table that has a first cell: without one it continues the row above."""
        text = self.line(number)
        first_cell = text.split("|")[1] if text.startswith("|") else text.split("\t")[0]
        return self.is_row(number) and bool(first_cell.strip())

    def merged_cells(self, number: int) -> list[tuple[int, int, str]]:
        """Return line, column and text of the cells above a row's empty cells: an empty cell is merged with those."""
        text = self.line(number)
        if not text.startswith("|"):
            return []
        empty = {place for place, cell in enumerate(text.split("|")) if not cell.strip()}
        merged: list[tuple[int, int, str]] = []
        above = number - 1
        while empty and number - above <= _TALLEST_CELL and self.is_row(above) and self.line(above).startswith("|"):
            cells = self.line(above).split("|")
            for place in [place for place in empty if place < len(cells) and cells[place].strip()]:
                merged.append((above, len("|".join(cells[:place])) + 1, cells[place]))
                empty.discard(place)
            above -= 1
        return merged

    def nearest_with(self, numbers: frozenset[Fraction], words: Sequence[str], line: int) -> int | None:
        """Return the line nearest to `line` that has one of the numbers, or else one of the words; None if none has."""
        near = range(max(1, line - _NEAR), min(len(self.lines), line + _NEAR) + 1)
        for place in sorted(near, key=lambda place: abs(place - line)):
            has_one = not self._readings(place).isdisjoint(numbers) if numbers else False
            if has_one or (not numbers and any(has_word(self.line(place), word) for word in words)):
                return place
        return None

    def _readings(self, number: int) -> frozenset[Fraction]:
        """Return all that the numbers of a line can mean."""
        if number not in self._readings_of:
            readings = (token.readings for token in self.tokens(number))
            self._readings_of[number] = frozenset().union(*readings)
        return self._readings_of[number]


def lines_of(text: str) -> list[str]:
    """Return the lines of a text, with plain blanks in place of non-breaking ones."""
    return text.translate(_BLANKS).splitlines()


def _pattern_of_name(name: str) -> str:
    """Return a pattern of a name that stands by itself, with any blanks and dashes in it."""
    pieces = (r"\s+".join(map(re.escape, piece.split())) for piece in re.split(_DASH, name))
    return rf"(?<!\w){_DASH.join(pieces)}(?!\w)"


def _chapter(text: str) -> tuple[str, str] | None:
    match = _CHAPTER.fullmatch(text) if text[:1].isdigit() else None
    return None if match is None else (match[1], match[2])


def has_word(text: str, word: str) -> bool:
    """Return True if a word occurs in a text by itself: `4.2.1` is not in `4.2.10`, nor `A02` in `A020`."""
    return next(places_of_word(text, word), None) is not None


def places_of_word(text: str, word: str) -> Iterator[int]:
    """Yield the places of a word by itself in a text."""
    at = text.find(word)
    while at >= 0:
        before, after = text[at - 1 : at], text[at + len(word) : at + len(word) + 1]
        if not before.isalnum() and not after.isalnum():
            yield at
        at = text.find(word, at + 1)


_TAG = re.compile(r"</?[A-Za-z]{1,6}/?>")


def letters_of(text: str) -> str:
    """Return only letters and digits, without case: blanks, hyphens and line breaks are layout."""
    return "".join(char for char in text.casefold() if char.isalnum())


class Passage:
    """Pieces of text, each with the line and the column (from 0) where it begins."""

    def __init__(self, manual: Manual, pieces: Iterable[tuple[int, int, str]]) -> None:
        self.manual = manual
        self.pieces = list(pieces)
        self.tokens: list[Token] = []
        self.starts: list[int] = []
        self.ends: list[int] = []
        self._line_starts: list[int] = []
        length = 0
        for line, column, text in self.pieces:
            whole = column == 0 and text == manual.line(line)
            for token in manual.tokens(line) if whole else manual.tokens_in(text, line, column):
                self.tokens.append(token)
                self.starts.append(length + token.column - 1 - column)
                self.ends.append(self.starts[-1] + len(token.text))
            self._line_starts.append(length)
            length += len(text) + 1
        self.text = "\n".join(text for _, _, text in self.pieces)

    def line_at(self, place: int) -> int:
        """Return the line of the manual that a place of the text lies on."""
        return self.pieces[bisect_right(self._line_starts, place) - 1][0]

    @cached_property
    def _letters(self) -> tuple[str, list[int]]:
        """The letters, each with its place in the text."""
        visible = _TAG.sub(lambda tag: " " * len(tag[0]), self.text)
        letters, places = [], []
        for place, char in enumerate(visible):
            if char.isalnum():
                for letter in char.casefold():
                    letters.append(letter)
                    places.append(place)
        return "".join(letters), places

    def places(self, words: str) -> Iterator[tuple[int, int]]:
        """Yield the places of words by themselves: that of the first letter and the one after the last letter."""
        wanted = letters_of(words)
        letters, places = self._letters
        at = letters.find(wanted) if wanted else -1
        while at >= 0:
            first, last = places[at], places[at + len(wanted) - 1]
            if self._may_begin(first, wanted) and self._may_end(last):
                yield first, last + 1
            at = letters.find(wanted, at + 1)

    def _may_begin(self, place: int, wanted: str) -> bool:
        """Return True if a word may begin here: extracted tables lose gaps, so a capital or digit may begin a cell."""
        before, char = self.text[place - 1 : place] if place else "", self.text[place]
        glued = char.isupper() or (char.isdigit() and before.isalpha() and not wanted.isdigit())
        return not before.isalnum() or glued

    def _may_end(self, place: int) -> bool:
        char, after = self.text[place], self.text[place + 1 : place + 2]
        return not after.isalnum() or (char.isalpha() and (after.isdigit() or after.isupper()))

    @cached_property
    def columns(self) -> list[Passage]:
        """The columns of its tables, each as a passage of its own."""
        cells: dict[int, list[tuple[int, int, str]]] = {}
        for line, column, text in self.pieces:
            gap = "|" if text.startswith("|") else "\t"
            start = column
            for place, cell in enumerate(text.split(gap) if gap in text else ()):
                cells.setdefault(place, []).append((line, start, cell))
                start += len(cell) + 1
        return [Passage(self.manual, cells[place]) for place in sorted(cells)]

    def inside(self, first: int, end: int) -> list[Token]:
        """Return the numbers that begin in a part of the text."""
        return self.tokens[bisect_left(self.starts, first) : bisect_left(self.starts, end)]

    def overlapping(self, first: int, end: int) -> list[Token]:
        """Return the numbers that overlap a part of the text."""
        return self.tokens[bisect_right(self.ends, first) : bisect_left(self.starts, end)]

    def after_names(self, names: tuple[str, ...]) -> list[Token]:
        """Return the numbers right after one of these names, as in `Mux 3` or `Default: 0`."""
        pattern = rf"(?<!\w)(?:{'|'.join(map(re.escape, names))})(?:\s*[:=])?\s*(?=[0-9])"
        matches = re.finditer(pattern, self.text)
        return [token for match in matches for token in self.inside(match.end(), match.end() + 1)]

    @cached_property
    def opening_lines(self) -> set[int]:
        """The ids of the numbers with no word before them on their line."""
        openings = (re.match(r"\W*", text) for _, _, text in self.pieces)
        ends = (match.end() if match else 0 for match in openings)
        starts = {start + end for start, end in zip(self._line_starts, ends, strict=True)}
        return {id(token) for token, start in zip(self.tokens, self.starts, strict=True) if start in starts}

    def in_order(self, numbers: tuple[frozenset[Fraction], ...]) -> Iterator[list[Token]]:
        """Yield each run of consecutive numbers in this order."""
        for at in range(len(self.tokens) - len(numbers) + 1):
            run = self.tokens[at : at + len(numbers)]
            if all(token.readings & wanted for token, wanted in zip(run, numbers, strict=True)):
                yield run
