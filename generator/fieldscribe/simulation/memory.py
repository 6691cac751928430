"""The words of one device. Points are read from the words, so that views, twins and bit groups always agree."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping
from fractions import Fraction
from random import Random
from threading import RLock
from typing import TypeVar

from fieldscribe.arithmetic.codec import setting_of
from fieldscribe.arithmetic.words import insert, joined, words_of
from fieldscribe.model import Point
from fieldscribe.simulation.layout import Area, Cells, Layout
from fieldscribe.simulation.starting import corrected_raw, starting_raw

V = TypeVar("V")

LOCK = RLock()
"""Held while a request is answered, and while a test reads or writes values from another thread."""


class Memory:
    """A raw number for every point, kept as words (or bits) by area and address."""

    def __init__(self, layout: Layout, areas: Mapping[Area, Mapping[int, int]]) -> None:
        self.layout = layout
        self.areas: dict[Area, dict[int, int]] = {area: dict(words) for area, words in areas.items()}
        self.settings: Mapping[str, int | Fraction] = Lookup(layout.points, self._setting)
        """The settings that rules compute with, by the name of the point: always what the memory holds now."""
        self.facts: Mapping[str, int | str] = Lookup(
            layout.names, lambda name: layout.variants.get(name) or self.raw(name)
        )
        """What conditions compare: raw numbers by the name of the point, values by variant axis."""

    @classmethod
    def started(cls, layout: Layout, seed: int = 0) -> Memory:
        """Return the memory of a device as delivered; what no manual says follows from the seed."""
        return cls(layout, _start(layout, seed))

    def raw(self, name: str) -> int:
        """Return the raw number of a point."""
        return self.layout.raw_reader(name)(self.areas)

    def put(self, name: str, raw: int) -> None:
        """Let a point hold a raw number, whatever the rules say."""
        point = self.layout.points[name]
        self._put(point, self.layout.cells[name], raw)
        if point.write_place is not None:
            self._put(point, self.layout.written[name], raw)

    def _setting(self, name: str) -> int | Fraction:
        return setting_of(self.layout.points[name], self.raw(name))

    def exists(self, point: Point) -> bool:
        """Return True if the condition of the point holds now."""
        return point.when is None or point.when.holds(self.facts)

    def _put(self, point: Point, cells: Cells, raw: int) -> None:
        held = self.areas[cells.area]
        if point.bits is not None:
            held[cells.addresses[0]] = insert(point, held[cells.addresses[0]], raw)
        elif cells.size == 1:
            held.update(zip(cells.addresses, words_of(point, raw), strict=True))
        else:
            held[cells.addresses[0]] = joined(words_of(point, raw))


class Lookup(Mapping[str, V]):
    """Numbers by name, read from the memory when they are needed."""

    def __init__(self, names: Collection[str], get: Callable[[str], V]) -> None:
        self._names, self._get = names, get

    def __getitem__(self, name: str) -> V:
        return self._get(name)

    def __contains__(self, name: object) -> bool:
        return name in self._names

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)


_starts: dict[tuple[int, int], tuple[Layout, dict[Area, dict[int, int]]]] = {}
"""The first words by layout and seed, so that a thousand devices of a kind start as quickly as one."""
_MOST_STARTS = 64


def _start(layout: Layout, seed: int) -> dict[Area, dict[int, int]]:
    key = id(layout), seed
    with LOCK:
        if key not in _starts:
            while len(_starts) >= _MOST_STARTS:
                del _starts[next(iter(_starts))]
            _starts[key] = layout, _first_words(layout, seed)
        return _starts[key][1]


def _first_words(layout: Layout, seed: int) -> dict[Area, dict[int, int]]:
    areas: dict[Area, dict[int, int]] = {area: dict(words) for area, words in layout.fixed.items()}
    for cells in (*layout.cells.values(), *layout.written.values()):
        for address in cells.addresses:
            areas.setdefault(cells.area, {}).setdefault(address, 0)
    reached = [(area, address) for area, addresses in layout.steps.items() for address in addresses]
    for area, address in (*layout.commands, *reached):
        areas.setdefault(area, {}).setdefault(address, 0)
    memory = Memory(layout, areas)
    for point in layout.order:
        if point.view_of is None and memory.exists(point):
            random = Random(f"{seed} {point.name}")  # noqa: S311  # no secret
            memory.put(point.name, starting_raw(layout, point, memory.settings, random))
    for point in layout.order:
        if point.writable and memory.exists(point):
            memory.put(point.name, corrected_raw(point, memory.raw(point.name), memory.settings))
    return memory.areas
