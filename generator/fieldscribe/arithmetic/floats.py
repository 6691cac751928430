"""Numbers in binary32 and binary64, and the patterns of their bits."""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from fractions import Fraction

_FORMATS = {32: (">f", ">I"), 64: (">d", ">Q")}


def float_of(pattern: int, bits: int) -> float:
    """The number that a pattern of 32 or 64 bits is."""
    number, whole = _FORMATS[bits]
    result: float = struct.unpack(number, struct.pack(whole, pattern))[0]
    return result


def pattern_of(value: float | Fraction, bits: int) -> int:
    """The pattern of the nearest number, ties to even. Raises OverflowError where that is infinite."""
    number, whole = _FORMATS[bits]
    result: int = struct.unpack(whole, struct.pack(number, float(value)))[0]
    return result
