"""A description of four points, and how a command ended, for tests of the command line."""

from __future__ import annotations

from typing import NamedTuple

from support.described import group, head

DEVICE = head(
    device="small_drive",
    vendor="Acme",
    model="S1",
    title="{en: Small drive}",
    bus="{framings: [rtu], units: 1..32, functions: {03h: {name: read_registers, max: 16}, 06h: write_register}}",
    variants="{size: {title: {en: Size}, values: {small: {title: {en: Small}}, large: {title: {en: Large}}}}}",
    parts="[main.yaml]",
)
POINTS = """\
- {code: P1, name: speed, title: {en: "TITLE"}, at: 10h, range: 0..4000, scale: value = raw * 0.1, unit: Hz}
- {code: P2, name: ratio, title: {en: Ratio}, at: 12h, range: 1..500}
- {code: P3, name: voltage, title: {en: Voltage}, at: 14h, range: 0..1000, scale: raw = value * ratio / 400, unit: V}
- {code: P4, name: state, title: {en: State}, at: 16h, access: r, enum: {0: stop, 1: run}}
"""
MAIN = group(POINTS, title="{en: Main}", access="rw", numbering="{modicon: wire + 1}")
SPEED_50 = "01 06 00 10 01 F4 88 18"
"""A frame that writes 50 Hz to P1."""


class Output(NamedTuple):
    """The exit code of a command, and what it printed."""

    code: int
    out: str
    err: str
