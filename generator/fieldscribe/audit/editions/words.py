"""A text as a series of words, in which layout counts for nothing: cells, padding, line breaks (`<br>`), dashes."""

from __future__ import annotations

import re
from bisect import bisect_left
from types import MappingProxyType
from typing import TYPE_CHECKING
from unicodedata import normalize

from fieldscribe.audit.editions.formulas import without_setting

if TYPE_CHECKING:
    from collections.abc import Container, Mapping

LINE_BREAK = " \u23ce "
"""Stands for the end of a line where words of several lines are shown."""
_INVISIBLE = "\u00ad\u200b\u200c\u200d\u2060\ufeff"
_DASHES = "\u2010\u2011\u2012\u2013\u2014\u2015\u2212\ufe58\ufe63\uff0d"
_WORD = re.compile(rf"[^\W_]+(?:[{_INVISIBLE}\u0300-\u036f]+[^\W_]*)*|[^\w\s|{_INVISIBLE}]|_")
_DOTS = "\u22c5\u2219"
_AS_WRITTEN = str.maketrans(
    {
        **dict.fromkeys(_INVISIBLE),
        **dict.fromkeys(_DASHES, "-"),
        **dict.fromkeys(_DOTS, "\u00b7"),
        "\u2026": "...",
        "\u00b5": "\u03bc",
    }
)
_RULE = re.compile(rf"[|\s:+=*_{_DASHES}-]*([-=_*{_DASHES}]{{3}}|\|)[|\s:+=*_{_DASHES}-]*")
_BREAK = re.compile(r"<br ?/?>", re.IGNORECASE)
_HEADING_MARKS = re.compile(r"\s*#{1,6}(?=\s)")
_DASH_IN_WORD = re.compile(r"(?<=[^\W\d_]) ?- ?(?=[^\W\d_])")
_PARTED_NUMBER = re.compile("[0-9]+[.,]|[.,][0-9]+")
_THOUSANDS = re.compile(r"(?<![0-9.,])(?<![0-9] )[1-9][0-9]{0,2}(?: [0-9]{3})+(?![0-9]| [0-9])")
_BLANK = re.compile(r"(?<![0-9]) | (?![0-9])")
_NO_ENDS: Mapping[int, int] = MappingProxyType({})


class Words:
    """The words of a text with the place of each: a name, a number, or one sign of punctuation."""

    def __init__(self, text: str, without: Container[int] = (), ends: Mapping[int, int] = _NO_ENDS) -> None:
        """The words of all lines but some (heads and feet of pages part what belongs together), of others to an end."""
        self.lines = text.splitlines()
        self.texts: list[str] = []
        self.line_of: list[int] = []
        self.column_of: list[int] = []
        self._first: list[int] = [0]
        for number, line in enumerate(self.lines, 1):
            if number not in without and not _RULE.fullmatch(line):
                self._add(number, line[: ends.get(number)])
            self._first.append(len(self.texts))

    def _add(self, number: int, line: str) -> None:
        marks = _HEADING_MARKS.match(line)
        line = without_setting(_BREAK.sub(lambda match: " " * len(match[0]), line))
        for match in _WORD.finditer(line, marks.end() if marks else 0):
            written = match[0]
            self.texts.append(written if written.isascii() else normalize("NFC", written.translate(_AS_WRITTEN)))
            self.line_of.append(number)
            self.column_of.append(match.start() + 1)

    def __len__(self) -> int:
        return len(self.texts)

    def line(self, number: int) -> str:
        """A line counted from 1; empty outside the text."""
        return self.lines[number - 1] if 1 <= number <= len(self.lines) else ""

    def of_line(self, line: int) -> range:
        """The words of a line counted from 1; none outside the text."""
        if not 1 <= line <= len(self.lines):
            return range(len(self), len(self))
        return range(self._first[line - 1], self._first[line])

    def opens_line(self, word: int) -> bool:
        """Whether a word is the first of its line; what stands behind the last word is."""
        return word >= len(self) or word == 0 or self.line_of[word] != self.line_of[word - 1]

    def up_to_end(self, word: int, step: int) -> range:
        """The words of its line from a word on, forwards or (-1) backwards."""
        line = self.of_line(self.line_of[word])
        return range(word, line.stop if step > 0 else line.start - 1, step)

    def is_in_one_line(self, start: int, end: int) -> bool:
        """Whether the words from..to stand in one line."""
        return self.line_of[start] == self.line_of[end - 1]

    def at(self, line: int, column: int) -> int:
        """The word at a place, or the first one behind it."""
        words = self.of_line(line)
        return bisect_left(self.column_of, column, words.start, words.stop)

    def is_minus(self, word: int) -> bool:
        """Whether a word is the sign of the number behind it, and no dash between two."""
        if self.texts[word] != "-" or word + 1 >= len(self) or not self.texts[word + 1][0].isdigit():
            return False
        line, column = self.lines[self.line_of[word] - 1], self.column_of[word]
        return self.column_of[word + 1] == column + 1 and not line[column - 2 : column - 1].isalnum()

    def whole(self, words: range) -> range:
        """Words with the rest of the number that they are the first or last part of."""
        first, last = words.start, words.stop
        while first and self._are_one_number(first - 1):
            first -= 1
        while last < len(self) and self._are_one_number(last - 1):
            last += 1
        while first < words.start and not self.texts[first].isdigit():
            first += 1
        while last > words.stop and not self.texts[last - 1].isdigit():
            last -= 1
        return range(first, last)

    def _are_one_number(self, word: int) -> bool:
        """Whether a word and the next one are parts of the same number."""
        here, behind = self.texts[word], self.texts[word + 1]
        glued = self.column_of[word] + len(here) == self.column_of[word + 1]
        has_digits = here.isdigit() != behind.isdigit() and _PARTED_NUMBER.fullmatch(here + behind) is not None
        return glued and has_digits and self.line_of[word] == self.line_of[word + 1]

    def shown(self, words: range) -> str:
        """Words as the text writes them, with a slash between lines."""
        if not words:
            return ""
        first, last = self.line_of[words[0]], self.line_of[words[-1]]
        pieces = []
        for number in range(first, last + 1):
            inside = [word for word in self.of_line(number) if word in words]
            if inside:
                end = self.column_of[inside[-1]] - 1
                match = _WORD.match(self.lines[number - 1], end)
                pieces.append(self.lines[number - 1][self.column_of[inside[0]] - 1 : match.end() if match else end + 1])
        return LINE_BREAK.join(pieces)


def pressed(texts: list[str]) -> str:
    """Words without the blanks and hyphens that only set them: two numbers stay apart, but for thousands."""
    joined = _THOUSANDS.sub(lambda match: match[0].replace(" ", ""), " ".join(texts))
    return _BLANK.sub("", _DASH_IN_WORD.sub("", joined))
