"""Exit codes, and printing: plain text, or colours and wrapped columns on a terminal."""

from __future__ import annotations

import gc
import os
import sys
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from typing import TYPE_CHECKING, TextIO

if TYPE_CHECKING:
    from fieldscribe.diagnostics import Line

FINE, FINDINGS, USAGE = 0, 1, 2
"""Exit codes: no finding; findings in the input, or stale output; wrong usage, or an error of the machine."""

Row = tuple[str, str]
"""A label and its text."""

_STYLES = {"error": "1;31", "warning": "1;33", "strong": "1", "place": "36", "frame": "34", "hint": "32"}
"""The terminal's code (SGR) of each style."""
_LABEL_STYLES = {"Wrong": "1;31", "Note": "33", "Doubt": "33", "Erratum": "33", "Not generated": "33"}
"""Labels with highlighted rows; all others are cyan, and their texts plain."""
_MARGIN, _GAP = 2, 2


def is_coloured(stream: TextIO) -> bool:
    """Return True if the stream is a terminal with colours and the environment does not forbid them."""
    if os.environ.get("NO_COLOR") or os.environ.get("TERM") == "dumb":
        return False
    return stream.isatty()


def terminal_width() -> int:
    """Return the columns that the environment gives, else those of the terminal."""
    columns = os.environ.get("COLUMNS", "")
    return int(columns) if columns.isdecimal() and int(columns) else terminal_size()[0]


def terminal_size() -> tuple[int, int]:
    """Return the columns and lines of the terminal, 80 by 24 if unknown; `shutil` would take long to import."""
    try:
        columns, lines = os.get_terminal_size(sys.stdout.fileno())
    except (OSError, ValueError):
        columns = lines = 0
    return columns or 80, lines or 24


def collect_rarely() -> None:
    """Collect garbage again in a command that runs for long: rarely, for most of its objects are short-lived texts."""
    gc.freeze()  # objects from before stay
    gc.set_threshold(100_000)
    gc.enable()


def print_lines(lines: Iterable[Line], stream: TextIO | None = None) -> None:
    """Print styled lines."""
    stream = stream or sys.stdout
    styles = _STYLES if is_coloured(stream) else {}
    for line in lines:
        stream.write("".join(_styled(styles.get(style, ""), piece) for style, piece in line) + "\n")


def print_rows(heading: str, rows: Sequence[Row]) -> None:
    """Print a heading and rows of label and text below it; a terminal gets long texts wrapped in their column."""
    title, row = row_writer(max([0, *(len(label) for label, _ in rows)]))
    sys.stdout.write("\n".join([title(heading), *(row(*each).rstrip() for each in rows)]) + "\n")


def row_writer(width: int) -> tuple[Callable[[str], str], Callable[[str, str], str]]:
    """Return what writes a heading, and a row of label and text for standard output; `width` is that of the labels."""
    if is_coloured(sys.stdout):
        return partial(_styled, "1"), lambda label, text: "\n".join(_wrapped(label, text, width))
    form = f"{' ' * _MARGIN}%-{width}s{' ' * _GAP}%s"
    return str, lambda label, text: form % (label, text)


def _wrapped(label: str, text: str, width: int) -> Iterable[str]:
    """Return the coloured lines of one row, with the text wrapped in its column."""
    from textwrap import wrap  # only a terminal needs it

    style = _LABEL_STYLES.get(label, "")
    space = max(20, terminal_width() - _MARGIN - width - _GAP)
    for place, line in enumerate(wrap(text, space, break_on_hyphens=False) or [""]):
        head = _styled(style or "36", f"{label:<{width}}") if place == 0 else " " * width
        yield f"{' ' * _MARGIN}{head}{' ' * _GAP}{_styled(style, line)}"


def _styled(code: str, text: str) -> str:
    return f"\x1b[{code}m{text}\x1b[0m" if code else text
