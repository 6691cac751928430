"""Every key that takes a whole number takes it in every notation of manuals, and means the same by it."""

from __future__ import annotations

import re
from decimal import Decimal
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.diagnostics import Report
from fieldscribe.language.load import load
from fieldscribe.language.nodes import SourceFile
from fieldscribe.model import Device
from support.described import DEVICES, compile_in, described, loaded
from support.descriptions_as_values import as_texts, rewrite
from support.places import ROOT
from support.quick import full_but

REAL = ROOT / "descriptions"
AS_WRITTEN = {"page", "serial", "timing", "errata", "values"}
"""What is repeated as it stands in the description."""
FOLDERS = [*sorted(DEVICES.iterdir()), pytest.param(REAL / "siemens_mm4", marks=pytest.mark.full)]

BUS = "{framings: [rtu], units: 1..32, functions: {03h: {name: read, max: 16}, 06h: write, 10h: write_many}}"


def noted(value: Any, notation: str) -> Any:
    """The same value with each whole number in that notation."""
    if isinstance(value, dict):
        return {key: noted(one, "" if key in AS_WRITTEN else notation) for key, one in value.items()}
    if isinstance(value, list):
        return [noted(one, notation) for one in value]
    if isinstance(value, Decimal):
        return float(value)
    return notation.format(value) if notation and type(value) is int and value >= 0 else value


@cache
def as_it_stands(folder: Path) -> Device:
    return loaded(folder / "device.yaml")


@pytest.mark.parametrize(
    "notation", full_but(("H'{:X}", "{}"), ("0x{:x}", "0{:X}h", "H'{:X}", "0b{:b}", "{}"), seconds=0.2)
)
@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.name)
def test_all_numbers_in_one_notation_are_the_same_device(folder: Path, notation: str, tmp_path: Path) -> None:
    """As texts in quotes, so that YAML leaves them alone."""
    files = {}
    for path in sorted(folder.glob("*.yaml")):
        files[path.name] = noted(load(SourceFile(path.name, path.read_text("utf-8")), Report()), notation)
    rewrite(tmp_path / "device", as_texts(files))
    assert loaded(tmp_path / "device" / "device.yaml") == as_it_stands(folder)


SWITCH = re.compile(r"\b(reserved|open|broadcast|keeps|no_value|writable): (yes|no)\b")


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.name)
def test_true_and_false_are_yes_and_no(folder: Path, tmp_path: Path) -> None:
    """At every key that is true or false."""
    words = {"yes": "true", "no": "false"}
    for path in sorted(folder.glob("*.yaml")):
        text = SWITCH.sub(lambda said: f"{said[1]}: {words[said[2]]}", path.read_text("utf-8"))
        (tmp_path / path.name).write_text(text, "utf-8")
    assert loaded(tmp_path / "device.yaml") == as_it_stands(folder)


@pytest.mark.parametrize(
    ("facts", "message"),
    [
        ("type: text, characters: 0h", "0 is out of bounds: at least 1"),
        ("digits: {count: 0Ah, enum: {0: a}}", "10 is out of bounds: 1 to 5"),
        ("flags: {0: {name: a, active: 2h}}", "2 is none of 0, 1"),
        ("untyped: wide, length: FFh", "255 is out of bounds: 1 to 125"),
        ("untyped: wide, length: some", "expected a whole number, found the text `some`"),
        ("line: 0b", "expected a whole number, found the text `0b`"),
        ("lines: {range: 20h..10h}", "lines `20h..10h` run downwards"),
    ],
)
def test_bounds_hold_in_every_notation(facts: str, message: str, tmp_path: Path) -> None:
    device, findings = compile_in(tmp_path, described(f"- {{name: a, at: 1, {facts}}}\n", bus=BUS))
    assert device is None
    assert [one.message for one in findings] == [message]
