"""The attributes of the class of points: laid out once for all points that are alike, and filled with their words."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.patterns import Pattern
from fieldscribe.targets.python.existence import only_for, uncertain
from fieldscribe.targets.python.families import in_python
from fieldscribe.targets.python.forms import NUMBERED, addresses_of, allowed, form, place
from fieldscribe.targets.python.identifiers import attribute
from fieldscribe.targets.python.kinds import Kinds
from fieldscribe.targets.python.layout import Group, Node, docstring, laid_out, wrapped
from fieldscribe.targets.python.words import blanked, likeness, words_of
from fieldscribe.text import python_doc, python_string

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from fieldscribe.model import Device, Point, Variant
    from fieldscribe.render import Render
    from fieldscribe.targets.python.kinds import Limits
    from fieldscribe.targets.python.scope import PackageScope
    from fieldscribe.targets.python.words import Words

BODY = 8
"""The indentation of an attribute's arguments."""


@dataclass(frozen=True, slots=True)
class AttributeView:
    """An attribute: its name, the function that makes it, its arguments, its docstring, its old names."""

    name: str
    maker: str
    arguments: tuple[str, ...]
    docstring: str
    old_names: tuple[str, ...] = ()


class Attributes:
    """The texts of a device's attributes."""

    def __init__(self, device: Device, scope: PackageScope, render: Render) -> None:
        self._family = in_python(device)
        self._scope = scope
        self._render = render
        self._kinds = Kinds(scope)
        self._patterns: dict[object, Pattern] = {}

    def of_point(self, point: Point) -> str:
        """The attribute of a point."""
        kind = self._kinds.of(point)
        limits = kind.limits_of(point, self._scope)
        words = words_of(point, kind, limits, self._scope)
        alike = likeness(point, kind, limits, words)
        pattern = self._patterns.get(alike)
        if pattern is None:
            pattern = self._patterns[alike] = Pattern(self.text(self._view(point, limits, blanked(words, point))))
        return pattern.filled(words)

    def by_variant(self, points: Mapping[Variant, Point]) -> str:
        """The attribute of points that have one name in different variants."""
        self._scope.used.add("ByVariant")
        variant, first = next(iter(points.items()))
        chosen = [f"{python_string(variant.value)}: {attribute(point.item)}" for variant, point in points.items()]
        arguments = (python_string(variant.axis), laid_out(Group("{", tuple(chosen), "}"), BODY))
        doc = wrapped(python_doc(f"{first.title['en']}, as the device's {variant.axis} has it."))
        old_names = tuple(dict.fromkeys(name for point in points.values() for name in point.was))
        return self.text(
            AttributeView(attribute(first.name), "ByVariant", arguments, "\n".join(docstring(doc)), old_names)
        )

    def text(self, view: AttributeView) -> str:
        """The text of an attribute."""
        if view.old_names:
            self._scope.used.add("renamed")
        return self._render("python/attribute.py.j2", {"attribute": view})

    def _view(self, point: Point, limits: Limits, words: Words) -> AttributeView:
        maker = self._family.maker(point)
        self._scope.used.add(maker)
        old_names = tuple(map(attribute, point.was)) if point.variant is None else ()
        arguments = tuple([laid_out(argument, BODY) for argument in _arguments(point, limits, words, self._scope)])
        return AttributeView(words.name, maker, arguments, words.docstring, old_names)


def places(point: Point, addresses: tuple[str, ...], index: str, scope: PackageScope) -> Iterator[Node]:
    """Where the point is read, and where else it is written."""
    yield place("at", point, addresses, index, scope)
    if point.write_place is not None:
        written = addresses_of(point.write_place.addresses, numbered=point.space in NUMBERED)
        yield place("write_at", point, written, index, scope)


def _arguments(point: Point, limits: Limits, words: Words, scope: PackageScope) -> Iterator[Node]:
    yield form(point, words.named, scope)
    yield from _identity(point, words, scope)
    if point.unit.symbol:
        yield f"unit={python_string(point.unit.symbol)}"
    if point.display is not None:
        yield f"display={point.display}"
    if limits.form is not None and point.form != "float":
        yield allowed(point, words.ends, scope)
    if words.default:
        yield f"default={words.default}"
    if point.fixed is not None:
        yield f"fixed=(0x{point.fixed.mask:04X}, 0x{point.fixed.bits:04X})"
    if point.changes in ("never", "rarely"):
        yield f"changes={python_string(point.changes)}"
    if point.changes_with:
        yield Group("changes_with=(", tuple([python_string(name) for name in point.changes_with]))
    if point.conditions and point.writable:
        yield Group("conditions=(", tuple([python_string(condition) for condition in point.conditions]))
    yield from _existence(point, scope)


def _identity(point: Point, words: Words, scope: PackageScope) -> Iterator[Node]:
    """The places of the point on the wire, and how the manual calls it."""
    yield from places(point, words.addresses, words.array_index, scope)
    if point.bits is not None:
        yield f"bits=({point.bits[0]}, {point.bits[1]})"
    yield f"group={words.group}"
    if words.code:
        yield f"code={words.code}"
    if words.references:
        numbers = zip(point.references, words.references, strict=True)
        yield Group("references={", tuple([f'"{key}": {number}' for key, number in numbers]), "}")


def _existence(point: Point, scope: PackageScope) -> Iterator[Node]:
    """In which devices the point exists."""
    if point.variant is not None:
        yield Group("variant=(", (python_string(point.variant.axis), python_string(point.variant.value)))
        yield f"name={python_string(point.name)}"
    if choice := only_for(point, scope.variants):
        yield Group("only_for=(", (python_string(choice[0]), Group("(", tuple(map(python_string, choice[1])))))
    if uncertain(point, scope.variants):
        yield "uncertain=True"
