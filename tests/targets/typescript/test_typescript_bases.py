"""Addresses that count from a base, in TypeScript: given when the device is made, or found in a chain of blocks."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from support.blocks import FOUND, HOSTILE, INVERTER, MODULES, Registers, chain, served
from support.described import made
from support.node_device import NodeDevice, NodeError, installed, node_device
from support.typescript_packages import install

pytestmark = pytest.mark.full(seconds=2)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder with the package of the device with bases."""
    folder = installed(tmp_path_factory.mktemp("bases"))
    install(folder, [made("kitchen_blocks")])
    return folder


@contextmanager
def over(folder: Path, line: Registers, **given: Any) -> Iterator[NodeDevice]:
    """Run the device on these registers."""
    with (
        served(line) as port,
        node_device(folder, "kitchen_blocks", {"kind": "tcp", "port": port, "framing": "rtu"}, unit=1, **given) as node,
    ):
        yield node


def status_of(node: NodeDevice, *call: Any) -> str:
    with pytest.raises(NodeError) as raised:
        node(*call)
    return str(raised.value.status)


def test_given(folder: Path) -> None:
    line = Registers({5: 1, 3005: 405, 3006: 0, 3007: 8, 3008: 3, 15021: 500})
    with over(folder, line, slot=3, half=0) as third:
        assert [third(point, "read") for point in ("firmware", "level", "energy")] == [1, 40.5, 8]
        third("level", "write", 12.5)
        third("mode", "write", 2)
    assert (line.held[3005], line.held[3008]) == (125, 5)
    with over(folder, line, slot=15, half=1) as last:
        assert last("level", "read") == 50


STEPS = {5: 3, 3005: 405, 3006: 0, 3007: 0, 3008: 2, 40: 0, **FOUND, 50009: 7}
CURVES = chain(40000, (705, [0, 0, 0, 0, 0, 0]), MODULES)


@pytest.mark.parametrize(
    ("command", "changed", "expected", "held"),
    [
        (("dim", "send", {"percent": 50}), {}, None, {3005: 500, 3008: 3}),
        (("dim", "send", {"percent": 100}), {5: 2}, None, {3005: 1000, 3008: 2}),
        (("dim", "send", {"percent": 0}), {3007: 1}, "not_reached", {3005: 0, 3008: 3}),
        (("dim", "send", {"percent": 101}), {}, "out_of_range", {3005: 405}),
        (("dim", "send", {"percent": -1}), {}, "out_of_range", {3005: 405}),
        (("dim", "send", {"percent": 1.5}), {}, "out_of_range", {3005: 405}),
        (("dim", "send", {"speed": 5}), {}, "bad_arguments", {3005: 405}),
        (("dim", "send", {}), {}, "bad_arguments", {3005: 405}),
        (("dim", "send"), {}, "bad_arguments", {3005: 405}),
        (("dim", "send", {"percent": 50}), {5: None}, "exception", {3005: 500, 3008: 2}),
        (("close", "send"), {}, "no_block", {40: 0}),
        (("close", "send"), CURVES, None, {40006: 1, 40007: 0, 40008: 5, 40: 1, 40017: 3}),
    ],
    ids=str,
)
def test_steps(
    folder: Path,
    command: tuple[Any, ...],
    changed: dict[int, int | None],
    expected: str | None,
    held: dict[int, int],
) -> None:
    """Steps are taken in order, if their condition holds; arguments that are none send nothing."""
    words = {at: word for at, word in {**STEPS, **changed}.items() if word is not None}
    line = Registers(words)
    with over(folder, line, slot=3, half=0) as node:
        if expected is None:
            node(*command)
        else:
            assert status_of(node, *command) == expected
            assert bool(line.asked) == (expected not in ("out_of_range", "bad_arguments"))
    assert {at: line.held[at] for at in held} == held


@pytest.mark.parametrize("given", [{"slot": 0, "half": 0}, {"slot": 16, "half": 0}, {"slot": 3}, {}], ids=str)
def test_given_wrongly(folder: Path, given: dict[str, int]) -> None:
    """What is not given, or no such number, is said before anything is sent."""
    line = Registers({})
    with over(folder, line, **given) as node:
        assert status_of(node, "level", "read") == "bad_base"
    assert not line.asked


def test_found(folder: Path) -> None:
    """The blocks are searched once, and anew when all is forgotten."""
    line = Registers(FOUND)
    with over(folder, line) as node:
        assert node("current", "read") == 25
        assert line.asked[:6] == [(40000, 2), (0, 2), (50000, 2), (50002, 2), (50005, 2), (50013, 2)]
        assert line.asked[6:] == [(50023, 2), (50008, 1), (50007, 1)]
        line.asked.clear()
        found = node(None, "readMany", "modules")
        kinds = ("Id", "Limit", "Energy")
        assert found == {
            f"module{kind}Index{at + 1}": (at + 1) + 10 * place + 10
            for at in (0, 1)
            for place, kind in enumerate(kinds)
        }
        assert line.asked == [(50015, 4), (50019, 4)]
        line.held = chain(0, INVERTER)
        node(None, "forget")
        assert node("current", "read") == 25
        assert list(node(None, "findBlocks")) == ["103"]


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_chains(folder: Path, name: str) -> None:
    """A search ends, says what is wrong, and is not repeated for each point."""
    held, expected = HOSTILE[name]
    line = Registers(held)
    with over(folder, line) as node:
        assert status_of(node, "current", "read") == expected
        asked = len(line.asked)
        assert asked < 300
        assert status_of(node, "current", "read") == expected
    assert expected not in {"no_marker", "bad_chain"} or len(line.asked) == asked


def test_several_at_once(folder: Path) -> None:
    """A group whose block is not there says so at each point, or at once."""
    with over(folder, Registers(chain(0, MODULES))) as node:
        values = node(None, "readMany", "inverter", {"errors": "return"})
        assert {one["error"]["status"] for one in values.values()} == {"no_block"}
        assert status_of(node, None, "readMany", "inverter") == "no_block"


def test_known_from_elsewhere(folder: Path) -> None:
    """A base may be said; what lies behind its end is not asked for."""
    line = Registers(dict.fromkeys(range(100, 140), 1))
    with over(folder, line) as node:
        node(None, "setBase", "models_160", 100, 5)
        assert node("moduleIdIndex1", "read") == 1
        assert status_of(node, "moduleIdIndex2", "read") == "behind_end"
        assert line.asked == [(102, 1)]
        for given in (("models_161", 1), ("slot", -1), ("slot", 65536), ("slot", 1, 65535), ("slot", "1")):
            assert status_of(node, None, "setBase", *given) == "bad_base"


@pytest.mark.parametrize(("points", "curves"), [(4, 2), (0, 0), (2, 4)])
def test_behind_what_points_count(folder: Path, points: int, curves: int) -> None:
    """What lies behind counted words is found by reading the counts, once."""
    line = Registers(chain(40000, (705, [points, curves, *(number % 2 for number in range(14))])))
    place = 40002 + points * 2 + curves + 1 + 3
    line.held[place], line.held[place + 1], line.held[place + 2] = 1, 0, 99
    with over(folder, line) as node:
        assert node("curveTime", "read") == 99
        assert line.asked[-3:] == [(40004, 1), (40005, 1), (place + 1, 2)]
        node("curveAccess", "write", 0)
    assert line.held[place] == 0


def test_behind_the_end_of_the_block(folder: Path) -> None:
    """A device that counts more than its block has is answered with what is wrong."""
    with over(folder, Registers(chain(40000, (705, [9000, 0, 0, 0])))) as node:
        assert status_of(node, "curveTime", "read") == "behind_end"
