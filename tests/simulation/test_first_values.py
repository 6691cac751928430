"""What simulated devices hold at the start: numbers in range, no special codes, and the same for all of a kind."""

from __future__ import annotations

import pytest
from fieldscribe.arithmetic import codec
from fieldscribe.arithmetic.codec import CodecError
from fieldscribe.model import Point
from fieldscribe.simulation.bench import layout_of
from fieldscribe.simulation.memory import Memory
from support.described import DEVICES as MADE
from support.places import ROOT
from support.quick import full_but

SHIPPED = sorted(path.parent for path in (ROOT / "descriptions").glob("*/device.yaml"))
FOR_TESTS = sorted(path.parent for path in MADE.glob("*/device.yaml"))


def refused(memory: Memory, point: Point) -> bool:
    try:
        codec.check(point, memory.raw(point.name), memory.settings)
    except CodecError:
        return True
    return False


@pytest.mark.parametrize("folder", full_but(FOR_TESTS[:2], (*SHIPPED, *FOR_TESTS)), ids=lambda folder: folder.name)
def test_every_point_starts_in_range(folder: object) -> None:
    layout = layout_of(str(folder))
    for seed in (0, 7):
        memory = Memory.started(layout, seed)
        existing = [point for point in layout.points.values() if memory.exists(point) and point.text is None]
        assert [point.name for point in existing if refused(memory, point)] == []
        defaults = [point for point in existing if point.default_raw is not None and point.view_of is None]
        assert [point.name for point in defaults if memory.raw(point.name) != point.default_raw] == []
        named = [point for point in existing if point.enum is not None]
        known = {point.name: {entry.raw for entry in point.enum.entries} for point in named if point.enum is not None}
        assert [point.name for point in named if memory.raw(point.name) not in known[point.name]] == []


def test_the_seed_chooses_what_no_manual_gives() -> None:
    layout = layout_of("eastron_sdm630")
    first, again, other = (Memory.started(layout, seed).areas for seed in (0, 0, 7))
    assert first == again != other
    first["input", 0][0] ^= 1
    assert again == Memory.started(layout).areas
