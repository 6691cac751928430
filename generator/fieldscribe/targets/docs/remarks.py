"""The remarks in the rows of points, in the order of the table of facts: all that no other column says."""

from __future__ import annotations

from operator import attrgetter
from typing import TYPE_CHECKING

from fieldscribe.facts.points import POINT

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Mapping

    from fieldscribe.facts.table import Context, Fact
    from fieldscribe.model import Point

    RemarkOf = Callable[[Point], str]


class Remarks:
    """The remarks of the points of a device; what points share is worked out once.

    `encode` makes a text fit for a cell. `further` are remarks by the key of a fact that are finished cells; facts that
    have columns are left out.
    """

    def __init__(
        self, context: Context, encode: Callable[[str], str], further: Mapping[str, RemarkOf], columns: Collection[str]
    ) -> None:
        self._context, self._encode, self._further = context, encode, further
        facts = [fact for fact in POINT if (fact.remark or fact.key in further) and fact.key not in columns]
        places = list(enumerate(facts))
        self._shared = [(place, fact) for place, fact in places if fact.holder]
        self._own = [(place, fact) for place, fact in places if not fact.holder]
        self._own_values = attrgetter(*[fact.attribute or fact.key for _, fact in self._own])
        self._known: dict[tuple[int, int], list[tuple[int, str]]] = {}

    def of(self, point: Point) -> str:
        """Return the remarks of a point in one line."""
        values = zip(self._own, self._own_values(point), strict=True)
        own = self._remarks([placed for placed, value in values if value or value == 0], point)
        key = id(point.shape), id(point.terms)
        shared = self._known.get(key)
        if shared is None:
            shared = self._known[key] = self._remarks(self._shared, point)
        return "; ".join([remark for _, remark in (sorted(own + shared) if own else shared)])

    def _remarks(self, facts: list[tuple[int, Fact]], point: Point) -> list[tuple[int, str]]:
        remarks = [(place, self._remark(fact, point)) for place, fact in facts]
        return [(place, remark) for place, remark in remarks if remark]

    def _remark(self, fact: Fact, point: Point) -> str:
        further = self._further.get(fact.key)
        return self._encode(fact.remark_of(point, self._context)) if further is None else further(point)
