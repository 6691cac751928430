"""The generated points of a device with their fields and their views.

The texts of many points differ in a few words only. These words are the fields of a point, finished for C. The rest is
laid out once for all points with the same view, with placeholders for the fields.
"""

from collections.abc import Callable, Hashable, Iterable, Iterator
from functools import partial
from typing import NamedTuple

from fieldscribe.model import Device, Point
from fieldscribe.targets.c.declarations import PointComment, range_words
from fieldscribe.targets.c.limits import has_ranges_table, name_shared
from fieldscribe.targets.c.point_views import point_view
from fieldscribe.targets.c.scales import Scaled
from fieldscribe.targets.c.scope import HeaderScope, bare, hexadecimal, signed
from fieldscribe.targets.c.special_codes import encoded_limits
from fieldscribe.targets.c.views import PointFields, PointView
from fieldscribe.targets.placeholders import MOST_FIELDS, TextTemplates, placeholders
from fieldscribe.text import c_comment, c_string, upper


class LimitFields(NamedTuple):
    """The fields of a point's limits, and the `form` of the other text about them.

    `ends` are the six fields from `low` to `last`; `range` is for people. `in_table` says that a table holds the
    ranges; the first point with these ranges defines it.
    """

    ends: tuple[str, ...]
    range: str
    scale: Scaled | None
    form: Hashable
    in_table: bool


class GeneratedPoint(NamedTuple):
    """A point with code: the view that it shares with points of the same text, and the fields that fill the text."""

    point: Point
    view: PointView
    fields: tuple[str, ...]


def texts_of(points: Iterable[GeneratedPoint], lay_out: Callable[[PointView], str]) -> Iterator[str]:
    """Yield one part of the text of each point; it is laid out once for each view."""
    texts = TextTemplates()
    for _, view, fields in points:
        yield texts.fill(view, fields, partial(lay_out, view))


def generated_points(device: Device, scope: HeaderScope, *, names_only: bool = False) -> list[GeneratedPoint]:
    """Return the points of a device that have code; with `names_only`, only with what identifiers need."""
    points = [point for point in device.points if point.generated]
    name_shared(points, scope)
    views = _PointViews(scope)
    return list(map(views.named if names_only else views.generated, points))


class _PointViews:
    """Makes the views of a device's points, in the order of the points."""

    def __init__(self, scope: HeaderScope) -> None:
        self._scope = scope
        self._keys = scope.lowered.template_keys
        self._views: dict[Hashable, PointView] = {}
        self._limits: dict[tuple[int, int], LimitFields] = {}
        self._comments: dict[tuple[int, str | None], PointComment] = {}

    def generated(self, point: Point) -> GeneratedPoint:
        """Return the next point with its view and its fields."""
        key, item, scope = self._keys[id(point)], point.item, self._scope
        limited, commented = (key, id(point.allowed)), (key, scope.spaces.get(point.terms.group))
        limits = self._limits.get(limited) or self._limits.setdefault(limited, _limits_of(point))
        comment = self._comments.get(commented) or self._comments.setdefault(commented, PointComment(point, scope))
        fields = _fields_of(point, item, limits, comment)
        whole = key, limits.form, scope.brings(point), tuple(map(len, fields[1:]))  # not the comment
        view = self._views.get(whole)
        if limits.in_table or point.was or len(fields) > MOST_FIELDS:
            view = point_view(point, PointFields.of(fields), scope, limits.scale)
        elif view is None:
            fillers = PointFields.of(placeholders(fields))
            view = self._views[whole] = point_view(point, fillers, scope, limits.scale)
        return GeneratedPoint(point, view, fields)

    def named(self, point: Point) -> GeneratedPoint:
        """Return the next point with its names alone."""
        fields = ("", point.item, upper(point.item), *[""] * (len(PointFields._fields) - 4))
        return GeneratedPoint(point, point_view(point, PointFields.of(fields), self._scope, None), fields)


def fields_of(point: Point, scope: HeaderScope, remark: str = "") -> PointFields:
    """Return the fields of a single point; `remark` ends its comment."""
    limits = _limits_of(point)
    return PointFields.of(_fields_of(point, point.item, limits, PointComment(point, scope, remark)))


def _fields_of(point: Point, item: str, limits: LimitFields, comment: PointComment) -> tuple[str, ...]:
    """Return the fields in the order of `PointFields`."""
    addresses = point.place.addresses
    places = [""] * 4
    if addresses:
        least = min(addresses)
        places = [hexadecimal(least), hexadecimal(addresses[0]), hexadecimal(addresses[-1]), str(least)]
    code = "" if point.code is None else c_string(point.code)
    references = [
        c_string(printed) if isinstance(printed, str) else signed(printed)
        for printed in point.place.references.values()
    ]
    return (comment.of(point, limits.range), item, upper(item), *limits.ends, *places, code, *references)


def _limits_of(point: Point) -> LimitFields:
    allowed, (low, high) = point.allowed, (0, 0) if point.info.floating else point.outer
    scale = Scaled(point, *encoded_limits(point)) if point.form == "scaled" and not point.scale_arguments else None
    first, last = (0, 0) if scale is None else scale.counts
    form = (
        (low, high) == point.held if point.type != "u64" and not point.specials else allowed.fixed,
        scale and (scale.wide, scale.inside, (first, last) == (low, high), point.writable and scale.raw_of_count),
    )
    ends = bare(low), bare(high), signed(low), signed(high), bare(first), bare(last)
    return LimitFields(ends, c_comment(range_words(point)), scale, form, has_ranges_table(point))
