"""Which pieces of one text are which of another: what stands in the same order, then what moved.

Rows that occur once in both texts hold the rest together; between them short stretches are compared piece by piece.
The cost grows with the texts, not with their product.
"""

from __future__ import annotations

from bisect import bisect_left
from collections import Counter
from difflib import SequenceMatcher
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

_SMALL = 60_000
"""A gap is compared piece by piece if it has at most so many pairs."""
_MOVED = 3
"""A line that moved alone has at least so many pieces."""
_LONG_MOVE = 40
"""So many pieces may move without being whole lines."""

Gap = tuple[int, int, int, int]
"""The pieces from..to of the one text and from..to of the other, the ends not included."""


class Pieces:
    """A text in pieces: on which line each stands (`line_of`)."""

    def __init__(self) -> None:
        self.line_of: list[int] = []
        self._first: list[int] = [0]

    def _end_line(self) -> None:
        """All pieces so far stand on the lines so far."""
        self._first.append(len(self.line_of))

    def __len__(self) -> int:
        return len(self.line_of)

    def of_line(self, line: int) -> range:
        """The pieces of a line counted from 1; none outside the text."""
        if not 1 <= line < len(self._first):
            return range(len(self), len(self))
        return range(self._first[line - 1], self._first[line])

    def opens_line(self, piece: int) -> bool:
        """Whether a piece is the first of its line; what stands behind the last piece is."""
        return piece >= len(self) or piece == 0 or self.line_of[piece] != self.line_of[piece - 1]

    def up_to_end(self, piece: int, step: int) -> range:
        """The pieces of its line from a piece on, forwards or (-1) backwards."""
        line = self.of_line(self.line_of[piece])
        return range(piece, line.stop if step > 0 else line.start - 1, step)


