"""Batched reads: which consecutive addresses one request may bring."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from fieldscribe.families.modbus.functions import PROTOCOL_MOST, SPACES, profile_of
from fieldscribe.model import Block

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from fieldscribe.model import Bus, Place, Point


@dataclass(slots=True)
class _Lane:
    """What one space and function offer: spans to read (low, end, name), and addresses that may be crossed.

    Those may be crossed where a readable point is in every device.
    """

    spans: list[tuple[int, int, str]] = field(default_factory=list)
    crossable: set[int] = field(default_factory=set)


def plan_blocks(bus: Bus, points: Sequence[Point], variants: Mapping[str, tuple[str, ...]]) -> tuple[Block, ...]:
    """Reads that bring all generated readable points, by space, then address.

    A block crosses no address that no readable point covers (reserved ones may be crossed) and none of the bus's gaps;
    it holds points whole and at most as many items as the device allows. What not every device has (a condition, a
    firmware, one variant alone) is in a block of its own: where it is missing, the device refuses all of a read. Points
    that no single read can bring (no allowed function, more words than allowed, words that are not neighbours) are in
    no block.
    """
    most = profile_of(bus).most
    blocks: list[Block] = []
    for (space, function), lane in _lanes(points, variants).items():
        if function in most:
            blocks.extend(_cut(space, function, lane, bus.gaps.get(space, ()), most[function]))
    order = {space: index for index, space in enumerate(SPACES)}
    blocks.sort(key=lambda block: (order[block.space], block.address, block.function))
    return tuple(blocks)


def _lanes(points: Sequence[Point], variants: Mapping[str, tuple[str, ...]]) -> dict[tuple[str, int], _Lane]:
    lanes: dict[tuple[str, int], _Lane] = {}
    values = _values(points)
    for point in points:
        place = _read_place(point)
        if place is None or place.space not in SPACES:
            continue
        function = SPACES[place.space].read if place.function is None else place.function
        if function not in PROTOCOL_MOST:
            continue
        lane = lanes.setdefault((place.space, function), _Lane())
        if _always_there(point, place, values, variants):
            lane.crossable.update(place.addresses)
        low, end = min(place.addresses), max(place.addresses) + 1
        if point.generated and end - low == len(place.addresses):
            lane.spans.append((low, end, point.name))
    return lanes


def _values(points: Iterable[Point]) -> dict[tuple[str, Place], set[str]]:
    """The variants in which points of one name are read at one place."""
    variants: dict[tuple[str, Place], set[str]] = {}
    for point in points:
        place = _read_place(point)
        if point.variant is not None and place is not None:
            variants.setdefault((point.name, place), set()).add(point.variant)
    return variants


def _always_there(
    point: Point, place: Place, values: Mapping[tuple[str, Place], set[str]], variants: Mapping[str, tuple[str, ...]]
) -> bool:
    """Whether every device has a point at the place that it is read from."""
    if point.when is not None or point.since is not None or point.until is not None:
        return False
    axis = (point.variant or "").partition("=")[0]
    return point.variant is None or {f"{axis}={value}" for value in variants.get(axis, ())} <= values[point.name, place]


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
    alone: dict[tuple[int, int], dict[str, None]] = {}
    for low, stop, name in sorted(span for span in lane.spans if span[1] - span[0] <= most):
        if not lane.crossable.issuperset(range(low, stop)):
            alone.setdefault((low, stop), {})[name] = None
            continue
        joins = stop - begin <= most and all(address in crossable for address in range(end, stop))
        if names and not joins:
            yield Block(space, function, begin, end - begin, tuple(names))
        if not names or not joins:
            begin, end, names = low, stop, {}
        end = max(end, stop)
        names[name] = None
    if names:
        yield Block(space, function, begin, end - begin, tuple(names))
    for (low, stop), own in alone.items():
        yield Block(space, function, low, stop - low, tuple(own))
