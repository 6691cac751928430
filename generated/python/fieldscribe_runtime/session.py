# SPDX-License-Identifier: 0BSD
"""What a device is asked, in which order: the part of sync and async devices that does no I/O.

Each operation is a generator: it yields the bytes of a request, is sent the bytes of the reply, and returns a result.
"""

from __future__ import annotations

from collections.abc import Generator, Iterable, Mapping
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar

from . import modbus
from .descriptors import PointAttribute, ReadOnly, ReadWrite, WriteOnly
from .errors import AccessError, RequestError
from .modbus import Profile, Request
from .planner import Block, plan, read_function
from .points import Decoding, Encoding, Point

if TYPE_CHECKING:
    from .facts import Place

T = TypeVar("T")
Steps = Generator[bytes, bytes, T]
Value = float | None
"""What reading can give: numbers (also bool, IntEnum and IntFlag), or None for "no value"."""

_KEPT = frozenset({"never", "rarely"})
_WRITES = {
    "coil": (modbus.WRITE_COIL, modbus.WRITE_COILS),
    "holding": (modbus.WRITE_REGISTER, modbus.WRITE_REGISTERS),
}


class PointTable:
    """A device's points, with what its bus needs to know."""

    PROFILE: ClassVar[Profile]
    BLOCKS: ClassVar[Mapping[str, tuple[Block, ...]]] = {}
    POINTS: ClassVar[Mapping[str, PointAttribute]] = {}
    VARIANTS: ClassVar[Mapping[str, tuple[str, ...]]] = {}

    def __init_subclass__(cls) -> None:
        points = {name: point for name, point in vars(cls).items() if isinstance(point, PointAttribute)}
        own = {point.facts.item: point for point in points.values() if point.new_name is None}
        cls.POINTS = {**cls.POINTS, **own}


