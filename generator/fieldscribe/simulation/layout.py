"""The words of each point of a device by area; all devices of a kind share one layout."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import NamedTuple

from fieldscribe.arithmetic.words import mask_of, reader_of, split
from fieldscribe.conditions import absent
from fieldscribe.conversation.selection import at_bases, choose_variants
from fieldscribe.diagnostics import UnclearError
from fieldscribe.families import family
from fieldscribe.model import Base, Command, Device, Place, Point
from fieldscribe.text import shortened

Area = tuple[str, int]
"""A space or a telegram, and the index if one is sent with the address (else 0)."""

_LAST = 0xFFFF
_BEHIND_HEAD = 2
"""The words of a found block that its length does not count: its id and its length."""


class Cells(NamedTuple):
    """The place of a point: an area, and its addresses there, high part first; one cell holds `size` words."""

    area: Area
    addresses: tuple[int, ...]
    size: int


RawReader = Callable[[Mapping[Area, Mapping[int, int]]], int]
"""Returns the raw number of a point from words by area and address."""


def joined_cells(numbers: list[int], size: int) -> int:
    """Return the numbers of cells that hold `size` words each as one number, the high one first."""
    pattern = 0
    for number in numbers:
        pattern = pattern << 16 * size | number & mask_of(16 * size)
    return pattern


def _raw_reader(point: Point, cells: Cells) -> RawReader:
    area, addresses, size = cells
    read, first = reader_of(point), addresses[0]
    if size > 1:
        return lambda areas: read(split(joined_cells([areas[area][at] for at in addresses], size), point.words))
    if len(addresses) > 1:
        return lambda areas: read([areas[area][at] for at in addresses])
    return lambda areas: read((areas[area][first],))


class Layout:
    """The points of one kind of device, each with its cells.

    `device` has the points of one value of each variant axis (the first, unless `variants` chooses another), at the
    addresses for the `given` numbers (the least by default); found chains start at the first of their places.
    `fixed` are words that belong to no point, such as the ids of found blocks. `counts` are the numbers of points
    that count the elements of a block before other points; 0 by default.
    """

    def __init__(
        self,
        device: Device,
        variants: Iterable[str] = (),
        given: Mapping[str, int] | None = None,
        counts: Mapping[str, int] | None = None,
    ) -> None:
        self._made_of = device, tuple(variants), given
        self.counts = {name: 0 for base in device.bases for name, _, _ in base.counts} | dict(counts or {})
        chosen = {axis: f"{axis}={values[0]}" for axis, values in device.variants.items()}
        chosen |= {choice.partition("=")[0]: choice for choice in variants}
        device = choose_variants(device, chosen.values())
        self.fixed: dict[Area, dict[int, int]] = {}
        starts = {each.name: each.low for each in device.given} | self._chain(device, given or {}) | dict(given or {})
        self.device, others = at_bases(device, [f"{name}={number}" for name, number in starts.items()])
        if others:
            known = ", ".join(each.name for each in device.given) or "none"
            raise UnclearError(f"no address depends on `{shortened(others[0])}`", f"given numbers: {known}")
        self.family = family(device.family)
        self.variants = {axis: values[0] for axis, values in self.device.variants.items()}
        existing = (point for point in self.device.points if not absent(point.when, self.device.variants))
        self.points: Mapping[str, Point] = {point.name: point for point in existing}
        """The points by name, as rules name them."""
        self.names = self.points.keys() | self.variants
        """The names in conditions: points and variant axes."""
        self.cells: dict[str, Cells] = {}
        """The cells to read each point."""
        self.written: dict[str, Cells] = {}
        """The cells to write each writable point."""
        self.readers: dict[Area, dict[int, tuple[Point, ...]]] = {}
        """The points in each cell that can be read."""
        self.writers: dict[Area, dict[int, tuple[Point, ...]]] = {}
        """The points in each cell that can be written."""
        self.windows: dict[Area, dict[int, tuple[Point, ...]]] = {}
        """The points at a cell only while others select them; each selection has an area of its own."""
        self._selections: dict[tuple[tuple[str, int], ...], int] = {(): 0}
        for point in self.points.values():
            self._place(point)
        self.commands: dict[tuple[Area, int], Command] = {
            ((command.space, 0), command.address): command for command in self.device.commands
        }
        self.steps: dict[Area, set[int]] = {}
        """The cells that steps of commands reach; if no point is there, they hold what was written."""
        for step in [step for command in self.device.stepped_commands for step in command.steps]:
            reached = range(step.address, step.address + len(step.words))
            self.steps.setdefault((step.space, 0), set()).update(reached)
        self.least = {
            factor.point
            for point in self.points.values()
            for case in point.scale or ()
            for factor in case.rule.factors
            if factor.ten_to
        }
        """The points that start at their lowest number: exponents of ten, and times of the line."""
        times = set(self.device.bus.timing.values())
        self.least.update(point.name for point in self.points.values() if {point.name, point.code} & times)
        self.order = tuple(_in_order(self.points))
        """The points, each after those that its scale, its limits and its condition need."""
        self.readable = {area: self._readable(area) for area in (*self.readers, *self.fixed, *self.steps)}
        """The cells that can be read."""
        self._raws: dict[str, RawReader] = {}

    def counted(self, counts: Mapping[str, int]) -> Layout:
        """Return the layout with these counts; this one if they are the same, or its words had no addresses then."""
        if counts == self.counts:
            return self
        try:
            made = Layout(*self._made_of, counts)
        except UnclearError:
            return self
        return made if all(max(words, default=0) <= _LAST for words in made.fixed.values()) else self

    def raw_reader(self, name: str) -> RawReader:
        """Return the function that returns the raw number of a point from words; it is made once."""
        if name not in self._raws:
            self._raws[name] = _raw_reader(self.points[name], self.cells[name])
        return self._raws[name]

    def _readable(self, area: Area) -> frozenset[int]:
        readers = self.readers.get(area, {})
        readable = (at for at, points in readers.items() if any(point.access != "w" for point in points))
        words = self.fixed.get(area, {}).keys() | self.steps.get(area, set())
        return frozenset(readable) | (words - readers.keys())

    def _place(self, point: Point) -> None:
        name = point.name
        cells = self._cells(point, point.place)
        written = cells if point.write_place is None else self._cells(point, point.write_place)
        for of, shared in ((self.readers, cells), (self.writers, written)):
            self._share(of, shared, point)
        if point.selects:
            self._share(self.windows, cells, point)
            space, number = cells.area[0], self._selections.setdefault(point.selects, len(self._selections))
            cells, written = cells._replace(area=(space, number)), written._replace(area=(space, number))
        self.cells[name], self.written[name] = cells, written

    @staticmethod
    def _share(of: dict[Area, dict[int, tuple[Point, ...]]], cells: Cells, point: Point) -> None:
        points = of.setdefault(cells.area, {})
        for address in cells.addresses:
            points[address] = (*points.get(address, ()), point)

    def _cells(self, point: Point, place: Place) -> Cells:
        if not place.addresses:
            return Cells((f"point {point.name}", 0), tuple(range(point.words)), 1)
        index = point.index or 0 if point.space in self.family.indexed else 0
        size = -(-point.words // len(place.addresses))
        return Cells((point.telegram or point.space, index), place.addresses, size)

    def _chain(self, device: Device, given: Mapping[str, int]) -> dict[str, int]:
        """Lay the blocks of a found chain one after the other; return the start of each by the name of its base."""
        if device.found is None:
            return {}
        words = self.fixed.setdefault((device.found.space, 0), {})
        place = device.found.places[0]
        words.update(enumerate(device.found.words, place))
        place += len(device.found.words)
        starts: dict[str, int] = {}
        for base in device.bases:
            if base.block is None:
                continue
            if base.starts_block:
                starts[base.name] = place
                length = self._length(device, base)
                if self.counts:
                    words.update(dict.fromkeys(range(place, place + length), 0))  # the elements that are counted
                words[place], words[place + 1] = base.block, length - _BEHIND_HEAD
                place += length
        words[place], words[place + 1] = device.found.end, 0
        for base in device.bases:  # after the first part of a block: at its counts
            if base.block is not None and not base.starts_block:
                first = next(each for each in device.bases if each.starts_block and each.block == base.block)
                starts[base.name] = given.get(first.name, starts[first.name]) + self._offset(base)
        return starts

    def _offset(self, base: Base) -> int:
        """Return where a base is in its block."""
        return base.offset + sum(self.counts[name] * factor for name, _, factor in base.counts)

    def _length(self, device: Device, base: Base) -> int:
        """Return the number of words of a found block: up to its last point."""
        last = 0
        for each in device.bases:
            if each.block == base.block:
                points = (point for point in device.points if point.base == each.name)
                last = max(last, max((self._offset(each) + max(point.addresses) for point in points), default=0))
        return last + 1


def _in_order(points: Mapping[str, Point]) -> Iterator[Point]:
    done: set[str] = set()

    def visit(point: Point) -> Iterator[Point]:
        if point.name in done:
            return
        done.add(point.name)
        for name in (*point.arguments, *(point.when.names if point.when is not None else ())):
            if name in points:
                yield from visit(points[name])
        yield point

    for point in points.values():
        yield from visit(point)
