"""Points whose YAML says the same facts: what follows from them is worked out for the first, and holds for the rest."""

from __future__ import annotations

from decimal import Decimal
from typing import TYPE_CHECKING, Generic, TypeVar

from fieldscribe.language.keys import keys_of, own
from fieldscribe.language.keys.places import POINT, SOURCE
from fieldscribe.language.nodes import Map, Seq

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable

    from fieldscribe.diagnostics import Report
    from fieldscribe.resolve.point_facts import PointFacts

Fact = TypeVar("Fact")

_IDENTITY = own(POINT) | {*keys_of(SOURCE), "source", "lines", "note", "was", "write_at", "each"}
"""What tells one point from another, and decides about nothing else."""

_NUMBERS = frozenset(("range", "range_in_units", "default", "default_in_units"))
"""Keys that points of one kind have alike, with numbers of their own."""


class Kinds:
    """Tells which points are alike: a number for each kind of them."""

    def __init__(self) -> None:
        self._kinds: dict[Hashable, int] = {}
        self._known: dict[int, Hashable] = {}

    def of(self, draft: PointFacts) -> int:
        """The kind of a point: that of all whose facts are the same, but for identity and the numbers of their limits.

        A point that varies, or has findings, is like no other.
        """
        if draft.variant is not None or draft.failed:
            facts: Hashable = draft
        else:
            first, *others = draft.layers
            shared = tuple(map(self._shared_facts, others)) if others else ()
            facts = id(draft.group), first is draft.own, bool(draft.hidden), _facts(first), shared
        return self._kinds.setdefault(facts, len(self._kinds))

    def _shared_facts(self, layer: Map) -> Hashable:
        """The facts of a layer that many points have, such as a format."""
        if id(layer) not in self._known:
            self._known[id(layer)] = _facts(layer)
        return self._known[id(layer)]


def _facts(layer: Map) -> Hashable:
    return tuple(
        [
            key if key in _NUMBERS else (key, value if value.__class__ is str else frozen(value))
            for key, value in layer.items()
            if key not in _IDENTITY
        ]
    )


def frozen(value: object) -> Hashable:
    """A YAML value as something that compares: equal for equal texts."""
    if isinstance(value, Map):
        return (*value.broken, *[(key, frozen(inner)) for key, inner in value.items()])
    if isinstance(value, Seq):
        return tuple(map(frozen, value))
    return str(value) if isinstance(value, Decimal) else (value.__class__, value)


class Once(Generic[Fact]):
    """Facts by what they follow from, each worked out once; but what has a finding is worked out for every point."""

    def __init__(self, report: Report) -> None:
        self._report = report
        self.known: dict[Hashable, Fact] = {}

    def of(
        self, kind: Hashable, draft: PointFacts, work: Callable[[PointFacts], Fact], general: Callable[[Fact], bool]
    ) -> Fact:
        """The fact of a point; `general` tells whether it is that of all points of its kind."""
        known = self.known.get(kind)
        if known is not None:
            return known
        before = self._report.count
        fact = work(draft)
        sound = self._report.count == before and not draft.failed and not self._report.full
        if sound and general(fact):
            self.known[kind] = fact
        return fact
