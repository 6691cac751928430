"""The state of a header while it is built: prefixes, points by name, and what is emitted already."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from zlib import crc32

from fieldscribe.lowered import Lowered, lower, named_numbers
from fieldscribe.model import Device, Point
from fieldscribe.targets.c.literals import raw_type
from fieldscribe.text import upper

_AND = "_and_"
_LONGEST = 80
"""A struct whose name would have more characters has a checksum in place of the points' names."""


@dataclass(slots=True)
class HeaderScope:
    """The state while the header of a device is built.

    `digits` are the names of enums of decimal digits, `spaces` the space of each group whose points all have the same.
    `shared` are the names of what several points share, each with the
    first of them. `spelling` is how the function being written spells the raw number of another point.
    """

    prefix: str
    upper: str
    lowered: Lowered
    digits: frozenset[str]
    spaces: Mapping[str, str | None]
    spelling: str = "{}_raw"
    shared: dict[str, str] = field(default_factory=dict)

    @property
    def points(self) -> Mapping[str, Point]:
        """The points by item and by name."""
        return self.lowered.points

    def by_content(self, sort: str, content: str) -> str:
        """Return a name with a checksum of the content, so that adding a point renames nothing that points share."""
        return f"{self.prefix}_{sort}_{crc32(content.encode()):08x}"

    def is_first(self, point: str, name: str) -> bool:
        """Return True if that point is the first that needs something shared: its text then holds it."""
        return self.shared.setdefault(name, point) == point

    def brings(self, point: Point) -> tuple[bool, bool]:
        """Return whether a point is the first with the names of its numbers, and with its shared codes."""
        item, enum, codes = point.item, named_numbers(point.shape), point.shape.shared_codes
        names = enum is not None and self.is_first(item, f"names of {enum.name}")
        return names, bool(codes) and self.is_first(item, f"codes of {codes}")

    def struct(self, names: Iterable[str]) -> str:
        """Return the struct for the raw numbers of several points, named after them in alphabetical order."""
        fields = sorted(names)
        name = f"{self.prefix}_with_{_AND.join(fields)}"
        is_clear = not any(_AND in f"_{field}_" for field in fields)  # `a_and_b` and `c`, or `a` and `b_and_c`
        return name if is_clear and len(name) <= _LONGEST else self.by_content("with", " ".join(fields))

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
        """Return the arguments that pass these raw numbers on: `lower_limit_raw`, or `with` for several."""
        return ("with",) if len(names) > 1 else tuple(map(self.raw, names))


def scope_of(device: Device) -> HeaderScope:
    """Return a fresh scope for a device."""
    shapes = {id(point.shape): point.shape for point in device.points}.values()
    digits = frozenset(shape.digits.enum.name for shape in shapes if shape.digits is not None)
    return HeaderScope(device.id, upper(device.id), lower(device), digits, _spaces(device))


def _spaces(device: Device) -> dict[str, str | None]:
    """Return the space of each group; None if its points have different ones."""
    spaces: dict[str, str | None] = {}
    for terms in {id(point.terms): point.terms for point in device.points}.values():
        if spaces.setdefault(terms.group, terms.space) != terms.space:
            spaces[terms.group] = None
    return spaces
