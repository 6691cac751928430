"""The state of a header while it is built, and the views of its points for the templates.

Views have final identifiers, literals and functions: nothing is left to decide.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from fieldscribe.lowered import Lowered, lower
from fieldscribe.model import Device, Flag, Point
from fieldscribe.targets.c.scales import Scaled
from fieldscribe.targets.c.syntax import Function, raw_type
from fieldscribe.text import upper


@dataclass(slots=True)
class HeaderScope:
    """The state while the header of a device is built.

    `enums` are the names of enums of points, `digits` of those of decimal digits, `spaces` the space of each group
    whose points all have the same. `shared` are what several points share, each with the first of them. `spelling` has
    the expressions for raw numbers of other points in the function being written. `calls_only` leaves out the
    descriptor of a point that calls read and write; `left_out` returns the names of the functions of a view that
    nobody needs.
    """

    prefix: str
    upper: str
    lowered: Lowered
    digits: frozenset[str]
    enums: frozenset[str]
    spaces: Mapping[str, str | None]
    spelling: str = "{}_raw"
    shared: dict[str, str] = field(default_factory=dict)
    calls_only: bool = False
    left_out: Callable[[PointView], set[str]] = lambda _: set()

    @property
    def points(self) -> Mapping[str, Point]:
        """The points by item and by name."""
        return self.lowered.points

    def named_after_first(self, point: str, sort: str, content: str) -> str:
        """Return the name of something shared: the name of the first point that needs this content, then `sort`."""
        return f"{self.prefix}_{self.shared.setdefault(content, point)}_{sort}"

    def is_first(self, point: str, name: str) -> bool:
        """Return True if the point is the first that needs something shared: its text defines it."""
        return self.shared.setdefault(name, point) == point

    def brings(self, point: Point) -> tuple[bool, bool, tuple[str, ...]]:
        """Return the shared items that this point defines: names of numbers, shared codes, shared enums of flags."""
        item, enum, codes = point.item, point.named_numbers, point.shape.shared_codes
        names = enum is not None and self.is_first(item, f"names of {enum.name}")
        wide = dict.fromkeys(flag.enum for flag in point.flags if flag.enum and flag.width > 1)
        flags = [name for name in wide if name not in self.enums and self.is_first(item, f"flags of {name}")]
        return names, bool(codes) and self.is_first(item, f"codes of {codes}"), tuple(flags)

    def struct(self, names: Iterable[str]) -> str:
        """Return the struct for the raw numbers of several points, named after them in alphabetical order."""
        return f"{self.prefix}_with_{'_and_'.join(sorted(names))}"

    def takes(self, names: tuple[str, ...]) -> None:
        """Begin a function that takes the raw numbers of these points, in a struct if there are several."""
        self.spelling = "with->{}_raw" if len(names) > 1 else "{}_raw"

    def parameters(self, point: Point, names: tuple[str, ...]) -> list[str]:
        """Return the parameter for the raw numbers of other points: a number, or a struct if there are several."""
        self.takes(names)
        if len(names) > 1:
            return [f"const {self.struct(point.arguments)} *with"]
        return [f"{raw_type(self.points[name])} {name}_raw" for name in names]

    def raw(self, name: str) -> str:
        """Return the expression for the raw number of another point, in the function being written."""
        return self.spelling.format(name)

    def passed(self, names: tuple[str, ...]) -> tuple[str, ...]:
        """Return the arguments that pass on these raw numbers: `lower_limit_raw`, or `with` for several."""
        return ("with",) if len(names) > 1 else tuple(map(self.raw, names))


def scope_of(device: Device) -> HeaderScope:
    """Return a fresh scope for a device."""
    digits = frozenset(enum.name for point in device.points if point.digits and (enum := point.named_numbers))
    enums = frozenset(enum.name for enum in device.enums)
    return HeaderScope(device.id, upper(device.id), lower(device), digits, enums, _spaces(device))


def _spaces(device: Device) -> dict[str, str | None]:
    """Return the space of each group; None if its points have different ones."""
    spaces: dict[str, str | None] = {}
    for terms in {id(point.terms): point.terms for point in device.points}.values():
        if spaces.setdefault(terms.group, terms.space) != terms.space:
            spaces[terms.group] = None
    return spaces


# Views.


Define = tuple[str, str]
"""A macro's name and its literal."""


