"""A new edition of a manual: every line that differs with what cites it, new line numbers, and accepting it."""

from __future__ import annotations

import json
from hashlib import sha256
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.cli import main
from support.described import write

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
        """Compare the old edition with a new one; return exit code and report."""
        (self.folder / "new.txt").write_text(new, "utf-8")
        files = ["--manual", str(self.folder / "new.txt"), "--old", str(self.folder / "old.txt")]
        code = main(["audit", str(self.folder / "audited"), *files, "--format", "json", *arguments])
        return code, json.loads(self.capsys.readouterr().out)

    def audit_alone(self, new: str) -> dict[str, Any]:
        """Return the plain audit of one text."""
        (self.folder / "new.txt").write_text(new, "utf-8")
        main(["audit", str(self.folder / "audited"), "--manual", str(self.folder / "new.txt"), "--format", "json"])
        report: dict[str, Any] = json.loads(self.capsys.readouterr().out)
        return report


@pytest.fixture
def described(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Described:
    return Described(tmp_path, capsys)


def fallen(report: dict[str, Any]) -> list[str]:
    """The facts that do not stand in the new edition."""
    return [f"{fact['subject']}: {fact['fact']} {fact['says']}" for fact in report["facts_that_fell"]]


ACCESS = "target_temperature: access R/W"
CHANGES = [
    # old, new, the kinds of lines, the facts that fall
    ("200-550", "200-600", ["changed"], ["target_temperature: range 200..550"]),
    ("0011h", "0021h", ["changed"], ["target_temperature: address 0011h"]),
    ("Target temperature | 0011h | R/W", "Target temperature | 0011h | R", ["changed"], [ACCESS]),
    ("Target temperature | 0011h | R/W", "Target temperature | 0011h | ", ["changed"], [ACCESS]),
    ("0.1 °C |\n| H06", "0.1 K |\n| H06", ["changed"], ["hysteresis: unit °C"]),
    ("0.1 °C |\n| H06", "0.5 °C |\n| H06", ["changed"], ["hysteresis: scale 1/10"]),
    ("1 heating, 2 cooling", "1 cooling, 2 heating", ["changed"], ["mode: enum 1 = heating"]),
    ("0 off, ", "", ["changed"], ["mode: enum 0, 1, 2", "mode: enum 0"]),
    ("| H05 |", "| H07 |", ["changed"], ["hysteresis: code H05"]),
    ("01 95 18 30", "01 95 18 31", ["changed"], ["frame write_target: bytes 0106001101951830"]),
    ("2 cooling |", "2 cooling, 3 defrosting |", ["changed"], []),
    ("kit 4711", "kit 4712", ["changed"], []),
    ("Pin 2 plus\n", "", ["removed"], []),
    ("| H06", "| H09 | New | 0019h | R/W | 0-9 | 1 s |\n| H06", ["added"], []),
]  # fmt: skip


@pytest.mark.parametrize(
    ("old", "new", "kinds", "facts"), CHANGES, ids=[f"{old} > {new}"[:40] for old, new, *_ in CHANGES]
)
def test_a_changed_line_is_listed_with_the_facts_that_fall(
    old: str, new: str, kinds: list[str], facts: list[str], described: Described
) -> None:
    assert OLD.count(old) == 1
    code, report = described.audit(OLD.replace(old, new))
    assert [line["kind"] for line in report["lines"]] == kinds
    assert fallen(report) == facts
    assert (code, report["stands"]) == ((1, False) if facts else (0, True))
    listed = [
        f"{fact['subject']}: {fact['fact']} {fact['says']}"
        for fact in report["lines"][0]["facts"]
        if not fact["stands"]
    ]
    assert listed == facts


def test_a_removed_row_falls_with_all_its_facts_until_its_point_is_gone(described: Described) -> None:
    row = "| H05 | Hysteresis | 0015h | R/W | 1-50 | 0.1 °C |\n"
    new = OLD.replace(row, "")
    code, report = described.audit(new)
    [line] = report["lines"]
    assert (code, line["kind"], line["old_line"], line["old"]) == (1, "removed", 12, row.strip())
    assert {fact["subject"] for fact in line["facts"]} == {"hysteresis"}
    point = "- {code: H05, name: hysteresis, at: 0015h, range: 1..50, scale: value = raw * 0.1, unit: °C, line: 12}\n"
    described.edit(point, "")
    described.edit(" (line 12)", "")
    code, report = described.audit(new, "--renumber", "--accept", "--file", "new.txt")
    assert (code, report["refused"], fallen(report)) == (0, None, [])
    assert described.audit_alone(new)["clean"]


def test_each_line_says_what_cites_it_and_where(described: Described) -> None:
    _, report = described.audit(OLD.replace("200-550", "200-600"))
    [line] = report["lines"]
    assert (line["old_line"], line["new_line"], line["words"]) == (10, 10, [["200-550", "200-600"]])
    facts = {f"{fact['fact']} {fact['says']}": fact for fact in line["facts"]}
    assert {name: fact["stands"] for name, fact in facts.items()} == {
        "code H02": True, "address 0011h": True, "access R/W": True, "range 200..550": False, "scale 1/10": True,
        "unit °C": True,
    }  # fmt: skip
    place = facts["range 200..550"]["place"]
    assert place.startswith(f"{described.file}:{described.line_of('range: 200..550')}:")


def test_lines_that_no_fact_cites_are_counted(described: Described) -> None:
    row = "| H09 | New | 0019h | R/W | 0-9 | 1 s |\n"
    code, report = described.audit(OLD.replace("| H06", row + "| H06").replace("Pin 2", "Pin 3"))
    assert (code, report["counts"]["without_facts"]) == (0, 2)
    assert [line["facts"] for line in report["lines"]] == [[], []]


def test_a_fact_does_not_stand_in_a_row_that_was_added_below(described: Described) -> None:
    row = "| H09 | Other | 0019h | R/W | 3-30 | s |\n"
    _, report = described.audit(OLD.replace("| 3-30 |", "| 5-30 |").replace("\nCooling", f"{row}\nCooling"))
    assert fallen(report) == ["pump_delay: range 3..30"]


def test_a_moved_line_is_no_change_of_its_facts(described: Described) -> None:
    frames = OLD[OLD.index("Setting 40.5") : OLD.index("\n\n## Wiring")]
    code, report = described.audit(OLD.replace(frames, "") + frames + "\n")
    assert (code, [line["kind"] for line in report["lines"]], fallen(report)) == (0, ["moved"], [])


def test_an_erratum_whose_text_is_gone_is_named(described: Described) -> None:
    code, report = described.audit(OLD.replace("Vorlauf-Temperatur", "Vorlauftemperatur").replace("0061h", "0016h"))
    assert (code, report["errata_not_printed"]) == (1, ["pump_delay_register", "flow_word"])


def test_lines_are_renumbered_and_nothing_else(described: Described) -> None:
    """Five lines more at the top: then the plain audit finds nothing, and the edition is accepted."""
    new = "One.\n\n\n\nFive.\n" + OLD
    before = described.text
    code, report = described.audit(new, "--renumber")
    assert (code, report["counts"]["to_renumber"]) == (0, 0)
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
    described.edit("lines: 6..8", "lines: [1, 5, 6..8]")
    assert described.audit_alone(new)["clean"]
    assert described.audit(new, "--renumber")[1]["written"] == ["renumbered: 0 lines in 0 files"]
    recorded = described.text.replace(sha256(OLD.encode()).hexdigest(), sha256(new.encode()).hexdigest())
    code, report = described.audit(new, "--accept", "--file", "new.txt")
    assert (code, report["refused"]) == (0, None)
    assert described.text == recorded.replace("file: old.txt", "file: new.txt")
    assert described.audit_alone(new)["same_text"] is True


def test_what_was_looked_through_takes_in_no_new_lines(described: Described) -> None:
    described.edit("21..23, why: Wiring.}\n- {lines: 24,", "21..24,")
    described.audit(OLD.replace("Pin 2", "Pin 3 earth\nPin 2"), "--renumber")
    assert "lines: [21..23, 25..25], why: Wiring." in described.text


@pytest.mark.parametrize("added", ["A foreword.\n", "A foreword.\n" * 26])
def test_a_point_that_was_added_before_renumbering_counts_the_new_lines(added: str, described: Described) -> None:
    row = "| H09 | Night setback | 0019h | R | 0-100 | 0.5 °C |\n"
    new = added + OLD.replace("| H06", row + "| H06")
    line = new[: new.index(row)].count("\n") + 1
    point = "{code: H09, name: night_setback, at: 0019h, access: r, range: 0..100, scale: value = raw * 0.5, unit: °C"
    described.file.write_text(f"{described.text}- {point}, line: {line}}}\n", "utf-8")
    code, report = described.audit(new, "--renumber")
    assert (code, fallen(report)) == (0, [])
    assert described.text.endswith(f"line: {line}}}\n")


def test_nothing_is_renumbered_where_a_cited_line_is_gone(described: Described) -> None:
    (described.folder / "new.txt").write_text(OLD.replace(OLD.splitlines()[11] + "\n", ""), "utf-8")
    before = described.text
    files = ["--manual", str(described.folder / "new.txt"), "--old", str(described.folder / "old.txt")]
    assert main(["audit", str(described.folder / "audited"), *files, "--renumber"]) == 1
    assert "line 12 is gone" in described.capsys.readouterr().err
    assert described.text == before


REFUSALS = [
    (OLD.replace("200-550", "200-600"), ("--accept",), "not every cited fact stands in the new edition"),
    (OLD.replace("0061h", "0016h"), ("--accept",), "not every cited fact stands in the new edition"),
    ("x\n" + OLD, ("--accept", "--file", "new.txt"), "add --renumber"),
    ("x\n" + OLD, ("--renumber", "--accept"), "file is `old.txt`, the new text is `new.txt`: give --file new.txt, or"),
    ("x\n" + OLD, ("--renumber", "--accept", "--file", "n", "--edition", "2"), "documents.manual has no `edition`"),
    ("x\n" + OLD, ("--renumber", "--accept", "--file", "old.txt"), None),
]


@pytest.mark.parametrize(("new", "arguments", "refused"), REFUSALS)
def test_accepting(new: str, arguments: tuple[str, ...], refused: str | None, described: Described) -> None:
    code, report = described.audit(new, *arguments)
    assert code == (0 if refused is None else 1)
    assert (report["refused"] is None) == (refused is None)
    assert refused is None or refused in report["refused"]
    assert (sha256(new.encode()).hexdigest() in described.text) == (refused is None)


def test_accepting_names_what_is_left_to_look_at(described: Described) -> None:
    row = "| H09 | New | 0019h | R/W | 0-9 | 1 s |\n"
    code, report = described.audit(OLD.replace("| H06", row + "| H06"), "--renumber", "--accept", "--file", "old.txt")
    assert (code, report["refused"]) == (0, None)
    assert report["written"][2:] == [
        "look at them: 1 line that differs, which no fact cites",
        "look at them: 1 finding of `fieldscribe audit` in the new text alone",
    ]


def test_the_printed_edition_is_asked_for_and_recorded(described: Described) -> None:
    described.edit("file: old.txt", 'edition: "2024-03", file: old.txt')  # in flow, with a comment after it
    code, report = described.audit(OLD + "x\n", "--accept", "--file", "old.txt")
    assert code == 1
    assert "edition is `2024-03`: give --edition" in report["refused"]
    given = ("--file", "new.txt", "--edition", "2025: the second")
    assert described.audit(OLD + "x\n", "--accept", *given)[0] == 0
    assert 'edition: "2025: the second", file: new.txt, sha256:' in described.text
    assert described.audit(OLD + "x\n", "--accept")[0] == 0  # what is recorded is not asked for again


@pytest.mark.parametrize("given", [("--file", "a/b.txt"), ("--edition", " "), ("--edition", "2" * 81)])
def test_what_cannot_be_recorded_is_refused(given: tuple[str, str], described: Described) -> None:
    before = described.text
    files = ["--manual", str(described.folder / "old.txt"), "--old", str(described.folder / "old.txt")]
    assert main(["audit", str(described.folder / "audited"), *files, "--accept", *given]) == 2
    assert main(["audit", str(described.folder / "audited"), *files, *given]) == 2
    assert described.text == before


def test_texts_in_the_wrong_order_are_noticed(described: Described) -> None:
    (described.folder / "new.txt").write_text(OLD.replace("200-550", "200-600"), "utf-8")
    files = ["--manual", str(described.folder / "old.txt"), "--old", str(described.folder / "new.txt")]
    main(["audit", str(described.folder / "audited"), *files])
    assert "old.txt is the text that the description records" in described.capsys.readouterr().out


LIMITS = [
    ("\n" * 4_000_000, "has more than 100000 lines"),
    ("7\n" * 100_000 + "7 " * 9_000 * 50, "has more than 200000 numbers"),
    ("Title\n" + "x " * 50_000, "has more than 20000 characters in a line"),
    ("\x00\udcff", "is no text in UTF-8"),
]


@pytest.mark.parametrize(("text", "message"), LIMITS, ids=[message for _, message in LIMITS])
def test_a_text_beyond_a_limit_is_refused(text: str, message: str, described: Described) -> None:
    (described.folder / "new.txt").write_bytes(text.encode("utf-8", "surrogateescape"))
    files = ["--manual", str(described.folder / "new.txt"), "--old", str(described.folder / "old.txt")]
    for more in ([], files[2:]):
        assert main(["audit", str(described.folder / "audited"), *files[:2], *more]) == 2
        assert message in described.capsys.readouterr().err


@pytest.mark.parametrize(
    "text", ["", "\x00\x01\x02", "9" * 5000, "|" * 3000 + "\n" + "\t" * 3000, "1 2 3 4 5 6 7\n" * 9000]
)
def test_strange_texts_have_findings_and_no_traceback(text: str, described: Described) -> None:
    assert not described.audit_alone(text)["clean"]
    assert described.audit(text)[0] == 1
