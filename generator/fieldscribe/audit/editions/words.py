"""A text as a series of words, in which layout counts for nothing: cells, padding, line breaks, dashes, lists, bold."""

from __future__ import annotations

import re
from bisect import bisect_left
from types import MappingProxyType
from typing import TYPE_CHECKING
from unicodedata import normalize

from fieldscribe.audit.editions.formulas import without_setting
from fieldscribe.audit.layout.alignment import Pieces
from fieldscribe.audit.manual import lines_of

if TYPE_CHECKING:
    from collections.abc import Container, Mapping

LINE_BREAK = " \u23ce "
"""Stands for the end of a line where words of several lines are shown."""
_INVISIBLE = "\u00ad\u200b\u200c\u200d\u2060\ufeff"
_DASHES = "\u2010\u2011\u2012\u2013\u2014\u2015\u2212\ufe58\ufe63\uff0d"
_WORD = re.compile(
    rf"[0-9A-F](?: [0-9A-F]){{1,3}} h(?!\w)|[^\W_]+(?:[{_INVISIBLE}\u0300-\u036f]+[^\W_]*)*|[^\w\s|{_INVISIBLE}]|_"
)
"""A number with a blank behind each digit is one, as it is for `Manual`."""
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
_TAG = re.compile(
    r"</?(?:br|b|i|u|em|strong|sub|sup|p|ul|ol|li|div|span|font|small|center)(?:\s[^<>|]*)?/?>|\*\*", re.IGNORECASE
)
_PARTS_CELLS = re.compile(r"\||\t|<br|<li", re.IGNORECASE)
_CONTINUES = re.compile(r"[\t ]|\|\s*\|")
_MARKS = re.compile(r"\s*(?:#{1,6}|[-*+\u2022\u2013](?: +o)?|o(?= ))(?=\s)")
"""What makes a line a heading, or an entry of a list."""
_HEXADECIMAL = re.compile(r"\b(?:0[xX]([0-9A-Fa-f]+)|([0-9][0-9A-Fa-f]*) ?[hH]|([0-9A-F]{2,})[hH])\b")
_DASH_IN_WORD = re.compile(r"(?<=[^\W\d_]) ?- ?(?=[^\W\d_])")
_PARTED_NUMBER = re.compile("[0-9]+[.,][0-9]+")
_LIST = re.compile(r"(?<![0-9.,])(?![0-9]{1,3}(?:,[0-9]{3})+(?![0-9]))[0-9]+(?:,[0-9]+){2,}(?![0-9.,]*[0-9])")
"""Numbers with nothing but commas between, but for those that part thousands."""
_SPACED = 4
"""A word with blanks between its letters has so many: `C R C 1 6`."""
_THOUSANDS = re.compile(r"(?<![0-9.,])(?<![0-9] )[1-9][0-9]{0,2}(?: [0-9]{3})+(?![0-9]| [0-9])")
_BLANK = re.compile(r"(?<![0-9]) | (?![0-9])")
_NO_ENDS: Mapping[int, int] = MappingProxyType({})


