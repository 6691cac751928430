"""Counts how often a fact of one point changes rooms on its way from YAML to the rendered C header.

.venv/bin/python tests/bench/rooms_crossed.py [--calls]

The device has one point, as A020 (`base_frequency`) of the L200 is described. Its address and the number in its scale
occur nowhere else. The compiler runs under `sys.setprofile` until the header is rendered. A call belongs to the way of
a fact if the number is in one of its arguments or in its result: as an integer, a fraction or a text, or in a value of
at most FIELDS parts (a tuple, list or record). Larger objects carry many facts and are not followed.

A room is the first folder below `fieldscribe/`; the modules that lie directly in `fieldscribe/` are one room together.
The script prints the rooms in the order of the calls, equal neighbours once, and the number of changes; `--calls` also
prints every call.
"""

from __future__ import annotations

import sys
import tempfile
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from types import FrameType
from typing import Any

import fieldscribe
from fieldscribe import pipeline
from fieldscribe.diagnostics import Report

HOUSE = Path(fieldscribe.__file__).parent
MOST = {"scale": 25, "address": 10}  # the scale first: the run for the address then finds its formula in a cache
FIELDS = 4
NUMBERS = {"address": 23131, "scale": 7919}
TEXTS = {"address": ("5A5Bh", "0x5A5B", "23131"), "scale": ("7919",)}
DEVICE = """fieldscribe: 1
device: hitachi_l200
version: 1.0.0
vendor: Hitachi
model: L200
title: {en: Frequency inverter}
family: modbus
documents: {manual: {title: ModBus, language: de}}
parts: [standard_a.yaml]
bus:
  framings: [rtu]
  units: 1..32
  functions:
    03h: {name: read_holding_registers, max: 4}
    06h: {name: write_register, max: 1}
"""
GROUP = """group: standard_a
title: {en: Standard functions}
space: holding
access: rw
source: {document: manual, section: Gruppe A}
numbering: {modicon: wire + 1}
points:
- code: A020
  name: base_frequency
  title: {en: Base frequency, de: Basisfrequenz}
  at: 5A5Bh
  range: 0..4000
  scale: value = raw * 0.7919
  unit: Hz
"""


def write_device(folder: Path) -> Path:
    """Write the device and return its `device.yaml`."""
    device_file = folder / "device.yaml"
    device_file.write_text(DEVICE, "utf-8")
    (folder / "standard_a.yaml").write_text(GROUP, "utf-8")
    return device_file


class Tracer:
    """Collects the calls that belong to the way of one fact."""

    def __init__(self, fact: str) -> None:
        self.number, self.texts = NUMBERS[fact], TEXTS[fact]
        self.calls: list[tuple[str, str]] = []

    def __call__(self, frame: FrameType, event: str, result: object) -> None:
        """Note a call or return that passes the fact on; `sys.setprofile` calls this."""
        code = frame.f_code
        if event not in ("call", "return") or not code.co_filename.startswith(f"{HOUSE}/"):
            return
        module = Path(code.co_filename).relative_to(HOUSE)
        room = module.parts[0] if len(module.parts) > 1 else "fieldscribe"
        arguments = code.co_varnames[: code.co_argcount + code.co_kwonlyargcount]
        values = [result] if event == "return" else [frame.f_locals.get(name) for name in arguments]
        if any(map(self.carries, values)):
            self.calls.append((room, f"{module}:{code.co_name}"))

    def carries(self, value: Any) -> bool:
        """Return True if the value is the fact, or a small value that holds it."""
        if isinstance(value, str):
            return any(text in value for text in self.texts)
        if isinstance(value, int | Fraction):
            return self.number in (value.numerator, value.denominator)
        if isinstance(value, float | Decimal):
            return self.texts[-1] in str(value)
        return any(map(self.carries, parts_of(value)))

    @property
    def rooms(self) -> list[str]:
        """The rooms in order, neighbours joined."""
        rooms = [room for room, _ in self.calls]
        return [room for room, before in zip(rooms, [None, *rooms], strict=False) if room != before]


def parts_of(value: Any) -> list[Any]:
    """Return the parts of a small tuple, list or record; nothing for all other values."""
    if isinstance(value, tuple | list):
        parts = list(value)
    elif type(value).__module__.startswith("fieldscribe.") and not callable(value) and not isinstance(value, dict):
        slots = [name for kind in type(value).__mro__ for name in getattr(kind, "__slots__", ())]
        parts = [getattr(value, name, None) for name in (*slots, *getattr(value, "__dict__", ()))]
    else:
        parts = []
    return parts if len(parts) <= FIELDS else []


def way_of(fact: str) -> Tracer:
    """Compile the device to its C header and return the calls that pass the fact on."""
    tracer, report = Tracer(fact), Report()
    with tempfile.TemporaryDirectory() as folder:
        device_file = write_device(Path(folder))
        sys.setprofile(tracer)
        models = pipeline.load_models(device_file, report)
        if models is not None:
            next(pipeline.outputs(models.whole, ["c"], models.plain))
        sys.setprofile(None)
    assert models is not None, report.findings
    return tracer


def main() -> None:
    """Print the way of both facts."""
    for fact, most in MOST.items():
        way = way_of(fact)
        print(f"{fact}: {len(way.rooms) - 1} changes of room (at most {most}): {' > '.join(way.rooms)}")
        if "--calls" in sys.argv:
            previous = None
            for call in way.calls:
                if call != previous:
                    print("   ", *call)
                previous = call


if __name__ == "__main__":
    main()
