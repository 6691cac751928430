"""Two texts of a manual, line by line: which lines stayed, changed, moved, were added or were removed.

Lines that are unique in both texts are aligned first, then the lines between them. So the cost grows with the length of
the texts even if every line changed; difflib alone would not finish.
"""

import re
from bisect import bisect_left
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from difflib import SequenceMatcher
from functools import cached_property
from itertools import pairwise
from operator import itemgetter
from typing import Final, NamedTuple, TypeAlias

_MOST_PAIRS: Final = 4_000
"""The most pairs of lines, or of words, in a block that is compared pair by pair."""
_MOST_STEPS: Final = 40
"""The most times that a line is looked at; a line not aligned by then was removed or added."""
_ALIKE = 0.3
"""The share of equal words from which on two lines are one changed line."""


_Chain: TypeAlias = "tuple[tuple[int, int], _Chain] | None"
"""Pairs of lines, each linked to the pairs that follow it."""


class Change(NamedTuple):
    """A line that differs: `old` and `new` are line numbers from 1. A moved line has the same text elsewhere."""

    kind: str
    old: int | None
    new: int | None


class Alignment:
    """The lines of an old and a new text with their counterparts. Blanks and the width of cells are ignored."""

    def __init__(self, old: Sequence[str], new: Sequence[str]) -> None:
        self.old, self.new = _Text(old), _Text(new)
        pairs = _Aligner(self.old.contents, self.new.contents).pairs()
        self._new_of = {self.old.numbers[at]: self.new.numbers[to] for at, to in pairs}
        self._moved = self._moved_lines()
        self._old_of = {new: old for old, new in (*self._new_of.items(), *self._moved.items())}

    def _moved_lines(self) -> dict[int, int]:
        """Return the lines without a counterpart whose text occurs exactly once among such lines of the other text."""
        aligned = set(self._new_of.values())
        left = _unique((line, self.old.text(line)) for line in self.old.numbers if line not in self._new_of)
        right = _unique((line, self.new.text(line)) for line in self.new.numbers if line not in aligned)
        return {line: right[text] for text, line in left.items() if text in right}

    def now(self, line: int) -> int | None:
        """Return the line of the new text for one of the old; None if it is gone. Blank lines follow the one above."""
        return _counterpart(line, self.old, {**self._moved, **self._new_of} if self._moved else self._new_of)

    def then(self, line: int) -> int | None:
        """Return the line of the old text for one of the new; None if it is new."""
        return _counterpart(line, self.new, self._old_of)

    @cached_property
    def changes(self) -> list[Change]:
        """All lines that differ, in the order of the new text; removed ones at their old place."""
        entries: list[tuple[int, int, Change]] = []
        above = 0
        for old in self.old.numbers:
            new = self._new_of.get(old)
            if new is None:
                kind = "moved" if old in self._moved else "removed"
                entries.append((above, old, Change(kind, old, self._moved.get(old))))
                continue
            above = new
            if self.old.text(old) != self.new.text(new):
                entries.append((new, 0, Change("changed", old, new)))
        entries += [(new, 0, Change("added", None, new)) for new in self.new.numbers if new not in self._old_of]
        return [change for _, _, change in sorted(entries, key=lambda entry: entry[:2])]


class _Text:
    """The non-empty lines of a text, without layout; `numbers` are their numbers from 1."""

    def __init__(self, lines: Sequence[str]) -> None:
        contents = [" ".join(line.replace("|", " | ").split()) for line in lines]
        self.numbers = [number for number, text in enumerate(contents, 1) if text]
        self.contents = [text for text in contents if text]
        self._text = dict(zip(self.numbers, self.contents, strict=True))

    def text(self, number: int) -> str:
        return self._text.get(number, "")


def _counterpart(line: int, text: _Text, lines: dict[int, int]) -> int | None:
    if line in lines:
        return lines[line]
    if text.text(line):
        return None
    place = bisect_left(text.numbers, line) - 1
    above = text.numbers[place] if place >= 0 else 0
    return line if above == 0 else lines[above] + line - above if above in lines else None


def _unique(texts: Iterable[tuple[int, str]]) -> dict[str, int]:
    """Return the numbers of the texts that occur once."""
    numbers = list(texts)
    often = Counter(text for _, text in numbers)
    return {text: number for number, text in numbers if often[text] == 1}


