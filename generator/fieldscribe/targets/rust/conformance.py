"""The view of the conformance program: for each kind of vector a table of points with their calls."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.families import family
from fieldscribe.targets.rust.families import Table, in_rust
from fieldscribe.targets.rust.literals import type_name, value_name
from fieldscribe.targets.rust.words import getter_name
from fieldscribe.text import rust_string

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from fieldscribe.model import Device, Point
    from fieldscribe.targets.rust.families import Needs, Tokens, Way
    from fieldscribe.targets.rust.subjects import CratePoint, CrateScope

_CHAIN = 60
"""A chain of calls on one line has at most so many characters."""


def conformance_tables(scope: CrateScope, device: Device) -> tuple[Table, ...]:
    """The tables by kind; rows are tokens that the runner's macro reads."""
    scaled = [subject for subject in scope.subjects if subject.form == "scaled"]
    floats = [subject for subject in scope.subjects if subject.form == "float"]
    texts = [subject for subject in scope.subjects if subject.form == "text"]
    digits = [subject for subject in scope.subjects if subject.form == "digits"]
    whole = [subject for subject in scope.subjects if subject.form not in ("scaled", "float", "text", "digits")]
    plain = [subject for subject in whole if subject.carried == subject.raw and not subject.point.specials]
    coded = [subject for subject in whole if subject.carried == subject.raw and subject.point.specials]
    mixed = [subject for subject in whole if subject.carried != subject.raw]
    counted = [subject for subject in scaled if subject.point.decimals is not None]
    encoding = [subject for subject in scaled if subject.point.encodes_values]
    read_scaled, write_scaled = tuple(_reads(scaled)), tuple(_writes(scaled))
    write_plain, write_coded, write_mixed = tuple(_writes(plain)), tuple(_writes(coded)), tuple(_writes(mixed))
    alone = ("(alone)",)
    return (
        Table("decode", "decode", (*read_scaled, *_reads(floats))),
        Table("encode", "encode", (*_writes(encoding), *_writes(floats))),
        Table("decode_count", "decode_count", tuple(_reads(counted))),
        Table("decode_plain", "decode_plain", tuple(_reads(plain))),
        Table("decode_coded", "decode_coded", tuple(_reads(coded))),
        Table("decode_mixed", "decode_count", tuple(_reads(mixed))),
        Table("encode_count", "encode_count", tuple(_writes(counted))),
        Table("encode_plain", "encode_plain", write_plain),
        Table("encode_coded", "encode_coded", write_coded),
        Table("encode_mixed", "encode_count", write_mixed),
        Table(
            "check",
            "check",
            (*write_scaled, *write_plain, *write_coded, *write_mixed, *_writes(floats), *_writes(digits)),
        ),
        Table("name", "name", tuple(_names((*whole, *digits)))),
        Table(
            "special", "special", tuple(row_of(subject, alone) for subject in scope.subjects if subject.point.specials)
        ),
        Table(
            "special_name",
            "special_name",
            tuple(row_of(subject, alone) for subject in scope.subjects if subject.point.specials),
        ),
        Table("flag", "flag", tuple(_flags(whole))),
        Table("flag_name", "flag_name", tuple(_flag_names(whole))),
        Table("bits", "bits", tuple(row_of(subject, alone) for subject in scope.subjects if subject.point.bits)),
        Table(
            "words", "words", tuple(row_of(subject, alone) for subject in scope.subjects if _has_words(subject.point))
        ),
        Table("address", "address", tuple(row_of(subject, _references(subject.point)) for subject in scope.subjects)),
        Table(
            "symbol", "symbol", tuple(row_of(subject, alone) for subject in scope.subjects if subject.point.unit.symbol)
        ),
        *_newer(scope, texts, digits),
        *_protocol(device),
    )


def _protocol(device: Device) -> Iterator[Table]:
    """The tables of the numbers of the protocol, and of commands."""
    family_part = in_rust(device.family)
    constants, named = [], []
    for codes in family(device.family).codes:
        for code in device.bus.codes(codes.section) if codes.emitted else ():
            if codes.section == "exceptions":
                named.append(_code(codes.kind, "exceptions", code.name, "named"))
            else:
                constants.append(_code(codes.kind, f"{codes.kind}s", code.name, "code"))
    for kind, rows in (("constant", constants), (family_part.refusals, named)):
        if rows:
            yield Table(kind, "code", tuple(rows))
    yield from family_part.tables_of_frames(device)
    places = [point for point in device.points if point.raw_only and point.address is not None]
    if places:
        documented = (item_row(point.item, "points", "documented", point.item.upper()) for point in places)
        yield Table("documented", "documented", tuple(documented))
    if device.commands:
        sent = (item_row(command.name, "commands", "sent", command.name.upper()) for command in device.commands)
        yield Table("command", "command", tuple(sent))


