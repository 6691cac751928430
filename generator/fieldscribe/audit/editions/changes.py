"""What tells a new edition of a text from the old one, line by line: kept, moved, changed, added, removed."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import dataclass
from itertools import product
from typing import TYPE_CHECKING

from fieldscribe.audit.editions.contents import Contents
from fieldscribe.audit.editions.matching import Matching
from fieldscribe.audit.editions.parting import are_unlike, parted
from fieldscribe.audit.editions.reading_order import ReadingOrder
from fieldscribe.audit.editions.words import Words, pressed, unspaced
from fieldscribe.audit.pages import page_lines_of_both, pattern

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from fieldscribe.audit.editions.matching import Gap

Lines = tuple[int, int]
"""The first and the last of some lines."""
_SECTION = re.compile(r"[\s#]*[0-9]+(?:\.[0-9]+)+\.?\s*([^\W\d][^|\t]*)")
_LEADERS = re.compile(r"\.{4,}|\s[0-9]+\s*$")
_FEW = 6
"""A glued cell is at most so many words."""
_NEAR = 12
"""The words of a line stand within so many lines; what stands farther away was matched by chance."""


@dataclass(frozen=True, slots=True)
class Change:
    """Lines that say something else now. An empty range of words stands where nothing was added or removed.

    `old` and `new` are all lines of the change in each text, `gaps` the words without a counterpart.
    """

    kind: str
    old: tuple[int, ...]
    new: tuple[int, ...]
    gaps: tuple[tuple[range, range], ...]


@dataclass(frozen=True, slots=True)
class Move:
    """Lines first..last of the old edition that stand in another order in the new one, from line `now` on."""

    first: int
    last: int
    now: int


class Editions:
    """Two editions of one text."""

    def __init__(self, old: str, new: str) -> None:
        self.pages = page_lines_of_both(old.splitlines(), new.splitlines())
        self.contents = Contents(old.splitlines()), Contents(new.splitlines())
        self.old, self.new = (
            Words(text, pages, contents.ends)
            for text, pages, contents in zip((old, new), self.pages, self.contents, strict=True)
        )
        self._matching = Matching(self.old, self.new)
        self._there, self._back = self._matching.there, self._matching.back
        self._match_headings()
        ReadingOrder(self._matching)
        self._put_rows_in_their_places()
        self._part_unlike_rows()
        for gap in list(self._matching.gaps()):
            self._take_equal_ends(gap)
        gaps = [gap for gap in self._matching.gaps() if not self._is_layout(gap)]
        self.changes = tuple(sorted(self._changes(gaps), key=lambda change: (change.new or change.old, change.old)))
        self._instead = _in_place(self.changes)
        self._then_instead = {new: old for old, new in self._instead.items()}
        self._now: dict[int, Lines | None] = {}
        self._then: dict[int, Lines | None] = {}
        self.moves = tuple(self._moves())
        self.changed_old = frozenset(line for change in self.changes for line in change.old)
        self.changed_new = frozenset(line for change in self.changes for line in change.new)

    def now(self, line: int) -> Lines | None:
        """The lines (first, last) of the new edition that have what a line of the old one says; None if it is gone."""
        if line not in self._now:
            self._now[line] = _there(line, self.old, self.new, self._there) or _one(self._instead.get(line))
        return self._now[line]

    def then(self, line: int) -> Lines | None:
        """The same turned round: the lines of the old edition."""
        if line not in self._then:
            self._then[line] = _there(line, self.new, self.old, self._back) or _one(self._then_instead.get(line))
        return self._then[line]

    def is_new(self, word: int) -> bool:
        """Whether a word of the new edition is not in the old one."""
        return self._back[word] < 0

    def is_gone(self, word: int) -> bool:
        """Whether a word of the old edition is not in the new one."""
        return self._there[word] < 0

    def there(self, word: int) -> int:
        """The word of the new edition that a word of the old one is; -1 if none."""
        return self._there[word]

    def _is_layout(self, gap: Gap) -> bool:
        """Whether only the setting of words or the mark of an entry differs; its words are taken for each other."""
        first, last, start, end = gap
        above, below = self.old.beside(range(first, last))
        was = pressed([*above, *unspaced(self.old.texts[first:last]), *below])
        now = pressed([*above, *unspaced(self.new.texts[start:end]), *below])
        if was != now and not self._is_mark(gap) and not self._is_repeated_cell(gap):
            return False
        olds = range(first, last) or [min(first, len(self._there) - 1)]
        news = range(start, end) or [min(start, len(self._back) - 1)]
        self._matching.spread(olds, news)
        return True

    def _is_mark(self, gap: Gap) -> bool:
        """Whether an entry of a list has a number where it had a mark, or the other way round."""
        first, last, start, end = gap
        if first == last:
            return self.new.is_numbering(start, end) and self.old.is_entry(self._back, end)
        return start == end and self.old.is_numbering(first, last) and self.new.is_entry(self._there, last)

    def _is_repeated_cell(self, gap: Gap) -> bool:
        """Whether the first cell of a row got, or lost, what the one above it has in both texts: it holds for both."""
        first, last, start, end = gap
        if first == last:
            return self._repeats_cell(self.new, self._back, range(start, end), self.old)
        return start == end and self._repeats_cell(self.old, self._there, range(first, last), self.new)

    @staticmethod
    def _repeats_cell(text: Words, other: list[int], words: range, bare: Words) -> bool:
        """Whether words of one text are such a cell, and their row begins with an empty cell in the `bare` one."""
        line = text.line_of[words.start]
        above, rest = text.first_cell(line - 1), range(words.stop, text.of_line(line).stop)
        if text.first_cell(line) != words or [text.texts[at] for at in above] != [text.texts[at] for at in words]:
            return False
        lines = {bare.line_of[other[word]] for word in rest if other[word] >= 0}
        return all(other[word] >= 0 for word in above) and len(lines) == 1 and bare.goes_on(lines.pop())

    def _take_equal_ends(self, gap: Gap) -> None:
        """What only blanks and hyphens set otherwise at an end of a gap is the same: something came beside it."""
        first, last, start, end = gap
        for old, new in product(range(1, min(_FEW, last - first) + 1), range(1, min(_FEW, end - start) + 1)):
            for olds, news in (
                (range(last - old, last), range(end - new, end)),
                (range(first, first + old), range(start, start + new)),
            ):
                if self._says_the_same(olds, news):
                    self._matching.spread(olds, news)
                    return

    def _says_the_same(self, olds: range, news: range) -> bool:
        both = (self.old, olds), (self.new, news)
        beside = (word for text, words in both for side in text.beside(words) for word in side)
        number = ["0"] if any(map(str.isdecimal, beside)) else []  # it parts the numbers of a list
        was, now = ([*number, *unspaced(text.texts[words.start : words.stop]), *number] for text, words in both)
        return len(olds) != len(news) and pressed(was) == pressed(now)

    def _match_headings(self) -> None:
        """A section that has another number now is the one with its title."""
        was, now = _titles(self.old), _titles(self.new)
        for title in was.keys() & now.keys():
            old, new = self.old.of_line(was[title]), self.new.of_line(now[title])
            texts = [self.old.texts[word] for word in old], [self.new.texts[word] for word in new]
            if texts[0] != texts[1] and len(old) == len(new):
                self._matching.take(old, new)

    def _put_rows_in_their_places(self) -> None:
        """Rows that differ in numbers alone, one below the other in both texts, are each the row in its place."""
        for group in _grouped([self._with_lines(gap) for gap in self._matching.gaps()]):
            olds, news = (sorted(set().union(*(placed[side] for placed in group))) for side in (1, 2))
            was, now = (
                [pattern(text.line(line)) for line in lines] for text, lines in ((self.old, olds), (self.new, news))
            )
            if len(olds) > 1 and was == now:
                self._matching.put_in_their_places(olds, news)

    def _part_unlike_rows(self) -> None:
        """A row that shares hardly a word with the one in its place is another row."""
        for group in _grouped([self._with_lines(gap) for gap in self._matching.gaps()]):
            olds, news = {line for _, old, _ in group for line in old}, {line for _, _, new in group for line in new}
            if len(olds) == len(news) == 1 and self._are_unlike(old := olds.pop(), new := news.pop()):
                self._matching.forget(self.old.of_line(old))
                self._matching.forget_new(self.new.of_line(new))

    def _are_unlike(self, old: int, new: int) -> bool:
        first = self._there[self.old.of_line(old).start]
        if first >= 0 and self.new.line_of[first] != new:
            return False  # the row stands elsewhere: what is here is a cell of it
        here = [word for word in self.old.of_line(old) if self.old.texts[word].isalnum()]
        there = {word: self.new.texts[word] for word in self.new.of_line(new) if self.new.texts[word].isalnum()}
        shared = sum(self._there[word] in there for word in here)
        texts = [self.old.texts[word] for word in here], [*there.values()]
        return are_unlike(self.old.line(old), self.new.line(new), texts, shared)

    def _changes(self, gaps: Iterable[Gap]) -> Iterator[Change]:
        pieces = [piece for gap in gaps for piece in parted(self.old, self.new, gap)]
        for group in _grouped([self._with_lines(piece) for piece in pieces]):
            olds = tuple(sorted({line for _, old, _ in group for line in old}))
            news = tuple(sorted({line for _, _, new in group for line in new}))
            words = tuple((range(*gap[:2]), range(*gap[2:])) for gap, _, _ in group)
            yield Change("changed" if olds and news else "removed" if olds else "added", olds, news, words)

    def _with_lines(self, gap: Gap) -> tuple[Gap, set[int], set[int]]:
        """A gap with its lines in both texts, and those that the rest of each line stands on in the other."""
        first, last, start, end = gap
        olds = {self.old.line_of[word] for word in range(first, last)}
        news = {self.new.line_of[word] for word in range(start, end)}
        if not olds:
            olds = {self.old.line_of[word] for word in self._beside(self.new, news, self._back, start, end)}
        elif not news:
            news = {self.new.line_of[word] for word in self._beside(self.old, olds, self._there, first, last)}
        return gap, olds, news

    @staticmethod
    def _beside(text: Words, lines: set[int], other: list[int], start: int, end: int) -> list[int]:
        """The counterpart of the word before a gap, or else of the one behind it, on the gap's own lines."""
        beside = [word for word in (start - 1, end) if 0 <= word < len(text) and text.line_of[word] in lines]
        return [other[word] for word in beside if other[word] >= 0][:1]

    def _moves(self) -> Iterator[Move]:
        run: list[tuple[int, int]] = []
        for line in range(1, len(self.old.lines) + 2):
            words = self.old.of_line(line)
            now = self.now(line) if words else None
            has_moved = now is not None and self._has_moved(words)
            if now is not None and has_moved and (not run or run[-1][1] <= now[0] <= run[-1][1] + _NEAR):
                run.append((line, now[0]))
            elif words or line > len(self.old.lines):
                if run:
                    yield Move(run[0][0], run[-1][0], run[0][1])
                run = [(line, now[0])] if now is not None and has_moved else []

    def _has_moved(self, words: range) -> bool:
        """Whether all that is left of a line moved."""
        left = [word for word in words if not self.is_gone(word)]
        return bool(left) and self._matching.moved.issuperset(left)

    def counts(self) -> dict[str, int]:
        """How many lines of each kind there are."""
        count = Counter({"changed": 0, "added": 0, "removed": 0})
        for change in self.changes:
            count[change.kind] += len(change.new or change.old)
        count["moved"] = sum(move.last - move.first + 1 for move in self.moves)
        return dict(count)


