"""Leads the links of pages to pages of HTML; a link to a page or a heading that is not there is a finding."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from posixpath import dirname, join, normpath, relpath
from typing import TYPE_CHECKING
from urllib.parse import unquote

from fieldscribe.diagnostics import Report, Span
from fieldscribe.pages.texts import Page

if TYPE_CHECKING:
    from markdown_it.token import Token

FOLDER = "fieldscribe"
"""Where our pages lie, beside the pages of devices."""

_ELSEWHERE = re.compile(r"(?i)[a-z][a-z0-9+.-]*:")
_DEVICE = re.compile(r"descriptions/(\w+)")
_OURS = re.compile(r"[^/]+\.md|descriptions/.*\.md")
"""The paths that pages have. What else a link may name, such as a folder, is not delivered: its words stay alone."""


@dataclass(frozen=True, slots=True)
class Links:
    """Leads links: to `pages` by their paths, which were read below `root`, and to `devices` that have a page."""

    pages: Mapping[str, Page]
    devices: Collection[str]
    root: Path
    report: Report

    def lead(self) -> None:
        """Change the links of all pages, and report those that lead nowhere."""
        for page in self.pages.values():
            for token in page.tokens:
                if token.children:
                    token.children = list(self._led(page, token))

    def _led(self, page: Page, inline: Token) -> Iterator[Token]:
        line, leads = (inline.map or [0])[0] + 1, True
        for token in inline.children or ():
            line += token.type == "softbreak"
            if token.type == "link_open":
                href = str(token.attrGet("href"))
                target = href if _ELSEWHERE.match(href) else self._target(page, href)
                leads = target is not None
                token.attrSet("href", target or "")
                if not leads and _OURS.fullmatch(_path(page, href)):
                    span = Span(str(self.root / page.path), line, 1)
                    message = f"the link `{unquote(href)}` leads to no page or heading"
                    self.report.error("broken-link", message, span, "copy the link that stands at the heading")
            if leads or token.type not in ("link_open", "link_close"):
                yield token

    def _target(self, page: Page, href: str) -> str | None:
        """Return where a link leads; None if that is nowhere."""
        path, anchor = _path(page, href), unquote(href.partition("#")[2])
        device = _DEVICE.fullmatch(path)
        if device and device[1] in self.devices:
            return relpath(f"{device[1]}.html", dirname(html_path(page.path)))
        target = self.pages.get(path)
        if target is None or (anchor and anchor not in {section.anchor for section in target.sections}):
            return None
        named = f"#{anchor}" if anchor else ""
        return named if named and target is page else relpath(html_path(path), dirname(html_path(page.path))) + named


def html_path(path: str) -> str:
    """Return where a page of Markdown lies as HTML."""
    return f"{FOLDER}/{path.removesuffix('.md')}.html"


def _path(page: Page, href: str) -> str:
    """Return the path that a link names, as from the top."""
    path = unquote(href.partition("#")[0])
    return normpath(join(dirname(page.path), path)) if path else page.path
