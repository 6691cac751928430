"""Printing: plain text, or colours and layout by rich on a terminal."""

from __future__ import annotations

import os
import sys
from functools import cache
from typing import TYPE_CHECKING, TextIO

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from fieldscribe.report import Line

Row = tuple[str, str]
"""A label and what it says."""

_STYLES = {
    "error": "bold red",
    "warning": "bold yellow",
    "strong": "bold",
    "place": "cyan",
    "frame": "blue",
    "hint": "green",
}
_LABEL_STYLES = {"Wrong": "bold red", "Note": "yellow", "Erratum": "yellow", "Not generated": "yellow"}


def is_coloured(stream: TextIO) -> bool:
    """Whether the stream is a terminal with colours, and the environment does not forbid them."""
    if os.environ.get("NO_COLOR") or os.environ.get("TERM") == "dumb":
        return False
    return stream.isatty()


def print_lines(lines: Iterable[Line], stream: TextIO | None = None) -> None:
    """Print styled lines."""
    stream = stream or sys.stdout
    if is_coloured(stream):
        text = ("".join(_styled(style, piece) for style, piece in line) for line in lines)
    else:
        text = ("".join(piece for _, piece in line) for line in lines)
    stream.writelines(f"{line}\n" for line in text)


def print_rows(heading: str, rows: Sequence[Row], stream: TextIO | None = None) -> None:
    """Print a heading and rows of label and text below it; on a terminal long texts are wrapped in their column."""
    stream = stream or sys.stdout
    if is_coloured(stream):
        _print_table(heading, rows, stream)
        return
    stream.write(rows_text(heading, rows))


def rows_text(heading: str, rows: Sequence[Row]) -> str:
    """A heading and rows of label and text below it, where nothing is coloured or wrapped."""
    width = max([len(label) for label, _ in rows], default=0)
    margins = {label: f"  {label:<{width}}  " for label, _ in rows}
    lines = [(margins[label] + text).rstrip() for label, text in rows]
    return "\n".join([heading, *lines, ""])


def _print_table(heading: str, rows: Sequence[Row], stream: TextIO) -> None:
    from rich.console import Console
    from rich.padding import Padding
    from rich.table import Table
    from rich.text import Text

    console = Console(file=stream, highlight=False)
    table = Table.grid(padding=(0, 2))
    table.add_column(no_wrap=True)
    table.add_column(overflow="fold")
    for label, text in rows:
        style = _LABEL_STYLES.get(label, "")
        table.add_row(Text(label, style or "cyan"), Text(text, style))
    console.print(Text(heading, "bold"))
    console.print(Padding(table, (0, 0, 0, 2)))


@cache
def _marks(style: str) -> tuple[str, str]:
    """The control codes around a text of that style; rich is asked only once, because findings may be thousands."""
    from rich.color import ColorSystem
    from rich.style import Style

    before, _, behind = Style.parse(_STYLES[style]).render("-", color_system=ColorSystem.STANDARD).partition("-")
    return before, behind


def _styled(style: str, text: str) -> str:
    if style not in _STYLES:
        return text
    before, behind = _marks(style)
    return f"{before}{text}{behind}"
