"""The table of points: a row for each, with a column for each fact that can be counted, sorted or looked up."""

from __future__ import annotations

from functools import cache, partial
from typing import TYPE_CHECKING, NamedTuple

from fieldscribe import wording
from fieldscribe.arithmetic.exact import SAME
from fieldscribe.facts.table import Context
from fieldscribe.families import family
from fieldscribe.targets.docs.bus import part_of
from fieldscribe.targets.docs.scope import Remarks
from fieldscribe.targets.docs.tables import Column, Table, codes_of, decimal, enum_of, original, source_cells
from fieldscribe.wording.exact import exact, fixed_rule, hex_text, number_text

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from fieldscribe.arithmetic.exact import Line
    from fieldscribe.model import Command, Device, Place, Point
    from fieldscribe.targets.docs.bus import OfFamily
    from fieldscribe.targets.docs.scope import DocsScope
    from fieldscribe.targets.docs.tables import Encode

COLUMNS = (
    Column("code", "the code that the manual prints"),
    Column("name", "the name in code, with the variant; each stands once"),
    Column("kind", "`point`, or `command`: a fixed number that is written so that the device does something"),
    Column("variant", "for which devices the row holds, where they differ"),
    Column("group", "the group in the description"),
    Column("title", "the title in English"),
    Column("title_original", "the title in the language of the manual"),
    Column("space", "where the address counts: `coil`, `holding`, `parameter`, `telegram`, ..."),
    Column("telegram", "in which telegram a word is"),
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
    Column("index", "the index of an element", True),
    Column("modicon", "the number that counts from 1", True),
    Column("reference", "the number whose first digit says the space (4: holding registers); coils have none", True),
    Column("computed", "which of these two the manual does not print: they are computed from the address"),
    Column("other_references", "other numbers that the manual prints"),
    Column("type", "the wire type; empty where the manual does not settle it"),
    Column("encoding", "what the number is: `integer`, `scaled`, `float`, `bit`, `enum`, `flags`, `text`, `digits`"),
    Column("access", "`r`, `w`, `rw`; `none` if no bus reaches it"),
    Column("unit", "the unit of values"),
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
    Column("conditions", "what must hold to write it"),
    Column("changes", "how often it changes"),
    Column("record", "the record that it belongs to"),
    Column("set", "the number of its parameter set", True),
    Column("remarks", "what else holds"),
    Column("note", "what the manual adds"),
    Column("errata", "where the manual is wrong, unclear or silent: ids of errata"),
    Column("document", "the manual"),
    Column("section", "the section of the manual"),
    Column("page", "the page", True),
    Column("line", "the line of the manual's text", True),
    Column("generated", "whether code has it"),
    Column("reason", "why not"),
)
_KEEPS = {None: "", "no": "no", "yes": "yes", "choice": "by the task"}
_IN_COLUMNS = frozenset(
    {"variant", "record", "set", "telegram", "special_of", "conditions", "changes", "note", "reason", "reserved"}
)
"""Facts with columns of their own, which are no remarks; `reserved` is part of the reason."""


class _Cells(NamedTuple):
    """The cells that points with the same shape and terms share."""

    group: str
    space: tuple[str, str]
    words: str
    bits: tuple[str, ...]
    meaning: tuple[str, ...]
    behaviour: tuple[str, str, str]
    generated: tuple[str, str]


def points_table(scope: DocsScope) -> Table:
    """Return the table of the points and commands of a device."""
    return Table("points", COLUMNS, partial(_rows, scope))


