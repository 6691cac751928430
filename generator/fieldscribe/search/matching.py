"""Finds words in everything that descriptions name, the nearest hits first."""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

from fieldscribe.pasted_numbers import number_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from fieldscribe.search.entries import Fact, Thing

_FAULTS = frozenset({"error", "exception", "fault"})
"""Kinds of codes that people take for the same."""
_SPELLED = str.maketrans({"ä": "ae", "ö": "oe", "ü": "ue"})
_WORDS = re.compile(r"\w+(?:[.-]\w+)*")
_WEIGHTS = {"name": 0, "code": 0, "section": 1, "number": 1, "title": 2, "old name": 3, "flag": 4, "group": 6}
_OTHER = 5
_WHOLE, _WORD, _BEGINNING, _INSIDE = 0, 10, 20, 30
"""How near a match is: the text itself, a word of it, the beginning of a word, some letters."""
_LEAST_INSIDE = 3


@dataclass(frozen=True, slots=True)
class Hit:
    """A thing with all the words: the facts that have them, the nearest first. The lower the rank, the nearer."""

    thing: Thing
    facts: tuple[Fact, ...]
    rank: int


def search(things: Iterable[Thing], words: Sequence[str]) -> list[Hit]:
    """The things that have all the words, in any of their texts; the nearest first, else in their order."""
    asked = [_Asked(word) for word in words]
    hits = [hit for thing in things if (hit := _hit(thing, asked)) is not None]
    return sorted(hits, key=lambda hit: hit.rank)


def near_words(things: Iterable[Thing], words: Sequence[str]) -> list[str]:
    """Words of the descriptions that are like one that is asked for."""
    from difflib import get_close_matches

    known: dict[str, str] = {}
    for thing in things:
        for fact in thing.facts:
            for word in _WORDS.findall(fact.text):
                known.setdefault(_folded(word)[0], word)
    close = [near for word in words for near in get_close_matches(_folded(word)[0][:60], list(known), 3, 0.7)]
    return list(dict.fromkeys(known[word] for word in close))


class _Asked:
    """A word that is asked for: folded, and the number that it may mean."""

    def __init__(self, word: str) -> None:
        kind, colon, rest = word.strip().partition(":")
        self.kind = kind.lower() if colon else ""
        self.number = number_of((rest if colon else word).strip())
        self.spellings = _folded(word)
        self.digits_only = bool(re.fullmatch(r"[0-9.]+", word))

    def rank(self, thing: Thing, fact: Fact) -> int | None:
        """How near a fact is; None if it does not have the word."""
        if self.kind and self.number is not None:
            return self._numbered(thing, fact)
        near = [
            nearness for nearness in map(self._nearness, self.spellings, _folded(fact.text)) if nearness is not None
        ]
        if fact.kind == "number" and self.number == fact.number:
            near.append(_WORD)
        return min(near) + _WEIGHTS.get(fact.kind, _OTHER) if near else None

    def _numbered(self, thing: Thing, fact: Fact) -> int | None:
        """`error:21h` is a code of that kind, or an entry of a list of faults."""
        if fact.number != self.number:
            return None
        if thing.number is not None:
            if thing.kind == self.kind:
                return _WHOLE
            return _WHOLE + 1 if {thing.kind, self.kind} <= _FAULTS else None
        return _WORD if self.kind in _FAULTS and thing.tells_faults else None

    def _nearness(self, word: str, text: str) -> int | None:
        if word == text:
            return _WHOLE
        if word not in text:
            return None
        parts = _parts(text)
        if word in parts:
            return _WORD
        beginning = f"{word}." if self.digits_only else word
        if any(part.startswith(beginning) for part in parts):
            return _BEGINNING
        return _INSIDE if len(word) >= _LEAST_INSIDE and not self.digits_only else None


def _hit(thing: Thing, asked: Sequence[_Asked]) -> Hit | None:
    total, facts = 0, []
    for word in asked:
        ranked = [(rank, fact) for fact in thing.facts if (rank := word.rank(thing, fact)) is not None]
        if not ranked:
            return None
        rank, fact = min(ranked, key=lambda entry: entry[0])
        total += rank
        facts.append((rank, fact))
    facts.sort(key=lambda entry: entry[0])
    return Hit(thing, tuple({id(fact): fact for _, fact in facts}.values()), total)


@lru_cache(maxsize=65536)
def _folded(text: str) -> tuple[str, str]:
    """The text without case, its umlauts written out (`ae`), and without any marks (`a`)."""
    lowered = text.casefold().strip()
    if lowered.isascii():
        return lowered, lowered
    spelled, plain = (unicodedata.normalize("NFKD", form) for form in (lowered.translate(_SPELLED), lowered))
    return (
        "".join(char for char in spelled if not unicodedata.combining(char)),
        "".join(char for char in plain if not unicodedata.combining(char)),
    )


@lru_cache(maxsize=65536)
def _parts(text: str) -> frozenset[str]:
    """The words of a folded text, those between underscores and dashes, too."""
    words = _WORDS.findall(text)
    return frozenset([*words, *(part for word in words for part in re.split(r"[_-]", word) if part)])
