"""Strikes: the unit as a digit, the tone as a letter, and an answer of two bytes."""

from __future__ import annotations


def strike(unit: int, tone: int) -> bytes:
    """What rings a tone of a bell."""
    return b"%d%c" % (unit, ord("A") + tone)


def tone_of(data: bytes) -> int | None:
    """The tone that a strike rings; None for other bytes."""
    whole = len(data) == 2 and data[:1].isdigit() and 0 <= data[1] - ord("A") <= 25
    return data[1] - ord("A") if whole else None
