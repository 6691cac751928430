"""Frames of the heartbeat of `kitchen_can`, whose layout has a byte of every kind: the right one and wrong ones."""

from __future__ import annotations

IDENTIFIER = 0x700
"""Plus the unit."""

UNIT = 5

RIGHT = bytes((5, UNIT, 0x12, 0x34, 0, 0, 5 ^ 0x12, UNIT ^ 0x34))
"""A constant, the unit, one word, constants, and the two halves of a checksum."""

WRONG = {"wrong_constant": (0, 4, 5), "wrong_unit": (1,), "wrong_check": (2, 3, 6, 7)}
"""The bytes that make a frame no heartbeat of the unit, by the reason."""


def spoiled(place: int) -> bytes:
    """Return the right frame with one byte changed."""
    return RIGHT[:place] + bytes((RIGHT[place] ^ 0x20,)) + RIGHT[place + 1 :]


def cases() -> list[tuple[str, bytes]]:
    """Why each spoiled frame is refused; a constant or a unit that is wrong is so whatever the checksum says."""
    return [(reason, spoiled(place)) for reason, places in WRONG.items() for place in places]
