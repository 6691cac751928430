"""Words without a counterpart, parted: what a line lost or got, and the lines that went or came whole, row by row."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.audit.editions.matching import Gap
    from fieldscribe.audit.editions.words import Words

_COLUMNS = re.compile(r"\S(?: {3,}|\t)\S")
_ENTRY = re.compile(r"\s*\W?\w*[0-9]\w*\S*(?:\s\S+){0,5}\s*")
_UNLIKE = 3
"""Two rows that share fewer than one word of so many are not the same row."""


class _Side(NamedTuple):
    """The words first..head end a line that began before them, tail..last begin one, those between are whole lines."""

    first: int
    head: int
    tail: int
    last: int

    @property
    def has_ends(self) -> bool:
        return self.first < self.head or self.tail < self.last

    @property
    def has_lines(self) -> bool:
        return self.head < self.tail


def parted(old: Words, new: Words, gap: Gap) -> Iterator[Gap]:
    """The pieces of a gap that say something by themselves."""
    first, last, start, end = gap
    was, now = _side(old, first, last), _side(new, start, end)
    if came := _apart(new, now, was):
        yield from _around((first, last), now, came)
    elif went := _apart(old, was, now):
        for here, there, *row in _around((start, end), was, went):
            yield row[0], row[1], here, there
    elif _are_whole_rows(old, was) and _are_whole_rows(new, now):
        yield from ((*row, start, start) for row in _whole_lines(old, was))
        yield from ((last, last, *row) for row in _whole_lines(new, now))
    else:
        yield from _cell_by_cell(old, new, gap)


def _cell_by_cell(old: Words, new: Words, gap: Gap) -> Iterator[Gap]:
    """Words of a row in place of others, each cell by itself."""
    first, last, start, end = gap
    olds, news = _cells(old, first, last), _cells(new, start, end)
    if len(olds) != len(news):
        olds, news = [(first, last)], [(start, end)]
    yield from ((*here, *there) for here, there in zip(olds, news, strict=True))


def _cells(text: Words, first: int, last: int) -> list[tuple[int, int]]:
    """The words of each cell in one line; all of them where they are of several."""
    one_line = first < last and text.is_in_one_line(first, last)
    opening = [word for word in range(first + 1, last) if one_line and text.opens_cell(word)]
    return list(zip([first, *opening], [*opening, last], strict=True))


def _apart(text: Words, side: _Side, other: _Side) -> list[tuple[int, int]]:
    """The whole lines of a side that say something by themselves, where the other side has no more than their ends."""
    if other.has_lines or (other.first < other.last and not side.has_ends and not _opens_entry(text, side)):
        return []
    return _whole_lines(text, side)


def _opens_entry(text: Words, side: _Side) -> bool:
    """Whether the first of some whole lines has a number of its own, and goes on with few words."""
    return side.has_lines and _ENTRY.fullmatch(text.line(text.line_of[side.head])) is not None


def _around(beside: tuple[int, int], side: _Side, rows: list[tuple[int, int]]) -> Iterator[Gap]:
    """Whole lines as gaps of their own; the words `beside` them belong to what ends the line above, or begins one."""
    first, last = beside
    at = last if side.first < side.head or side.tail == side.last else first
    gaps = [(first, at, side.first, side.head), *((at, at, *row) for row in rows), (at, last, side.tail, side.last)]
    yield from (gap for gap in gaps if gap[0] < gap[1] or gap[2] < gap[3])


def are_unlike(old: str, new: str, words: tuple[list[str], list[str]], shared: int) -> bool:
    """Whether two rows that share so many names and numbers have nothing to do with each other."""
    fewest = min(map(len, words))
    if fewest < _UNLIKE or words[0][0] == words[1][0] or shared * _UNLIKE >= fewest:
        return False
    return is_row(old) and is_row(new)


def is_row(line: str) -> bool:
    """Whether a line is the row of a table, with lines, tabs or blanks between its columns."""
    return line.startswith("|") or _COLUMNS.search(line) is not None


def _side(text: Words, first: int, last: int) -> _Side:
    head, tail = first, last
    while head < last and not text.opens_line(head):
        head += 1
    while tail > head and not text.opens_line(tail):
        tail -= 1
    return _Side(first, head, tail, last)


def _whole_lines(text: Words, side: _Side) -> list[tuple[int, int]]:
    """The words of each row among the whole lines of one side, or of all of them; none if a sentence goes on there."""
    if not side.has_lines:
        return []
    line = text.line_of[side.head]
    if side.has_ends and not (_is_apart(text, line) or _are_rows(text, side)):
        return []
    rows = list(_rows_below(text, line, side.tail)) if is_row(text.line(line - 1)) else []
    starts = [side.head, *(row for row in rows if row > side.head)]
    return list(zip(starts, [*starts[1:], side.tail], strict=True))


def _rows_below(text: Words, line: int, tail: int) -> Iterator[int]:
    """The first words of the rows from a line on, and of what stands behind them."""
    while (word := text.of_line(line).start) < tail and is_row(text.line(line)):
        if text.of_line(line) and not text.continues(line):
            yield word
        line += 1
    if word < tail:
        yield word


def _are_whole_rows(text: Words, side: _Side) -> bool:
    return side.has_lines and not side.has_ends and _are_rows(text, side)


def _are_rows(text: Words, side: _Side) -> bool:
    return all(is_row(text.line(line)) for line in {text.line_of[word] for word in range(side.head, side.tail)})


def _is_apart(text: Words, line: int) -> bool:
    """Whether a line opens something: a heading, or what stands behind an empty line."""
    return text.line(line).startswith("#") or not text.line(line - 1).strip()
