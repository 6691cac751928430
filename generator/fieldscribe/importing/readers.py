"""Reads a file into tables: CSV and TSV, workbooks (XLSX), Markdown, HTML, the text of a manual; and their limits."""

import csv
import io
import re
from contextlib import suppress
from html.parser import HTMLParser
from pathlib import Path
from typing import Any, NamedTuple

from fieldscribe.importing.cells import clean, one_line
from fieldscribe.safe_files import read_regular

MOST_BYTES = 64 << 20
"""The largest file that is read."""
MOST_ROWS, MOST_COLUMNS, MOST_CELL = 50_000, 400, 8_000
"""Limits: rows of all tables, columns of one table, characters of one cell."""


class UnreadableError(Exception):
    """The file cannot be read as tables, or has no such column; `line` is the place (0: the whole file)."""

    def __init__(self, message: str, line: int = 0, hint: str = "") -> None:
        super().__init__(message)
        self.message = message
        self.line = line
        self.hint = hint


class Row(NamedTuple):
    """One row; line breaks inside a cell are kept."""

    line: int
    cells: tuple[str, ...]

    @property
    def filled(self) -> tuple[str, ...]:
        """The cells that are not empty."""
        return tuple(cell for cell in self.cells if cell.strip())


class Table(NamedTuple):
    """A table, its number in the file, and the headings above it.

    `heading` is the nearest heading, `section` its number, and `parent` the heading of the section around that one.
    """

    number: int
    heading: str
    section: str
    parent: str
    rows: tuple[Row, ...]

    @property
    def line(self) -> int:
        """The line of the first row."""
        return self.rows[0].line

    @property
    def last(self) -> int:
        """The line of the last row."""
        return self.rows[-1].line

    @property
    def width(self) -> int:
        """The number of cells in the longest row."""
        return max(len(row.cells) for row in self.rows)


class TableCollector:
    """Collects the tables of a file while it is read, and enforces the limits."""

    def __init__(self) -> None:
        self.tables: list[Table] = []
        self._rows: list[Row] = []
        self._count = 0

    def add(self, line: int, cells: list[str]) -> None:
        """Add a row to the current table, without trailing empty cells. Raises UnreadableError beyond a limit."""
        while cells and not cells[-1]:
            cells.pop()
        self._count += 1
        if self._count > MOST_ROWS:
            raise UnreadableError(f"there are more than {MOST_ROWS} rows; import the tables one by one", line)
        if len(cells) > MOST_COLUMNS:
            raise UnreadableError(f"the row has more than {MOST_COLUMNS} cells", line)
        if any(len(cell) > MOST_CELL for cell in cells):
            raise UnreadableError(f"a cell has more than {MOST_CELL} characters", line)
        self._rows.append(Row(line, tuple(cells)))

    def close(self, heading: str, section: str = "", parent: str = "") -> None:
        """End the current table; it counts if it has at least two columns."""
        rows = tuple(row for row in self._rows if row.filled)
        if rows and max(len(row.cells) for row in rows) > 1:
            self.tables.append(Table(len(self.tables) + 1, heading, section, parent, rows))
        self._rows = []


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
_MARKDOWN_ROW = re.compile(r"\s*\|.*\|\s*")
_MARKDOWN_RULE = frozenset(" \t|:+=-")
_UNESCAPED_BAR = re.compile(r"(?<!\\)\|")
_HEADING = re.compile(r"\s{0,3}(?:(#{1,6})\s+)?(?:(\d{1,3}(?:\.\d{1,3}){1,5})\.?\s*(?=\s|[^\W\d]))?(\S.*)")
_CONTENTS_LINE = re.compile(r".*\.{3,}[\s|]*\d*\s*|\d{1,3}(?:\.\d{1,3})+\t[^\t]*\t\d+\s*")
_LONGEST_HEADING, _LONGEST_LINE = 160, 100_000
_HTML_HEADINGS = frozenset({"h1", "h2", "h3", "h4", "h5", "h6", "caption"})


def read_tables(path: Path) -> list[Table]:
    """Return the tables of the file. Raises OSError, UnreadableError, and ModuleNotFoundError without openpyxl."""
    form = FORMATS[path.suffix.lower()]
    data = read_regular(path, MOST_BYTES).data
    if form == "XLSX":
        return _read_workbook(data)
    text = _decoded(data)
    if form == "text":
        return _read_text(text)
    if form == "HTML":
        return _read_html(text)
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
    """Return the text of a cell as a workbook shows it: whole numbers without a decimal point."""
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


