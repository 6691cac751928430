"""A real browser, for what only one can say: how wide the tables of a page are."""

from __future__ import annotations

import json
import re
from html import unescape
from typing import TYPE_CHECKING, NamedTuple

from support.toolchains import succeed, tool

if TYPE_CHECKING:
    from pathlib import Path

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
