"""The device as generated code may know it: names as titles, no notes, no places in the manual, no reasons for errata.

Titles and notes change often. They reach only the documentation, so that vendored code stays the same when they do.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, replace
from functools import lru_cache
from typing import Any, Generic, TypeVar

from fieldscribe.model import (
    Code,
    Device,
    Entry,
    Enum,
    Erratum,
    FamilyFacts,
    Interner,
    Point,
    ScaleCase,
    Shape,
    Source,
    Terms,
    Titles,
)
from fieldscribe.text import humanised

Made = TypeVar("Made")
_NOWHERE = Source("", None, None, None)
_NO_NOTE: Titles = {}


def for_code(device: Device) -> Device:
    """Return the device without anything that is only for people."""
    points, errata, enums = _last.of(device, _parts)
    return replace(
        device,
        title={},
        note={},
        documents=(),
        bus=replace(
            device.bus,
            note={},
            timing={},
            serial={},
            functions=_without_texts(device.bus.functions),
            exceptions=_without_texts(device.bus.exceptions),
            family_facts=device.bus.family_facts and _family_facts(device.bus.family_facts),
        ),
        groups=_without_texts(device.groups),
        points=points,
        enums=tuple(map(enums.of, device.enums)),
        commands=_without_texts(device.commands),
        stepped_commands=_without_texts(device.stepped_commands),
        frames=_without_texts(device.frames),
        errata=errata,
        messages=_without_texts(device.messages),
        telegrams=_without_texts(device.telegrams),
        given=_without_texts(device.given),
        found=None if device.found is None else _without_texts((device.found,))[0],
    )


def has_same_points(first: Device, second: Device) -> bool:
    """Return True if two devices share their points and errata."""
    return first.points is second.points and first.errata is second.errata


class DeviceCache(Generic[Made]):
    """Keeps the results for the last devices; `same` decides whether two devices have the same result."""

    def __init__(self, same: Callable[[Device, Device], bool], most: int = 1) -> None:
        self.kept: list[tuple[Device, Made]] = []
        self._same, self._most = same, most

    def of(self, device: Device, make: Callable[[Device], Made]) -> Made:
        """Return the kept result for a device; make it if there is none."""
        for known, made in tuple(self.kept):
            if self._same(known, device):
                return made
        self.kept[:] = [(device, make(device)), *self.kept[: self._most - 1]]
        return self.kept[0][1]


_Parts = tuple[tuple[Point, ...], tuple[Erratum, ...], "_Enums"]
_last: DeviceCache[_Parts] = DeviceCache(has_same_points)


def _parts(device: Device) -> _Parts:
    """Return the points and errata of a device as code may know them, and its enums."""
    enums, interner = _Enums(), Interner()  # shapes that differed in titles only become one
    shapes = {id(shape): shape for shape in (point.shape for point in device.points)}
    shapes = {key: interner.shape(_shape(shape, enums)) for key, shape in shapes.items()}
    terms = {id(terms): terms for terms in (point.terms for point in device.points)}
    terms = {key: _terms(terms) for key, terms in terms.items()}
    points = tuple([_point(point, shapes[id(point.shape)], terms[id(point.terms)]) for point in device.points])
    errata = tuple([replace(erratum, why="", where="", source=_NOWHERE) for erratum in device.errata])
    return points, errata, enums


def _without_texts(things: tuple[Any, ...]) -> tuple[Any, ...]:
    """Return the things with their names as titles, without notes and places in the manual."""
    empty = {"note": {}, "source": _NOWHERE}
    return tuple(
        replace(thing, title=_title(thing.name), **{key: empty[key] for key in empty if hasattr(thing, key)})
        for thing in things
    )


def _family_facts(facts: FamilyFacts) -> FamilyFacts:
    """Return the facts of one family, its codes with their names as titles."""
    values = {field.name: getattr(facts, field.name) for field in fields(facts)}
    codes = {name: held for name, held in values.items() if held and isinstance(held, tuple) and type(held[0]) is Code}
    return replace(facts, **{name: _without_texts(held) for name, held in codes.items()})


def _point(point: Point, shape: Shape, terms: Terms) -> Point:
    """Return a point as code may know it. A new field of a point reaches code only if it is named here."""
    return Point(
        point.name,
        point.variant,
        point.code,
        _title(point.item),
        _NO_NOTE,
        _NOWHERE,
        point.place,
        point.write_place,
        shape,
        terms,
        point.allowed,
        point.default,
        point.default_raw,
        None,
        point.set,
        point.index,
        point.was,
        point.errata,
        point.enum_names,
    )


def _terms(terms: Terms) -> Terms:
    """Return terms as code may know them. A new field reaches code unless it is cleared here."""
    return replace(
        terms,
        unit=replace(terms.unit, name="", quantity=""),
        since=None if terms.since is None and terms.until is None else "",  # code only learns that there is one
        until=None,
        untyped=None if terms.untyped is None else "",
        view_of=None,
        certainty=None,
    )


def _shape(shape: Shape, enums: _Enums) -> Shape:
    """Return a shape as code may know it. A new field reaches code unless it is cleared here."""
    digits = shape.digits
    return replace(
        shape,
        scale=shape.scale and tuple([ScaleCase(case.point, case.raw, case.rule) for case in shape.scale]),
        enum=shape.enum and enums.of(shape.enum),
        digits=digits and replace(digits, enum=enums.of(digits.enum)),
        flags=tuple(
            replace(flag, title=_title(flag.name), values=tuple(map(_entry, flag.values))) for flag in shape.flags
        ),
        specials=tuple(replace(special, title=_title(special.name)) for special in shape.specials),
    )


class _Enums:
    """The enums of a device as code sees them; those that share their entries still do."""

    def __init__(self) -> None:
        self._entries: dict[int, tuple[Entry, ...]] = {}

    def of(self, enum: Enum) -> Enum:
        """Return an enum with names as titles."""
        known = self._entries.get(id(enum.entries))
        if known is None:
            known = self._entries[id(enum.entries)] = tuple(map(_entry, enum.entries))
        return Enum(enum.name, known, enum.closed, enum.was)


def _entry(entry: Entry) -> Entry:
    return Entry(entry.raw, entry.name, _title(entry.name), entry.quantity)


@lru_cache(maxsize=65536)
def _title(name: str) -> Titles:
    """Return `base_frequency` as `Base frequency`."""
    return {"en": humanised(name)}
