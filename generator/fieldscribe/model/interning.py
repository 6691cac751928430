"""Keeps one object of all equal ones, so that facts derived from it are worked out once."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.model.rules import Allowed, Interval

if TYPE_CHECKING:
    from fieldscribe.model.shape import Shape


class Interner:
    """The shapes and limits of a device's points, each kept once."""

    def __init__(self) -> None:
        self._shapes: dict[Shape, Shape] = {}
        self._allowed: dict[Allowed, Allowed] = {}
        self._intervals: dict[tuple[int, int], Allowed] = {}

    def shape(self, shape: Shape) -> Shape:
        """The first shape that is equal."""
        return self._shapes.setdefault(shape, shape)

    def interval(self, low: int, high: int) -> Allowed:
        """The limits of a single interval."""
        known = self._intervals.get((low, high))
        if known is None:
            known = self._intervals[low, high] = self.allowed(Allowed((Interval(low, high),), False, ()))
        return known

    def allowed(self, allowed: Allowed) -> Allowed:
        """The first limits that are equal."""
        return self._allowed.setdefault(allowed, allowed)