def item_row(key: str, module: str, how: str, name: str) -> Tokens:
    """The row of something other than a point: its key in the vectors, and its path in the crate."""
    return rust_string(key), module, *_bracketed((how, name))


def _code(what: str, module: str, name: str, how: str) -> Tokens:
    return item_row(f"{what} {name}", module, how, name.upper())


def _bracketed(tokens: Tokens) -> Tokens:
    if not tokens:
        return ("()",)
    first, *others = tokens
    return (f"({first})",) if not others else (f"({first}", *others[:-1], f"{others[-1]})")


def _newer(scope: CrateScope, texts: list[CratePoint], digits: list[CratePoint]) -> Iterator[Table]:
    """The tables of the kinds for places, fixed bits, texts and digits, and for exchanges."""
    placed = (subject for subject in scope.subjects if _has_place(subject.point))
    elsewhere = (subject for subject in scope.subjects if subject.point.write_place is not None)
    fixed = (subject for subject in scope.subjects if subject.point.fixed is not None)
    shown = [subject for subject in scope.subjects if subject.point.display is not None]
    alone = ("(alone)",)
    for kind, rows in (
        ("place", tuple(row_of(subject, alone) for subject in placed)),
        ("write_address", tuple(row_of(subject, alone) for subject in elsewhere)),
        ("fixed", tuple(row_of(subject, alone) for subject in fixed)),
        ("display", tuple(row_of(subject, alone) for subject in shown)),
        ("told", tuple(row_of(subject, _bracketed(_arguments(*of_scale(subject)))) for subject in shown)),
        ("text_decode", tuple(row_of(subject, _sizes(subject.point)) for subject in texts if subject.point.readable)),
        ("text_encode", tuple(row_of(subject, _sizes(subject.point)) for subject in texts if subject.point.writable)),
        ("digits", tuple(_digits(digits, "r", coded=False))),
        ("digits_coded", tuple(_digits(digits, "r", coded=True))),
        ("digits_encode", tuple(_digits(digits, "w", coded=False))),
        ("digits_encode_coded", tuple(_digits(digits, "w", coded=True))),
    ):
        if rows:
            yield Table(kind, kind, rows)
    yield from in_rust(scope.family).tables_of_points(scope)
    ways: dict[tuple[str, str], list[Tokens]] = {}
    for kind, run, row in _exchanges(scope):
        ways.setdefault((kind, run), []).append(row)
    for (kind, run), rows_of_way in ways.items():
        yield Table(f"{kind}_by_{run}", run, tuple(rows_of_way), kind)


def _exchanges(scope: CrateScope) -> Iterator[tuple[str, str, Tokens]]:
    """The kind, the runner's function and the row for each way in which each point is read or written."""
    for subject in scope.subjects:
        if not subject.point.addresses:
            continue
        for kind, run, needs in _ways(subject, scope):
            arguments = [token for pair in needs for token in _bracketed(_arguments(*pair))]
            yield kind, run, row_of(subject, _bracketed(("wire", *arguments)))


def _ways(subject: CratePoint, scope: CrateScope) -> Iterator[Way]:
    """The ways to read and write a point: by requests if it has an address, and further ones of its family."""
    point = subject.point
    text = "_text" if subject.form == "text" else ""
    if point.telegram is None and point.readable:
        yield "read", f"read{text}", ()
    if point.telegram is None and point.writable:
        yield "write", *change_of(subject, "write", "update")
    yield from in_rust(scope.family).ways(subject, scope)


def change_of(subject: CratePoint, change: str, update: str) -> tuple[str, Needs]:
    """The function that writes a point, and the structs that it needs."""
    point = subject.point
    if point.bits:
        return update, ()
    if not (point.readable and point.encodes_values):
        return f"{change}_only", ()
    text = subject.form == "text"
    return f"{change}{'_text' if text else ''}", () if text else (of_scale(subject), of_all(subject))


