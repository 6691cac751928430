"""Drafts of descriptions from tables: a file's tables, their columns, their rows, and what is open about them.

Nothing is guessed: what the cells leave open is left out, and a question stands where it belongs.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from fieldscribe.audit.editions.tables.columns import Columns
    from fieldscribe.audit.editions.tables.drafts import DraftGroup
    from fieldscribe.audit.editions.tables.rows import Read
    from fieldscribe.audit.editions.tables.tables import Table


@dataclass(frozen=True, slots=True)
class Wishes:
    """What the caller says: columns by role, the space, and which tables (by number, or lines first..last).

    `ranges` says what columns of ranges hold that do not show it: `raw` numbers, or values in `units`.
    """

    columns: Mapping[str, tuple[int, ...]] = field(default_factory=dict)
    space: str | None = None
    tables: tuple[int, ...] = ()
    lines: tuple[int, int] | None = None
    ranges: str | None = None


class Seen(NamedTuple):
    """A table with its columns, and whether points are drafted from it."""

    table: Table
    columns: Columns
    taken: bool


class Drafted(NamedTuple):
    """The groups that were drafted, all tables that were looked at, and the language of their heads."""

    groups: list[DraftGroup]
    seen: list[Seen]
    language: str


def draft(tables: Sequence[Table], wishes: Wishes) -> Drafted:
    """Draft groups of points from the tables that hold points."""
    from fieldscribe.audit.editions.tables.grouping import grouped, language_of, named
    from fieldscribe.audit.editions.tables.rows import rows_of, shows_of_range
    from fieldscribe.audit.editions.tables.settling import each_once, limits_known

    seen = _looked_at(tables, wishes)
    merges = _print_dashes(seen)
    read: list[tuple[Seen, list[Read]]] = []
    shown: dict[str, Counter[str]] = {}
    for entry in seen:
        if entry.taken:
            rows = rows_of(entry.table, entry.columns, merges=merges)
            read.append((entry, rows))
            shown.setdefault(_range_head(entry.columns), Counter()).update(shows_of_range(rows, entry.columns))
    columns = {head: counts.most_common(1)[0][0] for head, counts in shown.items() if counts}
    language = language_of(head for entry in seen if entry.taken for head in entry.columns.heads)
    groups = grouped(
        [(*entry, columns.get(_range_head(entry[0].columns), wishes.ranges)) for entry in read], wishes.space
    )
    each_once(groups)
    limits_known(groups)
    groups = [group for group in groups if group.points]
    named(groups)
    return Drafted(groups, seen, language)


def _looked_at(tables: Sequence[Table], wishes: Wishes) -> list[Seen]:
    """The wanted tables with their columns; a table without heads has those of the one above it."""
    from fieldscribe.audit.editions.tables.columns import columns_of
    from fieldscribe.audit.editions.tables.sheets_of_facts import upright

    seen: list[Seen] = []
    known = None
    for table in map(upright, tables):
        columns = columns_of(table, known, wishes.columns)
        known = columns
        if wishes.tables and table.number not in wishes.tables:
            continue
        if wishes.lines and not wishes.lines[0] <= table.line <= wishes.lines[1]:
            continue
        seen.append(Seen(table, columns, columns.are_points and len(table.rows) > columns.first))
    return seen


def _range_head(columns: Columns) -> str:
    """The head of the column of ranges: tables that share it print their ranges alike."""
    return next((columns.heads[place] for place in columns.places.get("range", ()) if place < len(columns.heads)), "")


def _print_dashes(seen: Sequence[Seen]) -> bool:
    """Whether the tables print a dash where there is nothing, so that an empty cell is merged with the one above."""
    cells = [cell.strip() for entry in seen if entry.taken for row in entry.table.rows for cell in row.cells]
    return sum(cell in ("-", "—", "–") for cell in cells) * 50 > len(cells)
