"""Vectors of the constants of a bus: units, lengths of telegrams, and others of its family."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from fieldscribe.targets.vectors.lines import Lines

NO_BROADCAST = 0xFFFF
"""The unit number for devices without broadcast: larger than any other."""


def add_limits(lines: Lines, **numbers: int) -> None:
    """Add a vector for each constant."""
    for what, number in numbers.items():
        lines.add("limit", what, number)
