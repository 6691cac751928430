# SPDX-License-Identifier: 0BSD
"""What a device is asked, in which order: the part of all devices that does no I/O and knows no bus.

Each operation is a generator: it yields what its family sends, is sent what came back, and returns a result. How words
travel is the family's part: a subclass with `get_steps` and `store_steps`.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Generator, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar

from .descriptors import PointAttribute
from .errors import AccessError
from .points import Decoding, Encoding, Point

if TYPE_CHECKING:
    from .facts import Place

T = TypeVar("T")
Steps = Generator[Any, Any, T]
"""What goes in and out between the steps is the family's own."""
Value = float | None
"""What reading numbers can give (also bool, IntEnum and IntFlag); None is "no value"."""

_KEPT = frozenset({"never", "rarely"})


class PointTable:
    """A device's points, with what its bus needs to know."""

    POINTS: ClassVar[Mapping[str, PointAttribute[Any, Any]]] = {}
    BLOCKS: ClassVar[Mapping[str, tuple[Any, ...]]] = {}
    """Planned reads by group, where the family plans."""
    VARIANTS: ClassVar[Mapping[str, tuple[str, ...]]] = {}

    def __init_subclass__(cls) -> None:
        points = {name: point for name, point in vars(cls).items() if isinstance(point, PointAttribute)}
        own = {point.facts.item: point for point in points.values() if point.new_name is None}
        cls.POINTS = {**cls.POINTS, **own}


