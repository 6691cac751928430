# SPDX-License-Identifier: 0BSD
"""How a Modbus device's words are read and written: requests and replies as bytes, no I/O."""

from __future__ import annotations

from collections.abc import Generator, Mapping, Sequence
from itertools import count
from typing import Any, ClassVar, TypeVar

from ..about import about_place
from ..arguments import check_bytes, check_name, check_place, check_values
from ..bits import BitLayout
from ..errors import AccessError, BlockError, RequestError, no_reply
from ..facts import Place
from ..layouts import Layout
from ..points import Decoding, Point
from ..session import Refusals, Session
from ..table import check_unit, check_variants, exists
from .bases import Bases, Start
from .frames import (
    BIT_READS,
    TCP,
    WRITE_COIL,
    WRITE_COILS,
    WRITE_REGISTER,
    WRITE_REGISTERS,
    WRITES,
    Profile,
    Request,
    build,
    check_framing,
    parse_checked,
)
from .planner import Block, plan, read_function

T = TypeVar("T")
Steps = Generator[bytes, bytes, T]
"""Each step yields the bytes of a request and is sent those of the reply."""

_WRITES = {
    "coil": (WRITE_COIL, WRITE_COILS),
    "holding": (WRITE_REGISTER, WRITE_REGISTERS),
}


_REMEMBERED = 256


