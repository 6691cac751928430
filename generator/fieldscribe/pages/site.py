"""The files of an index: the list of devices, Fieldscribe's own pages, and one search over all of them.

A link to a missing page or heading is a finding.
"""

from __future__ import annotations

import json
import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from operator import attrgetter
from pathlib import Path
from posixpath import dirname, join, normpath, relpath
from typing import TYPE_CHECKING, NamedTuple
from urllib.parse import unquote

from fieldscribe import __version__
from fieldscribe.diagnostics import Report, Span
from fieldscribe.families import family
from fieldscribe.model import Device, Point
from fieldscribe.pages.texts import Page, page_of
from fieldscribe.resources import Render, pages_dir
from fieldscribe.targets.docs.html import source
from fieldscribe.text import html_code, line
from fieldscribe.wording import label, title_text
from fieldscribe.wording.numbers import hex_text

if TYPE_CHECKING:
    from markdown_it.token import Token


FOLDER = "fieldscribe"
"""The folder of our pages, beside the pages of devices."""

_ELSEWHERE = re.compile(r"(?i)[a-z][a-z0-9+.-]*:")
_DEVICE = re.compile(r"descriptions/(\w+)")
_OURS = re.compile(r"[^/]+\.md|descriptions/.*\.md")
"""Matches paths of pages.

Other targets of links, such as folders, are not delivered: their text stays without a link.
"""


class Links(NamedTuple):
    """Resolves links: to `pages` by their paths below `root`, and to `devices` that have a page."""

    pages: Mapping[str, Page]
    devices: Collection[str]
    root: Path
    report: Report

    def lead(self) -> None:
        """Resolve the links of all pages, and report broken ones."""
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
        """Return the target of a link; None if it has none."""
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
    """Return the path of a page of Markdown as HTML."""
    return f"{FOLDER}/{path.removesuffix('.md')}.html"


def _path(page: Page, href: str) -> str:
    """Return the path of a link, from the top folder."""
    path = unquote(href.partition("#")[0])
    return normpath(join(dirname(page.path), path)) if path else page.path


Row = tuple[str, str, str, str]
"""An entry of the search: its anchor, its title, further words, and the heading above it."""


class DeviceView(NamedTuple):
    """A row of the list of devices, in HTML."""

    href: str
    cells: tuple[str, ...]


def device_view(device: Device) -> DeviceView:
    """Return the row of a device in the list."""
    framings = ", ".join(device.bus.framings)
    generated = sum(point.generated for point in device.points)
    texts = (
        *(device.model, device.vendor, title_text(device.title)),
        *(f"{device.family}: {framings}" if framings else device.family, str(len(device.points))),
        *(str(generated), str(len(device.errata))),
    )
    return DeviceView(html_code(f"{device.id}.html"), tuple(html_code(line(text)) for text in texts))


def device_name(device: Device) -> str:
    """Return maker and model."""
    return line(f"{device.vendor} {device.model}")


def rows_of(device: Device) -> Iterator[Row]:
    """Yield the search entries of the points of a device: names, codes, titles, addresses in all notations."""
    groups = {group.name: line(title_text(group.title)) for group in device.groups}
    for point in device.points:
        title = f"{label(point)}: {line(title_text(point.title))}"
        yield f"point={point.item}", title, " ".join(dict.fromkeys(_numbers(device, point))), groups[point.group]


def _numbers(device: Device, point: Point) -> Iterable[str]:
    """Yield the numbers of a point in manuals and tools, and its old names."""
    yield from point.was
    if point.addresses:
        first = min(point.addresses)
        yield from (hex_text(first), str(first), f"0x{first:04X}")
        yield from map(str, family(device.family).numbers(point.space, first).values())
    yield from map(str, point.references.values())


INDEX = "index"
"""The name of the files and their manifest, in place of a device id."""

