"""The view of one point: its macros, tables and enumerators, and the functions that convert it."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from fieldscribe.names import upper
from fieldscribe.targets.c.conversions import INLINE, Writer, value_type
from fieldscribe.targets.c.declarations import defines
from fieldscribe.targets.c.layout import Function, filled, function
from fieldscribe.targets.c.limits import ranges_table, rule_view
from fieldscribe.targets.c.literals import bare, hexadecimal, raw_type, signed
from fieldscribe.targets.c.special_codes import FUNCTIONS, special_view
from fieldscribe.targets.c.views import EnumView, PointView, TableView
from fieldscribe.targets.c.word_functions import (
    bits_functions,
    digits_functions,
    has_words,
    text_functions,
    words_functions,
)
from fieldscribe.text import c_comment, c_string

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from fieldscribe.model import Enum, Flag, Point
    from fieldscribe.targets.c.scales import Scaled
    from fieldscribe.targets.c.scope import HeaderScope
    from fieldscribe.targets.c.views import PointFields


class Brings(NamedTuple):
    """What a point brings into the header because no earlier point has it."""

    names: bool
    """The names of its numbers."""
    codes: bool
    """Special codes that it shares with others."""


def point_view(
    point: Point, fields: PointFields, scope: HeaderScope, brings: Brings, scale: Scaled | None
) -> PointView:
    """Return the view of a generated point."""
    name, macro = f"{scope.prefix}_{fields.item}", f"{scope.upper}_{fields.macro}"
    shape = shape_of(point)
    struct = scope.struct(point.arguments) if len(point.arguments) > 1 else ""
    members = sorted(point.arguments) if struct and scope.is_first(point.item, struct) else ()
    return PointView(
        fields=fields,
        function=name,
        macro=macro,
        defines=tuple(defines(point, fields, scope)),
        enum=_enum_view(point, fields, scope) if brings.names else None,
        tables=tuple(_tables(point, name, scope)),
        struct=struct,
        members=tuple((raw_type(scope.points[member]), f"{member}_raw") for member in members),
        rule=rule_view(point, scope) if shape == "ruled" else None,
        shape=shape,
        raw_type=raw_type(point),
        counts=point.decimals is not None,
        encodes=point.encodes_values,
        readable=point.readable,
        writable=point.writable,
        special=special_view(point, fields, scope, brings=brings.codes),
        scale=scale,
        scale_arguments=point.scale_arguments,
        limit_arguments=point.limit_arguments,
        splits=has_words(point),
        bits=point.bits is not None,
        flags=tuple(f"_{flag.name}" for flag in point.flags if flag.width > 1),
    )


def computes_in_double(view: PointView) -> bool:
    """Return True if the value is a double even where values are float by choice."""
    if view.scale is not None:
        return view.scale.wide
    return view.shape == "ruled" or (view.shape == "float" and view.raw_type == "uint64_t")


def named_numbers(point: Point) -> Enum | None:
    """Return the enum that names the point's numbers, or each of its digits."""
    return point.digits.enum if point.digits is not None else point.enum


def names_of(point: Point, fields: PointFields) -> tuple[str, str]:
    """Return the name of the point's enum, also in capitals; an enum of its own has the point's name."""
    enum = named_numbers(point)
    assert enum is not None
    return (fields.item, fields.macro) if enum.name == point.item else (enum.name, upper(enum.name))


def shape_of(point: Point) -> str:
    """Return the form of the point's functions: `plain`, `scaled`, `ruled`, `float`, `text` or `digits`."""
    form = point.form
    if form == "scaled":
        return "ruled" if point.scale_arguments else form
    return form if form in ("float", "text", "digits") else "plain"


def functions_of(point: Point, view: PointView, scope: HeaderScope) -> Iterator[Function]:
    """Yield all functions of a point."""
    name, writer = view.function, Writer(point, view, scope)
    if view.shape == "text":
        yield from text_functions(point, name)
    elif view.shape == "digits":
        yield from digits_functions(point, name, view.special, scope)
    else:
        ways = {"plain": writer.plain, "scaled": writer.scaled, "ruled": writer.ruled, "float": writer.floating}
        yield from ways[view.shape]()
    for flag in point.flags:
        if flag.width > 1:
            yield _flag_function(flag, point, name)
    if view.splits:
        yield from words_functions(point, name)
    if view.bits:
        yield from bits_functions(point, name)


