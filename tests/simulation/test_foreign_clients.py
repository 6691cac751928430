"""Other people's clients on simulated Modbus devices: every point is read, written in each way, and refused a limit."""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager
from functools import partial
from operator import ge
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.arithmetic import codec, texts
from fieldscribe.arithmetic.codec import CodecError
from fieldscribe.arithmetic.words import insert, words_of
from fieldscribe.families.modbus import SPACES, profile_of
from fieldscribe.model import Point
from fieldscribe.simulation import Simulated, simulated
from support.foreign_clients import Ask, Refused, minimal_modbus, of_program, pymodbus
from support.made_once import made_once
from support.places import TESTS
from support.rust_programs import built_programs
from support.toolchains import libmodbus, succeed, tool

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

LEAST = {
    "eastron_sdm630": (60, 11, 12),
    "fronius_datamanager": (200, 60, 200),
    "hitachi_l200": (240, 360, 220),
    "jumo_controller": (20, 12, 12),
    "nord_sk5xxe": (45, 70, 8),
    SINK: (230, 320, 130),
}
"""How many points are read, written (each by one or two functions) and refused, at the least."""

LINES = {"tcp": ("tcp", "tcp"), "rtu over tcp": ("tcp", "rtu"), "serial": ("serial", "rtu")}
CLIENTS = {
    "pymodbus": ("tcp", "rtu over tcp"),  # test_modbus_clients.py has its serial port, which is slow
    "minimalmodbus": ("serial",),
    "libmodbus": ("tcp", "serial"),
    "tokio-modbus": (*LINES,),
}

Client = Callable[[Simulated, str], AbstractContextManager[Ask]]


class Talk:
    """What one client and one device have said to each other."""

    def __init__(self, device: Simulated, ask: Ask, most_refused: int) -> None:
        self.ask, self.most_refused = ask, most_refused
        self.layout, self.memory = device.device.layout, device.device.memory
        self.most = profile_of(self.layout.device.bus).most
        self.read, self.written, self.refused = set[str](), set[tuple[str, int]](), set[str]()

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


def refusal(talk: Talk, point: Point, raw: int, function: int) -> int:
    """Return the number of the exception that a write leads to; 0 for none."""
    try:
        talk.write(point, raw, function)
    except Refused as refused:
        return refused.code
    return 0


def exercise(name: str, talk: Talk) -> None:
    """Do with each point all that a client can."""
    codes, memory = CODES[name], talk.memory
    for point in talk.points():
        if point.access != "w":
            assert talk.raw(point) == talk.held(point), point.name
            talk.read.add(point.name)
    for point in [*talk.points()]:
        held, ways = memory.raw(point.name), talk.ways(point)
        for way in ways if point.writable else ():
            change(talk, point, held, way)
            memory.put(point.name, held)
        wrong = held if point.access == "r" else beyond(point, talk)
        if ways and wrong is not None and point.access != "none" and len(talk.refused) < talk.most_refused:
            expected = codes[READ_ONLY if point.access == "r" else VALUE]
            assert refusal(talk, point, wrong, ways[-1]) == expected, (point.name, wrong)
            assert memory.raw(point.name) == held
            talk.refused.add(point.name)
    reading = next(way for way in (3, 4) if way in talk.most)
    with pytest.raises(Refused) as nothing:
        talk.ask(reading, 0xFFF0, [1])
    assert nothing.value.code == codes[ADDRESS]


def change(talk: Talk, point: Point, held: int, way: int) -> None:
    """Write a point by a function and read it back; what shares its word may refuse some numbers."""
    cells = talk.layout.written[point.name]
    alone = all(len(talk.layout.writers[cells.area][address]) == 1 for address in cells.addresses)
    for raw in samples(point, held, talk):
        code = refusal(talk, point, raw, way)
        assert not (code and alone), (point.name, raw, way, code)
        if code:
            continue
        assert talk.memory.raw(point.name) == raw, (point.name, way)
        if point.access == "rw":
            assert talk.raw(point) == talk.held(point), (point.name, way)
        talk.written.add((point.name, way))
        return
    assert any((cells.area, address) in talk.layout.commands for address in cells.addresses), (point.name, way)


def clients(factory: pytest.TempPathFactory, config: pytest.Config, name: str) -> Client:
    """Return what makes a client of a device and a framing; a program is built once a run."""

    def build(out: Path) -> None:
        source = Path(__file__).parent / "programs/foreign.c"
        flags, library = libmodbus()
        succeed([tool("gcc"), "-Wall", "-Wextra", "-Werror", "-O1", flags, "-o", out / "foreign", source, library])

    if name == "libmodbus":
        return partial(of_program, made_once(factory, name, build) / "foreign")
    if name == "tokio-modbus":
        return partial(of_program, built_programs(factory, config) / "foreign")
    return minimal_modbus if name == "minimalmodbus" else pymodbus


@pytest.mark.parametrize(
    ("client", "line"),
    [
        pytest.param(client, line, marks=pytest.mark.full(seconds=12 if client == "minimalmodbus" else 5))
        for client, lines in CLIENTS.items()
        for line in lines
    ],
)
def test_every_point(client: str, line: str, tmp_path_factory: pytest.TempPathFactory, request: Any) -> None:
    make, (on, framing) = clients(tmp_path_factory, request.config, client), LINES[line]
    for name, least in LEAST.items():
        with simulated(name, on=on) as device, make(device, framing) as ask:
            talk = Talk(device, ask, 12 if client == "minimalmodbus" else 1000)
            exercise(name, talk)
        counts = len(talk.read), len(talk.written), len(talk.refused)
        assert all(map(ge, counts, (*least[:2], min(least[2], talk.most_refused)))), (name, counts)
