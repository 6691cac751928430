"""A new text in the layout of the one that was transcribed: each line of that one, in its order, with what it says now.

So nothing of the audit has to know how a text may be laid out anew: cells, line breaks, pages and moved sections are as
they were, and a cited line is where it was cited. Only new lines come between.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections import Counter
from typing import TYPE_CHECKING

from fieldscribe.audit.layout.alignment import Alignment, runs
from fieldscribe.audit.layout.fingerprint import Text
from fieldscribe.audit.layout.lines import Line, as_written, joined
from fieldscribe.audit.layout.stacked import unstack
from fieldscribe.audit.pages import page_lines, repeated

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from fieldscribe.audit.layout.fingerprint import Fingerprint, Laid

_LENGTHS = (12, 8, 4, 2, 1)
"""So many pieces in a row tell a place if they occur once: one piece alone has one of 64 signs."""
_HAS_CELLS = re.compile(r"\||\t|\S {2,}\S")
_WENT = 6
"""A line of so many words is found again wherever it went."""
_BROKEN = 12
"""A line is broken over at most so many."""
_HEADS = 80
"""A table's head stands at most so many lines below the one before it."""
_LONG, _SEVERAL = 40, 3
"""So many pieces, or so many lines, moved; fewer may have changed places with others, and that is told.

What stands below a heading moves with it, and below a line that moved.
"""


class _Alignment(Alignment):
    """A few words that stand in another order nearby have changed places, which is no layout."""

    def __init__(self, old: Fingerprint, new: Text) -> None:
        super().__init__(old, new, old.signs, new.signs)
        self._old, self._new = old, new
        self.align(_LENGTHS)
        self._match_headings()
        for step in (1, -1):
            self._extend(step)
            self._mend_torn_lines(step)

    def _match_headings(self) -> None:
        """A heading goes where the line below it goes; a heading alone may have changed places with another."""
        old, new = self._old, self._new
        was, now = _lines_by_signs(old, old.sections), _lines_by_signs(new, range(1, len(new.ends) + 1))
        for signs, lines in was.items():
            if len(lines) == len(now.get(signs, ())) == 1 and self._are_alike_below(lines[0], now[signs][0]):
                olds, news = old.of_line(lines[0]), new.of_line(now[signs][0])
                if any(self.there[at] != there for at, there in zip(olds, news, strict=True)):
                    self.forget(olds)
                    self.forget_new(news)
                    self.match(olds.start, news.start, len(olds))
                    self.moved.update(olds)

    def _are_alike_below(self, line: int, now: int) -> bool:
        was, has = _below(self._old, line), _below(self._new, now)
        return 2 * sum((Counter(was) & Counter(has)).values()) > max(len(was), len(has))

    def _extend(self, step: int) -> None:
        """A piece that has no counterpart yet is the one beside that of its neighbour, if that is free and alike."""
        for at in range(len(self.there))[::step]:
            there = self.beside(at, step)
            if there is not None and self.fits(at, there):
                self.match(at, there)
                if at - step in self.moved:
                    self.moved.add(at)

    def _may_be_torn(self, beside: int, news: range) -> bool:
        return beside in self.moved or all(self.back[piece] < 0 for piece in news)

    def _may_move(self, first: int, last: int, shift: int) -> bool:
        lines = {self._old.line_of[piece] for piece in range(first, last)}
        return last - first >= _LONG or len(lines) >= _SEVERAL or self._goes_along(first, first + shift)

    def _goes_along(self, at: int, there: int) -> bool:
        """Whether the piece above moved likewise, or ends a heading that stands above in both texts."""
        if not at or not there:
            return False
        is_heading = self._old.line_of[at - 1] in self._old.sections and self._a[at - 1] == self._b[there - 1]
        return is_heading or self.there[at - 1] == there - 1


