"""What nearly all places of a manual print alike, all have to print alike."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import pytest
from fieldscribe.audit import audit
from fieldscribe.cli import main
from fieldscribe.diagnostics import Report
from fieldscribe.pipeline import load_analysis
from support.described import group, head, together, write

if TYPE_CHECKING:
    from pathlib import Path

NAMES = ("one", "two", "six", "ten", "red", "low", "top", "off", "raw", "new")
ROWS = [
    f"| A{place} | Speed {name} | Speed {name}, 0 - 5{place} | {place}h | {int(str(place), 16)} | 0-5{place} |"
    for place, name in enumerate(NAMES, 101)
]
SECTIONS = [
    f"4.{level} Level {chr(86 + level)}\n\nID\t{level}\nRange\t0 to 9, 100 of them\n"
    "Formula\traw = u * 100\nThe Highbyte of a Highbyte.\n"
    for level in range(11, 21)
]
WORD = """4.30 Word

ID\t77
Bit 15 - 12 are zero, 12 not for long
1\t0\tPump off
\t1\tPump on
2\t0\tFan off
\t1\tFan on, 4 times
4\t0\tLamp off
\t1\tLamp on
6\t0\tGate off
\t1\tGate on
Delay, normally 30 s, of unit 78; 0 is never
"""
TEXT = "\n".join(("| Code | Title | Text | Hex | Dec | Range |", *ROWS, "", *SECTIONS, WORD))

FORMULA = "4.12 Level b\n\nID\t12\nRange\t0 to 9, 100 of them\nFormula\traw = u * 100\n"


def line_of(words: str) -> int:
    """The line that begins with these words."""
    return next(number for number, line in enumerate(TEXT.split("\n"), 1) if line.startswith(words))


FLAGS = ", ".join(
    f"{bit}: {{name: {name}, zero: {{en: {name.title()} off}}, one: {{en: {name.title()} on}}}}"
    for bit, name in ((1, "pump"), (2, "fan"), (4, "lamp"), (6, "gate"))
)
POINTS = "".join(
    (
        *(
            f"- {{code: A{place}, name: {name}, title: Speed {name}, at: {place}h, range: 0..5{place},"
            f" line: {place - 99}, printed: {{wire: [{place}h, {int(str(place), 16)}]}}}}\n"
            for place, name in enumerate(NAMES, 101)
        ),
        *(
            f"- {{name: level_{level}, at: {level}, bits: 15..8, range: 0..9, scale: raw = value * 100,"
            f' section: "4.{level}",'
            f" line: {line_of(f'4.{level}')}}}\n"
            for level in range(11, 21)
        ),
        (
            f'- {{name: word, at: 77, fixed: {{15..12: 0}}, flags: {{{FLAGS}}}, section: "4.30",'
            f" line: {line_of('4.30')}}}\n"
            f"- {{name: delay, at: 78, unit: s, default: 30, special: {{0: {{name: never, writable: yes, en: never}}}},"
            f" line: {line_of('Delay')}, lines: {{default: {line_of('Delay')}}}}}\n"
        ),
    )
)
DEVICE = together(
    head(
        device="alike",
        documents="\n  manual: {title: Manual, language: en, file: manual.txt, writes: {15..8: [Highbyte], 0: [zero]}}",
        bus="{framings: [rtu], units: 1..9, functions: {3: read_holding_registers, 6: write_register}}",
    ),
    group(POINTS, source="{document: manual, section: Drive}"),
)


@pytest.mark.parametrize(
    ("old", "new", "missing"),
    [
        ("", "", []),
        ("| Speed ten |", "| Speed max |", ["ten title Speed ten"]),
        ("| 0-5105 |", "| 1-5105 |", ["red range 0..5105"]),
        ("| 108h |", "| 107h |", ["off printed wire 264", "off address 0108h"]),
        (FORMULA, FORMULA.replace("* 100", "* 50"), ["level_12 scale 100"]),
        ("a Highbyte.\n\n4.13", "a Lamp.\n\n4.13", ["level_12 bits 8"]),
        ("4\t0\tLamp off", "2\t0\tLamp off", ["word flag values bit 4"]),
        ("\t1\tFan on", "\t4\tFan on", ["word flag values 1 = Fan on"]),
        ("Bit 15 - 12 are zero", "Bit 15 - 12 are one", ["word fixed bits = 0"]),
        ("normally 30 s", "normally 31 s", ["delay default 30"]),
        ("0 is never", "0 is always", ["delay special 0 = never"]),
    ],
)
def test_one_place_among_many(
    old: str, new: str, missing: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert not old or TEXT.count(old) == 1
    write(tmp_path / "alike", DEVICE)
    (tmp_path / "manual.txt").write_text(TEXT.replace(old, new) if old else TEXT, "utf-8")
    main(["audit", str(tmp_path / "alike"), "--manual", str(tmp_path / "manual.txt"), "--report", "json"])
    report = json.loads(capsys.readouterr().out)
    assert [f"{fact['subject']} {fact['fact']} {fact['wanted']}" for fact in report["missing"]] == missing
    assert report["moved"] == []


MASKS = """Inputs 0020h
Bit 0 Input 1 (=0x0001)
Bit 1 Input 2 (=0x0002)
Bit 2 Input 3 (=0x0004)
"""


@pytest.mark.parametrize(("old", "new"), [("", ""), ("=0x0002", "=1"), ("=0x0004", "=3"), ("=0x0001", "=9")])
def test_the_number_beside_a_label_is_no_mask(old: str, new: str, tmp_path: Path) -> None:
    flags = "".join(
        f"    {bit}: {{name: input_{bit}, title: {{en: Input {bit + 1}}}, printed: {{bit: {bit}, mask: {1 << bit}}}}}\n"
        for bit in range(3)
    )
    points = f"- name: inputs\n  at: 0020h\n  line: 1\n  flags:\n{flags}  lines: {{flags: 2..4}}\n"
    described = load_analysis(write(tmp_path / "plant", together(head(), group(points))), Report())
    assert described is not None
    assert audit(described, "manual.txt", MASKS.replace(old, new), same_text=None).clean == (not old)
