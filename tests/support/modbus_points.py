"""The points of a simulated Modbus device as a client meets them: their words, what they take, and what they refuse."""

from __future__ import annotations

import struct
from collections.abc import Iterator, Sequence

from fieldscribe.arithmetic import codec, texts
from fieldscribe.arithmetic.codec import CodecError
from fieldscribe.arithmetic.words import insert, words_of
from fieldscribe.families.modbus import SPACES, profile_of
from fieldscribe.model import Point
from fieldscribe.simulation import Simulated

from support.foreign_clients import Ask
from support.places import TESTS

SINK = str(TESTS / "devices/kitchen_sink")
ADDRESS, VALUE, READ_ONLY = "address", "value", "read only"
STANDARD = {ADDRESS: 2, VALUE: 3, READ_ONLY: 4}
CODES = {
    "eastron_sdm630": STANDARD | {READ_ONLY: 5},
    "fronius_datamanager": STANDARD,
    "hitachi_l200": {ADDRESS: 2, VALUE: 0x21, READ_ONLY: 0x22},
    "jumo_controller": {ADDRESS: 2, VALUE: 8, READ_ONLY: 8},
    "nord_sk5xxe": STANDARD,
    SINK: {ADDRESS: 2, VALUE: 0x21, READ_ONLY: 2},
}
"""The exceptions that the manuals have for what is refused; where they have none, those of the protocol."""

LINES = {"tcp": ("tcp", "tcp"), "rtu over tcp": ("tcp", "rtu"), "serial": ("serial", "rtu")}
"""What a device is simulated on, and the framing of a client, for each line."""


class Talk:
    """What one client and one device have said to each other."""

    def __init__(self, device: Simulated, ask: Ask | None = None) -> None:
        self._ask = ask
        self.layout, self.memory = device.device.layout, device.device.memory
        self.most = profile_of(self.layout.device.bus).most
        self.read, self.written, self.refused = set[str](), set[tuple[str, int]](), set[str]()

    def ask(self, function: int, address: int, items: Sequence[int]) -> list[int]:
        """Let the client send a request."""
        assert self._ask is not None
        return self._ask(function, address, items)

    def points(self) -> Iterator[Point]:
        """Yield the points that are there now."""
        for point in self.layout.points.values():
            if point.place.addresses and self.memory.exists(point):
                yield point

    def raw(self, point: Point) -> tuple[int, ...]:
        """Return the words of a point as the client reads them: as many neighbours as the device allows at once."""
        function, at = SPACES[point.space].read, self.layout.cells[point.name].addresses
        words: dict[int, int] = {}
        for start in sorted(at):
            if start not in words:
                count = next(
                    size
                    for size in range(1, self.most[function] + 1)
                    if size == self.most[function] or start + size not in at
                )
                words.update(enumerate(self.ask(function, start, [count]), start))
        return tuple(words[address] for address in at)

    def held(self, point: Point) -> tuple[int, ...]:
        """Return the words of a point as the device holds them."""
        cells = self.layout.cells[point.name]
        return tuple(self.memory.areas[cells.area][address] for address in cells.addresses)

    def ways(self, point: Point) -> list[int]:
        """Return the functions that write the point in one request."""
        cells = self.layout.written[point.name]
        space, count = SPACES[cells.area[0]], len(cells.addresses)
        known = [
            way for way in (space.write_one, space.write_many) if way is not None and count <= self.most.get(way, 0)
        ]
        return known if max(cells.addresses) - min(cells.addresses) == count - 1 and not point.write_with else []

    def write(self, point: Point, raw: int, function: int) -> None:
        """Write a raw number; what else is in the word stays."""
        cells = self.layout.written[point.name]
        held = self.memory.areas[cells.area]
        words = words_of(point, raw)
        if point.bits is not None:
            words = (insert(point, held[cells.addresses[0]], raw),)
        items = dict(zip(cells.addresses, words, strict=True))
        self.ask(function, min(items), [items[address] for address in sorted(items)])

    def allows(self, point: Point, raw: int) -> bool:
        """Return True if the limits of a point allow a raw number now."""
        try:
            codec.check(point, raw, self.memory.settings)
        except CodecError:
            return False
        return True


def samples(point: Point, held: int, talk: Talk) -> list[int]:
    """Return raw numbers that a point may take, as far as its limits; the one that it holds is the last."""
    if point.text is not None:
        if point.text.parts:
            return [held]
        return [held ^ 1] if point.text.is_bytes else [texts.pattern_of_text(point.text, "AB")]
    step = max((step for _, step in point.steps), default=1)
    found = [held ^ 1, held + step, held - step]
    if point.info.floating:
        found = [
            codec.encode(point, end, talk.memory.settings) for ends in point.allowed.units for end in ends
        ] or found
    else:
        found += [end for window in codec.windows(point, talk.memory.settings) for end in (window.high, window.low)]
    found += [entry.raw for entry in point.enum.entries] if point.enum else []
    at = talk.layout.written[point.name]
    starts = talk.layout.commands.get((at.area, at.addresses[0]))  # writing its value does something else
    others = [raw for raw in dict.fromkeys(found) if raw != held and point.least <= raw <= point.greatest]
    return [raw for raw in (*others, held) if talk.allows(point, raw) and not (starts and raw == starts.value)]


def beyond(point: Point, talk: Talk) -> int | None:
    """Return a raw number beside the limits of a point; None if all that its bits hold is allowed."""
    if point.text is not None or point.fixed is not None:
        return None
    if point.info.floating:
        ends = [raw_of_float(point, float(high) + 1) for _, high in point.allowed.units]
    else:
        step = max((step for _, step in point.steps), default=1)
        windows = codec.windows(point, talk.memory.settings)
        ends = [raw for window in windows for raw in (window.high + step, window.low - step)]
    fitting = (raw for raw in ends if point.least <= raw <= point.greatest and not point.coding)
    return next((raw for raw in fitting if not talk.allows(point, raw)), None)


def raw_of_float(point: Point, value: float) -> int:
    return int.from_bytes(struct.pack(">f" if point.info.bits == 32 else ">d", value), "big")
