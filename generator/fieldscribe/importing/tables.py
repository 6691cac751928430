"""Tables as the readers return them: rows of text cells, each with its line (or its row of a sheet)."""

from __future__ import annotations

from dataclasses import dataclass

MOST_BYTES = 64 << 20
"""The largest file that is read."""
MOST_ROWS, MOST_COLUMNS, MOST_CELL = 50_000, 400, 8_000
"""Limits: rows of all tables, columns of one table, characters of one cell."""


class UnreadableError(Exception):
    """The file cannot be read as tables, or has no such column; `line` is where (0: the whole file)."""

    def __init__(self, message: str, line: int = 0, hint: str = "") -> None:
        super().__init__(message)
        self.message = message
        self.line = line
        self.hint = hint


@dataclass(frozen=True, slots=True)
class Row:
    """One row; line breaks inside a cell are kept."""

    line: int
    cells: tuple[str, ...]

    @property
    def filled(self) -> tuple[str, ...]:
        """The cells that are not empty."""
        return tuple(cell for cell in self.cells if cell.strip())


@dataclass(frozen=True, slots=True)
class Table:
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
        """Add a row to the current table, without empty cells at its end. Raises UnreadableError beyond a limit."""
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
