"""The tables for spreadsheets: the same columns for every device, numbers as numbers, texts that nothing runs."""

from __future__ import annotations

import csv
import io
import json
import re
from dataclasses import replace
from fractions import Fraction
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.model import Device, Fixed, Flag, Place, Point, Source, Special, Text
from fieldscribe.targets.docs import csv_files, sheet, tables, xlsx_files
from fieldscribe.targets.docs.cells import scope_of
from fieldscribe.targets.docs.tables import no_number
from openpyxl import load_workbook
from openpyxl.worksheet.worksheet import Worksheet
from support.described import SHIPPED, shipped
from support.models import HERTZ, allowed, entry, point, sample_device, scaled, titles, units

ROWS: dict[str, dict[str, str]] = json.loads(Path(__file__).with_name("sample_rows.json").read_text("utf-8"))
"""Rows of the sample, as they are written by hand."""

NUMBER = re.compile(r"-?[0-9]+(\.[0-9]+)?")
KINDS = {
    kind: {column.name: column.is_number for column in columns}
    for kind, columns in (("", sheet.COLUMNS), ("_meanings", tables.MEANINGS))
}


def rows_of(device: Device, kind: str = "") -> list[dict[str, str]]:
    """The rows of a table."""
    text = dict(csv_files(scope_of(device)))[f"{device.id}{kind}.csv"]
    assert text.startswith("\ufeff")
    return list(csv.DictReader(io.StringIO(text[1:], newline="")))


@cache
def rows_of_sample() -> dict[str, dict[str, str]]:
    return {row["name"]: row for row in rows_of(sample_device())}


def row_of(made: Point) -> dict[str, str]:
    return rows_of(sample_device((made,)))[0]


def workbook(device: Device) -> Any:
    [(name, contents)] = xlsx_files(scope_of(device))
    assert name == f"{device.id}.xlsx"
    return load_workbook(io.BytesIO(contents))


def cells(table: Worksheet) -> list[dict[str, Any]]:
    head, *rows = table.iter_rows(values_only=True)
    return [dict(zip(map(str, head), row, strict=True)) for row in rows]


@pytest.mark.full(seconds=2)
@pytest.mark.parametrize("kind", KINDS)
def test_columns_are_the_same_and_none_is_always_empty(kind: str) -> None:
    filled: set[str] = set()
    for name in SHIPPED:
        rows = rows_of(shipped(name), kind)
        assert list(rows[0])[: len(KINDS[kind])] == list(KINDS[kind])  # behind them, what is filled alone
        filled |= {column for row in rows for column, cell in row.items() if cell}
        for row in rows:
            assert [row[column] for column, number in KINDS[kind].items() if number and not _fits(row[column])] == []
    assert filled >= set(KINDS[kind])


def _fits(cell: str) -> bool:
    return not cell or NUMBER.fullmatch(cell) is not None


@pytest.mark.parametrize("name", ROWS)
def test_a_row(name: str) -> None:
    """Of a point and of a command."""
    row = rows_of_sample()[name]
    assert {key: row[key] for key in ROWS[name]} == ROWS[name]


@pytest.mark.parametrize(
    ("name", "facts"),
    [
        ("temperature", ("0.1", "-0.25", "")),
        ("frequency_fine", ("0.00390625", "0", "")),
        ("pulse", ("2", "0", "")),
        ("inverse", ("-0.1", "0", "")),
        ("third", ("", "", "raw x 7 / 3")),
        ("power", ("", "", "raw x 10^power_exponent.raw W")),
        ("signed_one", ("1", "0", "")),
        ("float_setpoint", ("1", "0", "")),
        ("frequency_source", ("", "", "")),
        ("status_word", ("", "", "")),
        ("setpoint", ("", "", "raw / 16384 x reference_frequency.raw Hz when unit_mode.raw is 0; raw x 0.01 Hz when ")),
        ("baud_rate", ("", "", "")),
    ],
)
def test_a_scale(name: str, facts: tuple[str, str, str]) -> None:
    row = rows_of_sample()[name]
    assert (row["factor"], row["offset"], row["scale"][: len(facts[2]) or None]) == facts


