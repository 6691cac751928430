"""Exact numbers for the oracle: rounding, and binary64 and binary32 patterns."""

from __future__ import annotations

import math
import struct
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from fieldscribe.model import Shape

INFINITY = math.inf
EXACT = 1 << 53
"""Every integer up to this one is a binary64 number."""


def half_away(over: int, under: int) -> int:
    """Rounds over / under (under > 0) to the nearest integer, halves away from zero."""
    if over < 0:
        return -((-2 * over + under) // (2 * under))
    return (2 * over + under) // (2 * under)


def quotient(over: int, under: int) -> float:
    """The binary64 nearest to over / under (under not 0); infinity if that is too large."""
    try:
        return over / under  # division of integers is correctly rounded
    except OverflowError:
        return INFINITY if (over < 0) == (under < 0) else -INFINITY


def as_raw(shape: Shape, pattern: int) -> int:
    """The raw number in a pattern of its bits; higher bits are ignored."""
    pattern &= (1 << shape.width) - 1
    return pattern - (1 << shape.width) if shape.info.signed and pattern >> (shape.width - 1) else pattern


def bits64(value: float) -> int:
    """The bits of a binary64 as a number."""
    return int.from_bytes(struct.pack(">d", value), "big")


def float_of_bits(bits: int, width: int) -> float:
    """The number in a binary32 or binary64 pattern."""
    form, size = (">f", 4) if width == 32 else (">d", 8)
    number: float = struct.unpack(form, bits.to_bytes(size, "big"))[0]
    return math.nan if math.isnan(number) else number


def bits32(value: float) -> int | None:
    """The pattern of the binary32 nearest to a finite binary64, ties to even; None if that is infinite."""
    sign = 0x8000_0000 if math.copysign(1.0, value) < 0 else 0
    over, under = abs(value).as_integer_ratio()
    if over == 0:
        return sign
    exponent = max(math.frexp(abs(value))[1] - 24, -149)  # of the last place
    if exponent >= 0:
        under <<= exponent
    else:
        over <<= -exponent
    places, rest = divmod(over, under)
    if 2 * rest > under or (2 * rest == under and places & 1):
        places += 1
    # The 24th bit of a normal number adds one to the exponent field, as does a carry out of the fraction.
    pattern = places if exponent == -149 else places + ((exponent + 149) << 23)
    return None if pattern >= 0x7F80_0000 else sign | pattern
