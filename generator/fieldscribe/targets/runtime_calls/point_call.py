"""The call that creates a point: its form, and all facts about it."""

from collections.abc import Iterable, Iterator, Mapping
from typing import NamedTuple

from fieldscribe.conditions import absent
from fieldscribe.model import Point, Variant
from fieldscribe.targets.runtime_calls.point_expressions import (
    addresses_of,
    allowed,
    form,
    is_limited,
    number,
    place,
    tests_of,
)
from fieldscribe.targets.runtime_calls.scope import Call, Hex, Name, Node, PointName, Scope, call, family_calls

_Facts = Iterator[tuple[str, Node]]


class PointFields(NamedTuple):
    """The facts of one point, as values or placeholders for them; an absent fact is empty (default and code: None).

    `numbers` is the class of its numbers or flags. `ends` are the bounds of its intervals.
    """

    group: Node
    code: Node
    default: Node
    numbers: str
    addresses: tuple[Node, ...]
    references: tuple[Node, ...]
    ends: tuple[Node, ...]


def fields_of(point: Point, scope: Scope) -> PointFields:
    """Return the fields of a point as values."""
    default = None if point.default is None else number(point.default)
    references = tuple(point.place.references.values())
    return PointFields(
        point.group, point.code or None, default, numbers_of(point, scope), point.addresses, references, ()
    )


def attribute_of(point: Point, scope: Scope) -> str:
    """Return the attribute of a point; one that only a variant has is named after its item."""
    return scope.attribute(point.name if point.variant is None else point.item)


def old_attributes(point: Point, scope: Scope) -> tuple[str, ...]:
    """Return the old attributes of a point; those of one that only a variant has belong to all of its name."""
    return () if point.variant is not None else tuple(map(scope.attribute, point.was))


def variants_call(points: Mapping[Variant, Point], scope: Scope) -> Call:
    """Return the call that creates the attribute of points that have one name in different variants."""
    axis = next(iter(points)).axis
    chosen = {variant.value: Name(attribute_of(point, scope)) for variant, point in points.items()}
    return call(scope.runtime("ByVariant"), axis, chosen)


def old_names_of(points: Mapping[Variant, Point]) -> tuple[str, ...]:
    """Return the old attributes of points that have one name in different variants."""
    return tuple(dict.fromkeys(name for point in points.values() for name in point.was))


def call_of(point: Point, fields: PointFields, scope: Scope) -> Call:
    """Return the call that creates a point."""
    maker = scope.runtime(family_calls(scope.device).maker(point))
    return call(maker, form(point, fields.numbers, scope), **dict(_facts(point, fields, scope)))


def numbers_of(point: Point, scope: Scope) -> str:
    """Return the class of a point's numbers or flags; empty if there is none."""
    return scope.names.word_class(point) if point.form == "flags" else scope.names.numbers_class(point)


def keeps(point: Point, scope: Scope) -> str:
    """Return how a written value is kept; a command by its attribute."""
    return scope.commands.get(point.keeps or "", point.keeps or "")


def places(point: Point, addresses: Iterable[Node], scope: Scope) -> _Facts:
    """Yield where the point is read, and where else it is written."""
    yield "at", place(point, addresses, scope)
    if point.write_place is not None:
        yield "write_at", place(point, addresses_of(point.write_place.addresses, point.space), scope)


def _facts(point: Point, fields: PointFields, scope: Scope) -> _Facts:
    yield from _identity(point, fields, scope)
    if point.unit.symbol and not point.epoch:
        yield "unit", point.unit.symbol
    if point.display is not None:
        yield "display", point.display
    if is_limited(point):
        yield "allowed", allowed(point, fields.ends, scope)
    if fields.default is not None:
        yield "default", fields.default
    if point.fixed is not None:
        yield "fixed", (Hex(point.fixed.mask), Hex(point.fixed.bits))
    if point.changes in ("never", "rarely"):
        yield "changes", point.changes
    if point.changes_with:
        yield "changes_with", tuple(map(PointName, point.changes_with))
    if point.writable:
        yield from _writing(point, scope)
    if point.selects:
        yield "selects", tuple((PointName(name), raw) for name, raw in point.selects)
    yield from _existence(point, scope)


def _writing(point: Point, scope: Scope) -> _Facts:
    """Yield the facts about writing."""
    if point.conditions:
        yield "conditions", point.conditions
    if point.takes_effect:
        yield "takes_effect", point.takes_effect
    if point.write_with:
        yield "write_with", tuple(map(PointName, point.write_with))
    if point.keeps:
        yield "keeps", keeps(point, scope)


def _identity(point: Point, fields: PointFields, scope: Scope) -> _Facts:
    """Yield the places of the point on the wire, and its names in the manual."""
    yield from places(point, fields.addresses, scope)
    if point.bits is not None:
        yield "bits", point.bits
    yield "group", fields.group
    if fields.code is not None:
        yield "code", fields.code
    if fields.references:
        yield "references", dict(zip(point.references, fields.references, strict=True))


def _existence(point: Point, scope: Scope) -> _Facts:
    """Yield the facts that decide in which devices the point exists."""
    if point.variant is not None:
        yield "variant", (point.variant.axis, point.variant.value)
        yield "name", point.name
    others = set() if point.when is None else {*point.when.names}
    if choice := _only_for(point, scope.device.variants):
        yield "only_for", choice
        others.remove(choice[0])
    if others or point.since is not None or point.until is not None or point.to_end:
        yield "uncertain", True  # another axis, a point, the firmware or the length of a block matters too
    if point.when is not None and not scope.device.variants.keys() >= {*point.when.names}:
        yield "when", tests_of(point.when)


def _only_for(point: Point, variants: Mapping[str, tuple[str, ...]]) -> tuple[str, tuple[str, ...]] | None:
    """Return the first axis that decides about the point's existence, and the values for which it can exist."""
    for axis in () if point.when is None else point.when.names:
        values = variants.get(axis, ())
        left = tuple([value for value in values if not absent(point.when, {**variants, axis: (value,)})])
        if left != values:
            return axis, left
    return None
