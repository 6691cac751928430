"""The words of one device. Points are read from them, so views of the same words always agree."""

from __future__ import annotations

from collections import ChainMap
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, MutableMapping
from decimal import Decimal
from fractions import Fraction
from functools import lru_cache
from random import Random
from threading import RLock
from typing import Protocol, TypeVar

from fieldscribe.arithmetic import codec
from fieldscribe.arithmetic.codec import CodecError, Settings, setting_of
from fieldscribe.arithmetic.texts import first_date, pattern_of_text, text_of
from fieldscribe.arithmetic.words import insert, joined, raw_of, with_fixed, words_of
from fieldscribe.conversation.encoding import read_value
from fieldscribe.conversation.selection import choose_point
from fieldscribe.diagnostics import RefusedError, UnclearError
from fieldscribe.model import Point
from fieldscribe.simulation.layout import Area, Cells, Layout

_ELECTRIC = {"voltage": 230, "current": 5, "frequency": 50, "power": 1000, "energy": 1000}
_USUAL = _ELECTRIC | {"temperature": 40, "ratio": 50, "rotational speed": 1500, "time": 10}
"""Typical measured values in the base unit of their quantity, for points without a usable range."""


_NUMBERS = 100
"""The highest start number of a point if neither its range nor its unit helps."""

_WIDE = 20_000
"""The width from which a range is just what the bits can hold."""


def starting_raw(layout: Layout, point: Point, settings: Settings, random: Random) -> int:
    """Return the raw number of a point at the start, given the settings that it depends on."""
    identifying, others = _identifying(layout, point)
    if identifying:
        return identifying[0]
    if point.default_raw is not None:
        return point.default_raw
    if point.text is not None:
        first = first_date(point.text) if point.text.parts else point.name[: point.text.characters]
        return 0 if point.text.is_bytes or first is None else pattern_of_text(point.text, first)
    try:
        if point.default is not None:
            return codec.encode(point, point.default, settings)
        found = (raw for raw in _candidates(layout, point, settings, random) if _allowed(point, raw, settings))
        return next(raw for raw in found if raw not in others)
    except (CodecError, StopIteration):
        return with_fixed(point, 0)


def _identifying(layout: Layout, point: Point) -> tuple[list[int], set[int]]:
    """Return the raw numbers of a point that identify this device, best first, and those of other variants."""
    accepted: list[list[int]] = []
    others: set[int] = set()
    for known in layout.device.identifications:
        if known.point == point.name:
            raws = [*known.raws, *(pattern_of_text(point.text, text) for text in known.texts if point.text is not None)]
            if known.variant is None or layout.variants[known.variant.axis] == known.variant.value:
                accepted.append(raws)
            else:
                others.update(raws)
    both = [raw for raw in accepted[0] if all(raw in raws for raws in accepted)] if accepted else []
    return sorted(both, key=lambda raw: (raw in others, raw != point.default_raw)), others


def corrected_raw(point: Point, raw: int, settings: Settings) -> int:
    """Return the raw number, or the nearest one that may be written with the present settings."""
    if _allowed(point, raw, settings) or point.info.floating or point.text is not None:
        return raw
    try:
        nearest = codec.nearest_allowed(point, raw, settings)
    except CodecError:
        nearest = None
    return raw if nearest is None else with_fixed(point, nearest)


def _allowed(point: Point, raw: int, settings: Settings) -> bool:
    try:
        codec.check(point, raw, settings)
    except CodecError:
        return False
    return True


def _candidates(layout: Layout, point: Point, settings: Settings, random: Random) -> Iterator[int]:
    """Yield raw numbers, the most plausible first."""
    if point.enum is not None:
        yield from (entry.raw for entry in point.enum.entries)
    if point.flags or point.digits is not None or point.width == 1 or point.name in layout.least:
        yield with_fixed(point, 0)
    usual = _USUAL.get(point.unit.quantity)
    if usual is not None:
        yield codec.encode(point, Fraction(usual), settings)
    for low, high in _ranges(point, settings):
        share = Fraction(random.randint(25, 75), 100)
        number = low + (high - low) * share
        yield codec.encode(point, Fraction(round(number)), settings) if point.info.floating else round(number)
        yield codec.encode(point, low, settings) if point.info.floating else int(low)


def _ranges(point: Point, settings: Settings) -> Iterator[tuple[Fraction, Fraction]]:
    """Yield the ranges of the point: in the unit for floating-point numbers, else in raw numbers."""
    if point.info.floating:
        yield from point.allowed.units or ((Fraction(0), Fraction(_NUMBERS)),)
    elif point.allowed.intervals:
        for low, high in ((window.low, window.high) for window in codec.windows(point, settings)):
            wide = high - low > _WIDE and low <= 0 <= high - _NUMBERS
            yield (Fraction(0), Fraction(_NUMBERS)) if wide else (Fraction(low), Fraction(high))
    else:
        yield Fraction(0), Fraction(min(_NUMBERS, point.greatest))


