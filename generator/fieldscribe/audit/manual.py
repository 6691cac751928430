"""The text of a manual: lines, the section and the table row around each, and the numbers that stand in it."""

from __future__ import annotations

import re
from bisect import bisect_right
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING

from fieldscribe.audit.pages import page_lines

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator, Sequence

_NUMBER = re.compile(
    r"""(?<![\w,'\u2018\u2019\u201a])(?<![^.]\.)(?:
        0[xX](?P<long>[0-9A-Fa-f]{4})
      | (?:0[xX]|[Hh]'|[Hh]ex[ ])(?P<marked>[0-9A-Fa-f]+)
      | (?P<binary>[01]{4,}(?:[ ][01]{4,})+)(?=[ ]?bin(?!\w))
      | (?P<parted>[0-9]+(?:\\?_[0-9]+)+)(?:(?=bin\b)|(?![A-Za-z0-9]|_[A-Za-z0-9]))
      | (?P<spaced>[0-9A-F](?:[ ][0-9A-F]){1,3})[ ]h(?!\w)
      | (?P<tailed>(?=[A-F]*[0-9]|[A-F]+[hH]|[A-Fa-f]+[0-9])[0-9A-Fa-f]+)[hH](?!\w)
      | (?P<bare>[0-9A-F]*[0-9][0-9A-F]*[A-F][0-9A-F]*|[A-F][0-9A-F]*[0-9][0-9A-F]*|[A-F]{2}|[A-F]{4})(?!\w)
      | (?P<grouped>(?<![0-9][ ])[1-9][0-9]{0,2}(?:[ \u00a0\u2009\u202f][0-9]{3})+)(?![\w'.,]*[0-9])(?![ ][0-9])
      | (?P<decimal>[0-9]+(?:[.,][0-9]+)*)
    )""",
    re.VERBOSE,
)
_HEADING = re.compile(r"#{1,6}\s+\S|[0-9]+(?:\.[0-9]+)+\.?[ \t]*[^\W\d]")
_NUMBERED = re.compile(r"(?:#{1,6}\s+)?([0-9]+(?:\.[0-9]+)+)\.?(?=[ \t]*[^\W\d])")
_RULE = re.compile(r"[|\s:-]+")
_CHAPTER = re.compile(r"([0-9]{1,2})\.?[ \t]+([^\W\d].*?)[.\s|]*([0-9]*)\s*")
"""A number and a title. Many other lines look so: only those are chapters that the table of contents lists."""
_LIST = re.compile("(?![0-9]{1,3}(?:,[0-9]{3})+$)[0-9]+(?:,[0-9]+){2,}")
"""Numbers parted by commas without blanks; three digits behind each comma are thousands."""
_ONE_OVER = "\\frac{"
_OVER = re.compile("/(?:[^\\W\\d_]|%|[0-9]{2})")
"""What makes a 1 the upper half of a fraction: `1/V`, `1/100`."""
_CONTENTS = re.compile(r"\.{4,}[\s|]*[0-9]+[\s|]*$|\t[0-9]+\s*$")
_NO_DIGIT = re.compile(r"[^0-9A-Fa-f]+")
_WORD = re.compile(r"[^\W_]+")
_BLANKS = str.maketrans(dict.fromkeys("\u00a0\u2007\u2009\u202f", " "))
_DASH = r"\s*[-\u2010-\u2015\u2212]\s*"
_PAGE = r"(?<!\w)(?:(?:auf )?Seite|(?:on )?page)\s+(?:[A-Z0-9]{1,2}\s*[-\u2013]\s*)?[0-9]+(?!\w)"
"""Where to read on is no fact."""
_LONGEST_NUMBER = 80
_LONG_ROW = 40
"""A row or paragraph has at most so many lines."""


@dataclass(frozen=True, slots=True)
class Token:
    """A number in the text: how it is written, where, and all that it can mean (`10` is ten, sixteen or two)."""

    text: str
    line: int
    column: int
    readings: frozenset[Fraction]

    def is_plainly(self, numbers: frozenset[Fraction]) -> bool:
        """Whether it means one of these, but not as two or three binary digits such as `11` for 3."""
        if len(self.text) > 3 or not set(self.text) <= {"0", "1"}:
            return not self.readings.isdisjoint(numbers)
        return not (self.readings - {Fraction(int(self.text, 2))} | {Fraction(int(self.text))}).isdisjoint(numbers)


@dataclass(frozen=True, slots=True)
class Extent:
    """Lines first..last (from 1) that belong together: a row of a table, a section, a paragraph."""

    first: int
    last: int
    kind: str

    def __contains__(self, line: int) -> bool:
        return self.first <= line <= self.last


