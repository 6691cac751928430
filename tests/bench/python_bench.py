"""Measures generated Python beside cantools, both in one process and turn by turn: medians, and their ratio.

.venv/bin/python tests/bench/python_bench.py [rounds]
"""

from __future__ import annotations

import importlib
import os
import random
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cantools.database
from fieldscribe.diagnostics import Report
from fieldscribe.families.can.dbc import export
from fieldscribe.model import Device
from fieldscribe.pipeline import load_device
from fieldscribe.resources import descriptions_dir, render, templates_dir
from fieldscribe.targets import python as target
from synthetic import write_frame_device

_SPAN = 0.01
"""So many seconds of each are measured in one go."""
_DBC = 'VERSION ""\nNS_ :\nBS_:\nBU_: unit\nBO_ 1 frame: 8 unit\n'


@dataclass(frozen=True)
class Work:
    """The same work done by generated code and by cantools, and the most that it may cost in cantools' time."""

    what: str
    ours: Callable[[], object]
    theirs: Callable[[], object]
    mark: float


def print_python(rounds: int) -> None:
    """The table."""
    print(f"\n{'Python beside cantools':<44} {'ours':>12} {'cantools':>12} {'ratio':>7} {'mark':>6}")
    with tempfile.TemporaryDirectory() as folder:
        scratch = Path(folder)
        shipped = [descriptions_dir() / name for name in ("hitachi_l200", "woodward_mpu2s")]
        devices = [_written(one / "device.yaml", scratch) for one in (*shipped, write_frame_device(scratch))]
        sys.path.insert(0, str(scratch / "python"))
        for work in (*_point(), *_four_points(), *_telegram(devices[1])):
            rows = [(_timed(work.ours), _timed(work.theirs)) for _ in range(rounds + 1)]
            _row(work.what, "ns", 1e9, rows, work.mark)
        for name in ("hitachi_l200", "woodward_mpu2s"):
            rows = [_imported(scratch / "python", name) for _ in range(rounds + 1)]
            _row(f"import {name}", "ms", 1e3, rows, 0.5)


def _row(what: str, unit: str, scale: float, rows: list[tuple[float, float]], mark: float) -> None:
    """Medians of all rounds but the first, which warms up."""
    ours, theirs, ratio = (
        statistics.median(numbers) for numbers in zip(*[(*row, row[0] / row[1]) for row in rows[1:]], strict=True)
    )
    print(f"{what:<44} {ours * scale:9,.1f} {unit} {theirs * scale:9,.1f} {unit} {ratio:7.2f} {mark:6}")


def _written(description: Path, folder: Path) -> Device:
    """A device, whose package is written."""
    device = load_device(description, Report())
    assert device is not None
    copies = {path: (templates_dir() / source).read_text("utf-8") for path, source in target.runtime(device)}
    for path, text in {**dict(target.outputs(device, render)), **copies}.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(text, encoding="utf-8")
    return device


def _timed(function: Callable[[], object]) -> float:
    """Seconds of the processor for one call, out of many."""
    calls, took = 1, 0.0
    while took < _SPAN:
        calls *= 2
        start = time.process_time()
        for _ in range(calls):
            function()
        took = time.process_time() - start
    return took / calls


def _imported(folder: Path, name: str) -> tuple[float, float]:
    """Seconds that importing a package and cantools cost beside starting Python."""
    ours, theirs, nothing = (_started(folder, f"import {one}") for one in (name, "cantools", "sys"))
    return ours - nothing, theirs - nothing


def _started(folder: Path, program: str) -> float:
    """Seconds for a fresh process, with byte code from the time before."""
    environment = {**os.environ, "PYTHONDONTWRITEBYTECODE": ""}
    start = time.perf_counter()
    subprocess.run([sys.executable, "-c", program], cwd=folder, env=environment, check=True)
    return time.perf_counter() - start


def _message(*signals: str) -> Any:
    """A message of a database with these signals of 16 bits, one behind the other, high byte first."""
    parts = [signal.split(" ", 1) for signal in signals]
    lines = [f" SG_ {name} : {16 * at + 7}|16@0{rest} unit\n" for at, (name, rest) in enumerate(parts)]
    return _loaded(_DBC + "".join(lines), "frame")


def _loaded(text: str, message: str) -> Any:
    """A message of a database."""
    database: Any = cantools.database.load_string(text, "dbc")
    return database.get_message_by_name(message)


def _point() -> Iterator[Work]:
    """One point as programs name it, and a message of one signal."""
    device = importlib.import_module("hitachi_l200").HitachiL200
    message = _message('base_frequency + (0.1,0) [0|400] "Hz"')
    values = {"base_frequency": 50.0}
    data = message.encode(values)
    assert message.decode(data) == {"base_frequency": device.base_frequency.decode(500)} == values
    assert data[:2] == device.base_frequency.encode(50.0).to_bytes(2, "big")
    yield Work("one point, decode", lambda: device.base_frequency.decode(500), lambda: message.decode(data), 0.25)
    yield Work("one point, encode", lambda: device.base_frequency.encode(50.0), lambda: message.encode(values), 0.2)


def _four_points() -> Iterator[Work]:
    """Four scaled points of a frame, from bytes to values by name and back."""
    [layout] = importlib.import_module("four_points").FourPoints.layouts("status")
    hertz, volt = '- (0.00390625,0) [-128|127.99609375] "Hz"', '+ (0.02,0) [0|1310.7] "V"'
    message = _message(f"out_freq {hertz}", f"out_volt {volt}", f"set_freq {hertz}", f"link_volt {volt}")
    values = {"out_freq": 50.0, "out_volt": 230.0, "set_freq": -12.5, "link_volt": 540.0}
    data = layout.encode(values)
    assert (message.encode(values), message.decode(data), layout.decode(data)) == (data, values, values)
    yield Work("four points of a frame, decode", lambda: layout.decode(data), lambda: message.decode(data), 0.33)
    yield Work("four points of a frame, encode", lambda: layout.encode(values), lambda: message.encode(values), 0.25)


def _telegram(device: Device) -> Iterator[Work]:
    """A frame of three currents, and all frames of its telegram, beside the database that `export dbc` writes."""
    runtime = importlib.import_module("fieldscribe_runtime.can")
    message = _loaded(export(device, 1).decode("latin-1"), "unit_1_messages")
    draw = random.Random(1)
    frames = [runtime.Frame(801, bytes((0xDD, slot, *draw.randbytes(6)))) for slot in range(23)]
    for slot in (1, 10, 14):  # exponents that the scales of others need
        frames[slot] = runtime.Frame(801, bytes((0xDD, slot, 2, 1, 0, 3, 0, 5)))
    decoder = runtime.Decoder(importlib.import_module("woodward_mpu2s").WoodwardMpu2s, "visualisation", unit=1)
    whole: dict[str, object] = {}
    for frame in (*frames, *frames):
        whole |= decoder.decode(frame)
    currents = frames[7]
    assert (len(whole), len(decoder.decode(currents)), len(message.decode(currents.data))) == (51, 3, 5)

    def ours() -> None:
        for frame in frames:
            decoder.decode(frame)

    def theirs() -> None:
        for frame in frames:
            message.decode(frame.data)

    yield Work("MPU2-S, a frame", lambda: decoder.decode(currents), lambda: message.decode(currents.data), 0.5)
    yield Work("MPU2-S, telegram of 23 frames", ours, theirs, 0.5)


if __name__ == "__main__":
    print_python(int(sys.argv[1]) if len(sys.argv) > 1 else 15)
