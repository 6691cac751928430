# SPDX-License-Identifier: 0BSD
"""Signals are numbers in some bits of a message: extracts and inserts them, without any I/O."""

from __future__ import annotations

from itertools import groupby
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Mapping


class Signal(NamedTuple):
    """The place of a signal in a message. `start` is its first bit as CAN databases count: bit 7 of byte 1 is 15.

    That is the bit of the lowest value if the low byte comes first, else the bit of the highest one. `when` has places
    of other signals of the message with the raw numbers that select this one: all must fit.
    """

    start: int
    width: int
    low_first: bool = False
    when: tuple[tuple[int, tuple[int, ...]], ...] = ()

    @property
    def words(self) -> int:
        """The number of words that it takes in the telegram of the message, the high one first."""
        return -(-self.width // 16)


class Packing:
    """Extracts the signals of a message from its bytes, and inserts them."""

    def __init__(self, signals: tuple[Signal, ...], length: int) -> None:
        self.signals, self.length = signals, length
        bits = 8 * length
        self._shifts = [
            (one.low_first, one.start if one.low_first else bits - (one.start ^ 7) - one.width, (1 << one.width) - 1)
            for one in signals
        ]
        self.parts: list[range] = []
        """The words that come together: those that always do, then those of each selection."""
        self._parts: list[tuple[list[int], tuple[tuple[int, tuple[int, ...]], ...]]] = []
        at = 0
        for when, several in groupby(enumerate(signals), lambda numbered: numbered[1].when):
            numbers = [number for number, _ in several]
            words = sum(signals[number].words for number in numbers)
            self.parts.append(range(at, at + words))
            self._parts.append((numbers, when))
            at += words

    def raws(self, data: bytes) -> list[int]:
        """The raw numbers of all signals without their signs, also of those that do not come in these bytes."""
        low, high = int.from_bytes(data, "little"), int.from_bytes(data, "big")
        return [(low if low_first else high) >> shift & mask for low_first, shift, mask in self._shifts]

    def coming(self, data: bytes) -> dict[int, bytes]:
        """The words of the parts that come in these bytes, each two bytes."""
        raws = self.raws(data)
        return {
            place: b"".join([raws[number].to_bytes(2 * self.signals[number].words, "big") for number in numbers])
            for place, (numbers, when) in enumerate(self._parts)
            if all(raws[selector] in known for selector, known in when)
        }

    def data(self, raws: Mapping[int, int]) -> bytes:
        """The bytes with these raw numbers, by the place of the signal; all other bits are 0."""
        low = high = 0
        for number, raw in raws.items():
            low_first, shift, mask = self._shifts[number]
            if low_first:
                low |= (raw & mask) << shift
            else:
                high |= (raw & mask) << shift
        pairs = zip(low.to_bytes(self.length, "little"), high.to_bytes(self.length, "big"), strict=True)
        return bytes([one | other for one, other in pairs])
