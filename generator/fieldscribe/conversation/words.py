"""Raw numbers in 16-bit words, the high part first, and bits put into a word."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

    from fieldscribe.model import Point


def raw_of(point: Point, words: Iterable[int]) -> int:
    """The raw number of a point out of its words; of a text all its words as one number."""
    pattern = 0
    for word in words:
        pattern = pattern << 16 | word
    if point.text is not None:
        return pattern
    if point.bits is not None:
        pattern >>= point.bits[1]
    pattern &= (1 << point.width) - 1
    return pattern - (1 << point.width) if pattern > point.greatest else pattern


def words_of(point: Point, raw: int) -> tuple[int, ...]:
    """The unsigned words of a raw number."""
    pattern = raw & ((1 << 16 * point.words) - 1)
    return tuple(pattern >> 16 * place & 0xFFFF for place in reversed(range(point.words)))


def group_mask(point: Point) -> int:
    """The bits of its word that a point takes."""
    return 0xFFFF if point.bits is None else ((1 << point.width) - 1) << point.bits[1]


def insert(point: Point, word: int, raw: int) -> int:
    """A word with the bits of a point replaced, and those put in that are always written as a constant."""
    low = 0 if point.bits is None else point.bits[1]
    mask = group_mask(point)
    word = word & ~mask & 0xFFFF | raw << low & mask
    return word if point.fixed is None else word & ~point.fixed.mask | point.fixed.bits
