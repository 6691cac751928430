"""No table of a page is wider than a screen: real browser, plain style, all shipped devices."""

from __future__ import annotations

import json
import re
from html import unescape
from pathlib import Path
from typing import NamedTuple

import pytest
from fieldscribe.resources import render
from fieldscribe.targets.docs import outputs
from support.described import SHIPPED, shipped
from support.toolchains import succeed, tool

WIDE = "\n\n| Too wide |\n| --- |\n| " + "x" * 300 + " |\n"

WINDOW = 1280
"""How wide the window is, in pixels."""

_STYLE = """
body { font-family: sans-serif; margin: 8px }
table { border-collapse: collapse }
td, th { border: 1px solid #ccc; padding: 4px 8px }
"""
_SCRIPT = """
const tables = [...document.querySelectorAll("table")].map(table => ({
  width: Math.ceil(table.getBoundingClientRect().width),
  heads: [...table.rows[0].cells].map(cell => cell.textContent),
}));
document.title = JSON.stringify(tables);
"""
_ALONE = ("--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking")


class Table(NamedTuple):
    """A table as the browser laid it out."""

    width: int
    heads: tuple[str, ...]


def tables_of(body: str, folder: Path) -> list[Table]:
    """All tables of a page with a plain style; `folder` is where the browser keeps its things."""
    browser, page = tool("chromium-headless-shell"), folder / "page.html"
    head = f'<!doctype html><meta charset="utf-8"><title></title><style>{_STYLE}</style>'
    page.write_text(f"{head}<body>{body}<script>{_SCRIPT}</script>", encoding="utf-8")
    own = (f"--user-data-dir={folder / 'browser'}", f"--window-size={WINDOW},1024")
    dom = succeed([browser, *_ALONE, *own, "--dump-dom", page.as_uri()])
    title = re.search(r"<title>(.*?)</title>", dom, re.DOTALL)
    assert title is not None
    return [Table(table["width"], tuple(table["heads"])) for table in json.loads(unescape(title[1]))]


@pytest.mark.full(seconds=4)
def test_every_table_fits_a_screen(tmp_path: Path) -> None:
    """A table with one long word, behind all others, shows that widths are really measured."""
    markdown = pytest.importorskip("markdown_it").MarkdownIt("commonmark").enable("table")
    pages = [dict(outputs(shipped(name), render))[f"docs/{name}.md"] for name in SHIPPED]
    *tables, wide = tables_of(markdown.render("\n\n".join((*pages, WIDE))), tmp_path)
    assert wide.width > WINDOW
    assert len(SHIPPED) == 7
    assert len(tables) == sum(page.count("\n| --- |") for page in pages)
    assert [table for table in tables if table.width > WINDOW] == []
