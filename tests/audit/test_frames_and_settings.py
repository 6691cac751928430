"""Frames that a manual prints as tables, settings and flags beside their bits: each changed number is a finding."""

from __future__ import annotations

from pathlib import Path

import pytest
from fieldscribe.audit import Citations, audit
from fieldscribe.diagnostics import Report
from fieldscribe.pipeline import load_analysis
from support.described import group, head, together, write

DOCUMENTS = "{manual: {title: Manual, language: en, writes: {default: [Factory setting]}}}"

TABLE = """4.1 Reading

Request\t\tResponse\t
Address\t0x08\tAddress\t0x08
Function\t0x03\tFunction\t0x03
Start High\t0x0C\tNumber of bytes\t0x04
Start Low\t0x10\tParameter 1 High\t0x2B
Number High\t0x00\tParameter 1 Low\t0x37
Number Low\t0x02\tParameter 2 High\t0x09
CRC High\t0xC6\tParameter 2 Low\t0xC4
CRC Low\t0x07\tCRC High\t0xDC
\t\tCRC Low\t0xDA
"""
FRAMES = """frames:
- {name: ask, line: 3, direction: request, bytes: 08 03 0C 10 00 02 C6 07}
- {name: answer, line: 3, answers: ask, bytes: 08 03 04 2B 37 09 C4 DC DA}
"""

WORDS = """4.1 Jog

To change from left to right: 067E 0000 to 057E 0000 does it.
"""
USS = """{units: 0..31, pkw: [0, 4], pzd: 0..2,
  functions: {0: {name: no_task, answers: [0]}, 1: {name: read, answers: [1]}},
  responses: {0: {name: none, answers: [0]}, 1: {name: word, answers: [1]}}}"""
JOG = """frames:
- {name: left, line: 3, framing: pzd, direction: request, bytes: 067E 0000}
- {name: right, line: 3, framing: pzd, direction: request, bytes: 057E 0000}
"""

SETTINGS = """4.1 Line

Rate: 9600 Baud
0: 8 bits, 1 stop bit, no parity
1: 8 bits, 1 stop bit, odd parity
2: 8 bits, 1 stop bit, even parity
3: 8 bits, 2 stop bits, no parity
"""
FORMAT = """{framings: [rtu], units: 1..247, functions: {03h: read},
  serial: {format: {0: "8 bits, 1 stop bit, no parity", 1: "8 bits, 1 stop bit, odd parity",
  2: "8 bits, 1 stop bit, even parity", 3: "8 bits, 2 stop bits, no parity"}}, lines: {format: 4..7}}"""

FLAGS = """4.1 Doors

ID 77
Bit 0 Door north
Bit 1 Door east
Bit 2 Door south
Bit 3 Door west
"""
DOORS = ", ".join(
    f"{bit}: {{name: {side}, title: {{en: Door {side}}}}}"
    for bit, side in enumerate(("north", "east", "south", "west"))
)
FLAG_POINT = f'- {{name: doors, at: 77, flags: {{{DOORS}}}, section: "4.1", line: 1}}\n'

LOCKS = """4.1 Locks

ID 78
Bits 5 and 4 Lock
0 Unlocked
3 Bolted
"""
LOCK_ENUM = "enums: {lock: {0: {name: unlocked, en: Unlocked}, 3: {name: bolted, en: Bolted}}}\n---\n"
LOCK_POINT = (
    '- {name: locks, at: 78, flags: {5..4: {name: side, title: {en: Lock}, values: lock}}, section: "4.1", line: 1}\n'
)

DEFAULT = """4.1 Unit

ID 512 must not be 0 or 2 (factory setting 0, Factory setting: 0)
"""
DEFAULT_POINT = '- {name: unit, at: 512, default: 0, section: "4.1", line: 3, lines: {default: 3}}\n'

DEVICES = {
    "frames": (head(documents=DOCUMENTS) + FRAMES, TABLE),
    "words": (head(documents=DOCUMENTS, family="uss", bus=USS) + JOG, WORDS),
    "settings": (head(documents=DOCUMENTS, bus=FORMAT), SETTINGS),
    "flags": (together(head(documents=DOCUMENTS), group(FLAG_POINT)), FLAGS),
    "shared values": (together(head(documents=DOCUMENTS), LOCK_ENUM + group(LOCK_POINT)), LOCKS),
    "default": (together(head(documents=DOCUMENTS), group(DEFAULT_POINT)), DEFAULT),
}


@pytest.mark.parametrize(
    ("device", "old", "new", "expected"),
    [
        ("frames", "", "", []),
        ("frames", "Start High\t0x0C", "Start High\t0x03", ["bytes 08030C100002C607"]),
        ("frames", "Address\t0x08\t", "Address\t0x03\t", ["bytes 08030C100002C607"]),
        ("frames", "2 High\t0x09", "2 High\t0x08", ["bytes 0803042B3709C4DCDA"]),
        ("words", "", "", []),
        ("words", "067E 0000", "067E 0008", ["bytes 067E0000"]),  # 0000 stands in the other frame, too
        ("settings", "", "", []),
        ("settings", "2 stop bits, no", "2 stop bits, odd", ["format 3: 8 bits, 2 stop bits, no parity"]),
        ("settings", "2 stop", "1 stop", ["format 3: 8 bits, 2 stop bits, no parity"] * 2),
        ("flags", "", "", []),
        ("flags", "Bit 1", "Bit 2", ["flags 1 = Door east"]),  # 2 is the mask of bit 1
        ("shared values", "", "", []),
        ("shared values", "3 Bolted", "2 Bolted", ["flag values 3 = Bolted"]),
        ("default", "", "", []),
        ("default", "Factory setting: 0", "Factory setting: 2", ["default 0"]),
    ],
)
def test_a_changed_number(device: str, old: str, new: str, expected: list[str], tmp_path: Path) -> None:
    description, text = DEVICES[device]
    assert not old or text.count(old) == 1
    report = Report()
    subject = load_analysis(write(tmp_path / "plant", description), report)
    assert subject is not None, report.findings
    outcome = audit(Citations(subject), "manual.txt", text.replace(old, new) if old else text, same_text=None)
    assert [f"{one.fact} {one.wanted}" for one in outcome.missing] == expected
