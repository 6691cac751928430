"""What the raw numbers of a point mean, apart from the point's identity: points that mean the same share a sheet.

The first of all that are computed alike is tried in depth, the others only with what is their own.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from fieldscribe.model import Limit

if TYPE_CHECKING:
    from collections.abc import Hashable

    from fieldscribe.model import Allowed, Bound, Enum, Interval, Point, Shape

MANY = 3
"""So many intervals of a list are tried for every point."""


@dataclass(frozen=True, slots=True, eq=False)
class Meaning:
    """All that the vectors of raw numbers follow from. They never see the point, so that nothing else can matter.

    `bits` are those of a group in its word. `order` names the words in ascending order of address, the high one being
    0; it is None if nobody knows the address. `symbol` is that of the unit where texts for people have it.
    """

    shape: Shape
    allowed: Allowed
    bits: tuple[int, int] | None
    order: tuple[int, ...] | None
    symbol: str

    @property
    def arguments(self) -> tuple[str, ...]:
        """The points whose raw numbers encoding, decoding or checking needs, in a fixed order."""
        scale, limits = self.shape.scale_arguments, self.allowed.arguments
        return tuple(dict.fromkeys((*scale, *limits))) if scale or limits else ()


class Meanings:
    """The meanings met so far, each once."""

    def __init__(self) -> None:
        self._met: dict[Hashable, Meaning] = {}
        self._first: dict[int, Shape] = {}
        self._alike: dict[Hashable, Shape] = {}
        self._computed: set[Hashable] = set()
        self._shapes: dict[int, int] = {}
        self._facts: dict[Hashable, int] = {}

    def of(self, point: Point) -> Meaning:
        """The meaning of a point's raw numbers. Its shape and its limits are compared as objects, which is quick."""
        shape, terms, addresses = self._like(point.shape), point.terms, point.place.addresses
        order = ascending(shape, addresses) if addresses else None
        symbol = terms.unit.symbol if shape.display is not None else ""
        key = id(shape), id(point.allowed), terms.bits, order, symbol
        meaning = self._met.get(key)
        if meaning is None:
            meaning = self._met[key] = Meaning(shape, point.allowed, terms.bits, order, symbol)
        return meaning

    def _like(self, shape: Shape) -> Shape:
        """The first shape that differs in nothing but the name of its enum, which no vector tells."""
        first = self._first.get(id(shape))
        if first is None:
            facts = replace(shape, enum=None), _entries(shape.enum), shape.enum is not None and shape.enum.closed
            first = self._alike.get(facts)
            if first is None:
                first = self._alike[facts] = shape
            self._first[id(shape)] = first
        return first

    def is_new(self, meaning: Meaning) -> bool:
        """Whether nothing was computed alike before."""
        number = self._shapes.get(id(meaning.shape))
        if number is None:
            facts = _facts(meaning.shape)
            number = self._shapes[id(meaning.shape)] = self._facts.setdefault(facts, len(self._facts))
        computed = number, _limits(meaning.allowed.intervals), len(meaning.allowed.units)
        new = computed not in self._computed
        self._computed.add(computed)
        return new


def ascending(shape: Shape, addresses: tuple[int, ...]) -> tuple[int, ...]:
    """The words of a number in ascending order of address; those that share one address have the high one first."""
    if len(addresses) == 1 and (shape.text is not None or shape.words == 1):
        return _ONE
    count = shape.words if shape.text is None else len(addresses)
    if len(addresses) != count:
        return tuple(range(count))
    return tuple(sorted(range(count), key=addresses.__getitem__))


_ONE = (0,)


def _facts(shape: Shape) -> Hashable:
    """The facts that decide how a point is computed, but for its limits: type, scale, special codes."""
    specials = tuple((special.low, special.high, special.writable, special.no_value) for special in shape.specials)
    kind = shape.type, shape.width, shape.access, shape.fixed, shape.encodes_values, shape.decimals, shape.most_raw
    enum = _entries(shape.digits.enum if shape.digits is not None else shape.enum)
    return (*kind, shape.display, shape.scale, specials, enum, bool(shape.flags))


def _entries(enum: Enum | None) -> tuple[tuple[int, str], ...] | None:
    return None if enum is None else tuple([(entry.raw, entry.name) for entry in enum.entries])


def _limits(intervals: tuple[Interval, ...]) -> Hashable:
    """The forms of the limits; a long list counts with its numbers."""
    if len(intervals) > MANY:
        return intervals
    return tuple([(_form(interval.low), _form(interval.high)) for interval in intervals])


def _form(bound: Bound) -> Hashable:
    return bound if isinstance(bound, Limit) else bound < 0
