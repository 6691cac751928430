"""The table of meanings: a row for each name of a number, flag, number of a flag, and special code."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from fieldscribe.targets.docs.tables import Column, Table, original

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Device, Enum, Flag, Point, Special, Titles
    from fieldscribe.targets.docs.tables import Encode

COLUMNS = (
    Column("of", "whose row it is: what the columns `enum`, `flags` and `codes` of points name"),
    Column("kind", "`enum`, `flag`, `flag value` or `code` (a special code)"),
    Column("bit_low", "the lowest bit of a flag, in the whole word", True),
    Column("bit_high", "its highest bit", True),
    Column("raw_first", "the raw number; of a flag of one bit, the bit while its name is true (0 if inverted)", True),
    Column("raw_last", "the last raw number, where a special code is a band; else the same", True),
    Column("name", "the name in code"),
    Column("title", "the title in English"),
    Column("title_original", "the title in the language of the manual"),
    Column("quantity", "which quantity the number stands for"),
    Column("no_value", "special codes: whether the device has no value then"),
    Column("writable", "special codes: whether the code may be written"),
)
_NAMELESS = ("zero", "one")
"""What numbers of a flag are called whose manual has only a text for them."""


def meanings_table(device: Device) -> Table:
    """The meanings of a device's numbers, in the order of the points."""
    return Table("meanings", COLUMNS, partial(_rows, device))


def enum_of(point: Point) -> Enum | None:
    """The names of the point's numbers, or of its digits."""
    return point.digits.enum if point.digits is not None else point.enum


def codes_of(point: Point) -> str:
    """What the special codes of a point are called: its own, or those that it only shares with others."""
    shared = point.shared_codes
    return f"codes of {shared}" if shared else point.item if point.specials else ""


def _rows(device: Device, encode: Encode) -> Iterator[tuple[str, ...]]:
    told: set[tuple[str, str]] = set()
    for point in device.points:
        if (enum := enum_of(point)) is not None and ("enum", enum.name) not in told:
            told.add(("enum", enum.name))
            yield from _of_enum(enum, encode)
        for flag in point.flags:
            yield from _of_flag(point, flag, encode)
        codes = codes_of(point)
        if codes and ("code", codes) not in told:
            told.add(("code", codes))
            yield from (_of_code(codes, special, encode) for special in point.specials)


def _of_enum(enum: Enum, encode: Encode) -> Iterator[tuple[str, ...]]:
    of = encode(enum.name)
    for entry in enum.entries:
        raw = str(entry.raw)
        called = _called(entry.name, entry.title, encode)
        yield of, "enum", "", "", raw, raw, *called, encode(entry.quantity or ""), "", ""


def _of_flag(point: Point, flag: Flag, encode: Encode) -> Iterator[tuple[str, ...]]:
    low = flag.low + (point.bits[1] if point.bits else 0)
    of, bits = encode(point.item), (str(low), str(low + flag.width - 1))
    active = str(flag.active) if flag.width == 1 else ""
    yield of, "flag", *bits, active, active, *_called(flag.name, flag.title, encode), "", "", ""
    for value in flag.values:
        raw, name = str(value.raw), "" if value.name in _NAMELESS else value.name
        called = _called(name, value.title, encode)
        yield of, "flag value", *bits, raw, raw, *called, encode(value.quantity or ""), "", ""


def _of_code(of: str, special: Special, encode: Encode) -> tuple[str, ...]:
    called = _called(special.name, special.title, encode)
    answers = "yes" if special.no_value else "no", "yes" if special.writable else "no"
    return encode(of), "code", "", "", str(special.low), str(special.high), *called, "", *answers


def _called(name: str, title: Titles, encode: Encode) -> tuple[str, str, str]:
    return encode(name), encode(title["en"]), encode(original(title))
