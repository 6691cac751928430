"""The tables of the conformance program: for each kind of vector the points that answer it, with their rows of calls.

`conformance_tables` makes them, `arms` chains those that answer a kind. A row is laid out once for all points with the
same template key.
"""

from collections.abc import Iterable, Iterator, Sequence
from functools import partial
from typing import NamedTuple

from fieldscribe.families import family
from fieldscribe.grouping import grouped
from fieldscribe.model import Device, Point, Text
from fieldscribe.targets.placeholders import TextTemplates
from fieldscribe.targets.rust.enums import getter_name
from fieldscribe.targets.rust.layout import Lines
from fieldscribe.targets.rust.literals import type_name, value_name
from fieldscribe.targets.rust.scope import END, CratePoint, CrateScope, Needs, Table, Tokens, Way, in_rust, row_text
from fieldscribe.text import rust_string, upper

_CHAIN = 60
"""A chain of calls on one line has at most this many characters."""


class Spot(NamedTuple):
    """Where a row belongs: the kind of the vectors, and the function of the runner that answers them."""

    kind: str
    run: str

    @property
    def name(self) -> str:
        """The name of the table."""
        return f"{self.kind}_by_{self.run}" if self.kind in ("read", "write", "store") else self.run


Row = tuple[Spot, Tokens]
Rows = dict[Spot, list[str]]


def conformance_tables(scope: CrateScope, device: Device) -> tuple[Table, ...]:
    """Return the tables in the order of their first points; rows are tokens that the runner's macro reads."""
    return *(Table(spot.name, spot.run, rows, spot.kind) for spot, rows in _rows(scope).items()), *_protocol(device)


def arms(tables: Iterable[Table]) -> Iterator[tuple[str, Lines]]:
    """Yield each kind of vectors with the chain of tables that answer it, in lines as rustfmt lays them out."""
    answering = grouped((table.kind, f"{table.name}(vector)") for table in tables)
    for kind, calls in answering.items():
        chain = [calls[0], *(f".or_else(|| {call})" for call in calls[1:])]
        on_one_line = len(chain) <= 2 or len("".join(chain)) <= _CHAIN
        yield kind, ("".join(chain),) if on_one_line else (chain[0], *(f"    {link}" for link in chain[1:]))


def _rows(scope: CrateScope) -> Rows:
    """Return all rows of all points, each in its table."""
    rows: Rows = {}
    texts = TextTemplates()
    for subject in scope.subjects:
        enum = subject.enum
        fields = (subject.item, subject.name, "" if enum is None else type_name(enum.name))
        text = texts.fill((subject.key, *map(len, fields)), fields, partial(_laid_out, subject, scope))
        for row in text.split(END):
            kind, run, tokens = row.split("\0")
            rows.setdefault(Spot(kind, run), []).append(tokens)
    return rows


def _laid_out(subject: CratePoint, scope: CrateScope, fields: Sequence[str]) -> str:
    """Return the rows of a point with these fields, each after its spot."""
    item, name, enum = fields
    found = rows_of(subject.renamed(item, name), enum, scope)
    return END.join([f"{kind}\0{run}\0{row_text(row)}" for (kind, run), row in found])


def _protocol(device: Device) -> Iterator[Table]:
    """Yield the tables of the numbers of the protocol, of documented points, and of commands."""
    part = in_rust(device.family)
    rows: dict[str, list[str]] = {}
    for codes in family(device.family).codes:
        kind, module, how = "constant", f"{codes.kind}s", "code"
        if codes.section == "exceptions":
            kind, module, how = part.refusals, "exceptions", "named"
        for code in device.bus.codes(codes.section) if codes.emitted else ():
            row = item_row(f"{codes.kind} {code.name}", module, how, upper(code.name))
            rows.setdefault(kind, []).append(row)
    rows["documented"] = [
        item_row(point.item, "points", "documented", upper(point.item)) for point in device.points if point.raw_only
    ]
    rows["command"] = [item_row(each.name, "commands", "sent", upper(each.name)) for each in device.commands]
    yield from (Table(kind, kind, of_kind, kind) for kind, of_kind in rows.items() if of_kind)
    yield from part.tables_of_frames(device)


