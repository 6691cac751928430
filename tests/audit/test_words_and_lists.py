"""Bits, numbers and titles in the lists of a manual: each changed one is a finding, the text itself has none."""

from __future__ import annotations

from pathlib import Path

import pytest
from fieldscribe.audit import Citations, audit
from fieldscribe.diagnostics import Report
from fieldscribe.pipeline import load_analysis
from support.described import group, head, together, write

LINES = """4.1 Inputs

ID\t77
Range\t11 + 10 + 9 + 8
Range\tBit 11 = 0 => Input 1 closed
\tBit 11 = 1 => Input 1 open
\tBit 10 = 0 => Input 2 closed
\tBit 10 = 1 => Input 2 open
\tBit 9 = 0 => Input 3 closed
\tBit 9 = 1 => Input 3 open
\tBit 8 = 0 => Input 4 closed
\tBit 8 = 1 => Input 4 open
"""
INPUTS = ", ".join(
    f"{bit}: {{name: input_{12 - bit}, title: {{en: Input {12 - bit}}}, zero: {{en: closed}}, one: {{en: open}}}}"
    for bit in (11, 10, 9, 8)
)
INPUT_LINES = f'- {{name: inputs, at: 77, bits: 11..8, flags: {{{INPUTS}}}, section: "4.1", line: 1}}\n'

PAIRS = """4.1 Pairs

77\tBit 3 + 2 Pump Bit 1 + 0 Gate
"""
PAIRS_OF_BITS = (
    "- {name: pairs, at: 77, flags: {3..2: {name: pump, title: {en: Pump}}, 1..0: {name: gate, title: {en: Gate}}},"
    " line: 3}\n"
)


def found(folder: Path, points: str, text: str) -> list[str]:
    """The facts that are missing and the numbers that no fact uses."""
    documents = "{manual: {title: Manual, language: en, writes: {bits: [Bit]}}}"
    subject = load_analysis(write(folder / "plant", together(head(documents=documents), group(points))), Report())
    assert subject is not None
    outcome = audit(Citations(subject), "manual.txt", text, same_text=None)
    return [f"{one.fact} {one.wanted}" for one in outcome.missing] + [f"unused {one.number}" for one in outcome.unused]


DEVICES = {"inputs": (INPUT_LINES, LINES), "pairs": (PAIRS_OF_BITS, PAIRS)}


@pytest.mark.parametrize(
    ("device", "old", "new", "expected"),
    [
        ("inputs", "", "", []),
        ("inputs", "Input 4 open", "Input 4 shut", ["flag values 1 = open"] * 4),  # printed three times for four flags
        ("inputs", "Bit 9 = 0", "Bit 7 = 0", ["unused 7"]),
        ("inputs", "10 + 9 + 8", "10 + 9 + 6", ["unused 6"]),
        ("pairs", "", "", []),
        ("pairs", "Bit 3 + 2", "Bit 9 + 2", ["flags bits 3 and 2"]),
        ("pairs", "Bit 3 + 2", "Bit 3 + 9", ["flags bits 3 and 2", "flags 3 = Pump"]),
    ],
)
def test_a_changed_number_in_a_list(device: str, old: str, new: str, expected: list[str], tmp_path: Path) -> None:
    points, text = DEVICES[device]
    assert not old or text.count(old) == 1
    assert found(tmp_path, points, text.replace(old, new) if old else text) == expected


MESSAGE = """4.1 Ask on H'33F

Byte 0\tByte 1\tByte 2\tByte 3\tByte 4\tByte 5\tByte 6\tByte 7
H'FF\tUnit\tID\tID\t0\t0\tCheck\tCheck

a.) Byte 0

In byte 0 stands FF.

""" + "\n\n".join(f"{letter}.) Byte {byte}" for byte, letter in enumerate("bcdefgh", 1))
ASK = """messages:
- {name: ask, direction: request, can_id: 33Fh, layout: {0: FFh, 1: unit, 2..3: address, 4..5: 0, 6..7: xor 0..5},
   line: 1}
looked_through: [{lines: 1, numbers: ["4.1"], why: The section.}]
"""


@pytest.mark.parametrize(
    ("old", "new", "expected"), [("", "", []), ("H'FF", "H'FE", ["unused H'FE"]), ("H'33F", "H'33E", ["can_id 831"])]
)
def test_a_changed_byte_of_a_message(old: str, new: str, expected: list[str], tmp_path: Path) -> None:
    assert not old or MESSAGE.count(old) == 1
    bus = "{bitrate: 125000, identifier_bits: 11, units: 1..30}"
    subject = load_analysis(write(tmp_path / "plant", head(family="can", bus=bus) + ASK), Report())
    assert subject is not None
    text = MESSAGE.replace(old, new) if old else MESSAGE
    outcome = audit(Citations(subject), "manual.txt", text, same_text=None)
    missing = [f"{one.fact} {one.wanted}" for one in outcome.missing]
    assert missing + [f"unused {one.number}" for one in outcome.unused] == expected


TYPES = """4.1 Numbers

77\tUINT32\tCounter\t5
78\t0,1 Hz\tCounter\t12,5
79\t-\tCounter\tKeypad
"""


@pytest.mark.parametrize(
    ("facts", "missing"),
    [
        ("at: 77, type: u32, default: 5, line: 3", []),
        ("at: 77, type: s32, default: 5, line: 3", ["type s32"]),
        ("at: 77, type: u32, default: 6, line: 3", ["default 6"]),
        ("at: 78, scale: value = raw * 0.1, unit: Hz, default_in_units: 12.5, line: 4", []),
        ("at: 78, scale: value = raw * 0.1, unit: Hz, default: 125, line: 4", []),
        ("at: 78, scale: value = raw * 0.1, unit: Hz, default: 100, line: 4", ["default 100"]),
        (
            "at: 79, enum: {0: {name: panel, en: Keypad}, 1: bus}, default: panel, line: 5",
            ["enum 0 = Keypad", "enum 1"],
        ),
    ],
)
def test_type_and_default_are_held_against_the_row(facts: str, missing: list[str], tmp_path: Path) -> None:
    findings = found(tmp_path, f"- {{name: counter, {facts}}}\n", TYPES)
    assert [text for text in findings if not text.startswith("unused")] == missing