def _titles(text: Words) -> dict[str, int]:
    """The line of each title that one numbered section has, and no other line."""
    lines: dict[str, list[int]] = {}
    for number in range(1, len(text.lines) + 1):
        if (match := _SECTION.fullmatch(text.line(number))) and not _LEADERS.search(match[1]):
            lines.setdefault(" ".join(match[1].casefold().split()), []).append(number)
    return {title: places[0] for title, places in lines.items() if len(places) == 1}


def _in_place(changes: Iterable[Change]) -> dict[int, int]:
    """Which line of the new edition stands in the place of an old one that was changed, where as many do."""
    alike = (change for change in changes if len(change.old) == len(change.new))
    return {old: new for change in alike for old, new in zip(change.old, change.new, strict=True)}


def _one(line: int | None) -> Lines | None:
    return None if line is None else (line, line)


def _there(line: int, here: Words, other: Words, counterparts: list[int]) -> Lines | None:
    """Where a line stands in the other text; one without words stands as far above the next that has some."""
    words = here.of_line(line)
    if words:
        there = [counterparts[word] for word in words if counterparts[word] >= 0]
    else:
        below = range(words.start, len(counterparts))
        word = next((word for word in below if counterparts[word] >= 0), None)
        if word is None:
            place = len(other.lines)
        else:
            place = max(1, other.line_of[counterparts[word]] - here.line_of[word] + line)
        return place, place
    if not there:
        return None
    lines = sorted(head := [other.line_of[word] for word in there])
    middle = lines[len(lines) // 2]
    near = [place for place in lines if abs(place - middle) <= _NEAR]
    is_row = here.line(line).startswith("|") and head[0] in near  # a cell of it may be one with the one above
    return head[0] if is_row else near[0], near[-1]


_Placed = tuple["Gap", set[int], set[int]]


def _grouped(gaps: list[_Placed]) -> Iterator[list[_Placed]]:
    """Gaps that share a line of either text."""
    groups: dict[int, list[_Placed]] = {}
    group_of: dict[tuple[str, int], int] = {}
    for number, gap in enumerate(gaps):
        lines = [*(("old", line) for line in gap[1]), *(("new", line) for line in gap[2])]
        joined = sorted({group_of[line] for line in lines if line in group_of})
        members = [member for other in joined for member in groups.pop(other)] + [gap]
        groups[number] = members
        for _, olds, news in members:
            group_of.update(dict.fromkeys((("old", line) for line in olds), number))
            group_of.update(dict.fromkeys((("new", line) for line in news), number))
    yield from groups.values()
