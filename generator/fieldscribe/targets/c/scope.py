"""What the view of one device shares while it is built: prefixes, points by name, which helpers are needed."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from fieldscribe.names import upper
from fieldscribe.targets.c.literals import raw_type

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from fieldscribe.model import Device, Linear, Point
    from fieldscribe.targets.c.views import ScaledView


@dataclass(slots=True)
class Scope:
    """The namespace of one device.

    `shifts` says that some rule has a factor of type f32, `lifts` that one with factors has an offset. `used` collects
    the names of shared helpers, `enums` and `codes` those already placed, `scales` what points share. `names_only` says
    that nobody will see the comments, tests and arithmetic of points, which take most of the time.
    """

    prefix: str
    upper: str
    points: Mapping[str, Point]
    errata: Mapping[str, str]
    shifts: bool
    lifts: bool
    names_only: bool = False
    used: set[str] = field(default_factory=set)
    enums: set[str] = field(default_factory=set)
    codes: set[str] = field(default_factory=set)
    scales: dict[tuple[object, ...], ScaledView] = field(default_factory=dict)

    def helper(self, name: str) -> str:
        """The identifier of a shared helper, which the header will then hold."""
        self.used.add(name)
        return f"{self.prefix}_{name}"

    def declare(self, names: tuple[str, ...]) -> str:
        """Parameters for the raw numbers of other points: `, uint16_t lower_limit_raw`."""
        return "".join(f", {raw_type(self.points[name])} {name}_raw" for name in names) if names else ""

    def place(self, names: tuple[str, ...]) -> str:
        """The same as arguments of a call: `, lower_limit_raw`."""
        return "".join(f", {name}_raw" for name in names) if names else ""


def scope_of(device: Device, *, names_only: bool = False) -> Scope:
    """A fresh scope for a device."""
    points: dict[str, Point] = {}
    for point in device.points:
        points.setdefault(point.name, point)
        points.setdefault(point.item, point)
    lines = {
        one.id: f"Erratum {one.id} ({one.certainty}): "
        f"printed: {one.printed.rstrip('.')}; taken: {one.taken.rstrip('.')}."
        for one in device.errata
    }
    floating = {point.name for point in device.points if point.info.floating}
    shifts = any(not floating.isdisjoint(point.arguments) for point in device.points) if floating else False
    lifts = any(rule.offset for point in device.points for rule in _rules(point))
    return Scope(device.id, upper(device.id), points, lines, shifts, lifts, names_only)


def _rules(point: Point) -> Iterator[Linear]:
    """The rules of a point whose factors are known at run time."""
    if point.scale_arguments:
        yield from (case.rule for case in point.scale or ())
    for interval in point.allowed.intervals:
        yield from (bound.rule for bound in (interval.low, interval.high) if not isinstance(bound, int))
