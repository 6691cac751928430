"""The audit: what a description cites is held against the text of its manual, also after the manual changed."""

from __future__ import annotations

import json
import os
from hashlib import sha256
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.audit.manual import Manual, has_word
from fieldscribe.cli import main
from fieldscribe.families.modbus.frames import crc16
from support.described import SHIPPED, group, head, together, write
from support.places import has_text
from support.quick import full_but

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

DOCUMENTS = """
  manual:
    {title: Manual, language: en, file: manual.txt, sha256: SHA,
     writes: {P: [Parameter], 15..8: [Highbyte], 0: [zero]}}"""
POINTS = """\
- {code: A001, name: base_frequency, at: 1001h, range: 0..4000, scale: value = raw * 0.1, unit: Hz, line: 7}
- {code: A002, name: frequency_source, at: 1002h, enum: {0: none, 1: keypad, 3: bus}, line: 8}
- {name: second_source, at: 1003h, line: 9}
- {name: speed_limit, at: 57, range: 5..17920, scale: raw = value * 256, unit: Hz, section: "4.1", line: 11,
   printed: {range_in_units: 0.02..70}}
- {name: reset_word, at: 58, flags: {0: reset, 3: fault}, section: "4.2", line: 18}
"""
BUS = "{framings: [rtu], units: 1..9, functions: {3: read_holding_registers, 6: write_register}}"
DEVICE = together(
    head(device="audited", documents=DOCUMENTS, bus=BUS) + "looked_through: [{lines: 23, why: A remark.}]\n",
    group(POINTS, source="{document: manual, section: Parameters}"),
)


def audit(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], manual: str = MANUAL, device: str = DEVICE, was: str = MANUAL
) -> tuple[int, dict[str, Any]]:
    """Runs the command on a description of a text (`was`) against another one; exit code and the JSON report."""
    folder = tmp_path / "audited"
    digest = sha256(was.encode()).hexdigest()
    write(folder, device.replace("SHA", digest))
    path = tmp_path / "manual.txt"
    path.write_text(manual, encoding="utf-8")
    code = main(["audit", str(folder), "--manual", str(path), "--report", "json"])
    return code, json.loads(capsys.readouterr().out)


