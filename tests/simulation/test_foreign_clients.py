"""Other people's clients on simulated Modbus devices: every point is read, written in each way, and refused a limit."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager
from functools import partial
from operator import ge
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.model import Point
from fieldscribe.simulation import Simulated, simulated
from support.foreign_clients import Ask, Refused, minimal_modbus, of_program, pymodbus
from support.made_once import made_once
from support.modbus_points import ADDRESS, CODES, LINES, READ_ONLY, SINK, VALUE, Talk, beyond, samples
from support.rust_programs import built_programs
from support.toolchains import libmodbus, succeed, tool

LEAST = {
    "eastron_sdm630": (60, 11, 12),
    "fronius_datamanager": (200, 60, 200),
    "hitachi_l200": (240, 360, 220),
    "jumo_controller": (20, 12, 12),
    "nord_sk5xxe": (45, 70, 8),
    SINK: (230, 320, 130),
}
"""How many points are read, written (each by one or two functions) and refused, at the least."""

CLIENTS = {
    "pymodbus": ("tcp", "rtu over tcp"),  # test_modbus_clients.py has its serial port, which is slow
    "minimalmodbus": ("serial",),
    "libmodbus": ("tcp", "serial"),
    "tokio-modbus": (*LINES,),
}

Client = Callable[[Simulated, str], AbstractContextManager[Ask]]


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
        if ways and wrong is not None and point.access != "none":
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
    writers = talk.layout.writers[cells.area[0], 0]
    alone = all(len(writers[address]) == 1 for address in cells.addresses)
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
        pytest.param(client, line, marks=pytest.mark.full(seconds=6))
        for client, lines in CLIENTS.items()
        for line in lines
    ],
)
def test_every_point(client: str, line: str, tmp_path_factory: pytest.TempPathFactory, request: Any) -> None:
    make, (on, framing) = clients(tmp_path_factory, request.config, client), LINES[line]
    for name, least in LEAST.items():
        with simulated(name, on=on) as device, make(device, framing) as ask:
            talk = Talk(device, ask)
            exercise(name, talk)
        counts = len(talk.read), len(talk.written), len(talk.refused)
        assert all(map(ge, counts, least)), (name, counts)
