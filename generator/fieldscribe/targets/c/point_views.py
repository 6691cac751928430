"""The generated points of a device: their views and fields, and the functions and tables of a point.

The texts of many points differ in a few words only. These words are the fields of a point, finished for C. The rest is
laid out once for all points with the same view, with placeholders for the fields. The header, the frames and the
conformance program fill these texts.
"""

from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping
from functools import partial
from typing import NamedTuple

from fieldscribe.arithmetic.words import mask_of
from fieldscribe.model import Device, Enum, Flag, Point
from fieldscribe.targets.c.conversions import Writer, value_type
from fieldscribe.targets.c.declarations import (
    FUNCTIONS,
    PointComment,
    code_set,
    defines,
    encoded_limits,
    range_words,
    value_defines,
)
from fieldscribe.targets.c.limits import has_ranges_table, name_shared, ranges_table, rule_function
from fieldscribe.targets.c.scales import Scaled
from fieldscribe.targets.c.scope import EnumView, HeaderScope, PointFields, PointView
from fieldscribe.targets.c.syntax import INLINE, WIDTH, Function, bare, filled, function, hexadecimal, raw_type, signed
from fieldscribe.targets.c.word_functions import (
    bits_functions,
    date_rows,
    digits_functions,
    has_words,
    text_functions,
    words_functions,
)
from fieldscribe.targets.placeholders import MOST_FIELDS, TextTemplates, placeholders
from fieldscribe.text import c_comment, c_string, upper

_TABLES = {"dense": "char *const", "sparse": "fieldscribe_name", "wide": "fieldscribe_wide_name"}


# The points of a device.


class GeneratedPoint(NamedTuple):
    """A point with code: the view that it shares with points of the same text, and the fields that fill the text."""

    point: Point
    view: PointView
    fields: tuple[str, ...]


class LimitFields(NamedTuple):
    """The fields of a point's limits, and the `form` of the other text about them.

    `ends` are the six fields from `low` to `last`; `range` is for people. `in_table` says that a table holds the
    ranges; the first point with these ranges defines it.
    """

    ends: tuple[str, ...]
    range: str
    scale: Scaled | None
    form: Hashable
    in_table: bool


def texts_of(points: Iterable[GeneratedPoint], lay_out: Callable[[PointView, object], str]) -> Iterator[str]:
    """Yield one part of the text of each point; it is laid out once for each view, which has the fields."""
    texts = TextTemplates()
    for _, view, fields in points:
        yield texts.fill(view, fields, partial(lay_out, view))


def generated_points(device: Device, scope: HeaderScope, *, names_only: bool = False) -> list[GeneratedPoint]:
    """Return the points of a device that have code; with `names_only`, only with what identifiers need."""
    points = [point for point in device.points if point.generated]
    name_shared(points, scope)
    views = _PointViews(scope)
    return list(map(views.named if names_only else views.generated, points))


class _PointViews:
    """Makes the views of a device's points, in the order of the points."""

    def __init__(self, scope: HeaderScope) -> None:
        self._scope = scope
        self._keys = scope.lowered.template_keys
        self._views: dict[Hashable, PointView] = {}
        self._limits: dict[tuple[int, int], LimitFields] = {}
        self._comments: dict[tuple[int, str | None], PointComment] = {}

    def generated(self, point: Point) -> GeneratedPoint:
        """Return the next point with its view and its fields."""
        key, item, scope = self._keys[id(point)], point.item, self._scope
        limited, commented = (key, id(point.allowed)), (key, scope.spaces.get(point.terms.group))
        limits = self._limits.get(limited) or self._limits.setdefault(limited, _limits_of(point))
        comment = self._comments.get(commented) or self._comments.setdefault(commented, PointComment(point, scope))
        fields = _fields_of(point, item, limits, comment)
        whole = key, limits.form, scope.brings(point), tuple(map(len, fields[1:]))  # not the comment
        view = self._views.get(whole)
        if limits.in_table or point.was or len(fields) > MOST_FIELDS:
            view = point_view(point, PointFields.of(fields), scope, limits.scale)
        elif view is None:
            fillers = PointFields.of(placeholders(fields))
            view = self._views[whole] = point_view(point, fillers, scope, limits.scale)
        return GeneratedPoint(point, view, fields)

    def named(self, point: Point) -> GeneratedPoint:
        """Return the next point with its names alone."""
        fields = ("", point.item, upper(point.item), *[""] * (len(PointFields._fields) - 4))
        return GeneratedPoint(point, point_view(point, PointFields.of(fields), self._scope, None), fields)