def item_row(key: str, module: str, how: str, name: str) -> str:
    """Return the row of something other than a point: its key in the vectors, and its path in the crate."""
    return row_text((rust_string(key), module, *bracketed((how, name))))


# The rows of a point.


def rows_of(subject: CratePoint, enum: str, scope: CrateScope) -> Iterator[Row]:
    """Yield all rows of a point; `enum` is the type of its enum."""
    point = subject.point
    yield from _conversions(subject)
    yield from _flags(subject)
    if enum:
        yield Spot("name", "name"), (_quoted(subject.item), enum, *bracketed(("enum", subject.carried)))
    alone = row_of(subject, ("(alone)",))
    for kind, holds in (
        ("special", point.specials),
        ("special_name", point.specials),
        ("bits", point.bits),
        ("words", _has_words(point)),
        ("symbol", point.unit.symbol),
        ("place", _has_place(point)),
        ("write_address", point.write_place is not None),
        ("fixed", point.fixed),
        ("display", point.display is not None),
        ("epoch", bool(point.epoch)),
    ):
        if holds:
            yield Spot(kind, kind), alone
    yield Spot("address", "address"), row_of(subject, _references(point))
    if point.display is not None:
        yield Spot("told", "told"), _read(subject)
    if point.write_with and point.text is None:
        yield Spot("alone", "alone"), row_of(subject, ("(wire)",))
    if point.addresses:
        yield from _exchanges(subject, scope)
    for kind in in_rust(scope.family).kinds(subject, scope):
        yield Spot(kind, kind), row_of(subject, ("(frames)",))


def _conversions(subject: CratePoint) -> Iterator[Row]:
    """Yield the rows by which a point is decoded, encoded and checked."""
    point, layout, (decodes, encodes) = subject.point, _layout(subject), _conversion_spots(subject)
    if point.readable:
        yield from ((spot, row_of(subject, layout) if layout else _read(subject)) for spot in decodes)
    if point.writable:
        yield from ((spot, row_of(subject, layout) if layout else _written(subject)) for spot in encodes)
        if point.form != "text":
            yield Spot("check", "check"), _written(subject)


def _conversion_spots(subject: CratePoint) -> tuple[list[Spot], list[Spot]]:
    """Return the spots for decoding and encoding of a point."""
    point = subject.point
    if point.form in ("scaled", "float"):
        decodes, encodes = ["decode"], ["encode"] if point.form == "float" or point.encodes_values else []
        if point.form == "scaled" and point.decimals is not None:
            decodes, encodes = [*decodes, "decode_count"], [*encodes, "encode_count"]
        return [Spot(kind, kind) for kind in decodes], [Spot(kind, kind) for kind in encodes]
    if point.text is not None:
        kind = _kind_of(point.text)
        return [Spot(f"{kind}_decode", f"{kind}_decode")], [Spot(f"{kind}_encode", f"{kind}_encode")]
    if point.form == "digits":
        coded = "_coded" if point.specials else ""
        return [Spot("digits", f"digits{coded}")], [Spot("digits_encode", f"digits_encode{coded}")]
    how = "count" if subject.carried != subject.raw else "coded" if point.specials else "plain"
    return [Spot("decode_count", f"decode_{how}")], [Spot("encode_count", f"encode_{how}")]


def _kind_of(text: Text) -> str:
    if text.parts:
        return "date"
    return "bytes" if text.is_bytes else "unicode" if text.is_unicode else "text"


def _layout(subject: CratePoint) -> Tokens:
    """Return the sizes of a text or of digits; empty for a number."""
    text, digits = subject.point.text, subject.point.digits
    if text is not None and text.parts:
        return bracketed(("size", str(subject.point.words)))
    if text is not None:
        return bracketed(("sizes", str(text.most_bytes), str(subject.point.words)))
    return () if digits is None else bracketed(("digits", str(digits.count), subject.carried))


