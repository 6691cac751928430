"""Tables to groups: one group for tables under one title in one space; then names for groups and points."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from fieldscribe.audit.editions.tables.addresses import numberings_of
from fieldscribe.audit.editions.tables.drafts import DraftGroup
from fieldscribe.audit.editions.tables.naming import Names, snake
from fieldscribe.audit.editions.tables.rows import Context, points_of
from fieldscribe.audit.editions.tables.settling import paired, share_labels, titled

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from fieldscribe.audit.editions.tables import Seen
    from fieldscribe.audit.editions.tables.columns import Columns
    from fieldscribe.audit.editions.tables.rows import Read
    from fieldscribe.audit.editions.tables.tables import Table

_SPACES = (
    ("coil", re.compile(r"\bcoils?\b|coil[- ]")),
    ("discrete", re.compile(r"discrete|diskret|1x{4}|status inputs?")),
    ("input", re.compile(r"input[- ]reg|eingangsregister|3x{4}\b|\b0?4h? read input")),
    ("parameter", re.compile(r"^(?:id|pnu|parameter[- ]?(?:id|nr\.?|no\.?|number|nummer|adresse|address))$")),
)
"""The words of headings and heads that say in which space the points are; the others are holding registers."""
_GERMAN = re.compile(
    r"\b(?:adresse|bezeichnung|beschreibung|einheit|bereich|wertebereich|zugriff|werkseinstellung|auflösung|funktion|datentyp|art|"
    r"grundwert|bemerkung|fkt|nr|wert|bedeutung|prozessdaten|einstellbereich|berechnungsformel)\b"
)


def grouped(read: Iterable[tuple[Seen, list[Read], str | None]], space: str | None) -> list[DraftGroup]:
    """The groups in the order of the file."""
    groups: dict[tuple[str, str], DraftGroup] = {}
    for seen, rows, column in read:
        table, columns = seen.table, seen.columns
        numberings = numberings_of([row.numbers for row in rows])
        where = space or numberings.space or _space_of(table, columns)
        context = Context(columns, where, numberings, column, table.section)
        points = titled(list(points_of(rows, context)), rows)
        share_labels(points)
        title = columns.title or table.around or table.heading or "Points"
        section = table.section.rpartition(".")[0] if table.around and not columns.title else table.section
        group = groups.setdefault((title, where), DraftGroup(title, where, section))
        group.numberings |= {name: offset for offset, name in numberings.names.items()}
        group.points += paired(points)
    return list(groups.values())


def _space_of(table: Table, columns: Columns) -> str:
    heads = [
        columns.heads[place].casefold() for place in columns.places.get("address", ()) if place < len(columns.heads)
    ]
    for texts in (heads, [columns.title.casefold()], [table.heading.casefold()]):
        for space, words in _SPACES:
            if any(words.search(text) for text in texts):
                return space
    return "holding"


def language_of(heads: Iterable[str]) -> str:
    """The language of the heads of columns: German if most known words are, else English."""
    german = [bool(_GERMAN.search(head.casefold())) for head in heads if head]
    return "de" if sum(german) * 4 > len(german) > 0 else "en"


def named(groups: Sequence[DraftGroup]) -> None:
    """Give every group and point a name of its own."""
    of_groups, of_points = Names(), Names()
    for group in groups:
        group.name = of_groups.give(snake(group.title, "points"), group.space)
        for point in group.points:
            otherwise = snake(point.code) if point.code else f"{group.space}_{_place(point.shown)}"
            title = point.title or point.code or otherwise
            point.title = title
            name = f"reserved_{_place(point.shown)}" if point.reserved else snake(title, snake(point.code, "point"))
            point.name = of_points.give(name, snake(point.code) if point.code else _place(point.shown))


def _place(shown: str) -> str:
    return shown.lower().replace("~", "unknown")
