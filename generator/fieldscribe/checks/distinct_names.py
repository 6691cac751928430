"""A quick proof that no two identifiers of a device are equal, without asking the targets for all of them.

Points of one kind have the same identifiers but for the point's name. So a target lists the identifiers of one point of
each kind, and the others follow by putting in the other names. Names are compared without case and underscores, because
languages write them differently. Where the proof fails, nothing is wrong yet: then all identifiers are compared.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import fields, replace
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

    `names` has the plain names of all points of a kind, under the plain name of its first point. `sample` is the device
    with the first point of each kind and with all points that belong to no kind.
    """

    def __init__(self, device: Device) -> None:
        limits = {id(point.allowed): point.allowed for point in device.points}
        terms = {id(point.terms): point.terms for point in device.points}
        self._limits = {key: _form_of_limits(allowed) for key, allowed in limits.items()}
        special = {key for key, shared in terms.items() if shared.when or shared.telegram or shared.changes_with}
        needed = _needed(device)
        first: dict[object, list[str]] = {}
        self.names: dict[str, list[str]] = {}
        kept: list[Point] = []
        for point in device.points:
            item = point.item
            if id(point.terms) in special or point.variant or point.was or point.index or {item, point.name} & needed:
                kept.append(point)
                continue
            names = first.setdefault(self.kind(point), [])
            if not names:
                kept.append(point)
                self.names[_plain(item)] = names
            names.append(_plain(item))
        self.sample = _sample(device, kept)

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
        if len(self.sample.points) > sum(map(len, self.names.values())):
            return False
        listed = list(identifiers(self.sample))
        if next(clashes(listed), None) is not None:
            return False
        spaces: defaultdict[str, set[tuple[str, str, str]]] = defaultdict(set)
        device = _plain(self.sample.id)
        for namespace, owner, names in listed:
            point = _point_of(owner)
            item = _plain(point)
            shared = item in self.names and point not in namespace  # a namespace of one point meets no other
            for name in map(_plain, names):
                before = next((start for start in (device, "") if shared and name.startswith(start + item)), None)
                if before is not None:
                    spaces[namespace].add((before, item, name[len(before) + len(item) :]))
                elif shared:
                    return False
                else:
                    spaces[namespace].add((name, "", ""))
        return all(self._differ(space) for space in spaces.values())

    def _differ(self, patterns: Iterable[tuple[str, str, str]]) -> bool:
        """Return True if the patterns, with each name of the kind in the middle, give no name twice."""
        taken: set[int] = set()
        count = 0
        for before, item, behind in patterns:
            names = self.names.get(item, [item])
            count += len(names)
            taken.update([hash(before + name + behind) for name in names])
        return len(taken) == count


def _sample(device: Device, points: list[Point]) -> Device:
    """Return the device with these points alone."""
    first = {point.group: point for point in reversed(points)}
    blocks = {
        group: tuple([replace(block, points=(first[group].name,)) for block in blocks[:1]])
        for group, blocks in device.blocks.items()
    }
    return replace(device, points=tuple(points), blocks=blocks)


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
