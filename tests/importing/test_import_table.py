"""`import table`: whole files in each form to drafts that compile, wrong calls, and files of strangers."""

from __future__ import annotations

import io
import random
import sys
import zipfile
from typing import TYPE_CHECKING

import pytest
from fieldscribe.cli import main
from fieldscribe.diagnostics import Report
from fieldscribe.importing import Wishes, draft
from fieldscribe.importing.draft_text import draft_text
from fieldscribe.importing.reading import read_tables
from fieldscribe.language.load import load
from fieldscribe.language.source import SourceFile

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

METER = """\
Register,Parameter,Data type,R/W,Unit,Resolution,Range,Factory setting,Description
40001,Voltage L1-N,UINT16,R,V,0.1,,,
40002,Current L1,INT16,R,A,0.01,-100.00 to 100.00,,
40003,Active power,INT32,R,W,1,,,
40005,Mode,UINT16,R/W,,,0-2,0,"0 = off, 1 = heating, 2 = cooling"
40006,Target temperature,INT16,R/W,°C,0.1,10.0 to 55.0,21.5,Set point of the room
40007,Counter,COUNTER,R,sacks,,,,
"""
POINTS = """\
- name: voltage_l1_n
  title: {en: Voltage L1-N}
  at: 0
  type: u16
  scale: value = raw * 0.1
  unit: V
  line: 2
  printed: {resolution: 0.1 V, reference: 40001}
- name: current_l1
  title: {en: Current L1}
  at: 1
  type: s16
  range_in_units: -100..100
  scale: value = raw * 0.01
  unit: A
  line: 3
  printed: {resolution: 0.01 A, reference: 40002}
- name: active_power
  title: {en: Active power}
  at: 2
  type: s32
  unit: W
  line: 4
  printed: {resolution: 1 W, reference: 40003}
- name: mode
  title: {en: Mode}
  at: 4
  access: rw
  type: u16
  range: 0..2
  default: 0
  enum:
    0: {name: "off", en: "off"}
    1: {name: heating, en: heating}
    2: {name: cooling, en: cooling}
  line: 5
  printed: {reference: 40005}
- name: target_temperature
  title: {en: Target temperature}
  at: 5
  access: rw
  type: s16
  range_in_units: 10..55
  scale: value = raw * 0.1
  unit: °C
  default_in_units: 21.5
  line: 6
  printed: {resolution: 0.1 °C, reference: 40006}
- name: counter
  title: {en: Counter}
  at: 6
  type: ~
  line: 7
  printed: {reference: 40007}
  # ? the type is printed as `COUNTER`: which is it?
  # ? is `sacks` a unit? It is none of those that need no declaration
"""
MANUAL = """\
# Drive

| Fkt.-Nr | Funktion | R/W | Beschreibung | Netzwerkdaten | | | |
|---|---|---|---|---|---|---|---|
|  |  |  |  | Reg. (hex) | Reg. (dez) | Bereich | Auflösung |
| A001 | Quelle | R/W | 3 Optionen:<br>00 .. Poti<br>01 .. Klemme | 1019h/<br>1018h | 4121/<br>4120 | 0, 1, 2 | — |
| A201 | Quelle (2. Satz) | R/W | 02 .. Bus | 150Ah/<br>1509h | 5386/<br>5385 | 0, 1, 2 | — |
| F002 (high) | Hochlaufzeit | R/W | 0,01 - 3000 s | 1014h/<br>1013h | 4116/<br>4115 | 1-<br>300000 | 0,01 s |
| F002 (low) |  | R/W |  | 1015h/<br>1014h | 4117/<br>4116 |  |  |
| F004 | Richtung | R |  | 1018h/<br>1017h | 4120/<br>4219 | 0-1 | — |
| F005 | Frequenz | R | 0,0 - 400,0 Hz | h |  | 0-4000 | 0,1 Hz |

Sonstiges:

| Nr. | Feld | Beispiel (Hex) |
|---|---|---|
| 1 | Funktion | 03 |
"""
PAGE = """<h2>Input registers</h2><table>
<tr><th rowspan=2>No.<th colspan=2>Address<th rowspan=2>Parameter<th rowspan=2>Range</tr><tr><th>hex<th>dec</tr>
<tr><td>P01.00<td>0100H<td>256<td>Accel time<td>0.1 s to 3600.0 s</tr>
<tr><td>P01.01<td>0101H<td>257<td>Source<td>00 (keypad), 01 (terminal)<br>02 (bus)</tr></table>"""
SHEET = "Type\tWord\nID\t57\nRange\t5 to 17920, that corresponds to 0.02 Hz to 70 Hz\nFormula\traw = f * 256\n"


