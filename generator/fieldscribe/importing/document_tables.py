"""Tables inside documents: Markdown rows, lines with tabs in the text of a manual, and HTML."""

from __future__ import annotations

import re
from html.parser import HTMLParser

from fieldscribe.importing.cells import clean, one_line
from fieldscribe.importing.tables import MOST_COLUMNS, Table, TableCollector, UnreadableError

_MARKDOWN_ROW = re.compile(r"\s*\|.*\|\s*")
_MARKDOWN_RULE = frozenset(" \t|:+=-")
_UNESCAPED_BAR = re.compile(r"(?<!\\)\|")
_HEADING = re.compile(r"\s{0,3}(?:(#{1,6})\s+)?(?:(\d{1,3}(?:\.\d{1,3}){1,5})\.?\s*(?=\s|[^\W\d]))?(\S.*)")
_CONTENTS_LINE = re.compile(r".*\.{3,}[\s|]*\d*\s*|\d{1,3}(?:\.\d{1,3})+\t[^\t]*\t\d+\s*")
_LONGEST_HEADING, _LONGEST_LINE = 160, 100_000
_HTML_HEADINGS = frozenset({"h1", "h2", "h3", "h4", "h5", "h6", "caption"})


def read_text(text: str) -> list[Table]:
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
    """Return what separates the cells of a line, `|` or a tab; empty for prose and tables of contents."""
    if "|" in line and _MARKDOWN_ROW.fullmatch(line):
        return "|"
    is_contents = len(line) < 2 * _LONGEST_HEADING and _CONTENTS_LINE.fullmatch(line)
    return "\t" if "\t" in line.strip() and not is_contents else ""


def _split(line: str, separator: str) -> list[str]:
    if separator == "\t":
        return [clean(cell) for cell in line.split("\t")]
    inner = line.strip()[1:-1]
    return [clean(cell.replace("\\|", "|")) for cell in _UNESCAPED_BAR.split(inner)]


def read_html(text: str) -> list[Table]:
    """Return the tables of a page, each with the heading or caption above it.

    A cell that spans rows stands in each of them, one that spans columns in the first; a table inside a cell is text.
    """
    parser = _TableParser()
    parser.feed(text)
    parser.close()
    parser.end_table()
    return parser.collector.tables


class _TableParser(HTMLParser):
    """Collects rows while tags arrive; an element that is never closed ends where the next one begins."""

    def __init__(self) -> None:
        super().__init__(convert_charrefs=True)
        self.collector = TableCollector()
        self._heading = ""
        self._text: list[str] | None = None
        self._row: list[str] | None = None
        self._depth = self._line = self._number = 0
        self._columns = self._rows = 1
        self._spanning: dict[tuple[int, int], str] = {}
        """By number of the row, and by column, the texts of cells that began in a row above."""

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
