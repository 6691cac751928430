"""Hints lead out: what a hint says to write passes, and leads into no other finding."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import pytest
from fieldscribe.diagnostics import Report
from fieldscribe.pipeline import load_device

if TYPE_CHECKING:
    from pathlib import Path

    from fieldscribe.diagnostics import Diagnostic

HEAD = """\
fieldscribe: 1
device: made_up
version: 1.0.0
vendor: Maker
model: M1
title: Test device
family: modbus
documents: {manual: {title: Manual, language: en}}
bus:
  framings: [rtu]
  units: 1..247
  functions: {01h: read_coils, 03h: read, 05h: write_coil, 06h: write, 10h: write_many}
groups:
- group: main
  space: holding
  source: {document: manual, section: "1"}
  points:
  - {name: mode, at: 900, range: 0..5}
"""
_LINE = re.compile(r"`(([a-z_]+): .*?)`(?= |$|,|;|:)")

WRITTEN = [
    ("scale: 0.1", "scale: value = raw * 0.1"),
    ("scale: 10", "scale: value = raw * 10"),
    ("scale: 0.0000152588", "scale: value = raw / 65536"),
    ("scale: x 0.1", "scale: value = raw * 0.1"),
    ('scale: "0,1"', "scale: value = raw * 0.1"),
    ("scale: raw/10", "scale: value = raw/10"),
    ('scale: "*10"', "scale: value = raw * 10"),
    ("scale: 1/10", "scale: value = raw / 10"),
    ('scale: "1:10"', "scale: value = raw / 10"),
    ("scale: 0.1 V", "scale: value = raw * 0.1"),
    ("scale: 10^-1", "scale: value = raw * 10 ** -1"),
    ("scale: y = 0.1 * x", "scale: value = 0.1 * raw"),
    ("scale: value = raw x 0.1", "scale: value = raw * 0.1"),
    ("scale: value == raw * 0.1", "scale: value = raw * 0.1"),
    ("scale: {factor: 0.1}", "scale: value = raw * 0.1"),
    ("range: 0-100", "range: 0..100"),
    ("range: 0 to 100", "range: 0..100"),
    ("range: 0...100", "range: 0..100"),
    ("range: {min: 0, max: 100}", "range: 0..100"),
    ("range_in_units: 0.0-50.0", "range_in_units: 0.0..50.0"),
    ("access: ro", "access: r"),
    ("access: R/W", "access: rw"),
    ("access: read-only", "access: r"),
    ("type: int16", "type: s16"),
    ("type: INT32", "type: s32"),
    ("type: float", "type: f32"),
    ("type: real", "type: f32"),
    ("type: double", "type: f64"),
    ("type: uint16", "type: u16"),
    ("type: word", "type: u16"),
    ("type: DWORD", "type: u32"),
    ("type: bool", "type: bit"),
    ("type: U16", "type: u16"),
    ("type: uint32_be", "type: u32"),
    ("keeps: true", "keeps: yes"),
    ("words: little endian, type: u32", "words: low first"),
    ("changes: constant", "changes: never"),
    ("steps: 10", "steps: {0: 10}"),
    ("bits: 15:8", "bits: 15..8"),
    ("bits: [8, 15]", "bits: 15..8"),
    ("bits: b3", "bits: 3"),
    ("enum: [Off, On line]", "enum: {0: off, 1: on_line}"),
    ('enum: "0=off, 1=on"', "enum: {0: off, 1: on}"),
    ("flags: [ready, fault]", "flags: {0: ready, 1: fault}"),
    ("section: 4.2", 'section: "4.2"'),
    ("when: mode in (0, 1)", 'when: "mode in (0, 1)"'),
    ("range: 0, 1, 2", 'range: "0, 1, 2"'),
    ("title: Speed, actual value", 'title: "Speed, actual value"'),
]

COUNTS = [
    "type: u32, decimals: 12, scale: value = raw * 0.1",
    "type: u32, decimals: 0, scale: value = raw * 0.1",
    "decimals: 1, scale: value = raw * 0.01",
    "type: s32, decimals: 12, scale: value = raw * 0.01",
    "type: u32, scale: value = raw * 0.0000152588",
    "type: s32, scale: value = raw * 0.000000011920929",
    "type: u32, scale: value = raw * 0.00001525878906",
    "type: u32, scale: value = raw * 0.0000000001",
    "type: u32, decimals: 3, scale: value = raw * 0.0000000001",
    "type: u32, decimals: 12, scale: value = raw * 0.0000000001",
    "scale: value = raw * 0.0000000000000001",
    "decimals: 0.01, scale: value = raw * 0.01",
]
"""Points whose counts do not fit, or whose decimals are wrong."""


def findings(folder: Path, facts: str, *, number: int = 1) -> tuple[Diagnostic, ...]:
    """What is found of a point with these facts."""
    space = ", space: coil" if "type: bit" in facts or "type: bool" in facts else ""
    file = folder / "device.yaml"
    file.write_text(f"{HEAD}  - {{name: made, at: {number}{space}, {facts}}}\n", "utf-8")
    report = Report()
    load_device(file, report)
    return report.findings


def told(hint: str) -> str:
    """The whole line that a hint shows; the first where it shows a choice."""
    found = _LINE.search(hint)
    if found is not None:
        return found[1]
    quoted = re.fullmatch(r'quote it: (".*")', hint)
    return "" if quoted is None else f"section: {quoted[1]}"


@pytest.mark.parametrize(("wrong", "right"), WRITTEN)
def test_the_line_that_a_hint_shows_works(tmp_path: Path, wrong: str, right: str) -> None:
    (first, *_) = (one for one in findings(tmp_path, wrong) if one.severity == "error")
    assert told(first.hint or "") == right
    key = right.partition(":")[0]
    rest = wrong.split(f"{key}: ", 1)[1].rpartition(", type: ")
    others = f", type: {rest[2]}" if rest[1] else ""
    assert not findings(tmp_path, right + others)


def applied(facts: str, hint: str) -> str:
    """The facts with what the hint says instead of what they said of that key."""
    line = told(hint)
    key = line.partition(":")[0]
    parts = re.split(r", (?=[a-z_]+: )", facts)
    return ", ".join([*(one for one in parts if not one.startswith(f"{key}: ")), line])


@pytest.mark.parametrize("facts", COUNTS)
def test_hints_about_decimals_lead_out(tmp_path: Path, facts: str) -> None:
    """Each hint is applied once; then nothing is wrong. A circle of hints would come back here."""
    found = [one for one in findings(tmp_path, facts) if one.severity == "error"]
    for one in found:
        assert told(one.hint or ""), one.hint
    if found:
        assert not findings(tmp_path, applied(facts, found[0].hint or ""))


@pytest.mark.parametrize(
    ("facts", "line"),
    [
        ("scale: value = raw * 0.0000152588", "value = raw / 65536"),
        ("scale: value = raw * 0.00610352", "value = raw * 100 / 16384"),
        ("scale: raw = value / 0.33333", "raw = value * 3"),
    ],
)
def test_a_cut_decimal_is_a_warning_that_can_be_followed(tmp_path: Path, facts: str, line: str) -> None:
    (only,) = findings(tmp_path, facts)
    assert (only.severity, only.rule) == ("warning", "cut-decimal")
    assert only.hint == f"write `{line}` to keep it exact"
    assert not findings(tmp_path, f"scale: {line}")


@pytest.mark.parametrize(
    ("facts", "rule", "hint"),
    [
        ("range: [0, 100]", "two-meanings", "`0..100` for all between them, `0 | 100` for these two alone"),
        ("enum: {off: 0, on: 1}", "unknown-key", "the number stands first: `0: off`"),
        ("flags: {ready: 0}", "unknown-key", "the number stands first: `0: ready`"),
        ("type: int48", "wrong-choice", "`type: ~` documents the point"),
        ("unit: mw", "unknown-unit", "`mW` (milliwatt) or `MW` (megawatt)"),
        ("unit: furlong", "unknown-unit", "`fieldscribe units` lists what is known"),
        ("keeps: choice", "wrong-choice", "write `keeps: yes`, `keeps: no`, or the command that stores"),
        ("type", "yaml-comma", "give it a value: `type: …`"),
        ("type: BYTE", "wrong-choice", "write `type: u8` with the `bits: 7..0`"),
        ("type: string", "wrong-choice", "write `type: text` with `characters: …`"),
        ("type: bool", "wrong-choice", "one bit of a word is `bits: 0`"),
    ],
)
def test_hints_name_what_is_meant(tmp_path: Path, facts: str, rule: str, hint: str) -> None:
    found = [one for one in findings(tmp_path, facts) if one.rule == rule]
    assert hint in (found[0].hint or "")


def test_a_number_for_people_is_no_address(tmp_path: Path) -> None:
    file = tmp_path / "device.yaml"
    file.write_text(f"{HEAD}  - {{name: made, at: 4x0010}}\n", "utf-8")
    report = Report()
    load_device(file, report)
    assert "on the wire it is 9, in the space `holding`" in (report.findings[0].hint or "")


@pytest.mark.parametrize(
    "facts",
    [
        "flags: {0Fh: last, 0x0: first, H'3..02h: middle}",
        "fixed: {0Ah: 1, 3h..0: 0}, bits: 15",
        "enum: {FFh: off, 0x10: on, 0b11: third}",
        "special: {FFFFh: broken}",
        "steps: {0Ah: 10}",
    ],
)
def test_numbers_as_keys_are_taken_as_manuals_write_them(tmp_path: Path, facts: str) -> None:
    assert not findings(tmp_path, facts)


def test_the_two_notations_of_a_key_are_one_number(tmp_path: Path) -> None:
    (only,) = findings(tmp_path, "flags: {10: ten, 0Ah: also_ten}")
    assert "bit 10 is taken twice" in only.message
