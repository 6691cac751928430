"""Reads a page of Markdown: its headings with anchors, the search entry of each section, and its HTML.

No markup of the Markdown gets through: HTML in it becomes text, and images are left out.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache
from typing import TYPE_CHECKING, Any

from fieldscribe.text import html_code

if TYPE_CHECKING:
    from markdown_it import MarkdownIt
    from markdown_it.token import Token

_COMMENT = re.compile(r"(?s)\s*<!--.*?-->\s*")
"""Matches a comment for our own tools."""


@dataclass(slots=True)
class Section:
    """A place to which a link can lead: a heading, or a row of a table that starts with a name in code (level 0).

    `words` is the text below the heading, or of the row; `within` is the heading above the row.
    """

    anchor: str
    level: int
    title: str
    within: str = ""
    words: list[str] = field(default_factory=list)


@dataclass(slots=True)
class Page:
    """A page: its path, which ends with `.md`, its Markdown in tokens, and its sections in order."""

    path: str
    tokens: list[Token]
    sections: list[Section]

    @property
    def title(self) -> str:
        """Return the text of the first heading."""
        return next((section.title for section in self.sections if section.level), self.path)

    def html(self) -> str:
        """Return the text as HTML."""
        reader = markdown_reader()
        return str(reader.renderer.render(self.tokens, reader.options, {}))


def page_of(path: str, text: str) -> Page:
    """Return the page of a text. Raises ModuleNotFoundError without markdown-it-py."""
    tokens = list(_without_comments(markdown_reader().parse(_clean(text))))
    return Page(path, tokens, list(_sections(tokens)))


def words_of(inline: Token) -> str:
    """Return the text of a paragraph, heading or cell."""
    return "".join(" " if child.type == "softbreak" else child.content for child in inline.children or ())


def _clean(text: str) -> str:
    """Return the text without invisible characters, such as bidi controls, which change the order of others."""
    return "".join(char for char in text if char in "\n\t" or unicodedata.category(char) not in {"Cc", "Cf", "Cs"})


def _without_comments(tokens: Sequence[Token]) -> Iterator[Token]:
    comments = [at for at, token in enumerate(tokens) if token.type == "inline" and _COMMENT.fullmatch(token.content)]
    left_out = {at + step for at in comments for step in (-1, 0, 1)}
    return (token for at, token in enumerate(tokens) if at not in left_out)


def _sections(tokens: Sequence[Token]) -> Iterator[Section]:
    """Yield the sections, and give tokens the anchors and names that their HTML needs."""
    taken: dict[str, int] = {}
    heading = place = Section("", 1, "")
    for before, token, after in zip(tokens, tokens[1:], [*tokens[2:], None], strict=False):
        if token.type in ("table_open", "fence"):
            token.meta["name"] = heading.title
        if token.type == "fence":
            place.words.append(token.content)
        elif token.type == "table_close":
            place = heading
        elif token.type == "inline" and before.type == "heading_open" and after is not None:
            title = words_of(token)
            heading = place = Section(_anchor(title, taken), int(before.tag[1]), title)
            before.attrSet("id", heading.anchor)
            after.meta |= {"anchor": heading.anchor, "name": title}
            yield heading
        elif token.type == "inline" and before.meta.get("row") and _starts_with_code(token):
            title = words_of(token)
            named = re.sub(r"\W+", "-", title).strip("-")
            place = Section(_anchor(f"{heading.anchor}-{named}", taken), 0, title, heading.title)
            before.meta["row"].attrSet("id", place.anchor)
            yield place
        elif token.type == "inline":
            place.words.append(words_of(token))
        elif token.type == "td_open" and before.type == "tr_open":
            token.meta["row"], place = before, heading


def _starts_with_code(inline: Token) -> bool:
    return (inline.children or [inline])[0].type == "code_inline"


def _anchor(title: str, taken: dict[str, int]) -> str:
    """Return the anchor of a heading as code hosts make it: further ones of the same text are numbered."""
    slug = re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") or "section"
    number = taken[slug] = taken.get(slug, -1) + 1
    return f"{slug}-{number}" if number else slug


@cache
def markdown_reader() -> MarkdownIt:
    """Return the converter from Markdown to HTML. Raises ModuleNotFoundError without markdown-it-py."""
    from markdown_it import MarkdownIt

    reader = MarkdownIt("commonmark", {"html": False}).enable("table").disable("image")
    for name, rule in _RULES.items():
        reader.add_render_rule(name, rule)
    return reader


def _heading_end(_renderer: Any, tokens: Sequence[Token], at: int, *_: object) -> str:
    token = tokens[at]
    anchor, name = html_code(token.meta["anchor"]), html_code(token.meta["name"])
    return f' <a class="anchor" href="#{anchor}" aria-label="Link to: {name}">#</a></{token.tag}>\n'


def _code_block(_renderer: Any, tokens: Sequence[Token], at: int, *_: object) -> str:
    code = html_code(tokens[at].content)
    return f'<div class="code"><pre{_scrolls("Code", tokens[at])}><code>{code}</code></pre></div>\n'


def _table_start(_renderer: Any, tokens: Sequence[Token], at: int, *_: object) -> str:
    return f'<div class="wide"{_scrolls("Table", tokens[at])}><table>\n'


def _scrolls(kind: str, token: Token) -> str:
    """Return the attributes of a box that the keyboard scrolls and a screen reader names."""
    return f' tabindex="0" role="group" aria-label="{kind}: {html_code(token.meta.get("name", ""))}"'


def _table_end(*_: object) -> str:
    return "</table></div>\n"


_RULES: dict[str, Any] = {
    "heading_close": _heading_end,
    "fence": _code_block,
    "code_block": _code_block,
    "table_open": _table_start,
    "table_close": _table_end,
}
"""Renderers that differ from plain HTML: anchors at headings, and boxes that scroll."""
