"""Tables for spreadsheets and programs: their columns, and their rows as CSV."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, NamedTuple

from fieldscribe.text import csv_cell

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from fieldscribe.model import Source, Titles

    Encode = Callable[[str], str]
    """What makes a text of a description fit for a cell; numbers need it not."""

_MARK = "\ufeff"
"""What tells spreadsheets that a text is UTF-8; without it `°C` and umlauts are garbled."""
_LIKE_A_NUMBER = re.compile(r"[-+0-9.,:/ eE]+")
_WHOLE = re.compile(r"0|[1-9][0-9]*")


class Column(NamedTuple):
    """A column, what its cells say, and whether they are numbers."""

    name: str
    says: str
    is_number: bool = False


class Table(NamedTuple):
    """A table: its columns, and what makes its rows of finished cells."""

    name: str
    columns: tuple[Column, ...]
    rows: Callable[[Encode], Iterable[tuple[str, ...]]]


def csv_of(table: Table) -> str:
    """The table as CSV, its head first."""
    lines = [",".join([column.name for column in table.columns])]
    lines += [",".join(row) for row in table.rows(csv_cell)]
    return _MARK + "\n".join(lines) + "\n"


def original(titles: Titles) -> str:
    """A title in the languages of the manual: all but English."""
    if len(titles) == 1:
        return ""
    return " / ".join(dict.fromkeys([text for language, text in titles.items() if language != "en"]))


def source_cells(source: Source, encode: Encode) -> Iterator[str]:
    """Where in which document: document, section, page, line."""
    yield encode(source.document)
    yield encode(no_number("section", source.section or ""))
    page = source.page or ""
    yield page if _WHOLE.fullmatch(page) else encode(no_number("page", page))
    yield "" if source.line is None else str(source.line)


def no_number(what: str, text: str) -> str:
    """A text that spreadsheets would take for a number or a date (section 4.10, page 7-25), with a word before it."""
    return f"{what} {text}" if _LIKE_A_NUMBER.fullmatch(text) else text


def decimal(text: str) -> str:
    """An exact number, or nothing where it is a fraction that has no end as a decimal."""
    return "" if "/" in text else text