class Session(PointTable):
    """The state of one device on a bus: its unit number, its variants, and what is remembered of it."""

    def __init__(self, framing: str, unit: int, variants: Mapping[str, str | None]) -> None:
        if framing not in (modbus.RTU, modbus.TCP):
            raise ValueError(f"the framing is 'rtu' or 'tcp', not {framing!r}")
        for axis, value in variants.items():
            if axis not in self.VARIANTS:
                raise ValueError(f"the device has no variants by {axis!r}")
            if value is not None and value not in self.VARIANTS[axis]:
                raise ValueError(f"{axis} is one of {', '.join(self.VARIANTS[axis])}, not {value!r}")
        self.unit = unit
        self.variants = variants
        self._framing = framing
        self._transaction = 0
        self._kept: dict[str, int] = {}
        self._readable: frozenset[tuple[str, int]] | None = None

    def forget(self) -> None:
        """Read everything anew that was remembered because it changes rarely or never."""
        self._kept.clear()

    def point(self, name: str) -> PointAttribute:
        """A point by name, that of this device's variant; raises AccessError."""
        found = self.POINTS.get(name)
        if found is None:
            same = [point for point in self.POINTS.values() if point.facts.name == name]
            found = next((point for point in same if self._has(point)), None)
        if found is None:
            raise AccessError(f"{name} does not exist for {dict(self.variants)}")
        return found

    def require(self, point: Point) -> None:
        """Raises AccessError if the point belongs to another variant than the one given for this device."""
        axis, value = point.facts.variant or ("", None)
        if self.variants.get(axis, value) not in (value, None):
            raise AccessError(f"{point.label} exists only for {axis} {value}")

    def _has(self, point: Point) -> bool:
        return point.facts.variant is None or self.variants.get(point.facts.variant[0]) == point.facts.variant[1]

    def ask(self, function: int, address: int, count: int = 0, values: tuple[int, ...] = ()) -> Steps[tuple[int, ...]]:
        """One request and its reply."""
        self._transaction = self._transaction + 1 & 0xFFFF
        request = Request(self.unit, function, address, count, values)
        reply = yield modbus.build(request, self.PROFILE, self._framing, self._transaction)
        if self.unit == self.PROFILE.broadcast:
            return ()
        return modbus.parse(request, reply, self.PROFILE, self._framing, self._transaction)

    def read_raw_steps(self, point: Point) -> Steps[int]:
        """Read a point's raw number."""
        at = point.facts.at
        words = yield from self.ask(read_function(at), at.address, at.span)
        return self._taken(point, Block(at.space, 0, at.address, at.span), words)

    def _taken(self, point: Point, block: Block, words: tuple[int, ...]) -> int:
        raw = point.from_words([words[address - block.address] for address in sorted(point.facts.at.addresses)])
        if point.facts.changes in _KEPT:
            self._kept[point.facts.item] = raw
        return raw

    def raws_steps(self, names: Iterable[str], known: Mapping[str, int]) -> Steps[dict[str, int]]:
        """The raw numbers of other points: those known, those remembered, the rest read."""
        raws: dict[str, int] = {}
        for name in names:
            point = self.point(name)
            if name in known:
                raws[name] = known[name]
            elif point.facts.item in self._kept:
                raws[name] = self._kept[point.facts.item]
            else:
                raws[name] = yield from self.read_raw_steps(point)
        return raws

    def read_steps(self, point: Decoding[T]) -> Steps[T]:
        """Read a point's value."""
        raws = yield from self.raws_steps(point.scale_needs, {})
        raw = yield from self.read_raw_steps(point)
        return point.decode(raw, raws)

    def write_steps(self, point: Encoding[T], value: T) -> Steps[None]:
        """Write a value."""
        raws = yield from self.raws_steps(dict.fromkeys((*point.scale_needs, *point.limit_needs)), {})
        yield from self._put_steps(point, point.encode(value, raws))

    def write_raw_steps(self, point: Encoding[Any], raw: int) -> Steps[None]:
        """Write a raw number that the range allows."""
        point.check(raw, (yield from self.raws_steps(point.limit_needs, {})))
        yield from self._put_steps(point, raw)

    def _put_steps(self, point: Point, raw: int) -> Steps[None]:
        place = point.facts.write_at or point.facts.at
        words = point.to_words(raw)
        if point.facts.bits is not None:
            if isinstance(self.POINTS.get(point.facts.item), WriteOnly):
                raise AccessError(f"{point.label}: the other bits of its word cannot be read back")
            word = yield from self.ask(read_function(point.facts.at), point.facts.at.address, 1)
            words = (point.insert(word[0], raw),)
        yield from self.put_steps(place, words)

    def put_steps(self, place: Place, values: tuple[int, ...]) -> Steps[None]:
        """Write words or bits at a place."""
        if place.space not in _WRITES:
            raise RequestError("bad_space", f"the space {place.space!r} cannot be written, only coil and holding")
        single, block = _WRITES[place.space]
        function = single if len(values) == 1 and single in self.PROFILE.functions else block
        if place.function in modbus.WRITES:
            function = place.function
        self._drop(place)
        yield from self.ask(function, place.address, values=values)

    def _drop(self, place: Place) -> None:
        """Forget what is remembered of the points at a place that is written."""
        for item in list(self._kept):
            at = self.POINTS[item].facts.at
            if at.space == place.space and set(at.addresses) & set(place.addresses):
                del self._kept[item]

    def read_many_steps(self, what: str | Iterable[str | Point]) -> Steps[dict[str, Value]]:
        """Read a group, or any points, with as few requests as the device allows."""
        points, blocks = self._group(what) if isinstance(what, str) else (self._listed(what), ())
        needed = dict.fromkeys(name for point in points for name in point.scale_needs)
        wanted = [*points, *(self.point(name) for name in needed if name not in self._kept)]
        rest = [one.facts.at for one in wanted if not any(block.covers(one.facts.at) for block in blocks)]
        raws: dict[str, int] = {}
        for block in (*blocks, *plan(rest, self.PROFILE, self._bridges())):
            words = yield from self.ask(block.function, block.address, block.count)
            covered = [point for point in wanted if block.covers(point.facts.at)]
            raws.update({point.facts.name: self._taken(point, block, words) for point in covered})
        values: dict[str, Value] = {}
        for point in points:
            known = yield from self.raws_steps(point.scale_needs, raws)
            values[point.facts.name] = point.decode(raws[point.facts.name], known)
        return values

    def _listed(self, what: Iterable[str | Point]) -> list[ReadOnly[Any] | ReadWrite[Any, Any]]:
        points = [self.point(one if isinstance(one, str) else one.facts.item) for one in what]
        for point in points:
            self.require(point)
            if not isinstance(point, Decoding):
                raise AccessError(f"{point.label} cannot be read")
        return [point for point in points if isinstance(point, ReadOnly | ReadWrite)]

    def _group(self, group: str) -> tuple[list[ReadOnly[Any] | ReadWrite[Any, Any]], tuple[Block, ...]]:
        members = [point for point in self.POINTS.values() if point.facts.group == group and self._has(point)]
        if not members:
            raise AccessError(f"there is no group {group}")
        return [point for point in members if isinstance(point, ReadOnly | ReadWrite)], self.BLOCKS.get(group, ())

    def _readable_here(self, point: Point) -> bool:
        return isinstance(point, Decoding) and self._has(point)

    def _bridges(self) -> frozenset[tuple[str, int]]:
        if self._readable is None:
            places = [point.facts.at for point in self.POINTS.values() if self._readable_here(point)]
            self._readable = frozenset((place.space, address) for place in places for address in place.addresses)
        return self._readable