def _read_text(text: str) -> list[Table]:
    """Return the tables of a text, each with the heading above it."""
    collector, heading, section, separator = TableCollector(), "", "", ""
    headings: dict[str, str] = {}
    for number, line in enumerate(text.splitlines(), 1):
        if len(line) > _LONGEST_LINE:
            message = f"the line has more than {_LONGEST_LINE} characters: this is no manual's text"
            raise UnreadableError(message, number)
        before, separator = separator, _separator(line)
        if before != separator:
            collector.close(heading, section, headings.get(section.rpartition(".")[0], ""))
        if separator:
            if not _MARKDOWN_RULE.issuperset(line):
                collector.add(number, _split(line, separator))
        elif match := _heading(line):
            heading, section = one_line(clean(match[3])), match[2] or ""
            headings[section] = heading
    collector.close(heading, section, headings.get(section.rpartition(".")[0], ""))
    return collector.tables


def _heading(line: str) -> re.Match[str] | None:
    """Match a heading: marked with `#`, or with a number of at least two parts."""
    match = _HEADING.fullmatch(line) if len(line) < _LONGEST_HEADING else None
    return match if match and (match[1] or match[2]) else None


def _separator(line: str) -> str:
    """Return the separator of the cells of a line, `|` or a tab; empty for prose and tables of contents."""
    if "|" in line and _MARKDOWN_ROW.fullmatch(line):
        return "|"
    is_contents = len(line) < 2 * _LONGEST_HEADING and _CONTENTS_LINE.fullmatch(line)
    return "\t" if "\t" in line.strip() and not is_contents else ""


def _split(line: str, separator: str) -> list[str]:
    if separator == "\t":
        return [clean(cell) for cell in line.split("\t")]
    inner = line.strip()[1:-1]
    return [clean(cell.replace("\\|", "|")) for cell in _UNESCAPED_BAR.split(inner)]


def _read_html(text: str) -> list[Table]:
    """Return the tables of a page, each with the heading or caption above it.

    A cell that spans rows appears in each of them, one that spans columns in the first; a table inside a cell is text.
    """
    parser = _TableParser()
    parser.feed(text)
    parser.close()
    parser.end_table()
    return parser.collector.tables


class _TableParser(HTMLParser):
    """Collects rows while tags arrive; an unclosed element ends where the next one begins."""

    def __init__(self) -> None:
        super().__init__(convert_charrefs=True)
        self.collector = TableCollector()
        self._heading = ""
        self._text: list[str] | None = None
        self._row: list[str] | None = None
        self._depth = self._line = self._number = 0
        self._columns = self._rows = 1
        self._spanning: dict[tuple[int, int], str] = {}
        """The texts of cells that began in a row above, by row number and by column."""

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Begin a cell, row, table or heading."""
        if tag == "table":
            self._depth += 1
        elif tag == "br":
            self.handle_data("\n")
        elif tag in _HTML_HEADINGS and self._depth <= 1:
            self._text = []
        elif self._depth == 1 and tag in ("tr", "td", "th"):
            self._begin(tag, dict(attrs))

    def handle_endtag(self, tag: str) -> None:
        """End a cell, row, table or heading."""
        if tag == "table":
            self._depth = max(0, self._depth - 1)
            if not self._depth:
                self.end_table()
        elif tag in _HTML_HEADINGS and self._depth <= 1 and self._text is not None:
            self._heading, self._text = one_line(clean("".join(self._text))), None
        elif self._depth == 1 and tag in ("td", "th"):
            self._end_cell()
        elif self._depth == 1 and tag == "tr":
            self._end_row()

    def handle_data(self, data: str) -> None:
        """Keep text inside cells and headings."""
        if self._text is not None:
            self._text.append(data)

    def end_table(self) -> None:
        """End the current table."""
        self._end_row()
        self.collector.close(self._heading)
        self._spanning = {}

    def _begin(self, tag: str, attributes: dict[str, str | None]) -> None:
        if tag == "tr":
            self._end_row()
        self._end_cell()
        if self._row is None:
            self._row, self._line = [], self.getpos()[0]
        if tag != "tr":
            self._text = []
            self._columns, self._rows = _span(attributes.get("colspan")), _span(attributes.get("rowspan"))

    def _end_cell(self) -> None:
        if self._text is None or self._row is None:
            return
        self._add_spanning(self._row)
        lines = "".join(self._text).split("\n")
        text, self._text = clean("\n".join(" ".join(line.split()) for line in lines)), None
        for place in range(min(self._columns, MOST_COLUMNS + 1 - len(self._row))):
            cell = "" if place else text
            below = range(self._number + 1, self._number + self._rows)
            self._spanning.update({(number, len(self._row)): cell for number in below})
            self._row.append(cell)

    def _add_spanning(self, row: list[str]) -> None:
        while (self._number, len(row)) in self._spanning:
            row.append(self._spanning.pop((self._number, len(row))))

    def _end_row(self) -> None:
        self._end_cell()
        if self._row is not None:
            self._add_spanning(self._row)
            self.collector.add(self._line, self._row)
            self._number += 1
        self._row = None


def _span(value: str | None) -> int:
    """Return a number of columns or rows, at least 1 and limited."""
    return min(max(int(value), 1), MOST_COLUMNS) if value and re.fullmatch("[0-9]{1,5}", value) else 1
