"""Kinds of points: their members differ in identity and limits only, so their text is laid out once."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from operator import attrgetter
from typing import TYPE_CHECKING, NamedTuple, TypeVar

from fieldscribe.model import Shape, Terms
from fieldscribe.targets.python.forms import NUMBERED, is_limited
from fieldscribe.wording import codes_text, condition_text, range_text

if TYPE_CHECKING:
    from collections.abc import Callable

    from fieldscribe.model import Point
    from fieldscribe.targets.python.scope import PackageScope

_BY_ENDS = 0
"""The form of limits that are told by their ends."""
_MOST_ENDS = 16
Shared = TypeVar("Shared", Shape, Terms)
_RANGED = ("scaled", "float", "integer")
"""The forms whose docstring says the range."""

_shape_facts = attrgetter(
    *[each.name for each in fields(Shape) if each.name not in ("enum", "flags", "specials", "digits")], "form"
)
_terms_facts = attrgetter(*[each.name for each in fields(Terms) if each.name != "group"])


class Limits(NamedTuple):
    """What the limits of a point are: for people, and the ends of its intervals in code.

    `form` is what decides about the text and is no end: None if no limits are said in code, the limits themselves if
    they are more than a few numbers.
    """

    told: str
    form: int | None
    ends: tuple[str, ...]


@dataclass(slots=True)
class Kind:
    """Points of one shape on the same terms. `alike` is the same for all whose text differs in words only."""

    alike: tuple[object, ...]
    has_flags: bool
    numbered: bool
    """Whether addresses are written in decimal."""
    named: str
    """The class of its numbers; empty if there is none, or one for each point."""
    remarks: str
    """What the docstring says behind title and limits."""
    limits: dict[int, Limits] = field(default_factory=dict)

    def limits_of(self, point: Point, scope: PackageScope) -> Limits:
        """The limits of a point, worked out once for all of this kind that share them."""
        limits = self.limits.get(id(point.allowed))
        if limits is None:
            limits = self.limits[id(point.allowed)] = _limits(point, scope)
        return limits


class Kinds:
    """The kinds of a device's points."""

    def __init__(self, scope: PackageScope) -> None:
        self._scope = scope
        self._kinds: dict[tuple[int, int], Kind] = {}
        self._shapes: dict[int, int] = {}
        self._terms: dict[int, int] = {}
        self._facts: dict[object, int] = {}

    def of(self, point: Point) -> Kind:
        """The kind of a point."""
        key = (id(point.shape), id(point.terms))
        kind = self._kinds.get(key)
        if kind is None:
            kind = self._kinds[key] = self._same_terms(point, self._number(self._terms, point.terms, _terms_facts))
        return kind

    def _same_terms(self, point: Point, terms: int) -> Kind:
        """The kind of a point; terms that differ in their group only make no difference."""
        shape = point.shape
        key = (id(shape), -terms)
        kind = self._kinds.get(key)
        if kind is None:
            named, remarks = self._scope.names.numbers_class(shape), _remarks(point, self._scope)
            alike = (self._number(self._shapes, shape, _facts_of), terms)
            kind = self._kinds[key] = Kind(alike, shape.form == "flags", point.terms.space in NUMBERED, named, remarks)
        return kind

    def _number(self, numbers: dict[int, int], shared: Shared, facts_of: Callable[[Shared], object]) -> int:
        """A number for the facts of a shape or of terms."""
        number = numbers.get(id(shared))
        if number is None:
            number = numbers[id(shared)] = self._facts.setdefault(facts_of(shared), len(self._facts) + 1)
        return number


def _facts_of(shape: Shape) -> tuple[object, ...]:
    """All facts of a shape but the names of its numbers and flags, which are in a class of their own."""
    closed = shape.enum is not None and shape.enum.closed
    count = None if shape.digits is None else shape.digits.count
    return (*_shape_facts(shape), closed, count, id(shape.specials) if shape.specials else 0)


def _limits(point: Point, scope: PackageScope) -> Limits:
    allowed = point.allowed
    told = range_text(point, scope.lowered.points) if point.writable and point.form in _RANGED else ""
    if point.form == "float":
        return Limits(told, id(allowed), ())
    if not is_limited(point):
        return Limits(told, None, ())
    if allowed.moves or len(allowed.intervals) * 2 > _MOST_ENDS:
        return Limits(told, id(allowed), ())
    return Limits(told, _BY_ENDS, tuple([str(end) for interval in allowed.fixed for end in interval]))


def _remarks(point: Point, scope: PackageScope) -> str:
    remarks = ""
    if point.when is not None:
        remarks += f" Exists only when {condition_text(point.when, scope.lowered.points)}."
    if point.conditions and point.writable:
        remarks += f" To write it takes: {', '.join(condition.replace('_', ' ') for condition in point.conditions)}."
    if point.specials:
        remarks += f" {codes_text(point)}."
    return remarks
