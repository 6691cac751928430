"""Tables as readers find them in a file: cells of text, each row with its line (or its row of a sheet)."""

from __future__ import annotations

from dataclasses import dataclass

MOST_BYTES = 64 << 20
"""The largest file that is read."""
MOST_ROWS, MOST_COLUMNS, MOST_CELL = 50_000, 400, 8_000
"""Rows of all tables, columns of one, characters of a cell: more than any manual has."""


class UnreadableError(Exception):
    """The file cannot be read as tables; `line` is where (0 if it is about the whole file)."""

    def __init__(self, message: str, line: int = 0) -> None:
        super().__init__(message)
        self.message = message
        self.line = line


class MissingExtraError(Exception):
    """A library that only an extra brings is not installed; `extra` is its name."""

    def __init__(self, extra: str) -> None:
        super().__init__(extra)
        self.extra = extra


@dataclass(frozen=True, slots=True)
class Row:
    """One row. A cell that is merged with the one above is empty; line breaks inside a cell are kept."""

    line: int
    cells: tuple[str, ...]

    @property
    def filled(self) -> tuple[str, ...]:
        """The cells that hold something."""
        return tuple(cell for cell in self.cells if cell.strip())


@dataclass(frozen=True, slots=True)
class Table:
    """A table with what stands above it: the nearest heading, its number, and the heading of the section around it."""

    number: int
    heading: str
    section: str
    around: str
    rows: tuple[Row, ...]

    @property
    def line(self) -> int:
        """Where it begins."""
        return self.rows[0].line

    @property
    def last(self) -> int:
        """Where it ends."""
        return self.rows[-1].line

    @property
    def width(self) -> int:
        """How many columns its widest row has."""
        return max(len(row.cells) for row in self.rows)


class Gathered:
    """The tables of a file while it is read; keeps the bounds."""

    def __init__(self) -> None:
        self.tables: list[Table] = []
        self._rows: list[Row] = []
        self._count = 0

    def add(self, line: int, cells: list[str]) -> None:
        """One more row of the table that is being read."""
        self._count += 1
        if self._count > MOST_ROWS:
            raise UnreadableError(f"there are more than {MOST_ROWS} rows; import the tables one by one", line)
        if len(cells) > MOST_COLUMNS:
            raise UnreadableError(f"the row has more than {MOST_COLUMNS} cells", line)
        if any(len(cell) > MOST_CELL for cell in cells):
            raise UnreadableError(f"a cell has more than {MOST_CELL} characters", line)
        self._rows.append(Row(line, tuple(cells)))

    def close(self, heading: str, section: str = "", around: str = "") -> None:
        """The table ends here, if one was read: rows of at least two columns."""
        rows = tuple(row for row in self._rows if row.filled)
        if rows and max(len(row.cells) for row in rows) > 1:
            self.tables.append(Table(len(self.tables) + 1, heading, section, around, rows))
        self._rows = []
