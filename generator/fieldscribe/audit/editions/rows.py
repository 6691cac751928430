"""Rows whose cells are broken over other lines: read cell by cell, their words stand in the order that they had."""

from __future__ import annotations

from difflib import SequenceMatcher
from typing import TYPE_CHECKING

from fieldscribe.audit.editions.words import pressed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.audit.editions.matching import Matching
    from fieldscribe.audit.editions.words import Words

    Pairs = list[tuple[int, int]]

_LONGEST = 12
"""A row is broken over at most so many lines."""


def broken_otherwise(matching: Matching) -> Iterator[tuple[range, range, Pairs]]:
    """The words of rows that are the same cell by cell, and only so, with which of them are which."""
    for old, new in dict.fromkeys(_pairs(matching)):
        if len(old) == len(new) == 1:
            continue
        here, there = _by_cells(matching.old, old), _by_cells(matching.new, new)
        if pairs := list(_same(matching, here, there)):
            yield range(min(here), max(here) + 1), range(min(there), max(there) + 1), pairs


def _same(matching: Matching, here: list[int], there: list[int]) -> Iterator[tuple[int, int]]:
    """Which word is which where both series say the same; one that is parted by a hyphen is each of its parts."""
    texts = [matching.old.texts[word] for word in here], [matching.new.texts[word] for word in there]
    if pressed(texts[0]) != pressed(texts[1]):
        return
    for _, first, last, start, end in SequenceMatcher(None, *texts, autojunk=False).get_opcodes():
        steps = max(last - first, end - start)
        for step in range(steps):
            yield here[first + step * (last - first) // steps], there[start + step * (end - start) // steps]


def _pairs(matching: Matching) -> Iterator[tuple[range, range]]:
    """The lines of each row of the old text that lacks words, and those of the row in the new one that begins so."""
    for first, last, start, end in matching.gaps():
        lines = {matching.old.line_of[word] for word in range(first, last)}
        backs = {matching.back[_head(matching.new, matching.new.line_of[word])] for word in range(start, end)}
        lines |= {matching.old.line_of[word] for word in backs if word >= 0}
        for line in lines:
            head = _head(matching.old, line)
            if matching.there[head] >= 0:
                new = matching.new.line_of[matching.there[head]]
                yield _row(matching.old, matching.old.line_of[head]), _row(matching.new, new)


def _head(text: Words, line: int) -> int:
    """The first word of the row that has a line."""
    first = line
    while first > max(1, line - _LONGEST) and text.continues(first):
        first = _next(text, first, -1)
    words = text.of_line(first) or text.of_line(line)
    return words.start


def _row(text: Words, line: int) -> range:
    """The lines of a row: those below that have nothing in the first cell go on with it, on the next page, too."""
    last, below = line, _next(text, line, 1)
    while below - line <= _LONGEST and text.continues(below):
        last, below = below, _next(text, below, 1)
    return range(line, last + 1)


def _next(text: Words, line: int, step: int) -> int:
    """The line below (or above), on the next page where an empty one parts them."""
    return line + step if text.line(line + step).strip() else line + 2 * step


def _by_cells(text: Words, lines: range) -> list[int]:
    """The words of a row, cell by cell."""
    gap = "|" if text.line(lines[0]).startswith("|") else "\t"
    words = [word for line in lines for word in text.of_line(line)]
    return sorted(words, key=lambda word: text.line(text.line_of[word]).count(gap, 0, text.column_of[word] - 1))
