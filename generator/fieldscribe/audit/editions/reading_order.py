"""Pieces of a page that a text gives in another order: cells, signs in the margin, the second halves of parted words.

What is left without a counterpart on both sides is compared by its letters, wherever on a page it stands. A number by
itself says something by its place: it is the same only where a cell of its own was joined to a line, or split from it.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from fieldscribe.audit.editions.pieces import MOST, PAGE, Piece, Places, Side

if TYPE_CHECKING:
    from collections.abc import Sequence

    from fieldscribe.audit.editions.matching import Matching

_LABEL = re.compile(r"(?!(?:0x)?[0-9a-f]*[0-9][0-9a-f]*h?$)(?:[^\W\d_]|.*[^\W\d_]{2}).*", re.IGNORECASE)
"""What says something wherever it stands: it has letters, and is no number with other digits."""
_NUMBER = re.compile(r"[0-9]+")
_NAME = re.compile(r"[^\W\d_]{3}")
_BESIDE = 2
"""What was one cell stands within so many lines."""
_WITHIN = 60
"""Two pieces enclose a number if at most so many words lie between."""


class ReadingOrder:
    """Takes pieces of one text for those of the other."""

    def __init__(self, matching: Matching) -> None:
        self._matching = matching
        self._old, self._new = Side(matching.old, matching.there), Side(matching.new, matching.back)
        self._places = {id(here): Places(here, other) for here, other in self._both()}
        for here, other in self._both():
            self._join_halves(here, other)
        for first, last, start, end in matching.gaps():
            if self._old.lines(first, last) == self._new.lines(start, end) == 1:
                self._old.replaced.update(range(first, last))
                self._new.replaced.update(range(start, end))
        self._match_equal()
        for here, other in self._both():
            self._match_composed(here, other)
            self._match_enclosed(here, other)
        self._match_all_but_a_number()

    def _both(self) -> tuple[tuple[Side, Side], tuple[Side, Side]]:
        return (self._old, self._new), (self._new, self._old)

    def _join_halves(self, here: Side, other: Side) -> None:
        """A word parted at the end of a line, whose other half opens a line farther down, is whole there."""
        wholes: dict[str, list[int]] = {}
        for word in other.free():
            wholes.setdefault(other.text.texts[word], []).append(word)
        for words in map(here.text.of_line, range(1, len(here.text.lines) + 1)):
            if len(words) > 1 and here.text.texts[words[-1]] == "-" and here.there[words[-2]] < 0:
                self._join_half(here, words[-1], other, wholes)

    def _join_half(self, here: Side, hyphen: int, other: Side, wholes: dict[str, list[int]]) -> None:
        line, first = here.text.line_of[hyphen], hyphen - 1
        for words in map(here.text.of_line, range(line + 1, line + PAGE)):
            if not words or here.there[words[0]] >= 0:
                continue
            for whole in wholes.get(here.text.texts[first] + here.text.texts[words[0]], ()):
                apart = self._places[id(here)].apart(hyphen, other.text.line_of[whole])
                if other.there[whole] < 0 and apart <= PAGE:
                    here.halves.add(words[0])
                    self._release(here, hyphen, other)
                    return self._take(here, [first, hyphen, words[0]], [whole])
        return None

    @staticmethod
    def _release(here: Side, word: int, other: Side) -> None:
        """Let a word have no counterpart: a hyphen may have got that of another."""
        if here.there[word] >= 0:
            other.there[here.there[word]] = -1
        here.there[word] = -1

    def _match_equal(self) -> None:
        """Pieces that say the same: the longest first, each the nearest."""
        by_key: dict[str, list[Piece]] = {}
        for piece in self._new.pieces():
            by_key.setdefault(piece.key, []).append(piece)
        places = self._places[id(self._old)]
        for piece in sorted(self._old.pieces(), key=lambda piece: -len(piece.key)):
            others = places.near(piece.words[0], by_key.get(piece.key, ()))
            near = [other for other in others if self._may_be_one(piece, other, places)]
            if near and piece.key and self._old.is_free(piece.words):
                best = min(near, key=lambda other: places.apart(piece.words[0], other.line))
                self._take(self._old, piece.words, best.words)

    def _may_be_one(self, old: Piece, new: Piece, places: Places) -> bool:
        if not self._new.is_free(new.words):
            return False
        is_label = _LABEL.fullmatch(old.key) is not None
        is_line = old.is_whole or new.is_whole
        if old.is_inner or new.is_inner or not is_line:
            is_near = places.apart(old.words[0], new.line) <= _BESIDE
            return is_label and is_near and (is_line or old.is_cell or new.is_cell)
        if old.is_whole and new.is_whole:
            return is_label
        pieces = (self._new, new, self._old) if old.is_whole else (self._old, old, self._new)
        return not self._stands_instead(*pieces)

    @staticmethod
    def _stands_instead(here: Side, piece: Piece, other: Side) -> bool:
        """Whether an end of a line stands where the same line of the other text has something else."""
        for beside, step in ((piece.words.start - 1, 1), (piece.words.stop, -1)):
            if 0 <= beside < len(here.there) and here.text.line_of[beside] == piece.line and here.there[beside] >= 0:
                there = other.text.up_to_end(here.there[beside], step)
                return any(other.text.texts[word].isalnum() for word in there[1:])
        return False

    def _match_composed(self, here: Side, other: Side) -> None:
        """A line that was put together of pieces that stood apart."""
        parts = here.pieces()
        for whole in sorted(other.pieces(), key=lambda piece: -len(piece.key)):
            if whole.is_whole and other.is_free(whole.words):
                near = self._places[id(other)].near(whole.words[0], parts)
                inside = {
                    part.key: part
                    for part in near
                    if part.key in whole.key and _LABEL.fullmatch(part.key) and here.is_free(part.words)
                }
                composed = _composed(whole.key, inside, MOST)
                if len(composed) > 1:
                    self._take(here, [word for part in composed for word in part.words], whole.words)

    def _match_enclosed(self, here: Side, other: Side) -> None:
        """A number by itself that stands in both texts between the same two pieces, of which both moved."""
        parts = {(part.key, part.words.stop): part for part in here.pieces() if part.is_whole}
        for piece in other.pieces():
            if not piece.is_whole or not piece.words.start or piece.words.stop == len(other.there):
                continue
            ends = [(piece.words.start - 1, -1), (piece.words.stop, 1)]
            first, last = (other.there[word] for word, _ in ends)
            if first < 0 or not first < last <= first + _WITHIN or not self._have_moved(here, other, ends):
                continue
            inside = (parts.get((piece.key, stop)) for stop in range(first + 1, last + 1))
            same = next(
                (part for part in inside if part and part.words.start > first and here.is_free(part.words)), None
            )
            if same and other.is_free(piece.words):
                self._take(here, same.words, piece.words)

    def _have_moved(self, here: Side, other: Side, ends: list[tuple[int, int]]) -> bool:
        words = [word if other is self._old else other.there[word] for word, _ in ends]
        return self._matching.moved.issuperset(words)

    def _match_all_but_a_number(self) -> None:
        """A line that stands elsewhere on the page, with another number."""
        by_key: dict[str, list[Piece]] = {}
        for piece in self._new.pieces():
            if self._has_one_number(self._new, piece):
                by_key.setdefault(_NUMBER.sub("#", piece.key), []).append(piece)
        for piece in self._old.pieces():
            if self._has_one_number(self._old, piece) and self._old.is_free(piece.words):
                others = self._places[id(self._old)].near(piece.words[0], by_key.get(_NUMBER.sub("#", piece.key), ()))
                same = [other for other in others if self._new.is_free(other.words)]
                if len(set(same)) == 1 and len(same[0].words) == len(piece.words):
                    for old, new in zip(piece.words, same[0].words, strict=True):
                        if not self._old.text.texts[old].isdigit():
                            self._take(self._old, [old], [new])

    @staticmethod
    def _has_one_number(side: Side, piece: Piece) -> bool:
        numbers = sum(side.text.texts[word].isdigit() for word in piece.words)
        return (
            piece.is_whole and numbers == len(_NUMBER.findall(piece.key)) == 1 and _NAME.search(piece.key) is not None
        )

    def _take(self, here: Side, words: Sequence[int], others: Sequence[int]) -> None:
        olds, news = (words, others) if here is self._old else (others, words)
        self._matching.spread(olds, news)
        self._matching.moved.update(olds)


def _composed(key: str, parts: dict[str, Piece], most: int) -> list[Piece]:
    """Pieces that make up a key, one behind the other, each once; none if there are none."""
    for start, part in parts.items():
        if start == key:
            return [part]
        if start and most > 1 and key.startswith(start):
            others = {text: other for text, other in parts.items() if not set(other.words) & set(part.words)}
            if rest := _composed(key[len(start) :].lstrip(), others, most - 1):
                return [part, *rest]
    return []
