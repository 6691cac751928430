"""`import table`: whole files of each format to drafts, the options, and wrong calls."""

from __future__ import annotations

import re
import sys
from typing import TYPE_CHECKING

import pytest
from fieldscribe.cli import main
from fieldscribe.importing.draft_text import DraftPoint

if TYPE_CHECKING:
    from pathlib import Path

NASTY = """\
Adresse;Bezeichnung;Datentyp;Zugriff;Einheit;Auflösung;Bereich;Werkseinstellung;Bemerkung
;Zähler;;;;;;;
1-16;Eingänge;BOOL;R;;;;;
-5;Drehzahl;INT16;R;1/min;1;;;
40001-40002;Energie;UINT32;R;kWh;0,1;0..999999;;
0x0010;Modus;UINT16;R/W;;;0-2;7;"0 = aus, 1 = an; 2 = auto"
;;;;;;;;
1Ah;Drehzahl;INT32;vielleicht;Hz;x 10;;20;
400001;Leistung;INT;R;W;;;;
;;;;;;Motordaten;;
17;Strom;;R;A;0,01;0,00-100,00;;
17;Strom 2;;R;A;Schritt;0..5 Wurst;;
27;Drehmoment;UINT16;R;;;;;
"""
NASTY_DRAFT = """\
# A draft of 9 points from tables, with 16 questions at points: settle what `# ?` asks, then take it out.
# ? titles are in the manual's language (de): give English names and titles
group: points
title: {en: Points, de: Points}
space: holding
# ? not every row prints an access; without the key it is rw
source: {document: manual, section: Points}
# ? line 2 is no point: Zähler
# ? nothing names the space: is it holding?
points:
- name: eingaenge
  title: {en: Eingänge, de: Eingänge}
  at: ~
  access: r
  type: ~
  line: 3
  # ? which is the address: 1-16?
  # ? type: bit? `bit` does not fit the space `holding`, which holds 16-bit words
- name: drehzahl
  title: {en: Drehzahl, de: Drehzahl}
  at: ~
  access: r
  type: s16
  unit: 1/min
  line: 4
  # ? which is the address: -5?
- name: energie
  title: {en: Energie, de: Energie}
  at: ~
  access: r
  type: u32
  scale: value = raw * 0.1
  unit: kWh
  line: 5
  # ? which is the address: 40001-40002?
  # ? is the range 0..999999 raw, or in the unit?
- name: modus
  title: {en: Modus, de: Modus}
  at: 0010h
  access: rw
  type: u16
  range: 0..2
  enum:
    0: {name: aus, en: aus, de: aus}
    1: {name: an, en: an, de: an}
    2: {name: auto, en: auto, de: auto}
  line: 6
  # ? default: 7? the default 7 cannot be written: the range does not allow its raw number 7
- name: drehzahl_26
  title: {en: Drehzahl, de: Drehzahl}
  at: 001Ah
  type: s32
  scale: ~
  unit: Hz
  line: 8
  # ? which access is `vielleicht`?
  # ? what is one raw step worth? Printed is `x 10`
  # ? is the default 20 raw, or in the unit?
- name: leistung
  title: {en: Leistung, de: Leistung}
  at: ~
  access: r
  type: ~
  unit: W
  line: 9
  # ? which type is `INT`?
  # ? line 10 is no point: Motordaten
  # ? at: 400001? the address 400001 lies outside 0..65535
- name: strom
  title: {en: Strom, de: Strom}
  at: 17
  access: r
  range_in_units: 0..100
  scale: value = raw * 0.01
  unit: A
  line: 11
- name: strom_2
  title: {en: Strom 2, de: Strom 2}
  at: ~
  access: r
  unit: A
  line: 12
  # ? which step is `Schritt`?
  # ? which range is `0..5 Wurst`?
  # ? at: 17? `Strom` at line 11 has the same address
- name: drehmoment
  title: {en: Drehmoment, de: Drehmoment}
  at: ~
  access: r
  type: u16
  line: 13
  # ? at: 27? `drehmoment` and `drehzahl_26` both stand at holding 27 (001Bh)
"""


def write(folder: Path, name: str, text: str) -> str:
    """Return the path of a file with this text."""
    (folder / name).write_text(text, "utf-8")
    return str(folder / name)


def points(text: str) -> dict[str, list[str]]:
    """Return the lines of each point of a draft, by its code or else its name."""
    blocks = [block.split("\n---")[0].splitlines() for block in re.split(r"\n- (?:name|code): ", text)[1:]]
    return {first: lines for first, *lines in blocks}


