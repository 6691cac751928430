"""The tables as others open them: LibreOffice finds typed cells, pandas columns of numbers."""

from __future__ import annotations

import csv
import importlib
import io
import math
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.model import Device
from fieldscribe.targets.docs import csv_files, sheet, tables, xlsx_files
from fieldscribe.targets.docs.cells import scope_of
from openpyxl import load_workbook
from support.described import KITCHENS, SHIPPED, made, shipped
from support.places import ROOT
from support.toolchains import succeed, tool

_AS_THE_DIALOG_DOES = "--infilter=CSV:44,34,76,1,,1033,false,true"
"""Commas, UTF-8 (which the mark tells the dialog), English (USA), and dates wherever something looks like one."""
OF_CELLS = "[hk]*.xlsx"
"""The workbooks of hitachi_l200 and the kitchens: a cell says itself what it is, so that they stand for all."""
_DIGITS = 1e-14
"""Spreadsheets keep 15 digits."""


def _devices() -> list[Device]:
    return [*map(shipped, SHIPPED), *map(made, KITCHENS)]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The tables and workbooks of all devices."""
    folder = tmp_path_factory.mktemp("tables")
    for device in _devices():
        scope = scope_of(device)
        for name, text in csv_files(scope):
            (folder / name).write_text(text, "utf-8", newline="")
        for name, contents in xlsx_files(scope):
            (folder / name).write_bytes(contents)
    return folder


def _numbers(path: Path) -> dict[str, bool]:
    columns = tables.MEANINGS if path.stem.endswith("_meanings") else (*sheet.COLUMNS, *sheet.FURTHER)
    used = path.read_text("utf-8-sig").partition("\n")[0].split(",")
    return {column.name: column.is_number for column in columns if column.name in used or column in sheet.COLUMNS}


def _opened(folder: Path, pattern: str, *options: str) -> Path:
    """What LibreOffice makes of these files when it saves them."""
    out = folder / f"opened_{pattern.rpartition('.')[2]}"
    profile = f"-env:UserInstallation={(folder / 'profile').as_uri()}"
    files = sorted(folder.glob(pattern))
    succeed([tool("soffice"), profile, "--headless", *options, "--convert-to", "xlsx", "--outdir", out, *files])
    return out


def _is_same(written: str, read: object, *, is_number: bool) -> bool:
    if not written or not is_number:
        return (read or "") == written or str(read) == written  # a title that is a number may be read as one
    return isinstance(read, int | float) and math.isclose(float(written), read, rel_tol=_DIGITS)


@pytest.mark.full(seconds=3)
def test_libreoffice_finds_typed_cells(folder: Path) -> None:
    out = _opened(folder, "*.csv", _AS_THE_DIALOG_DOES)
    for path in sorted(folder.glob("*.csv")):
        numbers = _numbers(path)
        written = list(csv.DictReader(io.StringIO(path.read_text("utf-8-sig"))))
        head, *read = load_workbook(out / f"{path.stem}.xlsx").worksheets[0].iter_rows(values_only=True)
        assert list(head) == list(numbers)
        assert len(read) == len(written)
        wrong = [
            (path.name, column, row[column], cell)
            for row, cells in zip(written, read, strict=True)
            for column, cell in zip(numbers, cells, strict=True)
            if not _is_same(row[column], cell, is_number=numbers[column])
        ]
        assert wrong == []


@pytest.mark.full(seconds=4)
def test_libreoffice_opens_the_workbooks(folder: Path) -> None:
    """What it saves has the same typed cells and filters (without a window it forgets which heads stay)."""
    out = _opened(folder, OF_CELLS)
    for path in sorted(folder.glob(OF_CELLS)):
        ours, theirs = load_workbook(path), load_workbook(out / path.name)
        assert theirs.sheetnames == ours.sheetnames
        for mine, opened in zip(ours.worksheets, theirs.worksheets, strict=True):
            assert opened.auto_filter.ref == mine.auto_filter.ref
            for row, others in zip(mine.iter_rows(), opened.iter_rows(), strict=True):
                assert [_typed(cell.value) for cell in row] == [_typed(cell.value) for cell in others]


def _typed(cell: object) -> object:
    return float(f"{cell:.14g}") if isinstance(cell, int | float) else cell


@pytest.mark.full(seconds=2)
def test_pandas_reads_numbers(folder: Path) -> None:
    pandas: Any = importlib.import_module("pandas")
    for device in SHIPPED:
        for path in (folder / f"{device}.csv", folder / f"{device}_meanings.csv"):
            numbers, frame = _numbers(path), pandas.read_csv(path)
            assert list(frame.columns) == list(numbers)
            for column, is_number in numbers.items():
                filled = frame[column].dropna()
                if not filled.astype(str).str.len().ge(20).any():  # pandas takes unsigned numbers of 64 bits as texts
                    assert filled.empty or (filled.dtype.kind in "iuf") == is_number, (path.name, column)


@pytest.mark.full(seconds=2)
def test_the_program_of_the_page(folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any) -> None:
    monkeypatch.chdir(folder)
    page = (ROOT / "descriptions/using/tables.md").read_text("utf-8")
    program = page.partition("```python\n")[2].partition("```")[0]
    exec(compile(program, "tables.md", "exec"), {})
    said = [line.partition("  # ")[2] for line in program.splitlines() if "  # " in line]
    assert capsys.readouterr().out.splitlines() == said
