"""Which words of one text are which of another: cells that are broken otherwise and lines that changed places, too."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.audit.editions.rows import broken_otherwise, cut_otherwise
from fieldscribe.audit.editions.swaps import exchanged, exchanged_cells
from fieldscribe.audit.layout.alignment import Alignment, Gap

if TYPE_CHECKING:
    from collections.abc import Sequence

    from fieldscribe.audit.editions.words import Words

__all__ = ["Gap", "Matching"]

_LENGTHS = (8, 4, 2, 1)
"""So many words in a row tell a place if they occur once; shorter rows are tried where longer ones lack."""


class Matching(Alignment):
    """Which words of two texts are the same ones."""

    def __init__(self, old: Words, new: Words) -> None:
        super().__init__(old, new, old.texts, new.texts)
        self.old, self.new = old, new
        self.align(_LENGTHS)
        self._slide()
        for of_cells in (broken_otherwise, cut_otherwise):
            for here, others, pairs in list(of_cells(self)):
                self._put_into_cells(here, others, pairs)
        self._match_moved(_LENGTHS[:2])
        for olds, news in list(exchanged(self)):
            self.put_in_their_places(olds, news)
        for words in list(exchanged_cells(self)):
            self.forget(words)

    def _end_lines(self, at: int, there: int) -> bool:
        """Whether lines end before these words, or behind them where they are a sign: it may be taken for another."""
        if self.old.opens_line(at) or self.new.opens_line(there):
            return super()._end_lines(at, there)
        ends = self.old.opens_line(at + 1) and self.new.opens_line(there + 1)
        return ends and self._a[at] == self._b[there] and not self.old.texts[at].isalnum()

    def _put_into_cells(self, olds: list[int], news: list[int], pairs: list[tuple[int, int]]) -> None:
        """Take the words of a row for those of another, pair by pair."""
        self.forget(olds)
        self.forget_new(news)
        for pair in pairs:
            self.match(*pair)

    def put_in_their_places(self, olds: list[int], news: list[int]) -> None:
        """Take each of these lines for the one in its place, whatever words they share with others."""
        for line in olds:
            self.forget(self.old.of_line(line))
        for old, new in zip(olds, news, strict=True):
            here, there = self.old.of_line(old), self.new.of_line(new)
            self._match_one_by_one(here.start, here.stop, there.start, there.stop)

    def take(self, olds: range, news: range) -> None:
        """Take the words of a line for those of another, each for the one in its place."""
        self.forget(olds)
        self.forget_new(news)
        self.match(olds.start, news.start, len(olds))
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
