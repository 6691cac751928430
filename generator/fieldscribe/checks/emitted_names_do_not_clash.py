"""No two things get one identifier in what any target emits: each target lists its names, and here they are compared.

It needs the whole model, so it looks at devices without other errors. What authors mix up often is found before, with
closer places, by `names_do_not_clash`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.diagnostics import Span

if TYPE_CHECKING:
    from collections.abc import Iterable

    from fieldscribe.checks.subject import Subject
    from fieldscribe.language.nodes import Map
    from fieldscribe.resolve.drafts import Draft
    from fieldscribe.targets.identifiers import Clash, Owner

_SECTIONS = {"command": "commands", "message": "messages", "telegram": "telegrams"}


def check(subject: Subject) -> None:
    """Names that meet in a target, whichever is generated today."""
    if subject.report.has_errors:
        return
    from fieldscribe.targets import NAMESPACES, knows, target
    from fieldscribe.targets.identifiers import clashes

    _, device = subject.models
    places: _Places | None = None
    told: set[tuple[str, str]] = set()
    for name in (one for one in NAMESPACES if knows(one, device)):
        for clash in clashes(target(name).identifiers(device)):
            places = places or _Places(subject)
            if (pair := (str(clash.first), str(clash.second))) not in told:
                told.add(pair)
                _report(subject, places, clash)


def _report(subject: Subject, places: _Places, clash: Clash) -> None:
    first, second = clash.first, clash.second
    if second.kind == "target":
        first, second = second, first
    related = [] if first.kind == "target" else [(places.of(first), f"{first} stands here")]
    message = f"{first} and {second} would both be `{clash.name}` in {clash.namespace}"
    hint = "choose another name" if first.kind == "target" else "rename one of them"
    subject.report.error("name-clash", message, places.of(second), hint, related)


class _Places:
    """Where owners of names stand in the text."""

    def __init__(self, subject: Subject) -> None:
        self.subject = subject
        self.enums: dict[str, Draft] = {}
        for one in reversed(subject.resolved):
            for enum in (one.point.enum, one.point.digits and one.point.digits.enum):
                if enum:
                    self.enums[enum.name] = one.draft

    def of(self, owner: Owner) -> Span:
        """The place of the thing, or of the key that holds the part of it."""
        scope = self.subject.scope
        if owner.kind == "point":
            return self._of_point(owner)
        if owner.kind == "enum" and owner.name in self.enums:
            return self.enums[owner.name].span("enum")
        if owner.kind in _SECTIONS:
            for raw in scope.listed(_SECTIONS[owner.kind]):
                if raw["name"] == owner.name:
                    return raw.span("name")
        if owner.kind == "variant":
            variants: Map = scope.header["variants"]
            return variants.key_span(owner.name)
        return scope.bus.span() if owner.kind == "code" and scope.bus is not None else scope.header.span("device")

    def _of_point(self, owner: Owner) -> Span:
        index = self.subject.index
        known: Iterable[Draft] = [*filter(None, [index.by_items.get(owner.name)]), *index.by_name.get(owner.name, [])]
        for draft in known:
            key = owner.part.partition(" ")[0]
            return draft.span({"flag": "flags", "code": "special", "old": "was"}.get(key))
        return Span(self.subject.scope.header.file.name, 1, 1)
