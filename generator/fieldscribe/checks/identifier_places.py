"""Words the owners of identifiers for messages, and finds their places in the description."""

from collections.abc import Iterator
from functools import cached_property
from typing import NamedTuple

from fieldscribe.diagnostics import Span
from fieldscribe.language.nodes import Map
from fieldscribe.model import item_of
from fieldscribe.resolve.analysis import Analysis
from fieldscribe.resolve.point_facts import PointFacts
from fieldscribe.targets.identifiers import Owner

_LISTED = {
    "command": "commands",
    "message": "messages",
    "telegram": "telegrams",
    "frame": "frames",
    "erratum": "errata",
    "group": "",
}
"""The sections that list things of a kind; groups are documents of their own."""
_NAMING = {"erratum": "id", "group": "group"}
"""The keys that name things of a kind, if that is not `name`."""
OF_BUS = {"exception": "exceptions", "function": "functions", "response": "responses"}
_OF_POINT = {"flag": "flags", "code": "special", "special codes": "special", "old name": "was"}
"""The key of a point that holds its parts, by kind."""


class Thing(NamedTuple):
    """A named thing: its name in messages, and its place; the place is None if a target itself needs the name."""

    words: str
    place: Span | None


class _LocatedEnum(NamedTuple):
    """An enum with the place of its entries: under `enums`, or in its point."""

    name: str
    was: tuple[str, ...]
    thing: Thing
    entries: Map


Named = PointFacts | Thing
"""The owner of a name in the description; a point becomes a `Thing` only if its name clashes."""


def given_names(analysis: Analysis) -> Iterator[tuple[str, str, Named]]:
    """Yield the names of groups, given numbers, points and enums in the description: namespace, name and owner."""
    for group in analysis.scope.groups:
        name = str(group["group"])
        yield "the list of groups", name, Thing(f"the group `{name}`", group.span("group"))
    for name in analysis.scope.given:
        place = analysis.scope.header["given"].key_span(name)
        yield "generated code", name, Thing(f"the given number `{name}`", place)
    for resolved in analysis.resolved:
        facts = resolved.facts
        yield "generated code", facts.item, facts
        if facts.variant is not None or resolved.point.was:
            for name, thing in _other_names(analysis, facts, resolved.point.was):
                yield "generated code", name, thing
    for enum in _enums(analysis):
        for name in (enum.name, *enum.was):
            yield "the enums of generated code", name, enum.thing


def _other_names(analysis: Analysis, facts: PointFacts, was: tuple[str, ...]) -> Iterator[tuple[str, Thing]]:
    """Yield the plain name of the first variant of a point, and the former names of a point."""
    if facts.variant is not None and facts is analysis.symbols.by_name[facts.name][0]:
        yield facts.name, Thing(f"the point `{facts.name}`", facts.span())
    for old in was:
        place = facts.span("was")
        if facts.variant is not None:
            yield item_of(old, facts.variant), Thing(f"the old name `{old}` of {_short(facts)}", place)
        yield old, Thing(f"the old name `{old}` of `{facts.name}`", place)


def thing_of(named: Named) -> Thing:
    """Return the owner of a name as messages word it, with its place."""
    return named if isinstance(named, Thing) else Thing(_point_words(named), named.span())


def _short(facts: PointFacts) -> str:
    return f"`{facts.name}`" if facts.variant is None else f"`{facts.name}` of {facts.variant}"


def _point_words(facts: PointFacts) -> str:
    return f"the point {_short(facts)}"


def _enums(analysis: Analysis) -> Iterator[_LocatedEnum]:
    """Yield the enums of generated points, each once, in the order of the points."""
    seen: set[tuple[str, int]] = set()
    for resolved in analysis.resolved:
        facts, enum = resolved.facts, resolved.point.named_numbers
        key = "enum" if resolved.point.digits is None else "digits"
        if enum is None or not resolved.point.generated:
            continue
        enum_as_written = facts.get("enum") if key == "enum" else facts.get("digits")["enum"]
        by_name = isinstance(enum_as_written, str)
        entries: Map = analysis.scope.named_enums[enum_as_written] if by_name else enum_as_written
        if (enum.name, id(entries)) in seen:
            continue
        seen.add((enum.name, id(entries)))
        thing = (
            _shared_enum(analysis, enum_as_written)
            if by_name
            else Thing(f"the enum of `{facts.name}`", facts.span(key))
        )
        yield _LocatedEnum(enum.name, enum.was, thing, entries)


