"""Small tables that lie on their side: each row is a fact (`ID | 57`, `Range | 0 to 70`), the title is the heading."""

from __future__ import annotations

from fieldscribe.audit.editions.tables.cell_text import one_line
from fieldscribe.audit.editions.tables.head_words import role_of
from fieldscribe.audit.editions.tables.tables import Row, Table

_NAME = "Name"


def upright(table: Table) -> Table:
    """The table as one row below its heads, if it stands on its side; else as it is."""
    facts = [
        (one_line(row.cells[0]), row.cells[1]) for row in table.rows if len(row.filled) == 2 and len(row.cells) > 1
    ]
    roles = [role_of(head) for head, _ in facts]
    if len(facts) < len(table.rows) or None in roles or len(set(roles)) < len(roles) or "address" not in roles:
        return table
    heads, values = zip(*facts, strict=True)
    rows = (Row(table.line, (_NAME, *heads)), Row(table.line, (table.heading, *values)))
    return Table(table.number, table.heading, table.section, table.around, rows)
