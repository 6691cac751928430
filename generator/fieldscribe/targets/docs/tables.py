"""Tables for spreadsheets and programs, as CSV and as a workbook (XLSX); the table of meanings and the table of errata.

A workbook has typed cells, frozen heads, filters, and no date in its bytes.
"""

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from datetime import datetime
from io import BytesIO
from typing import Any, NamedTuple, TypeAlias

import fieldscribe
from fieldscribe.grouping import grouped
from fieldscribe.model import Device, Enum, Flag, Point, Source, Special, Titles
from fieldscribe.targets.identifiers import command
from fieldscribe.text import csv_cell, line
from fieldscribe.wording import title_text

Encode: TypeAlias = Callable[[str], str]
"""Turns a text of a description into a cell; numbers do not need it."""
_MARK = "\ufeff"
"""The mark by which spreadsheets recognise UTF-8; without it `°C` and umlauts are garbled."""
_LIKE_A_NUMBER = re.compile(r"[-+0-9.,:/ eE]+")
_WHOLE = re.compile(r"0|[1-9][0-9]*")
_NUMBER = re.compile(r"-?[0-9]+(\.[0-9]+)?")
_ESCAPE = re.compile(r"(?<=_)(?=x[0-9A-Fa-f]{1,4}_)")
"""Matches a text that LibreOffice and others would read as an escaped character (`_x1_`)."""
_MOST = 1 << 53
"""Workbooks store floating point; greater whole numbers are written as text to stay exact."""
_NARROW, _WIDE = 6, 48
_FORMATS: Mapping[str, Mapping[str, object]] = {
    "head": {"bold": True, "bottom": 1},
    "plain": {},
    "short": {"valign": "top"},
    "long": {"valign": "top", "text_wrap": True},
}
"""The formats of cells; `long` is for columns with texts that are wider than the column."""
_STAYS = {"points": 2}
"""How many columns on the left stay visible when a sheet is scrolled."""
_WHEN = datetime(2000, 1, 1)  # the format needs a date, and the bytes must not depend on today's


class Column(NamedTuple):
    """A column: its name, what its cells mean, and whether they are numbers."""

    name: str
    meaning: str
    is_number: bool = False


class Table(NamedTuple):
    """A table: its name, its columns, and a function that returns rows of finished cells."""

    name: str
    columns: tuple[Column, ...]
    rows: Callable[[Encode], Iterable[Sequence[str]]]


def csv_of(table: Table) -> str:
    """Return the table as CSV, its head first."""
    lines = [",".join([column.name for column in table.columns])]
    lines += [",".join(row) for row in table.rows(csv_cell)]
    return _MARK + "\n".join(lines) + "\n"


def original(titles: Titles) -> str:
    """Return a title in the languages of the manual: all but English."""
    if len(titles) == 1:
        return ""
    return " / ".join(dict.fromkeys([text for language, text in titles.items() if language != "en"]))


def source_cells(source: Source, encode: Encode) -> Iterator[str]:
    """Yield the cells of a place in the manual: document, section, page, line."""
    yield encode(source.document)
    yield encode(no_number("section", source.section or ""))
    page = source.page or ""
    yield page if _WHOLE.fullmatch(page) else encode(no_number("page", page))
    yield "" if source.line is None else str(source.line)


def no_number(what: str, text: str) -> str:
    """Return a text; one that looks like a number or a date (section 4.10, page 7-25) gets a word in front."""
    return f"{what} {text}" if _LIKE_A_NUMBER.fullmatch(text) else text


def decimal(text: str) -> str:
    """Return an exact decimal; empty for a fraction whose decimals never end."""
    return "" if "/" in text else text


# Meanings and errata.


