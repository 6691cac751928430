"""The table of points for spreadsheets: a row for each point and command, a column for each fact.

`points_table` makes it for CSV and the workbook; `Sheet` returns the cells of a row by column.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cache, partial

from fieldscribe import wording
from fieldscribe.arithmetic.exact import SAME, Line
from fieldscribe.facts.points import POINT
from fieldscribe.facts.table import Fact
from fieldscribe.families import family
from fieldscribe.model import Command, Point, Source
from fieldscribe.targets.docs.cells import DocsScope, Remarks
from fieldscribe.targets.docs.tables import Column, Encode, Table, codes_of, decimal, original, source_cells
from fieldscribe.wording.numbers import exact, fixed_rule, hex_text, number_text

_FACTS = {fact.key: fact for fact in POINT if fact.column}
_SHARED = [fact for fact in _FACTS.values() if fact.holder]
_OWN = [fact for fact in _FACTS.values() if not fact.holder]
_KEEPS = {None: "", "no": "no", "yes": "yes", "choice": "by the task"}
_NO_REMARKS = ("special_of", "note", "reserved")
"""Facts in other columns: `special_of` in `codes`, `reserved` as part of the reason."""

Cells = dict[str, str]
"""The cells of a row by column; those left out are empty."""


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


def points_table(scope: DocsScope) -> Table:
    """Return the table of the points and commands of a device."""
    columns = (*COLUMNS, *_filled(scope))
    return Table("points", columns, partial(_rows, scope, [column.name for column in columns]))


def _filled(scope: DocsScope) -> Iterator[Column]:
    """Return the further columns that some point fills."""
    for column in FURTHER:
        if any(_FACTS[column.name].cell_of(point, scope.context) for point in scope.device.points):
            yield column


def _rows(scope: DocsScope, columns: Sequence[str], encode: Encode) -> Iterator[Sequence[str]]:
    sheet = Sheet(scope, encode)
    for point in scope.device.points:
        cells = sheet.of_point(point)
        yield [cells.get(column, "") for column in columns]
    for command in scope.device.commands:
        cells = sheet.of_command(command)
        yield [cells.get(column, "") for column in columns]


class Sheet:
    """Makes the rows of a device; cells of points with the same shape, terms and limits are made once."""

    def __init__(self, scope: DocsScope, encode: Encode) -> None:
        self._scope, self._encode, self._numbers_at = scope, encode, family(scope.device.family).numbers
        further = {
            "type": lambda point: wording.type_text(point) if point.form in ("text", "digits") else "",
            "untyped": lambda point: f"type: {point.untyped}" if point.untyped else "",
            "default": _default_numbers,
            "default_value": _default_fraction,
        }
        self._remarks = Remarks(scope.context, str, further, _NO_REMARKS, in_columns=True)
        self._encode_remarks = cache(encode)
        self._shared: dict[tuple[int, int, int], Cells] = {}

    def of_point(self, point: Point) -> Cells:
        """Return the row of a point."""
        encode, key = self._encode, (id(point.shape), id(point.terms), id(point.allowed))
        if key not in self._shared:
            self._shared[key] = self._shared_cells(point)
        cells = self._shared[key] | self._facts(_OWN, point) | self._places(point) | self._references(point)
        cells |= {
            "name": encode(point.item),
            "title": encode(point.title["en"]),
            "title_original": encode(original(point.title)),
            "default": _default(point),
            "default_raw": "" if point.default_raw is None else str(point.default_raw),
            "flags": encode(point.item) if point.flags else "",
            "codes": encode(codes_of(point)),
            "remarks": self._encode_remarks(self._remarks.of(point)),
            "note": encode(wording.title_text(point.note)) if point.note else "",
        }
        if (enum := point.named_numbers) is not None:
            cells["enum"] = encode(enum.name)
        return cells | self._source(point.source)

    def of_command(self, command: Command) -> Cells:
        """Return the row of a command."""
        encode, numbers = self._encode, self._numbers_at(command.space, command.address)
        value = "" if command.value is None else str(command.value)
        is_bit = family(self._scope.device.family).spaces[command.space] == "bit"
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
            **self._source(command.source),
            "generated": "yes",
        }

    def _shared_cells(self, point: Point) -> Cells:
        cells = self._facts(_SHARED, point) | _bits(point) | self._scale(point) | self._limits(point)
        return cells | {
            "kind": "point",
            "encoding": point.form if point.untyped is None else "",
            "keeps": _KEEPS[point.keeps] if point.keeps in _KEEPS else self._encode(f"after {point.keeps}"),
            "generated": "yes" if point.generated else "no",
        }

    def _facts(self, facts: Iterable[Fact], point: Point) -> Cells:
        """Return the cells of facts that are columns."""
        texts = ((fact, fact.cell_of(point, self._scope.context)) for fact in facts)
        return {fact.key: text if fact.is_number else self._encode(text) for fact, text in texts if text}

    def _source(self, source: Source) -> Cells:
        return dict(zip(("document", "section", "page", "line"), source_cells(source, self._encode), strict=True))

    def _places(self, point: Point) -> Cells:
        """Return the lowest address in both notations, the number of words, and their order."""
        addresses, words = point.place.addresses, str(point.words)
        if not addresses or point.place.bit is not None:
            return {"words": words}
        order = self._encode(wording.order_text(point)) if len(addresses) > 1 else ""
        lowest = min(addresses)
        return {"address": str(lowest), "address_hex": hex_text(lowest), "words": words, "word_order": order}

    def _references(self, point: Point) -> Cells:
        """Return the two numberings of Modicon, which of them are computed, and all other numberings as one text."""
        place, known = point.place, Cells()
        others = []
        for name, number in place.references.items():
            if name in ("modicon", "reference") and isinstance(number, int):
                known[name] = str(number)
            else:
                others.append(f"{name} {number}")
        counts = bool(place.addresses) and point.base is None  # from a base, the number is in no frame
        numbers = self._numbers_at(point.space, min(place.addresses)) if counts else {}
        computed = {name: str(number) for name, number in numbers.items() if name not in place.references}
        texts = {"computed": " ".join(computed), "other_references": self._encode(", ".join(others))}
        return known | computed | texts

    def _scale(self, point: Point) -> Cells:
        """Return factor and offset, or the rule as text if it is not linear with decimal numbers."""
        line = _line_of(point)
        if line is not None:
            factor, offset = exact(line.factor, line.divisor), exact(line.add, line.divisor)
            if "/" not in factor + offset:
                return {"factor": factor, "offset": offset}
        text = "" if point.scale is None else wording.scale_text(point, self._scope.by_name)
        return {"scale": self._encode(text)}

    def _limits(self, point: Point) -> Cells:
        """Return the least and the greatest raw number and value, and the rest of the rule as text."""
        ends = _ends_of(point)
        text = _range_of(point, ends[2:], self._scope.by_name)
        return dict(zip(("raw_min", "raw_max", "min", "max"), ends, strict=True)) | {"range": self._encode(text)}


def _bits(point: Point) -> Cells:
    """Return the bits of a bit group, `yes` if it shares the word, its mask, and the fixed bits."""
    fixed = point.fixed
    cells = {} if fixed is None else {"fixed_mask": str(fixed.mask), "fixed_bits": str(fixed.bits)}
    if point.bits is None:
        return cells
    high, low = point.bits
    shared, mask = "yes" if wording.shares_word(point) else "", str((2 << high) - (1 << low))
    return cells | {"bit_low": str(low), "bit_high": str(high), "shared": shared, "mask": mask}


def _line_of(point: Point) -> Line | None:
    """Return the rule from raw numbers to values; None if they are not quantities or need other points."""
    if point.form not in ("scaled", "integer", "float"):
        return None
    if point.scale is not None:
        return fixed_rule(point)
    return SAME if point.generated or point.reserved else None


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


def _default(point: Point) -> str:
    """Return the factory setting as a value; empty if it is a special code."""
    raw = point.default_raw
    if point.default is None or (raw is not None and point.special(raw) is not None):
        return ""
    return decimal(number_text(point.default))


def _default_numbers(point: Point) -> str:
    """Return the default of a word that is made of numbers."""
    parts = wording.default_parts(point)
    return parts and f"default: {parts}"


def _default_fraction(point: Point) -> str:
    """Return a default that is not a decimal and so has no column."""
    is_fraction = point.default is not None and point.default_raw is None and not decimal(number_text(point.default))
    return f"default {wording.default_text(point)}" if is_fraction else ""


def _command_remarks(command: Command) -> Iterator[str]:
    yield f"{wanted_text(command)} with function {hex_text(command.function, 2)}"
    if command.wears is not None:
        yield f"the memory is rated for {command.wears} writes"
    if command.busy:
        yield f"busy while {command.busy}"


def wanted_text(command: Command) -> str:
    """Return the number that the command writes: `write 1150`."""
    return f"write {'any number' if command.value is None else command.value}"
