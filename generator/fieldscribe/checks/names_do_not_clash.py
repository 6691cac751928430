"""No two things get the same identifier in a target, and none gets an identifier that generated code needs.

Nor do two identifiers differ only after the characters that a language compares.

Each target lists its identifiers with their owners (`identifiers` of `targets/*`); here they are only compared. Points
that have other findings are left out. Reserved words do not clash: targets change such names themselves.

Mostly a quick proof does without listing all of them. Points of one kind have the same identifiers except for the
point's name. So a target lists the identifiers of one point of each kind: a start, the name, and an ending; those of
the other points follow. They are compared without case and underscores, because languages write names differently. If
some are equal, that is not yet a clash: then the target lists all identifiers.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Callable, Hashable, Iterable, Mapping
from dataclasses import replace

from fieldscribe.checks.identifier_places import IdentifierPlaces, Named, Thing, given_names, thing_of
from fieldscribe.grouping import grouped
from fieldscribe.lowered import lower
from fieldscribe.model import Device
from fieldscribe.resolve.analysis import Analysis
from fieldscribe.targets import TARGETS, knows, target
from fieldscribe.targets.identifiers import Names, Owner, Resemblance, clashes, resemblances


def check(analysis: Analysis) -> None:
    """Report equal names in the description, then equal identifiers in a target."""
    reported: set[frozenset[Thing]] = set()
    first: dict[tuple[str, str], Named] = {}
    for namespace, name, named in given_names(analysis):
        known = first.setdefault((namespace, name), named)
        if known is not named and (other := thing_of(known)) != (thing := thing_of(named)):
            _report(analysis, other, thing, f"`{name}` in {namespace}", reported)
    _compare_targets(analysis, reported)


def _compare_targets(analysis: Analysis, reported: set[frozenset[Thing]]) -> None:
    owners, device = IdentifierPlaces(analysis), analysis.code_device
    warned: set[tuple[str, int]] = set()
    kinds = PointKinds(device, lower(device).template_keys)
    for language in [target(name) for name in TARGETS if knows(name, device)]:
        if kinds.saves_time and kinds.are_distinct(language.identifiers, language.BEFORE_POINTS):
            continue
        listed = list(language.identifiers(device))
        for clash in clashes(listed):
            first, second = owners.thing(clash.first), owners.thing(clash.second)
            _report(analysis, first, second, f"`{clash.name}` in {clash.namespace}", reported)
        for resemblance in resemblances(listed):
            _warn(analysis, resemblance, owners.thing(resemblance.first), owners.thing(resemblance.second), warned)


def _report(analysis: Analysis, first: Thing, second: Thing, where: str, reported: set[frozenset[Thing]]) -> None:
    """Report each pair once: names that clash in one language mostly clash in the others too."""
    pair = frozenset((first, second))
    if second.place is None:
        first, second = second, first
    if pair in reported or second.place is None:
        return
    reported.add(pair)
    hint = "rename one of them" if first.place is not None else "choose another name"
    related = [] if first.place is None else [(first.place, f"{first.words} stands here")]
    message = f"{first.words} and {second.words} would both be {where}"
    if first.words == second.words:
        message = f"{second.words} is there twice"
    analysis.report.error("name-clash", message, second.place, hint, related)


def _warn(
    analysis: Analysis, resemblance: Resemblance, first: Thing, second: Thing, warned: set[tuple[str, int]]
) -> None:
    """Warn of names that a compiler need not distinguish; once for all names of one place in the description."""
    place = second.place or first.place
    if place is None or (place.file, place.line) in warned:
        return
    warned.add((place.file, place.line))
    names = " and ".join(f"`{name}`" for name in resemblance.names)
    message = (
        f"{names} are equal in their first {resemblance.significant} characters, and C compilers need not compare more"
    )
    analysis.report.warning("long-names", message, place, "give it a shorter name")


# The proof.


class PointKinds:
    """The points of a device by kind: those of a kind have the same text in generated code except for their names.

    The keys of points, by their ids, tell their kinds. `names` are the plain names of all points of a kind with several
    points, each with that of the first point of its kind. `sample` is the device with the first point of each kind and
    with all other points. `saves_time` if it is so small that the proof takes less time than comparing all names.
    """

    def __init__(self, device: Device, keys: Mapping[int, Hashable]) -> None:
        needed = _needed(device)
        kinds = {
            item: keys[id(point)]
            for point in device.points
            if (item := point.item) not in needed and point.name not in needed
        }
        sizes = Counter(kinds.values())
        first: dict[Hashable, str] = {}
        self.names: dict[str, str] = {}
        self._longest: dict[str, int] = {}
        several = {item: _plain(item) for item, kind in kinds.items() if sizes[kind] > 1}
        for item, name in several.items():
            of_kind = self.names[name] = first.setdefault(kinds[item], name)
            self._longest[of_kind] = max(len(item), self._longest.get(of_kind, 0))
        self._of_kind = grouped((of_kind, name) for name, of_kind in self.names.items())
        self._are_unique = len(self.names) == len(several)
        left_out = {item for item, name in several.items() if self.names[name] != name}
        self.sample = _sample(device, left_out)
        self.saves_time = 3 * len(self.sample.points) < len(device.points)

    def are_distinct(self, identifiers: Callable[[Device], Iterable[Names]], before_points: Iterable[str]) -> bool:
        """Return True if all identifiers of a target are proven to differ, in the characters that it compares.

        `before_points` are the words that may come between the names of device and point.
        """
        if not self._are_unique or not self.names or not before_points:
            return False
        listed = list(identifiers(self.sample))
        if next(clashes(listed), None) is not None or next(resemblances(listed), None) is not None:
            return False
        around: defaultdict[str, set[tuple[str, str, str]]] = defaultdict(set)
        others: defaultdict[str, set[str]] = defaultdict(set)
        device = _plain(self.sample.id)
        starts = [*(device + word for word in sorted(before_points, key=len, reverse=True)), ""]
        for namespace, owner, names, significant in listed:
            point = _point_of(owner)
            item = _plain(point)
            shared = self.names.get(item) == item and point not in namespace  # it has no other names
            if shared and significant is not None:
                most = significant - (self._longest[item] - len(point))  # a longer name is proven by its start
                if any(len(name) >= most for name in names):
                    return False
            for name in map(_plain, names):
                start = next((start for start in starts if shared and name.startswith(start + item)), None)
                if start is not None:
                    around[namespace].add((start, item, name[len(start) + len(item) :]))
                elif shared:
                    return False
                else:
                    others[namespace].add(name)
        return all(self._differ(parts, others[namespace]) for namespace, parts in around.items())

    def _differ(self, around: set[tuple[str, str, str]], others: set[str]) -> bool:
        """Return True if no name, between each start and ending of its kind, gives an identifier that is there."""
        identifiers = [start + name + ending for start, kind, ending in around for name in self._of_kind[kind]]
        return len(set(identifiers)) == len(identifiers) and others.isdisjoint(identifiers)


def _sample(device: Device, left_out: set[str]) -> Device:
    """Return the device without these points, and without the enums that are named after them."""
    points = [point for point in device.points if point.item not in left_out]
    first = {point.group: point for point in reversed(points)}
    blocks = {
        group: tuple([replace(block, points=(first[group].name,)) for block in blocks[:1]])
        for group, blocks in device.blocks.items()
        if group in first
    }
    enums = tuple([enum for enum in device.enums if enum.name not in left_out])
    return replace(device, points=tuple(points), blocks=blocks, enums=enums)


def _needed(device: Device) -> set[str]:
    """Return the names of the points that scales, limits, selections and commands need."""
    scales = {id(point.shape): point.shape.scale_arguments for point in device.points}
    limits = {id(point.allowed): point.allowed.arguments for point in device.points}
    names = {name for arguments in (*scales.values(), *limits.values()) for name in arguments}
    names |= {
        name
        for terms in {id(point.terms): point.terms for point in device.points}.values()
        for name, _ in terms.selects
    }
    return names | {command.busy for command in device.commands if command.busy is not None}


def _point_of(owner: Owner) -> str:
    """Return the item of the point that a thing is or belongs to, or the name of its enum; else nothing."""
    whole: Owner | None = owner
    while whole is not None and whole.kind not in ("point", "enum"):
        whole = whole.of
    return "" if whole is None else whole.name


def _plain(name: str) -> str:
    """Return a name without case and underscores, which languages write differently."""
    return name.replace("_", "").lower()
