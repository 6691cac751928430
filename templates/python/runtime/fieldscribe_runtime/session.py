# SPDX-License-Identifier: 0BSD
"""What a device is asked, in which order: the part of all devices that does no I/O and knows no bus.

Each operation is a generator: it yields what its family sends, is sent what came back, and returns a result. How words
travel is the family's part: a subclass with `_get_steps` and `_store_steps`.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Generator, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar

from .arguments import check_name, shown
from .commands import Command
from .descriptors import ByVariant, PointAttribute, Renamed
from .errors import (
    AbsentError,
    AccessError,
    EchoError,
    FieldscribeError,
    RequestError,
)
from .lookup import find, is_code, nearest
from .points import Decoding, Encoding, Point
from .rules import NO_RAWS
from .special import Special

if TYPE_CHECKING:
    from .facts import Documented, Place
    from .rules import Raws

T = TypeVar("T")
Steps = Generator[Any, Any, T]
"""What goes in and out between the steps is the family's own."""
Value = float | str | tuple[int, ...] | Special
"""What reading a point can give (also bool, IntEnum and IntFlag)."""

_NEVER = "never"
_KEPT = frozenset({_NEVER, "rarely"})
_LISTED = 4
"""So many points of one request are listed in an error."""


@contextmanager
def about(*points: Point) -> Iterator[None]:
    """What goes wrong meanwhile says which point was asked for, or which ones one request reads."""
    try:
        yield
    except FieldscribeError as error:
        more = f" and {len(points) - _LISTED} more" if len(points) > _LISTED else ""
        error.point = error.point or ", ".join([one.label for one in points[:_LISTED]]) + more
        raise


@contextmanager
def _needing(point: Point, other: Point) -> Iterator[None]:
    """What goes wrong while another point is read says which one was asked for, and that it needs the other."""
    try:
        with about(other):
            yield
    except FieldscribeError as error:
        error.point, error.needs = point.label, error.needs or error.point
        raise


@contextmanager
def _of_group(group: str | None) -> Iterator[None]:
    """What goes wrong meanwhile says of which group."""
    try:
        yield
    except FieldscribeError as error:
        error.group = group
        raise


def check_unit(unit: int, units: tuple[int, int]) -> None:
    """Raises RequestError (bad_unit) for a unit number that the device cannot have."""
    low, high = units
    if isinstance(unit, bool) or not isinstance(unit, int) or not low <= unit <= high:
        raise RequestError("bad_unit", f"the device can be unit {low} to {high}, not {shown(unit)}")


def check_variants(axes: Mapping[str, tuple[str, ...]], variants: Mapping[str, str | None]) -> None:
    """Raises RequestError (bad_variant) for an axis or a value that the device has not."""
    for axis, value in variants.items():
        if axis not in axes:
            known = f", only by {', '.join(axes)}" if axes else ""
            raise RequestError("bad_variant", f"the device has no variants by {axis!r}{known}")
        if value is not None and value not in axes[axis]:
            raise RequestError("bad_variant", f"{axis} is one of {', '.join(axes[axis])}, not {shown(value)}")


def exists(point: Point, variants: Mapping[str, str | None]) -> bool:
    """Whether the variants that are told have a point; one of a variant needs it told."""
    axis, values = point.facts.only_for or ("", ())
    left = variants.get(axis) in (None, *values)
    variant = point.facts.variant
    return left and (variant is None or variants.get(variant[0]) == variant[1])


class PointTable:
    """A device's points, with what its bus needs to know."""

    POINTS: ClassVar[Mapping[str, PointAttribute[Any, Any]]] = {}
    BLOCKS: ClassVar[Mapping[str, tuple[Any, ...]]] = {}
    """Planned reads by group, where the family plans."""
    VARIANTS: ClassVar[Mapping[str, tuple[str, ...]]] = {}
    DOCUMENTED: ClassVar[Mapping[str, Documented]] = {}
    """Points that are no attributes, by name, with the reason."""

    OLD_NAMES: ClassVar[Mapping[str, Renamed]] = {}
    """What points were called before."""

    if not TYPE_CHECKING:  # type checkers report names that do not exist

        def __getattr__(self, name: str) -> Any:
            """Say why a point that the manual has is no attribute, or not of this device."""
            found = next((vars(kind)[name] for kind in type(self).__mro__ if name in vars(kind)), None)
            if hasattr(found, "__get__"):
                return found.__get__(self, type(self))  # an AttributeError came from there: it comes again as it was
            documented = type(self).DOCUMENTED.get(name)
            message = f"{type(self).__name__!r} object has no attribute {name!r}"
            raise AttributeError(
                message if documented is None else f"{name} is documented only: {documented}", name=name, obj=self
            )

    def __init_subclass__(cls) -> None:
        points = [point for point in vars(cls).values() if isinstance(point, PointAttribute)]
        cls.POINTS = {**cls.POINTS, **{point.facts.item: point for point in points}}
        renamed = {name: alias for name, alias in vars(cls).items() if isinstance(alias, Renamed)}
        cls.OLD_NAMES = {**cls.OLD_NAMES, **renamed}


