"""From the rows of a table to points, one by one; what concerns several rows is in `settling`."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.audit.editions.tables import addresses, numbers
from fieldscribe.audit.editions.tables.cell_text import one_line, without_footnotes
from fieldscribe.audit.editions.tables.columns import is_head
from fieldscribe.audit.editions.tables.drafts import DraftErratum, DraftPoint
from fieldscribe.audit.editions.tables.labels import choices_in, first_labels, labels_in
from fieldscribe.audit.editions.tables.meaning import evidence, meaning_of
from fieldscribe.audit.editions.tables.said import take_apart
from fieldscribe.audit.editions.tables.words_of_rows import LONG, access_of, bits_of, half_of, is_reserved, type_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence

    from fieldscribe.audit.editions.tables.addresses import Number, Numberings
    from fieldscribe.audit.editions.tables.columns import Columns
    from fieldscribe.audit.editions.tables.tables import Row, Table

_MERGED = frozenset({"range", "step", "unit", "type", "default", "description", "access", "formula"})
"""Roles whose empty cells are merged with the cell above, in manuals that print a dash for nothing."""
_DASH = re.compile(r"[-—–]{1,3}")
_TITLE_UNIT = re.compile(r"\s*[\[(]([^\[\]()]{1,8})[\])]\s*$")
_LONGEST_TITLE = 120


@dataclass(frozen=True, slots=True)
class Read:
    """A row of data: its cells by role, and the numbers of its place."""

    row: Row
    cells: Mapping[str, str]
    numbers: Sequence[Number]
    flags: list[tuple[str, str]]


@dataclass(frozen=True, slots=True)
class Context:
    """What holds for all rows of a table."""

    columns: Columns
    space: str
    numberings: Numberings
    column: str | None
    section: str


def rows_of(table: Table, columns: Columns, *, merges: bool) -> list[Read]:
    """The rows of data: repeated heads and notes are left out, a row that goes on is joined with the one above."""
    read: list[Read] = []
    above: dict[str, str] = {}
    for row in table.rows[columns.first :]:
        if is_head(row.cells) or len(row.filled) < 2 < table.width:
            continue
        cells = _by_role(row, columns)
        found = addresses.numbers_in(row, columns)
        if not found and not cells.get("code") and (not cells.get("name") or _bits(cells)):
            _go_on(read, cells)
            continue
        if merges:
            for role in _MERGED & columns.places.keys():
                if not cells.get(role) and read:
                    cells[role] = above.get(role, "")
        above = cells
        read.append(Read(row, cells, found, []))
    return read


def _by_role(row: Row, columns: Columns) -> dict[str, str]:
    """The cells by role; several of one role are joined."""
    return {
        role: "\n".join(row.cells[place] for place in places if place < len(row.cells) and row.cells[place].strip())
        for role, places in columns.places.items()
        if role != "address"
    }


def _bits(cells: Mapping[str, str]) -> str | None:
    return bits_of(cells.get("bits", ""), cells.get("type", ""))


def _go_on(read: list[Read], cells: Mapping[str, str]) -> None:
    """A row without a place of its own: a bit of the word above, or more of its description."""
    bits = _bits(cells)
    if read and bits is not None and cells.get("name"):
        read[-1].flags.append((bits, one_line(cells["name"])))
    elif read and cells.get("description"):
        last = read[-1]
        joined = {**last.cells, "description": f"{last.cells.get('description', '')}\n{cells['description']}"}
        read[-1] = Read(last.row, joined, last.numbers, last.flags)


def shows_of_range(read: Iterable[Read], columns: Columns) -> Counter[str]:
    """What the rows show of their range column: raw numbers, or values in the unit."""
    shown = (evidence(take_apart(dict(entry.cells), columns.unit("range"))) for entry in read)
    return Counter(kind for kind in shown if kind)


def points_of(read: Sequence[Read], context: Context) -> Iterator[DraftPoint]:
    """A point for each row."""
    wires = [context.numberings.wire(entry.numbers) for entry in read]
    for index, entry in enumerate(read):
        before = max((min(votes) for votes in wires[max(0, index - 1) : index] if votes), default=None)
        after = min((min(votes) for votes in wires[index + 1 : index + 2] if votes), default=None)
        at, why = addresses.settled(wires[index], before, after)
        point = _point(entry, context)
        _place(point, entry, context, at, why)
        yield point


def _point(entry: Read, context: Context) -> DraftPoint:
    cells = entry.cells
    point = DraftPoint(entry.row.line, context.space, section=context.section)
    code, half = half_of(_told(cells.get("code", "")))
    title, of_title = half_of(_told(cells.get("name", "")))
    point.code, point.half = code[:40], half or of_title
    title, unit = _without_unit(title)
    point.title = title[:_LONGEST_TITLE]
    point.reserved = is_reserved(title)
    _kind(point, cells, has_flags=bool(entry.flags))
    _meaning(point, cells, context, unit)
    _labels(point, cells)
    _default(point, cells.get("default", ""))
    for bits, name in entry.flags:
        if bits in point.flags:
            point.questions.append(f"bit {bits} is printed twice: {point.flags[bits][:40]}, {name[:40]}")
        point.flags.setdefault(bits, name)
    return point


def _told(cell: str) -> str:
    """A cell on one line; nothing for a dash."""
    plain = one_line(cell)
    return "" if _DASH.fullmatch(plain) else plain


def _without_unit(title: str) -> tuple[str, str]:
    found = _TITLE_UNIT.search(title)
    unit = numbers.unit_of(found[1]) if found else ""
    return (title[: found.start()], unit) if found and unit else (title, "")


def _kind(point: DraftPoint, cells: Mapping[str, str], *, has_flags: bool) -> None:
    access = cells.get("access", "")
    point.access = access_of(access) if access.strip() else None
    if access.strip() and point.access is None:
        point.questions.append(f"what access is `{one_line(access)[:40]}`?")
    kind, question = type_of(cells.get("type", ""))
    point.type = kind
    point.bits = _bits(cells) if point.space not in ("coil", "discrete") else None
    told = _told(cells.get("type", ""))
    if point.bits:
        point.type = None
    elif told and kind is None:
        point.type = None if has_flags else "~"
        point.questions.append(f"the type is printed as `{told[:40]}`: {question or 'which is it'}?")
    words = numbers.alone(cells.get("length", ""))
    if kind is None and ((words and words[0] == 2) or told.casefold() in LONG):
        point.type, point.length = "~", 2
        point.questions.append("the value has two words: of which type, and which word comes first?")


def _meaning(point: DraftPoint, cells: Mapping[str, str], context: Context, unit: str) -> None:
    said = take_apart(dict(cells), context.columns.unit("range") or context.columns.unit("name") or unit)
    meaning = meaning_of(said, context.column)
    point.range, point.range_in_units, point.scale = meaning.range, meaning.range_in_units, meaning.scale
    point.unit, point.special = meaning.unit, meaning.special
    point.questions += meaning.questions
    if meaning.signed and point.type in (None, "u16"):
        point.type = "s16"
    point.printed |= {key: [text] for key, text in meaning.printed.items()}
    for fact, (printed, taken) in meaning.misprints.items():
        point.errata.append(DraftErratum(fact, printed, taken, "The ranges that are printed beside it say so."))
    if meaning.follows:
        point.errata.append(DraftErratum("", "No step is printed.", f"scale: {meaning.scale}", meaning.follows))
    if meaning.highest > 0xFFFF and not point.half and point.type is None:
        point.type = "~"
        point.questions.append("the range is larger than one word: of which type is the value?")


def _labels(point: DraftPoint, cells: Mapping[str, str]) -> None:
    told = [cells.get(role, "") for role in ("description", "range")]
    named = (labels for text in told[: 1 if point.special else 2] if (labels := labels_in(text)))
    count, point.rest = choices_in(told[0]), first_labels(told[0])
    point.labels = next(named, {}) or (point.rest if count else {})
    if point.bits and ".." in point.bits and all(re.fullmatch("[01]+", str(number)) for number in point.labels):
        point.labels = {int(str(number), 2): label for number, label in point.labels.items()}
    if count is not None:
        point.printed["choices"] = [str(count)]


def _default(point: DraftPoint, cell: str) -> None:
    told = _told(without_footnotes(cell))
    if not told:
        return
    number = numbers.alone(told)
    if number is None:
        point.questions.append(f"the default is printed as `{told[:60]}`")
    elif point.scale is None and number[0].denominator == 1 and not point.labels:
        point.default = str(number[0].numerator)
    elif point.scale not in (None, "~") and (number[2] or "." in number[1] or "," in number[1]):
        point.default_in_units = numbers.decimal(number[0])
    elif point.labels and number[0].denominator == 1 and number[0].numerator in point.labels:
        point.default = str(number[0].numerator)
    else:
        point.questions.append(f"the default is printed as `{told[:60]}`: raw, or in the unit?")


def _place(point: DraftPoint, entry: Read, context: Context, at: int | None, why: str) -> None:
    """The address, and what is printed of it by numbering; numbers that say another address are misprints."""
    if why:
        point.questions.append(f"{why}: {', '.join(number.shown for number in entry.numbers)}")
    if at is None or at > 0xFFFFFF:
        if not entry.numbers and context.columns.places.get("address"):
            point.questions.append("no address is printed")
        return
    point.at = at
    names = {0: "wire", **context.numberings.names}
    by_numbering: dict[str, list[Number]] = {}
    for number in entry.numbers:
        by_numbering.setdefault(names.get(context.numberings.offsets.get(number.slot, 0), "wire"), []).append(number)
    wired = next((number.shown for number in by_numbering.get("wire", ()) if number.value == at), None)
    hexadecimal = any(number.shown.endswith("h") for number in entry.numbers)
    point.shown = wired or (f"{at:04X}h" if hexadecimal else str(at))
    for name, printed in by_numbering.items():
        point.printed[name] = [number.shown for number in printed]
        for number in printed:
            right = at + context.numberings.offsets.get(number.slot, 0)
            if number.value != right:
                shown = f"{right:04X}h" if number.shown.endswith("h") else str(right)
                point.errata.append(DraftErratum(name, number.shown, shown, "The other numbers of the address say so."))
    if len(entry.numbers) == 1 and "wire" in by_numbering:
        del point.printed["wire"]