@pytest.mark.parametrize(
    ("name", "ends", "text"),
    [
        ("inverse", ("-100", "50", "-5", "10"), ""),
        ("power_factor", ("-99", "100", "-0.99", "1"), "only -0.99..-0.7 or 0.7..1"),
        ("frequency_source", ("0", "10", "", ""), "only raw 0, 1, 10"),
        ("third", ("0", "30000", "0", "70000"), ""),
        ("float_setpoint", ("", "", "0", "650"), ""),
        ("double_actual", ("", "", "", ""), ""),
        ("upper_limit", ("1", "4000", "0.1", "400"), "only lower_limit..400 Hz; while lower_limit.raw is 0: from 0"),
        ("voltage_setpoint", ("0", "65535", "", ""), ""),
        ("dc_level_400v", ("660", "780", "660", "780"), ""),
    ],
)
def test_limits(name: str, ends: tuple[str, ...], text: str) -> None:
    row = rows_of_sample()[name]
    assert (tuple(row[key] for key in ("raw_min", "raw_max", "min", "max")), row["range"]) == (ends, text)


SCALED: dict[str, Any] = {"scale": scaled("3/7"), "decimals": 1, "unit": HERTZ}
POINTS: list[tuple[Point, dict[str, str]]] = [
    (point("p", 7, allowed=allowed((0, 100)), **SCALED), {"max": "", "range": "only 0..700/3 Hz"}),
    (point("p", 7, "f32", allowed=units("1/3", 2)), {"min": "", "max": "2", "range": "only 1/3..2"}),
    (point("p", 7, default=Fraction(1, 3)), {"default": "", "remarks": "default 1/3"}),
    (
        point("p", 7, flags=tuple(Flag(8 * at, 8, name, titles(name), 1, ()) for at, name in enumerate(("bit", "of")))),
        {"remarks": ""},
    ),
    (
        point(
            "p",
            7,
            default_raw=0x3402,
            flags=(Flag(0, 8, "bit", titles("B"), 1, ()), Flag(8, 8, "of", titles("O"), 1, ())),
        ),
        {"default_raw": "13314", "remarks": "default: of 52, bit 2"},
    ),
    (point("p", 7, default_raw=1, flags=(Flag(0, 1, "on", titles("On"), 1, ()),)), {"remarks": ""}),
    (point("p", 7, default_raw=7), {"default": "", "default_raw": "7", "remarks": ""}),
    (point("p", 7, default_raw=7, default=Fraction(7, 10)), {"default": "0.7", "default_raw": "7"}),
    (point("p", 7, "u32"), {"address": "7", "words": "2", "word_order": "high word first"}),
    (point("p", 7, "u32", order=(8, 7)), {"address": "7", "word_order": "low word first"}),
    (point("p", 7, "u32", order=(9, 7)), {"word_order": "0009h 0007h, high word first"}),
    (
        point("p", 7, "text", text=Text(4, "ascii"), order=(8, 7)),
        {"word_order": "last characters first", "remarks": "text, 4 characters, ascii", "raw_max": "", "factor": ""},
    ),
    (
        point("p", 7, "u8", bits=(13, 6), fixed=Fixed(0x18, 0x10)),
        {
            "bit_low": "6",
            "bit_high": "13",
            "shared": "yes",
            "mask": str(0x3FC0),
            "fixed_mask": "24",
            "fixed_bits": "16",
            "remarks": "shares its word: read it, change bits 13..6, write it back; bits 4..3 always 10",
        },
    ),
    (point("p", 7, "u8", bits=(13, 6), access="r"), {"shared": "", "mask": str(0x3FC0), "remarks": ""}),
    (point("p", 7, "bit", bits=(3, 3), telegram="t"), {"shared": "", "mask": "8"}),
    (
        point("p", 7, "bit", bits=(3, 3), access="w"),
        {"remarks": "shares its word, which cannot be read: bit 3 is written together with all others"},
    ),
    (point("p", 7, place=Place((7,), {})), {"modicon": "8", "reference": "400008", "computed": "modicon reference"}),
    (
        point("p", 7, "bit", space="coil", place=Place((7,), {})),
        {"modicon": "8", "reference": "", "computed": "modicon"},
    ),
    (
        point("p", 7, default_raw=0, allowed=allowed((0, 9)), specials=(Special(0, 1, "off", titles("Off"), False),)),
        {"raw_min": "2", "raw_max": "9", "default_raw": "0", "codes": "p"},
    ),
    (point("p", 7, "bit", specials=(Special(0, 1, "off", titles("Off"), False),)), {"raw_min": "", "raw_max": ""}),
    (point("p", None), {"address": "", "address_hex": "", "generated": "no"}),
    (point("p", 7, write_place=Place((0x20,), {})), {"remarks": "written at 0020h (32)"}),
    (point("p", 7, fixed=Fixed(0xC0, 0x80), since="1.10"), {"remarks": "bits 7..6 always 10; since 1.10"}),
    (point("p", 7, keeps="choice"), {"keeps": "by the task"}),
    (point("p", 7, changes_with=("q",)), {"remarks": "read it again after writing q"}),
    (point("p", 7, place=Place((7,), {"modicon": 8, "nr": 9})), {"modicon": "8", "other_references": "nr 9"}),
    (point("p", 7, place=Place((7,), {"modicon": "8a"})), {"modicon": "", "other_references": "modicon 8a"}),
    (point("p", 7, source=Source("m", "4.10", "7-25", 3)), {"section": "section 4.10", "page": "page 7-25"}),
    (point("p", 7, source=Source("m", "4.10 a", "iv", None)), {"section": "4.10 a", "page": "iv", "line": ""}),
    (point("p", 7, source=Source("m", None, "25", None)), {"section": "", "page": "25"}),
    (point("p", 7, generated=False, unit=HERTZ), {"factor": "", "min": "", "raw_max": "65535"}),
]


