"""What new rows of tables seem to be: read as `import table` reads them, written as the described rows beside them."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import cached_property
from itertools import groupby
from typing import TYPE_CHECKING, NamedTuple

from fieldscribe.audit.editions.findings import Draft
from fieldscribe.audit.editions.likeness import Described, like
from fieldscribe.audit.editions.new_groups import new_group
from fieldscribe.audit.editions.tables import Wishes, draft
from fieldscribe.audit.editions.tables.draft_text import point_lines
from fieldscribe.audit.editions.tables.tables import UnreadableError
from fieldscribe.audit.editions.tables.text_tables import read_text
from fieldscribe.audit.editions.titles import Titles

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from fieldscribe.audit.editions.changes import Editions
    from fieldscribe.audit.editions.holding import Pair
    from fieldscribe.audit.editions.tables import Seen
    from fieldscribe.audit.editions.tables.drafts import DraftPoint
    from fieldscribe.resolve.analysis import Analysis
    from fieldscribe.resolve.points import ResolvedPoint

_COLUMNS = re.compile(r"(?<=[^\s|]) {3,}(?=[^\s|])")
"""What parts the columns of a table that is set with blanks alone."""


class _Table(NamedTuple):
    """What tells a table from others: its heads, and its title or the heading above it. Page breaks do not part it."""

    heads: tuple[str, ...]
    title: str
    heading: str


class _Row(NamedTuple):
    """A row that became a point, as it was read, with its table and the piece of it that the row stands in."""

    read: DraftPoint
    table: _Table
    seen: Seen


class Drafts:
    """Makes drafts of rows that only the new edition has."""

    def __init__(
        self, subject: Analysis, editions: Editions, pairs: Iterable[Pair], glossary: Mapping[str, str]
    ) -> None:
        self.subject, self.editions = subject, editions
        language = next((document.language for document in subject.scope.documents.values()), "en")
        self.titles = Titles(subject, language, glossary)
        points = {resolved.point.item: resolved for resolved in subject.resolved}
        self._drafted_at: dict[str, int] = {}
        self._heads: dict[_Table, int] = {}
        self.points_at: dict[int, dict[str, tuple[ResolvedPoint, str]]] = {}
        for pair in pairs:
            claim = pair.claim
            if pair.new is None or claim.subject not in points:
                continue
            resolved = points[claim.subject]
            if claim.cited == ((resolved.facts.get("line"), 0),):
                at_line = self.points_at.setdefault(pair.new.cited[0][0], {})
                at_line.setdefault(claim.subject, (resolved, claim.where))

    def of(self, lines: Iterable[int]) -> Iterator[Draft]:
        """The drafts of lines of the new edition that are new rows, and not points already: one for each place."""
        news = [line for line in lines if line not in self.points_at and self._is_new(line)]
        rows = [self._rows[line] for line in news if line in self._rows] if news else []
        for table, here in groupby(rows, key=lambda row: row.table):
            yield from self._of_table(table, list(here))

    def _is_new(self, line: int) -> bool:
        """Whether the row opens with something new: its code or address."""
        words = self.editions.new.of_line(line)
        return bool(words) and self.editions.is_new(words[0])

    @cached_property
    def _rows(self) -> dict[int, _Row]:
        """All rows of the new edition that can be read as points, by line."""
        try:
            text = "\n".join(_COLUMNS.sub("\t", line) for line in self.editions.new.lines)
            drafted = draft(read_text(text), Wishes(ranges=self._ranges()))
        except UnreadableError:
            return {}
        points = {point.line: point for group in drafted.groups for point in group.points}
        rows: dict[int, _Row] = {}
        table = _Table((), "", "")
        for seen in drafted.seen:
            if seen.columns.first or seen.columns.heads != table.heads:
                table = _Table(seen.columns.heads, seen.columns.title, seen.table.heading)
            lines = (row.line for row in seen.table.rows if seen.taken)
            rows.update({line: _Row(points[line], table, seen) for line in lines if line in points})
        return rows

    def _ranges(self) -> str:
        """What the description takes the manual's columns of ranges for."""
        keys = [
            key for resolved in self.subject.resolved for key in ("range", "range_in_units") if resolved.facts.get(key)
        ]
        return "units" if keys.count("range_in_units") > keys.count("range") else "raw"

    def _of_table(self, table: _Table, rows: list[_Row]) -> Iterator[Draft]:
        if beside := self._described.get(table):
            for described, here in groupby(rows, key=lambda row: _nearest(beside, row.read.line)):
                yield self._points_beside(described, beside, [row.read for row in here])
        else:
            yield self._group(table, rows)

    @cached_property
    def _described(self) -> dict[_Table, list[Described]]:
        """The described rows of each table."""
        described: dict[_Table, list[Described]] = {}
        for line, row in sorted(self._rows.items()):
            for resolved, place in self.points_at.get(line, {}).values():
                described.setdefault(row.table, []).append(Described(line, resolved, place, row.read))
        return described

    def _alike(self, table: _Table, line: int) -> list[list[Described]]:
        """The described rows of tables with the same heads, the nearest first."""
        alike = [rows for other, rows in self._described.items() if other.heads == table.heads]
        return sorted(alike, key=lambda rows: min(abs(row.line - line) for row in rows))

    def _points_beside(self, described: Described, beside: list[Described], points: list[DraftPoint]) -> Draft:
        group = described.group
        own_section = described.resolved.facts.node.get("section", "")
        lines: list[str] = []
        for point in points:
            lines += self._lines(replace(point, section=own_section), beside, group.get("access"), "")
        below = described.line < points[0].line
        indent = _indent(described)
        place = f"{'below' if below else 'above'} {described.place}"
        last = self._drafted_at.get(place)
        self._drafted_at[place] = points[-1].line
        place = place if last is None else f"below the point of line {last}"
        return Draft(points[0].line, _counted(points), place, "\n".join(indent + line for line in lines))

    def _lines(self, point: DraftPoint, beside: list[Described], access: str | None, section: str) -> list[str]:
        title = point.title or point.code
        point = like(replace(point, name=self.titles.name(title, point.code)), beside)
        lines = point_lines(point, access or "rw", section, self.titles.titled)
        return self.titles.asking(lines, title)

    def _group(self, table: _Table, rows: list[_Row]) -> Draft:
        """A new table is a group, with its head where its first row is new: feet of pages may part its rows."""
        points = [row.read for row in rows]
        alike = self._alike(table, points[0].line)
        tables = [(described, self._rows[described[0].line].seen) for described in alike]
        group = new_group(self.subject, rows[0].seen, points, tables)
        first = self._heads.setdefault(table, points[0].line)
        is_first = first == points[0].line
        lines = self.titles.asking(group.head(self.titles), group.title) if is_first else []
        for point in points:
            lines += self._lines(replace(point, section=""), alike[0] if alike else [], group.access, "")
        place = group.place if is_first else f"in the group of line {first}"
        kind = f"a group with {_counted(points)}" if is_first else _counted(points)
        return Draft(points[0].line, kind, place, "\n".join(lines))


def _nearest(beside: list[Described], line: int) -> Described:
    """The row above, or else the first one below."""
    return max((row for row in beside if row.line < line), key=lambda row: row.line, default=beside[0])


def _indent(described: Described) -> str:
    """What stands before the dash of the point in its file."""
    node = described.resolved.facts.row
    line = node.file.text.splitlines()[node.span(next(iter(node))).line - 1]
    blanks = line[: len(line) - len(line.lstrip())]
    return blanks if line.lstrip().startswith("- ") else ""


def _counted(points: list[DraftPoint]) -> str:
    return "a point" if len(points) == 1 else f"{len(points)} points"