V = TypeVar("V")

LOCK = RLock()
"""Locks the memory for a request, or for values that a test reads or writes in another thread."""


class Memory:
    """A raw number for every point, kept as words (or bits) by area and address."""

    def __init__(self, layout: Layout, areas: Mapping[Area, Mapping[int, int]]) -> None:
        self.layout = layout
        self.areas: dict[Area, dict[int, int]] = {area: dict(words) for area, words in areas.items()}
        self.settings: Mapping[str, int | Fraction] = Lookup(layout.points, self._setting)
        """The settings that rules need, by point name: always as in the memory."""
        self.facts: Mapping[str, int | str] = Lookup(
            layout.names, lambda name: layout.variants.get(name) or self.raw(name)
        )
        """The operands of conditions: raw numbers by point name, values by variant axis."""

    @classmethod
    def started(cls, layout: Layout, seed: int = 0) -> Memory:
        """Return the memory of a device as delivered; numbers that no manual gives come from the seed."""
        with LOCK:
            first = _first(layout, seed)
        return cls(first.layout, first.areas)

    def raw(self, name: str) -> int:
        """Return the raw number of a point."""
        return self.layout.raw_reader(name)(self.areas)

    def put(self, name: str, raw: int) -> None:
        """Set the raw number of a point, whatever the rules say."""
        point = self.layout.points[name]
        self._put(point, self.layout.cells[name], raw)
        if point.write_place is not None:
            self._put(point, self.layout.written[name], raw)
        if name in self.layout.counts:
            self._lay_out({each: self.raw(each) for each in self.layout.counts})

    def _lay_out(self, counts: Mapping[str, int]) -> None:
        """Move the points that lie after counted elements; each keeps its number."""
        layout = self.layout.counted(counts)
        if layout is self.layout:
            return
        raws = {name: self.raw(name) for name, point in layout.points.items() if self.starts(point)}
        held, self.layout, self.areas = self.areas, layout, _empty(layout)
        for area, words in self.areas.items():
            words.update(
                (at, held[area][at])
                for at in words.keys() & held.get(area, {}).keys() - layout.fixed.get(area, {}).keys()
            )
        for name, raw in raws.items():
            self._put(layout.points[name], layout.cells[name], raw)

    def _setting(self, name: str) -> int | Fraction:
        return setting_of(self.layout.points[name], self.raw(name))

    def exists(self, point: Point) -> bool:
        """Return True if the condition of the point is true now."""
        return point.when is None or point.when.holds(self.facts)

    def held(self, area: Area, addresses: Iterable[int]) -> list[int]:
        """Return the cells at these addresses as a master sees them: windows show what is selected."""
        here, windows = self.areas.get(area, {}), self.layout.windows.get(area)
        if windows is None:
            return [here[address] for address in addresses]
        return [self._behind(here, windows.get(address, ()))[address] for address in addresses]

    def _behind(self, here: Mapping[int, int], window: Iterable[Point]) -> Mapping[int, int]:
        """Return the cells that a window shows now; those of the area if nothing is selected."""
        return next((self.areas[self.layout.cells[p.name].area] for p in window if self.exists(p)), here)

    def starts(self, point: Point) -> bool:
        """Return True if a point has a number from the start; in a window, whatever is selected first."""
        return point.when is None or point.when.holds(ChainMap(dict(point.selects), self.facts))  # type: ignore[arg-type]  # read only

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


def _empty(layout: Layout) -> dict[Area, dict[int, int]]:
    """Return the words of a device where no point has a number yet."""
    areas: dict[Area, dict[int, int]] = {area: dict(words) for area, words in layout.fixed.items()}
    for cells in (*layout.cells.values(), *layout.written.values()):
        for address in cells.addresses:
            areas.setdefault(cells.area, {}).setdefault(address, 0)
    for area, window in layout.windows.items():
        areas[area] = dict.fromkeys(window, 0) | areas.get(area, {})
    reached = [(area, address) for area, addresses in layout.steps.items() for address in addresses]
    for area, address in (*layout.commands, *reached):
        areas.setdefault(area, {}).setdefault(address, 0)
    return areas


@lru_cache(maxsize=64)
def _first(layout: Layout, seed: int) -> Memory:
    """Return the first memory; it is kept, so that a thousand devices of a kind start as quickly as one."""
    memory = Memory(layout, _empty(layout))
    for point in layout.order:
        if point.view_of is None and memory.starts(point):
            random = Random(f"{seed} {point.name}")  # noqa: S311  # no secret
            memory.put(point.name, starting_raw(layout, point, memory.settings, random))
    for point in layout.order:
        if point.writable and memory.starts(point):
            memory.put(point.name, corrected_raw(point, memory.raw(point.name), memory.settings))
    return memory


