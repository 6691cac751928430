"""Devices that nobody makes, and that use every mechanism: each point is what the simulated device holds."""

from __future__ import annotations

from typing import Any

import pytest
from fieldscribe.live.devices import device_class
from fieldscribe.simulation.bench import layout_of
from fieldscribe.simulation.device import Clock, SimulatedDevice
from support.places import TESTS
from support.simulated_lines import DirectBus, direct_line


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
