"""The points as rows of the page and of the sheet: what points that are alike say, and what each says of itself."""

from __future__ import annotations

from operator import attrgetter
from typing import TYPE_CHECKING, NamedTuple

from fieldscribe import wording
from fieldscribe.model import Shape
from fieldscribe.targets.docs.cells import LINE_BREAK, cell, narrow, number_cell
from fieldscribe.wording.exact import fixed_rule
from fieldscribe.wording.rules import RenamedPoints

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence

    from fieldscribe.model import Device, Point

_UNNAMED = attrgetter(*(name for name in Shape.__annotations__ if name != "enum"))
"""All facts of a shape but its enum: rows say the names of numbers, and only links say the name of the enum."""


class Limits(NamedTuple):
    """What rows of the page say of limits: range and raw range. Points that say the same have the same object."""

    page: tuple[str, str]


class Subject(NamedTuple):
    """A point; `kin` is the number of all points that differ only in words of their identity and in limits."""

    point: Point
    kin: int
    limits: Limits


class Scope(NamedTuple):
    """What all rows of a device share."""

    device: Device
    by_name: Mapping[str, Point]
    by_code: RenamedPoints
    subjects: tuple[Subject, ...]
    several: bool
    """Whether facts come from several documents, so that each source names its own."""


def scope_of(device: Device) -> Scope:
    """The points of a device for its rows."""
    by_name = {point.name: point for point in device.points}
    by_code = RenamedPoints(by_name, _codes(device.points))
    return Scope(device, by_name, by_code, tuple(_subjects(device.points, by_code)), len(device.documents) > 1)


def _codes(points: Iterable[Point]) -> dict[str, str]:
    """The codes by which rules call points: those that belong to one name."""
    names: dict[str, set[str]] = {}
    for point in points:
        if point.code:
            names.setdefault(point.code, set()).add(point.name)
    return {next(iter(alike)): code for code, alike in names.items() if len(alike) == 1}


def place_text(point: Point) -> str:
    """Where a point starts, and how many words it has from there: `3100h (12544)`, then `2 words, low word first`."""
    if not point.addresses:
        return ""
    start = wording.address_text(min(point.addresses))
    order = wording.order_text(point)
    return f"{start}{LINE_BREAK}{len(point.addresses)} words, {cell(order)}" if order else start


def reference_heads(points: Iterable[Point]) -> tuple[str, ...]:
    """The numberings of the manual that some of the points have, in the order of their first use."""
    heads: dict[str, None] = {}
    for point in points:
        heads |= dict.fromkeys(point.place.references)
    return tuple(heads)


def numbers_head(keys: Sequence[str]) -> str:
    """The head of the column with all numberings: `Modicon / Reference`."""
    return cell(" / ".join(key.capitalize() for key in keys))


def numbers_text(point: Point, keys: Sequence[str]) -> str:
    """The numbers of a point in these numberings: `4115 / 404115`, with a dash for one that it lacks."""
    references = point.place.references
    if not references:
        return ""
    return " / ".join([number_cell(references.get(key, "-")) for key in keys])


def _subjects(points: Iterable[Point], by_code: RenamedPoints) -> Iterator[Subject]:
    shapes, kins = dict[int, object](), dict[object, int]()
    known_limits: dict[object, Limits] = {}
    for point in points:
        shape = shapes.get(id(point.shape))
        if shape is None:
            shape = shapes[id(point.shape)] = alike(point.shape)
        kin = kins.setdefault(kin_of(point, shape), len(kins))
        key = limits_of(point, kin)
        limits = known_limits.get(key)
        if limits is None:
            limits = known_limits[key] = _limits(point, by_code)
        yield Subject(point, kin, limits)


def alike(shape: Shape) -> object:
    """What two shapes of which rows say the same have in common."""
    return tuple(map(id, (*_UNNAMED(shape), shape.enum and shape.enum.entries)))


def kin_of(point: Point, shape: object) -> object:
    """All that decides about the row of a point, but for the words of its identity and its limits."""
    return shape, id(point.terms), len(point.place.addresses)


def limits_of(point: Point, kin: int) -> object:
    """All that decides about the words of limits."""
    return kin, id(point.allowed)


def _limits(point: Point, by_code: RenamedPoints) -> Limits:
    """The range without its unit, and the raw range where it says more; both call other points by their codes."""
    raw = wording.raw_range_text(point, RenamedPoints({}, by_code.names) if point.allowed.moves else None)
    span = wording.range_text(point, by_code, unit=False)
    return Limits(("" if point.flags else narrow(cell(span)), narrow(cell(raw)) if _has_rule(point) else ""))


def _has_rule(point: Point) -> bool:
    """Whether the raw range says more than the range."""
    return point.scale is not None or point.allowed.moves or fixed_rule(point) is None