def _rows(scope: DocsScope, encode: Encode) -> Iterator[tuple[str, ...]]:
    known: dict[object, _Cells] = {}
    known_limits: dict[object, tuple[str, ...]] = {}
    part, remarks, encoded = part_of(scope.device), _remarks(scope), cache(encode)
    for point in scope.device.points:
        key = id(point.shape), id(point.terms), len(point.addresses)
        cells = known.get(key)
        if cells is None:
            cells = known[key] = _shared_cells(scope, point, encode)
        limits = known_limits.get((*key, id(point.allowed)))
        if limits is None:
            limits = (*ends_of(point), encode(range_of(point, scope.by_name)))
            known_limits[*key, id(point.allowed)] = limits
        enum = enum_of(point)
        yield (
            encode(point.code) if point.code else "",
            encode(point.item),
            "point",
            encode(str(point.variant)) if point.variant else "",
            cells.group,
            encode(point.title["en"]),
            encode(original(point.title)),
            *cells.space,
            *_address(point.place),
            cells.words,
            encode(wording.order_text(point)) if len(point.place.addresses) > 1 else "",
            *cells.bits,
            "" if point.index is None else str(point.index),
            *_references(point, part, encode),
            *cells.meaning,
            *limits,
            default_of(point),
            "" if point.default_raw is None else str(point.default_raw),
            "" if enum is None else encode(enum.name),
            encode(point.item) if point.flags else "",
            encode(codes_of(point)) if point.specials else "",
            *cells.behaviour,
            encode(point.record) if point.record else "",
            "" if point.set is None else str(point.set),
            encoded(remarks.of(point)),
            encode(wording.title_text(point.note)) if point.note else "",
            encode("; ".join(point.errata)) if point.errata else "",
            *source_cells(point.source, encode),
            *cells.generated,
        )
    for command in scope.device.commands:
        texts = command_cells(command, scope.device, encode)
        yield tuple(texts.get(column.name, "") for column in COLUMNS)


def _shared_cells(scope: DocsScope, point: Point, encode: Encode) -> _Cells:
    typed = point.untyped is None
    return _Cells(
        group=encode(point.group),
        space=(encode(point.space), encode(point.telegram or "")),
        words=str(point.words),
        bits=_bits(point),
        meaning=(
            point.type if typed else "",
            point.form if typed else "",
            point.access,
            encode(point.unit.symbol),
            *scale_cells(point, scope.by_name, encode),
        ),
        behaviour=(_keeps(point, encode), encode("; ".join(point.conditions)), encode(point.changes or "")),
        generated=("yes" if point.generated else "no", encode(point.reason or "")),
    )


def _remarks(scope: DocsScope) -> Remarks:
    further = {
        "type": lambda point: wording.type_text(point) if point.form in ("text", "digits") else "",
        "untyped": lambda point: f"type: {point.untyped}" if point.untyped else "",
        "default": _default_numbers,
        "default_value": _default_fraction,
    }
    return Remarks(Context(scope.device, names=scope.by_name), str, further, _IN_COLUMNS)


def _default_numbers(point: Point) -> str:
    """The factory setting of a word that is made of numbers."""
    parts = wording.default_parts(point)
    return parts and f"default: {parts}"


def _default_fraction(point: Point) -> str:
    """A factory setting that is no decimal, and so in no column."""
    is_fraction = point.default is not None and point.default_raw is None and not decimal(number_text(point.default))
    return f"default {wording.default_text(point)}" if is_fraction else ""


def _address(place: Place) -> tuple[str, str]:
    """The lowest address in both notations."""
    addresses = place.addresses
    return (str(min(addresses)), hex_text(min(addresses))) if addresses else ("", "")


def _bits(point: Point) -> tuple[str, ...]:
    """The place of a bit group in its word, `yes` if it shares the word, its mask, and the fixed bits."""
    fixed = ("", "") if point.fixed is None else (str(point.fixed.mask), str(point.fixed.bits))
    if point.bits is None:
        return "", "", "", "", *fixed
    high, low = point.bits
    return str(low), str(high), "yes" if wording.shares_word(point) else "", str((2 << high) - (1 << low)), *fixed


