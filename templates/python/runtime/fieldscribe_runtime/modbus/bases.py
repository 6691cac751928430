# SPDX-License-Identifier: 0BSD
"""Bases of addresses: from numbers that are given when a device is made, or blocks that are found in it."""

from __future__ import annotations

from copy import copy
from typing import TYPE_CHECKING

from ..arguments import check_integer, shown
from ..errors import (
    BlockError,
    ExceptionReplyError,
    FieldscribeError,
    RequestError,
    undecided,
)
from ..records import Record

if TYPE_CHECKING:
    from collections.abc import Callable, Generator, Mapping

    Read = Callable[[int, int], Generator[bytes, bytes, tuple[int, ...]]]

_LAST = 0xFFFF
_MOST_BLOCKS = 256
"""The most blocks that a search reads, so that a broken device cannot keep the line busy."""


class Base(Record):
    """A base of addresses: `offset` plus multiples of given numbers, or a place in the found block with this id.

    That place is `offset` words after the start of the block, plus multiples of the words at the addresses of `counts`
    in the block.
    """

    offset: int = 0
    factors: Mapping[str, int] = {}
    block: int | None = None
    counts: Mapping[int, int] = {}


class Chain(Record):
    """Blocks after a `marker` at one of `places`: each starts with its id and the number of words after these two."""

    name: str
    function: int
    marker: tuple[int, ...]
    places: tuple[int, ...]
    end: int

    def walk_steps(self, read: Read) -> Generator[bytes, bytes, dict[int, Start]]:
        """Return the start of each block by its id (the first one of two with the same id). Raises BlockError."""
        place = yield from self._search_steps(read)
        found: dict[int, Start] = {}
        for _ in range(_MOST_BLOCKS):
            if place == _LAST:
                block, length = (yield from read(place, 1))[0], 0
            elif place < _LAST:
                block, length = yield from read(place, 2)
            else:
                raise BlockError("bad_chain", f"the blocks of {self.name} do not end before the address 65536")
            if block == self.end:
                return found
            last = 1 + length
            if place + last > _LAST:
                text = f"the block {block} of {self.name} at {place} has {length} words, and ends beyond 65535"
                raise BlockError("bad_chain", text)
            found.setdefault(block, Start(place, last))
            place += last + 1
        raise BlockError("bad_chain", f"{self.name} has more than {_MOST_BLOCKS} blocks")

    def _search_steps(self, read: Read) -> Generator[bytes, bytes, int]:
        """Return the address after the marker; a place that the device refuses has none."""
        for place in self.places:
            try:
                words = yield from read(place, len(self.marker))
            except ExceptionReplyError as error:
                if error.lost:
                    raise
                continue
            if words == self.marker:
                return place + len(self.marker)
        places = ", ".join(map(str, self.places))
        raise BlockError("no_marker", f"nothing at {places} says where the blocks of {self.name} start")


class Start(Record):
    """The address that others count from, and the last address relative to it."""

    address: int
    last: int


class Bases:
    """The bases of one device, as far as they are known."""

    def __init__(self, bases: Mapping[str, Base], given: Mapping[str, tuple[int, int]], chain: Chain | None) -> None:
        self._bases, self._given, self.chain = bases, given, chain
        self._starts: dict[str, Start] = {}
        self._behind: dict[str, Start] = {}
        self._numbers: dict[str, int] = {}
        self._blocks: dict[int, Start] | BlockError | None = None

    def give(self, numbers: Mapping[str, int | None]) -> None:
        """Set the given numbers; None for one that is not known. Raises RequestError."""
        for name, number in numbers.items():
            low, high = self._given[name]
            if number is None:
                continue
            check_integer("bad_base", name, number)
            if not low <= number <= high:
                raise RequestError("bad_base", f"{name} is {low} to {high}, not {shown(number)}")
            self._numbers[name] = number

    def put(self, name: str, address: int, last: int | None = None) -> None:
        """Set a base that is known from elsewhere; raises RequestError if it is invalid."""
        if name not in self._bases:
            raise RequestError("bad_base", f"there is no base {shown(name)}, only {', '.join(self._bases)}")
        check_integer("bad_base", "the base", address)
        last = _LAST - address if last is None else last
        if not 0 <= address <= address + last <= _LAST:
            raise RequestError("bad_base", f"the base {name} at {shown(address)} is outside 0..65535")
        self._starts[name] = Start(address, last)

    def forget(self) -> None:
        """Forget the blocks; they are searched again when needed."""
        self._blocks = None
        self._behind.clear()

    def blocks_steps(self, read: Read) -> Generator[bytes, bytes, dict[int, Start]]:
        """Return the blocks of the device by their ids; they are searched once."""
        if self.chain is None:
            raise BlockError("no_marker", "the addresses of this device count from no found block")
        if self._blocks is None:
            try:
                self._blocks = yield from self.chain.walk_steps(read)
            except BlockError as error:
                self._blocks = error
                raise
        if isinstance(self._blocks, FieldscribeError):
            raise copy(self._blocks)
        return self._blocks

    def start_steps(self, name: str, read: Read) -> Generator[bytes, bytes, Start]:
        """Return the start of a base. Raises BlockError, or RequestError if a number was not given."""
        if (known := self._starts.get(name) or self._behind.get(name)) is not None:
            return known
        base = self._bases[name]
        if base.block is not None:
            blocks = yield from self.blocks_steps(read)
            if base.block not in blocks:
                has = ", ".join(map(str, blocks)) or "none"
                raise BlockError("no_block", f"the device has no block {base.block}, only {has}")
            start, words = blocks[base.block], base.offset
            if not words and not base.counts:
                return start
            for address, factor in base.counts.items():
                words += factor * (yield from read(start.address + address, 1))[0]
            if words > start.last:
                raise BlockError("behind_end", f"{name} lies behind the end of the block {base.block}")
            self._behind[name] = Start(start.address + words, start.last - words)
            return self._behind[name]
        missing = [each for each in base.factors if each not in self._numbers]
        if missing:
            raise undecided(RequestError("bad_base", f"where this is depends on {missing[0]}"), missing[0])
        address = base.offset + sum(self._numbers[each] * factor for each, factor in base.factors.items())
        return Start(address, _LAST - address)
