"""The audit: what a description cites is held against the text of its manual, also after the manual changed."""

from __future__ import annotations

import json
import os
from hashlib import sha256
from typing import TYPE_CHECKING, Any

import pytest
from fieldscribe.cli import main
from fieldscribe.resources import descriptions_dir

if TYPE_CHECKING:
    from pathlib import Path

MANUAL = """# Drive protocol

## Parameters

| Code | Title | Register | Range | Unit |
|------|-------|----------|-------|------|
| A001 | Base frequency | 1001h (4097) | 0-4000 | 0,1 Hz |
| A002 | Source         | 1002h (4098) | 0, 1, 3 |  |
|      | second source  | 1003h (4099) |       |  |

4.1 Speed limit

Type\tWord
ID\t57
Range\t5 to 17920, that is 0.02 Hz to 70 Hz
Formula\traw = f * 256

4.2 Reset word

ID\t58
Bits\tBit 0 reset, Bit 3 fault

A wrong checksum: 65 D3 is printed here.
"""

DEVICE = """fieldscribe: 1
device: audited
version: 1.0.0
vendor: Nobody
model: Drive
title: A drive
family: modbus
documents: {manual: {title: Manual, language: en, file: manual.txt, sha256: SHA}}
bus: {framings: [rtu], units: 1..9, functions: {3: read_holding_registers, 6: write_register}}
groups:
- group: main
  space: holding
  source: {document: manual, section: Parameters}
  points:
  - {code: A001, name: base_frequency, at: 1001h, range: 0..4000, scale: value = raw * 0.1, unit: Hz, line: 7}
  - {code: A002, name: frequency_source, at: 1002h, enum: {0: none, 1: keypad, 3: bus}, line: 8}
  - {name: second_source, at: 1003h, line: 9}
  - {name: speed_limit, at: 57, range: 5..17920, scale: raw = value * 256, unit: Hz, section: "4.1", line: 11}
  - {name: reset_word, at: 58, flags: {0: reset, 3: fault}, section: "4.2", line: 18}
"""


def audit(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], manual: str = MANUAL, device: str = DEVICE
) -> tuple[int, dict[str, Any]]:
    """Runs the command on a description of MANUAL against another text; exit code and the JSON report."""
    folder = tmp_path / "audited"
    folder.mkdir(exist_ok=True)
    digest = sha256(MANUAL.encode()).hexdigest()
    (folder / "device.yaml").write_text(device.replace("SHA", digest), encoding="utf-8")
    path = tmp_path / "manual.txt"
    path.write_text(manual, encoding="utf-8")
    code = main(["audit", str(folder), "--manual", str(path), "--report", "json"])
    return code, json.loads(capsys.readouterr().out)


