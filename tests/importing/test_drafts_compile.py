"""Whatever the cells hold, a draft compiles, and a file that is none ends in a message."""

from __future__ import annotations

import csv
import io
import zipfile
from collections.abc import Callable
from itertools import count
from pathlib import Path

import pytest
from fieldscribe.cli import main
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

HEADINGS = (
    *("Register", "Code", "Type", "R/W", "Unit", "Resolution", "Range", "Default", "Description", "Min", "Max", "Bit"),
    *("Length", "Formula", "Register type", "Foo"),
)
CELLS = (
    *(
        *("", "-", "0", "1", "2", "16", "1-16", "-5", "40001", "400001", "0x10", "10h", "1A", "40001/40002", "Speed"),
        "speed",
    ),
    *("Reserved", "class", "u16", "UINT32", "float", "INT", "bool", "r", "R/W", "x", "V", "Hz", "sacks", "%", "0.1"),
    *(
        "0,01 Hz",
        "x 10",
        "1/100 Hz",
        "0-4000",
        "0.0 to 50.0 Hz",
        "-5..5",
        "0,1,2",
        "5..0",
        "0 = off, 1 = on",
        "0: a\n1: b",
    ),
    *(
        "65536 = x; 2 = y",
        "value = raw * 0.1",
        "raw = value * x",
        "a = b",
        *("0..99999999999", "1e5", "15", "7..4", "Coil"),
    ),
    *("input registers", "\0", "\u202e", "a: {b}", "- x", "# c", "'", '"', "}", "|", "!!python/object", "&a", "*a"),
    *(
        "\u2028",
        "--- x: 1",
        "...",
        "%",
        "~",
        "null",
        "true",
        "on",
        "9" * 15,
        "a" * 500,
        "<td>",
        "²",
        "٣",
        "A001",
        "a,b",
    ),
)
OPTIONS: tuple[list[str], ...] = (
    *([], ["--base", "1"], ["--base", "modicon"], ["--hex"], ["--address-part", "2"], ["--space", "coil"]),
    *(["--ranges", "raw"], ["--ranges", "units"], ["--family", "uss"], ["--family", "can"], ["--space", "parameter"]),
)
ROWS = st.lists(
    st.lists(st.one_of(st.sampled_from(CELLS), st.text(max_size=12)), min_size=2, max_size=8), min_size=1, max_size=8
)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("drafts")


NUMBERS = count()


@pytest.mark.full(seconds=1)
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.lists(st.sampled_from(HEADINGS), max_size=6, unique=True), ROWS, st.sampled_from(OPTIONS))
@example(["Register", "Range"], [["", ""], ["", "", "1-16", "65536 = x; 2 = y"]], ["--space", "coil"])
def test_a_draft_compiles(
    folder: Path, capsys: pytest.CaptureFixture[str], headings: list[str], rows: list[list[str]], options: list[str]
) -> None:
    text = io.StringIO()
    csv.writer(text).writerows([["Address", "Name", *headings], *rows])
    (folder / "rows.csv").write_text(text.getvalue(), "utf-8", "surrogatepass")
    out = folder / str(next(NUMBERS)) / "device.yaml"
    code = main(["import", "table", str(folder / "rows.csv"), "--device", "x", "--out", str(out), *options])
    errors = capsys.readouterr().err
    assert "internal error" not in errors
    if code == 0:
        assert main(["check", str(out)]) == 0, capsys.readouterr().out + out.read_text("utf-8")
        assert main(["fmt", "--check", str(out)]) in (0, 1), capsys.readouterr().err
    else:
        assert "no table of points" in errors or "a cell begins with a quote" in errors or "is no text in" in errors