def _shared_enum(analysis: Analysis, name: str) -> Thing:
    section = next(file["enums"] for file in analysis.scope.files if name in file.get("enums", {}))
    return Thing(f"the enum `{name}`", section.key_span(name))


class IdentifierPlaces:
    """Finds the owners of identifiers in a description."""

    def __init__(self, analysis: Analysis) -> None:
        self._analysis = analysis

    def thing(self, owner: Owner) -> Thing:
        """Return the owner as messages word it, with its place."""
        if owner.kind == "target":
            return Thing(owner.name, None)
        if owner.kind == "enum":
            return self._enums[owner.name].thing
        if owner.kind == "point":
            return Thing(self._point_words(owner), self._facts(owner).span())
        return Thing(self._words(owner), self._place(owner))

    def node(self, kind: str, name: str) -> Map | None:
        """Return what the description says about a listed thing; None if it has none of that kind and name."""
        scope, key = self._analysis.scope, _NAMING.get(kind, "name")
        if kind not in _LISTED:
            return None
        listed = scope.groups if kind == "group" else scope.listed(_LISTED[kind])
        signals = scope.listed("messages") if kind == "telegram" else ()  # they have a telegram, too
        return next((node for node in (*listed, *signals) if node[key] == name), None)

    @cached_property
    def _enums(self) -> dict[str, _LocatedEnum]:
        declared = self._analysis.scope.named_enums
        shared = {name: _LocatedEnum(name, (), _shared_enum(self._analysis, name), declared[name]) for name in declared}
        return shared | {enum.name: enum for enum in reversed(list(_enums(self._analysis)))}

    def _facts(self, point: Owner) -> PointFacts:
        return self._analysis.symbols.by_item(point.name)

    def _point_words(self, owner: Owner) -> str:
        facts = self._facts(owner)
        return _point_words(facts) if owner.name == facts.item else f"the point `{owner.name}`"

    def _words(self, owner: Owner) -> str:
        named = f"the {owner.kind} `{owner.name}`"
        if owner.of is None:
            return named
        whole = self.thing(owner.of).words.removeprefix("the point ")
        return f"{named} of {whole}"

    def _place(self, owner: Owner) -> Span:
        scope = self._analysis.scope
        if owner.of is not None:
            return self._place_of_part(owner, owner.of)
        if (node := self.node(owner.kind, owner.name)) is not None:
            return node.span(_NAMING.get(owner.kind, "name"))
        if owner.kind == "base":
            based = ((node, scope.base_of(node)) for node in scope.groups)
            group = next(node for node, base in based if base is not None and base.name == owner.name)
            return group.span("base" if "base" in group else "block")
        if owner.kind == "special codes":
            return self._holder_of_codes(owner).span("special")
        holder = scope.header.get("variants") if owner.kind == "variant" else None
        if owner.kind in OF_BUS and scope.bus is not None:
            holder = scope.bus.get(OF_BUS[owner.kind])
        return _key_place(holder, owner.name) or scope.header.span("device")

    def _place_of_part(self, owner: Owner, of: Owner) -> Span:
        if owner.kind == "entry":
            enum = self._enums[of.name]
            return _key_place(enum.entries, owner.name) or enum.entries.span()
        if of.kind == "flag" and of.of is not None:
            return self._place_of_part(of, of.of)
        facts = self._holder_of_codes(of) if of.kind == "special codes" else self._facts(of)
        if owner.kind == "numbering":
            return _key_place(facts.group.get("numbering"), owner.name) or facts.span()
        key = _OF_POINT.get(owner.kind)
        holders = (facts.get(key), facts.group.get(key)) if key else ()
        places = (_key_place(holder, owner.name) for holder in holders)
        return next(filter(None, places), None) or facts.span(key)

    def _holder_of_codes(self, codes: Owner) -> PointFacts:
        """Return the first point that has these shared special codes."""
        return next(resolved.facts for resolved in self._analysis.resolved if resolved.point.shared_codes == codes.name)


def _key_place(holder: object, name: str) -> Span | None:
    """Return the place of the key with the name, or of the key whose value is or contains the name."""
    for key, value in holder.items() if isinstance(holder, Map) else ():
        if name in (key, value, value.get("name") if isinstance(value, Map) else None):
            return holder.key_span(key) if isinstance(holder, Map) else None
    return None
