"""The view of one point: its macros, tables and enumerators, and the functions that convert it."""

from collections.abc import Iterator, Mapping

from fieldscribe.arithmetic.words import mask_of
from fieldscribe.model import Enum, Flag, Point
from fieldscribe.targets.c.conversions import Writer, value_type
from fieldscribe.targets.c.declarations import defines, value_defines
from fieldscribe.targets.c.layout import INLINE, WIDTH, Function, filled, function
from fieldscribe.targets.c.limits import ranges_table, rule_view
from fieldscribe.targets.c.scales import Scaled
from fieldscribe.targets.c.scope import HeaderScope, bare, hexadecimal, raw_type, signed
from fieldscribe.targets.c.special_codes import FUNCTIONS, special_view
from fieldscribe.targets.c.views import EnumView, PointFields, PointView, RuleView
from fieldscribe.targets.c.word_functions import (
    bits_functions,
    date_rows,
    digits_functions,
    has_words,
    text_functions,
    words_functions,
)
from fieldscribe.text import c_comment, c_string, upper


def point_view(point: Point, fields: PointFields, scope: HeaderScope, scale: Scaled | None) -> PointView:
    """Return the view of a generated point."""
    name, macro = f"{scope.prefix}_{fields.item}", f"{scope.upper}_{fields.macro}"
    shape = shape_of(point)
    struct = scope.struct(point.arguments) if len(point.arguments) > 1 else ""
    members = sorted(point.arguments) if struct and scope.is_first(point.item, struct) else ()
    enum, (brings_names, brings_codes, brought) = point.named_numbers, scope.brings(point)
    return PointView(
        point=point,
        fields=fields,
        function=name,
        macro=macro,
        defines=tuple(defines(point, fields, scope)),
        shared_values=tuple(
            (flag, tuple(value_defines(flag, f"{scope.upper}_{upper(name)}")))
            for name in brought
            for flag in [next(flag for flag in point.flags if flag.enum == name)]
        ),
        enum=_enum_view(enum, point, fields, scope) if enum is not None and brings_names else None,
        tables=tuple(_tables(point, name, scope)),
        struct=struct,
        members=tuple((raw_type(scope.points[member]), f"{member}_raw") for member in members),
        rule=_first_rule_view(point, scope) if shape == "ruled" else None,
        shape=shape,
        raw_type=raw_type(point),
        special=special_view(point, fields, scope, brings=brings_codes),
        scale=scale,
    )


def names_of(enum: Enum, point: Point, fields: PointFields) -> tuple[str, str]:
    """Return the name of a point's enum, also in capitals; an enum of one point has the name of the point."""
    return (fields.item, fields.macro) if enum.name == point.item else (enum.name, upper(enum.name))


def _first_rule_view(point: Point, scope: HeaderScope) -> RuleView:
    rule = rule_view(point, scope)
    return rule if scope.is_first(point.item, rule.name) else rule._replace(text="")


def shape_of(point: Point) -> str:
    """Return the form of the point's functions, as in `PointView`."""
    form = point.form
    if form == "scaled":
        return "ruled" if point.scale_arguments else form
    return form if form in ("float", "text", "digits") else "plain"


def functions_of(view: PointView, scope: HeaderScope) -> Iterator[Function]:
    """Yield all functions of a point."""
    point, name, writer = view.point, view.function, Writer(view, scope)
    if point.writable and view.shape != "text":
        yield writer.check()
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
    if has_words(point):
        yield from words_functions(point, name)
    if point.bits is not None:
        yield from bits_functions(point, name)


def symbols_of(view: PointView) -> list[tuple[str, str]]:
    """Return the functions and arrays that are named after a point, each with its `sort` for old names."""
    point, counted, plain = view.point, view.is_counted, "FUNCTION"
    floating = "FLOATING_FUNCTION" if view.shape in ("scaled", "ruled", "float") else plain
    symbols = [("_encode", floating)] * (point.writable and point.encodes_values)
    symbols += [("_encode_count", plain)] * (point.writable and counted)
    symbols += [("_decode", floating), ("_decode_count", plain)][: 1 + counted] * point.readable
    symbols += [("_check", plain)] * (point.writable and view.shape != "text")
    symbols += [("_to_words", plain), ("_from_words", plain)] * has_words(point)
    symbols += [("_extract", plain), ("_insert", plain)] * (point.bits is not None)
    symbols += [("_addresses", "OBJECT")] * (view.shape == "text" or point.place.is_scattered)
    symbols += [("_parts", "OBJECT")] * (point.text is not None and bool(point.text.parts))
    symbols += [(f"_{flag.name}", plain) for flag in point.flags if flag.width > 1]
    symbols += [(tail, plain) for tail in FUNCTIONS] * (view.special is not None)
    return [(view.function + tail, sort) for tail, sort in symbols]


def _tables(point: Point, name: str, scope: HeaderScope) -> Iterator[tuple[str, tuple[str, ...]]]:
    """Yield the declarations and rows of a point's arrays: the words of a text, or the ranges that it defines."""
    if point.text is not None or point.place.is_scattered:
        rows = filled(map(hexadecimal, point.place.addresses), ", ", "    ")
        yield f"uint16_t {name}_addresses[{point.words}]", tuple(rows)
        if point.text is not None and point.text.parts:
            yield f"fieldscribe_date_part {name}_parts[]", tuple(filled(date_rows(point.text), ", ", "    "))
    elif (table := ranges_table(point, scope)) and scope.is_first(point.item, table):
        rows = filled((f"{{{bare(low)}, {bare(high)}}}" for low, high in point.allowed.fixed), ", ", "    ")
        yield f"fieldscribe_range {table}[]", tuple(rows)


def _enum_view(enum: Enum, point: Point, fields: PointFields, scope: HeaderScope) -> EnumView:
    """Return the enumerators of a point's numbers, and the function that looks their names up."""
    prefix, macro = names_of(enum, point, fields)
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
        table=table,
        names=tuple(_table(f"static const {_TABLES[form]} {table}[]", list(_rows(named, form)))),
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


def _table(declaration: str, rows: list[str]) -> list[str]:
    """Return the lines of a table: one if it fits."""
    line = f"{declaration} = {{{', '.join(rows)}}};"
    return [line] if len(line) <= WIDTH else [f"{declaration} = {{", *filled(rows, ", ", "    "), "};"]


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
    mask = hexadecimal(mask_of(flag.width, flag.low), bits // 4)
    body = f"fieldscribe_extract{wide}({raw}, {mask}, {flag.low}U)"
    body = body if bits in (16, 64) else f"({kind}){body}"
    return function(f"{INLINE} {kind}", f"{name}_{flag.name}", (f"{raw_type(point)} raw",), f"return {body};")
