"""A manual that changed: its lines are explained or reported, their numbers written anew, and it is accepted."""

from __future__ import annotations

import json
import time
from hashlib import sha256
from typing import TYPE_CHECKING, Any

import pytest
from fieldscribe.audit.editions.changes import Editions
from fieldscribe.cli import main
from support.described import write

if TYPE_CHECKING:
    from pathlib import Path

OLD = """# Heat pump HP 12

Edition 2024-03, with Soll-wert „Vorlauf-Temperatur“ in words.

## Registers

| Code | Title | Register | Access | Range | Step |
|------|-------|----------|--------|-------|------|
| H01 | Flow temperature | 0010h | R | -40-900 | 0.1 °C |
| H02 | Target temperature | 0011h | R/W | 200-550 | 0.1 °C |
| H03 | Mode | 0012h | R/W | 0 off, 1 heating, 2 cooling | |
| H05 | Hysteresis | 0015h | R/W | 1-50 | 0.1 °C |
| H06 | Pump delay | 0061h | R/W | 3-30 | s |

Cooling needs the cooling kit 4711.

## Frames

Setting 40.5 degrees: 01 06 00 11 01 95 18 30

## Wiring

Pin 1 shield
Pin 2 plus
"""
DEVICE = """fieldscribe: 1
device: audited
version: 1.0.0
vendor: Example
model: HP 12
title: {en: Heat pump}
family: modbus
documents:
  manual:
    {title: Heat pump HP 12, language: en, file: old.txt, sha256: SHA, names: [HP 12], access: {r: [R], rw: [R/W]}}
bus: {framings: [rtu], units: 1..247, functions: {03h: read_holding_registers, 06h: write_register}}
looked_through:
- {lines: 1..3, why: Title.}
- {lines: 21..23, why: Wiring.}
- {lines: 24, why: Wiring.}
- {lines: [15, 19], numbers: [4711, 40.5], why: The kit and the example.}
frames:
- {name: write_target, line: 19, direction: request, bytes: 01 06 00 11 01 95 18 30}
errata:
- id: pump_delay_register            # a comment names line 13
  point: H06
  line: 13
  printed: {wire: 0061h}
  taken: {wire: 0016h}
  why: "It follows 0015h (line 12)."
  certainty: likely
- id: flow_word
  where: title page
  line: 3
  printed: "It says „Vorlauf-Temperatur“."
  taken: Flow temperature
  why: So says the table from line 9 on.
  certainty: certain
---
group: main
space: holding
access: rw
source: {document: manual, section: Registers}
points:
- {code: H01, name: flow_temperature, at: 0010h, access: r, type: s16,
   range: -40..900, scale: value = raw * 0.1, unit: °C, line: 9}
- code: H02
  name: target_temperature
  at: 0011h
  range: 200..550   # raw
  scale: value = raw * 0.1
  unit: °C
  line: 10
- code: H03
  name: mode
  at: 0012h
  enum:
    0: "off"
    1: {name: heating, en: heating}
    2: {name: cooling, en: cooling}
  line: 11
  lines: {range: 11..11}
  note: Cooling needs a kit, see line 15.
- {code: H05, name: hysteresis, at: 0015h, range: 1..50, scale: value = raw * 0.1, unit: °C, line: 12}
- {code: H06, name: pump_delay, at: 0016h, range: 3..30, unit: s, line: 13, printed: {wire: 0061h}}
"""