def test_what_is_not_clear_becomes_a_question(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["import", "table", write(tmp_path, "nasty.csv", NASTY), "--language", "de"]) == 0
    assert capsys.readouterr().out == NASTY_DRAFT


MANUAL = """\
# Drive

| Gruppe A | | | | | | | |
|---|---|---|---|---|---|---|---|
| Fkt.-Nr | Funktion | R/W | Beschreibung | Netzwerkdaten | | | |
|  |  |  |  | Reg. (hex) | Reg. (dez) | Bereich | Auflösung |
| A001 | Quelle | R/W | 00 .. Poti<br>01 .. Klemme | 1019h/<br>1018h | 4121/<br>4120 | 0, 1, 2 | — |
| F002 (high) | Hochlaufzeit | R/W | 0,01 - 3000 s | 1014h/<br>1013h | 4116/<br>4115 | 1-<br>300000 | 0,01 s |
| Fkt.-Nr | Funktion | R/W | Beschreibung | Netzwerkdaten | | | |
| F004 | Richtung | R |  | 1018h/<br>1017h | 4120/<br>4219 | 0-1 | — |
| F005 | Frequenz | R | 0,0 - 400,0 Hz | h |  | 0-4000 | 0,1 Hz |

Sonstiges:

| Nr. | Feld | Beispiel (Hex) |
|---|---|---|
| 1 | Wert 3 | 03 |
"""
PAGE = """<h2>Input registers</h2><table>
<tr><th rowspan=2>Code<th colspan=2>Address<th rowspan=2>Parameter<th rowspan=2>Access</tr>
<tr><th>Reg. hex<th>Reg. dec</tr>
<tr><td>P01.00<td>0100<td>256<td>Accel time<td rowspan=2>R</tr>
<tr><td>P01.01<td>0101H<td>257<td>Source<table><tr><td>00 (keypad)</table></tr>
<tr><td>P01.02<td>0102<td>259<td>Sink</table>"""
SHEETS = "4.2 Parameters\n\n4.2.1 Speed limit\n\nType\tWord\nID\t57\nRange\t5 to 17920\nFormula\traw = value * 256\n"