def test_names_are_unique() -> None:
    rows = rows_of(sample_device())
    assert len({(row["kind"], row["name"]) for row in rows}) == len(rows)


@pytest.mark.parametrize(("made", "facts"), POINTS)
def test_a_point(made: Point, facts: dict[str, str]) -> None:
    row = row_of(made)
    assert {key: row[key] for key in facts} == facts


def test_meanings() -> None:
    shared = Special(0xFFF0, 0xFFFF, "reserved", titles("Reserved"), True, shared=True)
    own = Special(0, 0, "off", titles("Off", "Aus"), False, writable=True)
    word = Flag(0, 1, "fault", titles("Fault"), 0, (entry(0, "zero", "a fault"), entry(1, "fine", "none")))
    device = sample_device(
        (
            *(named for named in sample_device().points if named.name in ("frequency_source", "analog_filter")),
            point("source_2", 20, enum=next(enum for enum in sample_device().enums if enum.name == "frequency_source")),
            point("state", 21, "u8", bits=(15, 8), flags=(word, Flag(4, 2, "mode", titles("Mode"), 1, ()))),
            point("first", 22, specials=(shared,), specials_of="u16"),
            point("second", 23, specials=(shared,), specials_of="u16"),
            point("both", 24, specials=(own, shared), specials_of="u16"),
        )
    )
    keys = [(row["enum"], row["flags"], row["codes"]) for row in rows_of(device) if row["kind"] == "point"]
    assert keys == [
        *[(name, "", "") for name in ("frequency_source", "filter_mode", "frequency_source")],
        ("", "state", ""),
        *[("", "", codes) for codes in ("codes of u16", "codes of u16", "both")],
    ]
    assert [",".join(row.values()) for row in rows_of(device, "_meanings")] == [
        "frequency_source,enum,,,0,0,keypad,Keypad,Bedienfeld,,,",
        "frequency_source,enum,,,1,1,terminal,terminal,,,,",
        "frequency_source,enum,,,10,10,logic,logic,,,,",
        "filter_mode,enum,,,17,17,dead_band,16 samples, dead band,,500 ms,,",
        "state,flag,8,8,0,0,fault,Fault,,,,",
        "state,flag value,8,8,0,0,,a fault,,,,",
        "state,flag value,8,8,1,1,fine,none,,,,",
        "state,flag,12,13,,,mode,Mode,,,,",
        "codes of u16,code,,,65520,65535,reserved,Reserved,,,yes,no",
        "both,code,,,0,0,off,Off,Aus,,no,yes",
        "both,code,,,65520,65535,reserved,Reserved,,,yes,no",
    ]


