"""The lowered model: what all compiled languages need to know of a device, worked out once, in numbers.

It stands between the model and the views of C, Rust and Python: the integers of a scale and their widths, and what is
known of the points that a rule needs. A view asks it and writes the answer in its own language.
"""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

from fieldscribe.lowered.plans import Plan, plan_of
from fieldscribe.lowered.rules import Operand, Rule, rule_of
from fieldscribe.lowered.template_keys import TemplateKeys

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fieldscribe.model import Device, Enum, Linear, Point, Shape

__all__ = ["Lowered", "Operand", "Plan", "Rule", "lower", "named_numbers", "plan_of"]


class Lowered:
    """A device in numbers. `points` finds points by item, and by name (of variants the first)."""

    def __init__(self, device: Device) -> None:
        self.device = device
        self.points: Mapping[str, Point] = _by_name(device)
        self._rules: dict[Linear, Rule] = {}
        self._errata = frozenset([erratum.id for erratum in device.errata if erratum.facts])

    def rule(self, linear: Linear) -> Rule:
        """Return the lowered rule, shared by all points that have the same."""
        lowered = self._rules.get(linear)
        if lowered is None:
            lowered = self._rules[linear] = rule_of(linear, self.points)
        return lowered

    def errata_of(self, point: Point) -> list[str]:
        """Return the errata of a point that change a fact; others are in the documentation only."""
        return [erratum for erratum in point.errata if erratum in self._errata]

    @cached_property
    def template_keys(self) -> Mapping[int, int]:
        """The template key of each generated point, by the point's id."""
        key_of = TemplateKeys().of
        return {id(point): key_of(point) for point in self.device.points if point.generated}


_kept: list[Lowered] = []
"""The device that was lowered last: the targets of a run ask for the same device one after the other."""


def lower(device: Device) -> Lowered:
    """Return the lowered model of a device, made once for all targets that ask for the same one in a row."""
    if not _kept or _kept[0].device is not device:
        _kept[:] = [Lowered(device)]
    return _kept[0]


def named_numbers(shape: Shape) -> Enum | None:
    """Return the enum that names the numbers of points, or each of their digits."""
    return shape.enum if shape.digits is None else shape.digits.enum


def _by_name(device: Device) -> dict[str, Point]:
    points = {point.item: point for point in reversed(device.points)}
    for point in device.points:
        if point.variant is not None:
            points.setdefault(point.name, point)
    return points