def _flags(subject: CratePoint) -> Iterator[Row]:
    item = subject.item
    for flag in subject.point.flags:
        if subject.point.form == "flags":
            calls = bracketed(("flag", subject.raw, getter_name(flag.name), f"with_{flag.name}"))
            yield Spot("flag", "flag"), (_quoted(f"{item} {flag.name}"), subject.name, *calls)
        for entry in flag.values if flag.width > 1 else ():
            value = bracketed(("value", f"{flag.name.upper()}_{entry.name.upper()}"))
            yield Spot("flag_name", "flag_name"), (_quoted(f"{item} {flag.name} {entry.name}"), subject.name, *value)


def _exchanges(subject: CratePoint, scope: CrateScope) -> Iterator[Row]:
    """Yield a row for each way in which the point is read or written."""
    for kind, run, needs in _ways(subject, scope):
        arguments = [token for pair in needs for token in bracketed(_arguments(*pair))]
        yield Spot(kind, run), row_of(subject, bracketed(("wire", *arguments)))


def _ways(subject: CratePoint, scope: CrateScope) -> Iterator[Way]:
    """Yield the ways to read and write a point: by requests if it has an address, and further ones of its family."""
    point = subject.point
    text = "_text" if point.form == "text" else ""
    if point.telegram is None and point.readable:
        yield "read", f"read{text}", ()
    if point.telegram is None and point.writable and not point.write_with:
        yield "write", *change_of(subject, "write", "update")
    yield from in_rust(scope.family).ways(subject, scope)


def change_of(subject: CratePoint, change: str, update: str) -> tuple[str, Needs]:
    """Return the function that writes a point, and the structs that it needs."""
    point, needs = subject.point, (of_scale(subject), of_all(subject))
    if point.bits:
        return (f"{update}_with", needs) if point.arguments else (update, ())
    if not (point.readable and point.encodes_values):
        return f"{change}_only", ()
    text = point.form == "text"
    return f"{change}{'_text' if text else ''}", () if text else needs


def of_scale(subject: CratePoint) -> tuple[str, tuple[str, ...]]:
    """Return the struct of the raw numbers that the scale needs, with its fields."""
    return subject.factors_struct, subject.point.scale_arguments


def of_all(subject: CratePoint) -> tuple[str, tuple[str, ...]]:
    """Return the struct of all raw numbers that writing needs, with its fields."""
    return subject.name, subject.point.arguments


def row_of(subject: CratePoint, how: Tokens) -> Tokens:
    """Return the row of a point: its name in the vectors, its path in the crate, and further tokens."""
    return _quoted(subject.item), subject.name, *how


def bracketed(tokens: Tokens) -> Tokens:
    """Return tokens in parentheses."""
    if not tokens:
        return ("()",)
    first, *others = tokens
    return (f"({first})",) if not others else (f"({first}", *others[:-1], f"{others[-1]})")


def _quoted(names: str) -> str:
    """Return names in quotes. Identifiers need no escapes, and an encoder would strip placeholders."""
    return f'"{names}"'


def _read(subject: CratePoint) -> Tokens:
    return row_of(subject, bracketed(_arguments(*of_scale(subject))))


def _written(subject: CratePoint) -> Tokens:
    return row_of(subject, bracketed(_arguments(*of_all(subject))))


def _arguments(struct: str, names: Tokens) -> Tokens:
    if not names:
        return ()
    return f"{struct}:", *(token for name in names for token in (value_name(name), rust_string(name)))


def _has_place(point: Point) -> bool:
    """Return True if the place of a point is more than a single address: a text, an index or a telegram."""
    listed = point.text is not None or point.place.is_scattered
    return listed or point.index is not None or point.telegram is not None


def _has_words(point: Point) -> bool:
    """Return True if the words of the point differ from its raw number."""
    differs = point.words > 1 or point.info.signed or point.swapped or bool(point.coding)
    return point.bits is None and point.text is None and differs


def _references(point: Point) -> Tokens:
    keys = (token for key in point.references for token in (key.upper(), rust_string(key)))
    return bracketed(("at" if point.text is None else "text", *keys))
