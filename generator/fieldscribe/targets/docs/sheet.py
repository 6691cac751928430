"""The table of points for spreadsheets: a row for each point and command, a column for each fact.

`points_table` makes it for CSV and the workbook; the functions of `sheet_cells` fill the cells.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from itertools import pairwise, starmap
from operator import attrgetter
from typing import NamedTuple, TypeAlias

from fieldscribe import wording
from fieldscribe.facts.points import POINT
from fieldscribe.facts.table import Fact
from fieldscribe.model import Point
from fieldscribe.targets.docs.cells import DocsScope
from fieldscribe.targets.docs.sheet_cells import (
    Sheet,
    address_cells,
    bit_cells,
    command_cells,
    default_cells,
    enum_cells,
    keeps_cells,
    limit_cells,
    reference_cells,
    scale_cells,
)
from fieldscribe.targets.docs.tables import Column, Encode, Table, codes_of, original, source_cells

_FACTS = {fact.key: fact for fact in POINT if fact.column}
CellsOf: TypeAlias = Callable[[Point, Sheet], Iterable[str]]


def _fact_cells(fact: Fact, point: Point, sheet: Sheet) -> tuple[str]:
    """Return the cell of a fact."""
    text = fact.cell_of(point, sheet.scope.context)
    return (text if fact.is_number else sheet.encode(text),)


def _of_fact(key: str) -> Column:
    """Return the column of a fact, as the table of facts describes it."""
    return Column(key, _FACTS[key].column, _FACTS[key].is_number)


COLUMNS = (
    _of_fact("code"),
    Column("name", "the name in code, with the variant; each occurs once"),
    Column("kind", "`point`, or `command`: a fixed number that is written so that the device does something"),
    _of_fact("variant"),
    _of_fact("group"),
    Column("title", "the title in English"),
    Column("title_original", "the title in the language of the manual"),
    _of_fact("space"),
    _of_fact("telegram"),
    Column("address", "the (lowest) number on the wire; of a telegram word, its place there, counted from 0", True),
    Column("address_hex", "the same as manuals print it"),
    Column("words", "how many 16-bit words (or single bits) it takes", True),
    Column("word_order", "which of several words comes first"),
    Column("bit_low", "the lowest bit of a bit group in its word", True),
    Column("bit_high", "its highest bit", True),
    Column("shared", "`yes`: other points have the rest of the word: read it, change the bits of `mask`, write it"),
    Column("mask", "the bits of a bit group in its word, as a number", True),
    Column("fixed_mask", "bits of the word that must always be written as a constant", True),
    Column("fixed_bits", "that constant", True),
    _of_fact("index"),
    Column("modicon", "the number that counts from 1", True),
    Column("reference", "the number whose first digit says the space (4: holding registers); coils have none", True),
    Column("computed", "which of these two the manual does not print: they are computed from the address"),
    Column("other_references", "other numbers that the manual prints"),
    _of_fact("type"),
    Column("encoding", "what the number is: `integer`, `scaled`, `float`, `bit`, `enum`, `flags`, `text`, `digits`"),
    _of_fact("access"),
    _of_fact("unit"),
    Column("factor", "value = number of that type * factor + offset, exact", True),
    Column("offset", "see factor", True),
    Column("scale", "the rule as text, where other points or a fraction are in it"),
    Column("raw_min", "the least raw number that can ever be valid, without special codes, which are meanings", True),
    Column("raw_max", "the greatest; of a command, `raw_min` and `raw_max` are the number to write", True),
    Column("min", "the least value, in the unit", True),
    Column("max", "the greatest value", True),
    Column("range", "the whole rule as text, where least and greatest do not say all"),
    Column("default", "the factory setting, in the unit", True),
    Column("default_raw", "the factory setting as raw number; outside the limits if it is a special code", True),
    Column("enum", "the names of its numbers (`digits`: of each decimal digit): `of` in the meanings"),
    Column("flags", "the flags of its bits: `of` in the meanings"),
    Column("codes", "its special codes: `of` in the meanings"),
    Column("keeps", "whether a written value survives switching off: `yes` (each write wears the memory), `no`, how"),
    _of_fact("conditions"),
    _of_fact("changes"),
    _of_fact("record"),
    _of_fact("set"),
    Column("remarks", "what else holds"),
    Column("note", "what the manual adds"),
    _of_fact("errata"),
    Column("document", "the manual"),
    Column("section", "the section of the manual"),
    Column("page", "the page", True),
    Column("line", "the line of the manual's text", True),
    Column("generated", "whether code has it"),
    _of_fact("reason"),
)
"""The columns of every device."""
FURTHER = tuple(_of_fact(key) for key in _FACTS if key not in {column.name for column in COLUMNS})
"""The columns of all other facts; a device has those that one of its points fills."""


class _Cells(NamedTuple):
    """A function that returns the cells of a point from a column on.

    `shared` says what decides about them: shape and terms (`terms`), or also the limits (`limits`). Other cells belong
    to the point, and are empty if its attribute `needs` is.
    """

    column: str
    of: CellsOf
    shared: str = ""
    needs: str = "name"


def _cells_of_fact(key: str) -> _Cells:
    fact = _FACTS[key]
    needs = fact.attribute or (key if fact.value is None else "name")
    return _Cells(key, partial(_fact_cells, fact), "terms" if fact.holder else "", needs)


_CELLS = (
    *map(_cells_of_fact, _FACTS),
    _Cells("name", lambda point, sheet: (sheet.encode(point.item), "point")),
    _Cells("title", lambda point, sheet: (sheet.encode(point.title["en"]), sheet.encode(original(point.title)))),
    _Cells("address", address_cells),
    _Cells("bit_low", bit_cells, "terms"),
    _Cells("modicon", reference_cells),
    _Cells("encoding", lambda point, _: (point.form if point.untyped is None else "",), "terms"),
    _Cells("factor", scale_cells, "terms"),
    _Cells("raw_min", limit_cells, "limits"),
    _Cells("default", default_cells, needs="default"),
    _Cells("default_raw", lambda point, _: (str(point.default_raw),), needs="default_raw"),
    _Cells("enum", enum_cells, needs="shape.named_numbers"),
    _Cells("flags", lambda point, sheet: (sheet.encode(point.item),), needs="shape.flags"),
    _Cells("codes", lambda point, sheet: (sheet.encode(codes_of(point)),), needs="shape.specials"),
    _Cells("keeps", keeps_cells, "terms"),
    _Cells("remarks", lambda point, sheet: (sheet.remarks(point),)),
    _Cells("note", lambda point, sheet: (sheet.encode(wording.title_text(point.note)),), needs="note"),
    _Cells("document", lambda point, sheet: source_cells(point.source, sheet.encode)),
    _Cells("generated", lambda point, _: ("yes" if point.generated else "no",), "terms"),
)


def points_table(scope: DocsScope) -> Table:
    """Return the table of the points and commands of a device."""
    columns = (*COLUMNS, *_filled(scope))
    return Table("points", columns, partial(_rows, scope, columns))


def _filled(scope: DocsScope) -> Iterator[Column]:
    """Return the further columns that some point fills."""
    for column in FURTHER:
        if any(_FACTS[column.name].cell_of(point, scope.context) for point in scope.device.points):
            yield column


def _rows(scope: DocsScope, columns: Sequence[Column], encode: Encode) -> Iterator[Sequence[str]]:
    sheet, placed = Sheet(scope, encode), list(_placed(columns))
    with_terms, with_limits, own = (
        [(place, cells.of) for place, cells in placed if cells.shared == shared] for shared in ("terms", "limits", "")
    )
    needed = attrgetter(*(cells.needs for _, cells in placed if not cells.shared))
    by_terms: dict[object, list[str]] = {}
    by_limits: dict[object, list[str]] = {}
    for point in scope.device.points:
        key = id(point.shape), id(point.terms)
        shared_row = by_limits.get((*key, id(point.allowed)))
        if shared_row is None:
            if key not in by_terms:
                by_terms[key] = [""] * len(columns)
                _fill(by_terms[key], with_terms, point, sheet)
            shared_row = by_limits[*key, id(point.allowed)] = by_terms[key].copy()
            _fill(shared_row, with_limits, point, sheet)
        row = shared_row.copy()
        _fill(row, [part for part, value in zip(own, needed(point), strict=True) if value or value == 0], point, sheet)
        yield row
    for command in scope.device.commands:
        texts = command_cells(command, sheet)
        yield [texts.get(column.name, "") for column in columns]


def _placed(columns: Sequence[Column]) -> Iterator[tuple[slice, _Cells]]:
    """Return the cells with their places in a row, each up to the next."""
    first = {column.name: place for place, column in enumerate(columns)}
    cells = sorted((cells for cells in _CELLS if cells.column in first), key=lambda cells: first[cells.column])
    starts = [*(first[each.column] for each in cells), len(columns)]
    return zip(starmap(slice, pairwise(starts)), cells, strict=True)


def _fill(row: list[str], parts: Iterable[tuple[slice, CellsOf]], point: Point, sheet: Sheet) -> None:
    for place, cells_of in parts:
        row[place] = cells_of(point, sheet)
