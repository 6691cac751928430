"""Which column of a table holds what: by the words of its head, by the forms of its cells, or as the caller says."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.audit.editions.tables.cell_text import one_line
from fieldscribe.audit.editions.tables.head_words import MOST_HEAD, ROLES, base_of, role_of, unit_in

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from fieldscribe.audit.editions.tables.tables import Row, Table

_NUMBER = re.compile(r"0x[0-9A-F]+|[0-9A-F]*\d[0-9A-F]*\s?h?", re.IGNORECASE)
_ADDRESS = re.compile(r"[\s/,;()\[\]-]*(?:(?:0x|[hH]')?[0-9A-Fa-f]{1,6}\s?[hH]?[\s/,;()\[\].-]*){1,4}|[-—–]|h?")
_CODE = re.compile(r"[A-Za-z]{1,4}[-. ]?\d{1,4}(?:[.-]\d{1,3})*(?:\s?\[-?\d+\])?(?:\s*\(.*\))?")
_ACCESS = re.compile(
    r"(?:r|w|r ?/ ?w|rw|r/o|w/o|ro|wo|read(?:[ /-]?only)?|write(?:[ /-]?only)?|read ?/ ?write|[-—–]?)", re.IGNORECASE
)
_STEP = re.compile(r"(?:0?[.,]0*[125]|10*|[-—–])\s*[^\d]{0,12}")
_MOST_HEADS = 4
_TELLING = frozenset({"range", "unit", "type", "access", "step", "default", "formula"})
"""Only points have such columns: beside one of them, numbers are addresses."""
_WEAK = re.compile(r"(?:lfd )?(?:nr|no|num|number|nummer|#|index)")


@dataclass(frozen=True, slots=True)
class Columns:
    """The columns of a table: by role their places from 0, the head of each, and where the data begins."""

    places: Mapping[str, tuple[int, ...]]
    heads: tuple[str, ...]
    title: str
    first: int

    def base(self, place: int) -> int | None:
        """The base of the numbers in a column, where its head says one."""
        return base_of(self.heads[place]) if place < len(self.heads) else None

    def unit(self, role: str) -> str:
        """The unit in the head of a column."""
        return next((unit_in(self.heads[place]) for place in self.places.get(role, ()) if place < len(self.heads)), "")

    @property
    def are_points(self) -> bool:
        """Whether rows of the table look like points: something says where or which, and something what."""
        place = self.places.keys() & {"address", "code"}
        told = self.places.keys() & {"name", "description", "range", "unit", "type", "access"}
        return bool(place and told)


def columns_of(table: Table, known: Columns | None, forced: Mapping[str, tuple[int, ...]]) -> Columns:
    """The columns of a table; a table without heads goes on with the `known` ones of the table above it."""
    title, heads, first = _heads(table)
    body = [row.cells for row in table.rows[first:]]
    if not any(map(role_of, heads)) and known is not None and len(known.heads) == table.width:
        heads = known.heads
    places = _by_heads(heads, body)
    _by_forms(places, heads, body)
    for role, said in forced.items():
        taken = set(said)
        places = {other: rest for other, at in places.items() if (rest := tuple(p for p in at if p not in taken))}
        places[role] = said
    if forced and not first and not _has_number(table.rows[0], places.get("address", places.get("code", ()))):
        first = 1
    return Columns(places, heads, title, first)


def _has_number(row: Row, places: Iterable[int]) -> bool:
    return any(char.isdigit() for place in places if place < len(row.cells) for char in row.cells[place])


def is_head(cells: Iterable[str]) -> bool:
    """Whether a row repeats heads: at least two say what a column holds, and no cell is a number."""
    filled = [one_line(cell) for cell in cells if cell.strip()]
    if len(filled) < 2 or any(len(cell) < MOST_HEAD and _NUMBER.fullmatch(cell) for cell in filled):
        return False
    known = sum(role_of(cell) is not None for cell in filled)
    return known >= 2 and known * 2 >= len(filled)


def _heads(table: Table) -> tuple[str, tuple[str, ...], int]:
    """The table's own title, the head of each column (the heads above it before its own), and the first row of data."""
    title, stacked, first = "", [""] * table.width, 0
    for row in table.rows[:_MOST_HEADS]:
        filled = row.filled
        if len(filled) == 1 and table.width > 2 and not any(stacked):
            title = one_line(filled[0])
        elif is_head(row.cells) or _goes_on(row, stacked):
            _stack(row, stacked)
        else:
            break
        first += 1
    return title, tuple(stacked), first


