"""What the parts of a device's view share while it is built: prefixes, points by name, what was emitted already."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.lowered import lower
from fieldscribe.names import upper
from fieldscribe.records import dataclass, field
from fieldscribe.targets.c.literals import raw_type

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fieldscribe.lowered import Lowered
    from fieldscribe.model import Device, Point


@dataclass(slots=True)
class HeaderScope:
    """The state while the header of a device is built.

    `errata` are the ids of errata that change a fact, `digits` the names of enums of decimal digits, `spaces` the space
    of each group whose points all have the same. `tables` are the tables that several points share, each with the first
    of them. `grouped` says that the function being written gets the raw numbers of other points in a struct.
    """

    prefix: str
    upper: str
    lowered: Lowered
    errata: frozenset[str]
    digits: frozenset[str]
    spaces: Mapping[str, str | None]
    grouped: bool = False
    tables: dict[str, str] = field(default_factory=dict)

    @property
    def points(self) -> Mapping[str, Point]:
        """The points by item and by name."""
        return self.lowered.points

    def struct(self, point: Point) -> str:
        """The struct for the raw numbers that a point needs."""
        return f"{self.prefix}_{point.item}_with"

    def parameters(self, point: Point, names: tuple[str, ...]) -> list[str]:
        """The parameter for the raw numbers of other points: a number, or a struct if there are several."""
        self.grouped = len(names) > 1
        if self.grouped:
            return [f"const {self.struct(point)} *with"]
        return [f"{raw_type(self.points[name])} {name}_raw" for name in names]

    def raw(self, name: str) -> str:
        """The expression for the raw number of another point, in the function being written."""
        return f"with->{name}_raw" if self.grouped else f"{name}_raw"

    def passed(self, names: tuple[str, ...]) -> tuple[str, ...]:
        """The arguments that pass these raw numbers on: `lower_limit_raw`, or `with` for several."""
        return ("with",) if len(names) > 1 else tuple(map(self.raw, names))


def scope_of(device: Device) -> HeaderScope:
    """A fresh scope for a device."""
    shapes = {id(point.shape): point.shape for point in device.points}.values()
    digits = frozenset(shape.digits.enum.name for shape in shapes if shape.digits is not None)
    known = frozenset(erratum.id for erratum in device.errata if erratum.facts)
    return HeaderScope(device.id, upper(device.id), lower(device), known, digits, _spaces(device))


def _spaces(device: Device) -> dict[str, str | None]:
    """The space of each group; None if its points have different ones."""
    spaces: dict[str, str | None] = {}
    for terms in {id(point.terms): point.terms for point in device.points}.values():
        if spaces.setdefault(terms.group, terms.space) != terms.space:
            spaces[terms.group] = None
    return spaces