class Words(Pieces):
    """The words of a text with the place of each: a name, a number, or one sign of punctuation."""

    def __init__(self, text: str, without: Container[int] = (), ends: Mapping[int, int] = _NO_ENDS) -> None:
        """The words of all lines but some (heads and feet of pages part what belongs together), of others to an end."""
        super().__init__()
        self.lines = lines_of(text)
        self.texts: list[str] = []
        self.column_of: list[int] = []
        self._opening: set[int] = set()
        self.entries: set[int] = set()
        """The lines that a mark makes entries of a list."""
        for number, line in enumerate(self.lines, 1):
            if number not in without and not _RULE.fullmatch(line):
                self._add(number, line[: ends.get(number)])
            self._end_line()

    def _add(self, number: int, line: str) -> None:
        marks = _MARKS.match(line)
        if marks and "#" not in marks[0]:
            self.entries.add(number)
        plain = without_setting(_TAG.sub(lambda match: " " * len(match[0]), line))
        end = 0
        for match in _WORD.finditer(plain, marks.end() if marks else 0):
            written = match[0]
            if _PARTS_CELLS.search(line, end, match.start()):
                self._opening.add(len(self.texts))
            end = match.end()
            self.texts.append("." if self._is_decimal(plain, match) else _as_word(written))
            self.line_of.append(number)
            self.column_of.append(match.start() + 1)

    @staticmethod
    def _is_decimal(line: str, sign: re.Match[str]) -> bool:
        """Whether a sign is the comma of a number, and parts no list of them: `0,3,4`."""
        start, end = sign.span()
        if sign[0] != "," or not line[start - 1 : start].isdigit() or not line[end : end + 1].isdigit():
            return False
        return not any(first < end <= last for first, last in map(re.Match.span, _LIST.finditer(line)))

    def line(self, number: int) -> str:
        """A line counted from 1; empty outside the text."""
        return self.lines[number - 1] if 1 <= number <= len(self.lines) else ""

    def first_cell(self, line: int) -> range:
        """The words in the first cell of a row; none of a line that has no cells."""
        words, text = self.of_line(line), self.line(line)
        end = text.find("|", 1) if text.startswith("|") else text.find("\t")
        return range(words.start, self.at(line, end + 1)) if end >= 0 else range(words.start, words.start)

    def goes_on(self, line: int) -> bool:
        """Whether a row goes on in a line: its first cell is empty."""
        text = self.line(line)
        return text.startswith("\t") or (text.startswith("|") and not text.split("|")[1].strip())

    def opens_cell(self, word: int) -> bool:
        """Whether a word is the first of its cell, or of a line in it."""
        return word in self._opening

    def continues(self, line: int) -> bool:
        """Whether a line goes on with the row above: it has nothing in the first cell."""
        return _CONTINUES.match(self.line(line)) is not None

    def beside(self, words: range) -> tuple[list[str], list[str]]:
        """The word before these and the one behind, where they are in the same cell."""
        above = [] if self.opens_cell(words.start) else self.texts[max(0, words.start - 1) : words.start]
        return above, [] if self.opens_cell(words.stop) else self.texts[words.stop : words.stop + 1]

    def is_in_one_line(self, start: int, end: int) -> bool:
        """Whether the words from..to stand in one line."""
        return self.line_of[start] == self.line_of[end - 1]

    def at(self, line: int, column: int) -> int:
        """The word at a place, or the first one behind it."""
        words = self.of_line(line)
        return bisect_left(self.column_of, column, words.start, words.stop)

    def is_numbering(self, start: int, end: int) -> bool:
        """Whether words are a number and a sign before the text of a line, as in `1.`."""
        texts = self.texts[start:end]
        opens = self.opens_line(start) and not self.opens_line(end)
        return opens and len(texts) == 2 and texts[0].isdigit() and texts[1] in (".", ")")

    def is_entry(self, counterparts: list[int], word: int) -> bool:
        """Whether a word of the other text has its counterpart at the start of an entry of a list."""
        here = counterparts[word]
        return here >= 0 and self.opens_line(here) and self.line_of[here] in self.entries

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
        """Whether a word and the next one are parts of the same number: digits stand on both sides of its sign."""
        sign = word + self.texts[word].isdigit()
        parts = range(max(0, sign - 1), min(sign + 2, len(self)))
        number = "".join(self.texts[part] for part in parts)
        glued = self.column_of[parts[0]] + len(number) == self.column_of[parts[-1]] + len(self.texts[parts[-1]])
        one_line = self.line_of[parts[0]] == self.line_of[parts[-1]]
        return glued and one_line and _PARTED_NUMBER.fullmatch(number) is not None

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


def _as_word(written: str) -> str:
    plain = written if written.isascii() else normalize("NFC", written.translate(_AS_WRITTEN))
    return plain.replace(" ", "")


def pressed(texts: list[str]) -> str:
    """Words without what only sets them: blanks, hyphens, marks of hexadecimal numbers; thousands are one number."""
    written = _HEXADECIMAL.sub(lambda number: f"0x{number[number.lastindex or 0].upper()}", " ".join(texts))
    joined = _THOUSANDS.sub(lambda number: number[0].replace(" ", ""), written)
    return _BLANK.sub("", _DASH_IN_WORD.sub("", joined))


def unspaced(texts: list[str]) -> list[str]:
    """Letters that blanks part as one word."""
    is_spaced = (
        len(texts) >= _SPACED and texts[0].isalpha() and all(len(text) == 1 and text.isalnum() for text in texts)
    )
    return ["".join(texts)] if is_spaced else texts
