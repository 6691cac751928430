"""Text for the cells of a Markdown table."""

from __future__ import annotations

import re
from functools import lru_cache
from typing import TYPE_CHECKING

from fieldscribe.records import dataclass
from fieldscribe.text import markdown

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from fieldscribe.model import Source

_PLAIN = re.compile(r"(?:[^\W_]|[°%.,;:/?'()=+ -]|(?<=[A-Za-z0-9])_(?=[A-Za-z0-9]))*")
_CODE = re.compile(r"[A-Za-z0-9_.+/=-]+(?: [A-Za-z0-9_.+/=-]+)*")
_NUMBERED = re.compile(r"^([0-9]+)([.)])")
_NO_ANCHOR = re.compile(r"[^a-z0-9_-]")


@dataclass(frozen=True, slots=True)
class Table:
    """A table whose cells are finished Markdown."""

    heads: tuple[str, ...]
    rules: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


def table(columns: Iterable[tuple[str, Sequence[str]]]) -> Table | None:
    """A table from columns of equal length, without empty columns; None if none is left."""
    kept = [(head, cells) for head, cells in columns if any(cells)]
    if not kept:
        return None
    heads = tuple(head for head, _ in kept)
    return Table(heads, ("---",) * len(kept), tuple(zip(*(cells for _, cells in kept), strict=True)))


def by_rows(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> Table | None:
    """A table from rows, without empty columns; None without rows."""
    return table(zip(heads, zip(*rows, strict=True), strict=True)) if rows else None


@lru_cache(maxsize=65536)
def cell(text: str) -> str:
    """Plain text as a table cell; only possible markup is escaped, so that the source stays readable."""
    return text.strip() if _PLAIN.fullmatch(text) and "://" not in text and "www." not in text else markdown(text)


def paragraph(text: str) -> str:
    """Plain text at the beginning of a line: a number that would start a list is escaped too."""
    return _NUMBERED.sub(r"\1\\\2", markdown(text))


@lru_cache(maxsize=65536)
def code(text: str) -> str:
    """A name or bytes as a code span; as escaped text when it holds anything unusual."""
    return f"`{text}`" if _CODE.fullmatch(text) else markdown(text)


@lru_cache(maxsize=65536)
def anchor(kind: str, name: str) -> str:
    """The anchor that a link and its target share."""
    return f"{kind}-{_NO_ANCHOR.sub('-', name.lower())}"


@lru_cache(maxsize=65536)
def target(kind: str, name: str) -> str:
    """A name in a cell, as the target of links."""
    return f'<a id="{anchor(kind, name)}"></a>{code(name)}'


@lru_cache(maxsize=65536)
def link(kind: str, name: str) -> str:
    """A name as a link to its target."""
    return f"[{code(name)}](#{anchor(kind, name)})"


@lru_cache(maxsize=65536)
def source_text(source: Source, with_document: bool) -> str:
    """The place of a fact in the manual, as plain text."""
    parts = [source.document] if with_document else []
    parts += [source.section] if source.section else []
    parts += [f"page {source.page}"] if source.page else []
    parts += [f"line {source.line}"] if source.line is not None else []
    return ", ".join(parts)
