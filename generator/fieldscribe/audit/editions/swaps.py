"""Lines that changed places with each other between lines that stayed: labels of other numbers now.

A row that moved with its number says what it said. What has no number of its own (a second line of a row, a label on a
line by itself) means the number above it: where two such lines are exchanged, each is the changed line of its place.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.audit.editions.matching import Matching
    from fieldscribe.audit.editions.words import Words

    Window = tuple[list[int], list[int]]
    """As many lines of the old text and of the new one, in order."""

_FAR = 6
"""So many lines stay between two that are exchanged, at most."""
_OWN_NUMBER = re.compile(r"\|?\s*\W{0,2}(\w*[0-9]\w*)\b")


def exchanged(matching: Matching) -> Iterator[Window]:
    """Where lines were exchanged."""
    olds, news = _lines(matching.old), _lines(matching.new)
    come = list(_runs(news, {line for line in news if _is_free_new(matching, line)}))
    by_words = {_key(matching.new, [news[place] for place in run]): run for run in come}
    for run in _runs(olds, {line for line in olds if _is_free_old(matching, line)}):
        other = by_words.get(_key(matching.old, [olds[place] for place in run]))
        window = other and _window(matching, olds, news, run, other)
        if window and _is_exchange(matching, *window):
            yield window


def _window(matching: Matching, olds: list[int], news: list[int], run: range, other: range) -> Window | None:
    """The lines from what went to what came, which are as many in both texts."""
    above = matching.there[matching.old.of_line(olds[run.start - 1]).start] if run.start else -1
    first = other.start if above < 0 else news.index(matching.new.line_of[above]) + 1
    if first <= other.start:  # it came further down
        stayed = other.start - first
        here, there = range(run.start, run.stop + stayed), range(first, other.stop)
    else:
        stayed = first - other.stop
        here, there = range(run.start - stayed, run.stop), range(other.start, first)
    if not 0 < stayed <= _FAR or here.start < 0 or here.stop > len(olds) or there.stop > len(news):
        return None
    return [olds[place] for place in here], [news[place] for place in there]


def _is_exchange(matching: Matching, olds: list[int], news: list[int]) -> bool:
    """Whether the lines with a number of their own stand where they stood, and others do not."""
    was = [_texts(matching.old, line) for line in olds]
    now = [_texts(matching.new, line) for line in news]
    if len(was) != len(now) or sorted(was) != sorted(now):
        return False
    numbered = [_has_own_number(matching.old, line) for line in olds]
    stays = [before == after for before, after in zip(was, now, strict=True)]
    kinds = set(zip(stays, numbered, strict=True))
    return (True, True) in kinds and (False, True) not in kinds


def _has_own_number(text: Words, line: int) -> bool:
    return not text.continues(line) and _OWN_NUMBER.match(text.line(line)) is not None


def exchanged_cells(matching: Matching) -> Iterator[range]:
    """The cell that stayed where two neighbours in a row changed places: the other seems to have gone and come."""
    old, new = matching.old, matching.new
    come = {
        (new.line_of[start], *new.texts[start:end]): (start, end) for _, _, start, end in matching.gaps() if start < end
    }
    for first, last, *_ in matching.gaps():
        for stayed in _cells_beside(old, first, last):
            there = new.line_of[matching.there[stayed.start]]
            start, end = come.get((there, *old.texts[first:last]), (0, 0))
            beside = range(end, end + len(stayed)) if stayed.stop == first else range(start - len(stayed), start)
            if start < end and [matching.there[word] for word in stayed] == list(beside):
                yield stayed


def _cells_beside(text: Words, first: int, last: int) -> Iterator[range]:
    """The cells before and behind words that are a cell."""
    if first == last or not _is_cell(text, first, last):
        return
    words = text.of_line(text.line_of[first])
    parts = [word for word in words if text.opens_line(word) or text.opens_cell(word)]
    if last in words:
        yield range(last, next((word for word in parts if word > last), words.stop))
    if first > words.start:
        yield range(max(word for word in parts if word < first), first)


def _is_cell(text: Words, first: int, last: int) -> bool:
    parts = [word for word in range(first, last + 1) if text.opens_line(word) or text.opens_cell(word)]
    return parts == [first, last]


def _is_free_old(matching: Matching, line: int) -> bool:
    return all(matching.there[word] < 0 or word in matching.moved for word in matching.old.of_line(line))


def _is_free_new(matching: Matching, line: int) -> bool:
    return all(matching.back[word] < 0 or matching.back[word] in matching.moved for word in matching.new.of_line(line))


def _lines(text: Words) -> list[int]:
    """The lines that have words."""
    return [line for line in range(1, len(text.lines) + 1) if text.of_line(line)]


def _runs(lines: list[int], free: set[int]) -> Iterator[range]:
    """The stretches of `lines`, by place, that are free."""
    start = None
    for place, line in enumerate([*lines, 0]):
        if line in free and start is None:
            start = place
        elif line not in free and start is not None:
            yield range(start, place)
            start = None


def _key(text: Words, lines: list[int]) -> tuple[tuple[str, ...], ...]:
    return tuple(sorted(_texts(text, line) for line in lines))


def _texts(text: Words, line: int) -> tuple[str, ...]:
    words = text.of_line(line)
    return tuple(text.texts[words.start : words.stop])
