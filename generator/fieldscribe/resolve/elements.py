"""Sets and arrays: which points a row stands for if it has `sets`, `indices` or both."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.language.nodes import Map
from fieldscribe.resolve.point_facts import Element
from fieldscribe.resolve.values import integer, interval

if TYPE_CHECKING:
    from fieldscribe.resolve.point_facts import PointFacts
    from fieldscribe.resolve.scope import Scope

MOST_ELEMENTS = 4096
"""The most points that one row may stand for."""


def elements_of(scope: Scope, row: PointFacts) -> list[Element]:
    """Return the elements of a row, set by set and in each set index by index; none after a finding."""
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
    """The sets or the indices of a row: how many exist, which ones the row stands for, and their word in names."""

    count: int
    used: tuple[int | None, ...]
    word: str

    def suffix(self, number: int | None) -> str:
        return f"_{self.word}_{number}" if self.word else ""


def _axis(scope: Scope, row: PointFacts, plural: str, singular: str) -> _Axis | None:
    """Read `sets: 4`, `indices: 0..1`, or a lone `set: 2`; None after a finding."""
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
