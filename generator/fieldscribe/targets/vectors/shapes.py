"""Points of the same shape: the first is tried in depth, the others only with what is their own."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.model import Limit

if TYPE_CHECKING:
    from collections.abc import Hashable

    from fieldscribe.model import Bound, Interval, Point

MANY = 3
"""So many intervals of a list are tried for every point."""


class Shapes:
    """The shapes met so far."""

    def __init__(self) -> None:
        self._met: set[Hashable] = set()

    def is_new(self, point: Point) -> bool:
        """Whether the point is the first of its shape."""
        shape = shape_of(point)
        new = shape not in self._met
        self._met.add(shape)
        return new


def shape_of(point: Point) -> Hashable:
    """The facts that decide how a point is computed: type, scale, special codes and the form of the limits."""
    specials = tuple((special.low, special.high, special.writable, special.no_value) for special in point.specials)
    limits = _limits(point.allowed.intervals)
    kind = point.type, point.width, point.access, point.fixed, point.encodes_values, point.decimals, point.most_raw
    named = point.digits.enum if point.digits is not None else point.enum
    enum = None if named is None else tuple((entry.raw, entry.name) for entry in named.entries)
    return (*kind, point.display, point.scale, specials, limits, enum, bool(point.flags), len(point.allowed.units))


def _limits(intervals: tuple[Interval, ...]) -> Hashable:
    """The forms of the limits; a long list counts with its numbers."""
    if len(intervals) > MANY:
        return intervals
    return tuple((_form(interval.low), _form(interval.high)) for interval in intervals)


def _form(bound: Bound) -> Hashable:
    return bound if isinstance(bound, Limit) else bound < 0