def test_a_table_becomes_points(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = write(tmp_path, "meter.csv", METER)
    assert main(["import", "table", path]) == 0
    assert capsys.readouterr().out.partition("points:\n")[2] == POINTS


def test_a_draft_of_a_device_compiles(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name, text in {"meter.csv": METER, "drive.txt": MANUAL, "page.html": PAGE}.items():
        path, device = write(tmp_path, name, text), name.partition(".")[0]
        out = tmp_path / device / "device.yaml"
        assert main(["import", "table", path, "--device", device, "--out", str(out)]) == 0
        assert main(["check", str(out)]) == 0, capsys.readouterr().err
        assert main(["fmt", "--check", str(out)]) == 0


def test_the_text_of_a_manual(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["import", "table", write(tmp_path, "drive.txt", MANUAL)]) == 0
    said = capsys.readouterr()
    points = dict(point.split("\n", 1) for point in said.out.split("\n- code: ")[1:])
    assert list(points) == ["A001", "A201", "F002", "F004", "F005"]
    assert "    2: {name: bus, en: Bus, de: Bus}" in points["A001"]
    assert "  at: 1013h\n  type: u32\n  range: 1..300000\n  scale: value = raw * 0.01\n  unit: s\n" in points["F002"]
    assert "low_modicon: [1015h, 4117], low_wire: [1014h, 4116]" in points["F002"]
    assert "printed: {wire: 4219}\n  taken: {wire: 4119}" in said.out
    assert "  at: ~\n" in points["F005"]
    assert "# ? no address is printed" in points["F005"]
    assert "1 table holds no points and is left out (line 15)" in said.err


def test_a_sheet_of_facts_is_a_point(tmp_path: Path) -> None:
    path = write(tmp_path, "parameters.txt", f"4.2 Parameters\n\n4.2.1 Speed limit\n\n{SHEET}")
    (group,) = draft(read_tables(tmp_path / path), Wishes()).groups
    (point,) = group.points
    assert (group.title, group.space, point.title, point.section) == ("Parameters", "parameter", "Speed limit", "4.2.1")
    assert (point.at, point.range, point.scale, point.unit) == (57, "5..17920", "raw = value * 256", "Hz")


def test_cells_that_an_extraction_has_run_together(tmp_path: Path) -> None:
    text = "5.1Process data\n0x001FINTR/OStatus\nBit 1R/OHold\n0x0020FLOATR/WSetpoint\n"
    (group,) = draft(read_tables(tmp_path / write(tmp_path, "run.txt", text)), Wishes()).groups
    assert [(point.title, point.at, point.type, point.access, point.flags) for point in group.points] == [
        ("Status", 0x1F, None, "r", {"1": "Hold"}),
        ("Setpoint", 0x20, "f32", "rw", {}),
    ]


def test_a_workbook(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    from openpyxl import Workbook

    book = Workbook(write_only=True)
    sheet = book.create_sheet("Coils")
    for row in (("Address", "Name", "R/W", "Remark"), (1, "Run", "R/W", None), (2.0, "Fault", "R", "=1+1")):
        sheet.append(row)
    book.save(tmp_path / "list.xlsx")
    assert main(["import", "table", str(tmp_path / "list.xlsx")]) == 0
    said = capsys.readouterr().out
    assert "space: coil" in said
    assert "- name: fault\n  title: {en: Fault}\n  at: 2\n  line: 3\n" in said


def test_xlsx_needs_its_extra(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "openpyxl", None)
    assert main(["import", "table", write(tmp_path, "list.xlsx", "")]) == 2
    assert 'pip install "fieldscribe[import]"' in capsys.readouterr().err


def test_the_caller_names_columns_tables_and_lines(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = write(tmp_path, "odd.csv", "what,where,so\nSpeed,17,rpm\nTorque,18,Nm\n")
    assert main(["import", "table", path]) == 1
    assert main(["import", "table", path, "--columns", "name=1,address=2,unit=3", "--space", "input"]) == 0
    said = capsys.readouterr().out
    assert "- name: speed\n  title: {en: Speed}\n  at: 17\n  unit: rpm\n" in said
    assert said.count("- name:") == 2
    drive = write(tmp_path, "drive.txt", MANUAL)
    assert main(["import", "table", drive, "--table", "2"]) == 1
    assert main(["import", "table", drive, "--lines", "1..5"]) == 0
    capsys.readouterr()
    assert main(["import", "table", drive, "--list"]) == 0
    listed = capsys.readouterr().out.splitlines()
    assert [line.split(": ")[1] for line in listed] == [
        "1 code, 2 name, 3 access, 4 description, 5 address, 6 address, 7 range, 8 step",
        "no column is known",
    ]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["table", "a.csv", "--columns", "colour=1"], "is no column"),
        (["table", "a.csv", "--lines", "one"], "is no range of lines"),
        (["table", "a.csv", "--device", "../x"], "is no name"),
        (["table", "a.docx"], "no reader takes such a file"),
        (["table", "missing.csv"], "missing.csv"),
        (["table", "a.csv", "--out", "there.yaml"], "is there already"),
        (["dbc", "a.csv"], "invalid choice"),
    ],
)
def test_wrong_calls(
    arguments: list[str],
    said: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    write(tmp_path, "a.csv", METER)
    write(tmp_path, "there.yaml", "mine")
    assert main(["import", *arguments]) == 2
    assert said in capsys.readouterr().err
    assert (tmp_path / "there.yaml").read_text() == "mine"


CELLS = [
    "\0",
    "\u202e",
    "a: {b}",
    "- x",
    "# c",
    "'",
    '"',
    "}",
    "|",
    "!!python/object",
    "&a",
    "*a",
    "\u2028",
    "--- x",
    "%",
    "~",
]


def test_no_cell_gets_out_of_its_text(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    rows = [
        f'{place},"{cell.replace(chr(34), chr(34) * 2)}",V,"{cell.replace(chr(34), "")}",1'
        for place, cell in enumerate(CELLS)
    ]
    path = write(tmp_path, "evil.csv", "\n".join(["Address,Name,Unit,Default,Type", *rows]))
    out = tmp_path / "evil" / "device.yaml"
    assert main(["import", "table", path, "--device", "evil", "--out", str(out)]) == 0
    assert main(["check", str(out)]) == 0, capsys.readouterr().err


def _bomb() -> bytes:
    """An archive that says that one of its files has 2 GiB."""
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w") as archive:
        archive.writestr("xl/sheet.xml", "0")
    entry = data.getvalue().index(b"PK\x01\x02") + 24
    return data.getvalue()[:entry] + b"\xff\xff\xff\x7f" + data.getvalue()[entry + 4 :]


@pytest.mark.parametrize(
    ("name", "content", "said"),
    [
        ("a.xlsx", b"no archive", "the archive is broken"),
        ("bomb.xlsx", _bomb, "unpacks to more than"),
        ("empty.xlsx", b"PK\x05\x06" + bytes(18), "this is no workbook"),
        ("rows.csv", b"Address,Name\n" + b"1,a\n" * 50_001, "rows.csv:50001: there are more than 50000 rows"),
        ("cell.csv", b'Address,Name\n1,"' + b"a" * 9_000, "no CSV"),
        ("cells.html", b"<table><tr>" + b"<td colspan=400>1" * 5_000, "more than 400 cells"),
        ("deep.html", b"<table>" * 5_000 + b"<tr><td>1", "no table of points"),
        ("line.txt", b"x" * 200_000, "line.txt:1: the line has more than"),
        ("dots.txt", b"." * 90_000 + b"\tx", "more than 8000 characters"),
        ("spaces.md", b"| Address | Name |\n|" + b" " * 7_000 + b"<|x|", "no table of points"),
        ("digits.csv", b"Address,Name,Formula,Range\n1,a,x = y " + b"1" * 150 + b"!," + b"1-" * 2_000, ""),
        ("bytes.csv", b"\xff\xfe\x00", "bytes.csv"),
        ("nothing.md", b"", "no table of points"),
    ],
)
def test_files_of_strangers_end_in_a_message(
    name: str, content: bytes | Callable[[], bytes], said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    data = content() if callable(content) else content
    (tmp_path / name).write_bytes(data)
    assert main(["import", "table", str(tmp_path / name)]) == (1 if said else 0)
    message = capsys.readouterr().err
    assert said in message
    assert "Traceback" not in message
    assert "internal error" not in message


STRANGE = [
    '"',
    "}",
    "{",
    ": ",
    "#",
    "\0",
    "|",
    "\t",
    "0x",
    "h",
    "..",
    "9" * 20,
    "\\",
    "<td>",
    " bis ",
    "=",
    "(low)",
    "²",
    "Bit 3",
]


def test_damaged_tables_are_drafts_in_sound_yaml(tmp_path: Path) -> None:
    rng = random.Random(11)
    for number in range(60):
        text, name = rng.choice([(METER, "a.csv"), (MANUAL, "a.txt"), (PAGE, "a.html"), (SHEET, "b.txt")])
        for _ in range(rng.randrange(1, 30)):
            place = rng.randrange(len(text))
            text = text[:place] + rng.choice(STRANGE) + text[place + rng.randrange(4) :]
        drafted = draft(read_tables(tmp_path / write(tmp_path, name, text)), Wishes())
        report = Report()
        if not drafted.groups:
            continue
        load(SourceFile("draft.yaml", draft_text(drafted, None)), report)
        assert not report.findings, (number, text, report.findings)


def write(folder: Path, name: str, text: str) -> str:
    """The path of a file with this text."""
    (folder / name).write_text(text, "utf-8")
    return str(folder / name)
