"""The attributes of the class of points: laid out once for all points with the same template, and filled."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import NamedTuple

from fieldscribe.conditions import absent
from fieldscribe.model import Device, Point, Variant
from fieldscribe.resources import Render
from fieldscribe.targets.placeholders import MOST_FIELDS, TextTemplates, placeholders
from fieldscribe.targets.python.device import in_python
from fieldscribe.targets.python.identifiers import PackageScope, attribute
from fieldscribe.targets.python.layout import Group, Node, docstring, laid_out, wrapped
from fieldscribe.targets.python.point_expressions import addresses_of, allowed, form, is_limited, number, place
from fieldscribe.text import python_doc, python_string
from fieldscribe.wording import codes_text, condition_text, open_text, overflow_texts, range_text, write_texts

BODY = 8
"""The indentation of an attribute's arguments."""

_MOST_ENDS = 16
"""The ends of at most so many intervals are fields."""

_WITH_RANGE = ("scaled", "float", "integer")
"""The forms whose docstring says the range."""


_KEEPS = {
    "no": "Lost at power-off",
    "yes": "Each write wears the memory",
    "choice": "`keep=True` keeps it and wears the EEPROM",
}
"""What becomes of a written value."""


class AttributeFields(NamedTuple):
    """The words that only one point has, or placeholders for them; what it lacks is empty.

    `numbers` is the class of its numbers or flags. `ends` are the bounds of its intervals.
    """

    name: str
    docstring: str
    group: str
    code: str
    default: str
    numbers: str
    addresses: tuple[str, ...]
    references: tuple[str, ...]
    ends: tuple[str, ...]


_FREE = AttributeFields._fields.index("numbers")
"""The fields before this one have a line of their own: no line break depends on their width."""
_SINGLE = AttributeFields._fields.index("addresses")


LimitTexts = tuple[str, tuple[str, ...]]
"""The limits of a point for its docstring, and their ends in code."""


class AttributeView(NamedTuple):
    """An attribute: its name, the function that makes it, its arguments, its docstring, its old names."""

    name: str
    maker: str
    arguments: tuple[str, ...]
    docstring: str
    old_names: tuple[str, ...] = ()


class Attributes:
    """Makes the texts of a device's attributes."""

    def __init__(self, device: Device, scope: PackageScope, render: Render) -> None:
        self._family = in_python(device)
        self._scope = scope
        self._render = render
        self._keys = scope.lowered.template_keys
        self._texts = TextTemplates()
        self._limits: dict[tuple[int, int], LimitTexts] = {}
        self._remarks: dict[int, tuple[str, list[str]]] = {}

    def of_point(self, point: Point) -> str:
        """Return the attribute of a point."""
        key, scope = self._keys[id(point)], self._scope
        limited = key, id(point.allowed)
        limits = self._limits.get(limited) or self._limits.setdefault(limited, _limits_of(point, scope))
        remarks = self._remarks.get(key) or self._remarks.setdefault(
            key, (_remarks(point, scope), _errata(point, scope))
        )
        fields = self._fields(point, limits, remarks)
        if len(fields) > MOST_FIELDS:
            return self.text(self._view(point, _named(fields, point)))
        whole = key, tuple(map(len, fields[_FREE:]))
        return self._texts.fill(
            whole, fields, lambda: self.text(self._view(point, _named(placeholders(fields), point)))
        )

    def by_variant(self, points: Mapping[Variant, Point]) -> str:
        """Return the attribute of points that have one name in different variants."""
        variant, first = next(iter(points.items()))
        chosen = [f"{python_string(variant.value)}: {attribute(point.item)}" for variant, point in points.items()]
        arguments = (python_string(variant.axis), laid_out(Group("{", tuple(chosen), "}"), BODY))
        doc = docstring(wrapped(python_doc(f"{first.title['en']}, as the device's {variant.axis} has it.")))
        old_names = tuple(dict.fromkeys(name for point in points.values() for name in point.was))
        maker = self._scope.runtime("ByVariant")
        return self.text(AttributeView(attribute(first.name), maker, arguments, doc, old_names))

    def text(self, view: AttributeView) -> str:
        """Return the text of an attribute."""
        if view.old_names:
            self._scope.runtime("renamed")
        return self._render("python/attribute.py.j2", {"attribute": view})

    def _fields(self, point: Point, limits: LimitTexts, remarks: tuple[str, list[str]]) -> tuple[str, ...]:
        """Return the fields in the order of `AttributeFields`."""
        names, shape, code = self._scope.names, point.shape, point.code
        return (
            attribute(point.name if point.variant is None else point.item),
            _docstring(point.title["en"], limits[0], *remarks),
            python_string(point.terms.group),
            python_string(code) if code else "",
            "" if point.default is None else number(point.default),
            names.word_class(point) if shape.form == "flags" else names.numbers_class(shape),
            *addresses_of(point.place.addresses, point.terms.space),
            *[
                python_string(printed) if isinstance(printed, str) else str(printed)
                for printed in point.place.references.values()
            ],
            *limits[1],
        )

    def _view(self, point: Point, fields: AttributeFields) -> AttributeView:
        maker = self._scope.runtime(self._family.maker(point))
        old_names = tuple(map(attribute, point.was)) if point.variant is None else ()
        arguments = tuple([laid_out(argument, BODY) for argument in _arguments(point, fields, self._scope)])
        return AttributeView(fields.name, maker, arguments, fields.docstring, old_names)


def _named(fields: tuple[str, ...], point: Point) -> AttributeFields:
    """Return fields by name."""
    addresses = _SINGLE + len(point.place.addresses)
    references = addresses + len(point.place.references)
    return AttributeFields._make(
        (*fields[:_SINGLE], fields[_SINGLE:addresses], fields[addresses:references], fields[references:])
    )