class ModbusSession(Session):
    """The state of one Modbus device."""

    PROFILE: ClassVar[Profile]
    BASES: ClassVar[Any] = {}
    """What addresses count from, a `Base` by name; a device has it from its points, whose types are narrower."""
    GIVEN: ClassVar[Any] = {}
    """The ends of the numbers that are given when a device is opened, by name."""
    CHAIN: ClassVar[Any] = None
    """The `Chain` of blocks that are found, if there is one."""

    def __init__(self, framing: str, unit: int, variants: Mapping[str, str | None]) -> None:
        check_framing(framing, self.PROFILE)
        if type(unit) is not int or unit != self.PROFILE.broadcast:
            check_unit(unit, self.PROFILE.units)
        super().__init__(unit, variants)
        self._framing = framing
        self._transactions = count(1)
        self._reads: dict[tuple[int, int, int], tuple[Request, bytes]] = {}
        """Requests that read, as they were built."""
        self._readable: frozenset[tuple[str, int]] | None = None
        self._bases = Bases(self.BASES, self.GIVEN, self.CHAIN) if self.BASES else None

    def set_base(self, name: str, address: int, last: int | None = None) -> None:
        """Say where a base is that is known from elsewhere, and the last address that counts from it."""
        if self._bases is None:
            raise RequestError("bad_base", "the addresses of this device count from 0")
        self._bases.put(name, address, last)

    def forget(self) -> None:
        """Read everything anew, and search blocks anew."""
        super().forget()
        if self._bases is not None:
            self._bases.forget()

    def _give(self, numbers: Mapping[str, int | None]) -> None:
        assert self._bases is not None
        self._bases.give(numbers)

    def _chain_steps(self, address: int, count: int) -> Steps[tuple[int, ...]]:
        """Read words of the chain of blocks."""
        if self.CHAIN is None or self.unit == self.PROFILE.broadcast:
            raise BlockError("no_marker", "blocks are found in a single unit: set_base says where they are")
        return (yield from self._ask(self.CHAIN.function, address, count))

    def _blocks_steps(self) -> Steps[dict[int, Start]]:
        """Find the blocks."""
        if self._bases is None:
            raise BlockError("no_marker", "the addresses of this device count from no found block")
        return (yield from self._bases.blocks_steps(self._chain_steps))

    def _start_steps(self, base: str, last: int) -> Steps[int]:
        """Return the address of a base from which addresses up to the last count."""
        assert self._bases is not None
        start = yield from self._bases.start_steps(base, self._chain_steps)
        if last > start.last:
            text = f"the block of {base} ends at its word {start.last}, before the word {last}"
            raise BlockError("behind_end", text)
        return start.address

    def _there_steps(self, points: list[Decoding[Any]]) -> Steps[list[Decoding[Any]]]:
        """Return the points of a group that the found block has."""
        base = points[0].facts.at.base if points else None
        if base is None or self._bases is None or self.BASES[base].block is None:
            return points
        try:
            start = yield from self._bases.start_steps(base, self._chain_steps)
        except BlockError:
            return points  # each of them says so when it is read
        return [point for point in points if max(point.facts.at.addresses) <= start.last]

    def _ask(self, function: int, address: int, count: int = 0, values: tuple[int, ...] = ()) -> Steps[tuple[int, ...]]:
        """Return the steps of one request and its reply."""
        key = function, address, count
        if values or (known := self._reads.get(key)) is None:
            request = Request(self.unit, function, address, count, values)
            known = request, build(request, self.PROFILE, self._framing)
            if not values and len(self._reads) < _REMEMBERED:
                self._reads[key] = known
        if self.unit == self.PROFILE.broadcast:
            return self._retried_steps(0, self._to_all_steps, known[1])
        return self._retried_steps(self.retries, self._exchange_steps, *known)

    def _exchange_steps(self, request: Request, frame: bytes) -> Steps[tuple[int, ...]]:
        """Send a frame; return what the reply brings."""
        transaction = 0
        if self._framing == TCP:
            transaction = next(self._transactions) & 0xFFFF
            frame = transaction.to_bytes(2, "big") + frame[2:]
        sent = self.traffic.sent(frame)
        try:
            reply = yield frame
        except TimeoutError as error:
            raise no_reply(f"unit {self.unit} did not reply to function {request.function:02X}h", error) from error
        check_bytes(reply)
        self.traffic.came(reply, sent)
        return parse_checked(request, reply, self.PROFILE, self._framing, transaction)

    def _get_steps(self, place: Place) -> Steps[tuple[int, ...]]:
        """Return the steps that read the words or bits of a place, in ascending order of address."""
        if len(place.addresses) == 1 and place.base is None:
            return self._ask(read_function(place), place.addresses[0], 1)
        return self._several_steps(place)

    def _several_steps(self, place: Place) -> Steps[tuple[int, ...]]:
        start = 0 if place.base is None else (yield from self._start_steps(place.base, max(place.addresses)))
        if place.is_scattered:
            found: dict[int, int] = {}
            for block in plan(place.runs, self.PROFILE, self._bridges() - self._holes()):
                items = yield from self._words_steps(block.function, start + block.address, block.count)
                found.update(enumerate(items, block.address))
            return tuple([found[address] for address in sorted(place.addresses)])
        words = yield from self._words_steps(read_function(place), start + place.address, place.span)
        return tuple([words[address - place.address] for address in sorted(place.addresses)])

    def _words_steps(self, function: int, address: int, count: int) -> Steps[Sequence[int]]:
        """Read words or bits; a text that is longer than a request by several."""
        most = self.PROFILE.functions.get(function, count)
        if count <= most:
            return (yield from self._ask(function, address, count))
        words: list[int] = []
        while len(words) < count:
            words += yield from self._ask(function, address + len(words), min(most, count - len(words)))
        return words

    def _read_at_steps(self, space: str, address: int, count: int) -> Steps[tuple[int, ...]]:
        """Read by address; raises RequestError for what is no place."""
        check_place(space, address, count)
        place = Place(space, (address,))
        with about_place(self.traffic, place):
            return (yield from self._ask(read_function(place), address, count))

    def _write_at_steps(self, space: str, address: int, values: tuple[int, ...]) -> Steps[None]:
        """Write by address; raises RequestError for what is no place."""
        check_values(values)
        check_place(space, address, len(values))
        place = Place(space, tuple(range(address, address + len(values))))
        with about_place(self.traffic, place):
            if len(values) > self.PROFILE.functions.get(function := self._write_function(place, len(values)), 0):
                build(Request(self.unit, function, address, 0, values), self.PROFILE, self._framing)  # which is refused
            yield from self._put_steps(place, values)

    def _write_function(self, place: Place, count: int) -> int:
        if place.space not in _WRITES:
            raise RequestError("bad_space", f"the space {place.space!r} cannot be written, only coil and holding")
        single, block = _WRITES[place.space]
        if place.function in WRITES:
            return place.function
        return single if count == 1 and single in self.PROFILE.functions else block

    def _store_steps(self, place: Place, values: tuple[int, ...]) -> Steps[None]:
        """Write words or bits at a place; a text that is longer than a request by several, its first words first."""
        function = self._write_function(place, len(values))
        most = self.PROFILE.functions.get(function, len(values))
        start = 0 if place.base is None else (yield from self._start_steps(place.base, max(place.addresses)))
        for at in range(0, len(values), most):
            yield from self._ask(function, start + place.address + at, values=values[at : at + most])

    def _gather_steps(self, points: Sequence[Point], group: str | None, refusals: Refusals) -> Steps[dict[str, int]]:
        """Read the raw numbers of several points with few requests, in the blocks that the group was planned in."""
        planned: tuple[Block, ...] = self.BLOCKS.get(group, ()) if group is not None else ()
        blocks = [block for block in planned if any(block.covers(one.facts.at) for one in points)]
        bridges = self._bridges()
        if holes := self._holes():
            blocks = [block for block in blocks if holes.isdisjoint(block.places)]
            bridges -= holes
        rest = [one for one in points if not any(block.covers(one.facts.at) for block in blocks)]
        scattered = [one for one in rest if one.facts.at.is_scattered]
        raws = yield from super()._gather_steps(scattered, None, refusals)
        for block in (*blocks, *plan([one.facts.at for one in rest if one not in scattered], self.PROFILE, bridges)):
            inside = [point for point in points if block.covers(point.facts.at)]
            raws.update((yield from self._part_steps(inside, refusals, self._block_steps, block, inside)))
        return raws

    def _block_steps(self, block: Block, points: Sequence[Point]) -> Steps[dict[str, int]]:
        """Read points by one request; a long text by several."""
        last = block.address + block.count - 1
        start = 0 if block.base is None else (yield from self._start_steps(block.base, last))
        words = yield from self._words_steps(block.function, start + block.address, block.count)
        raws: dict[str, int] = {}
        for point in points:
            own = [words[address - block.address] for address in sorted(point.facts.at.addresses)]
            raws[point.facts.item] = self._taken(point, own)
        return raws

    def _note_gaps(self, points: Sequence[Point], *arguments: object) -> None:
        block = arguments[0]
        assert isinstance(block, Block)
        taken = {(block.area, address) for point in points for address in point.facts.at.addresses}
        self._gaps |= {place for place in block.places if place not in taken}

    def _holes(self) -> frozenset[tuple[str, int]]:
        """Return the addresses that the device has refused: of points, and between them."""
        places = [self.POINTS[item].facts.at for item in self._refused]
        return self._gaps.union((place.area, address) for place in places for address in place.addresses)

    @classmethod
    def layouts(cls, group: str, **variants: str) -> tuple[Layout, ...]:
        """The registers or bits of a group's planned reads, with the points in them; variants as for the device."""
        check_name("group", group)
        check_variants(cls.VARIANTS, variants)
        blocks: tuple[Block, ...] = cls.BLOCKS.get(group, ())
        if not blocks:
            raise AccessError(f"there is no group {group} with planned reads, only {', '.join(cls.BLOCKS)}")
        points = [point for point in cls.POINTS.values() if exists(point, variants)]
        made = []
        for block in blocks:
            inside = [point for point in points if block.covers(point.facts.at)]
            kind = BitLayout if block.function in BIT_READS else Layout
            made.append(kind(inside, range(block.address, block.address + block.count)))
        return tuple(made)

    def _bridges(self) -> frozenset[tuple[str, int]]:
        """The addresses of all points that are known to be there, and readable."""
        if self._readable is None:
            readable = [one for one in self.POINTS.values() if isinstance(one, Decoding) and self._surely_has(one)]
            places = [point.facts.at for point in readable]
            self._readable = frozenset((place.area, address) for place in places for address in place.addresses)
        return self._readable
