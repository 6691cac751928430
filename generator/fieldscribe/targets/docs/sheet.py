"""The table of points: a row for each, with a column for each fact that can be counted, sorted or looked up."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, NamedTuple

from fieldscribe import wording
from fieldscribe.targets.docs.bus import part_of
from fieldscribe.targets.docs.commands import command_cells
from fieldscribe.targets.docs.meanings import codes_of, enum_of
from fieldscribe.targets.docs.quantities import default_of, ends_of, range_of, scale_cells
from fieldscribe.targets.docs.tables import Column, Table, decimal, original, source_cells
from fieldscribe.wording.exact import hex_text, number_text

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Place, Point
    from fieldscribe.targets.docs.bus import OfFamily
    from fieldscribe.targets.docs.subjects import Scope
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


class _Kin(NamedTuple):
    """The cells that points have alike; `remarks` is plain text, to which points may add."""

    group: str
    space: tuple[str, str]
    words: str
    bits: tuple[str, ...]
    meaning: tuple[str, ...]
    behaviour: tuple[str, str, str]
    remarks: tuple[str, ...]
    remarks_cell: str
    generated: tuple[str, str]


def points_table(scope: Scope) -> Table:
    """The points of a device."""
    return Table("points", COLUMNS, partial(_rows, scope))


def _rows(scope: Scope, encode: Encode) -> Iterator[tuple[str, ...]]:
    kins: dict[int, _Kin] = {}
    limits_by_id: dict[int, tuple[str, ...]] = {}
    part = part_of(scope.device)
    for point, number, limits in scope.subjects:
        kin = kins.get(number)
        if kin is None:
            kin = kins[number] = _kin(scope, point, encode)
        ends = limits_by_id.get(id(limits))
        if ends is None:
            ends = limits_by_id[id(limits)] = (*ends_of(point), encode(range_of(point, scope.by_name)))
        enum = enum_of(point)
        yield (
            encode(point.code or ""),
            encode(point.item),
            "point",
            encode(str(point.variant)) if point.variant else "",
            kin.group,
            encode(point.title["en"]),
            encode(original(point.title)),
            *kin.space,
            *_address(point.place),
            kin.words,
            encode(wording.order_text(point)),
            *kin.bits,
            "" if point.index is None else str(point.index),
            *_references(point, part, encode),
            *kin.meaning,
            *ends,
            default_of(point),
            "" if point.default_raw is None else str(point.default_raw),
            "" if enum is None else encode(enum.name),
            encode(point.item) if point.flags else "",
            encode(codes_of(point)),
            *kin.behaviour,
            encode(point.record or ""),
            "" if point.set is None else str(point.set),
            _remarks(point, kin, encode),
            encode(wording.title_text(point.note)) if point.note else "",
            encode("; ".join(point.errata)),
            *source_cells(point.source, encode),
            *kin.generated,
        )
    for command in scope.device.commands:
        cells = command_cells(command, scope.device, encode)
        yield tuple(cells.get(column.name, "") for column in COLUMNS)


def _kin(scope: Scope, point: Point, encode: Encode) -> _Kin:
    remarks = tuple(text for text in _common_remarks(scope, point) if text)
    return _Kin(
        group=encode(point.group),
        space=(encode(point.space), encode(point.telegram or "")),
        words=str(point.words),
        bits=_bits(point),
        meaning=(
            point.type if point.untyped is None else "",
            point.form if point.untyped is None else "",
            point.access,
            encode(point.unit.symbol),
            *scale_cells(point, scope.by_name, encode),
        ),
        behaviour=(_keeps(point, encode), encode("; ".join(point.conditions)), encode(point.changes or "")),
        remarks=remarks,
        remarks_cell=encode("; ".join(remarks)),
        generated=("yes" if point.generated else "no", encode(point.reason or "")),
    )


def _address(place: Place) -> tuple[str, str]:
    """The lowest address in both notations."""
    addresses = place.addresses
    return (str(min(addresses)), hex_text(min(addresses))) if addresses else ("", "")


def _bits(point: Point) -> tuple[str, ...]:
    """Where in its word a bit group is, whether it shares the word, and the bits that are always the same."""
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


def _common_remarks(scope: Scope, point: Point) -> Iterator[str]:
    """What else is to be said of all points of a kin; much of it may be empty."""
    terms = point.terms
    yield f"type: {terms.untyped}" if terms.untyped else ""
    yield wording.type_text(point) if point.form in ("text", "digits") else ""
    yield f"steps: {wording.steps_text(point)}" if point.steps else ""
    yield wording.shared_text(point)
    yield wording.fixed_text(point)
    yield wording.display_text(point)
    yield from wording.width_texts(point)
    yield f"exists when {wording.condition_text(terms.when, scope.by_name)}" if terms.when else ""
    yield f"since {terms.since}" if terms.since else ""
    yield f"until {terms.until}" if terms.until else ""
    yield f"read it again after writing {', '.join(terms.changes_with)}" if terms.changes_with else ""


def _remarks(point: Point, kin: _Kin, encode: Encode) -> str:
    own = [*_own_remarks(point)]
    return encode("; ".join([*kin.remarks, *own])) if own else kin.remarks_cell


def _own_remarks(point: Point) -> Iterator[str]:
    """What else is to be said of one point alone."""
    if point.write_place is not None and point.addresses:
        yield f"written at {wording.write_place_text(point)}"
    if point.default is not None and point.default_raw is None and not decimal(number_text(point.default)):
        yield f"default {wording.default_text(point)}"
    if parts := wording.default_parts(point):
        yield f"default: {parts}"
    if point.was:
        yield f"was {', '.join(point.was)}"
