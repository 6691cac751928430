"""Finds out which column of a table holds what: by its heading, in English or German, or as the user says."""

import re
from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

from fieldscribe.importing.cells import one_line
from fieldscribe.importing.readers import Row, Table

Wanted = Mapping[str, Sequence[str]]

IGNORED = "ignore"
ROLES = (
    *("code", "name", "address", "space", "bits", "type", "length", "access", "range", "least", "greatest", "step"),
    *("unit", "default", "formula", "description", IGNORED),
)
"""The roles of columns."""
_JOINED = ("address", "description", IGNORED)
"""Roles that several columns may have."""

_ADDRESS_BEFORE = (
    r"modbus|modicon|register|reg|start|can|bus|wire|protocol|data|mb|plc|holding|input|parameter|coil|discrete|object|io"
    r"|protokoll|daten|speicher|wort"
)
_ADDRESS_AFTER = r"nr|no|nummer|number|hex|dec|dez|dezimal|decimal|hexadezimal|hexadecimal|adresse|address|modbus"
_HEADINGS = {
    "step": (
        r"resolution|res|step( size)?|increment|lsb|(min(imum)? )?setting unit|scale|scaling|factor|scale factor|"
        r"multiplier|auflösung|schritt(weite)?|inkrement|skalierung|faktor|skalierungsfaktor|multiplikator|"
        r"umrechnungsfaktor"
    ),
    "default": (
        r"default( value| setting)?|factory( setting| default)?|initial( value| setting)?|standard(wert)?|"
        r"werks?einstellung|ab werk|vorgabewert|grundeinstellung"
    ),
    "least": r"min(imum|imal|\.)?( value| ?wert)?|lower limit|untergrenze",
    "greatest": r"max(imum|imal|\.)?( value| ?wert)?|upper limit|obergrenze",
    "formula": r"formula|conversion( formula)?|(berechnungs|umrechnungs)?formel|umrechnung",
    "access": (
        r"r ?/ ?w|r ?/ ?o|rw|w ?/ ?r|access( type| mode| right| rights)?|read ?/ ?write|permission|attr(ibute)?s?|"
        r"rights|zugriff(sart|srecht)?|lesen ?/ ?schreiben"
    ),
    "unit": r"units?|dim(ension)?|uom|eng(ineering)? units?|(mass|mess)?einheit(en)?",
    "type": r"(data )?(type|format)|(daten)?typ|datenformat|datenart|variablentyp|art",
    "length": (
        r"(number|no) of (registers?|words)|length|size|words|count|qty|anzahl( der)? (register|worte|wörter)|"
        r"länge|worte|wörter"
    ),
    "bits": r"bits?( ?(nr|no|number|position|pos))?|bitnummer|bit ?nummer",
    "space": (
        r"(register|object|modbus|data) ?(type|table|area|space)|space|fc|function codes?|area|registertyp|tabelle|"
        r"funktionscodes?|bereichstyp"
    ),
    "range": (
        r"(setting |data |value |valid |adjustment |input )?range( of (values|setting))?|limits?|valid values|"
        r"min ?(/|\.\.+|-) ?max|(werte|einstell|daten|anzeige|zulässiger )?bereich|grenz(en|werte)|gültige werte"
    ),
    "code": (
        r"(func(tion)?|par(am)?(eter)?|cmd|menu|p)[ -]?(code|no|num|number)|code|tag|mnemonic|symbol|(fkt|"
        r"funktions|par(ameter)?|menü|p)[ -]?(code|nr|nummer)( ?nr)?|kürzel|kennung"
    ),
    "address": (
        rf"(({_ADDRESS_BEFORE})[ -]?)*(address|adresse|addr?|register|reg|offset|pnu|index|id|coil)"
        rf"([ -]?({_ADDRESS_AFTER}))*"
    ),
    "name": (
        r"(parameter|signal|register|point|function|variable|object|tag|data)?[ -]?(name|title|label)|function|"
        r"parameter|signal|variable|measurement|quantity|process data|item|data|meaning|value|setting|content.*|"
        r"(signal)?bezeichnung|titel|funktion|messwert|inhalt.*|prozessdaten|daten|bedeutung|wert|größe|"
        r"einstellung|begriff"
    ),
    "description": (
        r"descriptions?|remarks?|comments?|notes?|details|explanation|options|values|information|enum(eration)?|"
        r"beschreibung|bemerkung(en)?|kommentar|erläuterung(en)?|hinweise?|auswahl|werte|anmerkung(en)?|"
        r"wertebedeutung"
    ),
}
"""The usual headings of each role, English and German; the first role that fits wins."""

_PATTERNS = {role: re.compile(words) for role, words in _HEADINGS.items()}
_LONGEST_HEADING, _MOST_HEADING_ROWS = 60, 4
_IN_BRACKETS = re.compile(r"\[[^\]]*\]|\([^)]*\)|\{[^}]*\}")
_SEPARATORS = re.compile(r"[.:;*#_,\s-]*[.:;*#_,\s]+[.:;*#_,\s-]*")
_NUMBER = re.compile(r"[\d.,/x-]*\d[\d.,/x-]*|0x[0-9A-F]+|[0-9A-F]*\d[0-9A-F]*h", re.IGNORECASE)