class Relaid:
    """The text, with the place of each of its lines and words in both editions."""

    def __init__(self, kept: Fingerprint, text: str) -> None:
        self.old, self.new = kept, Text(text)
        self._alignment = _Alignment(kept, self.new)
        self._there, self._back = self._alignment.there, self._alignment.back
        self._drop_what_stands_alone()
        self._pages = self._new_pages()
        self._order, self._row_of = self._reading_order(unstack(self._alignment, kept, self.new, self._pages))
        self.lines: list[str] = []
        self._opening: set[int] = set()
        """New lines at the beginning of tables."""
        self._line_of_old: list[int] = [0]
        self._places: list[list[tuple[int, int, int]]] = []
        """For each line the columns of its words, with line and column in the new text."""
        self._write()
        self.gone_to = dict(self._lines_that_went())
        """The line of the new text that has what one line of the transcribed text said, where that stands alone."""
        self._line_of_new = self._by_new_line()
        self._new_lines = sorted(self._line_of_new)

    @property
    def text(self) -> str:
        """All lines."""
        return "\n".join(self.lines)

    @property
    def sections(self) -> set[int]:
        """The lines that opened a section of the transcribed text."""
        return {self.now(line) for line in self.old.sections}

    def now(self, line: int) -> int:
        """The line (of this text) that a line of the transcribed text is."""
        if line < len(self._line_of_old):
            return self._line_of_old[line]
        return line - len(self._line_of_old) + 1 + len(self.lines)

    def of_new(self, line: int) -> int:
        """The line (of this text) on which a line of the new text begins, or the last one before it."""
        at = bisect_right(self._new_lines, line)
        return self._line_of_new[self._new_lines[at - 1]] if at else 1

    def has_words(self, line: int) -> bool:
        """Whether anything stands on a line of this text."""
        return 1 <= line <= len(self._places) and bool(self._places[line - 1])

    def in_new(self, line: int, column: int = 0) -> tuple[int, int]:
        """Line and column in the new text of a place of this one; of a line that is gone, the last line before it.

        Without a column it is the line that has most of its words, or the first of those beside it that has some.
        """
        at = line
        while at and not self.has_words(at):
            at -= 1
        if not at:
            return 1, 1
        places = self._places[at - 1]
        if at != line:
            return max(places)[1], 1
        if not column:
            often = Counter(new for _, new, _ in places)
            most = max(often, key=lambda new: (often[new], -new))
            return min(new for new in often if most - _BROKEN <= new <= most), 1
        start, new_line, new_column = places[max(0, bisect_right(places, (column, len(self.new.written) + 1, 0)) - 1)]
        return new_line, max(1, new_column + column - start)

    def is_new(self, line: int, column: int, length: int) -> bool:
        """Whether some of so many characters of a line of this text stand in no place of the transcribed one."""
        return any(
            column <= start < column + length and self._back[self.new.at(new, there)] < 0
            for start, new, there in self._places[line - 1]
        )

    def last_in_new(self, line: int) -> int:
        """The last line of the new text that has words of a line of this one."""
        here = self._places[line - 1] if 1 <= line <= len(self._places) else []
        return here[-1][1] if here else self.in_new(line)[0]

    def _by_new_line(self) -> dict[int, int]:
        """For each line of the new text the line of this one that has its first word."""
        first: dict[int, tuple[int, int]] = {}
        for line, places in enumerate(self._places, 1):
            for _, new, column in places:
                first[new] = min(first.get(new, (column, line)), (column, line))
        return {new: line for new, (_, line) in first.items()}

    def _lines_that_went(self) -> Iterator[tuple[int, int]]:
        """Lines without a heading that are gone, but stand once somewhere else among the new words."""
        free: dict[str, list[int]] = {}
        signs = "".join(self.new.signs)
        for first, last in runs(self._back):
            for piece in range(first, last - _WENT + 1):
                free.setdefault(signs[piece : piece + _WENT], []).append(piece)
        for line in range(1, len(self.old.ends) + 1):
            pieces = self.old.of_line(line)
            is_gone = len(pieces) >= _WENT and all(self._there[piece] < 0 for piece in pieces)
            if is_gone and line not in self.old.sections:
                said = "".join(self.old.signs[pieces.start : pieces.stop])
                places = [at for at in free.get(said[:_WENT], ()) if signs.startswith(said, at)]
                if len(places) == 1:
                    yield line, self.new.line_of[places[0]]

    def _drop_what_stands_alone(self) -> None:
        """A piece whose neighbours are all others has its sign by chance."""
        there = self._there
        for piece, other in enumerate(there):
            if other < 0:
                continue
            before = piece > 0 and there[piece - 1] >= 0 and abs(there[piece - 1] - other) <= 1
            behind = piece + 1 < len(there) and there[piece + 1] >= 0 and abs(there[piece + 1] - other) <= 1
            is_line = len(self.old.of_line(self.old.line_of[piece])) == 1
            if not (before or behind or is_line):
                self._alignment.forget(range(piece, piece + 1))

    def _new_pages(self) -> frozenset[int]:
        """The heads and feet of pages that are not as they were."""
        written = self.new.written
        partly = {self.new.line_of[piece] for piece, other in enumerate(self._back) if other < 0}
        mostly = {line for line in partly if self._is_mostly_new(line)}
        pages = frozenset(page_lines(written) & partly) | frozenset(repeated(written, mostly))
        for line in pages:
            self._alignment.forget_new(self.new.of_line(line))
        return pages

    def _is_mostly_new(self, line: int) -> bool:
        pieces = self.new.of_line(line)
        return 2 * sum(self._back[piece] < 0 for piece in pieces) > len(pieces)

    def _write(self) -> None:
        behind, before, between = self._added()
        self._copy(between.pop(-1, ()))
        for line in range(1, len(self.old.ends) + 1):
            self._line_of_old.append(len(self.lines) + 1)
            self._write_line(line, behind, before)
            for piece in self.old.of_line(line):
                self._copy(between.pop(self._there[piece], ()) if self._there[piece] >= 0 else ())

    def _reading_order(self, rows: Iterable[list[int]]) -> tuple[list[int], list[int]]:
        """All words but those of pages in the order in which they are read, and the line or row of each."""
        row_of = list(self.new.line_of)
        instead: dict[int, list[int]] = {}
        for pieces in rows:
            instead[min(pieces)] = pieces
            for piece in pieces:
                row_of[piece] = -min(pieces) - 1
        order: list[int] = []
        for piece, row in enumerate(row_of):
            if row < 0:
                order += instead.get(piece, ())
            elif row not in self._pages:
                order.append(piece)
        return order, row_of

    def _added(self) -> tuple[dict[int, list[int]], dict[int, list[int]], dict[int, list[int]]]:
        """New words behind or before words that were there, by those; and new lines by the last word before them."""
        behind: dict[int, list[int]] = {}
        before: dict[int, list[int]] = {}
        between: dict[int, list[int]] = {}
        order, row_of = [-1, *self._order, -1], self._row_of
        for first, last in runs([0, *(self._back[piece] for piece in self._order), 0]):
            above, below = order[first - 1], order[last]
            inside = min(above, below) >= 0 and self._old_line(above) == self._old_line(below)
            for piece in order[first:last]:
                if inside or (above >= 0 and row_of[piece] == row_of[above]):
                    behind.setdefault(above, []).append(piece)
                elif below >= 0 and row_of[piece] == row_of[below]:
                    before.setdefault(below, []).append(piece)
                elif between.setdefault(above, [])[-1:] != [self.new.line_of[piece]]:
                    between[above].append(self.new.line_of[piece])
        return behind, before, between

    def _old_line(self, piece: int) -> int:
        return self.old.line_of[self._back[piece]]

    def _write_line(self, line: int, behind: dict[int, list[int]], before: dict[int, list[int]]) -> None:
        pieces = self.old.of_line(line)
        out = Line(self.new)
        gap = ""
        last: int | None = None
        for piece in pieces:
            gap = joined(gap, self.old.gaps[piece]) if piece != pieces.start else self.old.gaps[piece]
            there = self._there[piece]
            if there < 0:
                continue
            added = [*(behind.pop(last, ()) if last is not None else ()), *before.pop(there, ())]
            gap = out.put(added, gap)
            out.put_kept(there, gap, is_first=last is None)
            gap, last = "", there
        if last is None:
            self._end(out, "" if pieces else self.old.ends[line - 1])
        else:
            end = out.put(behind.pop(last, ()), joined(gap, self.old.ends[line - 1]))
            self._end(out, end)

    def _end(self, out: Line, gap: str) -> None:
        self.lines.append(out.text + as_written(gap, first=not out.text, last=True))
        self._places.append(out.places)

    def _copy(self, lines: Iterable[int]) -> None:
        """New lines as they are."""
        for line in lines:
            if self._is_head_again(line):
                continue
            self.lines.append(self.new.written[line - 1])
            self._places.append(
                [(self.new.columns[piece], line, self.new.columns[piece]) for piece in self.new.of_line(line)]
            )

    def _is_head_again(self, line: int) -> bool:
        """Whether a table begins with a line that one above it has, too: its head on one page more."""
        written = self.new.written
        above = line - 1
        while above > 1 and not written[above - 1].strip():
            above -= 1
        opens = above < line - 1 or above in self._pages or above in self._opening or not _is_row(written[above - 1])
        words = _words(written[line - 1])
        if not opens or not _is_row(written[line - 1]):
            return False
        self._opening.add(line)
        return any(words == _words(written[other - 1]) for other in range(max(1, line - _HEADS), line))


def _lines_by_signs(text: Laid, lines: Iterable[int]) -> dict[str, list[int]]:
    """The lines that have the same words, by their signs."""
    found: dict[str, list[int]] = {}
    for line in lines:
        pieces = text.of_line(line)
        found.setdefault("".join(text.signs[pieces.start : pieces.stop]), []).append(line)
    return found


def _below(text: Laid, line: int) -> list[str]:
    """The signs of the next line that has words."""
    start = text.of_line(line).stop
    pieces = text.of_line(text.line_of[start]) if start < len(text) else range(0)
    return text.signs[pieces.start : pieces.stop]


def _is_row(text: str) -> bool:
    return _HAS_CELLS.search(text.strip()) is not None and any(map(str.isalpha, text))


def _words(text: str) -> list[str]:
    return text.replace("|", " ").split()