class Described:
    """The description in a folder, and both editions beside it."""

    def __init__(self, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
        self.folder, self.capsys = folder, capsys
        (folder / "old.txt").write_text(OLD, "utf-8")
        write(folder / "audited", DEVICE.replace("SHA", sha256(OLD.encode()).hexdigest()))
        self.file = folder / "audited" / "device.yaml"

    @property
    def text(self) -> str:
        """The description as it is now."""
        return self.file.read_text("utf-8")

    def edit(self, old: str, new: str) -> None:
        """Change one place of the description."""
        assert self.text.count(old) == 1, old
        self.file.write_text(self.text.replace(old, new), "utf-8")

    def line_of(self, snippet: str) -> int:
        """The line of the description where a text stands."""
        return self.text[: self.text.index(snippet)].count("\n") + 1

    def audit(self, new: str, *arguments: str) -> tuple[int, dict[str, Any]]:
        """Hold it against another edition; exit code and report."""
        (self.folder / "new.txt").write_text(new, "utf-8")
        files = ["--manual", str(self.folder / "new.txt"), "--old", str(self.folder / "old.txt")]
        code = main(["audit", str(self.folder / "audited"), *files, "--format", "json", *arguments])
        return code, json.loads(self.capsys.readouterr().out)

    def audit_alone(self, new: str) -> dict[str, Any]:
        """The plain audit against one text."""
        (self.folder / "new.txt").write_text(new, "utf-8")
        main(["audit", str(self.folder / "audited"), "--manual", str(self.folder / "new.txt"), "--format", "json"])
        report: dict[str, Any] = json.loads(self.capsys.readouterr().out)
        return report


@pytest.fixture
def described(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Described:
    return Described(tmp_path, capsys)


def _reflowed(text: str) -> str:
    """Every table as tabs, cells of one as lines of their own, longer sentences over two lines."""
    lines = []
    for number, line in enumerate(text.splitlines()):
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if line.startswith("|--"):
            continue
        lines += cells if number == 9 else ["\t".join(cells)] if line.startswith("|") else [line]
    return "\n".join(lines).replace("needs the", "needs\nthe").replace("degrees: ", "degrees:\n")


def _without(line: str) -> str:
    return OLD.replace(line + "\n", "")


_FRAMES = OLD[OLD.index("## Frames") : OLD.index("## Wiring")]
_LAYOUTS = {
    "the same": OLD,
    "padding": OLD.replace(" | ", "    |  ").replace("Pin 1", "Pin   1"),
    "blank lines": OLD.replace("\n## ", "\n\n\n\n## "),
    "tables reflowed": _reflowed(OLD),
    "cells joined": OLD.replace("| R/W | 1-50 |", "| R/W 1-50 |"),
    "cells split": OLD.replace("| 0 off, 1 heating,", "| 0 | off, | 1 heating,"),
    "a section moved": OLD.replace(_FRAMES, "") + "\n" + _FRAMES,
    "other dashes": OLD.replace("200-550", "200\u2013550").replace("Soll-wert", "Soll\u00adwert"),
    "a word parted": OLD.replace("cooling kit", "cool-\ning kit"),
    "a word parted in a cell": OLD.replace("Hysteresis |", "Hyste-<br>resis |"),
    "line breaks in cells": OLD.replace("Pump delay", "Pump<br>delay").replace("1 heating, ", "1 heating,<br />"),
    "soft spaces": OLD.replace("0.1 °C", "0.1\u00a0°C"),
    "a sentence that holds nothing": OLD.replace("Pin 1", "Mind the colours.\n\nPin 1"),
}


@pytest.mark.parametrize("new", _LAYOUTS.values(), ids=_LAYOUTS)
def test_another_layout_is_no_change(new: str, described: Described) -> None:
    code, report = described.audit(new)
    unexplained = [finding for finding in report["findings"] if not finding["explained"]]
    assert (code, unexplained, report["elsewhere"], report["void_errata"]) == (0, [], [], [])


CHANGES = [
    # old, new, kind, a reason, and what stands at its place in the description
    ("200-550", "200-600", "changed", "range 200..550 is not there", "range: 200..550"),
    ("200-550", "200-600", "changed", "is `600`", "code: H02"),
    ("-40-900", "40-900", "changed", "without a minus sign", "range: -40..900"),
    ("Target temperature | 0011h | R/W", "Target temperature | 0011h | R", "changed", "access", "access: rw"),
    ("0.1 °C |\n| H06", "0.1 K |\n| H06", "changed", "unit °C is not there", "name: hysteresis"),
    ("1 heating, 2 cooling", "1 cooling, 2 heating", "swapped", "1 = ", "1: {name: heating"),
    ("2 cooling |", "2 cooling, 3 defrosting |", "changed", "is `defrosting`", "code: H03"),
    ("0 off, ", "", "changed", "enum", '0: "off"'),
    ("| H05 |", "| H07 |", "changed", "code H05 is not there", "code: H05"),
    ("01 95 18 30", "01 95 18 31", "changed", "bytes", "name: write_target"),
    ("kit 4711", "kit 4712", "changed", "nothing cites line 15: `4712`", ""),
    ("| H05 | Hysteresis | 0015h | R/W | 1-50 | 0.1 °C |\n", "", "removed", "cited line 12 is gone", "code: H05"),
    ("Pin 2 plus\n", "", "removed", "looked_through: cited line 24 is gone", "{lines: 24, why"),
    ("| H06", "| H09 | New | 0019h | R/W | 0-9 | 1 s |\n| H06", "added", "is `0019h`", "name: hysteresis"),
    ("## Wiring", "## Timing\n\nWait for 20 ms.\n\n## Wiring", "added", "nothing cites line 23: `20`", ""),
]  # fmt: skip


@pytest.mark.parametrize("change", CHANGES, ids=[change[1][:24] for change in CHANGES])
def test_a_change_is_reported_with_its_place(change: tuple[str, ...], described: Described) -> None:
    old, new, kind, reason, snippet = change
    assert OLD.count(old) == 1
    code, report = described.audit(OLD.replace(old, new))
    found = [finding for finding in report["findings"] if not finding["explained"]]
    assert (code, {finding["kind"] for finding in found}) == (1, {kind})
    places = [said["place"] for finding in found for said in finding["reasons"] if reason in said["text"]]
    assert places, [said["text"] for finding in found for said in finding["reasons"]]
    if snippet:
        assert f"device.yaml:{described.line_of(snippet)}:" in places[0]


def test_a_new_row_is_shown_as_a_point_to_paste(described: Described) -> None:
    row = "| H09 | Night setback | 0019h | R | 0-100 | 0.5 °C |\n"
    new = OLD.replace("| H06", row + "| H06")
    _, report = described.audit(new)
    [draft] = [draft for finding in report["findings"] for draft in finding["drafts"]]
    assert draft["line"] == 13
    assert draft["yaml"].splitlines() == [
        "- code: H09",
        "  name: night_setback",
        "  title: {en: Night setback}",
        "  at: 0019h",
        "  access: r",
        "  range: 0..100",
        "  scale: value = raw * 0.5",
        "  unit: °C",
        "  line: 13",
    ]
    text = described.text
    described.file.write_text(f"{text}{draft['yaml'].replace('..100', '..90')}\n", "utf-8")
    _, report = described.audit(new)
    [finding] = report["findings"]
    assert (finding["explained"], finding["drafts"]) == (False, [])
    described.file.write_text(f"{text}{draft['yaml']}\n", "utf-8")
    code, report = described.audit(new)
    assert (code, report["explained"]) == (0, True), report


def test_a_corrected_misprint_says_which_erratum_is_corrected(described: Described) -> None:
    new = OLD.replace("0061h", "0016h")
    code, report = described.audit(new)
    [void] = report["void_errata"]
    assert (code, void["erratum"], void["is_corrected"]) == (1, "pump_delay_register", True)
    assert f"device.yaml:{described.line_of('id: pump_delay')}:" in void["place"]
    start, end = described.text.index("- id: pump_delay"), described.text.index("- id: flow_word")
    described.file.write_text(described.text[:start] + described.text[end:], "utf-8")
    described.edit(", printed: {wire: 0061h}", "")
    assert described.audit(new)[0] == 0


def test_an_erratum_that_quotes_layout_is_void_with_it(described: Described) -> None:
    code, report = described.audit(OLD.replace("Vorlauf-Temperatur", "Vorlauftemperatur"))
    assert (code, [void["erratum"] for void in report["void_errata"]]) == (1, ["flow_word"])


def test_lines_are_written_anew_and_nothing_else(described: Described) -> None:
    """Five lines more at the top: then the plain audit finds nothing, and nothing moved; the edition is accepted."""
    new = "\n\n\n\n\n" + OLD
    before = described.text
    code, report = described.audit(new, "--renumber")
    assert (code, report["renumbered"]) == (0, True)
    after = described.text
    for old, now in (
        ("lines: 1..3", "lines: 6..8"), ("lines: 21..23", "lines: 26..28"), ("lines: 24,", "lines: 29,"),
        ("lines: [15, 19]", "lines: [20, 24]"),
        ("line: 19,", "line: 24,"), ("  line: 13\n", "  line: 18\n"), ("(line 12)", "(line 17)"),
        ("  line: 3\n", "  line: 8\n"),
        ("from line 9 on", "from line 14 on"), ("°C, line: 9}", "°C, line: 14}"), ("  line: 10\n", "  line: 15\n"),
        ("  line: 11\n", "  line: 16\n"), ("range: 11..11", "range: 16..16"), ("see line 15", "see line 20"),
        ("line: 12}", "line: 17}"), ("unit: s, line: 13,", "unit: s, line: 18,"),
    ):  # fmt: skip
        assert before.count(old) == 1, old
        before = before.replace(old, now)
    assert after == before
    assert "a comment names line 13, which is 18 now" in report["written"][0]
    alone = described.audit_alone(new)
    assert (alone["missing"], alone["moved"], alone["errata_not_printed"]) == ([], [], [])
    assert described.audit(new, "--renumber")[1]["written"] == ["renumbered: 0 lines in 0 files"]
    code, report = described.audit(new, "--accept", "--file", "new.txt")
    assert (code, report["refused"]) == (0, None)
    recorded = after.replace(sha256(OLD.encode()).hexdigest(), sha256(new.encode()).hexdigest())
    assert described.text == recorded.replace("file: old.txt", "file: new.txt")
    assert described.audit_alone(new)["same_text"] is True


def test_what_was_looked_through_takes_in_no_new_lines(described: Described) -> None:
    described.edit("21..23, why: Wiring.}\n- {lines: 24,", "21..24,")
    described.audit(OLD.replace("Pin 2", "Pin 3 earth\nPin 2"), "--renumber")
    assert "lines: [21..23, 25], why: Wiring." in described.text


FOLLOWED = [
    # a row, the point as it was, what the new row says instead, what the point says then
    (
        "| H07 | Outputs 11, 12 | 0017h | R/W | Bit 0 = [11], Bit 1 = [12] | |",
        "{code: H07, name: outputs, at: 0017h, flags: {0: OUTPUT_11, 1: OUTPUT_12}, line: 26}",
        {"Bit 0 = [11], Bit 1 = [12]": "Bit 0 = [12], Bit 1 = [11]"},
        {"OUTPUT_11, 1: OUTPUT_12": "OUTPUT_12, 1: OUTPUT_11"},
    ),
    (
        "| H08 | Curve | 0018h | R/W | 2 curves: 00 linear, 02 round 2 | 0, 2 |",
        """{code: H08, name: curve, at: 0018h, range: '0, 2', line: 26, printed: {range: '0, 2', choices: 2},
  enum: {0: {name: linear, en: linear}, 2: {name: round, en: round 2}}}""",
        {"02 round": "03 round", "0, 2 |": "0, 3 |"},
        {"range: '0, 2'": "range: '0, 3'", " 2: {name": " 3: {name"},
    ),
]
_OUTPUTS = {f"OUTPUT_{number}": f"{{name: output_{number}, title: {{en: Output {number}}}}}" for number in (11, 12)}


def _replaced(text: str, replacements: dict[str, str]) -> str:
    for old, new in replacements.items():
        assert old in text, old
        text = text.replace(old, new)
    return text


@pytest.mark.parametrize(("row", "point", "new_row", "new_point"), FOLLOWED, ids=["labels swapped", "renumbered"])
def test_what_followed_the_manual_is_explained(
    row: str, point: str, new_row: dict[str, str], new_point: dict[str, str], described: Described
) -> None:
    """Also where the numbers that were changed stand in the same row as other facts."""
    old = f"{OLD}\n{row}\n"
    (described.folder / "old.txt").write_text(old, "utf-8")
    described.edit("names: [HP 12]", 'names: [HP 12], writes: {Output 11: ["[11]"], Output 12: ["[12]"]}')
    text = described.text
    for now, explained in ((point, False), (_replaced(point, new_point), True)):
        outputs = {key: label for key, label in _OUTPUTS.items() if key in now}
        described.file.write_text(f"{text}- {_replaced(now, outputs)}\n", "utf-8")
        [finding] = described.audit(_replaced(old, new_row))[1]["findings"]
        assert finding["explained"] == explained


def test_lines_that_hold_nothing_stay_so_beside_numbers_that_are_no_facts(described: Described) -> None:
    new = OLD.replace("kit 4711", "kit 4712")
    described.edit("- {lines: [15, 19]", "- {lines: 15, numbers: [4712], why: The kit.}\n- {lines: [15, 19]")
    assert described.audit(new)[0] == 0
    assert described.audit_alone(new)["uncited"] == []


FLAGS = "{8: lamp, 9: pump, 10: fan, 11: door}"


@pytest.mark.parametrize("new", ["11 + 10 + 2 + 8", "11 + 10 + 9", "11 + 9 + 10 + 8"])
def test_a_row_that_lists_the_bits_of_flags_lists_all_of_them(new: str, described: Described) -> None:
    """Though each of the bits stands beside its name, too."""
    row = "\n## Inputs\n\nInputs 0031h\nBits 11 + 10 + 9 + 8\nBit 8 lamp 1\nBit 9 pump 2\nBit 10 fan\nBit 11 door\n"
    (described.folder / "old.txt").write_text(OLD + row, "utf-8")
    point = f"- {{name: inputs, at: 0031h, line: 28, lines: {{flags: 29..33}}, flags: {FLAGS}}}\n"
    described.file.write_text(described.text + point, "utf-8")
    assert described.audit(OLD + row)[0] == 0
    code, report = described.audit(OLD + row.replace("11 + 10 + 9 + 8", new))
    reasons = [reason["text"] for finding in report["findings"] for reason in finding["reasons"]]
    assert (code, "inputs: list of bits 11, 10, 9, 8 is not there" in reasons) == (1, True), reasons


LINE = [
    # what the new text says, what is not there then; the settings that follow it
    ("8 data bits, no parity, 1 stop bit", "bus: parity even", "parity: none, stop_bits: 1"),
    ("8 data bits, even parity, 2 stop bits", "bus: stop_bits 1", "parity: even, stop_bits: 2"),
]


@pytest.mark.parametrize(("now", "missing", "settings"), LINE)
def test_the_settings_of_the_line_are_held(now: str, missing: str, settings: str, described: Described) -> None:
    old = OLD + "\n## Line\n\n8 data bits, even parity, 1 stop bit\n"
    (described.folder / "old.txt").write_text(old, "utf-8")
    line = "06h: write_register}, serial: {parity: even, stop_bits: 1}, lines: {parity: 28, stop_bits: 28}}"
    described.edit("06h: write_register}}", line)
    described.edit("- {lines: 24, why", "- {lines: 28, numbers: [8], why: x}\n- {lines: 24, why")
    new = old.replace("8 data bits, even parity, 1 stop bit", now)
    code, report = described.audit(new)
    [reason, *_] = [reason for finding in report["findings"] for reason in finding["reasons"]]
    assert (code, reason["text"]) == (1, f"{missing} is not there")
    assert f"device.yaml:{described.line_of('serial:')}:" in reason["place"]
    described.edit("parity: even, stop_bits: 1", settings)
    _, report = described.audit(new)
    assert [reason["text"] for finding in report["findings"] for reason in finding["reasons"]] == []
    assert (report["explained"], report["elsewhere"]) == (True, [])


def test_feet_of_pages_that_look_like_rows_are_no_uncited_rows(described: Described) -> None:
    text = "x\n" * 9
    feet = "".join(f"\nMaker\tPage {page} of 9\n{text}" for page in range(1, 10))
    rows = described.audit_alone(OLD + feet)["uncited"]
    assert [row["text"] for row in rows if row["kind"] == "row"] == []
    rows = described.audit_alone(OLD + feet.replace(" of 9", "").replace("Page", "Pump"))["uncited"]
    assert len([row for row in rows if row["kind"] == "row"]) == 9


WAYS_OUT = [
    # what looked_through has of the row, what the finding says to write; nothing when it is explained
    ("", "add `numbers: [7], words: [Delta, Kelvin]` there"),
    ("numbers: [7], ", "looked_through has the line: add `words: [Delta, Kelvin]` there"),
    ("numbers: [7], words: [Delta], ", "looked_through has the line: add `words: [Kelvin]` there"),
    ("numbers: [7], words: [Delta Kelvin], ", ""),
    ("numbers: [7, Delta, Kelvin], ", ""),
]


@pytest.mark.parametrize(("listed", "said"), WAYS_OUT)
def test_a_row_that_was_looked_through_says_what_to_list(listed: str, said: str, described: Described) -> None:
    described.edit("- {lines: [15, 19]", f"- {{lines: 12, {listed}why: x}}\n- {{lines: [15, 19]")
    code, report = described.audit(OLD.replace("| 1-50 |", "| 1-50 (Delta 7 Kelvin) |"))
    reasons = [reason["text"] for finding in report["findings"] for reason in finding["reasons"]]
    assert (code, [said in reason for reason in reasons]) == ((1, [True]) if said else (0, []))


def test_the_words_of_a_long_value_may_stand_in_two_rows(described: Described) -> None:
    rows = "| H07 (low) | Hours | 0017h | R | | |\n| H07 (high) | | 0018h | R | | |\n"
    point = "{code: H07, name: hours, at: 0017h, type: u32, words: low first, access: r, line: 26, printed: PRINTED}"
    described.edit("- {lines: [15,", "- {lines: 13, numbers: [1], why: A second.}\n- {lines: [15,")
    text = described.text
    for printed, unused in (("{wire: 0017h}", ["0018h"]), ("{wire: 0017h, high_wire: 0018h}", [])):
        described.file.write_text(f"{text}- {point.replace('PRINTED', printed)}\n", "utf-8")
        report = described.audit_alone(f"{OLD}\n{rows}")
        assert ([number["number"] for number in report["unused_numbers"]], report["missing"]) == (unused, [])


REFUSALS = [
    (OLD.replace("200-550", "200-600"), ("--accept",), 1, "not everything in the new edition is explained"),
    (
        OLD.replace("200-550", "200-600"),
        ("--renumber", "--accept"),
        1,
        "not everything in the new edition is explained",
    ),
    ("\n" + OLD, ("--accept", "--file", "new.txt"), 1, "--renumber comes first"),
    ("\n" + OLD, ("--renumber", "--accept"), 1, "file is `old.txt`, the new text is `new.txt`: say --file new.txt, or"),
    ("\n" + OLD, ("--renumber", "--accept", "--file", "n", "--edition", "2"), 1, "documents.manual has no `edition`"),
    ("\n" + OLD, ("--renumber", "--accept", "--file", "old.txt"), 0, None),
]


@pytest.mark.parametrize(("new", "arguments", "code", "refused"), REFUSALS)
def test_accepting(new: str, arguments: tuple[str, ...], code: int, refused: str | None, described: Described) -> None:
    before = described.text
    found, report = described.audit(new, *arguments)
    assert found == code
    assert (report["refused"] is None) == (refused is None)
    assert refused is None or refused in report["refused"]
    assert (described.text == before) == bool(refused)


def test_the_printed_edition_is_asked_for_and_recorded(described: Described) -> None:
    described.edit("file: old.txt", 'edition: "2024-03", file: old.txt')  # in flow, with a comment behind
    before = described.text
    code, report = described.audit("\n" + OLD, "--renumber", "--accept", "--file", "old.txt")
    assert (code, described.text) == (1, before)
    assert "edition is `2024-03`: say --edition" in report["refused"]
    given = ("--file", "new.txt", "--edition", "2025: the second")
    assert described.audit("\n" + OLD, "--renumber", "--accept", *given)[0] == 0
    assert 'edition: "2025: the second", file: new.txt, sha256:' in described.text
    assert described.audit("\n" + OLD, "--accept")[0] == 0  # what is recorded is not asked for again


def test_what_the_accepted_text_alone_has_open_is_said(described: Described) -> None:
    described.edit("numbers: [4711, 40.5]", "numbers: [4711]")
    code, report = described.audit("\n" + OLD, "--renumber", "--accept", "--file", "old.txt")
    assert report["refused"] is None
    assert code == 1
    [head, finding] = report["written"][-1].splitlines()
    assert head == "the audit of the new text alone has 1 finding:"
    assert finding.endswith("no fact uses 40.5 at line 20, column 9")


@pytest.mark.parametrize("given", [("--file", "a/b.txt"), ("--edition", " "), ("--edition", "2" * 81)])
def test_what_cannot_be_recorded_is_refused(given: tuple[str, str], described: Described) -> None:
    before = described.text
    files = ["--manual", str(described.folder / "old.txt"), "--old", str(described.folder / "old.txt")]
    assert main(["audit", str(described.folder / "audited"), *files, "--accept", *given]) == 2
    assert main(["audit", str(described.folder / "audited"), *files, *given]) == 2
    assert described.text == before


NOTES = [
    # a sentence of another part, what the manual says now, what is told of it
    ("bus", "H02 must not pass 550 (raw), nor the range of H05 of 50.", ("200-550", "200-600"), {"550": "line 10"}),
    ("bus", "From 550 on it is hot.", ("200-550", "200-600"), None),
    ("bus", "Never above 550 in H05.", ("200-550", "200-600"), None),
    ("bus", "The kit 4711 is needed.", ("kit 4711", "kit 4712"), {"4711": "line 15"}),
    ("bus", 'It keeps the "hysteresis" small.', ("Hysteresis", "Dead band"), {"Hysteresis": "line 12"}),
    ("bus", "It keeps the Hysteresis low.", ("Hysteresis", "Dead band"), {"Hysteresis": "line 12"}),
    ("bus", "The hysteresis stays small.", ("Hysteresis", "Dead band"), None),
    ("bus", "See H05 and H06.", ("| H05 |", "| H07 |"), {"H05": "line 12"}),
    ("mode", "Cooling needs a kit, see line 15; 2 is rare.", ("2 cooling", "3 cooling"), {"2": "line 11"}),
    ("bus", "Never write 2 there.", ("2 cooling", "3 cooling"), None),
    (
        "bus",
        "Never write 0015h, which H02 shadows.",
        ("| H05 | Hysteresis | 0015h | R/W | 1-50 | 0.1 °C |\n", ""),
        {"0015h": "line 12"},
    ),
]


@pytest.mark.parametrize(("owner", "note", "change", "said"), NOTES, ids=[note[1][:20] for note in NOTES])
def test_notes_that_say_what_changed_are_told(
    owner: str, note: str, change: tuple[str, str], said: dict[str, str] | None, described: Described
) -> None:
    if owner == "bus":
        described.edit("bus: {framings", f"bus: {{note: {{en: '{note}'}}, framings")
    else:
        described.edit("note: Cooling needs a kit, see line 15.", f"note: {note}")
    _, report = described.audit(OLD.replace(*change))
    told = [stale for stale in report["notes"] if stale["owner"] == owner]
    assert [stale["said"] for stale in told] == ([said] if said else [])
    if said:
        assert told[0]["place"].startswith(f"{described.file}:{described.line_of(note)}:")


def test_notes_that_say_what_changed_are_told_with_explained_lines_too(
    described: Described, capsys: pytest.CaptureFixture[str]
) -> None:
    described.edit("note: Cooling needs a kit, see line 15.", "note: The edition of 2024-03 lacks 4711, see line 15.")
    described.edit("- {lines: [15, 19]", "- {lines: 15, numbers: [4712], why: The kit.}\n- {lines: [15, 19]")
    (described.folder / "new.txt").write_text(OLD.replace("kit 4711", "kit 4712"), "utf-8")
    files = ["--manual", str(described.folder / "new.txt"), "--old", str(described.folder / "old.txt")]
    assert main(["audit", str(described.folder / "audited"), *files]) == 0
    printed = capsys.readouterr().out
    assert "note: note of mode says `4711` (line 15): does it still hold?" in printed
    assert main(["audit", str(described.folder / "audited"), *files, "--accept", "--file", "old.txt"]) == 0
    assert "does it still hold?" in capsys.readouterr().out


def test_nothing_is_renumbered_where_a_cited_line_is_gone(
    described: Described, capsys: pytest.CaptureFixture[str]
) -> None:
    (described.folder / "new.txt").write_text(_without(OLD.splitlines()[11]), "utf-8")
    before = described.text
    files = ["--manual", str(described.folder / "new.txt"), "--old", str(described.folder / "old.txt")]
    assert main(["audit", str(described.folder / "audited"), *files, "--renumber"]) == 1
    assert "line 12 is gone" in capsys.readouterr().err
    assert described.text == before


def test_the_whole_way(described: Described) -> None:
    """Edited before it is renumbered: what was pasted counts the lines of the new edition already."""
    row = "| H09 | Night setback | 0019h | R | 0-100 | 0.5 °C |\n"
    new = "Second series.\n\n" + OLD.replace("200-550", "200-600").replace("| H06", row + "| H06")
    code, report = described.audit(new)
    assert code == 1
    [draft] = [draft for finding in report["findings"] for draft in finding["drafts"]]
    described.edit("range: 200..550", "range: 200..600")
    described.file.write_text(described.text + draft["yaml"] + "\n", "utf-8")
    assert described.audit(new)[0] == 0
    assert described.audit(new, "--renumber")[0] == 0
    assert described.text.endswith("  line: 15\n")
    assert described.audit_alone(new)["moved"] == []
    assert described.audit(new, "--accept", "--file", "new.txt")[0] == 0


def test_what_was_edited_counts_its_old_lines_until_it_is_renumbered(described: Described) -> None:
    """Also where what it says now stands at these lines of the new edition, and not at those of the old one."""
    kit = "- {id: kit, where: a note, line: 15, printed: The kit is 4711., taken: None., why: None., certainty: likely}"
    described.edit("---\ngroup", f"{kit}\n---\ngroup")
    described.edit("kit is 4711", "kit is 4712")
    described.audit("Second series.\n\n" + OLD.replace("4711", "4712"), "--renumber")
    assert "line: 17, printed: The kit is 4712." in described.text


def test_numbers_that_were_looked_through_count_the_lines_where_they_stand(described: Described) -> None:
    described.edit("{lines: [15, 19], numbers: [4711, 40.5]", "{lines: 19, numbers: [40.5]")
    described.audit("".join(f"Foreword, part {part}.\n" for part in "abcdefghijklmnopqrstuvwxyz") + OLD, "--renumber")
    assert "{lines: 45, numbers: [40.5]" in described.text


def test_an_erratum_in_words_about_a_changed_line_has_to_be_looked_at(described: Described) -> None:
    """It blocks until it is said to hold, or is removed: no claim can tell."""
    new = OLD.replace("2024-03", "2025-01")
    code, report = described.audit(new, "--accept", "--file", "new.txt")
    assert (code, [doubt["erratum"] for doubt in report["doubtful_errata"]]) == (1, ["flow_word"])
    assert "errata about changed lines are not looked at" in report["refused"]
    code, report = described.audit(new, "--holds", "pump_delay_register, flow_word")
    assert (code, report["doubtful_errata"]) == (0, [])
    described.edit(described.text[described.text.index("- id: flow_word") : described.text.index("---\ngroup")], "")
    assert described.audit(new)[0] == 0


def test_only_errata_of_the_description_can_hold(described: Described) -> None:
    files = ["--manual", str(described.folder / "old.txt"), "--old", str(described.folder / "old.txt")]
    assert main(["audit", str(described.folder / "audited"), *files, "--holds", "nothing"]) == 2
    assert "the description has no erratum `nothing`" in described.capsys.readouterr().err


def test_editions_that_are_given_the_wrong_way_round_are_noticed(described: Described) -> None:
    (described.folder / "new.txt").write_text(OLD.replace("200-550", "200-600"), "utf-8")
    files = ["--manual", str(described.folder / "old.txt"), "--old", str(described.folder / "new.txt")]
    main(["audit", str(described.folder / "audited"), *files])
    assert "old.txt is the text that the description records" in described.capsys.readouterr().out


def test_an_erratum_of_a_row_that_goes_on_in_a_new_line_has_to_be_looked_at(described: Described) -> None:
    """A list that lacked an entry may have it now."""
    lacking = (
        "{id: fan_only, point: H03, line: 11, printed: Fan only is missing., taken: None., why: x, certainty: likely}"
    )
    described.edit("---\ngroup", f"- {lacking}\n---\ngroup")
    row = "| H03 | Mode | 0012h | R/W | 0 off, 1 heating, 2 cooling | |\n"
    _, report = described.audit(OLD.replace(row, f"{row}| | | | | 3 fan only | |\n"))
    assert [doubt["erratum"] for doubt in report["doubtful_errata"]] == ["fan_only"]


def test_a_corrected_checksum_says_which_erratum_is_corrected(described: Described) -> None:
    wrong = "- {id: sum, frame: write_target, line: 19, printed: {crc: 18 31}, taken: {crc: 18 30}"
    described.edit("95 18 30", "95 18 31")
    described.edit("---\ngroup", f"{wrong}, why: x, certainty: likely}}\n---\ngroup")
    (described.folder / "old.txt").write_text(OLD.replace("95 18 30", "95 18 31"), "utf-8")
    _, report = described.audit(OLD)
    assert [(void["erratum"], void["is_corrected"]) for void in report["void_errata"]] == [("sum", True)]


def test_an_index_in_brackets_is_no_negative_number(described: Described) -> None:
    group = "group: more\nspace: holding\naccess: r\ntype: ~\nsource: {document: manual, section: Registers}"
    point = '- {code: "P70[1]", name: fault, title: Fault, at: 70, index: 1, line: 14, printed: {wire: 4480}}'
    described.file.write_text(
        f"{described.text}---\n{group}\naddressing: number * 64 + index - 1\npoints:\n{point}\n", "utf-8"
    )
    row = "| P70 [-01] | Fault | 4480 | R | | |\n"
    code, report = described.audit(OLD.replace("\nCooling needs", f"{row}\nCooling needs"))
    assert code == 0, [finding["reasons"] for finding in report["findings"]]


@pytest.mark.parametrize(
    ("old", "new", "kinds"),
    [
        ("a 1\nb 2\nc 3", "a 1\nb 2\nc 3", []),
        ("a 1 2", "a 12", ["changed"]),
        ("a 1 b 2", "a 1 b\n2", []),
        ("a b-<br>c 1<br>2", "a bc<br/>1 2", []),
        ("x -4", "x 4", ["changed"]),
        ("x 4 - 9", "x 4\u20139", []),
        ("one 1\ntwo 2\n", "one 1\nthree 3\ntwo 2\n", ["added"]),
        ("one 1\nthree 3\ntwo 2\n", "one 1\ntwo 2\n", ["removed"]),
        ("a b c d 1\ne f g h 2\ni j k l 3", "e f g h 2\ni j k l 3\na b c d 1", []),
    ],
)
def test_lines_of_two_texts(old: str, new: str, kinds: list[str]) -> None:
    assert [change.kind for change in Editions(old, new).changes] == kinds


@pytest.mark.full(seconds=4)
def test_a_large_change_costs_what_it_is_long(described: Described) -> None:
    """One change of 20,000 equal lines: each line asks nothing that was asked for the whole change."""
    (described.folder / "old.txt").write_text("x\n" * 20_000, "utf-8")
    before = time.process_time()
    code, _ = described.audit("y\n" * 20_000)
    assert code == 1
    assert time.process_time() - before < 20


def test_a_text_without_its_line_breaks_is_refused(described: Described, capsys: pytest.CaptureFixture[str]) -> None:
    files = ["--manual", str(described.folder / "new.txt"), "--old", str(described.folder / "old.txt")]
    (described.folder / "new.txt").write_text("Title\n" + "x " * 50_000, "utf-8")
    for more in ([], files[2:]):
        assert main(["audit", str(described.folder / "audited"), *files[:2], *more]) == 2
        assert "new.txt:2 has more than 20000 characters" in capsys.readouterr().err.replace("`", "")
