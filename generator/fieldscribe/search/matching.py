"""Searches words in the texts of entries; the nearest hits come first."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from functools import lru_cache
from operator import itemgetter

from fieldscribe.pasted_numbers import number_of
from fieldscribe.search.entries import Entry, Text

_FAULTS = frozenset({"error", "exception", "fault"})
"""Kinds of codes that people take for the same."""
_UMLAUTS = str.maketrans({"ä": "ae", "ö": "oe", "ü": "ue"})
_WORD = re.compile(r"\w+(?:[.-]\w+)*")
_WEIGHTS = {"name": 0, "code": 0, "section": 1, "number": 1, "title": 2, "old name": 3, "flag": 4, "group": 6}
_OTHER_WEIGHT = 5
_WHOLE, _WHOLE_WORD, _PREFIX, _INSIDE = 0, 10, 20, 30
"""Ranks of a match: the whole text, a word of it, the start of a word, some letters. The lower, the nearer."""
_LEAST_INSIDE = 3


@dataclass(frozen=True, slots=True)
class Hit:
    """An entry with all the words: the texts that have them, the nearest first, and a rank: the lower, the nearer."""

    entry: Entry
    texts: tuple[Text, ...]
    rank: int


def search(entries: Iterable[Entry], words: Sequence[str]) -> list[Hit]:
    """Return the entries that have all the words in any of their texts: the nearest first, else in their order."""
    queries = [_Query(word) for word in words]
    hits = [hit for entry in entries if (hit := _hit(entry, queries)) is not None]
    return sorted(hits, key=lambda hit: hit.rank)


def near_words(entries: Iterable[Entry], words: Sequence[str]) -> list[str]:
    """Return words of the entries that are similar to the given ones."""
    known: dict[str, str] = {}
    for entry in entries:
        for text in entry.texts:
            for word in _WORD.findall(text.text):
                known.setdefault(_folded(word)[0], word)
    close = [near for word in words for near in get_close_matches(_folded(word)[0][:60], list(known), 3, 0.7)]
    return list(dict.fromkeys(known[word] for word in close))


def _hit(entry: Entry, queries: Sequence[_Query]) -> Hit | None:
    best = []
    for query in queries:
        ranked = [(rank, text) for text in entry.texts if (rank := query.rank(entry, text)) is not None]
        if not ranked:
            return None
        best.append(min(ranked, key=itemgetter(0)))
    best.sort(key=itemgetter(0))
    return Hit(entry, tuple({id(text): text for _, text in best}.values()), sum(rank for rank, _ in best))


class _Query:
    """A word that is searched: folded, and the number that it may mean."""

    def __init__(self, word: str) -> None:
        kind, colon, rest = word.strip().partition(":")
        self.kind = kind.lower() if colon else ""
        self.number = number_of((rest if colon else word).strip())
        self.spellings = _folded(word)
        self.digits_only = bool(re.fullmatch(r"[0-9.]+", word))

    def rank(self, entry: Entry, text: Text) -> int | None:
        """Return the rank of a text; None if it does not have the word."""
        if self.kind and self.number is not None:
            return self._rank_of_number(entry, text)
        ranks = [rank for rank in map(self._rank, self.spellings, _folded(text.text)) if rank is not None]
        if text.kind == "number" and self.number == text.number:
            ranks.append(_WHOLE_WORD)
        return min(ranks) + _WEIGHTS.get(text.kind, _OTHER_WEIGHT) if ranks else None

    def _rank_of_number(self, entry: Entry, text: Text) -> int | None:
        """Rank `error:21h`, which is a code of that kind, or an entry of a list of faults."""
        if text.number != self.number:
            return None
        if entry.number is not None:
            if entry.kind == self.kind:
                return _WHOLE
            return _WHOLE + 1 if {entry.kind, self.kind} <= _FAULTS else None
        return _WHOLE_WORD if self.kind in _FAULTS and entry.lists_faults else None

    def _rank(self, word: str, text: str) -> int | None:
        if word == text:
            return _WHOLE
        if word not in text:
            return None
        parts = _parts(text)
        if word in parts:
            return _WHOLE_WORD
        start = f"{word}." if self.digits_only else word
        if any(part.startswith(start) for part in parts):
            return _PREFIX
        return _INSIDE if len(word) >= _LEAST_INSIDE and not self.digits_only else None


@lru_cache(maxsize=65536)
def _folded(text: str) -> tuple[str, str]:
    """Return the text without case and marks, with umlauts as `ae` and as `a`."""
    lowered = text.casefold().strip()
    if lowered.isascii():
        return lowered, lowered
    return _without_marks(lowered.translate(_UMLAUTS)), _without_marks(lowered)


def _without_marks(text: str) -> str:
    return "".join(char for char in unicodedata.normalize("NFKD", text) if not unicodedata.combining(char))


@lru_cache(maxsize=65536)
def _parts(text: str) -> frozenset[str]:
    """Return the words of a folded text, and their parts between underscores and dashes."""
    words = _WORD.findall(text)
    return frozenset([*words, *(part for word in words for part in re.split(r"[_-]", word) if part)])