class Session(PointTable, ABC):
    """The state of one device on a bus: its unit number, its variants, and what is remembered of it."""

    def __init__(self, unit: int, variants: Mapping[str, str | None]) -> None:
        check_variants(self.VARIANTS, variants)
        self.unit = unit
        self.variants = variants
        self._kept: dict[str, int] = {}

    def __repr__(self) -> str:
        known = "".join(f", {axis} {value}" for axis, value in self.variants.items() if value is not None)
        return f"<{type(self).__name__} unit {self.unit}{known}>"

    @abstractmethod
    def _get_steps(self, place: Place) -> Steps[tuple[int, ...]]:
        """Read the words or bits of a place, in ascending order of address."""

    @abstractmethod
    def _store_steps(self, place: Place, values: tuple[int, ...]) -> Steps[None]:
        """Write words or bits at a place, in ascending order of address."""

    def _gather_steps(self, points: Sequence[Point], group: str | None) -> Steps[dict[str, int]]:
        """Read the raw numbers of several points (of a whole `group`, where one is named), by item: place by place."""
        del group
        words: dict[Place, tuple[int, ...]] = {}
        raws: dict[str, int] = {}
        for point in points:
            at = point.facts.at
            if at not in words:
                with about(point):
                    words[at] = yield from self._get_steps(at)
            raws[point.facts.item] = self._taken(point, words[at])
        return raws

    def _shared_word_steps(self, point: Point) -> Steps[int]:
        """The word that a bit group shares with others, as it is before the group is written."""
        if not isinstance(point, Decoding):
            raise AccessError("the other bits of its word cannot be read back")
        return (yield from self._get_steps(point.facts.at))[0]

    def forget(self) -> None:
        """Read everything anew that was remembered because it changes rarely or never."""
        self._kept.clear()

    def _resolved(self, what: Any) -> PointAttribute[Any, Any]:
        """A point by name, old name or code, that of this device's variant; raises AccessError."""
        check_name("point", what)
        name = what
        if (old := self.OLD_NAMES.get(what)) is not None:
            old.warn(stacklevel=4)
            name = old.new_name.rstrip("_")
        found = self._found(name)
        if found is not None:
            return found
        coded = find(self.POINTS.values(), what)
        points = [point for point in coded if self._has(point)] or coded
        if len({point.facts.name for point in points}) > 1:
            raise AccessError(f"{what} means several points: {', '.join(point.facts.item for point in points)}")
        if len(points) != 1:
            name = points[0].facts.name if points else name
            raise AccessError(f"{name} {self._absence(name)}")
        return points[0]

    def _named(self, name: str) -> list[PointAttribute[Any, Any]]:
        """The points of that name, one for each variant that has its own."""
        return [point for point in self.POINTS.values() if point.facts.name == name]

    def _found(self, name: str) -> PointAttribute[Any, Any] | None:
        return self.POINTS.get(name) or next((point for point in self._named(name) if self._has(point)), None)

    def _absence(self, name: str) -> str:
        """Why there is no such point, or not yet."""
        axes = [point.facts.variant[0] for point in self._named(name) if point.facts.variant]
        if not axes:
            return self._other_meaning(name)
        if self.variants.get(axes[0]) is None:
            return f"depends on {axes[0]}: pass it when the device is made"
        return f"does not exist for {axes[0]} {self.variants[axes[0]]}"

    def _other_meaning(self, name: str) -> str:
        """What a name is that no point has as its own: a documented point, a command, a group, or one like others."""
        for documented, facts in self.DOCUMENTED.items():
            if name in (documented, documented.rstrip("_")) or is_code(facts.code, name):
                return f"is documented only{'' if documented == name else f', as {documented}'}: {facts}"
        if isinstance(getattr(type(self), name, None), Command):
            return f"is a command of this device: {name}.send() gives it"
        if name in self._groups():
            return f"is a group of this device: read_many({name!r}) reads it"
        near = nearest([*self.POINTS.values()], name)
        return "is no point of this device" + (f"; did you mean {' or '.join(near)}?" if near else "")

    def _groups(self) -> list[str]:
        return list(dict.fromkeys([point.facts.group for point in self.POINTS.values() if point.facts.group]))

    def _meant_by_group(self, group: str) -> str:
        """What may be meant where there is no such group."""
        if self._found(group) is not None or find(self.POINTS.values(), group):
            return f"; it is a point: read_many([{group!r}]) reads it"
        return f", only {', '.join(self._groups())}"

    def _needed(self, point: Point, name: str) -> PointAttribute[Any, Any]:
        """The point that another one needs; raises AccessError that says so."""
        found = self._found(name)
        if found is None:
            raise AccessError(f"{point.label} needs {name}, which {self._absence(name)}")
        return found

    def _require(self, point: Point) -> None:
        """Raises AccessError if the point belongs to another variant than the one given for this device."""
        axis, value = point.facts.variant or ("", None)
        if self.variants.get(axis, value) not in (value, None):
            raise AbsentError(f"{point.label} exists only for {axis} {value}")
        axis, values = point.facts.only_for or ("", ())
        if self.variants.get(axis) not in (None, *values):
            raise AbsentError(f"{point.label} exists only for {axis} {' or '.join(values)}")

    def _has(self, point: Point) -> bool:
        return exists(point, self.variants)

    def _surely_has(self, point: Point) -> bool:
        """Whether the point is there for all that is known: no condition is open."""
        axis, _ = point.facts.only_for or ("", ())
        known = not axis or self.variants.get(axis) is not None
        return known and not point.facts.uncertain and self._has(point)

    def _read_raw_steps(self, point: Point) -> Steps[int]:
        """Read a point's raw number."""
        with about(point):
            return self._taken(point, (yield from self._get_steps(point.facts.at)))

    def _taken(self, point: Point, words: Sequence[int]) -> int:
        """The raw number in words that came; it is remembered if the description says when it changes."""
        raw = point.from_words(words)
        if point.facts.changes in _KEPT or point.facts.changes_with:
            self._kept[point.facts.item] = raw
        return raw

    def _raws_steps(
        self, point: Point, names: Iterable[str], known: Mapping[str, int] = NO_RAWS, *, writes: bool = False
    ) -> Steps[dict[str, int]]:
        """The raw numbers that a point needs of others: those known (by item), those remembered, the rest read.

        What is written must not follow from a number that has changed meanwhile, by another master or by hand: then
        only what never changes is taken from memory.
        """
        raws: dict[str, int] = {}
        for name in names:
            other = self._needed(point, name)
            item = other.facts.item
            if item in known:
                raws[name] = known[item]
            elif item in self._kept and (not writes or other.facts.changes == _NEVER):
                raws[name] = self._kept[item]
            else:
                with _needing(point, other):
                    raws[name] = yield from self._read_raw_steps(other)
        return raws

    def _read_steps(self, point: Decoding[T]) -> Steps[T]:
        """Read a point's value."""
        raws = yield from self._raws_steps(point, point.scale_needs)
        raw = yield from self._read_raw_steps(point)
        return point.decode(raw, raws)

    def _write_steps(self, point: Encoding[T], value: T, place: Place | None = None) -> Steps[None]:
        """Write a value, to another `place` than the usual one where one is named."""
        point.require(value)
        needs = dict.fromkeys((*point.scale_needs, *point.limit_needs))
        raws = yield from self._raws_steps(point, needs, writes=True)
        yield from self._put_raw_steps(point, point.encode(value, raws), place, raws)

    def _write_raw_steps(self, point: Encoding[Any], raw: int, place: Place | None = None) -> Steps[None]:
        """Write a raw number that the range allows."""
        point.require_raw(raw)
        raws = yield from self._raws_steps(point, point.limit_needs, writes=True)
        point.check(raw, raws)
        yield from self._put_raw_steps(point, raw, place, raws)

    def _put_raw_steps(self, point: Point, raw: int, place: Place | None, raws: Raws) -> Steps[None]:
        """Write a raw number that was checked; raises EchoError if the device confirms another one."""
        words = point.to_words(raw)
        with about(point):
            if point.facts.bits is not None:
                words = (point.insert((yield from self._shared_word_steps(point)), raw),)
            try:
                yield from self._put_steps(place or point.facts.write_at or point.facts.at, words)
            except EchoError as error:
                if point.facts.bits is not None or len(error.answered) != point.size:
                    raise
                answered = point.from_words(error.answered)
                if not point.same(raw, answered):
                    text = f"{point.told(raw, raws)} was written, and the device answered {point.told(answered, raws)}"
                    raise EchoError(text, error.written, error.answered) from None

    def _put_steps(self, place: Place, values: tuple[int, ...]) -> Steps[None]:
        """Write words or bits at a place, and forget what they change."""
        for item in list(self._kept):
            kept = self.POINTS[item].facts
            changing = [one.facts for one in self.POINTS.values() if one.facts.name in kept.changes_with]
            if any(place.overlaps(at) for facts in (kept, *changing) for at in (facts.at, facts.write_at) if at):
                del self._kept[item]
        yield from self._store_steps(place, values)

    def _read_many_steps(self, what: str | Iterable[str | Point]) -> Steps[dict[str, Value]]:
        """Read a group, or any points, with as few requests as the device allows.

        Of a group those points are left out that do not travel the way the link is set.
        """
        group = what if isinstance(what, str) else None
        points = self._group(what) if isinstance(what, str) else self._listed(what)
        with _of_group(group):
            return (yield from self._values_steps(points, group))

    def _values_steps(self, points: Sequence[Decoding[Any]], group: str | None) -> Steps[dict[str, Value]]:
        """The values of points, by name, and before them what their scales need."""
        needed = [self._needed(point, name) for point in points for name in point.scale_needs]
        wanted: dict[str, Point] = {point.facts.item: point for point in points}
        wanted.update({point.facts.item: point for point in needed if point.facts.item not in self._kept})
        raws = yield from self._gather_steps(list(wanted.values()), group)
        values: dict[str, Value] = {}
        for point in points:
            known = yield from self._raws_steps(point, point.scale_needs, raws)
            values[point.facts.name] = point.decode(raws[point.facts.item], known)
        return values

    def _listed(self, what: Iterable[str | Point]) -> list[Decoding[Any]]:
        if isinstance(what, (Point, bytes, bytearray)) or not isinstance(what, Iterable):
            raise AccessError(f"takes the name of a group, or a list of points and their names, not {shown(what)}")
        points: list[Decoding[Any]] = []
        for one in what:
            point = self._own(one)
            self._require(point)
            if not isinstance(point, Decoding):
                raise AccessError(f"{point.label} cannot be read")
            points.append(point)
        return points

    def _own(self, one: Any) -> PointAttribute[Any, Any]:
        """The point that a caller means by a name, a code, or a point of this device."""
        if isinstance(one, ByVariant):
            same = getattr(type(self), one.name, None) is one
            return self._resolved(one.name.rstrip("_") if same else one)
        if not isinstance(one, Point):
            return self._resolved(one)
        point = self._resolved(one.facts.item)
        if one.facts is not point.facts or getattr(one, "_device", self) is not self:
            raise AccessError(f"{one.label} is a point of another device")
        return point

    def _group(self, group: str) -> list[Decoding[Any]]:
        check_name("group", group)
        members = [point for point in self.POINTS.values() if point.facts.group == group and self._has(point)]
        if not members:
            raise AccessError(f"there is no group {group}{self._meant_by_group(group)}")
        return [point for point in members if isinstance(point, Decoding) and self._travels(point)]

    def _travels(self, point: Point) -> bool:
        """Whether the link carries a point, and all that its scale needs."""
        needed = [self._found(name) for name in point.scale_needs]
        return all(self._carried(one) for one in (point, *needed) if one is not None)

    def _carried(self, point: Point) -> bool:
        """Whether the words of a point travel the way the link is set; families say where that differs."""
        del point
        return True
