"""Rows of a table whose cells are set over several lines, side by side: which words of the text belong to which row.

Extractions that keep the look of a page write such a row line by line, so that words of all its cells lie mixed.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from difflib import SequenceMatcher
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Container, Iterator, Sequence

    from fieldscribe.audit.layout.alignment import Alignment
    from fieldscribe.audit.layout.fingerprint import Fingerprint, Text

_FEWEST_CELLS = 2
"""So many cells, tabs or bars stand before the last one of a row."""
_OPENING, _MOST_ALIKE = 2, 100
"""Rows are looked up by so many words: a code and a number; where so many lines begin so, they tell nothing."""
_MOST_PAIRS = 60_000
"""Rows of more words are not compared word by word."""
_MOST_LINES, _MOST_ROWS = 40, 12
"""A row is set over at most so many lines, and shares a cell with at most so many."""
_SEGMENT = re.compile(r"\S(?:.*?\S)??(?=\s{2}|$)")
"""What stands in one column of a line: two blanks part it from the next."""


def unstack(alignment: Alignment, old: Fingerprint, new: Text, pages: Container[int]) -> Iterator[list[int]]:
    """Align each row of the old text with the lines of the new one that have it, read column by column.

    Yields all pieces of those lines as they are read so. `pages` are lines of the new text to be passed over.
    """
    starts = _starts(alignment, old, new)
    for line, (first, end) in _rows(alignment, old, starts, shared=False):
        inside = _by_columns(new, first, end, pages)
        pieces = old.of_line(line)
        free = [piece for piece in inside if alignment.back[piece] < 0 or alignment.back[piece] in pieces]
        pairs = _pairs(old, pieces, new, free, least=1)
        if len(pairs) > sum(alignment.there[piece] >= 0 for piece in pieces):
            alignment.forget(pieces)
            _match(alignment, pairs)
        yield inside
    for line, (first, end) in _rows(alignment, old, starts, shared=True):
        inside = _by_columns(new, first, end, pages)
        lacking = [piece for piece in old.of_line(line) if alignment.there[piece] < 0]
        _match(alignment, _pairs(old, lacking, new, [piece for piece in inside if alignment.back[piece] < 0], least=2))


def _by_columns(new: Text, first: int, end: int, pages: Container[int]) -> list[int]:
    """The pieces of some lines, column by column."""
    lines = [number for number in range(first, end) if number not in pages]
    column_of = _columns(new, lines)
    return [piece for _, piece in sorted((column_of(piece), piece) for line in lines for piece in new.of_line(line))]


def _pairs(
    old: Fingerprint, olds: Sequence[int], new: Text, news: Sequence[int], *, least: int
) -> list[tuple[int, int]]:
    """Which pieces are which, in order, at least so many side by side."""
    if len(olds) * len(news) > _MOST_PAIRS:
        return []
    signs = [old.signs[piece] for piece in olds], [new.signs[piece] for piece in news]
    blocks = SequenceMatcher(None, *signs, autojunk=False).get_matching_blocks()
    return [
        (olds[at + step], news[there + step])
        for at, there, count in blocks
        for step in range(count if count >= least else 0)
    ]


def _match(alignment: Alignment, pairs: list[tuple[int, int]]) -> None:
    for at, there in pairs:
        alignment.match(at, there)


def _rows(
    alignment: Alignment, old: Fingerprint, starts: dict[int, int], *, shared: bool
) -> Iterator[tuple[int, tuple[int, int]]]:
    """Rows that lack words, with the lines of the new text from..to where they begin, and the next row does.

    `shared`: up to the row that has something in a cell that lacks words, if that is not the next one: a cell that
    rows share goes on beside those below.
    """
    lines = sorted(starts)
    for number, line in enumerate(lines[:-1]):
        pieces = old.of_line(line)
        cells = _cells(old, pieces)
        lacking = {cell for piece, cell in zip(pieces, cells, strict=True) if alignment.there[piece] < 0}
        if not lacking or cells[-1] < _FEWEST_CELLS:
            continue
        below = number + 1
        free = lacking.difference(_cells(old, old.of_line(lines[below])))
        while shared and free and below < min(number + _MOST_ROWS, len(lines) - 1):
            if not free.isdisjoint(_cells(old, old.of_line(lines[below]))):
                break
            below += 1
        first, end = starts[line], starts[lines[below]]
        if below - number > shared and 1 <= end - first <= _MOST_LINES:
            yield line, (first, end)


def _starts(alignment: Alignment, old: Fingerprint, new: Text) -> dict[int, int]:
    """The line of the new text on which each line of the old one begins: by its first word, or else its first cell."""
    starts: dict[int, int] = {}
    opening: dict[str, list[int]] = {}
    for number in range(1, len(new.ends) + 1):
        opening.setdefault("".join(new.signs[piece] for piece in new.of_line(number)[:_OPENING]), []).append(number)
    for line in range(1, len(old.ends) + 1):
        pieces = old.of_line(line)
        there = alignment.there[pieces.start] if pieces else -1
        if there >= 0:
            starts[line] = new.line_of[there]
        elif pieces and _cells(old, pieces)[-1] >= _FEWEST_CELLS:
            signs = _first_cell(old, pieces)
            alike = opening.get("".join(signs[:_OPENING]), [])
            begin = [number for number in alike[:_MOST_ALIKE] if _begins(new, number, signs)]
            rest = [new.line_of[alignment.there[piece]] for piece in pieces if alignment.there[piece] >= 0]
            if len(begin) == 1 and begin[0] <= min(rest, default=begin[0]):
                starts[line] = begin[0]
    return starts


def _cells(old: Fingerprint, pieces: range) -> list[int]:
    """The cell in which each piece of a line stands, from 0."""
    cells, cell = [], 0
    for piece in pieces:
        cell += old.gaps[piece].count("|") + old.gaps[piece].count("\t")
        cells.append(cell)
    return cells


def _first_cell(old: Fingerprint, pieces: range) -> list[str]:
    """The signs of a row's first cell, and of the first word behind it."""
    end = next((piece for piece in pieces[1:] if {"|", "\t"} & set(old.gaps[piece])), pieces.stop)
    return old.signs[pieces.start : end + 1]


def _begins(new: Text, line: int, signs: list[str]) -> bool:
    """Whether a line begins with these words, the last of which stands in a column of its own."""
    pieces = new.of_line(line)
    last = pieces.start + len(signs) - 1
    return last < pieces.stop and new.gaps[last] not in ("", " ") and new.signs[pieces.start : last + 1] == signs


def _columns(new: Text, lines: Sequence[int]) -> Callable[[int], int]:
    """In which column of these lines a piece stands: by cells, or else what overlaps, seen from above, is one."""
    texts = [new.written[line - 1] for line in lines]
    gap = next((gap for gap in "|\t" if any(gap in text for text in texts)), None)
    if gap is not None:
        return lambda piece: new.written[new.line_of[piece] - 1].count(gap, 0, new.columns[piece] - 1)
    spans = sorted(match.span() for text in texts for match in _SEGMENT.finditer(text))
    columns: list[list[int]] = []
    for start, stop in spans:
        if columns and start < columns[-1][1]:
            columns[-1][1] = max(columns[-1][1], stop)
        else:
            columns.append([start, stop])
    starts = [start for start, _ in columns]
    return lambda piece: bisect_right(starts, new.columns[piece] - 1)