class Alignment:
    """`there[i]` is the piece of the new text that piece i of the old one is, -1 if none; `back` is that turned round.

    `moved` holds the pieces of the old text that stand in another order in the new one.
    """

    def __init__(self, old: Pieces, new: Pieces, olds: Sequence[str], news: Sequence[str]) -> None:
        """Nothing is aligned yet; `olds` and `news` are what the pieces are."""
        numbers: dict[str, int] = {}
        self._a = [numbers.setdefault(text, len(numbers)) for text in olds]
        self._b = [numbers.setdefault(text, len(numbers)) for text in news]
        self._lines = old, new
        self.there = [-1] * len(old)
        self.back = [-1] * len(new)
        self.moved: set[int] = set()

    def align(self, lengths: tuple[int, ...]) -> None:
        """Align the texts by rows of so many pieces, the longest first, and the last ones piece by piece."""
        self._match_in_order([(0, len(self.there), 0, len(self.back))], lengths[:2])
        self._match_moved(lengths[:1])
        self._match_in_order(list(self.gaps()), lengths)
        self._match_moved(lengths[1:3])
        self._straighten(1)
        self._straighten(-1)
        self._mend_torn_lines(1)
        self._mend_torn_lines(-1)

    def gaps(self) -> Iterator[Gap]:
        """What has no counterpart, as pairs that stand between the same neighbours; a side of a pair may be empty."""
        come = dict(runs(self.back))
        starts = {end: start for start, end in come.items()}
        for first, last in runs(self.there):
            start = self._place_of(first, last, come, starts)
            yield first, last, start, come.pop(start, start)
        for start, end in come.items():
            first = self.back[start - 1] + 1 if start else 0
            yield first, first, start, end

    def _place_of(self, first: int, last: int, come: dict[int, int], starts: dict[int, int]) -> int:
        """Where in the new text something came in the place of pieces of the old one; else where it would stand.

        One of the neighbours may stand elsewhere: then the other one tells, if it is of the same line.
        """
        old, new = self._lines
        start = self.there[first - 1] + 1 if first else 0
        while first and start < len(self.back) and self.back[start] == first - 1:
            start += 1  # one word may be several now
        end = self.there[last] if last < len(self.there) else len(self.back)
        is_behind = not old.opens_line(first) and not new.opens_line(start)
        if start in come and (come[start] == end or is_behind):
            return start
        is_before = not old.opens_line(last) and not new.opens_line(end)
        return starts[end] if is_before and starts.get(end) in come else start

    def match(self, at: int, there: int, count: int = 1) -> None:
        """Take so many pieces of the old text, from one on, for those of the new one."""
        for step in range(count):
            self.there[at + step], self.back[there + step] = there + step, at + step

    def forget(self, pieces: Sequence[int]) -> None:
        """Let pieces of the old text have no counterpart."""
        for piece in pieces:
            if self.there[piece] >= 0:
                self.back[self.there[piece]] = -1
            self.there[piece] = -1
        self.moved.difference_update(pieces)

    def forget_new(self, pieces: Sequence[int]) -> None:
        """Let pieces of the new text have none."""
        for there in (self.back[piece] for piece in pieces if self.back[piece] >= 0):
            self.forget(range(there, there + 1))

    def _match_in_order(self, waiting: list[Gap], lengths: tuple[int, ...]) -> None:
        whole = lengths[-1] == 1
        while waiting:
            first, last, start, end = self._without_equal_ends(waiting.pop())
            if first == last or start == end:
                continue
            if whole and (last - first) * (end - start) <= _SMALL:
                self._match_one_by_one(first, last, start, end)
                continue
            for length in lengths:
                olds, news = range(first, last - length + 1), range(start, end - length + 1)
                if pairs := _rising(self._rare_in_both(olds, news, length)):
                    waiting += self._between(pairs, (first, last, start, end))
                    break

    def _between(self, pairs: list[tuple[int, int]], gap: Gap) -> Iterator[Gap]:
        """Match these pairs; the gaps around them."""
        first, last, start, end = gap
        for pair in (*pairs, (last, end)):
            yield first, pair[0], start, pair[1]
            if pair != (last, end):
                self.match(*pair)
            first, start = pair[0] + 1, pair[1] + 1

    def _without_equal_ends(self, gap: Gap) -> Gap:
        first, last, start, end = gap
        while first < last and start < end and self._a[first] == self._b[start]:
            self.match(first, start)
            first, start = first + 1, start + 1
        while first < last and start < end and self._a[last - 1] == self._b[end - 1]:
            last, end = last - 1, end - 1
            self.match(last, end)
        return first, last, start, end

    def _match_one_by_one(self, first: int, last: int, start: int, end: int) -> None:
        blocks = SequenceMatcher(None, self._a[first:last], self._b[start:end], autojunk=False).get_matching_blocks()
        for at, there, count in blocks:
            self.match(first + at, start + there, count)

    def _rare_in_both(self, olds: Sequence[int], news: Sequence[int], length: int) -> list[tuple[int, int]]:
        """Where the same row of pieces occurs once on each side, in the order of the old text."""
        there = _once(self._b, news, length)
        return sorted((at, there[key]) for key, at in _once(self._a, olds, length).items() if key in there)

    def _match_moved(self, lengths: tuple[int, ...]) -> None:
        """Whole lines, or long stretches, that stand elsewhere."""
        for length in lengths:
            free = _starts(self.there, length), _starts(self.back, length)
            for at, there in self._rare_in_both(*free, length):
                if self.fits(at, there):
                    self._match_run(at, there)

    def _run_around(self, at: int, there: int) -> tuple[int, int, int]:
        """The pieces from..to that are alike around two that are, and how far away their counterparts are."""
        first, start = at, there
        while first and start and self.fits(first - 1, start - 1):
            first, start = first - 1, start - 1
        last, end = at, there
        while last < len(self.there) and end < len(self.back) and self.fits(last, end):
            last, end = last + 1, end + 1
        return first, last, start - first

    def _match_run(self, at: int, there: int) -> None:
        first, last, shift = self._run_around(at, there)
        if last - first < _LONG_MOVE:
            first, last = self._whole_lines(first, last, shift)
        if last - first >= _MOVED and self._may_move(first, last, shift):
            self.match(first, first + shift, last - first)
            self.moved.update(range(first, last))

    def _may_move(self, first: int, last: int, shift: int) -> bool:
        """Whether these pieces may have gone so far away."""
        return True

    def _whole_lines(self, first: int, last: int, shift: int) -> tuple[int, int]:
        """The part of a run that is whole lines of both texts."""
        old, new = self._lines
        while first < last and not (old.opens_line(first) and new.opens_line(first + shift)):
            first += 1
        while first < last and not self._end_lines(last, last + shift):
            last -= 1
        return first, last

    def _end_lines(self, at: int, there: int) -> bool:
        """Whether lines of both texts end before these pieces."""
        old, new = self._lines
        return old.opens_line(at) and new.opens_line(there)

    def fits(self, at: int, there: int) -> bool:
        """Whether two pieces are alike and have no counterpart."""
        return self.there[at] < 0 and self.back[there] < 0 and self._a[at] == self._b[there]

    def _straighten(self, step: int) -> None:
        """Where text moved, a piece beside it may have got the counterpart of another: give each its own."""
        for first, last in list(runs(self.there)):
            for at in range(first, last) if step > 0 else range(last - 1, first - 1, -1):
                there = self.beside(at, step)
                if there is None or self._a[at] != self._b[there]:
                    break
                other = self.back[there]
                own = None if other < 0 else self.beside(other, step)
                if own is None or self.back[own] >= 0 or self._a[at] != self._b[own]:
                    break
                self.match(other, own)
                self.match(at, there)
                self.moved.update({at, other} if {at - step, other - step} & self.moved else ())

    def _mend_torn_lines(self, step: int) -> None:
        """The first (or last) pieces of lines that moved may be those of each other: `4.2.` of headings."""
        old, new = self._lines
        for beside in range(max(0, step), len(self.there) + min(0, step)):
            at, there = beside - step, self.there[beside] - step
            if self.there[beside] < 0 or self.there[at] in (-1, there) or not 0 <= there < len(self.back):
                continue
            olds, news = old.up_to_end(at, -step), new.up_to_end(there, -step)
            same = [self._a[piece] for piece in olds] == [self._b[piece] for piece in news]
            if same and old.line_of[at] == old.line_of[beside] and self._may_be_torn(beside, news):
                self._exchange(olds, news, step)

    def _may_be_torn(self, beside: int, news: range) -> bool:
        """Whether the first (or last) pieces of a line may be those of another one, and not exchanged with those."""
        return True

    def _exchange(self, olds: range, news: range, step: int) -> None:
        """Take pieces for these, and those that had them for theirs."""
        for at, there in zip(olds, news, strict=True):
            other, left = self.back[there], self.there[at]
            self.match(at, there)
            if other >= 0 and left >= 0:
                self.match(other, left)
            elif other >= 0:
                self.there[other] = -1
            elif left >= 0:
                self.back[left] = -1
            for piece in (at, other) if other >= 0 else (at,):
                (self.moved.add if piece + step in self.moved else self.moved.discard)(piece)

    def beside(self, at: int, step: int) -> int | None:
        """The piece of the new text behind (or before) the counterpart of the one before (or behind) a piece."""
        beside = at - step
        there = self.there[beside] + step if 0 <= beside < len(self.there) and self.there[beside] >= 0 else -1
        return there if 0 <= there < len(self.back) else None


