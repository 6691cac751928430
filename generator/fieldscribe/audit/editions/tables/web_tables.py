"""Tables of an HTML page. Merged cells stand once, where they begin; tables inside cells are text of the cell."""

from __future__ import annotations

from html.parser import HTMLParser

from fieldscribe.audit.editions.tables.cell_text import clean, one_line
from fieldscribe.audit.editions.tables.tables import MOST_CELL, MOST_COLUMNS, Gathered, Table

_HEADINGS = frozenset({"h1", "h2", "h3", "h4", "h5", "h6", "caption"})
_CELLS = frozenset({"td", "th"})
_UNSEEN = frozenset({"script", "style", "template"})


def read_web(text: str) -> list[Table]:
    """The tables of a page, each with the heading or caption above it."""
    page = _Page()
    page.feed(text)
    page.close()
    page.finish_table()
    return page.gathered.tables


class _Page(HTMLParser):
    """Collects rows as tags come; what is never closed is closed by what follows."""

    def __init__(self) -> None:
        super().__init__(convert_charrefs=True)
        self.gathered = Gathered()
        self._heading = ""
        self._text: list[str] | None = None
        self._row: list[str] | None = None
        self._merged: dict[int, int] = {}
        self._depth = self._line = self._unseen = self._size = 0
        self._across = self._down = 1

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """A cell, row, table or heading begins."""
        if tag in _UNSEEN:
            self._unseen += 1
        elif tag == "table":
            self._depth += 1
        elif tag in _HEADINGS and self._depth <= 1:
            self._text, self._size = [], 0
        elif tag == "br" and self._text is not None:
            self._text.append("\n")
        elif self._depth == 1 and tag == "tr":
            self._finish_row()
            self._row, self._line = [], self.getpos()[0]
        elif self._depth == 1 and tag in _CELLS:
            self._begin_cell(dict(attrs))

    def handle_endtag(self, tag: str) -> None:
        """A cell, row, table or heading ends."""
        if tag in _UNSEEN:
            self._unseen = max(0, self._unseen - 1)
        elif tag in _HEADINGS and self._depth <= 1 and self._text is not None:
            self._heading, self._text = one_line(clean("".join(self._text))), None
        elif self._depth == 1 and tag in _CELLS:
            self._finish_cell()
        elif self._depth == 1 and tag == "tr":
            self._finish_row()
        elif tag == "table" and self._depth:
            self._depth -= 1
            if not self._depth:
                self.finish_table()

    def handle_data(self, data: str) -> None:
        """Text: kept inside cells and headings."""
        if self._text is not None and not self._unseen and self._size <= MOST_CELL:
            self._size += len(data)
            self._text.append(data)

    def finish_table(self) -> None:
        """The table ends."""
        self._finish_row()
        self.gathered.close(self._heading)
        self._merged = {}

    def _begin_cell(self, attributes: dict[str, str | None]) -> None:
        self._finish_cell()
        if self._row is None:
            self._row, self._line = [], self.getpos()[0]
        while self._merged.get(len(self._row), 0) > 0 and len(self._row) < MOST_COLUMNS:
            self._row.append("")
        self._text, self._size = [], 0
        self._across, self._down = _span(attributes.get("colspan")), _span(attributes.get("rowspan"))

    def _finish_cell(self) -> None:
        if self._text is None or self._row is None:
            return
        lines = "".join(self._text).split("\n")
        for place in range(min(self._across, MOST_COLUMNS + 1 - len(self._row))):
            if self._down > 1:
                self._merged[len(self._row)] = self._down
            self._row.append(clean("\n".join(" ".join(line.split()) for line in lines)) if not place else "")
        self._text = None

    def _finish_row(self) -> None:
        self._finish_cell()
        if self._row is not None:
            self.gathered.add(self._line, self._row)
            self._merged = {place: rows - 1 for place, rows in self._merged.items() if rows > 1}
        self._row = None


def _span(said: str | None) -> int:
    """A number of columns or rows, within reason."""
    return min(max(int(said), 1), MOST_COLUMNS) if said and said.isascii() and said.isdigit() and len(said) < 6 else 1