_SHELVES = (
    ("Start", ("README.md", "CHANGELOG.md")),
    ("Describe a device", ("descriptions/README.md", "descriptions/language/*.md", "descriptions/*.md")),
    ("Use the code, talk to devices", ("descriptions/using/*.md",)),
)
"""The headings of our list of pages, with patterns of paths."""


class Shelf(NamedTuple):
    """Pages under one heading of the list of pages."""

    heading: str
    pages: tuple[Page, ...]


class LinkView(NamedTuple):
    """A link in a list."""

    href: str
    text: str
    here: bool = False


class PageView(NamedTuple):
    """A page, in HTML: its heading, the path to the top, the lists of links beside it, and its text."""

    path: str
    title: str
    top: str
    shelves: tuple[tuple[str, list[LinkView]], ...]
    contents: tuple[LinkView, ...]
    text: str


def load_pages(devices: Collection[str], report: Report, root: Path | None = None) -> tuple[Shelf, ...]:
    """Return our pages, with links to each other and to the pages of these devices.

    `root` is another folder of pages. Raises ModuleNotFoundError without markdown-it-py.
    """
    root = root or pages_dir()
    pages: dict[str, Page] = {}
    shelves = []
    for heading, patterns in _SHELVES:
        files = [file for each in patterns for file in sorted(root.glob(each), key=attrgetter("stem"))]
        paths = {file.relative_to(root).as_posix(): file for file in files}
        shelf = {path: page_of(path, file.read_text("utf-8")) for path, file in paths.items()}
        shelves.append(Shelf(heading, tuple(shelf.values())))
        pages |= shelf
    Links(pages, devices, root, report).lead()
    return tuple(shelves)


def site_files(
    devices: Sequence[Device], shelves: Sequence[Shelf], command: str, render: Render
) -> Iterator[tuple[str, str]]:
    """Yield the files: path relative to the folder, and text. `command` is the one that makes them again."""
    head = f"Generated by fieldscribe {__version__} from {INDEX} of these pages; do not edit."
    context = {"made": head, "command": command}
    text = render("docs/page/devices.html.j2", {"devices": [device_view(device) for device in devices]})
    views = [_view(f"{INDEX}.html", "Devices", shelves, (), text)]
    for page in (page for shelf in shelves for page in shelf.pages):
        contents = tuple(
            LinkView(f"#{html_code(at.anchor)}", html_code(at.title)) for at in page.sections if at.level == 2
        )
        views.append(_view(html_path(page.path), page.title, shelves, contents, page.html()))
    for view in views:
        yield view.path, render("docs/page/pages.html.j2", {**context, "page": view})
    yield f"{INDEX}.css", f"/* {head} */\n{source(('shared.css', 'pages.css'))}"
    script = source(("shared.js", "search.js", "pages.js"))
    yield f"{INDEX}.js", f"/* {head} */\n{script}{_search_data(devices, shelves)}"


def _view(path: str, title: str, shelves: Sequence[Shelf], contents: tuple[LinkView, ...], text: str) -> PageView:
    here = dirname(path) or "."

    def link(target: str, name: str) -> LinkView:
        return LinkView(html_code(relpath(target, here)), html_code(name), target == path)

    listed = [
        (html_code(each.heading), [link(html_path(page.path), page.title) for page in each.pages]) for each in shelves
    ]
    top = relpath(".", here)
    return PageView(path, html_code(title), top, (("", [link(f"{INDEX}.html", "Devices")]), *listed), contents, text)


def _search_data(devices: Sequence[Device], shelves: Sequence[Shelf]) -> str:
    """Return the call that adds entries to the search: path, name, and rows of anchor, title, words, heading above."""
    places: list[object] = [[f"{device.id}.html", device_name(device), list(rows_of(device))] for device in devices]
    for page in (page for shelf in shelves for page in shelf.pages):
        rows = [(at.anchor, at.title, " ".join(" ".join(at.words).split()), at.within) for at in page.sections]
        places.append([html_path(page.path), page.title, rows])
    return f"startPages({json.dumps(places, separators=(',', ':'))});\n"
