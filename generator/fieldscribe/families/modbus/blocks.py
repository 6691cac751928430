"""Batched reads: which consecutive addresses one request may bring."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from fieldscribe.families.modbus.functions import PROTOCOL_MOST, SPACES, profile_of
from fieldscribe.model import Block

if TYPE_CHECKING:
    from collections.abc import Iterable

    from fieldscribe.model import Bus, Place, Point


@dataclass(slots=True)
class _Lane:
    """What one space and function offer: spans to read (low, end, name), and addresses that may be crossed."""

    spans: list[tuple[int, int, str]] = field(default_factory=list)
    crossable: set[int] = field(default_factory=set)


def plan_blocks(bus: Bus, points: Iterable[Point]) -> tuple[Block, ...]:
    """Reads that bring all generated readable points, by space, then address.

    A block crosses no address that no readable point covers (reserved ones may be crossed) and none of the bus's gaps;
    it holds points whole and at most as many items as the device allows. Points that no single read can bring (no
    allowed function, more words than allowed, words that are not neighbours) are in no block.
    """
    most = profile_of(bus).most
    blocks: list[Block] = []
    for (space, function), lane in _lanes(bus, points).items():
        if function in most:
            blocks.extend(_cut(space, function, lane, bus.gaps.get(space, ()), most[function]))
    order = {space: index for index, space in enumerate(SPACES)}
    blocks.sort(key=lambda block: (order[block.space], block.address, block.function))
    return tuple(blocks)


def _lanes(bus: Bus, points: Iterable[Point]) -> dict[tuple[str, int], _Lane]:
    lanes: dict[tuple[str, int], _Lane] = {}
    for point in points:
        place = _read_place(point)
        if place is None or place.space not in SPACES:
            continue
        function = SPACES[place.space].read if place.function is None else place.function
        if function not in PROTOCOL_MOST:
            continue
        lane = lanes.setdefault((place.space, function), _Lane())
        lane.crossable.update(place.addresses)
        low, end = min(place.addresses), max(place.addresses) + 1
        if point.generated and end - low == len(place.addresses):
            lane.spans.append((low, end, point.name))
    return lanes


def _read_place(point: Point) -> Place | None:
    if not point.readable:
        return None
    places = [place for place in point.places if place.addresses]
    return next((place for place in places if place.purpose == "read"), places[0] if places else None)


def _cut(space: str, function: int, lane: _Lane, gaps: tuple[tuple[int, int], ...], most: int) -> Iterable[Block]:
    """The lane's spans joined as far as holes, gaps and the largest count let them."""
    crossable = {address for address in lane.crossable if not any(low <= address <= high for low, high in gaps)}
    begin = end = 0
    names: dict[str, None] = {}
    for low, stop, name in sorted(span for span in lane.spans if span[1] - span[0] <= most):
        joins = stop - begin <= most and all(address in crossable for address in range(end, stop))
        if names and not joins:
            yield Block(space, function, begin, end - begin, tuple(names))
        if not names or not joins:
            begin, end, names = low, stop, {}
        end = max(end, stop)
        names[name] = None
    if names:
        yield Block(space, function, begin, end - begin, tuple(names))