def test_what_stands_where_it_is_cited_is_clean(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    code, found = audit(tmp_path, capsys)
    assert (code, found["missing"]) == (0, [])
    assert found["same_text"] is True


@pytest.mark.parametrize("form", ["text", "json", "html"])
def test_a_description_with_an_error_is_not_audited(
    form: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Its findings come as lines for people, or as JSON where that was asked for."""
    wrong = DEVICE.replace("unit: Hz, line: 7", "unit: Hertz, line: 7").replace("SHA", "a" * 64)
    place = write(tmp_path / "audited", wrong)
    assert main(["audit", str(place.parent), "--manual", "none.txt", "--report", form]) == 1
    printed = capsys.readouterr()
    if form == "json":
        assert [one["rule"] for one in json.loads(printed.out)["findings"]] == ["unknown-unit"]
    else:
        assert (printed.out + printed.err).lstrip().startswith("error[unknown-unit]: ")


@pytest.mark.parametrize(
    ("old", "new", "missing"),
    [
        ("0-4000", "0-5000", [("base_frequency", "range", "0..4000", 7)]),
        ("1001h (4097)", "1011h (4113)", [("base_frequency", "address", "1001h", 7)]),
        ("0,1 Hz", "0,5 Hz", [("base_frequency", "scale", "1/10", 7)]),
        ("0, 1, 3", "0, 1, 2", [("frequency_source", "enum", "3", 8)]),
        ("f * 256", "f * 255", [("speed_limit", "scale", "256", 11)]),
        ("5 to 17920", "5 to 17664", [("speed_limit", "range", "5..17920", 11)]),
        ("Bit 3 fault", "Bit 4 fault", [("reset_word", "flags", "bit 3", 18)]),
    ],
)  # fmt: skip
def test_a_changed_fact_is_named_with_its_place(
    old: str, new: str, missing: list[tuple[str, str, str, int]], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert MANUAL.count(old) == 1
    code, found = audit(tmp_path, capsys, MANUAL.replace(old, new))
    assert code == 1
    assert [(one["subject"], one["fact"], one["wanted"], one["line"]) for one in found["missing"]] == missing


@pytest.mark.parametrize("letter", "AP")
def test_an_added_code_among_cited_ones_is_found(
    letter: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Also one that is no number: `A009` may be hexadecimal, `P009` is not."""
    manual, device = (text.replace("A00", f"{letter}00") for text in (MANUAL, DEVICE))
    was = manual.replace("second source ", f"as {letter}001     ")
    added = f"| {letter}009 | Added | 1009h (4105) | 0-9 | 1 s |\n\n4.1 Speed"
    assert audit(tmp_path, capsys, was, device, was)[1]["unused_numbers"] == []
    code, found = audit(tmp_path, capsys, was.replace("4.1 Speed", added), device, was)
    assert code == 1
    assert f"{letter}009" in [one["number"] for one in found["unused_numbers"]]


def test_one_fact_in_two_notations_is_reported_once(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    device = DEVICE.replace("unit: Hz, line: 7}", "unit: Hz, line: 7, printed: {wire: [1001h, 4097]}}")
    assert device != DEVICE
    code, found = audit(tmp_path, capsys, MANUAL.replace("1001h (4097)", "1005h (4101)"), device)
    assert code == 1
    facts = [one["fact"] for one in found["missing"] if one["subject"] == "base_frequency"]
    assert facts.count("printed wire") == 1


def test_numbers_that_no_fact_uses_and_sections_that_none_cites(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    changed = MANUAL.replace("Bit 3 fault", "Bit 3 fault, Bit 7 ready") + "\n5.1 New chapter\n\nID\t99\n"
    code, found = audit(tmp_path, capsys, changed)
    assert code == 1
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


@pytest.mark.parametrize("form", ["text", "html", "json"])
def test_the_name_of_a_manual_reaches_no_report_raw(
    form: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    audit(tmp_path, capsys)
    evil = tmp_path / "manual\x1b]0;owned\x07\u202e.txt"
    (tmp_path / "manual.txt").rename(evil)
    assert main(["audit", str(tmp_path / "audited"), "--manual", str(evil), "--report", form]) == 0
    said = capsys.readouterr().out
    assert "owned" in said
    assert not {"\x1b", "\x07", "\u202e"} & set(said)


def test_a_description_cannot_name_a_manual_outside_the_folder_that_was_given(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    audit(tmp_path, capsys, device=DEVICE.replace("file: manual.txt", "file: ../manual.txt"))
    (tmp_path / "empty").mkdir()
    assert main(["audit", str(tmp_path / "audited"), "--manual", str(tmp_path / "empty")]) == 2
    assert "name the file itself: the description names none" in capsys.readouterr().err
    (tmp_path / "short.txt").write_text("1\n", "utf-8")
    assert main(["audit", str(tmp_path / "audited"), "--manual", str(tmp_path / "short.txt")]) == 1
    assert "`short.txt` has 1 line, and facts cite line 18" in capsys.readouterr().err


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


@pytest.mark.parametrize("form", ["text", "html", "json"])
def test_a_description_that_cites_no_line_is_not_clean(
    form: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write(tmp_path / "plant", together(head(device="plant"), group("- {name: speed, at: 1}\n")))
    (tmp_path / "manual.txt").write_text(MANUAL)
    assert main(["audit", str(tmp_path / "plant"), "--manual", str(tmp_path / "manual.txt"), "--report", form]) == 1
    wanted = '"clean": false' if form == "json" else "o fact cites a line of the manual, so nothing was compared"
    assert wanted in capsys.readouterr().out


@pytest.mark.parametrize("device", full_but(("jumo_controller", "siemens_mm4"), SHIPPED))
def test_the_descriptions_cite_their_manuals_truly(device: str, capsys: pytest.CaptureFixture[str]) -> None:
    manuals = os.environ.get("FIELDSCRIBE_MANUALS")
    if not manuals:
        pytest.skip("set FIELDSCRIBE_MANUALS to the folder with the manuals' texts")
    if not has_text(device, Path(manuals)):
        pytest.skip(f"{manuals} has no text of {device}")
    code = main(["audit", device, "--manual", manuals])
    assert code == 0, capsys.readouterr().out


def test_a_chapter_is_what_the_contents_list() -> None:
    manual = Manual(
        "1\tGeneral\t3\n2\tThe telegram.....\t4\n\n1 General\n\n1 reads\n2 writes\n\n2 The telegram\nNr\t69\n"
    )
    assert manual.headings == [4, 9]
    assert manual.line_of_section == {"1": 4, "2": 9}
    assert (manual.section_around(10).first, manual.section_around(10).last) == (9, 10)


MORE = """
4.3 Delay of inputs

ID\t70
Delay\t0000 to 2222
0\t100 ms
1\t200 ms
2\t5 s

4.4 Source

ID\t71
Highbyte: source, Bit 7 to Bit 3 are always zero, Bit 0 = 0 => off, Bit 0 = 1 => on

4.5 Fault text 12

16 characters: ID 90 and ID 91, ID 92, ID 93, ID 94, ID 95, ID 96, ID 97
"""
MORE_POINTS = """\
- {name: input_delay, at: 70, digits: {count: 4, enum: delay}, section: "4.3", line: 26, printed: {range: 0..2222}}
- {name: source, at: 71, bits: 15..8, fixed: {7..3: 0}, section: "4.4", line: 34}
- {name: source_logic, at: 71, bits: 0, flags: {0: {name: active, zero: "off", one: "on"}}, section: "4.4", line: 34}
- {name: fault_text, at: 97..90, type: text, characters: 16, access: r, section: "4.5", line: 39}
enums:
  delay:
    0: {name: ms_100, quantity: 100 ms}
    1: {name: ms_200, quantity: 200 ms}
    2: {name: s_5, quantity: 5 s}
"""


@pytest.mark.parametrize(
    ("old", "new", "missing"),
    [
        ("", "", []),
        ("200 ms", "250 ms", ["enum 1 = 200 ms"]),
        ("2\t5 s", "3\t5 s", ["enum 2 = 5 s"]),
        ("Bit 3 are", "Bit 4 are", ["fixed bits 3"]),
        ("always zero", "always one", []),  # the 0 of bit 0 stands there too
        ("Bit 0 = 1 => on", "else on", ["flag values active 1"]),
        ("Highbyte", "Upper byte", ["bits 8", "bits 15"]),
        ("16 characters", "18 characters", ["characters 16"]),
        ("ID 94", "ID 99", ["address 94"]),
    ],
)
def test_what_stands_in_words_and_lists_is_looked_for(
    old: str, new: str, missing: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = MANUAL + MORE
    assert old == "" or text.count(old) == 1
    _, found = audit(tmp_path, capsys, text.replace(old, new) if old else text, DEVICE + MORE_POINTS, text)
    assert [f"{one['fact']} {one['wanted']}" for one in found["missing"]] == missing
    if not old:
        assert [one["number"] for one in found["unused_numbers"] if int(str(one["line"])) > 25] == []


COLUMNS = """
4.6 State word

ID\t72
0\t0\tDrive off\tDrive off at standstill
\t1\tDrive on\t-
1\t0\tPump off\t-
\t1\tPump on\t-
2\t0\tFan off\tNot 0 while hot, nor 3
\t1\tFan on\t-
3\t0\tLamp off\tPanel
\t1\t\t-
"""
COLUMNS_POINTS = """\
- name: state_word
  at: 72
  section: "4.6"
  line: 26
  flags:
    0: {name: drive, zero: {en: Drive off}, one: {en: Drive on}}
    1: {name: pump, zero: {en: Pump off}, one: {en: Pump on}}
    2: {name: fan, zero: {en: Fan off}, one: {en: Fan on}}
    3: {name: lamp, zero: {en: Lamp off}, one: lamp_on}
"""


@pytest.mark.parametrize(
    ("old", "new", "missing"),
    [
        ("", "", []),
        ("\tFan off\t", "\tFan out\t", ["0 = Fan off"]),
        ("0\tPump off", "3\tPump off", ["0 = Pump off"]),
        ("Pump off\t-\n", "Pump off\t-\tmore\n", []),
    ],
)
def test_lists_keep_to_their_columns_and_rows(
    old: str, new: str, missing: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = MANUAL + COLUMNS
    assert old == "" or text.count(old) == 1
    _, found = audit(tmp_path, capsys, text.replace(old, new) if old else text, DEVICE + COLUMNS_POINTS)
    assert [one["wanted"] for one in found["missing"]] == missing


SPLIT = """
4.3 Rule

Set P 601 first; Parameter 103 and P740[2] come later.
Address: $1001\\_10_{\\text{bin}}$

4.4 Lost table

Its numbers are 9,
10 and 12.

4.5 Wiring

Pin\t1\tshield
Pin\t2\tplus
"""
SPLIT_POINTS = """\
- {code: P601, name: p601, at: 601, type: ~, section: "4.3", line: 27}
- {code: P103, name: p103, at: 103, type: ~, line: 27}
- {code: "P740[2]", name: p740_2, at: ~, type: ~, line: 27}
- {name: rule, at: 38, line: 28, printed: {wire: "0b100110"}}
- {name: later, at: 0009h, line: 32}
looked_through:
- {lines: 35..38, why: Wiring.}
"""
SPAN = """errata:
- {id: lost, point: later, line: LINE, printed: The numbers are 9 and 12., taken: "9", why: First., certainty: likely}
"""


@pytest.mark.parametrize(
    ("old", "new", "missing"),
    [
        ("", "", []),
        ("P 601", "Q 601", ["p601 code P601"]),
        ("P 601", "P 6012", ["p601 code P601"]),
        ("Parameter 103", "page 103", ["p103 code P103"]),
        ("_10_", "_11_", ["rule address 0026h", "rule printed wire 38"]),
    ],
)
def test_codes_and_split_numbers(
    old: str, new: str, missing: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = MANUAL + SPLIT
    assert old == "" or text.count(old) == 1
    _, found = audit(tmp_path, capsys, text.replace(old, new) if old else text, DEVICE + SPLIT_POINTS)
    assert [f"{one['subject']} {one['fact']} {one['wanted']}" for one in found["missing"]] == missing


def test_what_was_looked_through_is_not_uncited(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    _, found = audit(tmp_path, capsys, MANUAL + SPLIT, DEVICE + SPLIT_POINTS)
    assert [one for one in found["uncited"] if int(str(one["line"])) >= 35] == []
    described = DEVICE + SPLIT_POINTS.partition("looked_through")[0]
    _, found = audit(tmp_path, capsys, MANUAL + SPLIT, described)
    rows = [(one["line"], one["last"]) for one in found["uncited"]]
    assert rows[-2:] == [(35, 35), (37, 38)]  # rows that follow each other are one finding


@pytest.mark.parametrize(("pages", "unused"), [("12 13 14", []), ("12 14 13", [12, 14, 13]), ("12 13", [12, 13])])
def test_numbers_of_pages_are_no_facts(
    pages: str, unused: list[int], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = MANUAL + "".join(f"\nDrive manual\tPage {number}\n" for number in pages.split())
    _, found = audit(tmp_path, capsys, text)
    assert [int(one["number"]) for one in found["unused_numbers"]] == unused


@pytest.mark.parametrize(("line", "absent"), [("7", ["lost"]), ("32..33", []), ("7, lines: {printed: 32..33}", [])])
def test_an_erratum_may_span_lines(
    line: str, absent: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    errata = SPAN.replace("LINE", line)
    _, found = audit(tmp_path, capsys, MANUAL + SPLIT, DEVICE + SPLIT_POINTS + errata)
    assert [one["erratum"] for one in found["errata_not_printed"]] == absent


FRAME = """
frames:
- name: write
  direction: request
  bytes: 01 06 10 01 01 90 CRC
  says: {A001: 40.0}
  line: 26
  lines: {printed: 25..25}
"""


@pytest.mark.parametrize(("value", "missing"), [("40 Hz", []), ("41 Hz", ["frame write says 40"])])
def test_what_a_frame_says_stands_where_it_is_cited(
    value: str, missing: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    check = crc16(bytes.fromhex("01 06 10 01 01 90")).to_bytes(2, "little").hex(" ").upper()
    text = f"{MANUAL}\nThe frequency of {value}\n01 06 10 01 01 90 {check}\n"
    _, found = audit(tmp_path, capsys, text, DEVICE + FRAME.replace("CRC", check), text)
    assert [f"{one['subject']} {one['fact']} {one['wanted']}" for one in found["missing"]] == missing


@pytest.mark.parametrize(
    ("text", "word", "stands"),
    [
        ("A1", "A1", True),
        ("see A1.", "A1", True),
        ("XA1", "A1", False),
        ("A1X", "A1", False),
        ("A12", "A1", False),
        ("XA1 A1", "A1", True),
        ("A1A1 A1", "A1", True),
        ("4.2.10", "4.2.1", False),
        ("4.2.10 4.2.1", "4.2.1", True),
        ("", "A1", False),
    ],
)
def test_a_word_stands_by_itself(text: str, word: str, stands: bool) -> None:
    assert has_word(text, word) is stands


def test_a_section_ends_before_the_next_that_is_not_its_own() -> None:
    manual = Manual("1.1 A\n\ntext\n1.1.1 B\ntext\n1.2 C\ntext\n")
    assert {number: manual.end_of_section(number) for number in manual.line_of_section} == {
        "1.1": 5,
        "1.1.1": 5,
        "1.2": 7,
    }


@pytest.mark.parametrize(("distance", "missing"), [(1, []), (400, []), (401, [("far", "section")])])
def test_a_section_without_a_number_is_searched_above(
    distance: int, missing: list[tuple[str, str]], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    lines = [*MANUAL.splitlines(), "Appendix", *["A line."] * (distance - 1), "ID 1234"]
    points = f"- {{name: far, at: 1234, section: Appendix, line: {len(lines)}}}\n"
    _, found = audit(tmp_path, capsys, "\n".join(lines) + "\n", DEVICE + points)
    assert [(one["subject"], one["fact"]) for one in found["missing"]] == missing


def test_a_number_of_thousands_of_digits_means_nothing(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    _, found = audit(tmp_path, capsys, MANUAL + "9" * 5000 + "\n")
    assert (found["missing"], [one["line"] for one in found["unused_numbers"]]) == ([], [24])