MEANINGS = (
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
"""The names of the numbers of a flag if the manual has only texts for them."""


def codes_of(point: Point) -> str:
    """Return the name of a point's special codes in the table of meanings; empty if it has none."""
    shared = point.shared_codes
    return f"codes of {shared}" if shared else point.item if point.specials else ""


def meaning_rows(device: Device, encode: Encode) -> Iterator[tuple[str, ...]]:
    """Yield the rows of the meanings of numbers, in the order of the points."""
    listed: set[tuple[str, str]] = set()
    for point in device.points:
        if (enum := point.named_numbers) is not None and ("enum", enum.name) not in listed:
            listed.add(("enum", enum.name))
            yield from _of_enum(enum, encode)
        for flag in point.flags:
            yield from _of_flag(point, flag, encode)
        codes = codes_of(point)
        if codes and ("code", codes) not in listed:
            listed.add(("code", codes))
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


ERRATA = (
    Column("id", "the id, which the column `errata` of points names"),
    Column("points", "the points that it is about"),
    Column("where", "what else it is about"),
    Column("printed", "what the manual prints"),
    Column("taken", "what was taken"),
    Column("why", "why"),
    Column("certainty", "how sure that is: `certain`, `likely`, `unknown`"),
    Column("leaves_open", "what the manual leaves open"),
    Column("document", "the manual"),
    Column("section", "the section of the manual"),
    Column("page", "the page", True),
    Column("line", "the line of the manual's text", True),
)


def items_of(device: Device) -> Mapping[str, list[str]]:
    """Return the names in code of the points by name, one for each variant."""
    return grouped((point.name, point.item) for point in device.points)


def erratum_rows(device: Device, encode: Encode) -> Iterator[tuple[str, ...]]:
    """Yield the rows of the errata."""
    items = items_of(device)
    for erratum in device.errata:
        points = "; ".join(item for name in erratum.points for item in items.get(name, ()))
        where = str(erratum.where)
        doubts = "; ".join(text for _, text in erratum.leaves_open)
        texts = (erratum.id, points, where, erratum.printed, erratum.taken, erratum.why, erratum.certainty, doubts)
        yield (*map(encode, texts), *source_cells(erratum.source, encode))


# The workbook.


_COLUMNS = (Column("sheet", ""), Column("column", ""), Column("says", ""))


def workbook_of(device: Device, tables: Iterable[Table]) -> bytes:
    """Return the bytes of the workbook. Raises ModuleNotFoundError without XlsxWriter."""
    from xlsxwriter import Workbook  # type: ignore[import-untyped]  # it has no types

    contents = BytesIO()
    book = Workbook(contents, {"in_memory": True})
    version = f"{device.version} ({device.digest[:16]})"
    book.set_properties(
        {
            "title": line(f"{device.vendor} {device.model}: {title_text(device.title)}"),
            "comments": f"Generated by fieldscribe {fieldscribe.__version__} from {device.id} {version}. "
            f"Regenerate with: {line(command(device, 'docs'))}",
            "created": _WHEN,
        }
    )
    formats = {name: book.add_format(properties) for name, properties in _FORMATS.items()}
    sheets = tuple(tables)
    for table in (*sheets, Table("columns", _COLUMNS, lambda encode: _explained(sheets, encode))):
        _write(book.add_worksheet(table.name), table, formats)
    book.close()
    return contents.getvalue()


def _explained(tables: Iterable[Table], encode: Encode) -> Iterator[tuple[str, ...]]:
    for table in tables:
        for column in table.columns:
            yield table.name, column.name, encode(column.meaning.replace("`", ""))


def _write(sheet: Any, table: Table, formats: Mapping[str, object]) -> None:
    widths = [len(column.name) + 2 for column in table.columns]
    for place, column in enumerate(table.columns):
        sheet.write_string(0, place, column.name, formats["head"])
    last = 0
    for last, row in enumerate(table.rows(line), 1):
        for place, text in enumerate(row):
            if text:
                widths[place] = max(widths[place], len(text))
                if table.columns[place].is_number and _fits(text):
                    sheet.write_number(last, place, float(text))
                else:
                    _write_text(sheet, (last, place), text, formats["plain"])
    for place, width in enumerate(widths):
        column_format = formats["long" if width > _WIDE else "short"]
        sheet.set_column(place, place, min(max(width, _NARROW), _WIDE) + 1, column_format)
    sheet.freeze_panes(1, _STAYS.get(table.name, 1))
    sheet.autofilter(0, 0, last, len(widths) - 1)
    _print_wide(sheet)


def _print_wide(sheet: Any) -> None:
    """Print all columns side by side, and the head on each page."""
    sheet.set_landscape()
    sheet.fit_to_pages(1, 0)
    sheet.repeat_rows(0)


def _fits(text: str) -> bool:
    """Return True if a cell for numbers can hold the text exactly."""
    return _NUMBER.fullmatch(text) is not None and ("." in text or abs(int(text)) <= _MOST)


def _write_text(sheet: Any, at: tuple[int, int], text: str, plain: object) -> None:
    """Write a text, never as a formula, a link or a date; in pieces where it looks like an escaped character."""
    first, *others = _ESCAPE.split(text)
    if others:
        sheet.write_rich_string(*at, first, *(piece for other in others for piece in (plain, other)))
    else:
        sheet.write_string(*at, text)