class Manual:
    """A manual's text, read once. `names` are its words with digits in them that are no numbers.

    `sections` are lines that open a section, whatever they look like.
    """

    def __init__(self, text: str, names: Sequence[str] = (), sections: Collection[int] = ()) -> None:
        self.lines = lines_of(text)
        self._sections = frozenset(sections)
        self._heads: dict[int, str] = {}
        self._names = re.compile("|".join([_PAGE, *map(_name, names)]))

    def __len__(self) -> int:
        return len(self.lines)

    def line(self, number: int) -> str:
        """The text of a line counted from 1; empty outside."""
        return self.lines[number - 1] if 1 <= number <= len(self.lines) else ""

    @cached_property
    def page_lines(self) -> frozenset[int]:
        """The heads and feet of its pages."""
        return page_lines(self.lines)

    @cached_property
    def headings(self) -> list[int]:
        """The lines that open a section; lines of a table of contents do not."""
        return [
            number for number, text in enumerate(self.lines, 1) if number in self._sections or self._is_heading(text)
        ]

    def _is_heading(self, text: str) -> bool:
        looks_so = _HEADING.match(text) or _chapter(text) in self._chapters
        return bool(looks_so) and not _CONTENTS.search(text) and "|" not in text

    @cached_property
    def _chapters(self) -> set[tuple[str, str]]:
        """The number and title of each chapter in the table of contents."""
        return {chapter for text in self.lines if _CONTENTS.search(text) and (chapter := _chapter(text)) is not None}

    @cached_property
    def numbered(self) -> dict[str, int]:
        """The line of each numbered section."""
        line_of_number: dict[str, int] = {}
        for number in self.headings:
            text = self.line(number)
            match = _NUMBERED.match(text) or _CHAPTER.match(text)
            if match:
                line_of_number.setdefault(match[1], number)
        return line_of_number

    @cached_property
    def tokens(self) -> list[list[Token]]:
        """The numbers of each line."""
        return [self._tokens_in(text, number, 0) for number, text in enumerate(self.lines, 1)]

    def tokens_in(self, text: str, number: int, column: int = 0) -> list[Token]:
        """The numbers in a piece of a line that begins behind a column, but for those in names."""
        if column == 0 and 1 <= number <= len(self.lines) and text == self.lines[number - 1]:
            return self.tokens[number - 1]
        return self._tokens_in(text, number, column)

    def _tokens_in(self, text: str, number: int, column: int) -> list[Token]:
        names = [match.span() for match in self._names.finditer(text)]
        tokens = tokens_of(text, number, column)
        if not names:
            return tokens
        return [token for token in tokens if not any(first <= token.column - 1 - column < end for first, end in names)]

    def without_names(self, text: str) -> str:
        """A piece of text without the words that are no facts."""
        return self._names.sub("", text)

    @cached_property
    def lines_of(self) -> dict[Fraction, list[int]]:
        """Where each number stands, in whatever notation."""
        lines_of_reading: dict[Fraction, list[int]] = {}
        for number, tokens in enumerate(self.tokens, 1):
            for reading in {reading for token in tokens for reading in token.readings}:
                lines_of_reading.setdefault(reading, []).append(number)
        return lines_of_reading

    @cached_property
    def words(self) -> dict[str, list[int]]:
        """Where each word stands, in small letters."""
        lines_of_word: dict[str, list[int]] = {}
        for number, text in enumerate(self.lines, 1):
            for word in {match[0].lower() for match in _WORD.finditer(text)}:
                lines_of_word.setdefault(word, []).append(number)
        return lines_of_word

    def lines_with(self, word: str) -> list[int]:
        """The lines that contain a word; for the number of a section only its heading."""
        if word in self.numbered:
            return [self.numbered[word]]
        first = "".join(char if char.isalnum() else " " for char in word).split()
        lines = self.words.get(first[0].lower(), []) if first else []
        return [line for line in lines if has_word(self.line(line), word)]

    @cached_property
    def _digits(self) -> list[str]:
        """The hexadecimal digits of each line."""
        return [_NO_DIGIT.sub("", text).upper() for text in self.lines]

    def lines_with_bytes(self, digits: str) -> list[int]:
        """The lines that have these bytes in one piece."""
        return [number for number, text in enumerate(self._digits, 1) if digits in text]

    def end_of_section(self, number: str) -> int:
        """The last line of a numbered section, with the sections below it."""
        start = self.numbered[number]
        following = (
            place for other, place in self.numbered.items() if place > start and not other.startswith(f"{number}.")
        )
        return min(following, default=len(self.lines) + 1) - 1

    def column(self, number: int, place: int) -> int | None:
        """The column of a table in which a place of a line lies (from 0); None outside of tables."""
        text = self.line(number)
        gap = "|" if text.startswith("|") else "\t"
        return text.count(gap, 0, place) if gap in text else None

    def head(self, number: int) -> str:
        """The letters of a table's first row, for any of its rows."""
        if number not in self._heads:
            gap = "|" if self.line(number).startswith("|") else "\t"
            first = number
            while gap in self.line(first - 1) and first - 1 not in self._heads:
                first -= 1
            head = self._heads.get(first - 1) if gap in self.line(first - 1) else self.line(first)
            self._heads |= dict.fromkeys(range(first, number + 1), "".join(filter(str.isalnum, head or "")))
        return self._heads[number]

    def is_merged(self, number: int) -> bool:
        """Whether the first cell of a table's row is empty: merged with the one above it."""
        return self.line(number).startswith("|") and not self.line(number).split("|")[1].strip()

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

    def merged_cells(self, number: int) -> list[tuple[int, int, str]]:
        """The cells above a row's empty cells, with line and column: such a cell is merged with the one above it."""
        text = self.line(number)
        if not text.startswith("|"):
            return []
        empty = {place for place, cell in enumerate(text.split("|")) if not cell.strip()}
        merged: list[tuple[int, int, str]] = []
        above = number - 1
        while empty and self.line(above).startswith("|") and not _RULE.fullmatch(self.line(above)):
            cells = self.line(above).split("|")
            for place in [place for place in empty if place < len(cells) and cells[place].strip()]:
                merged.append((above, len("|".join(cells[:place])) + 1, cells[place]))
                empty.discard(place)
            above -= 1
        return merged