def test_no_row_is_lost(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    cells = [cell for cell in CELLS if cell.isalnum() and cell.isascii()]
    path = tmp_path / "rows.csv"
    path.write_text("Address,Name,Type\n" + "".join(f",,x{cell}\n{cell},,\n,n{cell},\n" for cell in cells), "utf-8")
    assert main(["import", "table", str(path)]) == 0
    draft = capsys.readouterr().out
    for line in range(2, 2 + 3 * len(cells)):
        assert f"  line: {line}\n" in draft or f"# ? line {line} is no point: " in draft


@pytest.mark.full(seconds=2)
def test_a_large_table_compiles(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    rows = "".join(f"{number},Point,UINT32,Hz,0-5\n" for number in range(2000))
    (tmp_path / "rows.csv").write_text(f"Address,Name,Type,Unit,Range\n{rows}", "utf-8")
    out = tmp_path / "device.yaml"
    assert main(["import", "table", str(tmp_path / "rows.csv"), "--device", "x", "--out", str(out)]) == 0
    assert main(["check", str(out)]) == 0, capsys.readouterr().out
    assert "x: 2000 points" in capsys.readouterr().out


def _bomb() -> bytes:
    """Return an archive that says that one of its files has 2 GiB."""
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w") as archive:
        archive.writestr("xl/sheet.xml", "0")
    entry = data.getvalue().index(b"PK\x01\x02") + 24
    return data.getvalue()[:entry] + b"\xff\xff\xff\x7f" + data.getvalue()[entry + 4 :]


def _long_cell() -> bytes:
    """Return a workbook with a cell that is too long."""
    from openpyxl import Workbook

    book, data = Workbook(write_only=True), io.BytesIO()
    book.create_sheet("Coils").append(("Address", "a" * 8_001))
    book.save(data)
    return data.getvalue()


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("cell.xlsx", _long_cell, "cell.xlsx:1: a cell has more than 8000 characters"),
        ("a.xlsx", b"no archive", "the archive is broken"),
        ("bomb.xlsx", _bomb, "unpacks to more than 64 MiB"),
        ("empty.xlsx", b"PK\x05\x06" + bytes(18), "this is no workbook"),
        ("rows.csv", b"Address,Name\n" + b"1,a\n" * 50_001, "rows.csv:50001: there are more than 50000 rows"),
        ("cell.csv", b'Address,Name\n1,"' + b"a" * 9_000, "2: a cell has more than 8000 characters"),
        ("cells.html", b"<table><tr>" + b"<td colspan=400>1" * 5_000, "more than 400 cells"),
        ("deep.html", b"<table>" * 5_000 + b"<tr><td>1", "no table"),
        ("spans.html", b"<table>" + (b"<tr><td rowspan=400>" + b"<td>1" * 300) * 300, "more than 400 cells"),
        ("line.txt", b"x" * 200_000, "line.txt:1: the line has more than"),
        ("dots.txt", b"." * 90_000 + b"\tx", "more than 8000 characters"),
        ("spaces.md", b"| Address | Name |\n|" + b" " * 7_000 + b"<|x|", ""),
        ("digits.csv", b"Address,Name,Formula,Range\n1,a,x = y " + b"1" * 150 + b"!," + b"1-" * 2_000, ""),
        ("bytes.csv", b"\xff\xfe\x00", "is no text in UTF-8, UTF-16 or Windows-1252"),
        ("cp1252.csv", "Address,Name\n1,Höhe".encode("cp1252"), ""),
        ("utf16.csv", "Address;Name\n1;Höhe".encode("utf-16"), ""),
        ("nothing.md", b"", "no table"),
    ],
)
def test_hostile_files_end_in_a_message(
    name: str, content: bytes | Callable[[], bytes], message: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    data = content() if callable(content) else content
    (tmp_path / name).write_bytes(data)
    assert main(["import", "table", str(tmp_path / name)]) == (1 if message else 0)
    out, err = capsys.readouterr()
    assert message in err
    assert "Traceback" not in err
    assert "internal error" not in err
    if name in ("cp1252.csv", "utf16.csv"):
        assert "{en: Höhe}" in out
