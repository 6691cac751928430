"""Vectors of the constants of a bus: its units, how long its telegrams are, and what its family adds."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from fieldscribe.targets.vectors.lines import Lines

NO_BROADCAST = 0xFFFF
"""Larger than any unit number."""


def add_limits(lines: Lines, **numbers: int) -> None:
    """Constants by name."""
    for what, number in numbers.items():
        lines.add("limit", what, number)