def symbols_of(view: PointView) -> list[tuple[str, str]]:
    """Return the functions and arrays that are named after a point, each with its `sort` for old names."""
    plain, floating = "FUNCTION", "FLOATING_FUNCTION" if view.shape in ("scaled", "ruled", "float") else "FUNCTION"
    counted = view.shape in ("scaled", "ruled") and view.counts
    has_check = view.writable and view.shape != "text"
    symbols = [("_encode", floating)] * (view.writable and view.encodes)
    symbols += [("_encode_count", plain)] * (view.writable and counted)
    symbols += [("_decode", floating), ("_decode_count", plain)][: 1 + counted] * view.readable
    symbols += [("_check", plain)] * has_check
    symbols += [("_to_words", plain), ("_from_words", plain)] * view.splits
    symbols += [("_extract", plain), ("_insert", plain)] * view.bits
    symbols += [("_addresses", "OBJECT")] * (view.shape == "text")
    tails = (*view.flags, *(FUNCTIONS if view.special is not None else ()))
    return [(view.function + tail, sort) for tail, sort in (*symbols, *((tail, plain) for tail in tails))]


def _tables(point: Point, name: str, scope: HeaderScope) -> Iterator[TableView]:
    """Yield the arrays of a point: the words of a text, its ranges if it is the first that has them."""
    if point.text is not None:
        rows = filled(map(hexadecimal, point.place.addresses), ", ", "    ")
        yield TableView("uint16_t", f"{name}_addresses", str(point.words), tuple(rows))
    elif (table := ranges_table(point, scope)) and scope.is_first(point.item, table):
        rows = filled((f"{{{bare(low)}, {bare(high)}}}" for low, high in point.allowed.fixed), ", ", "    ")
        yield TableView("fieldscribe_range", table, "", tuple(rows))


def _enum_view(point: Point, fields: PointFields, scope: HeaderScope) -> EnumView:
    """Return the enumerators of a point's numbers, and the function that looks their names up."""
    enum, (prefix, macro) = named_numbers(point), names_of(point, fields)
    assert enum is not None
    entries: list[tuple[str, str, str]] = []
    named: dict[int, tuple[str, str]] = {}
    for entry in enum.entries:
        name = f"{scope.upper}_{macro}_{upper(entry.name)}"
        comment = f" /* {c_comment(entry.quantity)} */" if entry.quantity else ""
        entries.append((name, signed(entry.raw), comment))
        named.setdefault(entry.raw, (name, c_string(entry.name)))
    lookup, table = f"{scope.prefix}_{prefix}_name", f"{scope.prefix}_{prefix}_names"
    form = _form_of(named, digits=enum.name in scope.digits)
    return EnumView(
        entries=tuple(entries),
        fits_int=all(-(1 << 15) <= entry.raw < 1 << 15 for entry in enum.entries),
        table_type=_TABLES[form],
        table=table,
        rows=tuple(filled(_rows(named, form), ", ", "    ")),
        function=lookup,
        lookup=_lookup(lookup, table, value_type(point), form),
    )


_TABLES = {"dense": "char *const", "sparse": "fieldscribe_name", "wide": "fieldscribe_wide_name"}


def _form_of(named: Mapping[int, tuple[str, str]], *, digits: bool) -> str:
    """Return the form of a table of names: `dense` if its numbers count from 0, else `sparse` or `wide`."""
    if not digits and sorted(named) == list(range(len(named))):
        return "dense"
    return "sparse" if all(-(1 << 31) <= raw < 1 << 31 for raw in named) else "wide"


def _rows(named: Mapping[int, tuple[str, str]], form: str) -> Iterator[str]:
    for raw in sorted(named):
        name, text = named[raw]
        pair = f"{{{name if form == 'sparse' else f'(uint64_t){name}'}, {text}}}"
        yield text if form == "dense" else pair


def _lookup(name: str, table: str, kind: str, form: str) -> str:
    rows = f"{table}, FIELDSCRIBE_COUNT({table})"
    number = "(raw <= (uint64_t)INT64_MAX) ? (int64_t)raw : -1" if kind == "uint64_t" else "raw"
    if form == "wide":
        body = f"fieldscribe_wide_name_of({rows}, {'raw' if kind == 'uint64_t' else '(uint64_t)raw'})"
    elif form == "dense":
        body = f"FIELDSCRIBE_NAME_AT({table}, {number})"
    elif kind == "uint64_t":
        body = f"(raw <= (uint64_t)INT32_MAX) ? fieldscribe_name_of({rows}, (int64_t)raw) : NULL"
    else:
        body = f"fieldscribe_name_of({rows}, raw)"
    return function(f"{INLINE} const char *", name, (f"{kind} raw",), f"return {body};").text


def _flag_function(flag: Flag, point: Point, name: str) -> Function:
    """Return the function that takes a flag of several bits out of the raw number."""
    bits = point.info.bits
    kind, wide = f"uint{bits}_t", "_wide" if bits > 16 else ""
    raw = f"(uint{max(16, bits)}_t)raw" if point.info.signed else "raw"
    mask = hexadecimal(((1 << flag.width) - 1) << flag.low, bits // 4)
    body = f"fieldscribe_extract{wide}({raw}, {mask}, {flag.low}U)"
    body = body if bits in (16, 64) else f"({kind}){body}"
    return function(f"{INLINE} {kind}", f"{name}_{flag.name}", (f"{raw_type(point)} raw",), f"return {body};")
