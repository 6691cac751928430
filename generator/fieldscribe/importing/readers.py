"""Reads a file into tables: CSV and TSV, workbooks (XLSX), Markdown, HTML, and the text of a manual."""

from __future__ import annotations

import csv
import io
from contextlib import suppress
from pathlib import Path
from typing import Any

from fieldscribe.importing.cells import clean
from fieldscribe.importing.document_tables import read_html, read_text
from fieldscribe.importing.tables import (
    MOST_BYTES,
    MOST_CELL,
    MOST_COLUMNS,
    MOST_ROWS,
    Table,
    TableCollector,
    UnreadableError,
)
from fieldscribe.safe_files import read_regular

FORMATS = {
    ".csv": "CSV",
    ".tsv": "TSV",
    ".tab": "TSV",
    ".md": "text",
    ".markdown": "text",
    ".txt": "text",
    ".html": "HTML",
    ".htm": "HTML",
    ".xlsx": "XLSX",
}
"""The format of a file by its suffix."""
_MOST_UNPACKED = 64 << 20
"""Limit for the unpacked size of a workbook, in bytes."""


def read_tables(path: Path) -> list[Table]:
    """Return the tables of the file. Raises OSError, UnreadableError, and ModuleNotFoundError without openpyxl."""
    form = FORMATS[path.suffix.lower()]
    data = read_regular(path, MOST_BYTES).data
    if form == "XLSX":
        return _read_workbook(data)
    text = _decoded(data)
    if form == "text":
        return read_text(text)
    if form == "HTML":
        return read_html(text)
    return _read_delimited(text, "\t" if form == "TSV" else _delimiter(text))


def _decoded(data: bytes) -> str:
    """Return the text of a file: UTF-8, UTF-16 with a byte order mark, or Windows-1252."""
    is_utf16 = data.startswith((b"\xff\xfe", b"\xfe\xff"))
    for encoding in ("utf-16",) if is_utf16 else ("utf-8-sig", "cp1252"):
        with suppress(UnicodeDecodeError):
            return data.decode(encoding)
    raise UnreadableError("this is no text in UTF-8, UTF-16 or Windows-1252")


def _read_delimited(text: str, delimiter: str) -> list[Table]:
    """Return the one table of a CSV or TSV file."""
    csv.field_size_limit(MOST_CELL)
    collector = TableCollector()
    reader = csv.reader(io.StringIO(text, newline=None), delimiter=delimiter, strict=True)
    line = 1
    try:
        for cells in reader:
            collector.add(line, [clean(cell) for cell in cells])
            line = reader.line_num + 1
    except csv.Error as error:
        is_long = "limit" in str(error)
        wrong = f"has more than {MOST_CELL} characters" if is_long else "begins with a quote and does not end with one"
        hint = "a cell between quotes ends at the next quote; a quote inside it is written twice"
        raise UnreadableError(f"a cell {wrong}", line, hint) from error
    collector.close("")
    return collector.tables


def _delimiter(text: str) -> str:
    """Return the delimiter that occurs most evenly in the first lines."""
    lines = [line for line in text.splitlines()[:40] if line.strip()]
    counts = {sign: [line.count(sign) for line in lines] for sign in (";", "\t", ",", "|")}
    return max(counts, key=lambda sign: (min(counts[sign], default=0), sum(counts[sign]), sign == ";"))


def _read_workbook(data: bytes) -> list[Table]:
    """Return the sheets of a workbook, one table each."""
    from openpyxl import load_workbook

    _refuse_bomb(data)
    collector = TableCollector()
    try:
        book = load_workbook(io.BytesIO(data), read_only=True, data_only=True, keep_links=False)
        for sheet in book.worksheets:
            rows = sheet.iter_rows(max_row=MOST_ROWS, max_col=MOST_COLUMNS, values_only=True)
            for number, row in enumerate(rows, 1):
                collector.add(number, [_cell_text(value) for value in row])
            collector.close(clean(str(sheet.title)))
    except UnreadableError:
        raise
    except Exception as error:  # openpyxl raises whatever its parsers raise; no file may end in a traceback
        raise UnreadableError(f"this is no workbook that openpyxl can read: {type(error).__name__}") from error
    return collector.tables


def _cell_text(value: Any) -> str:
    """Return a cell as its reader sees it: whole numbers without a decimal point."""
    if value is None:
        return ""
    if isinstance(value, float) and value.is_integer() and abs(value) < 1e15:
        return str(int(value))
    return clean(str(value))


def _refuse_bomb(data: bytes) -> None:
    """Raise UnreadableError unless the workbook is a ZIP archive that unpacks to a sane size."""
    from zipfile import BadZipFile, ZipFile

    try:
        with ZipFile(io.BytesIO(data)) as archive:
            unpacked = sum(entry.file_size for entry in archive.infolist())
    except (BadZipFile, ValueError, NotImplementedError) as error:
        raise UnreadableError("this is no workbook: the archive is broken") from error
    if unpacked > _MOST_UNPACKED:
        raise UnreadableError(f"the workbook unpacks to more than {_MOST_UNPACKED >> 20} MiB")
