# SPDX-License-Identifier: 0BSD
"""Plans reads of consecutive addresses within the limits of a device, around its gaps."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..errors import RequestError
from ..records import Record
from .frames import READ_COILS, READ_DISCRETE, READ_HOLDING, READ_INPUT, READS, Profile

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable

    from ..facts import Place

_READS = {"coil": READ_COILS, "discrete": READ_DISCRETE, "holding": READ_HOLDING, "input": READ_INPUT}


class Block(Record):
    """One read: `count` words or bits from `address` on."""

    space: str
    function: int
    address: int
    count: int
    base: str | None = None

    @property
    def area(self) -> str:
        """The space, and the base from which the address counts."""
        return self.space if self.base is None else f"{self.space} from {self.base}"

    @property
    def places(self) -> list[tuple[str, int]]:
        """The area and the address of each of its words or bits."""
        area = self.area
        return [(area, address) for address in range(self.address, self.address + self.count)]

    def covers(self, place: Place) -> bool:
        """Return True if the block has all words of a place."""
        last = max(place.addresses)
        same = self.space == place.space and self.base == place.base
        return same and self.address <= place.address and last < self.address + self.count


def read_function(place: Place) -> int:
    """The function that reads a place; raises RequestError for an unknown space."""
    if place.space not in _READS:
        raise RequestError("bad_space", f"there is no space {place.space!r}, only {', '.join(_READS)}")
    return place.function if place.function in READS else _READS[place.space]


def plan(places: Iterable[Place], profile: Profile, bridges: Collection[tuple[str, int]] = ()) -> tuple[Block, ...]:
    """Return the fewest reads, in ascending order of address, that cover all places.

    A read never splits a place, has no more items than the function allows (unless a text alone has more), and touches
    no address that was not asked for, except those in `bridges` (area and address of other points that are known to be
    readable).
    """
    blocks: list[Block] = []
    for place in sorted(set(places), key=lambda one: (one.area, read_function(one), one.address, one.span)):
        function = read_function(place)
        last = blocks[-1] if blocks else None
        if last is not None and last.area == place.area and last.function == function:
            end = last.address + last.count
            count = max(end, place.address + place.span) - last.address
            known = all((place.area, address) in bridges for address in range(end, place.address))
            if known and count <= profile.functions.get(function, 1):
                blocks[-1] = last.replaced(count=count)
                continue
        blocks.append(Block(place.space, function, place.address, place.span, place.base))
    return tuple(blocks)
