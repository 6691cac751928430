"""Which words of one text are which of another: what stands in the same order, then what moved.

Rows and sentences that occur once in both texts hold the rest together; between them short stretches are compared word
by word. The cost grows with the texts, not with their product.
"""

from __future__ import annotations

from bisect import bisect_left
from collections import Counter
from difflib import SequenceMatcher
from typing import TYPE_CHECKING

from fieldscribe.audit.editions.rows import broken_otherwise, cut_otherwise
from fieldscribe.audit.editions.swaps import exchanged, exchanged_cells

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from fieldscribe.audit.editions.words import Words

_LENGTHS = (8, 4, 2, 1)
"""So many words in a row tell a place if they occur once; shorter rows are tried where longer ones lack."""
_SMALL = 60_000
"""A gap is compared word by word if it has at most so many pairs of words."""
_MOVED = 3
"""A line that moved alone has at least so many words."""
_LONG_MOVE = 40
"""So many words may move without being whole lines."""

Gap = tuple[int, int, int, int]
"""The words from..to of the one text and from..to of the other, the ends not included."""


class Matching:
    """`there[i]` is the word of the new text that word i of the old one is, -1 if none; `back` is that turned round.

    `moved` holds the words of the old text that stand in another order in the new one.
    """

    def __init__(self, old: Words, new: Words) -> None:
        self.old, self.new = old, new
        numbers: dict[str, int] = {}
        self._a = [numbers.setdefault(text, len(numbers)) for text in old.texts]
        self._b = [numbers.setdefault(text, len(numbers)) for text in new.texts]
        self.there = [-1] * len(old)
        self.back = [-1] * len(new)
        self.moved: set[int] = set()
        self._match_in_order([(0, len(old), 0, len(new))], _LENGTHS[:2])
        self._match_moved(_LENGTHS[:1])
        self._match_in_order(list(self.gaps()), _LENGTHS)
        self._match_moved(_LENGTHS[1:3])
        self._straighten(1)
        self._straighten(-1)
        self._mend_torn_lines(1)
        self._mend_torn_lines(-1)
        self._slide()
        for of_cells in (broken_otherwise, cut_otherwise):
            for here, others, pairs in list(of_cells(self)):
                self._put_into_cells(here, others, pairs)
        self._match_moved(_LENGTHS[:2])
        for olds, news in list(exchanged(self)):
            self.put_in_their_places(olds, news)
        for words in list(exchanged_cells(self)):
            self.forget(words)

    def gaps(self) -> Iterator[Gap]:
        """What has no counterpart, as pairs that stand between the same neighbours; a side of a pair may be empty."""
        come = dict(_runs(self.back))
        starts = {end: start for start, end in come.items()}
        for first, last in _runs(self.there):
            start = self._place_of(first, last, come, starts)
            yield first, last, start, come.pop(start, start)
        for start, end in come.items():
            first = self.back[start - 1] + 1 if start else 0
            yield first, first, start, end

    def _place_of(self, first: int, last: int, come: dict[int, int], starts: dict[int, int]) -> int:
        """Where in the new text something came in the place of words of the old one; else where it would stand.

        One of the neighbours may stand elsewhere: then the other one tells, if it is of the same line.
        """
        start = self.there[first - 1] + 1 if first else 0
        while first and start < len(self.back) and self.back[start] == first - 1:
            start += 1  # one word may be several now
        end = self.there[last] if last < len(self.there) else len(self.back)
        is_behind = not self.old.opens_line(first) and not self.new.opens_line(start)
        if start in come and (come[start] == end or is_behind):
            return start
        is_before = not self.old.opens_line(last) and not self.new.opens_line(end)
        return starts[end] if is_before and starts.get(end) in come else start

    def _match(self, at: int, there: int, count: int = 1) -> None:
        for step in range(count):
            self.there[at + step], self.back[there + step] = there + step, at + step

    def _match_in_order(self, waiting: list[Gap], lengths: tuple[int, ...]) -> None:
        whole = lengths[-1] == 1
        while waiting:
            first, last, start, end = self._without_equal_ends(waiting.pop())
            if first == last or start == end:
                continue
            if whole and (last - first) * (end - start) <= _SMALL:
                self._match_word_by_word(first, last, start, end)
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
                self._match(*pair)
            first, start = pair[0] + 1, pair[1] + 1

    def _without_equal_ends(self, gap: Gap) -> Gap:
        first, last, start, end = gap
        while first < last and start < end and self._a[first] == self._b[start]:
            self._match(first, start)
            first, start = first + 1, start + 1
        while first < last and start < end and self._a[last - 1] == self._b[end - 1]:
            last, end = last - 1, end - 1
            self._match(last, end)
        return first, last, start, end

    def _match_word_by_word(self, first: int, last: int, start: int, end: int) -> None:
        blocks = SequenceMatcher(None, self._a[first:last], self._b[start:end], autojunk=False).get_matching_blocks()
        for at, there, count in blocks:
            self._match(first + at, start + there, count)

    def _rare_in_both(self, olds: Sequence[int], news: Sequence[int], length: int) -> list[tuple[int, int]]:
        """Where the same words in a row occur once on each side, in the order of the old text."""
        there = _once(self._b, news, length)
        return sorted((at, there[key]) for key, at in _once(self._a, olds, length).items() if key in there)

    def _match_moved(self, lengths: tuple[int, ...]) -> None:
        """Whole lines, or long stretches, that stand elsewhere."""
        for length in lengths:
            free = _starts(self.there, length), _starts(self.back, length)
            for at, there in self._rare_in_both(*free, length):
                if self._fits(at, there):
                    self._match_run(at, there)

    def _match_run(self, at: int, there: int) -> None:
        first, start = at, there
        while first and start and self._fits(first - 1, start - 1):
            first, start = first - 1, start - 1
        last, end = at, there
        while last < len(self.there) and end < len(self.back) and self._fits(last, end):
            last, end = last + 1, end + 1
        shift = start - first
        if last - first < _LONG_MOVE:
            first, last = self._whole_lines(first, last, shift)
        if last - first >= _MOVED:
            self._match(first, first + shift, last - first)
            self.moved.update(range(first, last))

    def _whole_lines(self, first: int, last: int, shift: int) -> tuple[int, int]:
        """The part of a run that is whole lines of both texts."""
        while first < last and not (self.old.opens_line(first) and self.new.opens_line(first + shift)):
            first += 1
        while first < last and not self._end_lines(last, last + shift):
            last -= 1
        return first, last

    def _end_lines(self, at: int, there: int) -> bool:
        """Whether lines end before these words, or behind them where they are a sign: it may be taken for another."""
        if self.old.opens_line(at) or self.new.opens_line(there):
            return self.old.opens_line(at) and self.new.opens_line(there)
        ends = self.old.opens_line(at + 1) and self.new.opens_line(there + 1)
        return ends and self._a[at] == self._b[there] and not self.old.texts[at].isalnum()

    def _fits(self, at: int, there: int) -> bool:
        return self.there[at] < 0 and self.back[there] < 0 and self._a[at] == self._b[there]

    def _straighten(self, step: int) -> None:
        """Where text moved, a word beside it may have got the counterpart of another: give each its own."""
        for first, last in list(_runs(self.there)):
            for at in range(first, last) if step > 0 else range(last - 1, first - 1, -1):
                there = self._beside(at, step)
                if there is None or self._a[at] != self._b[there]:
                    break
                other = self.back[there]
                own = None if other < 0 else self._beside(other, step)
                if own is None or self.back[own] >= 0 or self._a[at] != self._b[own]:
                    break
                self._match(other, own)
                self._match(at, there)
                self.moved.update({at, other} if {at - step, other - step} & self.moved else ())

    def _mend_torn_lines(self, step: int) -> None:
        """The first (or last) words of lines that moved may be those of each other: `4.2.` of headings."""
        for beside in range(max(0, step), len(self.there) + min(0, step)):
            at, there = beside - step, self.there[beside] - step
            if self.there[beside] < 0 or self.there[at] in (-1, there) or not 0 <= there < len(self.back):
                continue
            olds, news = self.old.up_to_end(at, -step), self.new.up_to_end(there, -step)
            same = [self._a[word] for word in olds] == [self._b[word] for word in news]
            if same and self.old.line_of[at] == self.old.line_of[beside]:
                self._exchange(olds, news, step)

    def _exchange(self, olds: range, news: range, step: int) -> None:
        """Take words for these, and those that had them for theirs."""
        for at, there in zip(olds, news, strict=True):
            other, left = self.back[there], self.there[at]
            self._match(at, there)
            if other >= 0 and left >= 0:
                self._match(other, left)
            elif other >= 0:
                self.there[other] = -1
            elif left >= 0:
                self.back[left] = -1
            for word in (at, other) if other >= 0 else (at,):
                (self.moved.add if word + step in self.moved else self.moved.discard)(word)

    def _beside(self, at: int, step: int) -> int | None:
        """The word of the new text behind (or before) the counterpart of the one before (or behind) a word."""
        beside = at - step
        there = self.there[beside] + step if 0 <= beside < len(self.there) and self.there[beside] >= 0 else -1
        return there if 0 <= there < len(self.back) else None

    def _put_into_cells(self, olds: list[int], news: list[int], pairs: list[tuple[int, int]]) -> None:
        """Take the words of a row for those of another, pair by pair."""
        self.forget(olds)
        self.forget_new(news)
        for pair in pairs:
            self._match(*pair)

    def put_in_their_places(self, olds: list[int], news: list[int]) -> None:
        """Take each of these lines for the one in its place, whatever words they share with others."""
        for line in olds:
            self.forget(self.old.of_line(line))
        for old, new in zip(olds, news, strict=True):
            here, there = self.old.of_line(old), self.new.of_line(new)
            self._match_word_by_word(here.start, here.stop, there.start, there.stop)

    def forget(self, words: Sequence[int]) -> None:
        """Let words of the old text have no counterpart."""
        for word in words:
            if self.there[word] >= 0:
                self.back[self.there[word]] = -1
            self.there[word] = -1
        self.moved.difference_update(words)

    def take(self, olds: range, news: range) -> None:
        """Take the words of a line for those of another, each for the one in its place."""
        self.forget(olds)
        self.forget_new(news)
        self._match(olds.start, news.start, len(olds))
        if {olds.start - 1, olds.stop} & self.moved:
            self.moved.update(olds)

    def spread(self, olds: Sequence[int], news: Sequence[int]) -> None:
        """Take words for each other that say the same in another number of words, as far along as they stand."""
        for place, word in enumerate(olds):
            if self.there[word] < 0:
                self.there[word] = news[place * len(news) // len(olds)]
        for place, word in enumerate(news):
            if self.back[word] < 0:
                self.back[word] = olds[place * len(olds) // len(news)]

    def forget_new(self, words: Sequence[int]) -> None:
        """Let words of the new text have none."""
        for there in (self.back[word] for word in words if self.back[word] >= 0):
            self.forget(range(there, there + 1))

    def _slide(self) -> None:
        """What was added or removed may begin at several words: at the first of a line or cell, where that is one."""
        for first, last, start, end in list(self.gaps()):
            if start < end and (first == last or not self.new.is_in_one_line(start, end)):
                self._slide_one(self.new, start, end, self.back, self.there)
            if first < last and (start == end or not self.old.is_in_one_line(first, last)):
                self._slide_one(self.old, first, last, self.there, self.back)

    def _slide_one(self, text: Words, start: int, end: int, here: list[int], other: list[int]) -> None:
        words, low, high = text.texts, start, end
        while low and here[low - 1] >= 0 and words[low - 1] == words[high - 1]:
            low, high = low - 1, high - 1
        steps = start - low
        high = end
        while high < len(here) and here[high] >= 0 and words[high] == words[start + high - end]:
            high += 1
        shifts = sorted(range(-steps, high - end + 1), key=lambda by: (start + by > 0, abs(by)))
        for opens in (text.opens_line, text.opens_cell):
            if (by := next((by for by in shifts if opens(start + by)), None)) is not None:
                _shift(here, other, start, end, by)
                return


def _shift(here: list[int], other: list[int], start: int, end: int, by: int) -> None:
    """Let the words without a counterpart be those so many words further on."""
    for step in range(abs(by)):
        filled, freed = (start + step, end + step) if by > 0 else (end - 1 - step, start - 1 - step)
        here[filled], here[freed] = here[freed], -1
        other[here[filled]] = filled


def _runs(matched: list[int]) -> Iterator[tuple[int, int]]:
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
    """Where so many words in a row begin that have no counterpart."""
    return [start for first, last in _runs(matched) for start in range(first, last - length + 1)]


def _once(words: list[int], places: Sequence[int], length: int) -> dict[tuple[int, ...], int]:
    """The rows of words that begin at one of the places only, with that place."""
    keys = {place: tuple(words[place : place + length]) for place in places}
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
