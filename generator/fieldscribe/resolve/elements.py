"""Sets and arrays: rows of the manual that stand for one point in each parameter set, for each index, or both."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

from fieldscribe.language.nodes import Map
from fieldscribe.resolve.values import integer, interval

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fieldscribe.model import Titles
    from fieldscribe.resolve.point_facts import PointFacts
    from fieldscribe.resolve.scope import Scope

MOST_ELEMENTS = 4096
"""The most points that one row may stand for."""

_SET_WORDS = {"en": "set {}", "de": "{}. Parametersatz"}
_INDEX_WORDS = {"en": "index {}", "de": "Index {}"}


@dataclass(frozen=True, slots=True)
class Element:
    """One of the points that a row stands for.

    `set_number` and `index` tell which one, None where the row has no sets or indices; `sets` and `indices` tell how
    many there are. `counted` holds those of the keys `sets` and `indices` that the row has.
    """

    set_number: int | None
    sets: int
    index: int | None
    indices: int
    suffix: str
    counted: tuple[str, ...]

    def values(self, number: int) -> Mapping[str, Fraction]:
        """What an addressing rule may name; a point outside sets and arrays is in set 1, at index 1."""
        return {
            "number": Fraction(number),
            "index": Fraction(1 if self.index is None else self.index),
            "set": Fraction(1 if self.set_number is None else self.set_number),
            "sets": Fraction(self.sets),
            "indices": Fraction(self.indices),
        }

    @property
    def keys(self) -> tuple[str, ...]:
        """The keys under `each` that mean this element, the most exact first: `set/index`, `index`; or `set` alone."""
        if self.index is None:
            return () if self.set_number is None else (f"{self.set_number}",)
        by_index = (f"{self.index}",)
        return by_index if self.set_number is None else (f"{self.set_number}/{self.index}", *by_index)

    def titled(self, title: Titles) -> Titles:
        """The title of this element: that of the row, with its set and index."""
        words = [
            (words, number)
            for key, words, number in (("sets", _SET_WORDS, self.set_number), ("indices", _INDEX_WORDS, self.index))
            if key in self.counted and number is not None and self.suffix
        ]
        if not words:
            return title
        return {language: f"{text} ({_words_in(words, language)})" for language, text in title.items()}


def set_title(title: Titles, number: int) -> Titles:
    """The title of a point in a further set."""
    return {language: f"{text} ({_words_in([(_SET_WORDS, number)], language)})" for language, text in title.items()}


ALONE = Element(None, 1, None, 1, "", ())
"""The one element of a row without sets and indices."""


def elements_of(scope: Scope, row: PointFacts) -> list[Element]:
    """All points that the row stands for, set by set, in each set index by index; none after a finding."""
    rows = isinstance(row.get("sets"), Map)  # each further set has a row of its own
    sets = _Axis(1, (None,), "") if rows else _axis(scope, row, "sets", "set")
    indices = _axis(scope, row, "indices", "index")
    if sets is None or indices is None:
        return []
    if len(sets.used) * len(indices.used) > MOST_ELEMENTS:
        message = f"these are {len(sets.used) * len(indices.used)} points"
        key = "sets" if sets.word else "indices"
        scope.report.error("too-many-items", message, row.span(key), f"one row has at most {MOST_ELEMENTS}")
        return []
    counted = tuple(key for key in ("sets", "indices") if row.layer(key) is not None and not (rows and key == "sets"))
    return [
        Element(set_number, sets.count, index, indices.count, sets.suffix(set_number) + indices.suffix(index), counted)
        for set_number in sets.used
        for index in indices.used
    ]


@dataclass(frozen=True, slots=True)
class _Axis:
    """The sets or indices of a row: how many there are, which ones the row stands for, and their word in names."""

    count: int
    used: tuple[int | None, ...]
    word: str

    def suffix(self, number: int | None) -> str:
        return f"_{self.word}_{number}" if self.word else ""


def _axis(scope: Scope, row: PointFacts, plural: str, singular: str) -> _Axis | None:
    """`sets: 4`, `indices: 0..1`, or `set: 2` alone; None after a finding."""
    own_number: int | None = row.get(singular)
    raw = row.get(plural)
    if raw is None:
        return _Axis(1, (own_number,), "")
    span, text = row.span(plural), str(raw)
    if ".." in text:
        ends = interval(text, span, scope.report)
    else:
        count = integer(raw, span, scope.report)
        ends = None if count is None else (1, count)
    if ends is None:
        return None
    low, high = ends
    if low < 0 or high < low or high - low >= 65536:
        message = f"`{plural}: {text}` is no count of elements, or too many"
        scope.report.error("wrong-choice", message, span, f"write a count, or an interval such as `{plural}: 0..1`")
        return None
    if own_number is None:
        used = range(low, min(high, low + MOST_ELEMENTS) + 1)
        return _Axis(high - low + 1, tuple(used), singular)
    if not low <= own_number <= high:
        message = f"there is no {singular} {own_number} in {low}..{high}"
        scope.report.error("wrong-choice", message, row.span(singular), f"correct `{singular}` or `{plural}`")
        return None
    return _Axis(high - low + 1, (own_number,), "")


def _words_in(words: list[tuple[dict[str, str], int]], language: str) -> str:
    return ", ".join(texts.get(language, texts["en"]).format(number) for texts, number in words)
