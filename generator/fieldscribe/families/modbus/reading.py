"""Reads the family's own facts from the description, and reports what the protocol cannot do."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from fieldscribe.families.modbus import BROADCAST, PROTOCOL_MOST, SPACES, ModbusBus, profile_of
from fieldscribe.language.nodes import Map
from fieldscribe.model import Block, Variant
from fieldscribe.resolve.family_reader import FamilyReader

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from fieldscribe.diagnostics import Span
    from fieldscribe.model import Bus, Code, Point
    from fieldscribe.resolve.scope import Scope


class ModbusReading(FamilyReader):
    """How Modbus functions, their counts, broadcasts and block reads are taken from a description."""

    def bus(self, scope: Scope, node: Map, functions: tuple[Code, ...]) -> ModbusBus:
        """How coils are padded."""
        _counts(scope, node, functions)
        _broadcasts(scope, node, functions)
        return ModbusBus(node.get("pad_coil_bytes"))

    def writes(self, space: str) -> tuple[int, ...]:
        """The functions that write into a space."""
        return tuple(
            function for function in (SPACES[space].write_one, SPACES[space].write_many) if function is not None
        )

    def blocks(self, bus: Bus, points: Sequence[Point], variants: Mapping[str, tuple[str, ...]]) -> tuple[Block, ...]:
        """The reads that bring all points of a group."""
        return plan_blocks(bus, points, variants)


def _counts(scope: Scope, node: Map, functions: tuple[Code, ...]) -> None:
    """Report functions with more items than the protocol can carry."""
    spans = _places(node, "max")
    for code in functions:
        most = PROTOCOL_MOST.get(code.number)
        if most is not None and code.most is not None and code.most > most:
            message = f"`max: {code.most}` is more than one request can carry"
            hint = f"function {code.number:02X}h takes at most {most}"
            scope.report.error("too-many-items", message, spans[code.name], hint)


def _broadcasts(scope: Scope, node: Map, functions: tuple[Code, ...]) -> None:
    """Report broadcast functions that the protocol always answers."""
    spans = _places(node, "broadcast")
    for code in functions:
        if code.broadcast and code.number not in BROADCAST:
            message = f"function {code.number:02X}h is never broadcast: it is of no use without an answer"
            shown = ", ".join(f"{function:02X}h" for function in sorted(BROADCAST))
            scope.report.error("not-broadcast", message, spans[code.name], f"functions that can be: {shown}")


def _places(node: Map, key: str) -> Mapping[str, Span]:
    """Where each function stands in the description, by its name."""
    return {value["name"]: value.span(key) for value in node.get("functions", {}).values() if isinstance(value, Map)}


READING = ModbusReading()


_Stand = tuple[str, str, tuple[int, ...]]
"""The name of a point, its space, and the addresses where it is read."""


@dataclass(slots=True)
class _Lane:
    """What one function reads in one space: `spans` of points (low, end, name), and `crossable` addresses.

    A block may cross an address if every device has a readable point there.
    """

    spans: list[tuple[int, int, str]] = field(default_factory=list)
    crossable: set[int] = field(default_factory=set)


def plan_blocks(bus: Bus, points: Sequence[Point], variants: Mapping[str, tuple[str, ...]]) -> tuple[Block, ...]:
    """The reads that fetch all generated readable points, ordered by space, then by address.

    A block covers only addresses with a readable point (also a reserved one) and none of the gaps of the bus. It holds
    whole points, and at most as many items as the device allows. A point that some devices lack (by a condition, a
    firmware or a variant) has a block of its own, for a device refuses a whole read if one address is missing. A point
    that no single read can fetch (no allowed function, too many words, words that are not neighbours) is in no block.
    """
    most = profile_of(bus).most
    blocks: list[Block] = []
    for (space, function), lane in _lanes(points, variants).items():
        if function in most:
            blocks.extend(_blocks_of_lane(space, function, lane, bus.gaps.get(space, ()), most[function]))
    order = {space: index for index, space in enumerate(SPACES)}
    blocks.sort(key=lambda block: (order[block.space], block.address, block.function))
    return tuple(blocks)


def _lanes(points: Sequence[Point], variants: Mapping[str, tuple[str, ...]]) -> dict[tuple[str, int], _Lane]:
    lanes: defaultdict[tuple[str, int], _Lane] = defaultdict(_Lane)
    values = _variants_with_place(points)
    for point in points:
        addresses, space = point.place.addresses, point.terms.space
        if not point.shape.readable or not addresses or space not in SPACES:
            continue
        lane = lanes[space, SPACES[space].read]
        if _always_there(point, values, variants):
            lane.crossable.update(addresses)
        low, end = min(addresses), max(addresses) + 1
        if point.generated and end - low == len(addresses):
            lane.spans.append((low, end, point.name))
    return lanes


def _variants_with_place(points: Iterable[Point]) -> dict[_Stand, set[Variant]]:
    """The variants that have a readable point of this name in this space at these addresses."""
    variants: dict[_Stand, set[Variant]] = {}
    for point in points:
        if point.variant is not None and point.readable:
            variants.setdefault(_stand(point), set()).add(point.variant)
    return variants


def _stand(point: Point) -> _Stand:
    return point.name, point.space, point.addresses


def _always_there(point: Point, values: Mapping[_Stand, set[Variant]], variants: Mapping[str, tuple[str, ...]]) -> bool:
    """Whether every device has this point at the place that it is read from."""
    terms = point.terms
    if terms.when is not None or terms.since is not None or terms.until is not None:
        return False
    if point.variant is None:
        return True
    axis = point.variant.axis
    return {Variant(axis, value) for value in variants.get(axis, ())} <= values[_stand(point)]


def _blocks_of_lane(
    space: str, function: int, lane: _Lane, gaps: tuple[tuple[int, int], ...], most: int
) -> Iterable[Block]:
    """The blocks of a lane: its spans, joined as far as holes, gaps and the largest count allow."""
    crossable = lane.crossable
    for low, high in gaps:
        crossable = {address for address in crossable if not low <= address <= high}
    begin = end = 0
    names: dict[str, None] = {}
    alone: dict[tuple[int, int], dict[str, None]] = {}
    for low, stop, name in sorted(span for span in lane.spans if span[1] - span[0] <= most):
        if not lane.crossable.issuperset(range(low, stop)):
            alone.setdefault((low, stop), {})[name] = None
            continue
        joins = stop - begin <= most and crossable.issuperset(range(end, stop))
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
