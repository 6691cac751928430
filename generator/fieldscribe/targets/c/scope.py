"""The state of a header while it is built: prefixes, points by name, and what is emitted already."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from fieldscribe.lowered import Lowered, lower, named_numbers
from fieldscribe.model import Device, Point
from fieldscribe.targets.c.literals import raw_type
from fieldscribe.text import upper


@dataclass(slots=True)
class HeaderScope:
    """The state while the header of a device is built.

    `enums` are the names of enums of points, `digits` of those of decimal digits, `spaces` the space of each group
    whose points all have the same. `shared` are what several points share, each with the first of them. `spelling` is
    how the function being written spells the raw number of another point. `calls_only` leaves out the descriptor of a
    point that calls read and write.
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

    @property
    def points(self) -> Mapping[str, Point]:
        """The points by item and by name."""
        return self.lowered.points

    def named_after_first(self, point: str, sort: str, content: str) -> str:
        """Return the name of something shared: that of the first point asked about with this content, then `sort`."""
        return f"{self.prefix}_{self.shared.setdefault(content, point)}_{sort}"

    def is_first(self, point: str, name: str) -> bool:
        """Return True if that point is the first that needs something shared: its text then holds it."""
        return self.shared.setdefault(name, point) == point

    def brings(self, point: Point) -> tuple[bool, bool, tuple[str, ...]]:
        """Return what a point is the first with: the names of its numbers, shared codes, shared enums of flags."""
        item, enum, codes = point.item, named_numbers(point.shape), point.shape.shared_codes
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
        """Return the arguments that pass these raw numbers on: `lower_limit_raw`, or `with` for several."""
        return ("with",) if len(names) > 1 else tuple(map(self.raw, names))


def scope_of(device: Device) -> HeaderScope:
    """Return a fresh scope for a device."""
    shapes = {id(point.shape): point.shape for point in device.points}.values()
    digits = frozenset(shape.digits.enum.name for shape in shapes if shape.digits is not None)
    enums = frozenset(enum.name for enum in device.enums)
    return HeaderScope(device.id, upper(device.id), lower(device), digits, enums, _spaces(device))


def _spaces(device: Device) -> dict[str, str | None]:
    """Return the space of each group; None if its points have different ones."""
    spaces: dict[str, str | None] = {}
    for terms in {id(point.terms): point.terms for point in device.points}.values():
        if spaces.setdefault(terms.group, terms.space) != terms.space:
            spaces[terms.group] = None
    return spaces
