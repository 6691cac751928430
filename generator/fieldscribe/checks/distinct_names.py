"""A cheap proof that points of one kind get no identifier twice: their identifiers differ in the point's name alone.

Targets list their identifiers for one point of each kind. What stands around the name of that point stands around the
names of all others of its kind. Names are compared without case and underscores, which languages write differently.
Where the proof fails, nothing is wrong yet: then all identifiers are compared as they are.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass, field, fields, replace
from operator import attrgetter
from typing import TYPE_CHECKING

from fieldscribe.model import Shape
from fieldscribe.targets.identifiers import clashes

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from fieldscribe.model import Allowed, Device, Place, Point
    from fieldscribe.targets.identifiers import Names, Owner


_BUT_ENUM = attrgetter(*[each.name for each in fields(Shape) if each.name not in ("enum", "flags", "specials")])


class Kinds:
    """The points of a device by kind: the `first` of each, and the others, which are like it but for their names.

    `items` are the names of all that have a kind, `rests` what stands behind one of them in another. `sample` is the
    device with the first point of each kind, and with all points that are unlike any other.
    """

    def __init__(self, device: Device) -> None:
        needed = _needed(device)
        limits = {id(point.allowed): point.allowed for point in device.points}
        terms = {id(point.terms): point.terms for point in device.points}
        self._limits = {key: _form(allowed) for key, allowed in limits.items()}
        special = {key for key, shared in terms.items() if shared.when or shared.telegram or shared.changes_with}
        first: dict[object, Point] = {}
        kept: list[Point] = []
        items: list[str] = []
        for point in device.points:
            item = point.item
            alone = id(point.terms) in special or _is_special(point) or item in needed or point.name in needed
            if alone or first.setdefault(self.kind(point), point) is point:
                kept.append(point)
            if not alone:
                items.append(_plain(item))
        self.items = frozenset(items)
        self._unique = len(self.items) == len(items)
        lengths = {len(item) for item in self.items}
        self.rests = {
            item[cut:] for cut in lengths for item in self.items if cut < len(item) and item[:cut] in self.items
        }
        self._first = frozenset(point.item for point in first.values())
        self.sample = _sample(device, kept)

    def proves(self, identifiers: Callable[[Device], Iterable[Names]]) -> bool:
        """Whether no two things of the device can have one identifier; False too where the proof is not worth it."""
        if not self._unique or len(self.sample.points) > len(self.items):
            return False
        listed = list(identifiers(self.sample))
        if next(clashes(listed), None) is not None:
            return False
        spaces: defaultdict[str, _Space] = defaultdict(_Space)
        before = _plain(self.sample.id)
        for namespace, owner, names in listed:
            item = _point_of(owner)
            if item not in self._first or item in namespace:  # a namespace of its own meets no other
                spaces[namespace].others.update(map(_plain, names))
            elif not all(spaces[namespace].learns(_plain(name), _plain(item), before) for name in names):
                return False
        return all(space.apart(self) for space in spaces.values() if space.behind)

    def kind(self, point: Point) -> object:
        """All that decides which identifiers a point has, but for its name."""
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


@dataclass(slots=True)
class _Space:
    """A namespace: what stands before and behind the names of points in it, and the names of other things."""

    before: set[str] = field(default_factory=set)
    behind: set[str] = field(default_factory=set)
    others: set[str] = field(default_factory=set)

    def learns(self, name: str, item: str, device: str) -> bool:
        """Take apart a name of a point; False if it is not made of the point's name."""
        before = next((before for before in (device, "") if name.startswith(before + item)), None)
        if before is None:
            return False
        self.before.add(before)
        self.behind.add(name[len(before) + len(item) :])
        return len(self.before) == 1

    def apart(self, kinds: Kinds) -> bool:
        """Whether no name is there twice, whatever of all that stands behind items here stands behind which."""
        between = {tail[:cut] for tail in self.behind for cut in range(1, len(tail) + 1) if tail[cut:] in self.behind}
        (before,) = self.before
        others = [name[len(before) :] for name in self.others if name.startswith(before)]
        return between.isdisjoint(kinds.rests) and not any(self._is_of_item(name, kinds.items) for name in others)

    def _is_of_item(self, name: str, items: frozenset[str]) -> bool:
        """Whether the name is an item with something behind it."""
        return any(name.endswith(tail) and name[: len(name) - len(tail)] in items for tail in self.behind)


def _sample(device: Device, points: list[Point]) -> Device:
    """The device with these points alone."""
    first = {point.group: point for point in reversed(points)}
    blocks = {
        group: tuple([replace(block, points=(first[group].name,)) for block in blocks[:1]])
        for group, blocks in device.blocks.items()
    }
    return replace(device, points=tuple(points), blocks=blocks)


def _needed(device: Device) -> set[str]:
    """The names of points that others need."""
    scales = {id(point.shape): point.shape.scale_arguments for point in device.points}
    limits = {id(point.allowed): point.allowed.arguments for point in device.points}
    names = {name for arguments in (*scales.values(), *limits.values()) for name in arguments}
    return names | {command.busy for command in device.commands if command.busy is not None}


def _is_special(point: Point) -> bool:
    """Whether more than its shape, terms and name decides about the identifiers of a point."""
    return bool(point.variant or point.was or point.index)


def _form_of_shape(point: Point) -> object:
    """A shape without the name of its enum, if that is called after the point."""
    shape = point.shape
    enum = shape.enum
    if enum is None or enum.name != point.item or shape.flags or shape.specials:
        return id(shape)
    return id(enum.entries), enum.closed, _BUT_ENUM(shape)


def _form_of_place(place: Place) -> object:
    """A place without its numbers."""
    addresses = place.addresses
    return tuple(place.references), len(addresses) > 1 and tuple([address - addresses[0] for address in addresses])


def _form(allowed: Allowed) -> object:
    """Limits without their numbers where they are a single interval; all of them where they may be a table."""
    fixed = len(allowed.fixed) == len(allowed.intervals) == 1
    return (allowed.listed, allowed.intervals[0].outer[0] < 0) if fixed else id(allowed)


def _point_of(owner: Owner) -> str | None:
    """The item of the point that a thing is, or is a part of; of an enum the name, which may be that of a point."""
    whole: Owner | None = owner
    while whole is not None and whole.kind not in ("point", "enum"):
        whole = whole.of
    return None if whole is None else whole.name


def _plain(name: str) -> str:
    """A name without what languages write differently."""
    return name.replace("_", "").lower()
