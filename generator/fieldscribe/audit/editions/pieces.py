"""What is left of two texts without a counterpart, piece by piece, and about where in the other each would stand."""

from __future__ import annotations

from bisect import bisect_left
from itertools import groupby, pairwise
from typing import TYPE_CHECKING, NamedTuple

from fieldscribe.audit.editions.words import pressed, unspaced

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from fieldscribe.audit.editions.words import Words

PAGE = 40
"""What a page gives in another order stands within so many lines."""
MOST = 4
"""So many lines, or pieces, make one cell."""


class Piece(NamedTuple):
    """Words without a counterpart: whole lines, or one end of a line or cell; `key` is what they say without blanks."""

    words: range
    line: int
    key: str
    is_whole: bool
    is_cell: bool
    """Whether it is a cell of a line that goes on with the row above."""
    is_inner: bool
    """Whether it is a cell, or an end of one, amidst a line."""


class Side:
    """One of the two texts, with the counterparts of its words."""

    def __init__(self, text: Words, there: list[int]) -> None:
        self.text, self.there = text, there
        self.replaced: set[int] = set()
        self.halves: set[int] = set()

    def free(self) -> list[int]:
        """The words without a counterpart."""
        return [word for word, other in enumerate(self.there) if other < 0]

    def lines(self, first: int, last: int) -> int:
        """On how many lines the words first..last stand."""
        return len({self.text.line_of[word] for word in range(first, last)})

    def is_free(self, words: range) -> bool:
        """Whether none of these words has a counterpart."""
        return all(self.there[word] < 0 for word in words) and self.replaced.isdisjoint(words)

    def pieces(self) -> list[Piece]:
        """Each line, or end of a line, without a counterpart, and up to some of those in a row."""
        ends = list(self._ends())
        inner = [self._piece([cell], is_inner=True) for cell in self._cells()]
        runs = (ends[at:last] for at in range(len(ends)) for last in range(at + 1, min(at + MOST, len(ends)) + 1))
        whole = [run for run in runs if all(above.stop == below.start for above, below in pairwise(run))]
        return [*map(self._piece, whole), *inner]

    def _piece(self, run: list[range], *, is_inner: bool = False) -> Piece:
        words = range(run[0].start, run[-1].stop)
        key = pressed(unspaced([self.text.texts[word] for word in words])).removesuffix("-")
        opens = self.text.opens_line(words.start) or words.start - 1 in self.halves
        is_whole = opens and self.text.opens_line(words.stop)
        line = self.text.line_of[words.start]
        is_cell = self.text.continues(line) and all(map(self._parts, (words.start, words.stop)))
        return Piece(words, line, key, is_whole, is_cell, is_inner)

    def _parts(self, word: int) -> bool:
        """Whether a line or cell begins at a word."""
        return self.text.opens_line(word) or self.text.opens_cell(word)

    def _cells(self) -> Iterator[range]:
        """The cells, and ends of cells, without a counterpart that stand between others of their line."""
        for is_free, run in groupby(range(len(self.there)), key=lambda word: self.there[word] < 0):
            words = list(run)
            inside = range(words[0], words[-1] + 1)
            amidst = not self.text.opens_line(inside.start) and not self.text.opens_line(inside.stop)
            if is_free and amidst and (self._parts(inside.start) or self._parts(inside.stop)):
                yield inside

    def _ends(self) -> Iterator[range]:
        for line in range(1, len(self.text.lines) + 1):
            words = self.text.of_line(line)
            taken = [word for word in words if self.there[word] >= 0]
            if not taken:
                yield from [words] if words else []
            else:
                yield from (end for end in (range(words.start, taken[0]), range(taken[-1] + 1, words.stop)) if end)


class Places:
    """About where in the other text each word of one text would stand: where its neighbours do."""

    def __init__(self, side: Side, other: Side) -> None:
        self._above, self._below = [0] * len(side.there), [0] * len(side.there)
        for places, words in ((self._above, range(len(side.there))), (self._below, range(len(side.there) - 1, -1, -1))):
            line = 0
            for word in words:
                line = other.text.line_of[side.there[word]] if side.there[word] >= 0 else line
                places[word] = line

    def apart(self, word: int, line: int) -> int:
        """How far a line of the other text is from there."""
        return min(abs(line - self._above[word]), abs(line - self._below[word]))

    def near(self, word: int, pieces: Sequence[Piece]) -> Iterator[Piece]:
        """Those of some pieces of the other text, in its order, that stand on the same page."""
        for middle in {self._above[word], self._below[word]}:
            at = bisect_left(pieces, middle - PAGE, key=lambda piece: piece.line)
            while at < len(pieces) and pieces[at].line <= middle + PAGE:
                yield pieces[at]
                at += 1