def test_what_stands_where_it_is_cited_is_clean(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    code, found = audit(tmp_path, capsys)
    assert (code, found["missing"], found["moved"]) == (0, [], [])
    assert found["same_text"] is True


@pytest.mark.parametrize(
    ("old", "new", "missing"),
    [
        ("0-4000", "0-5000", [("base_frequency", "range", "4000", 7)]),
        ("1001h (4097)", "1011h (4113)", [("base_frequency", "address", "1001h", 7)]),
        ("0,1 Hz", "0,5 Hz", [("base_frequency", "scale", "1/10", 7)]),
        ("0, 1, 3", "0, 1, 2", [("frequency_source", "enum", "3", 8)]),
        ("f * 256", "f * 255", [("speed_limit", "scale", "256", 11)]),
        ("17920, that is 0.02 Hz to 70", "17664, that is 0.02 Hz to 69", [("speed_limit", "range", "17920", 11)]),
        ("Bit 3 fault", "Bit 4 fault", [("reset_word", "flags", "bit 3", 18)]),
    ],
)  # fmt: skip
def test_a_changed_fact_is_named_with_its_place(
    old: str,
    new: str,
    missing: list[tuple[str, str, str, int]],
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert MANUAL.count(old) == 1
    code, found = audit(tmp_path, capsys, MANUAL.replace(old, new))
    assert code == 1
    assert [(one["subject"], one["fact"], one["wanted"], one["line"]) for one in found["missing"]] == missing
    assert found["moved"] == []


def test_an_added_row_moves_what_follows_and_is_uncited(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    row = "| A009 | Added | 1009h (4105) | 0-9 | 1 s |\n"
    code, found = audit(tmp_path, capsys, MANUAL.replace("| A002", row + "| A002"))
    assert (code, found["missing"]) == (1, [])
    assert {(one["line"], one["now"]) for one in found["moved"]} == {(8, 9), (9, 10), (11, 12), (18, 19)}
    assert any(one["line"] == 8 and "A009" in str(one["text"]) for one in found["uncited"]) or any(
        one["line"] == 8 for one in found["unused_numbers"]
    )


def test_a_moved_section_is_found_where_it_stands_now(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    start, end = MANUAL.index("4.1 Speed"), MANUAL.index("4.2 Reset")
    moved = MANUAL[:start] + MANUAL[end:] + "\n" + MANUAL[start:end]
    code, found = audit(tmp_path, capsys, moved)
    assert (code, found["missing"]) == (1, [])
    places = {one["subject"]: one["now"] for one in found["moved"]}
    lines = moved.splitlines()
    assert lines[int(str(places["speed_limit"])) - 1].startswith("4.1")
    assert lines[int(str(places["reset_word"])) - 1].startswith("4.2")


def test_numbers_that_no_fact_uses_and_sections_that_none_cites(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    changed = MANUAL.replace("Bit 3 fault", "Bit 3 fault, Bit 7 ready") + "\n5.1 New chapter\n\nID\t99\n"
    code, found = audit(tmp_path, capsys, changed)
    assert code == 0
    assert ("7", 21) in {(one["number"], one["line"]) for one in found["unused_numbers"]}
    assert any("New chapter" in str(one["text"]) for one in found["uncited"])


ERRATUM = """errata:
- id: reset_title
  point: reset_word
  line: 18
  printed: The section is called "Reset word".
  taken: Reset and fault
  why: It has both bits.
  certainty: likely
"""


@pytest.mark.parametrize(("manual", "code"), [(MANUAL, 0), (MANUAL.replace("Reset word", "Reset bits"), 1)])
def test_errata_are_looked_for(manual: str, code: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    found_code, found = audit(tmp_path, capsys, manual, DEVICE + ERRATUM)
    assert found_code == code
    assert [one["erratum"] for one in found["errata_not_printed"]] == (["reset_title"] if code else [])


@pytest.mark.parametrize("form", ["text", "html"])
def test_other_reports_say_the_same(form: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    audit(tmp_path, capsys, MANUAL.replace("0-4000", "0-<b>5000"))
    assert main(["audit", str(tmp_path / "audited"), "--manual", str(tmp_path / "manual.txt"), "--report", form]) == 1
    said = capsys.readouterr().out
    assert "base_frequency" in said
    assert "4000" in said
    assert "<b>" not in said or form == "text"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--manual", "nowhere.txt"], "there is no file"),
        (["--manual", ""], "the path is empty"),
        (["--manual", "."], "holds no manual"),
    ],
)
def test_refusals(
    arguments: list[str],
    message: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    audit(tmp_path, capsys)
    (tmp_path / "empty").mkdir()
    monkeypatch.chdir(tmp_path / "empty")
    assert main(["audit", str(tmp_path / "audited"), *arguments]) == 2
    assert message in capsys.readouterr().err


DEVICES = sorted(path.parent.name for path in descriptions_dir().glob("*/device.yaml"))


@pytest.mark.parametrize("device", DEVICES)
def test_the_five_descriptions_cite_their_manuals_truly(device: str, capsys: pytest.CaptureFixture[str]) -> None:
    manuals = os.environ.get("FIELDSCRIBE_MANUALS")
    if not manuals:
        pytest.skip("set FIELDSCRIBE_MANUALS to the folder with the manuals' texts")
    code = main(["audit", device, "--manual", manuals])
    assert code == 0, capsys.readouterr().out
