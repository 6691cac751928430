"""`import table`: whole files of each format to drafts, the options, and wrong calls."""

from __future__ import annotations

import os
import re
import sys
from pathlib import Path
from zipfile import ZipFile

import pytest
from fieldscribe.cli import main
from fieldscribe.importing.draft_text import DraftPoint

FOLDER = Path(__file__).parent / "tables"
TABLES = {
    "nasty.csv": ["--language", "de"],
    "everything.csv": [],
    "drive.md": ["--address-part", "2"],
    "merged.html": [],
    "sheet.txt": ["--ranges", "raw"],
    "names.csv": [],
}
"""The tables in the folder `tables`, each beside its draft, with the options that the draft is made with."""


RELATIONS = b"http://schemas.openxmlformats.org/officeDocument/2006/relationships"


def write(folder: Path, name: str, text: str) -> str:
    """Return the path of a file with this text."""
    (folder / name).write_text(text, "utf-8")
    return str(folder / name)


def points(text: str) -> dict[str, list[str]]:
    """Return the lines of each point of a draft, by its code or else its name."""
    blocks = [block.split("\n---")[0].splitlines() for block in re.split(r"\n- (?:name|code): ", text)[1:]]
    return {first: lines for first, *lines in blocks}


@pytest.mark.parametrize("table", TABLES)
def test_a_table_becomes_its_draft(table: str, capsys: pytest.CaptureFixture[str]) -> None:
    """FIELDSCRIBE_ACCEPT=1 writes the drafts; look at the difference."""
    path = FOLDER / table
    assert main(["import", "table", str(path), *TABLES[table]]) == 0
    draft = capsys.readouterr().out
    if os.environ.get("FIELDSCRIBE_ACCEPT"):
        path.with_suffix(".draft").write_text(draft, "utf-8")
    assert draft == path.with_suffix(".draft").read_text("utf-8")