@pytest.mark.parametrize(
    ("text", "shown"),
    [("", ""), ("4.10", "x 4.10"), ("7-25", "x 7-25"), ("1/2", "x 1/2"), ("1E5", "x 1E5"), ("Gruppe 1", "Gruppe 1")],
)
def test_what_looks_like_a_number_gets_a_word(text: str, shown: str) -> None:
    assert no_number("x", text) == shown


HOSTILE = "=cmd()|'x'\r\nnew"


def _hostile() -> Device:
    bad = titles(HOSTILE, HOSTILE)
    special = Special(9, 9, "odd", bad, False)
    made = point("bad", 1, title=bad, note=bad, code="@x", specials=(special,), conditions=("+1+2", "b"))
    return sample_device(
        (made, point("a_x1_x5_x0041_b", 4), point("wide", 2, "u64"), point("low", 3, "s16", allowed=allowed((-5, 5))))
    )


def test_nothing_is_run() -> None:
    """A formula is text; a number has no apostrophe."""
    bad, _, _, low, _ = rows_of(_hostile())
    assert (bad["title"], bad["code"], bad["conditions"]) == ("'=cmd()|'x' new", "'@x", "'+1+2; b")
    assert (bad["section"], bad["line"]) == ("Gruppe A", "780")
    assert (low["raw_min"], low["min"]) == ("-5", "-5")
    assert rows_of(_hostile(), "_meanings")[0]["title"] == "'=cmd()|'x' new"


def test_a_workbook_is_typed() -> None:
    device = sample_device()
    book = workbook(device)
    assert book.sheetnames == ["points", "meanings", "errata", "columns"]
    points = cells(book["points"])
    assert [row["name"] for row in points] == [row["name"] for row in rows_of(device)]
    base = next(row for row in points if row["name"] == "base_frequency")
    typed = {
        "address": 4136,
        "factor": 0.1,
        "max": 400,
        "default": 50,
        "line": 780,
        "page": None,
        "section": "Gruppe A",
    }
    assert {key: base[key] for key in typed} == typed
    assert [row["id"] for row in cells(book["errata"])] == [erratum.id for erratum in device.errata]
    assert {row["column"] for row in cells(book["columns"]) if row["sheet"] == "points"} == set(points[0])
    for table, frozen in (("points", "C2"), ("meanings", "B2"), ("errata", "B2")):
        assert book[table].freeze_panes == frozen
        assert book[table].auto_filter.ref == book[table].dimensions
        page = book[table].page_setup
        assert (page.orientation, page.fitToHeight, book[table].print_title_rows) == ("landscape", 0, "$1:$1")
        assert all(5 < width.width < 51 for width in book[table].column_dimensions.values())
    assert all(isinstance(row["address"], int) for row in points if row["address"] is not None)


def test_a_workbook_has_no_formula_and_no_rounded_number() -> None:
    table = workbook(_hostile())["points"]
    assert {cell.data_type for row in table.iter_rows() for cell in row} <= {"s", "n"}
    bad, escape, wide, low, _ = cells(table)
    assert escape["name"] == "a_x1_x5_x0041_b"
    assert (bad["title"], bad["code"]) == ("=cmd()|'x' new", "@x")
    assert (wide["raw_max"], low["raw_min"]) == ("18446744073709551615", -5)


@pytest.mark.parametrize(("why", "is_broken"), [("word," * 20, True), ("short", None)])
def test_long_texts_are_broken(why: str, is_broken: bool | None) -> None:
    device = sample_device((point("speed", 1),))
    errata = workbook(replace(device, errata=(replace(device.errata[0], why=why),)))["errata"]
    assert errata.cell(2, 6).value == why
    assert (errata.cell(2, 6).alignment.wrap_text, errata.cell(2, 6).alignment.vertical) == (is_broken, "top")


def test_a_workbook_has_the_same_bytes_each_time() -> None:
    device = replace(sample_device((point("speed", 1),)), errata=())
    first, second = (dict(xlsx_files(scope_of(device))) for _ in range(2))
    assert first == second
    assert workbook(device)["errata"].max_row == 1
