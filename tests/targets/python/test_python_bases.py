"""Addresses that count from a base: given when the device is opened, or found in a chain of blocks."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from typing import Any

import pytest
from support.blocks import FOUND, HOSTILE, INVERTER, MODULES, Registers, chain
from support.described import made
from support.python_package import Awaited, imported, status, write_package


@pytest.fixture(scope="module")
def package(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Any]:
    """The package of the device with bases."""
    folder = write_package(made("kitchen_blocks"), tmp_path_factory.mktemp("bases"))
    yield from imported(folder, "kitchen_blocks")


def test_given(package: Any) -> None:
    """Addresses count from what is given; two devices of one line have their own."""
    line = Registers({5: 1, 3005: 405, 3006: 0, 3007: 8, 3008: 3, 15021: 500})
    third, last = package.KitchenBlocks(line, 1, slot=3, half=0), package.KitchenBlocks(line, 1, slot=15, half=1)
    assert (third.firmware.read(), third.level.read(), third.energy.read(), last.level.read()) == (1, 40.5, 8, 50.0)
    third.level.write(12.5)
    third.mode.write(2)
    assert (line.held[3005], line.held[3008]) == (125, 5)
    assert str(third.level.facts.at) == "holding 0x0005 from slot_half"


def test_steps(package: Any) -> None:
    """Words of a command count from the base of their points; one command may have several bases."""
    line = Registers({5: 3, 3005: 405, 3006: 0, 3007: 0, 3008: 2, 40: 0, **FOUND, 50009: 7})
    device = package.KitchenBlocks(line, 1, slot=3, half=0)
    device.dim.send(percent=50)
    assert (line.held[3005], line.held[3008]) == (500, 3)
    wrong, message = status(device.close.send)
    assert wrong == "no_block"
    assert "close, step 1" in message


@pytest.mark.parametrize(
    ("given", "needle"),
    [
        ({"slot": 0, "half": 0}, "slot is 1 to 15, not 0"),
        ({"slot": 16, "half": 0}, "slot is 1 to 15, not 16"),
        ({"slot": "3", "half": 0}, "slot is an integer"),
        ({"slot": 3}, "depends on half: pass it when the device is made"),
        ({}, "depends on slot: pass it when the device is made"),
    ],
)
def test_given_wrongly(package: Any, given: dict[str, Any], needle: str) -> None:
    """What is not given, or no such number, is said before anything is sent."""
    line = Registers({})

    def read() -> object:
        return package.KitchenBlocks(line, 1, **given).level.read()

    wrong, message = status(read)
    assert wrong == "bad_base"
    assert needle in message
    assert not line.asked


def test_found(package: Any) -> None:
    """The blocks are searched once, and anew when all is forgotten."""
    line = Registers(FOUND)
    device = package.KitchenBlocks(line, 1)
    assert device.current.read() == 25.0
    assert line.asked[:6] == [(40000, 2), (0, 2), (50000, 2), (50002, 2), (50005, 2), (50013, 2)]
    assert line.asked[6:] == [(50023, 2), (50008, 1), (50007, 1)]
    line.asked.clear()
    assert device.read_many("modules") == {
        "module_id_index_1": 11,
        "module_id_index_2": 12,
        "module_limit_index_1": 21,
        "module_limit_index_2": 22,
        "module_energy_index_1": 31,
        "module_energy_index_2": 32,
    }
    assert line.asked == [(50015, 4), (50019, 4)]
    device.module_limit_index_2.write(5)
    assert line.held[50020] == 5
    assert device.find_blocks() == {1: (50002, 2), 103: (50005, 7), 160: (50013, 9)}
    line.held = chain(0, INVERTER)
    device.forget()
    assert device.current.read() == 25.0
    assert list(device.find_blocks()) == [103]


def test_found_with_await(package: Any) -> None:
    """The async device does the same."""

    device = package.KitchenBlocksAsync(Awaited(Registers(FOUND)), 1)
    assert asyncio.run(device.current.read()) == 25.0
    assert asyncio.run(device.find_blocks())[160] == (50013, 9)


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_chains(package: Any, name: str) -> None:
    """A search ends, says what is wrong, and is not repeated for each point."""
    held, expected = HOSTILE[name]
    line = Registers(held)
    device = package.KitchenBlocks(line, 1)
    assert status(device.current.read)[0] == expected
    assert len(line.asked) < 300
    asked = len(line.asked)
    assert status(device.current.read)[0] == expected
    assert expected not in {"no_marker", "bad_chain"} or len(line.asked) == asked


def test_several_at_once(package: Any) -> None:
    """A group whose block is not there says so at each point, or at once."""
    device = package.KitchenBlocks(Registers(chain(0, MODULES)), 1)
    values = device.read_many("inverter", errors="return")
    assert {one.status for one in values.values()} == {"no_block"}
    assert status(lambda: device.read_many("inverter"))[0] == "no_block"


def test_known_from_elsewhere(package: Any) -> None:
    """A base may be said; what lies behind its end is not asked for."""
    line = Registers(dict.fromkeys(range(100, 140), 1))
    device = package.KitchenBlocks(line, 1)
    device.set_base("models_160", 100, 5)
    assert device.module_id_index_1.read() == 1
    assert status(device.module_id_index_2.read)[0] == "behind_end"
    assert line.asked == [(102, 1)]
    for arguments in (("models_161", 1), ("slot", -1), ("slot", 65536), ("slot", 1, 65535), ("slot", "1")):
        assert status(lambda put=arguments: device.set_base(*put))[0] == "bad_base"


@pytest.mark.parametrize(("points", "curves"), [(4, 2), (0, 0), (2, 4)])
def test_behind_what_points_count(package: Any, points: int, curves: int) -> None:
    """What lies behind counted words is found by reading the counts, once."""
    words = [points, curves, *(number % 2 for number in range(14))]
    line = Registers(chain(40000, (705, words)))
    device = package.KitchenBlocks(line, 1)
    place = 40002 + points * 2 + curves + 1 + 3
    line.held[place], line.held[place + 1], line.held[place + 2] = 1, 0, 99
    assert (device.curve_access.read().name, device.curve_time.read()) == ("CLOSED", 99)
    assert line.asked[-4:] == [(40004, 1), (40005, 1), (place, 1), (place + 1, 2)]
    device.curve_access.write(package.CurveAccess.OPEN)
    assert line.held[place] == 0


def test_behind_the_end_of_the_block(package: Any) -> None:
    """A device that counts more than its block has is answered with what is wrong."""
    device = package.KitchenBlocks(Registers(chain(40000, (705, [9000, 0, 0, 0]))), 1)
    assert status(device.curve_time.read)[0] == "behind_end"
