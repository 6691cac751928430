"""The attributes of the class of points: laid out once for all points with the same template, and filled."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from fieldscribe.model import Point, Variant
from fieldscribe.resources import Render
from fieldscribe.targets.placeholders import MOST_FIELDS, TextTemplates, placeholders
from fieldscribe.targets.python.identifiers import attribute
from fieldscribe.targets.python.layout import arguments, docstring, leaf, wrapped
from fieldscribe.targets.runtime_calls.expressions import Call, Name
from fieldscribe.targets.runtime_calls.point_call import (
    PointFields,
    attribute_of,
    call_of,
    keeps,
    numbers_of,
    old_attributes,
    old_names_of,
    variants_call,
)
from fieldscribe.targets.runtime_calls.point_expressions import addresses_of, is_limited, number
from fieldscribe.targets.runtime_calls.scope import Scope
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


_FREE = 5
"""The fields before this one have a line of their own: no line break depends on their width."""
_SINGLE = 6
"""Those behind have several texts each."""


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

    def __init__(self, scope: Scope, render: Render) -> None:
        self._scope = scope
        self._render = render
        self._keys = scope.lowered.template_keys
        self._texts = TextTemplates()
        self._limits: dict[tuple[int, int], LimitTexts] = {}
        self._remarks: dict[int, tuple[str, list[str]]] = {}

    def of(self, member: Point | dict[Variant, Point]) -> str:
        """Return the attribute of a point, or of points that have one name in different variants."""
        return self.of_point(member) if isinstance(member, Point) else self.by_variant(member)

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
            return self.text(self._view(point, fields))
        whole = key, tuple(map(len, fields[_FREE:]))
        return self._texts.fill(whole, fields, lambda: self.text(self._view(point, placeholders(fields))))

    def by_variant(self, points: Mapping[Variant, Point]) -> str:
        """Return the attribute of points that have one name in different variants."""
        variant, first = next(iter(points.items()))
        doc = docstring(wrapped(python_doc(f"{first.title['en']}, as the device's {variant.axis} has it.")))
        made = variants_call(points, self._scope)
        return self.text(attribute_view(attribute(first.name), made, doc, old_names_of(points)))

    def text(self, view: AttributeView) -> str:
        """Return the text of an attribute."""
        if view.old_names:
            self._scope.runtime("renamed")
        return self._render("python/attribute.py.j2", {"attribute": view})

    def _fields(self, point: Point, limits: LimitTexts, remarks: tuple[str, list[str]]) -> tuple[str, ...]:
        """Return the texts that only this point has: attribute, docstring, then those of `PointFields`."""
        code = point.code
        return (
            attribute_of(point, self._scope),
            _docstring(point.title["en"], limits[0], *remarks),
            python_string(point.terms.group),
            python_string(code) if code else "",
            "" if point.default is None else str(number(point.default)),
            numbers_of(point, self._scope),
            *map(leaf, addresses_of(point.place.addresses, point.terms.space)),
            *map(leaf, point.place.references.values()),
            *limits[1],
        )

    def _view(self, point: Point, texts: tuple[str, ...]) -> AttributeView:
        made = call_of(point, _named(texts, point), self._scope)
        return attribute_view(texts[0], made, texts[1], old_attributes(point, self._scope))


def attribute_view(name: str, made: Call, doc: str, old_names: tuple[str, ...] = ()) -> AttributeView:
    """Return the view of an attribute that a call makes."""
    return AttributeView(name, made.name, arguments(made, BODY), doc, old_names)


def _named(texts: tuple[str, ...], point: Point) -> PointFields:
    """Return the texts of a point by name."""
    fields = tuple(map(Name, texts))
    addresses = _SINGLE + len(point.place.addresses)
    references = addresses + len(point.place.references)
    group, code, default, numbers = fields[2:_SINGLE]
    several = fields[_SINGLE:addresses], fields[addresses:references], fields[references:]
    return PointFields(group, code or None, default or None, numbers, *several)


def _limits_of(point: Point, scope: Scope) -> LimitTexts:
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


def _remarks(point: Point, scope: Scope) -> str:
    remarks = ""
    if point.when is not None:
        remarks += f" Exists only when {condition_text(point.when, scope.lowered.points)}."
    if point.conditions and point.writable:
        remarks += f" To write it takes: {', '.join(condition.replace('_', ' ') for condition in point.conditions)}."
    if point.keeps and point.writable:
        remarks += f" {_KEEPS.get(point.keeps) or f'`{keeps(point, scope)}.send()` keeps it'}."
    remarks += "".join(f" {text[0].upper()}{text[1:]}." for text in write_texts(point))
    if point.specials:
        remarks += f" {codes_text(point)}."
    remarks += "".join(f" O{text[1:]}." for text in overflow_texts(point))
    return remarks


def _errata(point: Point, scope: Scope) -> list[str]:
    changing, doubts = scope.lowered.errata_of(point)
    lines = ["", *wrapped(f"Errata: {', '.join(changing)}.")] if changing else []
    return [*lines, "", *wrapped(python_doc(f"The {open_text(doubts)}."))] if doubts else lines
