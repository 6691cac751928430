"""What each form of a move does, on a device with a point of each form; the numbers are worked out by hand."""

from __future__ import annotations

import json
import shutil
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.simulation.bench import Bench
from fieldscribe.simulation.device import SimulatedDevice

DEVICE = Path(__file__).parent / "moving"
ZERO = "speed: 0, wanted: 0, delay: 0, mode: stop, state: 2, count: 0, heat: 0, level: 0, low: 0, high: 0, factor: 1"
"""`state` 2: neither `on` nor `fault`, whose bit is 0 while it is true."""

Held = Mapping[str, object]
Step = tuple[Mapping[str, Any], float, Held]
"""What is written, how many seconds pass then, and what is held."""

MOVES: dict[str, list[Step]] = json.loads(Path(__file__).with_name("moves.json").read_text("utf-8"))
"""The moves, several in braces, with their steps."""


def moving(folder: Path, moves: str, **settings: object) -> SimulatedDevice:
    """A device with these moves; its time stands but for `advance`."""
    shutil.copy(DEVICE / "device.yaml", folder)
    listed = moves.strip("{}").split(", ") if moves.startswith("{") else [moves]
    text = "".join(f"  {move}\n" for move in listed)
    plant = "plant: {load: {unit: A}, current: {start: 4, unit: A}}"
    (folder / "behaviour.yaml").write_text(f"behaviour: moving\n{plant}\nstart: {{{ZERO}}}\nmoves:\n{text}", "utf-8")
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
