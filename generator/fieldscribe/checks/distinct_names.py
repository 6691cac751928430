"""A quick proof that no two identifiers of a device are equal, without asking the targets for all of them.

Points of one kind have the same identifiers but for the point's name. So a target lists the identifiers of one point of
each kind: a start, the name, and an ending. Two names that differ can only give equal identifiers if one name begins
with the other, and an ending begins with the rest. Names are compared without case and underscores, because languages
write them differently. If the proof fails, nothing is wrong yet: then all identifiers are compared.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from operator import attrgetter
from typing import TYPE_CHECKING

from fieldscribe.model import Shape
from fieldscribe.targets.identifiers import clashes

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from fieldscribe.model import Allowed, Device, Place, Point
    from fieldscribe.targets.identifiers import Names, Owner

_SHAPE_WITHOUT_NAMES = attrgetter(
    *[each.name for each in fields(Shape) if each.name not in ("enum", "flags", "specials")]
)


class PointKinds:
    """The points of a device by kind.

    `names` are the plain names of all points that belong to a kind, each with that of the first point of its kind.
    `sample` is the device with the first point of each kind and with all points that belong to no kind.
    """

    def __init__(self, device: Device) -> None:
        limits = {id(point.allowed): point.allowed for point in device.points}
        terms = {id(point.terms): point.terms for point in device.points}
        self._limits = {key: _form_of_limits(allowed) for key, allowed in limits.items()}
        special = {key for key, shared in terms.items() if shared.when or shared.telegram or shared.changes_with}
        needed = _needed(device)
        first: dict[object, str] = {}
        items: list[str] = []
        self.names: dict[str, str] = {}
        kept: list[Point] = []
        for point in device.points:
            item = point.item
            if id(point.terms) in special or point.variant or point.was or point.index or {item, point.name} & needed:
                kept.append(point)
                continue
            items.append(item)
            name = _plain(item)
            self.names[name] = first.setdefault(self.kind(point), name)
            if self.names[name] == name:
                kept.append(point)
        self._are_unique = len(self.names) == len(items)
        self.sample = _sample(device, kept, set(items))

    def kind(self, point: Point) -> object:
        """Return what decides which identifiers a point has, apart from its name."""
        return (
            _form_of_shape(point),
            id(point.terms),
            self._limits[id(point.allowed)],
            _form_of_place(point.place),
            None if point.write_place is None else _form_of_place(point.write_place),
            point.set,
            point.default is None,
            point.default_raw is None,
        )

    def are_distinct(self, identifiers: Callable[[Device], Iterable[Names]]) -> bool:
        """Return True if all identifiers of a target are proven to differ; False also if the proof is not worth it."""
        if not self._are_unique or len(self.sample.points) > len(self.names):
            return False
        listed = list(identifiers(self.sample))
        if next(clashes(listed), None) is not None:
            return False
        spaces: defaultdict[str, _Space] = defaultdict(_Space)
        device = _plain(self.sample.id)
        for namespace, owner, names in listed:
            point = _point_of(owner)
            item = _plain(point)
            shared = self.names.get(item) == item and point not in namespace  # a namespace of one point meets no other
            space = spaces[namespace]
            for name in map(_plain, names):
                start = next((start for start in (device, "") if shared and name.startswith(start + item)), None)
                if start is not None:
                    space.starts.add(start)
                    space.endings[name[len(start) + len(item) :]].add(item)
                elif shared:
                    return False
                else:
                    space.others.add(name)
        return all(map(self._differ, spaces.values()))

    def _differ(self, space: _Space) -> bool:
        """Return True if no name gives an identifier that another name, or another thing, has in this namespace."""
        if len(space.starts) > 1:
            return False
        for ending, longer in space.endings.items():
            for end in range(1, len(ending) + 1):
                pairs, shorter = self._rests.get(ending[:end]), space.endings.get(ending[end:])
                if pairs and shorter and any(first in longer and second in shorter for first, second in pairs):
                    return False
        return not any(
            other[at:end] in self.names and other[end:] in space.endings
            for start in space.starts
            for other in space.others
            if other.startswith(start)
            for at in [len(start)]
            for end in range(at + 1, len(other) + 1)
        )

    @cached_property
    def _rests(self) -> dict[str, set[tuple[str, str]]]:
        """What follows in names that begin with another name, with the kinds of both names, the shorter one first."""
        rests: defaultdict[str, set[tuple[str, str]]] = defaultdict(set)
        for name, kind in self.names.items():
            for end in range(1, len(name)):
                if (shorter := self.names.get(name[:end])) is not None:
                    rests[name[end:]].add((shorter, kind))
        return rests


@dataclass
class _Space:
    """The identifiers of a namespace: what stands before and behind the names of points, and those of other things.

    Each ending has the kinds of points that have it.
    """

    starts: set[str] = field(default_factory=set)
    endings: defaultdict[str, set[str]] = field(default_factory=lambda: defaultdict(set))
    others: set[str] = field(default_factory=set)


def _sample(device: Device, points: list[Point], items: set[str]) -> Device:
    """Return the device with these points alone; an enum that is named after another one of the items is left out."""
    left_out = items - {point.item for point in points}
    first = {point.group: point for point in reversed(points)}
    blocks = {
        group: tuple([replace(block, points=(first[group].name,)) for block in blocks[:1]])
        for group, blocks in device.blocks.items()
    }
    enums = tuple([enum for enum in device.enums if enum.name not in left_out])
    return replace(device, points=tuple(points), blocks=blocks, enums=enums)


def _needed(device: Device) -> set[str]:
    """Return the names of the points that scales, limits and commands need."""
    scales = {id(point.shape): point.shape.scale_arguments for point in device.points}
    limits = {id(point.allowed): point.allowed.arguments for point in device.points}
    names = {name for arguments in (*scales.values(), *limits.values()) for name in arguments}
    return names | {command.busy for command in device.commands if command.busy is not None}


def _form_of_shape(point: Point) -> object:
    """Return the shape, without the name of its enum if that is named after the point."""
    shape = point.shape
    enum = shape.enum
    if enum is None or enum.name != point.item or shape.flags or shape.specials:
        return id(shape)
    return id(enum.entries), enum.closed, _SHAPE_WITHOUT_NAMES(shape)


def _form_of_place(place: Place) -> object:
    """Return a place without its numbers."""
    addresses = place.addresses
    return tuple(place.references), len(addresses) > 1 and tuple([address - addresses[0] for address in addresses])


def _form_of_limits(allowed: Allowed) -> object:
    """Return a single interval without its numbers; other limits whole, for a target may make a table of them."""
    fixed = len(allowed.fixed) == len(allowed.intervals) == 1
    return (allowed.listed, allowed.intervals[0].outer[0] < 0) if fixed else id(allowed)


def _point_of(owner: Owner) -> str:
    """Return the item of the point that a thing is or is a part of, or the name of its enum; else nothing."""
    whole: Owner | None = owner
    while whole is not None and whole.kind not in ("point", "enum"):
        whole = whole.of
    return "" if whole is None else whole.name


def _plain(name: str) -> str:
    """Return a name without what languages write differently."""
    return name.replace("_", "").lower()