def _limits_of(point: Point, scope: PackageScope) -> LimitTexts:
    limits = point.allowed
    text = range_text(point, scope.lowered.points) if point.writable and point.form in _WITH_RANGE else ""
    if point.form == "float" or limits.moves or len(limits.intervals) * 2 > _MOST_ENDS or not is_limited(point):
        return text, ()
    return text, tuple([str(end) for interval in limits.fixed for end in interval])


def _docstring(title: str, limits: str, remarks: str, errata: list[str]) -> str:
    """Return the lines of a docstring: title, limits, remarks, and the errata that change facts."""
    text = f"{title}: {limits}" if limits else title
    lines = wrapped(python_doc(f"{text}{'' if text.endswith('.') else '.'}{remarks}"))
    return docstring(lines + errata)


def _remarks(point: Point, scope: PackageScope) -> str:
    remarks = ""
    if point.when is not None:
        remarks += f" Exists only when {condition_text(point.when, scope.lowered.points)}."
    if point.conditions and point.writable:
        remarks += f" To write it takes: {', '.join(condition.replace('_', ' ') for condition in point.conditions)}."
    if point.keeps and point.writable:
        remarks += f" {_KEEPS.get(point.keeps) or f'`{_keeps(point, scope)}.send()` keeps it'}."
    remarks += "".join(f" {text[0].upper()}{text[1:]}." for text in write_texts(point))
    if point.specials:
        remarks += f" {codes_text(point)}."
    remarks += "".join(f" O{text[1:]}." for text in overflow_texts(point))
    return remarks


def _keeps(point: Point, scope: PackageScope) -> str:
    """Return what keeps a written value, a command by its attribute."""
    return scope.commands.get(point.keeps or "", point.keeps or "")


def _errata(point: Point, scope: PackageScope) -> list[str]:
    changing, doubts = scope.lowered.errata_of(point)
    lines = ["", *wrapped(f"Errata: {', '.join(changing)}.")] if changing else []
    return [*lines, "", *wrapped(python_doc(f"The {open_text(doubts)}."))] if doubts else lines


def places(point: Point, addresses: Iterable[str], index: str, scope: PackageScope) -> Iterator[Node]:
    """Yield where the point is read, and where else it is written."""
    yield place("at", point, addresses, index, scope)
    if point.write_place is not None:
        yield place("write_at", point, addresses_of(point.write_place.addresses, point.space), index, scope)


def _arguments(point: Point, fields: AttributeFields, scope: PackageScope) -> Iterator[Node]:
    yield form(point, fields.numbers, scope)
    yield from _identity(point, fields, scope)
    if point.unit.symbol:
        yield f"unit={python_string(point.unit.symbol)}"
    if point.display is not None:
        yield f"display={point.display}"
    if is_limited(point):
        yield allowed(point, fields.ends, scope)
    if fields.default:
        yield f"default={fields.default}"
    if point.fixed is not None:
        yield f"fixed=(0x{point.fixed.mask:04X}, 0x{point.fixed.bits:04X})"
    if point.changes in ("never", "rarely"):
        yield f"changes={python_string(point.changes)}"
    if point.changes_with:
        yield Group("changes_with=(", tuple([python_string(name) for name in point.changes_with]))
    if point.writable:
        yield from _writing(point, scope)
    yield from _existence(point, scope)


def _writing(point: Point, scope: PackageScope) -> Iterator[Node]:
    """Yield what a writer has to know."""
    if point.conditions:
        yield Group("conditions=(", tuple([python_string(condition) for condition in point.conditions]))
    if point.takes_effect:
        yield f"takes_effect={python_string(point.takes_effect)}"
    if point.write_with:
        yield Group("write_with=(", tuple([python_string(name) for name in point.write_with]))
    if point.keeps:
        yield f"keeps={python_string(_keeps(point, scope))}"


def _identity(point: Point, fields: AttributeFields, scope: PackageScope) -> Iterator[Node]:
    """Yield the places of the point on the wire, and how the manual calls it."""
    yield from places(point, fields.addresses, "" if point.index is None else str(point.index), scope)
    if point.bits is not None:
        yield f"bits=({point.bits[0]}, {point.bits[1]})"
    yield f"group={fields.group}"
    if fields.code:
        yield f"code={fields.code}"
    if fields.references:
        numbers = zip(point.references, fields.references, strict=True)
        yield Group("references={", tuple([f'"{key}": {number}' for key, number in numbers]), "}")


def _existence(point: Point, scope: PackageScope) -> Iterator[Node]:
    """Yield the arguments that say in which devices the point exists."""
    if point.variant is not None:
        yield Group("variant=(", (python_string(point.variant.axis), python_string(point.variant.value)))
        yield f"name={python_string(point.name)}"
    others = set() if point.when is None else {*point.when.names}
    if choice := _only_for(point, scope.variants):
        yield Group("only_for=(", (python_string(choice[0]), Group("(", tuple(map(python_string, choice[1])))))
        others.remove(choice[0])
    if others or point.since is not None or point.until is not None or point.to_end:
        yield "uncertain=True"  # another axis, a point, the firmware or the length of a block decides too


def _only_for(point: Point, variants: Mapping[str, tuple[str, ...]]) -> tuple[str, tuple[str, ...]] | None:
    """Return the first axis that decides about the point's existence, and the values for which it can exist."""
    for axis in () if point.when is None else point.when.names:
        values = variants.get(axis, ())
        left = tuple([value for value in values if not absent(point.when, {**variants, axis: (value,)})])
        if left != values:
            return axis, left
    return None
