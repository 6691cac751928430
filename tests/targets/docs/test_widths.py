"""No table of a page is wider than a screen: real browser, plain style, all shipped devices."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from fieldscribe.render import render
from fieldscribe.targets.docs import outputs
from support.browser import WINDOW, tables_of
from support.described import shipped
from support.places import ROOT

if TYPE_CHECKING:
    from pathlib import Path

DEVICES = sorted(path.parent.name for path in (ROOT / "descriptions").glob("*/device.yaml"))
WIDE = "\n\n| Too wide |\n| --- |\n| " + "x" * 300 + " |\n"


@pytest.mark.full(seconds=4)
def test_every_table_fits_a_screen(tmp_path: Path) -> None:
    """A table with one long word, behind all others, shows that widths are really measured."""
    markdown = pytest.importorskip("markdown_it").MarkdownIt("commonmark").enable("table")
    pages = [dict(outputs(shipped(name), render))[f"docs/{name}.md"] for name in DEVICES]
    *tables, wide = tables_of(markdown.render("\n\n".join((*pages, WIDE))), tmp_path)
    assert wide.width > WINDOW
    assert len(DEVICES) == 5
    assert len(tables) == sum(page.count("\n| --- |") for page in pages)
    assert [table for table in tables if table.width > WINDOW] == []