def runs(matched: list[int]) -> Iterator[tuple[int, int]]:
    """The stretches from..to without a counterpart."""
    start = None
    for place, other in enumerate(matched):
        if other < 0 and start is None:
            start = place
        elif other >= 0 and start is not None:
            yield start, place
            start = None
    if start is not None:
        yield start, len(matched)


def _starts(matched: list[int], length: int) -> list[int]:
    """Where so many pieces in a row begin that have no counterpart."""
    return [start for first, last in runs(matched) for start in range(first, last - length + 1)]


def _once(pieces: list[int], places: Sequence[int], length: int) -> dict[tuple[int, ...], int]:
    """The rows of pieces that begin at one of the places only, with that place."""
    keys = {place: tuple(pieces[place : place + length]) for place in places}
    count = Counter(keys.values())
    return {key: place for place, key in keys.items() if count[key] == 1}


def _rising(pairs: list[tuple[int, int]]) -> list[tuple[int, int]]:
    """The longest series of pairs that rises in both numbers; the first numbers of `pairs` rise."""
    ends: list[int] = []
    tops: list[int] = []
    before: list[int] = []
    for place, (_, there) in enumerate(pairs):
        at = bisect_left(ends, there)
        before.append(tops[at - 1] if at else -1)
        ends[at : at + 1], tops[at : at + 1] = [there], [place]
    series = []
    place = tops[-1] if tops else -1
    while place >= 0:
        series.append(pairs[place])
        place = before[place]
    return series[::-1]