class PointFields(NamedTuple):
    """The words of one point, finished for C, or placeholders for them; an absent fact is empty.

    `comment` is all of the comment above the point. `macro` is the item in capitals. `low` and `high` bound raw
    numbers, `first` and `last` counts. `address` is the lowest one, and `number` the same in decimal; `start` and `end`
    are the first and the last. `references` are literals.
    """

    comment: str
    item: str
    macro: str
    low: str
    high: str
    low_signed: str
    high_signed: str
    first: str
    last: str
    address: str
    start: str
    end: str
    number: str
    code: str
    references: tuple[str, ...]

    @classmethod
    def of(cls, fields: tuple[str, ...]) -> PointFields:
        """Return the fields from a sequence of all their texts."""
        single = len(cls._fields) - 1
        return cls._make((*fields[:single], fields[single:]))


class EnumView(NamedTuple):
    """Enumerators (name, literal, comment), the table of their names in lines, and the function that looks one up."""

    entries: tuple[tuple[str, str, str], ...]
    fits_int: bool
    table: str
    names: tuple[str, ...]
    lookup: Function


class CodesView(NamedTuple):
    """A set of special codes: its functions, and its macros if several points share it."""

    comment: str
    defines: tuple[Define, ...]
    functions: tuple[str, ...]


@dataclass(frozen=True, slots=True, eq=False)
class PointView:
    """A generated point; or the first of several with the same text, whose fields are then placeholders.

    `shared_values` are the macros of shared enums of flags that no earlier point has, each with a flag that has them.
    `tables` are declarations of arrays with their rows. `struct` holds the raw numbers of other points, if functions
    need several; `members` are its members if no earlier point has it. `rule` is the function that gives the rule of a
    scale, without a text if an earlier point has it. `shape` is the form of the functions: `plain`,
    `scaled`, `ruled`, `float`, `text` or `digits`. `special` is what the functions of its special codes begin with,
    empty without codes; `codes` are these if no earlier point has them. `scale` has the expressions of a scale without
    run-time factors.
    """

    point: Point
    fields: PointFields
    function: str
    macro: str
    defines: tuple[Define, ...]
    shared_values: tuple[tuple[Flag, tuple[Define, ...]], ...]
    enum: EnumView | None
    tables: tuple[tuple[str, tuple[str, ...]], ...]
    struct: str
    members: tuple[tuple[str, str], ...]
    rule: Function | None
    shape: str
    raw_type: str
    special: str
    codes: CodesView | None
    scale: Scaled | None

    @property
    def is_special(self) -> str:
        """The function that recognises special codes; empty without codes."""
        return self.special and f"{self.special}_is_special"

    @property
    def is_counted(self) -> bool:
        """True if functions convert counts in addition to values."""
        return self.shape in ("scaled", "ruled") and self.point.decimals is not None

    @property
    def computes_in_double(self) -> bool:
        """True if the value is a double even if the user has chosen float for values."""
        if self.scale is not None:
            return self.scale.wide
        return self.shape == "ruled" or (self.shape == "float" and self.raw_type == "uint64_t")


class AliasView(NamedTuple):
    """An old name of something that belongs to a renamed point; `was` is the old name of the point.

    `sort` is its kind for the conformance program: NUMBER, FUNCTION, FLOATING_FUNCTION, OBJECT or STRUCT.
    """

    was: str
    old_item: str
    item: str
    old: str = ""
    new: str = ""
    sort: str = ""
