"""Facts that follow from the YAML of a point, computed once for all points whose YAML is the same."""

from collections.abc import Callable, Hashable
from decimal import Decimal
from typing import Generic, TypeVar

from fieldscribe.diagnostics import Report
from fieldscribe.language.keys import identifying_keys, keys_of
from fieldscribe.language.keys.places import POINT, SOURCE
from fieldscribe.language.nodes import Map, Seq
from fieldscribe.resolve.point_facts import PointFacts

Fact = TypeVar("Fact")

_IDENTITY = identifying_keys(POINT) | {*keys_of(SOURCE), "source", "lines", "note", "was", "write_at", "each"}
"""Keys that identify or annotate a point: no shape, scale or limit depends on them."""

_NUMBERS = frozenset(("range", "range_in_units", "default", "default_in_units"))
"""Keys of which only the presence counts, because each point has its own number there."""


class FactKeys:
    """Numbers kinds of points: those of a kind state the same facts, except for identity and numbers of limits."""

    def __init__(self) -> None:
        self._keys: dict[Hashable, int] = {}
        self._layers: dict[int, Hashable] = {}

    def of(self, point: PointFacts) -> int:
        """Return the kind of a point. A point with a variant or with findings is a kind of its own."""
        if point.variant is not None or point.failed:
            stated: Hashable = point
        else:
            first, *others = point.layers
            shared = tuple(map(self._shared, others)) if others else ()
            stated = id(point.group), first is point.node, bool(point.hidden), _stated(first), shared
        return self._keys.setdefault(stated, len(self._keys))

    def _shared(self, layer: Map) -> Hashable:
        """Return what a shared layer states, such as a format."""
        if id(layer) not in self._layers:
            self._layers[id(layer)] = _stated(layer)
        return self._layers[id(layer)]


def _stated(layer: Map) -> Hashable:
    return tuple(
        [
            key if key in _NUMBERS else (key, value if value.__class__ is str else hashable(value))
            for key, value in layer.items()
            if key not in _IDENTITY
        ]
    )


def hashable(value: object) -> Hashable:
    """Return a YAML value as a hashable one, equal for equal texts."""
    if isinstance(value, Map):
        return (*value.broken, *[(key, hashable(inner)) for key, inner in value.items()])
    if isinstance(value, Seq):
        return tuple(map(hashable, value))
    return str(value) if isinstance(value, Decimal) else (value.__class__, value)


class Memo(Generic[Fact]):
    """Remembers a fact by what it follows from. A fact with a finding is computed again for every point."""

    def __init__(self, report: Report) -> None:
        self._report = report
        self._known: dict[Hashable, Fact] = {}

    def of(
        self,
        key: Hashable,
        point: PointFacts,
        work: Callable[[PointFacts], Fact],
        general: Callable[[Fact], bool] = lambda _: True,
    ) -> Fact:
        """Return the fact of a point; `general` says whether it holds for all points with the key."""
        known = self._known.get(key)
        if known is not None:
            return known
        before = self._report.count
        fact = work(point)
        sound = self._report.count == before and not point.failed and not self._report.full
        if sound and general(fact):
            self._known[key] = fact
        return fact
