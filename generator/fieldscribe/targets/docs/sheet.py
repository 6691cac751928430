"""The table of points for spreadsheets: a row for each point, a column for each fact.

A function fills the cells of each group of neighbouring columns.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cache, partial
from itertools import pairwise, starmap
from operator import attrgetter
from typing import NamedTuple, TypeAlias

from fieldscribe import wording
from fieldscribe.arithmetic.exact import SAME, Line
from fieldscribe.facts.points import POINT
from fieldscribe.facts.table import Fact
from fieldscribe.families import family
from fieldscribe.model import Command, Point
from fieldscribe.targets.docs.cells import DocsScope, Remarks
from fieldscribe.targets.docs.tables import Column, Encode, Table, codes_of, decimal, original, source_cells
from fieldscribe.wording.numbers import exact, fixed_rule, hex_text, number_text

_FACTS = {fact.key: fact for fact in POINT if fact.column}
_KEEPS = {None: "", "no": "no", "yes": "yes", "choice": "by the task"}
_NO_REMARKS = ("special_of", "note", "reserved")
"""Facts in other columns: `special_of` in `codes`, `reserved` as part of the reason."""


class Sheet:
    """The state that the cells of all points of a device need."""

    def __init__(self, scope: DocsScope, encode: Encode) -> None:
        self.scope, self.encode, self.numbers_at = scope, encode, family(scope.device.family).numbers
        further = {
            "type": lambda point: wording.type_text(point) if point.form in ("text", "digits") else "",
            "untyped": lambda point: f"type: {point.untyped}" if point.untyped else "",
            "default": _default_numbers,
            "default_value": _default_fraction,
        }
        self._remarks = Remarks(scope.context, str, further, _NO_REMARKS, in_columns=True)
        self._encode_remarks = cache(encode)

    def remarks(self, point: Point) -> str:
        """Return the remarks of a point; many points have the same."""
        return self._encode_remarks(self._remarks.of(point))


CellsOf: TypeAlias = Callable[[Point, Sheet], Iterable[str]]


def _fact_cells(fact: Fact, point: Point, sheet: Sheet) -> tuple[str]:
    """Return the cell of a fact."""
    text = fact.cell_of(point, sheet.scope.context)
    return (text if fact.is_number else sheet.encode(text),)


def _address_cells(point: Point, sheet: Sheet) -> tuple[str, str, str, str]:
    """Return the lowest address in both notations, the number of words, and their order."""
    addresses, words = point.place.addresses, str(point.words)
    if not addresses:
        return "", "", words, ""
    if point.place.bit is not None:
        return "", "", words, ""
    lowest = min(addresses)
    order = sheet.encode(wording.order_text(point)) if len(addresses) > 1 else ""
    return str(lowest), hex_text(lowest), words, order


def _bit_cells(point: Point, _: Sheet) -> tuple[str, ...]:
    """Return the bits of a bit group, `yes` if it shares the word, its mask, and the fixed bits."""
    fixed = ("", "") if point.fixed is None else (str(point.fixed.mask), str(point.fixed.bits))
    if point.bits is None:
        return "", "", "", "", *fixed
    high, low = point.bits
    return str(low), str(high), "yes" if wording.shares_word(point) else "", str((2 << high) - (1 << low)), *fixed


def _reference_cells(point: Point, sheet: Sheet) -> tuple[str, str, str, str]:
    """Return the two numberings of Modicon, which of them are computed, and all other numberings as one text."""
    place = point.place
    others, known = [], {"modicon": "", "reference": ""}
    for name, number in place.references.items():
        if name in known and isinstance(number, int):
            known[name] = str(number)
        else:
            others.append(f"{name} {number}")
    counts = bool(place.addresses) and point.base is None  # from a base, the number is in no frame
    numbers = sheet.numbers_at(point.space, min(place.addresses)) if counts else {}
    computed = {name: str(number) for name, number in numbers.items() if name not in place.references}
    known |= computed
    return known["modicon"], known["reference"], " ".join(computed), sheet.encode(", ".join(others))


def _scale_cells(point: Point, sheet: Sheet) -> tuple[str, str, str]:
    """Return factor and offset, or the rule as text if it is not linear with decimal numbers."""
    line = _line_of(point)
    if line is not None:
        factor, offset = exact(line.factor, line.divisor), exact(line.add, line.divisor)
        if "/" not in factor + offset:
            return factor, offset, ""
    return "", "", sheet.encode(wording.scale_text(point, sheet.scope.by_name) if point.scale is not None else "")


def _line_of(point: Point) -> Line | None:
    """Return the rule from raw numbers to values; None if they are not quantities or need other points."""
    if point.form not in ("scaled", "integer", "float"):
        return None
    if point.scale is not None:
        return fixed_rule(point)
    return SAME if point.generated or point.reserved else None


def _limit_cells(point: Point, sheet: Sheet) -> tuple[str, ...]:
    """Return the least and the greatest raw number and value, and the rest of the rule as text."""
    ends = _ends_of(point)
    return *ends, sheet.encode(_range_of(point, ends[2:], sheet.scope.by_name))


def _ends_of(point: Point) -> tuple[str, str, str, str]:
    """Return the least and the greatest raw number and value; empty texts if there is none."""
    units = point.allowed.units
    if point.info.floating or units:
        return "", "", *((decimal(number_text(units[0][0])), decimal(number_text(units[-1][1]))) if units else ("", ""))
    outer, line = _without_codes(point, wording.outer_raw(point)), _line_of(point)
    if outer is None or point.text is not None:
        return "", "", "", ""
    if line is None:
        return str(outer[0]), str(outer[1]), "", ""
    low, high = (exact(raw * line.factor + line.add, line.divisor) for raw in (outer[:: -1 if line.factor < 0 else 1]))
    return str(outer[0]), str(outer[1]), decimal(low), decimal(high)


def _without_codes(point: Point, ends: tuple[int, int] | None) -> tuple[int, int] | None:
    """Return the ends without special codes; None if nothing is left."""
    if ends is None or not point.specials:
        return ends
    low, high = ends
    while low <= high and (code := point.special(low)) is not None:
        low = code.high + 1
    while low <= high and (code := point.special(high)) is not None:
        high = code.low - 1
    return (low, high) if low <= high else None


def _range_of(point: Point, ends: tuple[str, str], points: Mapping[str, Point]) -> str:
    """Return the limits as text if least and greatest value do not say everything: other points, gaps, fractions."""
    allowed, line = point.allowed, _line_of(point)
    parts = allowed.units or allowed.intervals
    unsaid = line is not None and bool(parts) and "" in ends
    if len(parts) <= 1 and not allowed.moves and not unsaid:
        return ""
    text = wording.range_text(point, points) if line is not None or allowed.units else ""
    raw = "" if text else wording.raw_range_text(point)
    return f"only {text}" if text else f"only raw {raw}" if raw else ""


def _default_cells(point: Point, _: Sheet) -> tuple[str]:
    """Return the factory setting as a value; empty if it is a special code."""
    raw = point.default_raw
    if point.default is None or (raw is not None and point.special(raw) is not None):
        return ("",)
    return (decimal(number_text(point.default)),)


def _default_numbers(point: Point) -> str:
    """Return the default of a word that is made of numbers."""
    parts = wording.default_parts(point)
    return parts and f"default: {parts}"


def _default_fraction(point: Point) -> str:
    """Return a default that is not a decimal and so has no column."""
    is_fraction = point.default is not None and point.default_raw is None and not decimal(number_text(point.default))
    return f"default {wording.default_text(point)}" if is_fraction else ""


def _enum_cells(point: Point, sheet: Sheet) -> tuple[str]:
    """Return the name of the enum."""
    enum = point.named_numbers
    return ("" if enum is None else sheet.encode(enum.name),)


def _keeps_cells(point: Point, sheet: Sheet) -> tuple[str]:
    """Return whether a written value survives switching off."""
    return (_KEEPS[point.keeps] if point.keeps in _KEEPS else sheet.encode(f"after {point.keeps}"),)


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
    _Cells("address", _address_cells),
    _Cells("bit_low", _bit_cells, "terms"),
    _Cells("modicon", _reference_cells),
    _Cells("encoding", lambda point, _: (point.form if point.untyped is None else "",), "terms"),
    _Cells("factor", _scale_cells, "terms"),
    _Cells("raw_min", _limit_cells, "limits"),
    _Cells("default", _default_cells, needs="default"),
    _Cells("default_raw", lambda point, _: (str(point.default_raw),), needs="default_raw"),
    _Cells("enum", _enum_cells, needs="shape.named_numbers"),
    _Cells("flags", lambda point, sheet: (sheet.encode(point.item),), needs="shape.flags"),
    _Cells("codes", lambda point, sheet: (sheet.encode(codes_of(point)),), needs="shape.specials"),
    _Cells("keeps", _keeps_cells, "terms"),
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
        texts = _command_cells(command, sheet)
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


def _command_cells(command: Command, sheet: Sheet) -> Mapping[str, str]:
    """Return the cells of a command's row by column."""
    encode, numbers = sheet.encode, sheet.numbers_at(command.space, command.address)
    value = "" if command.value is None else str(command.value)
    is_bit = family(sheet.scope.device.family).spaces[command.space] == "bit"
    return {
        "name": encode(command.name),
        "kind": "command",
        "title": encode(command.title["en"]),
        "title_original": encode(original(command.title)),
        "space": encode(command.space),
        "address": str(command.address),
        "address_hex": hex_text(command.address),
        "words": "1",
        **{name: str(number) for name, number in numbers.items()},
        "computed": " ".join(numbers),
        "type": "bit" if is_bit else "u16",
        "encoding": "bit" if is_bit else "integer",
        "access": "w",
        "raw_min": value,
        "raw_max": value,
        "remarks": encode("; ".join(_command_remarks(command))),
        "note": encode(wording.title_text(command.note)) if command.note else "",
        **dict(zip(("document", "section", "page", "line"), source_cells(command.source, encode), strict=True)),
        "generated": "yes",
    }


def _command_remarks(command: Command) -> Iterator[str]:
    yield f"{wanted_text(command)} with function {hex_text(command.function, 2)}"
    if command.wears is not None:
        yield f"the memory is rated for {command.wears} writes"
    if command.busy:
        yield f"busy while {command.busy}"


def wanted_text(command: Command) -> str:
    """Return the number that the command writes: `write 1150`."""
    return f"write {'any number' if command.value is None else command.value}"