def lines_of(text: str) -> list[str]:
    """The lines of a text, with plain blanks: those that hold two words together are layout."""
    return text.translate(_BLANKS).splitlines()


def tokens_of(text: str, number: int, column: int = 0) -> list[Token]:
    """The numbers in a piece of a line that begins behind a column, without the 1 of a fraction 1/x."""
    tokens: list[Token] = []
    for match in _NUMBER.finditer(text):
        if _LIST.fullmatch(match[0]):
            for part in re.finditer("[0-9]+", match[0]):
                tokens += tokens_of(part[0], number, column + match.start() + part.start())
        elif match[0] != "1" or not (text.endswith(_ONE_OVER, 0, match.start()) or _OVER.match(text, match.end())):
            digits = match[0].replace(" ", "_") if match["binary"] else match[0]
            tokens.append(Token(match[0], number, column + match.start() + 1, _readings_of(digits)))
    return tokens


def _name(name: str) -> str:
    """A pattern of a name that stands by itself, with any blanks and dashes in it."""
    pieces = (r"\s+".join(map(re.escape, piece.split())) for piece in re.split(_DASH, name))
    return rf"(?<!\w){_DASH.join(pieces)}(?!\w)"


def _chapter(text: str) -> tuple[str, str] | None:
    match = _CHAPTER.fullmatch(text)
    return None if match is None else (match[1], match[2])


@lru_cache(10_000)
def _readings_of(number: str) -> frozenset[Fraction]:
    """All that a number can mean: the same few are printed again and again."""
    match = _NUMBER.fullmatch(number) if len(number) <= _LONGEST_NUMBER else None
    return frozenset(_readings(match) if match else ())


def _readings(match: re.Match[str]) -> set[Fraction]:
    if marked := match["long"] or match["marked"] or match["tailed"]:
        return {Fraction(int(marked, 16))}
    if parted := match["parted"]:
        digits = parted.replace("_", "").replace("\\", "")
        return {Fraction(int(digits, 2 if set(digits) <= {"0", "1"} else 10))}
    if spaced := match["spaced"]:
        return {Fraction(int(spaced.replace(" ", ""), 16))}
    if grouped := match["grouped"]:
        return {Fraction("".join(grouped.split())), *map(Fraction, grouped.split())}
    if bare := match["bare"]:
        amount = {Fraction(int(bare[:-1]))} if re.fullmatch("[1-9][0-9]*A", bare) else set()
        return {Fraction(int(bare, 16)), *amount}  # "10A" may be ten ampere
    text = match["decimal"]
    readings = set(_decimals(text))
    if text.isdigit() and len(text) in (2, 4, 8):
        readings.add(Fraction(int(text, 16)))
    if set(text) <= {"0", "1"} and len(text) > 1:
        readings.add(Fraction(int(text, 2)))
    return readings


def _decimals(text: str) -> set[Fraction]:
    """The readings of a number with points or commas: they may part decimals, thousands, or the numbers of a list."""
    parts = re.split(r"[.,]", text)
    if len(parts) == 1:
        return {Fraction(int(text))}
    if len(parts) == 2:
        readings = {Fraction(int("".join(parts)), 10 ** len(parts[1]))}
    else:
        readings = {Fraction(int(part)) for part in parts}
    if all(len(part) == 3 for part in parts[1:]):
        readings.add(Fraction(int("".join(parts))))
    return readings


def has_word(text: str, word: str) -> bool:
    """Whether a word stands in a text by itself: `4.2.1` is not in `4.2.10`, nor `A02` in `A020`."""
    return next(places_in(text, word), None) is not None


def places_in(text: str, word: str) -> Iterator[int]:
    """Where a word stands in a text by itself."""
    at = text.find(word)
    while at >= 0:
        before, after = text[at - 1 : at], text[at + len(word) : at + len(word) + 1]
        if not before.isalnum() and not after.isalnum():
            yield at
        at = text.find(word, at + 1)
