"""A description as one side of a comparison: its model, the places of its facts, its names in generated code."""

from collections.abc import Callable, Iterator, Mapping
from functools import cache, cached_property

from fieldscribe.checks.identifier_places import OF_BUS, IdentifierPlaces
from fieldscribe.code_view import for_code
from fieldscribe.diagnostics import Span
from fieldscribe.facts.devices import device_table
from fieldscribe.facts.table import Parts
from fieldscribe.families import FAMILIES
from fieldscribe.language.nodes import Map
from fieldscribe.model import Device, Point
from fieldscribe.resolve.analysis import Analysis
from fieldscribe.resolve.point_facts import PointFacts
from fieldscribe.targets import TARGETS, knows, target
from fieldscribe.targets.identifiers import Owner

_OF_ENUM = ("", "enum", "open", "name of the enum")
"""The facts of a point that belong to its enum, which is added, removed and renamed with it."""

_DECLARED = {"document": "documents", "variant": "variants", "given": "given", "found": "found"}
"""The key of the head under which things of a kind are declared."""


class Described:
    """One description. Things are given by kind and name, from the outside in."""

    def __init__(self, analysis: Analysis) -> None:
        self.analysis = analysis
        self.device: Device = analysis.device
        self.points: Mapping[str, Point] = {point.item: point for point in self.device.points}

    def written(self, item: str) -> PointFacts:
        """Return the point as the description states it."""
        return self.analysis.symbols.by_item(item)

    @cached_property
    def _owners(self) -> IdentifierPlaces:
        return IdentifierPlaces(self.analysis)

    @cached_property
    def lost(self) -> frozenset[tuple[str, str]] | None:
        """Kinds and names of things in the text that were not resolved; None if even that is unknown."""
        if not self.analysis.scope.complete:
            return None
        drafts = self.analysis.symbols.by_items.keys()
        frames = {open_frame.frame.name for open_frame in self.analysis.located_frames}
        known_frames = {frame.name for frame in self.device.frames}
        return frozenset(
            {("point", item) for item in drafts - self.points.keys()}
            | {("frame", name) for name in frames - known_frames}
        )

    def identifiers(self, names: tuple[tuple[str, str], ...], fact: str) -> dict[str, list[str]]:
        """Return the names in generated code of the thing that differs, by language."""
        owners = tuple(self._owners_of(names, fact))
        return {
            language: [name for owner in owners for name in of_owner.get(owner, ())]
            for language, of_owner in self._listed.items()
        }

    @cached_property
    def _listed(self) -> Mapping[str, Mapping[Owner, Mapping[str, None]]]:
        plain = for_code(self.device)
        listed = {name: _names(name, plain) for name in TARGETS if knows(name, plain)}
        return {name: names for name, names in listed.items() if names}

    def _owners_of(self, names: tuple[tuple[str, str], ...], fact: str) -> Iterator[Owner]:
        """Yield the things that differ as owners of names; for facts of an enum also the enum."""
        owner = self.owner(names)
        if owner is None:
            return
        if fact == "old names":
            yield from (Owner("old name", old, owner) for old in self.points[owner.name].was)
        enum = self._enum_of(owner.name) if fact in _OF_ENUM and owner.kind == "point" else ""
        owners = [Owner("enum", enum), owner] if enum and (fact or enum == owner.name) else [owner]
        yield from owners if fact else reversed(owners)

    def owner(self, names: tuple[tuple[str, str], ...]) -> Owner | None:
        """Return a thing as the owner of names; None for the device as a whole."""
        owner: Owner | None = None
        for kind, name in names:
            if kind == "entry":
                owner = Owner("entry", name, Owner("enum", self._enum_of(names[0][1])))
            elif kind == "code" and owner is not None and (shared := self._shared_codes(names[0][1])):
                owner = Owner("code", name, Owner("special codes", shared))
            else:
                owner = Owner(kind, name, owner)
        return owner

    def span(self, names: tuple[tuple[str, str], ...], fact: str) -> Span | None:
        """Return the place of a fact; None if the description does not have the thing."""
        if not names:
            return self._of_device(fact)
        (kind, name), parts = names[0], names[1:]
        if kind == "point":
            return self._of_point(name, names, fact) if name in self.analysis.symbols.by_items else None
        node = self._owners.node(kind, name)
        if node is not None:
            return _fact_span(node, fact) or self._owners.thing(Owner(kind, name)).place
        return None if parts else self._of_key(kind, name)

    def _of_point(self, item: str, names: tuple[tuple[str, str], ...], fact: str) -> Span:
        written = self.written(item)
        for key in _yaml_keys(fact) if len(names) == 1 else ():
            if key in written.keys:
                return written.span(key)
            if key in written.group and fact == "base":
                return written.group.key_span(key)
        owner = self.owner(names)
        return _found(lambda: self._owners.thing(owner).place if owner and len(names) > 1 else None) or (
            written.span("enum" if fact == "enum" else "flags" if fact == "flag" else None)
        )

    def _of_key(self, kind: str, name: str) -> Span | None:
        """Return the place of a declaration by its key."""
        if kind in OF_BUS or kind == "base":
            owner = Owner(kind, name)
            return _found(lambda: self._owners.thing(owner).place)
        holder = self.analysis.scope.header.get(_DECLARED.get(kind, ""))
        return holder.key_span(name) if holder and name in holder else None

    def _of_device(self, fact: str) -> Span:
        scope, keys = self.analysis.scope, _yaml_keys(fact)
        for holder in (scope.header,) if scope.bus is None or fact == "note" else (scope.bus, scope.header):
            for key in ("note",) if fact == "note of the bus" else keys:
                if key in holder:
                    return holder.span(key)
        return scope.header.span("device")

    def _enum_of(self, item: str) -> str:
        point = self.points.get(item)
        enum = None if point is None else point.named_numbers
        return "" if enum is None else enum.name

    def _shared_codes(self, item: str) -> str:
        point = self.points.get(item)
        return "" if point is None else point.shared_codes


def _fact_span(node: Map, fact: str) -> Span | None:
    return next((node.span(key) for key in _yaml_keys(fact) if key in node), None)


def _found(place: Callable[[], Span | None]) -> Span | None:
    """Return the place that the function finds; None for a thing that only the other side has."""
    try:
        return place()
    except (KeyError, IndexError, StopIteration):
        return None


def _names(name: str, plain: Device) -> Mapping[Owner, Mapping[str, None]]:
    """Return all names in a language by owner, each once, in the order of the listing."""
    by_owner: dict[Owner, dict[str, None]] = {}
    for _, owner, names, _ in target(name).identifiers(plain):
        by_owner.setdefault(owner, {}).update(dict.fromkeys(names))
    return by_owner


def _yaml_keys(label: str) -> tuple[str, ...]:
    """Return the keys of a description that state the fact or the parts with this label."""
    return _all_yaml_keys().get(label) or (label,)


@cache
def _all_yaml_keys() -> Mapping[str, tuple[str, ...]]:
    keys: dict[str, tuple[str, ...]] = {}
    views = [view for name in FAMILIES for fact in device_table(name) for view in fact.compared()]
    while views:
        view = views.pop()
        if isinstance(view, Parts):
            views += view.entries.values()
        if view.yaml:
            keys[view.kind if isinstance(view, Parts) else view.label] = view.yaml
    return keys