Value = str | int | float
"""A name of an enum or of a special code, a text, a whole number, or a number in the unit."""


class Plant(Protocol):
    """The quantities of a behaviour, which are no points."""

    @property
    def plant(self) -> Mapping[str, Fraction]:
        """The quantities by name."""

    def set(self, name: str, number: Fraction) -> None:
        """Set a quantity."""

    def touch(self) -> None:
        """Handle a write of points."""


class Values(MutableMapping[str, Value]):
    """The values by name or code; writing one ignores the rules, so a device may hold what it would refuse.

    It includes the quantities of a behaviour.
    """

    def __init__(self, memory: Memory, advance: Callable[[], None], plant: Plant | None = None) -> None:
        self._memory, self._advance, self._plant = memory, advance, plant

    def __getitem__(self, name: str) -> Value:
        with LOCK:
            self._go_on()
            if self._plant is not None and name in self._plant.plant:
                return _plain(self._plant.plant[name])
            point = self._point(name)
            return value_of(point, self._memory.raw(point.name), self._memory.settings)

    def __setitem__(self, name: str, value: Value | Fraction | Decimal) -> None:
        with LOCK:
            self._go_on()
            if self._plant is not None and name in self._plant.plant:
                self._plant.set(name, _number(name, value))
            else:
                point = self._point(name)
                self._memory.put(point.name, raw_for(point, value, self._memory.settings))
            self._go_on()

    def __delitem__(self, name: str) -> None:
        raise TypeError("a device has all of its points")

    def __iter__(self) -> Iterator[str]:
        return iter(self._memory.layout.points)

    def __len__(self) -> int:
        return len(self._memory.layout.points)

    def _go_on(self) -> None:
        """Update the memory to the present; afterwards evaluate the rules for what was written."""
        if self._plant is not None:
            self._plant.touch()
        self._advance()

    def _point(self, name: str) -> Point:
        points = self._memory.layout.points
        try:
            return points[name] if name in points else points[choose_point(self._memory.layout.device, name).name]
        except UnclearError as error:
            raise KeyError(f"{error.message}; {error.hint}".rstrip("; ")) from None


def value_of(point: Point, raw: int, settings: codec.Settings) -> Value:
    """Return the value of a raw number: a name, a text, or a number in the unit."""
    special = point.special(raw)
    if special is not None:
        return special.name
    if point.text is not None:
        try:
            return text_of(point.text, raw)
        except ValueError:
            return raw
    if point.enum is not None:
        return next((entry.name for entry in point.enum.entries if entry.raw == raw), raw)
    try:
        value = codec.decode(point, raw, settings)
    except CodecError:
        return codec.float_of(point, raw) if point.info.floating else raw
    return float(value) if point.info.floating else _plain(value)


def _number(name: str, value: Value | Fraction | Decimal) -> Fraction:
    """Return a number for a quantity. Raises ValueError for anything else."""
    try:
        return Fraction(value)
    except (ValueError, OverflowError, ZeroDivisionError):
        raise ValueError(f"{name} is a number, not {value}") from None


def _plain(value: Fraction) -> int | float:
    return int(value) if value.denominator == 1 else float(value)


def _is_coded(point: Point, raw: int) -> bool:
    """Return False for a number that the coding of a point cannot express."""
    words = words_of(point, raw) if point.bits is None else [insert(point, 0, raw)]
    return not point.coding or raw_of(point, words) == raw


def raw_for(point: Point, value: Value | Fraction | Decimal, settings: codec.Settings) -> int:
    """Return the raw number of a value. Raises ValueError if the bits cannot hold it, or the point has no such name."""
    try:
        if isinstance(value, str):
            typed = read_value(point, value)
            raw = typed.raw if typed.value is None else codec.encode(point, typed.value, settings)
        elif point.form in ("enum", "flags", "bit", "digits"):
            raw = int(value)
        else:
            raw = codec.encode(point, Fraction(value), settings)
    except UnclearError as error:
        raise ValueError(f"{error.message}; {error.hint}".rstrip("; ")) from None
    except (CodecError, OverflowError, RefusedError) as error:
        raise ValueError(f"{point.name} cannot hold {value}: {error}") from None
    if point.text is None and not (point.least <= raw <= point.greatest and _is_coded(point, raw)):
        span = f"{point.least}..{point.greatest}"
        raise ValueError(f"{point.name} cannot hold {value}: raw {raw} is outside {span}")
    return raw
