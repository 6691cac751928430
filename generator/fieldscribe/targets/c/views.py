"""The views for the C templates: final identifiers, literals and functions, nothing left to decide."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from fieldscribe.model import Flag, Point
from fieldscribe.targets.c.scales import Scaled

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
    function: str
    lookup: str


class CodesView(NamedTuple):
    """A set of special codes: its functions, and its macros if several points share it."""

    comment: str
    defines: tuple[Define, ...]
    functions: tuple[str, ...]


class RuleView(NamedTuple):
    """The function that gives the rule of a scale, and its text if no earlier point has it."""

    name: str
    text: str


@dataclass(frozen=True, slots=True, eq=False)
class PointView:
    """A generated point; or the first of several with the same text, whose fields are then placeholders.

    `shared_values` are the macros of shared enums of flags that no earlier point has, each with a flag that has them.
    `tables` are declarations of arrays with their rows. `struct` holds the raw numbers of other points, if functions
    need several; `members` are its members if no earlier point has it. `shape` is the form of the functions: `plain`,
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
    rule: RuleView | None
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
