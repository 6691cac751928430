"""The side of a comparison that is a description: its model, the places of its facts, and what did not resolve."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

from fieldscribe.checks.identifier_places import IdentifierPlaces
from fieldscribe.targets.identifiers import Owner

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from fieldscribe.diagnostics import Span
    from fieldscribe.language.nodes import Map
    from fieldscribe.model import Device, Point
    from fieldscribe.resolve.analysis import Analysis
    from fieldscribe.resolve.point_facts import PointFacts

_KEYS = {
    "address": ("at",),
    "order of words": ("words",),
    "base": ("numbering",),
    "write address": ("write_at",),
    "range": ("range", "range_in_units", "enum"),
    "listed": ("range",),
    "step": ("steps",),
    "default": ("default", "default_in_units"),
    "length": ("length", "characters"),
    "kept": ("keep_with", "keeps"),
    "codes of": ("special",),
    "name of the enum": ("enum",),
    "old names": ("was",),
    "changes with": ("changes_with",),
    "source": ("line", "lines", "page", "section"),
    "bytes": ("bytes",),
    "meaning": ("says", "with"),
    "reason": ("why",),
    "points": ("point", "points"),
    "max": ("functions",),
    "entry": ("enum",),
    "flag": ("flags",),
    "code": ("special", "code"),
}
"""The keys of a description that say a fact, where they are called otherwise than the fact."""

_OF_ENUM = ("", "enum", "open", "name of the enum")
"""The facts of a point that are those of its enum; the enum comes, goes and is renamed with it."""

_LISTED = {"command": "commands", "message": "messages", "telegram": "telegrams"}
_OF_BUS = {"function": "functions", "exception": "exceptions", "response": "responses"}


class Described:
    """One description. `names` of things are given from the outside in, each with its kind."""

    def __init__(self, subject: Analysis) -> None:
        self._subject = subject
        self.device: Device = subject.device
        self.points: Mapping[str, Point] = {point.item: point for point in self.device.points}

    @property
    def subject(self) -> Analysis:
        """The description with its places."""
        return self._subject

    def draft(self, item: str) -> PointFacts:
        """The point as the text has it."""
        return self._subject.index.by_item(item)

    @cached_property
    def _owners(self) -> IdentifierPlaces:
        return IdentifierPlaces(self._subject)

    @cached_property
    def lost(self) -> frozenset[tuple[str, str]] | None:
        """What stands in the text and did not resolve, by kind and name; None where even that is not known."""
        if not self._subject.scope.complete:
            return None
        drafts = self._subject.index.by_items.keys()
        frames = {open_frame.frame.name for open_frame in self._subject.open_frames}
        known_frames = {frame.name for frame in self.device.frames}
        return frozenset(
            {("point", item) for item in drafts - self.points.keys()}
            | {("frame", name) for name in frames - known_frames}
        )

    def owners(self, names: tuple[tuple[str, str], ...], fact: str) -> Iterator[Owner]:
        """The things that a difference is about, as targets know them: of the facts of an enum also the enum."""
        owner = self.owner(names)
        if owner is None:
            return
        if fact == "old names":
            yield from (Owner("old name", old, owner) for old in self.points[owner.name].was)
        enum = self._enum_of(owner.name) if fact in _OF_ENUM and owner.kind == "point" else ""
        owners = [Owner("enum", enum), owner] if enum and (fact or enum == owner.name) else [owner]
        yield from owners if fact else reversed(owners)

    def owner(self, names: tuple[tuple[str, str], ...]) -> Owner | None:
        """A thing as targets know it that give it names; None for the device as a whole."""
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
        """Where a fact stands; None where the description does not have the thing."""
        if not names:
            return self._of_device(fact)
        (kind, name), parts = names[0], names[1:]
        if kind == "point":
            return self._of_point(name, names, fact) if name in self._subject.index.by_items else None
        node = next((node for node in self._nodes(kind) if name in (node.get("name"), node.get("id"))), None)
        if node is not None:
            return _said(node, fact) or node.span("name" if "name" in node else "id")
        return None if parts else self._of_key(kind, name)

    def _of_point(self, item: str, names: tuple[tuple[str, str], ...], fact: str) -> Span:
        draft = self.draft(item)
        for key in _KEYS.get(fact, (fact,)) if len(names) == 1 else ():
            if key in draft.keys:
                return draft.span(key)
            if key in draft.group and fact == "base":
                return draft.group.key_span(key)
        owner = self.owner(names)
        return _found(lambda: self._owners.thing(owner).place if owner and len(names) > 1 else None) or (
            draft.span("enum" if fact == "enum" else "flags" if fact == "flag" else None)
        )

    def _nodes(self, kind: str) -> Iterator[Map]:
        subject = self._subject
        if kind == "frame":
            return (open_frame.node for open_frame in subject.open_frames)
        if kind == "erratum":
            return (open_erratum.node for open_erratum in subject.errata)
        return subject.scope.listed(_LISTED[kind]) if kind in _LISTED else iter(())

    def _of_key(self, kind: str, name: str) -> Span | None:
        """What is declared by a key."""
        scope = self._subject.scope
        if kind == "group":
            return next((node.span("group") for node in scope.groups if node["group"] == name), None)
        if kind in _OF_BUS:
            owner = Owner(kind, name)
            return _found(lambda: self._owners.thing(owner).place)
        holder = scope.header.get({"document": "documents", "variant": "variants"}.get(kind, ""))
        return holder.key_span(name) if holder and name in holder else None

    def _of_device(self, fact: str) -> Span:
        scope, keys = self._subject.scope, _KEYS.get(fact, (fact,))
        for holder in (scope.header, *([scope.bus] if scope.bus is not None else [])):
            for key in ("note",) if fact == "note of the bus" else keys:
                if key in holder:
                    return holder.span(key)
        return scope.header.span("device")

    def _enum_of(self, item: str) -> str:
        point = self.points.get(item)
        enum = None if point is None else point.enum if point.digits is None else point.digits.enum
        return "" if enum is None else enum.name

    def _shared_codes(self, item: str) -> str:
        point = self.points.get(item)
        return "" if point is None else point.shared_codes


def _said(node: Map, fact: str) -> Span | None:
    return next((node.span(key) for key in _KEYS.get(fact, (fact,)) if key in node), None)


def _found(place: Callable[[], Span | None]) -> Span | None:
    """The place that something is found at; None for what only one of the sides has."""
    try:
        return place()
    except (KeyError, IndexError, StopIteration):
        return None