def fields_of(point: Point, scope: HeaderScope, remark: str = "") -> PointFields:
    """Return the fields of a single point; `remark` ends its comment."""
    limits = _limits_of(point)
    return PointFields.of(_fields_of(point, point.item, limits, PointComment(point, scope, remark)))


def _fields_of(point: Point, item: str, limits: LimitFields, comment: PointComment) -> tuple[str, ...]:
    """Return the fields in the order of `PointFields`."""
    addresses = point.place.addresses
    places = [""] * 4
    if addresses:
        least = min(addresses)
        places = [hexadecimal(least), hexadecimal(addresses[0]), hexadecimal(addresses[-1]), str(least)]
    code = "" if point.code is None else c_string(point.code)
    references = [
        c_string(printed) if isinstance(printed, str) else signed(printed)
        for printed in point.place.references.values()
    ]
    return (comment.of(point, limits.range), item, upper(item), *limits.ends, *places, code, *references)


def _limits_of(point: Point) -> LimitFields:
    allowed, (low, high) = point.allowed, (0, 0) if point.info.floating else point.outer
    scale = Scaled(point, *encoded_limits(point)) if point.form == "scaled" and not point.scale_arguments else None
    first, last = (0, 0) if scale is None else scale.counts
    form = (
        (low, high) == point.held if point.type != "u64" and not point.specials else allowed.fixed,
        scale and (scale.wide, scale.inside, (first, last) == (low, high), point.writable and scale.raw_of_count),
    )
    ends = bare(low), bare(high), signed(low), signed(high), bare(first), bare(last)
    return LimitFields(ends, c_comment(range_words(point)), scale, form, has_ranges_table(point))


# The view of a point, its functions and tables.


def point_view(point: Point, fields: PointFields, scope: HeaderScope, scale: Scaled | None) -> PointView:
    """Return the view of a generated point."""
    name, macro = f"{scope.prefix}_{fields.item}", f"{scope.upper}_{fields.macro}"
    shape = shape_of(point)
    struct = scope.struct(point.arguments) if len(point.arguments) > 1 else ""
    members = sorted(point.arguments) if struct and scope.is_first(point.item, struct) else ()
    enum, (brings_names, brings_codes, brought) = point.named_numbers, scope.brings(point)
    special = f"{scope.prefix}_{point.shared_codes or fields.item}" if point.specials else ""
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
        rule=_first_rule(point, scope) if shape == "ruled" else None,
        shape=shape,
        raw_type=raw_type(point),
        special=special,
        codes=code_set(point, special, scope) if special and (brings_codes or not point.shared_codes) else None,
        scale=scale,
    )


def names_of(enum: Enum, point: Point, fields: PointFields) -> tuple[str, str]:
    """Return the name of a point's enum, also in capitals; an enum of one point has the name of the point."""
    return (fields.item, fields.macro) if enum.name == point.item else (enum.name, upper(enum.name))


def _first_rule(point: Point, scope: HeaderScope) -> Function:
    rule = rule_function(point, scope)
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
        yield from digits_functions(point, name, view.is_special, scope)
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
    symbols += [(tail, plain) for tail in FUNCTIONS] * bool(view.special)
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
        lookup=_lookup(lookup, table, value_type(point), form),
    )


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


def _lookup(name: str, table: str, kind: str, form: str) -> Function:
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
    return function(f"{INLINE} const char *", name, (f"{kind} raw",), f"return {body};")


def _flag_function(flag: Flag, point: Point, name: str) -> Function:
    """Return the function that takes a flag of several bits out of the raw number."""
    bits = point.info.bits
    kind, wide = f"uint{bits}_t", "_wide" if bits > 16 else ""
    raw = f"(uint{max(16, bits)}_t)raw" if point.info.signed else "raw"
    mask = hexadecimal(mask_of(flag.width, flag.low), bits // 4)
    body = f"fieldscribe_extract{wide}({raw}, {mask}, {flag.low}U)"
    body = body if bits in (16, 64) else f"({kind}){body}"
    return function(f"{INLINE} {kind}", f"{name}_{flag.name}", (f"{raw_type(point)} raw",), f"return {body};")