def of_scale(subject: CratePoint) -> tuple[str, tuple[str, ...]]:
    """The struct of the raw numbers that the scale needs, with its fields."""
    return subject.factors_struct, subject.factors


def of_all(subject: CratePoint) -> tuple[str, tuple[str, ...]]:
    """The struct of all raw numbers that writing needs, with its fields."""
    return subject.name, subject.arguments


def arms(tables: Iterable[Table]) -> Iterator[str]:
    """The match arms that choose the table for vectors of whole exchanges, laid out as by rustfmt."""
    answering: dict[str, list[str]] = {}
    for table in tables:
        answering.setdefault(table.kind, []).append(f"{table.name}(vector)")
    for kind in ("read", "write", "store"):
        calls = answering.get(kind, [])
        chain = [*calls[:1], *(f".or_else(|| {call})" for call in calls[1:])]
        if len(chain) == 2 or len("".join(chain)) <= _CHAIN:
            lines = ["".join(chain)] if chain else []
        else:
            lines = [chain[0], *(f"    {link}" for link in chain[1:])]
        if lines:
            whole = [f'"{kind}" => {lines[0]}', *lines[1:]]
            yield from whole[:-1]
            yield f"{whole[-1]},"


def row_of(subject: CratePoint, how: Tokens) -> Tokens:
    """The row of a point: its name in the vectors, its path in the crate, and further tokens."""
    return rust_string(subject.point.item), subject.name, *how


def _sizes(point: Point) -> Tokens:
    return _bracketed(("sizes", str(point.text.characters if point.text is not None else 0), str(point.words)))


def _digits(subjects: Iterable[CratePoint], access: str, *, coded: bool) -> Iterator[Tokens]:
    for subject in subjects:
        if access in subject.point.access and bool(subject.point.specials) == coded:
            yield row_of(subject, _counted(subject))


def _counted(subject: CratePoint) -> Tokens:
    digits = subject.point.digits
    return _bracketed(("digits", str(digits.count if digits is not None else 0), subject.carried))


def _has_place(point: Point) -> bool:
    """Whether a single address does not say where the point is: a text, an index or a telegram."""
    return point.text is not None or point.index is not None or point.telegram is not None


def _has_words(point: Point) -> bool:
    """Whether the words of the point differ from its raw number."""
    return point.bits is None and point.text is None and (point.words > 1 or point.info.signed)


def _references(point: Point) -> Tokens:
    keys = (token for key in point.references for token in (key.upper(), rust_string(key)))
    return _bracketed(("at" if point.text is None else "text", *keys))


def _reads(subjects: Iterable[CratePoint]) -> Iterator[Tokens]:
    for subject in subjects:
        if "r" in subject.point.access:
            yield row_of(subject, _bracketed(_arguments(*of_scale(subject))))


def _writes(subjects: Iterable[CratePoint]) -> Iterator[Tokens]:
    for subject in subjects:
        if "w" in subject.point.access:
            yield row_of(subject, _bracketed(_arguments(*of_all(subject))))


def _arguments(struct: str, names: Tokens) -> Tokens:
    if not names:
        return ()
    return f"{struct}:", *(token for name in names for token in (value_name(name), rust_string(name)))


def _names(subjects: Iterable[CratePoint]) -> Iterator[Tokens]:
    for subject in subjects:
        if subject.enum is not None:
            yield rust_string(subject.point.item), type_name(subject.enum.name), *_bracketed(("enum", subject.carried))


def _flags(subjects: Iterable[CratePoint]) -> Iterator[Tokens]:
    for subject in subjects:
        if subject.form == "flags":
            for flag in subject.point.flags:
                calls = _bracketed(("flag", subject.raw, getter_name(flag.name), f"with_{flag.name}"))
                yield rust_string(f"{subject.point.item} {flag.name}"), subject.name, *calls


def _flag_names(subjects: Iterable[CratePoint]) -> Iterator[Tokens]:
    for subject in subjects:
        for flag in subject.point.flags:
            for entry in flag.values if flag.width > 1 else ():
                key = rust_string(f"{subject.point.item} {flag.name} {entry.name}")
                yield key, subject.name, *_bracketed(("value", f"{flag.name.upper()}_{entry.name.upper()}"))