class Session(PointTable, ABC):
    """The state of one device on a bus: its unit number, its variants, and what is remembered of it."""

    def __init__(self, unit: int, variants: Mapping[str, str | None]) -> None:
        for axis, value in variants.items():
            if axis not in self.VARIANTS:
                raise ValueError(f"the device has no variants by {axis!r}")
            if value is not None and value not in self.VARIANTS[axis]:
                raise ValueError(f"{axis} is one of {', '.join(self.VARIANTS[axis])}, not {value!r}")
        self.unit = unit
        self.variants = variants
        self._kept: dict[str, int] = {}

    @abstractmethod
    def get_steps(self, place: Place) -> Steps[tuple[int, ...]]:
        """Read the words or bits of a place, in ascending order of address."""

    @abstractmethod
    def store_steps(self, place: Place, values: tuple[int, ...]) -> Steps[None]:
        """Write words or bits at a place, in ascending order of address."""

    def gather_steps(self, points: Sequence[Point], group: str | None) -> Steps[dict[str, int]]:
        """Read the raw numbers of several points (of a whole `group`, where one is named), by item: place by place."""
        del group
        words: dict[Place, tuple[int, ...]] = {}
        raws: dict[str, int] = {}
        for point in points:
            at = point.facts.at
            if at not in words:
                words[at] = yield from self.get_steps(at)
            raws[point.facts.item] = self.taken(point, words[at])
        return raws

    def shared_word_steps(self, point: Point) -> Steps[int]:
        """The word that a bit group shares with others, as it is before the group is written."""
        if not isinstance(point, Decoding):
            raise AccessError(f"{point.label}: the other bits of its word cannot be read back")
        return (yield from self.get_steps(point.facts.at))[0]

    def forget(self) -> None:
        """Read everything anew that was remembered because it changes rarely or never."""
        self._kept.clear()

    def point(self, name: str) -> PointAttribute[Any, Any]:
        """A point by name, that of this device's variant; raises AccessError."""
        found = self.POINTS.get(name)
        if found is None:
            same = [point for point in self.POINTS.values() if point.facts.name == name]
            found = next((point for point in same if self._has(point)), None)
        if found is None:
            raise AccessError(f"{name} does not exist for {dict(self.variants)}")
        return found

    def require(self, point: Point) -> None:
        """Raises AccessError if the point belongs to another variant than the one given for this device."""
        axis, value = point.facts.variant or ("", None)
        if self.variants.get(axis, value) not in (value, None):
            raise AccessError(f"{point.label} exists only for {axis} {value}")
        axis, values = point.facts.only_for or ("", ())
        if self.variants.get(axis) not in (None, *values):
            raise AccessError(f"{point.label} exists only for {axis} {' or '.join(values)}")

    def _has(self, point: Point) -> bool:
        axis, values = point.facts.only_for or ("", ())
        exists = self.variants.get(axis) in (None, *values)
        variant = point.facts.variant
        return exists and (variant is None or self.variants.get(variant[0]) == variant[1])

    def read_raw_steps(self, point: Point) -> Steps[int]:
        """Read a point's raw number."""
        return self.taken(point, (yield from self.get_steps(point.facts.at)))

    def taken(self, point: Point, words: Sequence[int]) -> int:
        """The raw number in words that came; it is remembered if the description says when it changes."""
        raw = point.from_words(words)
        if point.facts.changes in _KEPT or point.facts.changes_with:
            self._kept[point.facts.item] = raw
        return raw

    def raws_steps(self, names: Iterable[str], known: Mapping[str, int]) -> Steps[dict[str, int]]:
        """The raw numbers of other points: those known (by item), those remembered, the rest read."""
        raws: dict[str, int] = {}
        for name in names:
            point = self.point(name)
            item = point.facts.item
            if item in known:
                raws[name] = known[item]
            elif item in self._kept:
                raws[name] = self._kept[item]
            else:
                raws[name] = yield from self.read_raw_steps(point)
        return raws

    def read_steps(self, point: Decoding[T]) -> Steps[T]:
        """Read a point's value."""
        raws = yield from self.raws_steps(point.scale_needs, {})
        raw = yield from self.read_raw_steps(point)
        return point.decode(raw, raws)

    def write_steps(self, point: Encoding[T], value: T, place: Place | None = None) -> Steps[None]:
        """Write a value, to another `place` than the usual one where one is named."""
        raws = yield from self.raws_steps(dict.fromkeys((*point.scale_needs, *point.limit_needs)), {})
        yield from self._write_steps(point, point.encode(value, raws), place)

    def write_raw_steps(self, point: Encoding[Any], raw: int, place: Place | None = None) -> Steps[None]:
        """Write a raw number that the range allows."""
        point.check(raw, (yield from self.raws_steps(point.limit_needs, {})))
        yield from self._write_steps(point, raw, place)

    def _write_steps(self, point: Point, raw: int, place: Place | None) -> Steps[None]:
        words = point.to_words(raw)
        if point.facts.bits is not None:
            words = (point.insert((yield from self.shared_word_steps(point)), raw),)
        yield from self.put_steps(place or point.facts.write_at or point.facts.at, words)

    def put_steps(self, place: Place, values: tuple[int, ...]) -> Steps[None]:
        """Write words or bits at a place, and forget what they change."""
        for item in list(self._kept):
            kept = self.POINTS[item].facts
            changing = [one.facts for one in self.POINTS.values() if one.facts.name in kept.changes_with]
            if any(place.overlaps(at) for facts in (kept, *changing) for at in (facts.at, facts.write_at) if at):
                del self._kept[item]
        yield from self.store_steps(place, values)

    def read_many_steps(self, what: str | Iterable[str | Point]) -> Steps[dict[str, Any]]:
        """Read a group, or any points, with as few requests as the device allows."""
        group = what if isinstance(what, str) else None
        points = self._group(what) if isinstance(what, str) else self._listed(what)
        needed = [self.point(name) for point in points for name in point.scale_needs]
        wanted: dict[str, Point] = {point.facts.item: point for point in points}
        wanted.update({point.facts.item: point for point in needed if point.facts.item not in self._kept})
        raws = yield from self.gather_steps(list(wanted.values()), group)
        values: dict[str, Any] = {}
        for point in points:
            known = yield from self.raws_steps(point.scale_needs, raws)
            values[point.facts.name] = point.decode(raws[point.facts.item], known)
        return values

    def _listed(self, what: Iterable[str | Point]) -> list[Decoding[Any]]:
        points: list[Decoding[Any]] = []
        for one in what:
            point = self.point(one if isinstance(one, str) else one.facts.item)
            self.require(point)
            if not isinstance(point, Decoding):
                raise AccessError(f"{point.label} cannot be read")
            points.append(point)
        return points

    def _group(self, group: str) -> list[Decoding[Any]]:
        members = [point for point in self.POINTS.values() if point.facts.group == group and self._has(point)]
        if not members:
            raise AccessError(f"there is no group {group}")
        return [point for point in members if isinstance(point, Decoding)]