def _goes_on(row: Row, stacked: list[str]) -> bool:
    """Whether a row has heads alone, below or above others, as where a cell spans several columns."""
    filled = [one_line(cell) for cell in row.filled]
    if any(_CODE.fullmatch(cell) or _NUMBER.fullmatch(cell) or re.fullmatch(r"[\d.,h/x-]+", cell) for cell in filled):
        return False
    return len(filled) > 1 and sum(role_of(cell) is not None for cell in filled) >= (1 if any(stacked) else 2)


def _stack(row: Row, stacked: list[str]) -> None:
    for place, cell in enumerate(row.cells):
        if cell.strip():
            stacked[place] = one_line(cell)


def _by_heads(heads: tuple[str, ...], body: list[tuple[str, ...]]) -> dict[str, tuple[int, ...]]:
    places: dict[str, list[int]] = {}
    for place, head in enumerate(heads):
        cells = _filled(body, place)
        role = _settled(role_of(head), head, cells)
        if role is not None:
            places.setdefault(role, []).append(place)
    numbered = places.pop("number", [])
    if "address" not in places and _TELLING & places.keys():
        places["address"] = numbered
    names = places.get("name", [])
    if len(names) > 1:  # the first is the name, the others tell more
        places["description"] = [*names[1:], *places.get("description", [])]
        places["name"] = names[:1]
    elif not names and "code" in places and "description" in places:
        places["name"] = [places["description"].pop(0)]
    return {role: tuple(at) for role, at in places.items() if at}


def _settled(role: str | None, head: str, cells: list[str]) -> str | None:
    """The role of a column once its cells were looked at: words of heads mean different things in different manuals."""
    if role == "step or default":
        return "step" if _share(_STEP, cells) > 0.6 else "default"
    if role in ("code", "address"):
        return _which(role, head, cells)
    if role == "name" and cells and _share(_CODE, cells) > 0.8:
        return "code"
    return None if role == "access" and cells and _share(_ACCESS, cells) < 0.5 else role


def _which(role: str, head: str, cells: list[str]) -> str | None:
    """Whether a column that is called a number or code holds codes, addresses, or numbers that may be addresses."""
    if role == "address" and _share(_ADDRESS, cells) >= 0.5:
        return "address"
    if _share(_CODE, cells) >= (0.3 if role == "code" else 0.5):
        return "code"
    ordinal = _WEAK.fullmatch(head.casefold().strip(" ."))
    return "number" if role == "code" and not ordinal and _share(_ADDRESS, cells) > 0.8 else None


def _by_forms(places: dict[str, tuple[int, ...]], heads: tuple[str, ...], body: list[tuple[str, ...]]) -> None:
    """Find by their cells what columns without a head hold: access, and codes."""
    free = [place for place, head in enumerate(heads) if not head]
    for role, form, least in (("code", _CODE, 0.8), ("access", re.compile(r"[Rr](?:/?[WwOo])?|[Ww]/?[Oo]?"), 0.8)):
        for place in free:
            cells = _filled(body, place)
            if role not in places and len(cells) > 1 and _share(form, cells) >= least:
                places[role] = (place,)


def _filled(body: list[tuple[str, ...]], place: int) -> list[str]:
    return [cells[place] for cells in body if place < len(cells) and cells[place].strip()]


def _share(form: re.Pattern[str], cells: list[str]) -> float:
    return sum(form.fullmatch(one_line(cell)) is not None for cell in cells) / len(cells) if cells else 0.0


def said_columns(text: str) -> dict[str, tuple[int, ...]]:
    """The columns that the caller gives, as in `code=1,address=3,address=4`. Raises ValueError with what is wrong."""
    said: dict[str, list[int]] = {}
    for pair in text.split(","):
        role, sign, place = pair.strip().partition("=")
        if not sign or role not in ROLES:
            raise ValueError(f"`{pair.strip()}` is no column: write ROLE=NUMBER, with one of {', '.join(ROLES)}")
        if not (place.isascii() and place.isdigit() and 1 <= int(place[:6]) <= 400):
            raise ValueError(f"`{pair.strip()}`: columns are counted from 1")
        said.setdefault(role, []).append(int(place) - 1)
    return {role: tuple(at) for role, at in said.items()}
