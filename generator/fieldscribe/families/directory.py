"""Finds the points of a device by their addresses."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from fractions import Fraction

from fieldscribe.arithmetic.codec import setting_of
from fieldscribe.conditions import absent
from fieldscribe.families import family
from fieldscribe.model import Device, Place, Point

Where = tuple[str, int, int]
"""The space or the telegram, the address, and the index that travels with it (0 without one)."""

PointPlace = tuple["Point", "Place"]


class Directory:
    """The points of a device by address: those that are read there, and those that are written there."""

    def __init__(self, device: Device) -> None:
        self._at: dict[Where, list[PointPlace]] = {}
        self._points: dict[Where, list[Point]] = {}
        indexed = family(device.family).indexed
        # points that the chosen variants lack come last, so that present points win their places
        for point in sorted(device.points, key=lambda point: absent(point.when, device.variants)):
            for place in point.places:
                index = (point.index or 0) if point.space in indexed else 0
                for address in place.addresses:
                    here = self._at.setdefault((point.telegram or point.space, address, index), [])
                    if not (here and absent(point.when, device.variants)):
                        here.append((point, place))
        places: dict[str, set[tuple[tuple[int, ...], int | None]]] = {}
        for point in device.points:
            places.setdefault(point.name, set()).add((point.addresses, point.index))
        rules = {name for point in device.points for name in point.arguments}
        self._settings = {name for name in rules if len(places.get(name, ())) == 1}
        named = ((point.telegram or "", point) for point in device.points if point.addresses)
        self._firsts = {(telegram, point.name): point.addresses[0] for telegram, point in named}
        self._derived: dict[str, list[Point]] = {}
        for point in device.points:
            for name in point.changes_with:
                self._derived.setdefault(name, []).append(point)

    def places(self, where: str, address: int, index: int = 0) -> list[PointPlace]:
        """Return the points that have a word at this address, each with its place."""
        return self._at.get((where, address, index), [])

    def at(self, where: str, address: int, index: int = 0) -> list[Point]:
        """Return the points that have a word at this address."""
        place = where, address, index
        if place not in self._points and place in self._at:  # as many as the device has
            self._points[place] = list({point.item: point for point, _ in self._at[place]}.values())
        return self._points.get(place, [])

    def starting_at(self, where: str, address: int) -> list[PointPlace]:
        """Return the points whose lowest address is this, each with its place."""
        return [(point, place) for point, place in self.places(where, address) if min(place.addresses) == address]

    def first(self, telegram: str, name: str) -> int | None:
        """Return the first address of a point of the telegram; None if the telegram has no such point."""
        return self._firsts.get((telegram, name))

    def derived(self, name: str) -> list[Point]:
        """Return the points whose values the device computes again when the named point is written."""
        return self._derived.get(name, [])

    def settings(self, raws: Iterable[tuple[Point, int]]) -> Iterator[tuple[str, int | Fraction]]:
        """Yield the settings that raw numbers give to rules, without points whose variants have several places."""
        for point, raw in raws:
            if self.teaches(point):
                yield point.name, setting_of(point, raw)

    def teaches(self, point: Point) -> bool:
        """Return True if the raw number of a point is a setting that some rule needs."""
        return point.name in self._settings
