"""Synthetic devices of any size, for speed and growth: every tenth point is of another kind, as in real maps."""

from __future__ import annotations

from pathlib import Path

from support.described import group, head, together, write

POINTS_PER_GROUP = 250

_BUS = """
  framings: [rtu, tcp]
  units: 1..247
  broadcast: 0
  functions:
    03h: {name: read_holding_registers, max: 125}
    06h: write_register
    10h: {name: write_registers, max: 100}"""
_OF_ALL = {
    "title": "{en: A synthetic device, de: Ein erfundenes Gerät}",
    "enums": "{contact: {0: normally_open, 1: normally_closed, 2: disabled}}",
    "formats": '{percent_tenth: {range: 0..1000, scale: value = raw * 0.1, unit: "%"}}',
}

_KINDS = (
    "range: 0..4000, scale: value = raw * 0.1, unit: Hz, default: 50, printed: {{wire: {at:04X}h, resolution: 0.1 Hz}}",
    "format: percent_tenth, default_in_units: 12.5",
    "enum: contact, default: 1",
    "type: u32, range: 0..999999, scale: value = raw * 0.01, unit: s",
    "enum: {{0: stopped, 1: running, 2: tripped}}",
    "range: 0..{limit}.raw, scale: value = raw * 0.1, unit: A",
    "access: r, type: s16, scale: raw = value * 256, unit: °C",
    "flags: {{0: ready, 1: running, 3: {{name: fault, active: 0}}, 5..4: mode}}, access: r",
    "range: 0..255 | 300..400, note: {{en: A register that holds a plain number}}",
    "type: s32, range_in_units: -100..100, scale: value = raw * 0.001, unit: Nm",
)
"""The facts of a point by its last digit."""


def _points(first: int, last: int) -> str:
    """Some of the points, three addresses apart."""
    lines = []
    for index in range(first, last):
        facts = _KINDS[index % len(_KINDS)].format(at=index * 3, limit=f"point_{index - 5}")
        title = f"{{en: Point number {index}, de: Punkt Nummer {index}}}"
        lines.append(f"- {{code: P{index:05}, name: point_{index}, title: {title}, at: {index * 3:04X}h, {facts}}}\n")
    return "".join(lines)


def write_device(folder: Path, count: int) -> Path:
    """A device folder with so many points in its device.yaml, whose path is returned."""
    groups = (
        group(
            _points(first, min(count, first + POINTS_PER_GROUP)),
            group=f"group_{number}",
            title=f"{{en: Group {number}, de: Gruppe {number}}}",
            access="rw",
            numbering="{modicon: wire + 1, reference: 400000 + modicon}",
        )
        for number, first in enumerate(range(0, count, POINTS_PER_GROUP), 1)
    )
    return write(folder, together(head(bus=_BUS, **_OF_ALL), *groups))
