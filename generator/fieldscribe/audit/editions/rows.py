"""Rows whose cells are broken over other lines: read cell by cell, their words stand in the order that they had.

A cell that belongs to two rows may be one or be cut between them: then the cells below the whole one are empty.
"""

from __future__ import annotations

import re
from difflib import SequenceMatcher
from itertools import islice, takewhile
from typing import TYPE_CHECKING

from fieldscribe.audit.editions.words import Words, pressed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.audit.editions.matching import Matching

    Pairs = list[tuple[int, int]]

_CONTINUES = re.compile(r"[\t ]|\|\s*\|")
_TEXT = re.compile(r"[^\W\d_]{2}")
_TOGETHER = 4
"""A cell belongs to at most so many rows."""
_LONGEST = 12
"""A row is broken over at most so many lines."""


def broken_otherwise(matching: Matching) -> Iterator[tuple[range, range, Pairs]]:
    """The words of rows that are the same cell by cell, and only so, with which of them are which."""
    for old, new in dict.fromkeys((*_pairs(matching), *_cut_cells(matching))):
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


def _cut_cells(matching: Matching) -> Iterator[tuple[range, range]]:
    """Rows one below the other in both texts, of which one cell is whole in the one text and cut in the other."""
    for first, last, start, end in matching.gaps():
        lines = {matching.old.line_of[word] for word in range(first, last)}
        backs = {matching.back[matching.new.of_line(matching.new.line_of[word]).start] for word in range(start, end)}
        lines |= {matching.old.line_of[word] for word in backs if word >= 0}
        for line in {line - step for line in lines for step in range(_TOGETHER)}:
            words = matching.old.of_line(line)
            if words and matching.there[words.start] >= 0:
                now = matching.new.line_of[matching.there[words.start]]
                yield from _cut_rows(matching, line, now)


def _cut_rows(matching: Matching, line: int, now: int) -> Iterator[tuple[range, range]]:
    """The fewest rows from these lines on that are so."""
    was, has = _cells(matching.old, line), _cells(matching.new, now)
    most = min(len(was), len(has))
    counts = (count for count in range(2, most + 1) if _are_cut(was[:count], has[:count]))
    yield from ((range(line, line + count), range(now, now + count)) for count in islice(counts, 1))


def _are_cut(was: list[list[str]], now: list[list[str]]) -> bool:
    """Whether rows with the same first cells differ only in a cell that is whole in the uppermost in one text."""
    if len({len(cells) for cells in (*was, *now)}) != 1 or not all(cells[0] for cells in was):
        return False
    both = list(zip(zip(*was, strict=True), zip(*now, strict=True), strict=True))
    others = [(old, new) for old, new in both if old != new]
    return bool(others) and all(_is_cut(old, new) or _is_cut(new, old) for old, new in others)


def _is_cut(whole: tuple[str, ...], parts: tuple[str, ...]) -> bool:
    """Whether a cell above empty ones is cut into parts, which are text: numbers and codes are those of their rows."""
    texts = [part for part in parts if part]
    return "".join(parts) == whole[0] and len(texts) > 1 and bool(parts[0]) and all(map(_TEXT.search, texts))


def _cells(text: Words, line: int) -> list[list[str]]:
    """The cells of some rows with lines between their columns, from a line on, each as its words say it."""
    rows = takewhile(lambda row: row.startswith("|"), (text.line(line + step) for step in range(_TOGETHER)))
    return [[pressed(Words(cell).texts) for cell in row.strip().strip("|").split("|")] for row in rows]


def _head(text: Words, line: int) -> int:
    """The first word of the row that has a line."""
    first = line
    while first > max(1, line - _LONGEST) and _CONTINUES.match(text.line(first)):
        first -= 1
    words = text.of_line(first) or text.of_line(line)
    return words.start


def _row(text: Words, line: int) -> range:
    """The lines of a row: those below that have nothing in the first cell go on with it."""
    last = line
    while last - line < _LONGEST and _CONTINUES.match(text.line(last + 1)):
        last += 1
    return range(line, last + 1)


def _by_cells(text: Words, lines: range) -> list[int]:
    """The words of a row, cell by cell."""
    gap = "|" if text.line(lines[0]).startswith("|") else "\t"
    words = [word for line in lines for word in text.of_line(line)]
    return sorted(words, key=lambda word: text.line(text.line_of[word]).count(gap, 0, text.column_of[word] - 1))
