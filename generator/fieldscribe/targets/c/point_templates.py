"""The generated points of a device with their fields and their templates.

A header says the same of many points but for a few words. These words are the fields of a point, finished for C; the
rest is laid out once for all points with the same template, with placeholders for the fields.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from fieldscribe.names import upper
from fieldscribe.targets.c.declarations import PointComment, range_words
from fieldscribe.targets.c.limits import has_ranges_table
from fieldscribe.targets.c.literals import bare, hexadecimal, signed
from fieldscribe.targets.c.point_views import Brings, named_numbers, point_view
from fieldscribe.targets.c.scales import Scaled
from fieldscribe.targets.c.special_codes import encoded_limits
from fieldscribe.targets.c.views import PointFields
from fieldscribe.targets.placeholders import MOST_FIELDS, TextTemplate, placeholders
from fieldscribe.text import c_comment, c_string

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable

    from fieldscribe.model import Device, Point
    from fieldscribe.targets.c.scope import HeaderScope
    from fieldscribe.targets.c.views import PointView


class LimitFields(NamedTuple):
    """The fields that a point has of its limits, and the `form` of the rest of its text about them.

    `low` and `high` bound raw numbers, `first` and `last` counts; `range` is for people. `in_table` says that a table
    holds the ranges, which the first point that has them brings.
    """

    low: str
    high: str
    low_signed: str
    high_signed: str
    first: str
    last: str
    range: str
    scale: Scaled | None
    form: Hashable
    in_table: bool


@dataclass(frozen=True, slots=True, eq=False)
class PointTemplate:
    """The first of the points with one text, and its view with placeholders for the fields."""

    point: Point
    view: PointView


class GeneratedPoint(NamedTuple):
    """A point for which there is code, its template, and the fields that fill it."""

    point: Point
    template: PointTemplate
    fields: tuple[str, ...]


class TemplateTexts:
    """One part of the text of points: laid out once for each template, and filled for each point."""

    def __init__(self, lay_out: Callable[[PointTemplate], str]) -> None:
        self._lay_out = lay_out
        self._texts: dict[PointTemplate, TextTemplate] = {}

    def of(self, generated: GeneratedPoint) -> str:
        """Return the text of a point."""
        template = generated.template
        text = self._texts.get(template)
        if text is None:
            text = self._texts[template] = TextTemplate(self._lay_out(template))
        return text.fill(generated.fields)


def generated_points(device: Device, scope: HeaderScope, *, names_only: bool = False) -> list[GeneratedPoint]:
    """Return the points of a device that have code; with `names_only` just with what their names follow from."""
    templates = _PointTemplates(scope)
    make = templates.named if names_only else templates.generated
    return [make(point) for point in device.points if point.generated]


class _PointTemplates:
    """Makes the templates of a device's points, in the order of the points."""

    def __init__(self, scope: HeaderScope) -> None:
        self._scope = scope
        self._keys = scope.lowered.template_keys
        self._templates: dict[Hashable, PointTemplate] = {}
        self._limits: dict[tuple[int, int], LimitFields] = {}
        self._comments: dict[tuple[int, str | None], PointComment] = {}

    def generated(self, point: Point) -> GeneratedPoint:
        """Return the next point with its template and its fields."""
        key, item, scope = self._keys[id(point)], point.item, self._scope
        limits = self._limits.get((key, id(point.allowed)))
        if limits is None:
            limits = self._limits[key, id(point.allowed)] = _limits_of(point)
        commented = key, scope.spaces.get(point.terms.group)
        comment = self._comments.get(commented)
        if comment is None:
            comment = self._comments[commented] = PointComment(point, scope)
        fields = _fields_of(point, item, limits, comment)
        brings = self._brings(point, item)
        if limits.in_table or point.was or len(fields) > MOST_FIELDS:
            view = point_view(point, PointFields.of(fields), scope, brings, limits.scale)
            return GeneratedPoint(point, PointTemplate(point, view), fields)
        whole = key, limits.form, brings, tuple(map(len, fields[1:]))  # the comment breaks no line of others
        template = self._templates.get(whole)
        if template is None:
            view = point_view(point, PointFields.of(placeholders(fields)), scope, brings, limits.scale)
            template = self._templates[whole] = PointTemplate(point, view)
        return GeneratedPoint(point, template, fields)

    def named(self, point: Point) -> GeneratedPoint:
        """Return the next point with its names alone."""
        fields = ("", point.item, upper(point.item), *[""] * (len(PointFields._fields) - 4))
        view = point_view(point, PointFields.of(fields), self._scope, self._brings(point, point.item), None)
        return GeneratedPoint(point, PointTemplate(point, view), fields)

    def _brings(self, point: Point, item: str) -> Brings:
        enum, codes = named_numbers(point), point.shape.shared_codes
        names = enum is not None and self._scope.is_first(item, f"names of {enum.name}")
        return Brings(names, bool(codes) and self._scope.is_first(item, f"codes of {codes}"))


def fields_of(point: Point, scope: HeaderScope, remark: str = "") -> PointFields:
    """Return the fields of a single point; `remark` ends its comment."""
    limits = _limits_of(point)
    return PointFields.of(_fields_of(point, point.item, limits, PointComment(point, scope, remark)))


def _fields_of(point: Point, item: str, limits: LimitFields, comment: PointComment) -> tuple[str, ...]:
    """Return the fields in the order of `PointFields`."""
    addresses = point.place.addresses
    if len(addresses) == 1:
        lowest = start = end = hexadecimal(addresses[0])
        number = str(addresses[0])
    elif addresses:
        least = min(addresses)
        lowest, start, end = hexadecimal(least), hexadecimal(addresses[0]), hexadecimal(addresses[-1])
        number = str(least)
    else:
        lowest = start = end = number = ""
    code = "" if point.code is None else c_string(point.code)
    references = [
        c_string(printed) if isinstance(printed, str) else signed(printed)
        for printed in point.place.references.values()
    ]
    text = comment.of(point, limits.range)
    return (text, item, upper(item), *limits[:6], lowest, start, end, number, code, *references)


def _limits_of(point: Point) -> LimitFields:
    allowed, (low, high) = point.allowed, (0, 0) if point.info.floating else point.outer
    scale = Scaled(point, *encoded_limits(point)) if point.form == "scaled" and not point.scale_arguments else None
    first, last = (0, 0) if scale is None else scale.counts
    form = (
        (low, high) == point.held if point.type != "u64" and not point.specials else allowed.fixed,
        scale and (scale.wide, scale.inside, (first, last) == (low, high), point.writable and scale.raw_of_count),
    )
    ends = bare(low), bare(high), signed(low), signed(high), bare(first), bare(last)
    return LimitFields(*ends, c_comment(range_words(point)), scale, form, has_ranges_table(point))
