"""How bits hold a raw number that is not in two's complement: as decimal digits, or as sign and magnitude."""

from __future__ import annotations

BCD = "bcd"
"""Decimal digits of four bits each. Bits that are no such number stand for a number that has too many digits."""

MAGNITUDE = "sign and magnitude"
"""The highest bit is the sign of the number in the others; minus zero reads as 0."""


def coded_ends(width: int, coding: str) -> tuple[int, int]:
    """Return the least and the greatest number that so many bits can hold."""
    if coding == BCD:
        return 0, int(10 ** (width // 4)) - 1
    most = (1 << width - 1) - 1
    return -most, most


def coded_number(pattern: int, width: int, coding: str) -> int:
    """Return the number in a pattern; of digits that are none, the pattern itself or the least number that is too long.

    So a code such as FFFFh, which is no decimal number, stays a number of its own.
    """
    if coding == MAGNITUDE:
        sign = 1 << width - 1
        return sign - pattern if pattern & sign else pattern
    digits = f"{pattern:0{width // 4}x}"
    return int(digits) if digits.isdecimal() else max(pattern, coded_ends(width, coding)[1] + 1)


def coded_pattern(raw: int, width: int, coding: str) -> int:
    """Return the pattern of a number; one with too many digits is a pattern."""
    if coding == MAGNITUDE:
        return abs(raw) & (1 << width - 1) - 1 | (raw < 0) << width - 1
    return raw if raw > coded_ends(width, coding)[1] else int(str(raw), 16)