class Columns(NamedTuple):
    """A table with its columns: by role their places from 0, all headings, a title above them, the first data row."""

    table: Table
    places: Mapping[str, tuple[int, ...]]
    headings: tuple[str, ...]
    title: str = ""
    first: int = 0

    def heading(self, role: str) -> str:
        """Return the heading of the first column with this role."""
        return next((self.headings[place] for place in self.places.get(role, ())), "")

    def is_hex(self, place: int) -> bool:
        """Return True if the heading says that the numbers are hexadecimal."""
        return re.search(r"\bhex|0x|\(h\)", self.headings[place].casefold()) is not None

    @property
    def hold_points(self) -> bool:
        """Return True if the rows can be points: columns identify a point and describe it."""
        return bool(
            self.places.keys() & {"address", "code"}
            and self.places.keys() & {"name", "description", "range", "unit", "type", "access"}
        )

    @property
    def unread(self) -> list[str]:
        """Return the non-empty columns without a role, or with a role that another column has already."""
        read = {place for role, places in self.places.items() for place in (places if role in _JOINED else places[:1])}
        filled = {
            place for row in self.table.rows[self.first :] for place, cell in enumerate(row.cells) if cell.strip()
        }
        return [self.headings[place] or f"column {place + 1}" for place in sorted(filled - read)]


def role_of(heading: str) -> str | None:
    """Return the role of a column with this heading; None if it is unknown."""
    if len(heading) > _LONGEST_HEADING:
        return None
    plain = heading.casefold().replace("-\n", "").replace("\n", " ")
    for text in (plain, _IN_BRACKETS.sub(" ", plain)):
        words = _SEPARATORS.sub(" ", text).strip(" -/")
        role = next((role for role, pattern in _PATTERNS.items() if words and pattern.fullmatch(words)), None)
        if role:
            return role
    return None


def columns_of(table: Table, wanted: Wanted, above: Columns | None) -> Columns:
    """Return the columns of a table; a table without headings has those of the table `above` if that is equally wide.

    `wanted` holds for each role the headings or column numbers that the user named.
    """
    named = {same_heading(name) for names in wanted.values() for name in names}
    title, headings, first = _headings(table, named)
    if not first and above is not None and len(above.headings) == table.width:
        return Columns(table, above.places, above.headings)
    forced = {
        role: tuple(place for name in names for place in _places(name, headings) if place < table.width)
        for role, names in wanted.items()
    }
    taken = {place for places in forced.values() for place in places}
    places: dict[str, tuple[int, ...]] = {role: found for role, found in forced.items() if found}
    for place, heading in enumerate(headings):
        role = role_of(heading)
        if role and place not in taken and role not in forced:
            places[role] = (*places.get(role, ()), place)
    return Columns(table, places, headings, title, first)


def _is_heading_row(cells: Iterable[str], named: Iterable[str] = ()) -> bool:
    """Return True if no cell is a number, and at least two (or one that the user named) are known as headings."""
    filled = [one_line(cell) for cell in cells if cell.strip()]
    if any(_NUMBER.fullmatch(cell) for cell in filled):
        return False
    known = sum(role_of(cell) is not None for cell in filled)
    return (known >= 2 and known * 2 >= len(filled)) or any(same_heading(cell) in named for cell in filled)


def _headings(table: Table, named: Iterable[str]) -> tuple[str, tuple[str, ...], int]:
    """Return the title inside the table, the heading of each column (the lowest of stacked ones), and the first row."""
    title, headings, first = "", [""] * table.width, 0
    for row in table.rows[:_MOST_HEADING_ROWS]:
        if len(row.filled) == 1 and table.width > 2 and not any(headings) and same_heading(row.filled[0]) not in named:
            title = one_line(row.filled[0])
        elif _is_heading_row(row.cells, named) or (any(headings) and _continues_headings(row)):
            for place, cell in enumerate(row.cells):
                headings[place] = one_line(cell) or headings[place]
        else:
            break
        first += 1
    return title, tuple(headings), first if any(headings) else 0


def _continues_headings(row: Row) -> bool:
    """Return True for a second row of headings, below headings that span several columns."""
    filled = [one_line(cell) for cell in row.filled]
    has_digits = any(char.isdigit() for cell in filled for char in cell)
    return not has_digits and len(filled) > 1 and sum(map(bool, map(role_of, filled))) * 2 >= len(filled)


def _places(name: str, headings: Sequence[str]) -> list[int]:
    """Return the columns with this heading; a number that is not a heading counts columns from 1."""
    places = [place for place, heading in enumerate(headings) if same_heading(heading) == same_heading(name)]
    return [int(name) - 1] if not places and is_column_number(name) else places


def is_column_number(name: str) -> bool:
    """Return True for the number of a column, counted from 1."""
    return name.isascii() and name.isdigit() and 1 <= int(name[:6]) <= 400


def same_heading(heading: str) -> str:
    """Return a heading for comparison: without capitals and extra blanks."""
    return " ".join(heading.split()).casefold()


def upright(table: Table) -> Table:
    """Return a table that prints one fact in each row (`ID | 57`, `Range | 0 to 70`) as one row below headings.

    Its heading becomes the name; any other table is returned unchanged.
    """
    facts = [(one_line(row.cells[0]), row.cells[1]) for row in table.rows if len(row.filled) == 2]
    roles = [role_of(heading) for heading, _ in facts]
    if len(facts) < len(table.rows) or None in roles or len(set(roles)) < len(roles) or "address" not in roles:
        return table
    headings, values = zip(*facts, strict=True)
    rows = (Row(table.line, ("Name", *headings)), Row(table.line, (table.heading, *values)))
    return Table(table.number, table.parent or table.heading, table.section, "", rows)
