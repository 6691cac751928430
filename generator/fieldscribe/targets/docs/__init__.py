"""The documentation target: a Markdown reference, an HTML page, and tables of points and meanings (CSV, XLSX)."""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial
from itertools import chain
from typing import TYPE_CHECKING

from fieldscribe.model import Device

if TYPE_CHECKING:
    from fieldscribe.resources import Render
    from fieldscribe.targets.docs.cells import DocsScope
    from fieldscribe.targets.docs.tables import Table

SEES_TITLES = True

WEIGHT = 2.0


def outputs(device: Device, render: Render) -> Iterable[tuple[str, str]]:
    """Yield the files of a device: path relative to the output folder, and text."""
    from fieldscribe.targets.docs.cells import scope_of

    scope = scope_of(device)
    for path, text in chain(markdown_files(scope, render), csv_files(scope), html_files(scope, render)):
        yield f"docs/{path}", text


def markdown_files(scope: DocsScope, render: Render) -> Iterable[tuple[str, str]]:
    """Yield the reference in Markdown."""
    from fieldscribe.targets.docs.page import page_of

    yield f"{scope.device.id}.md", render("docs/device.md.j2", {"page": page_of(scope)}).rstrip("\n") + "\n"


def html_files(scope: DocsScope, render: Render, index: str = "") -> Iterable[tuple[str, str]]:
    """Yield the page in HTML, with a link to `index`."""
    from fieldscribe.targets.docs.html import html_of

    yield f"{scope.device.id}.html", html_of(scope, render, index)


def csv_files(scope: DocsScope) -> Iterable[tuple[str, str]]:
    """Yield the points and their meanings as CSV."""
    from fieldscribe.targets.docs.tables import csv_of

    points, meanings, _ = tables_of(scope)
    yield f"{scope.device.id}.csv", csv_of(points)
    yield f"{scope.device.id}_meanings.csv", csv_of(meanings)


def xlsx_files(scope: DocsScope) -> Iterable[tuple[str, bytes]]:
    """Yield all tables as one workbook. Raises ModuleNotFoundError without XlsxWriter."""
    from fieldscribe.targets.docs.tables import workbook_of

    yield f"{scope.device.id}.xlsx", workbook_of(scope.device, tables_of(scope))


def tables_of(scope: DocsScope) -> tuple[Table, Table, Table]:
    """Return the tables of the points, their meanings, and the errata."""
    from fieldscribe.targets.docs.sheet import points_table
    from fieldscribe.targets.docs.tables import ERRATA, MEANINGS, Table, erratum_rows, meaning_rows

    meanings = Table("meanings", MEANINGS, partial(meaning_rows, scope.device))
    return points_table(scope), meanings, Table("errata", ERRATA, partial(erratum_rows, scope.device))
