"""The view of the conformance program: for each kind of vector a table of points with their calls."""

from collections.abc import Hashable, Iterable, Iterator
from functools import partial

from fieldscribe.families import family
from fieldscribe.grouping import grouped
from fieldscribe.model import Device
from fieldscribe.targets.placeholders import TextTemplates, placeholders
from fieldscribe.targets.rust.conformance_rows import Spot, bracketed, rows_of
from fieldscribe.targets.rust.families import END, Table, Tokens, in_rust, row_text
from fieldscribe.targets.rust.layout import Lines
from fieldscribe.targets.rust.literals import type_name
from fieldscribe.targets.rust.subjects import CratePoint, CrateScope
from fieldscribe.text import rust_string, upper

_CHAIN = 60
"""A chain of calls on one line has at most this many characters."""

Rows = dict["Spot", list[str]]


def conformance_tables(scope: CrateScope, device: Device) -> tuple[Table, ...]:
    """Return the tables in the order of their first points; rows are tokens that the runner's macro reads."""
    return *(Table(spot.name, spot.run, rows, spot.kind) for spot, rows in _rows(scope).items()), *_protocol(device)


def _rows(scope: CrateScope) -> Rows:
    """Return all rows of all points, each in its table."""
    rows: Rows = {}
    tables_of: dict[Hashable, dict[Tokens, list[list[str]]]] = {}
    texts = TextTemplates()
    for subject in scope.subjects:
        enum = subject.enum
        fields = (subject.item, subject.name, "" if enum is None else type_name(enum.name))
        key = subject.key, *map(len, fields)
        tables = tables_of.get(key)
        if tables is None:
            tables = tables_of[key] = _tables_by_row(subject, fields, scope, rows)
        text = texts.fill(key, fields, partial(_text_of, tables))
        for row, tables_of_row in zip(text.split(END), tables.values(), strict=True):
            for table in tables_of_row:
                table.append(row)
    return rows


def _tables_by_row(
    subject: CratePoint, fields: Iterable[str], scope: CrateScope, rows: Rows
) -> dict[Tokens, list[list[str]]]:
    """Return the different rows of a point, with placeholders, and the tables of `rows` to which each belongs."""
    item, name, enum = placeholders(fields)
    tables: dict[Tokens, list[list[str]]] = {}
    for spot, row in rows_of(subject.renamed(item, name), enum, scope):
        tables.setdefault(row, []).append(rows.setdefault(spot, []))
    return tables


def _text_of(rows: Iterable[Tokens]) -> str:
    return END.join(map(row_text, rows))


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


def arms(tables: Iterable[Table]) -> Iterator[tuple[str, Lines]]:
    """Yield each kind of vectors with the chain of tables that answer it, in lines as rustfmt lays them out."""
    for kind, calls in grouped((table.kind, f"{table.name}(vector)") for table in tables).items():
        chain = [calls[0], *(f".or_else(|| {call})" for call in calls[1:])]
        on_one_line = len(chain) <= 2 or len("".join(chain)) <= _CHAIN
        yield kind, ("".join(chain),) if on_one_line else (chain[0], *(f"    {link}" for link in chain[1:]))
