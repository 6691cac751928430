"""All vectors of a device, with those of its family."""

from __future__ import annotations

from operator import attrgetter
from typing import TYPE_CHECKING

from fieldscribe.families import family
from fieldscribe.targets.vectors.computations import Computations
from fieldscribe.targets.vectors.exchanges import Exchanges
from fieldscribe.targets.vectors.family_vectors import FamilyVectors, add_limits
from fieldscribe.targets.vectors.identity import Identities
from fieldscribe.targets.vectors.lines import Lines, rows
from fieldscribe.targets.vectors.oracle import Oracle
from fieldscribe.targets.vectors.shared_vectors import SharedVectors

if TYPE_CHECKING:
    from fieldscribe.model import Device


def collect(device: Device) -> Lines:
    """Return all vectors of a device: its points by address, then its frames and blocks.

    Of points that are computed by the same rules, only the first is tried in depth and with bad answers.
    """
    family_part: FamilyVectors = family(device.family).part("targets.vectors") or FamilyVectors()
    lines = Lines(rows(family_part.KINDS))
    oracle = Oracle({point.name: point for point in reversed(device.points)})
    computations = Computations()
    shared_vectors = SharedVectors(lines, oracle, computations)
    identities = Identities(lines, device.variants)
    points = {point.item: point for point in sorted(device.points, key=attrgetter("rank")) if point.generated}
    exchanges = [Exchanges(lines, oracle, computations, points, wire) for wire in family_part.wires(device)]
    usual, others = exchanges[:1], exchanges[1:]
    for collector in usual:
        collector.open()
    for axis, choices in device.variants.items():
        lines.add("variant", axis, choices)
    _limits(lines, device, family_part)
    for point in points.values():
        computation = computations.of(point)
        identities.add(point)
        lines.include(shared_vectors.of(computation))
        lines.include(shared_vectors.of_bits(computation))
        for collector in usual:
            collector.of(point, computation)
        lines.gather(_MANY)
    for collector in others:
        collector.open()
        collector.of_each_space()
        lines.gather()
    for point in device.points:
        if point.raw_only and point.address is not None:
            lines.add("documented", point.item, point.space, point.address, point.words, point.index)
    if left_out := [point for point in device.points if not point.generated]:
        lines.add(
            "left_out", tuple(point.item for point in left_out), tuple(point.code or "none" for point in left_out)
        )
    family_part.frames(lines, device)
    return lines


_MANY = 200
"""The number of new lines that are joined at once."""


def _limits(lines: Lines, device: Device, family_part: FamilyVectors) -> None:
    """Add the vectors of constants."""
    add_limits(lines, first_unit=device.bus.units[0], last_unit=device.bus.units[1])
    family_part.limits(lines, device.bus)
    for telegram in device.telegrams:
        lines.add("size", "words", telegram.name, telegram.words)
