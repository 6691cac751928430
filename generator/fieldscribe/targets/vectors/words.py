"""The words of raw numbers as they travel, and their vectors."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.targets.vectors.numbers import as_raw

if TYPE_CHECKING:
    from fieldscribe.targets.vectors.lines import Lines
    from fieldscribe.targets.vectors.meaning import Meaning

OTHER_BITS = 0xA5C3
"""The bits of a shared word around those of the point."""


def words(lines: Lines, meaning: Meaning) -> None:
    """Add vectors of the words of a number, in ascending order of the addresses."""
    shape, order = meaning.shape, meaning.order
    if order is None or meaning.bits is not None or shape.text is not None:
        return
    count = shape.words
    if count < 2 and not shape.info.signed:
        return
    raws = [as_raw(shape, pattern) for pattern in (_wide_patterns(count) if count > 1 else _NARROW)]
    lines.add_all("words", [(raw, words_of(meaning, order, raw)) for raw in raws])


_NARROW = (0x8000, 0x8001, 0xFFFD, 0x7FFE)
"""Samples of a signed word: the least number, negative odd numbers, a positive number."""


def _wide_patterns(count: int) -> tuple[int, ...]:
    top = 1 << 16 * count - 1
    ascending = sum(0x0001_0203_0405_0607 >> 64 - 16 * count & 0xFFFF << 16 * place for place in range(count))
    mixed = sum((0x8000 if place % 2 else 0x8001) << 16 * place for place in range(count))
    return (0, 1, ascending, top, top + 1, top - 1, mixed, (1 << 16 * count) - 1, 0xFFFF)


def words_of(meaning: Meaning, order: tuple[int, ...], raw: int, *, received: bool = False) -> tuple[int, ...]:
    """The words of a raw number as they travel, in ascending order of address: `order` says which is which.

    A bit group has other bits beside it. Constant bits are as written when they are sent, and different when received.
    """
    if meaning.bits is not None:
        return (_shared_word(meaning, meaning.bits[1], raw, received=received),)
    count = len(order)
    pattern = raw & (1 << 16 * count) - 1
    return tuple([pattern >> 16 * (count - 1 - place) & 0xFFFF for place in order])


def _shared_word(meaning: Meaning, low: int, raw: int, *, received: bool) -> int:
    ones, fixed = (1 << meaning.shape.width) - 1, meaning.shape.fixed
    word = OTHER_BITS & ~(ones << low) | (raw & ones) << low
    if fixed is None:
        return word
    constant = fixed.bits ^ fixed.mask if received else fixed.bits
    return word & ~fixed.mask | constant
