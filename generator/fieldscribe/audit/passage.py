"""A piece of a manual's text in which claims are searched for: its numbers in order, and its letters without layout."""

from __future__ import annotations

import re
from bisect import bisect_left, bisect_right
from collections.abc import Iterable, Iterator
from fractions import Fraction
from functools import cached_property

from fieldscribe.audit.manual import Manual
from fieldscribe.audit.numbers import Token

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
