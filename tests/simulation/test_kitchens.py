"""Devices that nobody makes, and that use every mechanism: each point is what the simulated device holds."""

from __future__ import annotations

from typing import Any

import pytest
from fieldscribe.live.connection import device_class
from fieldscribe.simulation import simulated
from fieldscribe.simulation.bench import layout_of
from fieldscribe.simulation.device import Clock, SimulatedDevice
from fieldscribe_runtime.transports.tcp import TcpLine
from support.described import loaded
from support.places import TESTS
from support.simulated_lines import DirectBus, direct_line

BLOCKS = TESTS / "devices/kitchen_blocks"


@pytest.mark.parametrize(("name", "least"), [("kitchen_uss", 25), ("kitchen_can", 70)])
def test_every_point(name: str, least: int) -> None:
    """Swapped and coded words, bit groups, texts, pages of signals; what is written back is taken."""
    from fieldscribe_runtime.uss import Link

    layout = layout_of(str(TESTS / "devices" / name))
    device = SimulatedDevice(layout, 5, clock=Clock(0), seed=2)
    uss = layout.device.family == "uss"
    made: Any = device_class(layout.device)
    line = (direct_line(device), 5, Link(127, 4)) if uss else (DirectBus(device), 5)
    client = made(*line, **layout.variants)
    seen = 0
    selectors = {each for point in layout.points.values() for each in (point.when.names if point.when else ())}
    for point in layout.points.values():
        if not (point.generated and point.addresses) or point.name in selectors:
            continue
        handle = getattr(client, point.name)
        if point.readable and point.text is None:
            assert handle.read_raw() == device.memory.raw(point.name), point.name
            seen += 1
        elif point.readable:
            assert handle.read() == device.values[point.name], point.name
            seen += 1
        if point.writable and point.space == "parameter" and point.text is None:
            raw = device.memory.raw(point.name)
            handle.write_raw(raw)
            assert device.memory.raw(point.name) == raw
            seen += 1
    assert seen > least


@pytest.mark.parametrize("counts", [(0, 0), (1, 0), (3, 2), (40, 2), (0, 1)])
def test_what_lies_after_counted_elements_moves_with_the_count(counts: tuple[int, int]) -> None:
    """The places and the length of the block are those of the counts as they are; what it held it holds."""
    made: Any = device_class(loaded(BLOCKS / "device.yaml"))
    with simulated(BLOCKS, framing="tcp", strict=True) as device, TcpLine("127.0.0.1", device.port) as line:
        device.values.update({"curve_time": 4711, "curve_access": "closed", "level": 12.5})
        for points in (counts[0], counts[0] + 1):
            device.values.update({"curve_points": points, "curve_count": counts[1]})
            client = made(line, 1, slot=1, half=0)
            assert client.find_blocks()[705] == (40024, 2 * points + counts[1] + 6)
            counted = range(40028, 40028 + 2 * points + counts[1])
            assert device.device.read(("holding", 0), counted) == [0] * len(counted)
            assert (client.curve_time.read(), client.curve_access.read(), client.level.read()) == (4711, 1, 12.5)
            client.curve_time.write(99)
            assert device.values["curve_time"] == 99
            client.curve_time.write(4711)


def test_counts_for_which_there_are_no_addresses_move_nothing() -> None:
    made: Any = device_class(loaded(BLOCKS / "device.yaml"))
    with simulated(BLOCKS, framing="tcp") as device, TcpLine("127.0.0.1", device.port) as line:
        device.values["curve_points"] = 65535
        assert made(line, 1).curve_points.read() == 65535
