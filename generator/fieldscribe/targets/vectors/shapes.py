"""What many points share is tried in depth once; of each other point, only what tells it from its neighbours."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.model import Limit

if TYPE_CHECKING:
    from collections.abc import Hashable

    from fieldscribe.model import Bound, Interval, Point

MANY = 3
"""Intervals of a list that are tried one by one for every point."""


class Shapes:
    """The shapes that were met."""

    def __init__(self) -> None:
        self._met: set[Hashable] = set()

    def is_new(self, point: Point) -> bool:
        """Whether no point before had this shape; from now on one has."""
        shape = shape_of(point)
        new = shape not in self._met
        self._met.add(shape)
        return new


def shape_of(point: Point) -> Hashable:
    """The type, the scale, the special codes, and the form of the limits, but for numbers that are the point's own."""
    specials = tuple((one.low, one.high, one.writable, one.no_value) for one in point.specials)
    limits = _limits(point.allowed.intervals)
    kind = point.type, point.width, point.access, point.fixed, point.encodes_values, point.decimals, point.most_raw
    named = point.digits.enum if point.digits is not None else point.enum
    enum = None if named is None else tuple((entry.raw, entry.name) for entry in named.entries)
    return (*kind, point.display, point.scale, specials, limits, enum, bool(point.flags), len(point.allowed.units))


def _limits(intervals: tuple[Interval, ...]) -> Hashable:
    """A long list is part of the shape, numbers and all."""
    if len(intervals) > MANY:
        return intervals
    return tuple((_form(one.low), _form(one.high)) for one in intervals)


def _form(bound: Bound) -> Hashable:
    return bound if isinstance(bound, Limit) else bound < 0
