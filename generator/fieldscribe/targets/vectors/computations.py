"""How the raw numbers of a point are computed, apart from its identity: equal computations share their vectors.

Of all points that are computed by the same rules, the first gets vectors in depth, the others only their own numbers.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from fieldscribe.model import Limit

if TYPE_CHECKING:
    from collections.abc import Hashable

    from fieldscribe.model import Allowed, Bound, Enum, Interval, Point, Shape

MANY = 3
"""The number of intervals of a list that are tried for every point."""


@dataclass(frozen=True, slots=True, eq=False)
class Computation:
    """All facts that vectors of raw numbers depend on. Their code never sees the point, so nothing else can matter.

    `bits` are those of a group in its word. `order` names the words in ascending order of address, the high one being
    0; it is None without an address. `symbol` is the unit's where a displayed text contains it.
    """

    shape: Shape
    allowed: Allowed
    bits: tuple[int, int] | None
    order: tuple[int, ...] | None
    symbol: str

    @property
    def arguments(self) -> tuple[str, ...]:
        """The names of the points whose raw numbers encoding, decoding or checking needs, in a fixed order."""
        scale, limits = self.shape.scale_arguments, self.allowed.arguments
        return tuple(dict.fromkeys((*scale, *limits))) if scale or limits else ()


class Computations:
    """The different computations of a device, each once."""

    def __init__(self) -> None:
        self._met: dict[Hashable, Computation] = {}
        self._first: dict[int, Shape] = {}
        self._alike: dict[Hashable, Shape] = {}
        self._computed: set[Hashable] = set()
        self._shapes: dict[int, int] = {}
        self._facts: dict[Hashable, int] = {}

    def of(self, point: Point) -> Computation:
        """Return the computation of a point; points whose shape and limits are the same objects share it."""
        shape, terms, addresses = self._like(point.shape), point.terms, point.place.addresses
        order = ascending(shape, addresses) if addresses else None
        symbol = terms.unit.symbol if shape.display is not None else ""
        key = id(shape), id(point.allowed), terms.bits, order, symbol
        computation = self._met.get(key)
        if computation is None:
            computation = self._met[key] = Computation(shape, point.allowed, terms.bits, order, symbol)
        return computation

    def _like(self, shape: Shape) -> Shape:
        """Return the first shape that is equal but for the name of its enum, which no vector contains."""
        first = self._first.get(id(shape))
        if first is None:
            facts = replace(shape, enum=None), _entries(shape.enum), shape.enum is not None and shape.enum.closed
            first = self._alike.get(facts)
            if first is None:
                first = self._alike[facts] = shape
            self._first[id(shape)] = first
        return first

    def is_new(self, computation: Computation) -> bool:
        """Return True the first time that these rules occur."""
        number = self._shapes.get(id(computation.shape))
        if number is None:
            facts = _facts(computation.shape)
            number = self._shapes[id(computation.shape)] = self._facts.setdefault(facts, len(self._facts))
        computed = number, _limits(computation.allowed.intervals), len(computation.allowed.units)
        new = computed not in self._computed
        self._computed.add(computed)
        return new


def ascending(shape: Shape, addresses: tuple[int, ...]) -> tuple[int, ...]:
    """Return the words of a number in ascending order of address; words at one address have the high one first."""
    if len(addresses) == 1 and (shape.text is not None or shape.words == 1):
        return _ONE
    count = shape.words if shape.text is None else len(addresses)
    if len(addresses) != count:
        return tuple(range(count))
    return tuple(sorted(range(count), key=addresses.__getitem__))


_ONE = (0,)


def _facts(shape: Shape) -> Hashable:
    """Return the facts that decide how a point is computed, except its limits: type, scale, special codes."""
    specials = tuple((special.low, special.high, special.writable, special.no_value) for special in shape.specials)
    kind = shape.type, shape.width, shape.access, shape.fixed, shape.encodes_values, shape.decimals, shape.most_raw
    enum = _entries(shape.digits.enum if shape.digits is not None else shape.enum)
    return (*kind, shape.display, shape.scale, specials, enum, bool(shape.flags))


def _entries(enum: Enum | None) -> tuple[tuple[int, str], ...] | None:
    return None if enum is None else tuple([(entry.raw, entry.name) for entry in enum.entries])


def _limits(intervals: tuple[Interval, ...]) -> Hashable:
    """Return the forms of the limits; a long list is its own form."""
    if len(intervals) > MANY:
        return intervals
    return tuple([(_form(interval.low), _form(interval.high)) for interval in intervals])


def _form(bound: Bound) -> Hashable:
    return bound if isinstance(bound, Limit) else bound < 0
