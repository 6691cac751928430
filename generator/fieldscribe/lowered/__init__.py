"""The lowered model: what every compiled language needs to know alike of a device, in numbers.

It stands between the model and the views of C, Rust and Python: which integers a scale comes to and how wide they are,
what the points hold that a rule needs, and where those are. A view asks it and turns the answer into its own language.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.lowered.plans import Plan, plan_of
from fieldscribe.lowered.rules import Operand, Rule, rule_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fieldscribe.model import Device, Linear, Point

__all__ = ["Lowered", "Operand", "Plan", "Rule", "lower", "plan_of"]


class Lowered:
    """A device in numbers. `points` finds the points by item and by name, of variants the first by the latter."""

    def __init__(self, device: Device) -> None:
        self.device = device
        self.points: Mapping[str, Point] = _by_name(device)
        self._rules: dict[Linear, Rule] = {}

    def rule(self, linear: Linear) -> Rule:
        """A rule with what is known of its factors; many points share it."""
        found = self._rules.get(linear)
        if found is None:
            found = self._rules[linear] = rule_of(linear, self.points)
        return found


_kept: list[Lowered] = []
"""The device that was lowered last: the targets of a run ask for it one after the other."""


def lower(device: Device) -> Lowered:
    """The lowered model of a device, made once for all targets that ask for the same one in a row."""
    if not _kept or _kept[0].device is not device:
        _kept[:] = [Lowered(device)]
    return _kept[0]


def _by_name(device: Device) -> dict[str, Point]:
    points = {point.item: point for point in reversed(device.points)}
    for point in device.points:
        points.setdefault(point.name, point)
    return points