def test_ranges_are_raw_or_in_units_as_the_user_says(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = str(FOLDER / "drive.md")
    assert main(["import", "table", path, "--ranges", "raw"]) == 0
    drafted = points(capsys.readouterr().out)
    assert "  range: 0..4000" in drafted["F005"]
    assert "  # ? range: 1..300000? 300000 lies outside the type, which holds 0..65535" in drafted["F002 (high)"]
    assert main(["import", "table", path, "--ranges", "units"]) == 0
    assert "  range_in_units: 0..4000" in points(capsys.readouterr().out)["F005"]


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
    book.save(tmp_path / "openpyxl.xlsx")
    with ZipFile(tmp_path / "openpyxl.xlsx") as old, ZipFile(tmp_path / "list.xlsx", "w") as new:
        for name in old.namelist():  # other programs write whole numbers with a decimal point
            linked = b"<externalReferences><externalReference xmlns:r='%s' r:id='rId99'/></externalReferences><calcPr"
            whole = old.read(name).replace(b"<v>2</v>", b"<v>2.0</v>")
            new.writestr(name, whole.replace(b"<calcPr", linked % RELATIONS))  # the linked workbook was not sent along
    assert main(["import", "table", str(tmp_path / "list.xlsx")]) == 0
    out, err = capsys.readouterr()
    assert err.startswith("1 table holds no points")
    assert "space: coil\n" in out
    assert points(out) == {
        "run": ["  title: {en: Run}", "  at: 1", "  access: rw", "  line: 2"],
        "fault": ["  title: {en: Fault}", "  at: 2", "  line: 3"],
        "x": ["  title: {en: X}", "  at: ~", "  line: 4", "  # ? which is the address: 3.5?"],
    }


BLOCK = re.compile(r"^=== (.*)\n((?:.*\n)+?)---\n((?: .*\n)*)", re.MULTILINE)
LISTED = BLOCK.findall((FOLDER / "files.txt").read_text("utf-8"))
"""The name of a file with options, its text, and the tables that are found in it, with their columns."""


@pytest.mark.parametrize(("call", "text", "tables"), LISTED, ids=[call for call, *_ in LISTED])
def test_the_tables_of_a_file(
    call: str, text: str, tables: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    name, *options = call.split()
    assert main(["import", "table", write(tmp_path, name, text.replace("<TAB>", "\t")), "--list", *options]) == 0
    assert capsys.readouterr().out == tables


@pytest.mark.parametrize(
    ("rows", "options", "family", "space", "question"),
    [
        ("Address,Name\n1,a", "", "modbus", "holding", "nothing names the space: is it holding?"),
        ("Address,Name\n1,a", "--family uss", "uss", "parameter", "nothing names the space: is it parameter?"),
        ("Address,Name\n40001,a", "--base modicon", "modbus", "holding", ""),
        ("Address,Name\n1,a", "--space discrete", "modbus", "discrete", ""),
        ("PNU,Name\n1,a", "", "can", "parameter", ""),
        ("Coil,Name\n1,a", "", "modbus", "coil", ""),
        ("Address,Name,FC\n1,a,1", "--family can", "can", "parameter", "nothing names the space: is it parameter?"),
        ("Coil,Name\n40001,a\n,b", "", "modbus", "coil", "are the addresses Modicon references?"),
        ("Coil,Name\n40001,a\n5,b", "", "modbus", "coil", ""),
        ("Coil,Name\n,a\n0,b", "", "modbus", "coil", ""),
    ],
)
def test_the_family_and_the_space_of_a_draft(  # noqa: PLR0917  # a table
    rows: str, options: str, family: str, space: str, question: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """By what the table says, else by options; what neither says is asked."""
    assert main(["import", "table", write(tmp_path, "a.csv", rows), "--device", "x", *options.split()]) == 0
    draft = capsys.readouterr().out
    assert f"\nfamily: {family}\n" in draft
    assert f"\nspace: {space}\n" in draft
    asked = re.findall(r"# \? ((?:nothing|the family|are the).*)", draft)
    assert [text.partition("?")[0] for text in asked[:1]] == [question.rstrip("?")] * bool(question)
    advice = "# ? are the addresses Modicon references? Then import with `--base modicon`\n"
    assert (advice in draft) == question.startswith("are the addresses")


def test_a_long_workbook_is_read_to_its_end(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    from openpyxl import Workbook

    book = Workbook(write_only=True)
    sheet = book.create_sheet("Coils")
    for row in (("Address", "Name"), *((number, f"p{number}") for number in range(500))):
        sheet.append(row)
    book.save(tmp_path / "list.xlsx")
    assert main(["import", "table", str(tmp_path / "list.xlsx")]) == 0
    assert len(points(capsys.readouterr().out)) == 500


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
    assert "no table has a column `6`" in capsys.readouterr().err


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


def test_references_have_their_space_and_their_numbering(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Of five or six digits, the first of which is the space; the others count from 1."""
    printed = ["00001", "000002", "10003", "100004", "30005", "300006", "40007", "465536"]
    unclear = ["40000", "50001", "4001", "4000001"]
    rows = "".join(f"{number},n{number}\n" for number in [*printed, *unclear, "465536"])
    assert main(["import", "table", write(tmp_path, "a.csv", f"Address,Name\n{rows}"), "--base", "modicon"]) == 0
    draft = capsys.readouterr().out
    at = dict(re.findall(r"- name: n(\d+)\n.*\n  at: (.*)\n", draft))
    assert [at[number] for number in printed + unclear] == ["0", "1", "2", "3", "4", "5", "6", "65535", *4 * "~"]
    groups = dict(zip(re.findall("^space: (.*)", draft, re.MULTILINE), draft.split("\n---\n"), strict=True))
    assert {space: re.findall("^numbering: (.*)", text, re.MULTILINE) for space, text in groups.items()} == {
        "coil": ["{reference: wire + 1}"],
        "discrete": ["{reference: wire + 10001, long_reference: wire + 100001}"],
        "input": ["{reference: wire + 30001, long_reference: wire + 300001}"],
        "holding": ["{reference: wire + 40001, long_reference: wire + 400001}"],
    }
    assert draft.count("printed: {long_reference: 465536}") == 1  # the second has the same address, and none then


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
    path = str(FOLDER / "drive.md")
    assert main(["import", "table", path, "--table", "2"]) == 1
    assert main(["import", "table", path, "--lines", "1..5"]) == 0
    assert main(["import", "table", path, "--lines", "4-20"]) == 1
    assert main(["import", "table", path, "--lines", "90..95"]) == 1
    assert "no table that --lines chooses" in capsys.readouterr().err
    wide = write(tmp_path, "wide.csv", "Address,Name,Type\n1,Speed,u32\n")
    assert main(["import", "table", wide, "--family", "uss", "--device", "x"]) == 0
    assert "type: u32" in capsys.readouterr().out
    assert main(["import", "table", path, "--list"]) == 0
    assert capsys.readouterr().out == (
        "   1  3..11  points     Gruppe A: 1 code, 2 name, 3 access, 4 description, 5 address, 6 address, 7 range, "
        "8 step\n"
        "   2  15..17  no points  Drive: no column is known\n"
    )


def test_a_point_without_a_name_is_called_by_its_code_or_place(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["import", "table", write(tmp_path, "bare.csv", "Code,Address,Name\nP1,5,\n,6,\n,7,温度\n")]) == 0
    found = points(capsys.readouterr().out)
    assert list(found) == ["P1", "holding_6", "point"]
    assert {"  title: {en: P1}", "  title: {en: holding 6}"} <= {line for lines in found.values() for line in lines}


def test_rows_of_a_table_without_points_are_listed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = "|Address|Name|\n|1|Speed|\n\npage 2\n\n|Address|Name|\n||Torque|\n"
    assert main(["import", "table", write(tmp_path, "two.md", text)]) == 0
    assert "# ? line 7 is no point: Torque\n" in capsys.readouterr().out


@pytest.mark.parametrize("rows", ['1,"Speed,Hz\n2,Torque,V\n', '1,"Speed,Hz\n2,"Torque",V\n', '1,"Spe"ed,Hz\n'])
def test_a_quote_that_is_not_closed_hides_no_row(rows: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["import", "table", write(tmp_path, "rows.csv", f"Address,Name,Unit\n0,First,A\n{rows}")]) == 1
    assert "rows.csv:3: a cell begins with a quote and does not end with one" in capsys.readouterr().err


def test_lines_may_end_as_on_old_systems(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "rows.csv").write_bytes(b"Address,Name\r1,Speed\r2,Torque\r")
    assert main(["import", "table", str(tmp_path / "rows.csv")]) == 0
    assert list(points(capsys.readouterr().out)) == ["speed", "torque"]


def test_three_thousand_is_asked_about(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    rows = "Address;Name;Range;Default\n1;Speed;0 bis 3.000;1.500\n2;Torque;0 bis 2,5;\n"
    assert main(["import", "table", write(tmp_path, "rows.csv", rows)]) == 0
    speed = points(capsys.readouterr().out)["speed"]
    assert "  # ? which range is `0 bis 3.000`?" in speed
    assert "  # ? is the default 1.500 raw, or in the unit?" in speed
    assert not [line for line in speed if line.startswith(("  range", "  default"))]


def test_labels_may_stand_in_a_second_description(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = 'Address,Name,Description,Remarks\n1,Mode,How it runs,"0 = off, 1 = turning"\n'
    assert main(["import", "table", write(tmp_path, "rows.csv", text)]) == 0
    assert "    1: {name: turning, en: turning}" in points(capsys.readouterr().out)["mode"]


def test_a_point_that_no_question_can_mend_is_a_bug() -> None:
    point = DraftPoint(1, "holding", "Speed", facts={"at": "~", "unit": "V"})
    point.withdraw("title", "no such title")
    assert point.questions == ["the row: unit: V? no such title"]
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
        (["table", "a.csv", "--device", "../x"], "fieldscribe: --device: `../x` is no name"),
        (["table", "a.csv", "--language", "deutsch"], "is no code of a language"),
        (["table", "a.docx"], "no reader takes such a file"),
        (["table", "missing.csv"], "missing.csv"),
        (["table", "a.csv", "--out", "there.yaml"], "is there already"),
        (["dxf", "a.csv"], "invalid choice"),
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
    write(tmp_path, "a.csv", "Address,Name\n1,Speed\n")
    write(tmp_path, "there.yaml", "mine")
    assert main(["import", *arguments]) == 2
    assert message in capsys.readouterr().err
    assert (tmp_path / "there.yaml").read_text() == "mine"
