"""Tables in files that are nothing else: CSV, TSV, and sheets of a workbook (XLSX)."""

from __future__ import annotations

import csv
import io
from typing import TYPE_CHECKING, Any

from fieldscribe.audit.editions.tables.cell_text import clean
from fieldscribe.audit.editions.tables.tables import (
    MOST_CELL,
    MOST_COLUMNS,
    MOST_ROWS,
    Gathered,
    MissingExtraError,
    Table,
    UnreadableError,
)

if TYPE_CHECKING:
    from collections.abc import Iterable

_MOST_UNPACKED = 64 << 20
"""What all parts of a workbook may hold when they are unpacked."""


def read_delimited(text: str, delimiter: str = "") -> list[Table]:
    """The one table of a CSV or TSV file. Without a delimiter, the one that the first lines have most evenly."""
    csv.field_size_limit(MOST_CELL)
    gathered = Gathered()
    reader = csv.reader(io.StringIO(text), delimiter=delimiter or _delimiter(text))
    line = 1
    try:
        for cells in reader:
            gathered.add(line, [clean(cell) for cell in cells])
            line = reader.line_num + 1
    except csv.Error as error:
        raise UnreadableError(f"this is no CSV: {error}", reader.line_num) from error
    gathered.close("")
    return gathered.tables


def _delimiter(text: str) -> str:
    lines = [line for line in text.splitlines()[:40] if line.strip()]
    counts = {sign: [line.count(sign) for line in lines] for sign in (";", "\t", ",", "|")}
    return max(counts, key=lambda sign: (min(counts[sign], default=0), sum(counts[sign]), sign == ";"))


def read_workbook(data: bytes) -> list[Table]:
    """The sheets of a workbook, one table each. Raises MissingExtraError without openpyxl."""
    try:
        from openpyxl import load_workbook
    except ModuleNotFoundError as error:
        raise MissingExtraError("import") from error
    _refuse_bombs(data)
    gathered = Gathered()
    try:
        book = load_workbook(io.BytesIO(data), read_only=True, data_only=True, keep_links=False)
        for sheet in book.worksheets:
            _sheet(sheet.iter_rows(max_row=MOST_ROWS, max_col=MOST_COLUMNS, values_only=True), gathered)
            gathered.close(clean(str(sheet.title)))
    except UnreadableError:
        raise
    except Exception as error:  # openpyxl raises whatever its parsers raise; no file may end in a traceback
        raise UnreadableError(f"this is no workbook that openpyxl can read: {type(error).__name__}") from error
    return gathered.tables


def _sheet(rows: Iterable[tuple[Any, ...]], gathered: Gathered) -> None:
    for number, row in enumerate(rows, 1):
        cells = [_shown(value) for value in row]
        while cells and not cells[-1]:
            cells.pop()
        if cells:
            gathered.add(number, cells)


def _shown(value: Any) -> str:
    """A cell as a person sees it: whole numbers without a decimal point."""
    if value is None:
        return ""
    if isinstance(value, float) and value.is_integer() and abs(value) < 1e15:
        return str(int(value))
    return clean(str(value))


def _refuse_bombs(data: bytes) -> None:
    """A workbook is a ZIP archive: refuse one that is none, or that unpacks to more than is sane."""
    from zipfile import BadZipFile, ZipFile

    try:
        with ZipFile(io.BytesIO(data)) as archive:
            unpacked = sum(entry.file_size for entry in archive.infolist())
    except (BadZipFile, ValueError, NotImplementedError) as error:
        raise UnreadableError("this is no workbook: the archive is broken") from error
    if unpacked > _MOST_UNPACKED:
        raise UnreadableError(f"the workbook unpacks to more than {_MOST_UNPACKED >> 20} MiB")