def _references(point: Point, part: OfFamily, encode: Encode) -> tuple[str, str, str, str]:
    """Modicon's two numberings, which of them are computed, and all others as one text."""
    place = point.place
    others, known = [], {"modicon": "", "reference": ""}
    for name, number in place.references.items():
        if name in known and isinstance(number, int):
            known[name] = str(number)
        else:
            others.append(f"{name} {number}")
    numbers = part.numbers(point.space, min(place.addresses)) if place.addresses else {}
    computed = {name: str(number) for name, number in numbers.items() if name not in place.references}
    known |= computed
    return known["modicon"], known["reference"], " ".join(computed), encode(", ".join(others))


def _keeps(point: Point, encode: Encode) -> str:
    return _KEEPS[point.keeps] if point.keeps in _KEEPS else encode(f"after {point.keeps}")


def scale_cells(point: Point, points: Mapping[str, Point], encode: Encode) -> tuple[str, str, str]:
    """Return factor, offset and empty text; without a linear decimal rule the rule as text."""
    line = line_of(point)
    if line is not None:
        factor, offset = exact(line.factor, line.divisor), exact(line.add, line.divisor)
        if "/" not in factor + offset:
            return factor, offset, ""
    return "", "", encode(wording.scale_text(point, points) if point.scale is not None else "")


def line_of(point: Point) -> Line | None:
    """Return the rule from raw numbers to values; None if they are no quantities or other points are needed."""
    if point.form not in ("scaled", "integer", "float"):
        return None
    if point.scale is not None:
        return fixed_rule(point)
    return SAME if point.generated or point.reserved else None


def ends_of(point: Point) -> tuple[str, str, str, str]:
    """Return the least and the greatest raw number and value; empty texts where there is none."""
    if point.info.floating:
        units = point.allowed.units
        return "", "", *((decimal(number_text(units[0][0])), decimal(number_text(units[-1][1]))) if units else ("", ""))
    outer, line = _without_codes(point, wording.outer_raw(point)), line_of(point)
    if outer is None or point.text is not None:
        return "", "", "", ""
    if line is None:
        return str(outer[0]), str(outer[1]), "", ""
    low, high = (exact(raw * line.factor + line.add, line.divisor) for raw in (outer[:: -1 if line.factor < 0 else 1]))
    return str(outer[0]), str(outer[1]), decimal(low), decimal(high)


def _without_codes(point: Point, ends: tuple[int, int] | None) -> tuple[int, int] | None:
    """The ends without the special codes there; None if nothing is left."""
    if ends is None or not point.specials:
        return ends
    low, high = ends
    while low <= high and (code := point.special(low)) is not None:
        low = code.high + 1
    while low <= high and (code := point.special(high)) is not None:
        high = code.low - 1
    return (low, high) if low <= high else None


def range_of(point: Point, points: Mapping[str, Point]) -> str:
    """Return the limits as text if least and greatest are not all: other points, gaps, fractions."""
    allowed, line = point.allowed, line_of(point)
    parts = allowed.units if point.info.floating else allowed.intervals
    unsaid = line is not None and bool(parts) and "" in ends_of(point)[2:]
    if len(parts) <= 1 and not allowed.moves and not unsaid:
        return ""
    text = wording.range_text(point, points) if line is not None else ""
    raw = "" if text else wording.raw_range_text(point)
    return f"only {text}" if text else f"only raw {raw}" if raw else ""


def default_of(point: Point) -> str:
    """Return the factory setting as a value; a special code is none."""
    raw = point.default_raw
    if point.default is None or (raw is not None and point.special(raw) is not None):
        return ""
    return decimal(number_text(point.default))


def command_cells(command: Command, device: Device, encode: Encode) -> Mapping[str, str]:
    """Return the cells of a command's row by column."""
    numbers = part_of(device).numbers(command.space, command.address)
    value = "" if command.value is None else str(command.value)
    is_bit = family(device.family).spaces[command.space] == "bit"
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
        yield f"the memory stands {command.wears} writes"
    if command.busy:
        yield f"busy while {command.busy}"


def wanted_text(command: Command) -> str:
    """Return which number the command writes: `write 1150`."""
    return f"write {'any number' if command.value is None else command.value}"
