"""All vectors of a device, part by part, with those of its family."""

from __future__ import annotations

from operator import attrgetter
from types import MappingProxyType
from typing import TYPE_CHECKING

from fieldscribe.families import family
from fieldscribe.targets.vectors.bus import add_limits
from fieldscribe.targets.vectors.exchanges import Exchanges
from fieldscribe.targets.vectors.identity import Identities
from fieldscribe.targets.vectors.lines import Lines, rows
from fieldscribe.targets.vectors.meaning import Meanings
from fieldscribe.targets.vectors.oracle import Oracle
from fieldscribe.targets.vectors.sheets import Sheets

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from fieldscribe.model import Bus, Device
    from fieldscribe.targets.vectors.exchanges import Wire


class OfFamily:
    """The part `targets.vectors` of a family. These are the defaults."""

    KINDS: Mapping[str, str] = MappingProxyType({})
    """The kinds of vectors that only this family has, with the fields of their lines."""

    def limits(self, lines: Lines, bus: Bus) -> None:
        """Add the vectors of the constants of the bus."""

    def frames(self, lines: Lines, device: Device) -> None:
        """Add the vectors of the frames of a device."""

    def wires(self, device: Device) -> Sequence[Wire]:
        """The ways in which points travel, with the usual way first."""
        del device
        return ()


def collect(device: Device) -> Lines:
    """All vectors of a device: its points by address, then its frames and blocks.

    What is tried in depth, or with bad answers, is tried at the first of all that are alike.
    """
    family_part: OfFamily = family(device.family).part("targets.vectors") or OfFamily()
    lines = Lines(rows(family_part.KINDS))
    oracle = Oracle({point.name: point for point in reversed(device.points)})
    meanings = Meanings()
    sheets = Sheets(lines, oracle, meanings)
    identities = Identities(lines, device.variants)
    points = {point.item: point for point in sorted(device.points, key=attrgetter("rank")) if point.generated}
    exchanges = [Exchanges(lines, oracle, meanings, points, wire) for wire in family_part.wires(device)]
    usual, others = exchanges[:1], exchanges[1:]
    for collector in usual:
        collector.open()
    for axis, choices in device.variants.items():
        lines.add("variant", axis, choices)
    _limits(lines, device, family_part)
    for point in points.values():
        meaning = meanings.of(point)
        identities.add(point)
        lines.include(sheets.of(meaning))
        lines.include(sheets.of_bits(meaning))
        for collector in usual:
            collector.of(point, meaning)
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
"""So many new lines and parts are joined at once."""


def _limits(lines: Lines, device: Device, family_part: OfFamily) -> None:
    """Add all vectors of constants."""
    add_limits(lines, first_unit=device.bus.units[0], last_unit=device.bus.units[1])
    family_part.limits(lines, device.bus)
    for telegram in device.telegrams:
        lines.add("size", "words", telegram.name, telegram.words)
