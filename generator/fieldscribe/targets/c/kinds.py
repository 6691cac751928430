"""Points whose text differs in words only: it is laid out once for all of a kind, with blanks in place of the words."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from fieldscribe.model import Shape
from fieldscribe.patterns import Pattern, blanks
from fieldscribe.targets.c.points import point_view
from fieldscribe.targets.c.words import Filling, Limits, Words, filling_of, limits_of, stand_ins, widths_of

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable

    from fieldscribe.model import Device, Point, Terms
    from fieldscribe.targets.c.scope import HeaderScope
    from fieldscribe.targets.c.views import PointView


@dataclass(frozen=True, slots=True, eq=False)
class Kind:
    """Points with one text: the first of them, and its view with blanks. `comment` is the blank for the comment."""

    point: Point
    view: PointView
    comment: str


class Placed(NamedTuple):
    """A generated point with its kind and its words."""

    point: Point
    kind: Kind
    words: Filling


class Texts:
    """A part of the text of points, laid out for the first of each kind."""

    def __init__(self, lay_out: Callable[[Kind], str]) -> None:
        self._lay_out = lay_out
        self._patterns: dict[Kind, Pattern] = {}

    def of(self, kind: Kind) -> Pattern:
        """The pattern of a kind."""
        pattern = self._patterns.get(kind)
        if pattern is None:
            pattern = self._patterns[kind] = Pattern(self._lay_out(kind))
        return pattern


class _Alike(NamedTuple):
    """What the kind of a point has of its shape.

    `number` is that of the shape, `own` a number of all shapes that say the same but for the name of their enum, if
    that is the point's own. `alone` says that points have more of their own than words.
    """

    number: int
    own: int
    enum: str
    codes: str
    alone: bool


def placed_points(device: Device, scope: HeaderScope) -> list[Placed]:
    """The generated points of a device."""
    kinds = Kinds(scope)
    return [kinds.placed(point) for point in device.points if point.generated]


class Kinds:
    """Sorts the points of a device into kinds; asked for them in their order."""

    def __init__(self, scope: HeaderScope) -> None:
        self._scope = scope
        self._kinds: dict[Hashable, Kind] = {}
        self._shapes: dict[int, _Alike] = {}
        self._owners: dict[Hashable, int] = {}
        self._limits: dict[tuple[int, int, str], Limits] = {}
        self._terms: dict[int, int] = {}
        self._said: dict[Hashable, int] = {}
        self._enums: set[str] = set()
        self._codes: set[str] = set()

    def placed(self, point: Point) -> Placed:
        """The next point with its kind and its words."""
        item, addresses, terms = point.item, point.place.addresses, point.terms
        alike = self._shapes.get(id(point.shape)) or self._alike(point.shape)
        number = alike.own if alike.enum == item else alike.number
        limits = self._limits.get((number, id(point.allowed), terms.unit.symbol)) or self._limits_of(point, number)
        words = filling_of(point, item, addresses, limits)
        first_names = bool(alike.enum) and _is_first(alike.enum, self._enums)
        first_codes = bool(alike.codes) and _is_first(alike.codes, self._codes)
        if alike.alone or limits.alone or point.was or point.write_place is not None:
            view = point_view(point, Words.of(words), self._scope, first_names=first_names, first_codes=first_codes)
            return Placed(point, Kind(point, view, _comment_blank(words)), words)
        key = (
            number,
            self._terms.get(id(terms)) or self._number_of(terms),
            limits.form,
            first_names,
            first_codes,
            widths_of(words),
            tuple([address - addresses[0] for address in addresses]) if len(addresses) > 1 else len(addresses),
            tuple(point.place.references),
            point.index,
            point.errata,
        )
        kind = self._kinds.get(key)
        if kind is None:
            shown = Words.of(stand_ins(words))
            view = point_view(point, shown, self._scope, first_names=first_names, first_codes=first_codes)
            kind = self._kinds[key] = Kind(point, view, _comment_blank(words))
        return Placed(point, kind, words)

    def _limits_of(self, point: Point, number: int) -> Limits:
        limits = self._limits[number, id(point.allowed), point.unit.symbol] = limits_of(point)
        return limits

    def _number_of(self, terms: Terms) -> int:
        """A number of all terms that say the same in C."""
        space = terms.space, self._scope.spaces.get(terms.group)
        said = (*space, terms.bits, terms.steps, terms.keeps, terms.when, terms.telegram, terms.untyped)
        number = self._terms[id(terms)] = self._said.setdefault(said, len(self._said) + 1)
        return number

    def _alike(self, shape: Shape) -> _Alike:
        enum, number = shape.digits.enum if shape.digits is not None else shape.enum, len(self._shapes)
        said: Hashable = number
        if enum is not None and shape == Shape(shape.type, shape.width, shape.access, None, 0, enum, (), ()):
            entries = tuple([(entry.raw, entry.name, entry.quantity) for entry in enum.entries])
            said = (shape.type, shape.width, shape.access, enum.closed, entries, enum.name in self._scope.digits)
        alike = self._shapes[id(shape)] = _Alike(
            number,
            self._owners.setdefault(said, -1 - number),
            "" if enum is None else enum.name,
            shape.shared_codes,
            bool(shape.text or shape.digits or shape.scale_arguments) or shape.type == "u64",
        )
        return alike


def _is_first(name: str, met: set[str]) -> bool:
    """Whether a name is met for the first time."""
    if name in met:
        return False
    met.add(name)
    return True


def _comment_blank(words: Filling) -> str:
    """The blank for the comment, which follows the words."""
    return blanks((*[""] * len(words), "_"))[-1]
