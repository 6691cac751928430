"""What the targets make of the names in a description: one identifier per namespace, with the place of its name."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from fieldscribe.diagnostics import Span
from fieldscribe.names import RUST_CONSTANTS, RUST_UNKNOWN, pascal
from fieldscribe.resolve.drafts import Draft, groups

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.checks.subject import Subject
    from fieldscribe.language.nodes import Map
    from fieldscribe.model import Entry, Enum, Point
    from fieldscribe.resolve.points import Resolved


class Claim(NamedTuple):
    """A thing that wants an identifier. `what` names it in messages; `holder` and `key` say where its name stands."""

    namespace: str
    identifier: str
    what: str
    holder: Draft | Map | None
    key: str | None = None

    @property
    def span(self) -> Span:
        """Where the name stands."""
        if isinstance(self.holder, Draft):
            return self.holder.span(self.key)
        if self.holder is None:
            return Span("", 1, 1)
        return self.holder.key_span(self.key) if self.key in self.holder.places else self.holder.span(self.key)


def claims(subject: Subject) -> Iterator[Claim]:
    """Everything that one device names."""
    yield from _groups(subject)
    seen: set[tuple[str, int]] = set()
    for resolved in subject.resolved:
        yield from _point(subject, resolved)
        if not resolved.point.generated:
            continue
        for key, enum in enums_of(resolved.point):
            if (enum.name, id(resolved.draft.layer(key))) not in seen:
                seen.add((enum.name, id(resolved.draft.layer(key))))
                yield from _enum(subject, resolved.draft, enum, key)
        if resolved.point.flags:
            yield from _flags(resolved)
        for special in resolved.point.specials:
            if special.name in RUST_CONSTANTS:
                name, space = special.name.upper(), f"Rust, in `{resolved.point.item}`"
                yield Claim(space, name, f"the constant `{name}` of every point", None)
                yield Claim(space, name, f"the code `{special.name}`", resolved.draft, "special")


def enums_of(point: Point) -> Iterator[tuple[str, Enum]]:
    """The enums of a point, with the key that says them."""
    if point.enum is not None:
        yield "enum", point.enum
    if point.digits is not None:
        yield "digits", point.digits.enum


def _groups(subject: Subject) -> Iterator[Claim]:
    for group in groups(subject.scope):
        yield Claim("", f"group {group['name']}", f"the group `{group['name']}`", group, "name")


def _point(subject: Subject, resolved: Resolved) -> Iterator[Claim]:
    """A point under its name, its names in variants and its former names."""
    point, draft = resolved.point, resolved.draft
    what = f"the point `{point.name}`" if point.variant is None else f"the point `{point.name}` of {point.variant}"
    yield Claim("generated code", point.item, what, draft)
    if point.variant is not None:
        yield Claim("generated code", point.name, f"the point `{point.name}`", subject.index.by_name[point.name][0])
    for old in point.was:
        if point.variant is not None:
            held = f"the old name `{old}` of `{point.name}` of {point.variant}"
            yield Claim("generated code", old + point.item[len(point.name) :], held, draft.layer("was"), "was")
        yield Claim("generated code", old, f"the old name `{old}` of `{point.name}`", draft.layer("was"), "was")
    if point.generated:
        type_name = pascal(point.item)
        yield Claim("Rust", type_name, what, draft)
        if point.scale is not None and point.scale_arguments not in ((), point.arguments):
            yield Claim("Rust", f"{type_name}Factors", f"what {what} needs", draft)


def _enum(subject: Subject, draft: Draft, enum: Enum, key: str) -> Iterator[Claim]:
    said = draft.get("enum") if key == "enum" else draft.get(key)["enum"]
    shared = isinstance(said, str)
    holder = subject.scope.named_enums[said] if shared else said
    what = f"the enum `{enum.name}`" if shared else f"the enum of `{draft.name}`"
    if shared:
        file = next(file for file in subject.scope.files if said in file.get("enums", {}))
        yield Claim("the enums of generated code", pascal(enum.name), what, file["enums"], said)
    else:
        yield Claim("the enums of generated code", pascal(enum.name), what, draft.layer(key), key)
    space = f"Rust, in {what}"
    for entry in enum.entries:
        yield Claim(space, pascal(entry.name), f"`{entry.name}`", holder, _key(holder, entry))
    if {pascal(entry.name) for entry in enum.entries}.issuperset(RUST_UNKNOWN):
        yield Claim(space, RUST_UNKNOWN[0], "a number without a name", None)


def _key(holder: Map, entry: Entry) -> str | None:
    return next(
        (key for key, value in holder.items() if (value if isinstance(value, str) else value["name"]) == entry.name),
        None,
    )


def _flags(resolved: Resolved) -> Iterator[Claim]:
    """The constants, getters and setters of a word of flags in Rust."""
    raw: Map = resolved.draft.get("flags")
    keys = {value if isinstance(value, str) else str(value["name"]): key for key, value in raw.items()}
    space = f"Rust, in the flags of `{resolved.point.name}`"
    for flag in resolved.point.flags:
        what, key = f"the flag `{flag.name}`", keys.get(flag.name)
        getter = f"get_{flag.name}" if flag.name.startswith(("from_", "as_", "into_", "to_")) else flag.name
        for identifier in (flag.name.upper(), getter, f"with_{flag.name}"):
            yield Claim(space, identifier, what, raw, key)
        for value in flag.values:
            yield Claim(space, f"{flag.name}_{value.name}".upper(), f"`{value.name}` of {what}", raw, key)