def test_one_number_of_an_address_cell_is_chosen(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = write(tmp_path, "drive.txt", MANUAL)
    assert main(["import", "table", path, "--address-part", "2"]) == 0
    out, err = capsys.readouterr()
    assert "group: gruppe\ntitle: {en: Gruppe A}\n" in out
    assert err == "1 table holds no points and is left out (line 15); `--list` shows them\n"
    drafted = points(out)
    assert list(drafted) == ["A001", "F002 (high)", "F004", "F005"]
    assert drafted["A001"] == [
        "  name: quelle",
        "  title: {en: Quelle}",
        "  at: 1018h",
        "  access: rw",
        "  range: 0, 1, 2",
        "  enum:",
        "    0: {name: poti, en: Poti}",
        "    1: {name: klemme, en: Klemme}",
        "  line: 7",
    ]
    assert drafted["F002 (high)"][2:] == [
        "  at: 1013h",
        "  access: rw",
        "  scale: value = raw * 0.01",
        "  unit: s",
        "  line: 8",
        "  # ? is the range 1- 300000 raw, or in the unit?",
    ]
    assert drafted["F004"][2:] == [
        "  at: ~",
        "  range: 0..1",
        "  line: 10",
        "  # ? which is the address: 1018h/ 1017h | 4120/ 4219?",
    ]
    assert "  # ? which is the address: h?" in drafted["F005"]
    assert main(["import", "table", path]) == 0
    assert "  # ? which is the address: 1019h/ 1018h | 4121/ 4120?" in points(capsys.readouterr().out)["A001"]


def test_ranges_are_raw_or_in_units_as_the_user_says(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = write(tmp_path, "drive.txt", MANUAL)
    assert main(["import", "table", path, "--ranges", "raw"]) == 0
    drafted = points(capsys.readouterr().out)
    assert "  range: 0..4000" in drafted["F005"]
    assert "  # ? range: 1..300000? 300000 lies outside the type, which holds 0..65535" in drafted["F002 (high)"]
    assert main(["import", "table", path, "--ranges", "units"]) == 0
    assert "  range_in_units: 0..4000" in points(capsys.readouterr().out)["F005"]


def test_a_page_with_merged_cells(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["import", "table", write(tmp_path, "page.html", PAGE)]) == 0
    out = capsys.readouterr().out
    assert "group: input_registers\ntitle: {en: Input registers}\nspace: input\n# ? not every row" in out
    drafted = points(out)
    assert drafted["P01.00"][1:] == ["  title: {en: Accel time}", "  at: 0100h", "  access: r", "  line: 4"]
    assert drafted["P01.01"][1:] == ["  title: {en: Source00 (keypad)}", "  at: 0101h", "  access: r", "  line: 5"]
    assert drafted["P01.02"][2:] == ["  at: ~", "  line: 6", "  # ? which is the address: 0102 | 259?"]


def test_a_table_of_one_fact_a_row_is_a_point(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["import", "table", write(tmp_path, "parameters.txt", SHEETS), "--ranges", "raw"]) == 0
    assert capsys.readouterr().out.partition("group: ")[2] == (
        "parameters\ntitle: {en: Parameters}\nspace: parameter\n"
        "# ? not every row prints an access; without the key it is rw\n"
        "source: {document: manual, section: 4.2.1}\npoints:\n"
        "- name: speed_limit\n  title: {en: Speed limit}\n  at: 57\n  type: u16\n  range: 5..17920\n"
        "  scale: raw = value * 256\n  line: 5\n"
    )


def test_a_workbook(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    from openpyxl import Workbook

    book = Workbook(write_only=True)
    sheet = book.create_sheet("Coils")
    for row in (
        ("Address", "Name", "R/W", "Foo"),
        (1, "Run", "R/W", None),
        (2.0, "Fault", "R", "=1+1"),
        (3.5, "X", "R"),
    ):
        sheet.append(row)
    book.create_sheet("Notes").append(("a", "b"))
    book.save(tmp_path / "list.xlsx")
    assert main(["import", "table", str(tmp_path / "list.xlsx")]) == 0
    out, err = capsys.readouterr()
    assert err.startswith("1 table holds no points")
    assert "space: coil\n" in out
    assert points(out) == {
        "run": ["  title: {en: Run}", "  at: 1", "  access: rw", "  line: 2"],
        "fault": ["  title: {en: Fault}", "  at: 2", "  line: 3"],
        "x": ["  title: {en: X}", "  at: ~", "  line: 4", "  # ? which is the address: 3.5?"],
    }


def test_xlsx_needs_its_extra(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "openpyxl", None)
    assert main(["import", "table", write(tmp_path, "list.xlsx", "")]) == 2
    assert 'pip install "fieldscribe[import]"' in capsys.readouterr().err


def test_columns_are_named_by_heading_or_number(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = write(tmp_path, "odd.csv", "what,where,so,Unit,Notes\nSpeed,17,rpm,Hz,fast\nTorque,18,Nm,Hz,\n")
    assert main(["import", "table", path]) == 1
    columns = ["--column", "name=What", "--column", "address=2", "--column", "unit=so", "--column", "ignore=Notes"]
    assert main(["import", "table", path, *columns, "--space", "input"]) == 0
    out = capsys.readouterr().out
    assert points(out) == {
        "speed": ["  title: {en: Speed}", "  at: 17", "  unit: rpm", "  line: 2"],
        "torque": ["  title: {en: Torque}", "  at: 18", "  unit: Nm", "  line: 3"],
    }
    assert "space: input\n" in out
    assert "# ? not read at line 1: Unit\n" in out
    assert main(["import", "table", path, "--column", "address=Wo"]) == 1
    assert capsys.readouterr().err == (
        f"fieldscribe: {path}: no table has a column `Wo`\n  hint: there are `what`, `where`, `so`, `Unit`, `Notes`\n"
    )
    assert main(["import", "table", path, "--column", "address=6"]) == 1


def test_a_second_table_goes_on_with_the_columns_of_the_first(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = "|Address|Name|\n|1|Speed|\n\npage 2\n\n|40001|Torque|\n|2|Current|\n"
    assert main(["import", "table", write(tmp_path, "two.md", text)]) == 0
    out = capsys.readouterr().out
    assert "# ? the table at line 6 has no headings: it was read as the one above\n" in out
    assert {name: lines[1] for name, lines in points(out).items()} == {
        "speed": "  at: 1",
        "torque": "  at: 40001",
        "current": "  at: 2",
    }


@pytest.mark.parametrize(
    ("options", "addresses"),
    [
        ([], ["40001", "~", "20001"]),
        (["--base", "1"], ["40000", "~", "20000"]),
        (["--base", "40001"], ["0", "~", "~"]),
        (["--base", "modicon"], ["0", "0", "~"]),
    ],
)
def test_the_base_of_addresses(
    options: list[str], addresses: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = write(tmp_path, "base.csv", "Address,Name\n40001,a\n300001,b\n20001,c\n")
    assert main(["import", "table", path, *options]) == 0
    found = {name: lines[1].removeprefix("  at: ") for name, lines in points(capsys.readouterr().out).items()}
    assert [found[name] for name in "abc"] == addresses


def test_addresses_that_may_be_references_are_asked_about(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = write(tmp_path, "base.csv", "Address,Name\n40001,a\n30002,b\n")
    assert main(["import", "table", path]) == 0
    assert "# ? are the addresses Modicon references? Then import with `--base modicon`\n" in capsys.readouterr().out


def test_numbers_with_hexadecimal_digits_leave_their_column_open(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = write(tmp_path, "hex.csv", "Address,Name\n0010,a\n001A,b\n20h,c\n")
    found = []
    for options in ([], ["--hex"]):
        assert main(["import", "table", path, *options]) == 0
        found.append([lines[1] for lines in points(capsys.readouterr().out).values()])
    assert found == [["  at: ~", "  at: ~", "  at: 0020h"], ["  at: 0010h", "  at: 001Ah", "  at: 0020h"]]


def test_rows_of_bits_are_flags_of_the_word_above(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = "Address,Bit,Name\n7,,Status\n,0,Ready\n,3..2,Mode\n,0,Again\n8,15..8,High byte\n,,,more\n"
    assert main(["import", "table", write(tmp_path, "bits.csv", text)]) == 0
    out = capsys.readouterr().out
    assert points(out) == {
        "status": [
            "  title: {en: Status}",
            "  at: 7",
            "  flags:",
            "    0: {name: ready, title: {en: Ready}}",
            "    3..2: {name: mode, title: {en: Mode}}",
            "  line: 2",
            "  # ? bit 0 is printed twice: Ready, Again",
        ],
        "high_byte": [
            "  title: {en: High byte}",
            "  at: 8",
            "  bits: 15..8",
            "  line: 6",
            "  # ? line 7 is no point: more",
        ],
    }
    assert "# ? not read at line 1: column 4\n" in out


def test_tables_are_chosen_and_listed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = write(tmp_path, "drive.txt", MANUAL)
    assert main(["import", "table", path, "--table", "2"]) == 1
    assert main(["import", "table", path, "--lines", "1..5"]) == 0
    assert main(["import", "table", path, "--lines", "4-20"]) == 1
    capsys.readouterr()
    assert main(["import", "table", path, "--list"]) == 0
    assert capsys.readouterr().out == (
        "   1  3..11  points     Gruppe A: 1 code, 2 name, 3 access, 4 description, 5 address, 6 address, 7 range, "
        "8 step\n"
        "   2  15..17  no points  Drive: no column is known\n"
    )


def test_rows_of_a_table_without_points_are_listed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = "|Address|Name|\n|1|Speed|\n\npage 2\n\n|Address|Name|\n||Torque|\n"
    assert main(["import", "table", write(tmp_path, "two.md", text)]) == 0
    assert "# ? line 7 is no point: Torque\n" in capsys.readouterr().out


def test_a_point_that_no_question_can_mend_is_a_bug() -> None:
    point = DraftPoint(1, "holding", "Speed")
    with pytest.raises(ValueError, match="no such title"):
        point.withdraw("title", "no such title")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["table", "a.csv", "--column", "colour=1"], "is not ROLE=HEADING or ROLE=NUMBER, with one of code, name,"),
        (["table", "a.csv", "--column", "name="], "is not ROLE=HEADING or ROLE=NUMBER"),
        (["table", "a.csv", "--lines", "one"], "is no range of lines"),
        (["table", "a.csv", "--base", "-1"], "is neither the number printed for wire address 0 nor `modicon`"),
        (["table", "a.csv", "--address-part", "0"], "invalid choice"),
        (["table", "a.csv", "--device", "../x"], "is no name"),
        (["table", "a.csv", "--language", "deutsch"], "is no code of a language"),
        (["table", "a.docx"], "no reader takes such a file"),
        (["table", "missing.csv"], "missing.csv"),
        (["table", "a.csv", "--out", "there.yaml"], "is there already"),
        (["dbc", "a.csv"], "invalid choice"),
    ],
)
def test_wrong_calls(
    arguments: list[str],
    message: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    write(tmp_path, "a.csv", NASTY)
    write(tmp_path, "there.yaml", "mine")
    assert main(["import", *arguments]) == 2
    assert message in capsys.readouterr().err
    assert (tmp_path / "there.yaml").read_text() == "mine"
