"""What each form of a move does, on a device with a point of each form; the numbers are worked out by hand."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.simulation.bench import Bench
from fieldscribe.simulation.device import SimulatedDevice
from support.described import described, write

POINTS = """\
- {name: speed, at: 1, scale: value = raw / 10, unit: Hz}
- {name: wanted, at: 2, scale: value = raw / 10, unit: Hz}
- {name: delay, at: 3, scale: value = raw / 10, unit: s}
- {name: mode, at: 4, enum: {0: stop, 1: run, 2: jog}}
- {name: state, at: 5, flags: {0: on, 1: {name: fault, active: 0}, 3..2: {name: step, values: {0: a, 1: b, 2: c}}}}
- {name: count, at: 6}
- {name: heat, at: 7, type: f32, unit: °C}
- {name: level, at: 9, type: s16, special: {7FFFh: {name: empty, writable: yes}}}
- {code: X1, name: low, at: 10, bits: 3..0}
- {name: high, at: 10, bits: 7..4}
- {name: factor, at: 11, range: 1..10}
- {name: product, at: 12, scale: value = raw * factor, unit: V}
"""
ZERO = "speed: 0, wanted: 0, delay: 0, mode: stop, state: 2, count: 0, heat: 0, level: 0, low: 0, high: 0, factor: 1"
"""`state` 2: neither `on` nor `fault`, whose bit is 0 while it is true."""

Held = Mapping[str, object]
Step = tuple[Mapping[str, Any], float, Held]
"""What is written, how many seconds pass then, and what is held."""

MOVES: dict[str, list[Step]] = {
    # set
    "speed: set wanted * 2 + 1": [({"wanted": 5}, 0, {"speed": 11}), ({"wanted": 7}, 0, {"speed": 15})],
    "speed: set 5": [({"speed": 9}, 0, {"speed": 5})],
    "mode: set jog while count > 3": [
        ({"count": 3}, 0, {"mode": "stop"}),
        ({"count": 4}, 0, {"mode": "jog"}),
        ({"count": 1}, 9, {"mode": "jog"}),
    ],
    "count: set speed.raw": [({"speed": 2.5}, 0, {"count": 25})],
    "count: set mode": [({"mode": "jog"}, 0, {"count": 2})],
    "count: set 10 ** X1": [({"low": 2}, 0, {"count": 100}), ({"low": 0}, 0, {"count": 1})],
    "count: set 100 / 10 ** low": [({"low": 1}, 0, {"count": 10})],
    "count: set -level - 1": [({"level": -5}, 0, {"count": 4}), ({"level": "empty"}, 0, {"count": 0})],
    "count: set 12 / low": [
        ({"count": 7}, 0, {"count": 7}),
        ({"low": 5}, 0, {"count": 2}),
        ({"low": 8}, 0, {"count": 2}),
    ],
    "count: set heat * 2": [({"heat": 1.25}, 0, {"count": 3})],
    "heat: set wanted / 4": [({"wanted": 0.5}, 0, {"heat": 0.125})],
    "level: set count": [({"count": 40000}, 0, {"level": "empty"}), ({"count": 5}, 0, {"level": 5})],
    "speed: set count * 1000": [({"count": 9}, 0, {"speed": 6553.5})],
    "high: set count": [({"count": 99, "low": 6}, 0, {"high": 15, "low": 6})],
    "product: set 12": [
        ({"factor": 4}, 0, {"product": 12}),
        ({"factor": 5}, 0, {"product": 10}),
    ],
    "speed: set time * 2": [({}, 3, {"speed": 6}), ({}, 0.25, {"speed": 6.5})],
    # flags
    "state.on: set 1 while mode == run": [({"mode": "run"}, 0, {"state": 3}), ({"mode": "stop"}, 0, {"state": 3})],
    "state.fault: set count": [({"count": 1}, 0, {"state": 0}), ({"count": 0}, 0, {"state": 2})],
    "state.step: set c while mode != stop": [({"mode": "run"}, 0, {"state": 10})],
    "state.step: set count": [({"count": 1}, 0, {"state": 6}), ({"count": 9}, 0, {"state": 14})],
    "count: set 1 while state.on == 1": [({"state": 3}, 0, {"count": 1})],
    "count: set 2 while state.fault == 1": [({"state": 2}, 0, {"count": 0}), ({"state": 0}, 0, {"count": 2})],
    "count: set 3 while state.step == b": [({"state": 4}, 0, {"count": 3})],
    "count: set 4 while state.fault == off": [({}, 0, {"count": 4}), ({"state": 0, "count": 0}, 0, {"count": 0})],
    # conditions
    "count: set 5 while mode in (run, jog)": [({}, 0, {"count": 0}), ({"mode": "jog"}, 0, {"count": 5})],
    "count: set 6 while mode == run and wanted >= 2 or low == 3": [
        ({"mode": "run", "wanted": 1.9}, 0, {"count": 0}),
        ({"wanted": 2}, 0, {"count": 6}),
        ({"mode": "stop", "count": 1, "low": 3}, 0, {"count": 6}),
    ],
    "count: set 7 while wanted.raw < 5": [({"wanted": 0.5}, 0, {"count": 7}), ({"count": 0}, 0, {"count": 0})],
    # once
    "count: set count + 1 when mode == run": [
        ({"mode": "run"}, 9, {"count": 1}),
        ({"mode": "stop"}, 0, {"count": 1}),
        ({"mode": "run"}, 0, {"count": 2}),
    ],
    "count: [set 5 when mode == run, set 6 when mode == run]": [({"mode": "run"}, 0, {"count": 5})],
    "count: [set 5 while mode == run, set 6]": [({}, 0, {"count": 6}), ({"mode": "run"}, 0, {"count": 5})],
    # after
    "state.on: set 1 while mode == run after 2 s": [
        ({"mode": "run"}, 1.9, {"state": 2}),
        ({"mode": "stop"}, 5, {"state": 2}),
        ({"mode": "run"}, 1.9, {"state": 2}),
        ({}, 0.1, {"state": 3}),
    ],
    "count: set count + 1 when mode == run after 500 ms": [
        ({"mode": "run"}, 0.4, {"count": 0}),
        ({}, 0.1, {"count": 1}),
    ],
    "count: set 1 while mode == run after delay": [
        ({"delay": 3, "mode": "run"}, 2.9, {"count": 0}),
        ({"delay": 2.9}, 0, {"count": 1}),
    ],
    "count: set 1 while mode == run after 1 min": [({"mode": "run"}, 59.9, {"count": 0}), ({}, 0.1, {"count": 1})],
    "count: set 1 after 1 h": [({}, 3599, {"count": 0}), ({}, 1, {"count": 1})],
    "count: set 1 while time > 3": [({}, 3, {"count": 0}), ({}, 0.1, {"count": 1})],
    # ramp
    "speed: ramp to wanted at 10 Hz/s": [
        ({"wanted": 20}, 1.5, {"speed": 15}),
        ({}, 5, {"speed": 20}),
        ({"wanted": 5}, 1, {"speed": 10}),
        ({"speed": 30}, 1, {"speed": 20}),
    ],
    "speed: ramp to wanted at 10 Hz/s, down at 5 Hz/s": [
        ({"wanted": 20}, 2, {"speed": 20}),
        ({"wanted": 5}, 1, {"speed": 15}),
        ({}, 9, {"speed": 5}),
    ],
    "speed: ramp to 100 at 60 Hz/min while mode == run": [
        ({}, 1, {"speed": 0}),
        ({"mode": "run"}, 3, {"speed": 3}),
        ({"mode": "stop"}, 3, {"speed": 3}),
    ],
    "speed: ramp to 50 at wanted / delay": [
        ({}, 0, {"speed": 50}),
        ({"wanted": 10, "delay": 2, "speed": 0}, 2, {"speed": 10}),
        ({"delay": 0}, 0, {"speed": 50}),
    ],
    "heat: ramp to 20.5 at 1 °C/s": [({}, 2.5, {"heat": 2.5}), ({}, 60, {"heat": 20.5})],
    "{speed: ramp to wanted at 10 Hz/s, wanted: ramp to 8 at 2 Hz/s}": [
        ({}, 3, {"speed": 6, "wanted": 6}),
        ({}, 9, {"speed": 8, "wanted": 8}),
    ],
    "{speed: ramp to 30 at 10 Hz/s, state.on: set 1 while speed > 5, count: set count + 1 when speed >= 20}": [
        ({}, 0.5, {"state": 2, "count": 0}),
        ({}, 0.1, {"state": 3, "count": 0}),
        ({}, 2, {"speed": 26, "count": 1}),
    ],
    # quantities
    "load: set 1 / 3": [({}, 0, {"load": 0.333333333})],
    "load: set -2 / 3": [({}, 0, {"load": -0.666666667})],
    "load: set load * 10 ** 9 when mode != stop": [
        ({"load": 3e11, "mode": "run"}, 0, {"load": 10**20}),
        ({"load": -3e11, "mode": "stop"}, 0, {"load": -3 * 10**11}),
        ({"mode": "jog"}, 0, {"load": -(10**20)}),
    ],
    "{load: ramp to 5 at 1 A/s, current: set load * 2}": [({}, 3, {"load": 3, "current": 6}), ({}, 9, {"current": 10})],
}


def moving(folder: Path, moves: str, **settings: object) -> SimulatedDevice:
    """A device with these moves; its time stands but for `advance`."""
    write(folder, described(POINTS))
    listed = moves.strip("{}").split(", ") if moves.startswith("{") else [moves]
    text = "".join(f"  {move}\n" for move in listed)
    plant = "plant: {load: {unit: A}, current: {start: 4, unit: A}}"
    (folder / "behaviour.yaml").write_text(f"behaviour: made_up\n{plant}\nstart: {{{ZERO}}}\nmoves:\n{text}", "utf-8")
    (line,) = Bench({"lines": [{"devices": [{"device": str(folder), **settings}]}], "time_scale": 0}).lines
    return line.core.devices[0]


@pytest.mark.parametrize("moves", MOVES)
def test_a_move(moves: str, tmp_path: Path) -> None:
    device = moving(tmp_path, moves)
    for number, (written, seconds, held) in enumerate(MOVES[moves]):
        device.values.update(written)
        device.clock.advance(seconds)
        assert {name: device.values[name] for name in held} == held, number


def test_a_restart_begins_what_moves_anew(tmp_path: Path) -> None:
    device = moving(tmp_path, "{speed: ramp to wanted at 10 Hz/s, load: set 3 when mode == run}")
    device.values.update({"wanted": 20, "mode": "run", "count": 9})
    device.clock.advance(1)
    assert (device.values["speed"], device.values["load"]) == (10, 3)
    device.restart()
    names = ("speed", "load", "current", "wanted", "count", "mode")
    assert {name: device.values[name] for name in names} == {
        "speed": 0, "load": 3, "current": 4, "wanted": 20, "count": 9, "mode": "run"
    }  # fmt: skip
    device.clock.advance(0.5)
    assert device.values["speed"] == 5


def test_a_still_device_has_no_quantities(tmp_path: Path) -> None:
    device = moving(tmp_path, "speed: set 5", behaviour=False)
    assert (device.values["mode"], "load" in device.values) == ("stop", False)
    with pytest.raises(KeyError, match="load"):
        device.values["load"] = 1
