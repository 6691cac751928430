"""The view of the conformance program: for each kind of vector a table of points with their calls."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from fieldscribe.families import family
from fieldscribe.patterns import Pattern, blanks, widths
from fieldscribe.targets.rust.conformance_rows import bracketed, rows_of
from fieldscribe.targets.rust.families import END, Table, in_rust, row_text
from fieldscribe.targets.rust.literals import type_name
from fieldscribe.text import rust_string

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from fieldscribe.model import Device
    from fieldscribe.targets.rust.conformance_rows import Spot
    from fieldscribe.targets.rust.families import Tokens
    from fieldscribe.targets.rust.subjects import CratePoint, CrateScope

_ALWAYS = {
    "decode": "decode",
    "encode": "encode",
    "decode_count": "decode_count",
    "decode_plain": "decode_plain",
    "decode_coded": "decode_coded",
    "decode_mixed": "decode_count",
    "encode_count": "encode_count",
    "encode_plain": "encode_plain",
    "encode_coded": "encode_coded",
    "encode_mixed": "encode_count",
    **{name: name for name in ("check", "name", "special", "special_name", "flag", "flag_name", "bits", "words")},
    **{name: name for name in ("address", "symbol")},
}
"""The tables that every program has, with the runner's function."""

_SOMETIMES = (
    *("place", "write_address", "fixed", "display", "told", "text_decode", "text_encode"),
    *("digits", "digits_coded", "digits_encode", "digits_encode_coded"),
)
"""The tables that a program has if they have rows."""

_CHAIN = 60
"""A chain of calls on one line has at most so many characters."""

_STEP = 12
"""Names are laid out as if they were as wide as the next multiple: if their rows fit then, they fit with all."""


Rows = dict["Spot", list[str]]


def conformance_tables(scope: CrateScope, device: Device) -> tuple[Table, ...]:
    """The tables by kind; rows are tokens that the runner's macro reads."""
    rows = _rows(scope)
    parts: dict[str, list[str]] = {}
    for spot in sorted(rows, key=lambda spot: spot.part):
        parts.setdefault(spot.table, []).extend(rows[spot])
    return (
        *(Table(name, run, parts.get(name, ())) for name, run in _ALWAYS.items()),
        *(Table(name, name, parts[name]) for name in _SOMETIMES if name in parts),
        *in_rust(scope.family).tables_of_points(scope),
        *(Table(spot.table, spot.run, rows[spot], spot.kind) for spot in rows if spot.kind),
        *_protocol(device),
    )


def _rows(scope: CrateScope) -> Rows:
    """All rows of all points where they belong."""
    rows: Rows = {}
    plans: dict[object, _Plan] = {}
    kinds: dict[int, object] = {}
    for subject in scope.subjects:
        enum = subject.shape.enum
        words = (subject.item, subject.name, "" if enum is None else type_name(enum.name))
        wide = max(map(len, words)) // _STEP * _STEP + _STEP
        kind = kinds.get(subject.kin) or kinds.setdefault(subject.kin, _kind(subject))
        key = (kind, wide)
        plan = plans.get(key)
        if plan is None:
            plan = plans[key] = _laid_out(subject, [wide * bool(word) for word in words], scope, rows)
        if not plan.fits:
            exact = (kind, *widths(words))
            plan = plans.get(exact) or plans.setdefault(exact, _laid_out(subject, widths(words), scope, rows))
        for appends, text in zip(plan.appends, plan.pattern.filled(words).split(END), strict=True):
            for append in appends:
                append(text)
    return rows


class _Plan(NamedTuple):
    """The different rows of points, where each is appended, and whether each fits in one line."""

    appends: list[list[Callable[[str], None]]]
    pattern: Pattern
    fits: bool


def _kind(subject: CratePoint) -> tuple[object, ...]:
    """All that decides which rows a kin has, and what is in them beside names."""
    point = subject.point
    return (
        subject.shape.alike,
        subject.arguments,
        point.unit.symbol == "",
        point.bits is None,
        point.telegram,
        point.index is None,
        tuple(point.place.references),
        point.write_place is None,
        point.keeps,
        subject.name if subject.name.endswith("_") else None,
    )


def _laid_out(subject: CratePoint, wide: Iterable[int], scope: CrateScope, rows: Rows) -> _Plan:
    """The rows with blanks in place of names; a name that would clash stays as it is."""
    item, name, enum = blanks(" " * width for width in wide)
    name = subject.name if subject.name.endswith("_") else name
    spots: dict[Tokens, list[Spot]] = {}
    for spot, row in rows_of(subject._replace(item=item, name=name), enum, scope):
        spots.setdefault(row, []).append(spot)
    texts = [row_text(row) for row in spots]
    appends = [[rows.setdefault(spot, []).append for spot in alike] for alike in spots.values()]
    return _Plan(appends, Pattern(END.join(texts)), all("\n" not in text for text in texts))


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


def item_row(key: str, module: str, how: str, name: str) -> str:
    """The row of something other than a point: its key in the vectors, and its path in the crate."""
    return row_text((rust_string(key), module, *bracketed((how, name))))


def _code(what: str, module: str, name: str, how: str) -> str:
    return item_row(f"{what} {name}", module, how, name.upper())


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
