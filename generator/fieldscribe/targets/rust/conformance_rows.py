"""The rows of one point in the tables of the conformance program."""

from collections.abc import Iterator
from typing import NamedTuple

from fieldscribe.model import Point, Text
from fieldscribe.targets.rust.enums import getter_name
from fieldscribe.targets.rust.families import Needs, Tokens, Way, in_rust
from fieldscribe.targets.rust.literals import value_name
from fieldscribe.targets.rust.subjects import CratePoint, CrateScope
from fieldscribe.text import rust_string


class Spot(NamedTuple):
    """Where a row belongs: the kind of the vectors, and the function of the runner that answers them."""

    kind: str
    run: str

    @property
    def name(self) -> str:
        """The name of the table."""
        return f"{self.kind}_by_{self.run}" if self.kind in ("read", "write", "store") else self.run


Row = tuple[Spot, "Tokens"]


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
    point = subject.point
    if point.bits:
        return update, ()
    if not (point.readable and point.encodes_values):
        return f"{change}_only", ()
    text = point.form == "text"
    return f"{change}{'_text' if text else ''}", () if text else (of_scale(subject), of_all(subject))


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
