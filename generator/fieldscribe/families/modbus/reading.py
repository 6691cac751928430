"""Reads the facts that only Modbus has from the description, and plans the batched reads of a group."""

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

from fieldscribe.families.modbus import BROADCAST, FUNCTIONS, SPACES, ModbusBus, profile_of
from fieldscribe.language.nodes import Map
from fieldscribe.model import Block, Bus, Code, Point, Variant
from fieldscribe.resolve.bus import FamilyReader
from fieldscribe.resolve.scope import Scope


class ModbusReading(FamilyReader):
    """Reads functions, their counts and broadcasts, and plans batched reads."""

    def bus(self, scope: Scope, node: Map, functions: tuple[Code, ...]) -> ModbusBus:
        """Return how coils are padded; report functions whose description contradicts the protocol."""
        by_name = {value["name"]: value for value in node.get("functions", {}).values() if isinstance(value, Map)}
        can_be = ", ".join(f"{number:02X}h" for number in sorted(BROADCAST))
        for code in functions:
            name, limit = f"function {code.number:02X}h", FUNCTIONS.get(code.number)
            if limit is not None and code.most is not None and code.most > limit.most:
                message = f"`max: {code.most}` is more than one request can carry"
                span = by_name[code.name].span("max")
                scope.report.error("too-many-items", message, span, f"{name} takes at most {limit.most}")
            if code.broadcast and code.number not in BROADCAST:
                message = f"{name} is never broadcast: it is of no use without an answer"
                span = by_name[code.name].span("broadcast")
                scope.report.error("not-broadcast", message, span, f"functions that can be: {can_be}")
        return ModbusBus(node.get("pad_coil_bytes"))

    def writes(self, space: str) -> tuple[int, ...]:
        """Return the functions that write into a space."""
        functions = SPACES[space]
        return tuple(number for number in (functions.write_one, functions.write_many) if number is not None)

    def able(self, bus: Bus, space: str, count: int, *, writes: bool) -> tuple[int, ...]:
        """Return the functions of the device that read or write so many items at once, the usual one first."""
        most = profile_of(bus).most
        known = self.writes(space) if writes else (SPACES[space].read,)
        return tuple(number for number in known if most.get(number, 0) >= count)

    def blocks(self, bus: Bus, points: Sequence[Point], variants: Mapping[str, tuple[str, ...]]) -> tuple[Block, ...]:
        """Return the reads that fetch all points of a group."""
        return plan_blocks(bus, points, variants)


READING = ModbusReading()

_LaneKey = tuple[str, str | None, int]
"""A space, the base of its addresses, and the element of a repetition to the end of a block, else -1."""
_Place = tuple[str, str, tuple[int, ...]]
"""The name of a point, its space, and the addresses from which it is read."""


@dataclass(slots=True)
class _Lane:
    """The points that one function reads in one space: their `spans` (low, end, name), and `crossable` addresses.

    A block may cross an address if every device has a readable point there.
    """

    spans: list[tuple[int, int, str]] = field(default_factory=list)
    crossable: set[int] = field(default_factory=set)


def plan_blocks(bus: Bus, points: Sequence[Point], variants: Mapping[str, tuple[str, ...]]) -> tuple[Block, ...]:
    """Return the reads that fetch all generated readable points, ordered by space, then by address.

    A block covers only addresses with a readable point (also a reserved one) and none of the gaps of the bus. It holds
    whole points, and at most as many items as the device allows. A point that some devices lack (by a condition, a
    firmware or a variant) has its own block, because a device refuses a whole read if one address is missing. A point
    that no single read can fetch (no allowed function, too many words, words that are not neighbours, something to be
    selected before) is in no block.
    """
    most = profile_of(bus).most
    lanes = _lanes(points, variants)
    blocks: list[Block] = []
    for (space, base, _), lane in lanes.items():
        read, gaps = SPACES[space].read, () if base else bus.gaps.get(space, ())
        if read in most:
            blocks.extend(replace(block, base=base) for block in _blocks(space, read, lane, gaps, most[read]))
    order = {space: index for index, space in enumerate(SPACES)}
    return tuple(sorted(blocks, key=lambda block: (order[block.space], block.address, block.function)))


def _lanes(points: Sequence[Point], variants: Mapping[str, tuple[str, ...]]) -> dict[_LaneKey, _Lane]:
    lanes: defaultdict[_LaneKey, _Lane] = defaultdict(_Lane)
    variants_at: dict[_Place, set[Variant]] = {}
    for point in points:
        if point.variant is not None and point.readable:
            variants_at.setdefault(_place(point), set()).add(point.variant)
    for point in points:
        addresses, space = point.place.addresses, point.terms.space
        if not point.shape.readable or not addresses or space not in SPACES:
            continue
        lane = lanes[space, point.terms.base, (point.index or 0) if point.terms.to_end else -1]
        if _always_there(point, variants_at, variants):
            lane.crossable.update(addresses)
        low, end = min(addresses), max(addresses) + 1
        if point.generated and end - low == len(addresses) and not point.terms.selects:
            lane.spans.append((low, end, point.name))
    return lanes


def _place(point: Point) -> _Place:
    return point.name, point.space, point.place.addresses


def _always_there(
    point: Point, variants_at: Mapping[_Place, set[Variant]], variants: Mapping[str, tuple[str, ...]]
) -> bool:
    """Return True if every device has this point at its read address."""
    terms = point.terms
    if terms.when is not None or terms.since is not None or terms.until is not None:
        return False
    if point.variant is None:
        return True
    axis = point.variant.axis
    return {Variant(axis, value) for value in variants.get(axis, ())} <= variants_at[_place(point)]


def _blocks(space: str, function: int, lane: _Lane, gaps: Iterable[tuple[int, int]], most: int) -> Iterator[Block]:
    """Yield the blocks of a lane: its spans, joined as far as holes, gaps and the largest count allow."""
    closed = {address for address in lane.crossable if any(low <= address <= high for low, high in gaps)}
    crossable = lane.crossable - closed
    begin = end = 0
    names: dict[str, None] = {}
    single: dict[tuple[int, int], dict[str, None]] = {}
    for low, stop, name in sorted(span for span in lane.spans if span[1] - span[0] <= most):
        if not lane.crossable.issuperset(range(low, stop)):
            single.setdefault((low, stop), {})[name] = None
            continue
        if names and not (stop - begin <= most and crossable.issuperset(range(end, stop))):
            yield Block(space, function, begin, end - begin, tuple(names))
            names = {}
        if not names:
            begin, end = low, stop
        end = max(end, stop)
        names[name] = None
    if names:
        yield Block(space, function, begin, end - begin, tuple(names))
    for (low, stop), group in single.items():
        yield Block(space, function, low, stop - low, tuple(group))