class _Aligner:
    """Aligns two lists of lines: first those that are unique in both, then the blocks between them."""

    def __init__(self, old: Sequence[str], new: Sequence[str]) -> None:
        self.old, self.new = old, new
        self._steps = _MOST_STEPS * (len(old) + len(new) + 1)

    def pairs(self) -> list[tuple[int, int]]:
        """Return the pairs of indices of aligned lines, rising in both texts."""
        found: list[tuple[int, int]] = []
        blocks = [(range(len(self.old)), range(len(self.new)))]
        while blocks:
            old, new = self._without_equal_ends(*blocks.pop(), found)
            self._steps -= len(old) + len(new)
            if not old or not new or self._steps < 0:
                continue
            anchors = self._anchors(old, new)
            if not anchors:
                found += self._block(old, new)
                continue
            found += anchors
            ends = [(old.start - 1, new.start - 1), *anchors, (old.stop, new.stop)]
            blocks += [(range(a + 1, c), range(b + 1, d)) for (a, b), (c, d) in pairwise(ends)]
        return sorted(found)

    def _without_equal_ends(self, old: range, new: range, found: list[tuple[int, int]]) -> tuple[range, range]:
        while old and new and self.old[old[0]] == self.new[new[0]]:
            found.append((old[0], new[0]))
            old, new = old[1:], new[1:]
        while old and new and self.old[old[-1]] == self.new[new[-1]]:
            found.append((old[-1], new[-1]))
            old, new = old[:-1], new[:-1]
        return old, new

    def _anchors(self, old: range, new: range) -> list[tuple[int, int]]:
        """Return lines that are unique in both blocks: by text, by text without numbers, or by first words."""
        keys: tuple[Callable[[str], str], ...] = (
            str,
            lambda line: re.sub(r"[0-9]+", "#", line),
            lambda line: " ".join(re.findall(r"\w+", line)[:2]),
        )
        for key in keys:
            left = _unique((at, key(self.old[at])) for at in old)
            right = _unique((at, key(self.new[at])) for at in new)
            both = [(at, right[text]) for text, at in left.items() if text in right]
            if both:
                return _longest_rising(both)
        return []

    def _block(self, old: range, new: range) -> list[tuple[int, int]]:
        """Pair the lines of a block by the words that they share; those of a large block by position."""
        if len(old) * len(new) > _MOST_PAIRS:
            return list(zip(old, new, strict=False)) if len(old) == len(new) else []
        nothing: tuple[float, _Chain] = (0.0, None)
        best = [nothing] * (len(new) + 1)
        for at in reversed(old):
            below, best = best, [nothing] * (len(new) + 1)
            for place, to in reversed(list(enumerate(new))):
                share, (rest, chain) = self._likeness(at, to), below[place + 1]
                pair = [(rest + share, ((at, to), chain))] if share else []
                best[place] = max((*pair, below[place], best[place + 1]), key=itemgetter(0))
        return list(_unchained(best[0][1]))

    def _likeness(self, at: int, to: int) -> float:
        left, right = (Counter(re.findall(r"\w+", text)) for text in (self.old[at], self.new[to]))
        share = 2 * (left & right).total() / max(1, left.total() + right.total())
        is_prose = "|" not in self.old[at] and "|" not in self.new[to]
        return share if share >= _ALIKE else 0.01 * is_prose


def _unchained(chain: _Chain) -> Iterator[tuple[int, int]]:
    while chain is not None:
        pair, chain = chain
        yield pair


def _longest_rising(pairs: list[tuple[int, int]]) -> list[tuple[int, int]]:
    """Return the longest subsequence of pairs that rises in both texts; the pairs are in the order of the old one."""
    ends: list[int] = []
    chains: list[_Chain] = []
    for pair in pairs:
        place = bisect_left(ends, pair[1])
        chain = (pair, chains[place - 1] if place else None)
        ends[place : place + 1] = [pair[1]]
        chains[place : place + 1] = [chain]
    return [*_unchained(chains[-1])][::-1]


def changed_words(old: str, new: str) -> list[tuple[str, str]]:
    """Return the runs of words that differ between two lines, old and new."""
    left, right = (re.findall(r"[^\s|]+", text) for text in (old, new))
    if len(left) * len(right) > _MOST_PAIRS * 50:
        return [(old.strip(), new.strip())]
    codes = SequenceMatcher(None, left, right, autojunk=False).get_opcodes()
    return [(" ".join(left[a:b]), " ".join(right[c:d])) for tag, a, b, c, d in codes if tag != "equal"]
