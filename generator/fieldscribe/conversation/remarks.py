"""Sentences that every family needs: about units, and words as manuals print them."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from fieldscribe.model import Bus


def units_text(bus: Bus) -> str:
    """Which units the device may have: `units are 1 to 32`."""
    low, high = bus.units
    return f"units are {low} to {high}"


def strange_unit(bus: Bus, unit: int) -> str:
    """That no device has a unit number; empty if one may have it."""
    low, high = bus.units
    return "" if low <= unit <= high else f"the device cannot have unit {unit}: {units_text(bus)}"


def words_text(words: Sequence[int]) -> str:
    """Words as manuals print them: `0001h FFFFh`."""
    return " ".join(f"{word:04X}h" for word in words)
