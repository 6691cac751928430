"""Rows whose cells are broken over other lines: read cell by cell, their words stand in the order that they had.

A cell that belongs to two rows may be one or be cut between them: then the cells below the whole one are empty.
"""

from __future__ import annotations

import re
from difflib import SequenceMatcher
from itertools import takewhile
from typing import TYPE_CHECKING

from fieldscribe.audit.editions.words import Words, pressed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.audit.editions.matching import Matching

    Pairs = list[tuple[int, int]]

_TEXT = re.compile(r"[^\W\d_]{2}")
_TOGETHER = 4
"""A cell belongs to at most so many rows."""
_LONGEST = 12
"""A row is broken over at most so many lines."""


def broken_otherwise(matching: Matching) -> Iterator[tuple[list[int], list[int], Pairs]]:
    """The words of rows that are the same cell by cell, and only so, with which of them are which."""
    for old, new in dict.fromkeys(_pairs(matching)):
        if len(old) == len(new) == 1:
            continue
        here, there = _by_cells(matching.old, old), _by_cells(matching.new, new)
        if pairs := list(_same(matching, here, there)):
            yield here, there, pairs


def cut_otherwise(matching: Matching) -> Iterator[tuple[list[int], list[int], Pairs]]:
    """The same for rows with a cell that is whole above empty ones in one text, and cut between them in the other."""
    done: set[int] = set()
    for line, now in dict.fromkeys(_heads(matching)):
        was, has = _cells(matching.old, line), _cells(matching.new, now)
        counts = dict(_cut_columns(was, has))
        rows = max(counts.values(), default=0)
        if not rows or line in done:
            continue
        done.update(range(line, line + rows))
        pairs: Pairs = []
        for column in range(len(was[0])):
            step = counts.get(column, 1)
            for row in range(0, rows, step):
                here = _of_column(matching.old, range(line + row, line + row + step), column)
                there = _of_column(matching.new, range(now + row, now + row + step), column)
                pairs += _alike(matching, here, there)
        yield _of_rows(matching.old, line, rows), _of_rows(matching.new, now, rows), pairs


def _alike(matching: Matching, here: list[int], there: list[int]) -> Iterator[tuple[int, int]]:
    """The equal words of two series, in order."""
    texts = [matching.old.texts[word] for word in here], [matching.new.texts[word] for word in there]
    for at, to, count in SequenceMatcher(None, *texts, autojunk=False).get_matching_blocks():
        yield from zip(here[at : at + count], there[to : to + count], strict=True)


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


def _heads(matching: Matching) -> Iterator[tuple[int, int]]:
    """Rows of the old text at or just above words that lack a counterpart, each with the row that begins so now."""
    for first, last, start, end in matching.gaps():
        lines = {matching.old.line_of[word] for word in range(first, last)}
        backs = {matching.back[matching.new.of_line(matching.new.line_of[word]).start] for word in range(start, end)}
        lines |= {matching.old.line_of[word] for word in backs if word >= 0}
        for line in sorted({line - step for line in lines for step in range(_TOGETHER)}):
            words = matching.old.of_line(line)
            if words and matching.there[words.start] >= 0:
                yield line, matching.new.line_of[matching.there[words.start]]


def _cut_columns(was: list[list[str]], now: list[list[str]]) -> Iterator[tuple[int, int]]:
    """The columns of a table that have such a cell in its first row here, each with the number of the cell's rows."""
    if not was or not now or len({len(cells) for cells in (*was, *now)}) != 1:
        return
    heads = takewhile(lambda row: row[0][0] and row[0][0] == row[1][0], zip(was, now, strict=False))
    most = len(list(heads))
    for column in range(1, len(was[0])):
        old, new = ([cells[column] for cells in rows[:most]] for rows in (was, now))
        count = max(_rows_of(old, new), _rows_of(new, old)) if old and new else 0
        if count > 1:
            yield column, count


def _rows_of(whole: list[str], parts: list[str]) -> int:
    """Over how many rows a cell above empty ones is cut into parts of text: numbers and codes are those of their rows.

    The first part begins as the whole does.
    """
    empty = len(list(takewhile(lambda cell: not cell, whole[1:])))
    cut = len(list(takewhile(_TEXT.search, parts[: 1 + empty])))
    return cut if cut > 1 and whole[0].startswith(parts[0]) else 0


def _of_rows(text: Words, line: int, rows: int) -> list[int]:
    return [word for number in range(line, line + rows) for word in text.of_line(number)]


def _of_column(text: Words, lines: range, column: int) -> list[int]:
    """The words in a column of some rows."""
    words = _of_rows(text, lines.start, len(lines))
    return [word for word in words if _bars_before(text, word) == column + 1]


def _bars_before(text: Words, word: int) -> int:
    return text.line(text.line_of[word]).count("|", 0, text.column_of[word])


def _cells(text: Words, line: int) -> list[list[str]]:
    """The cells of some rows with lines between their columns, from a line on, each as its words say it."""
    rows = takewhile(lambda row: row.startswith("|"), (text.line(line + step) for step in range(_TOGETHER)))
    return [[pressed(Words(cell).texts) for cell in row.strip().strip("|").split("|")] for row in rows]


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
