"""Renders findings as text with the lines of the file, and as JSON.

A line of text is a list of (style, text), so that the command line can colour it. Control and bidi characters of a file
are shown as their numbers.
"""

import re
import unicodedata
from collections.abc import Callable, Iterable, Iterator, Sequence

from fieldscribe.diagnostics import Diagnostic, Report, Span
from fieldscribe.text import counted

Line = list[tuple[str, str]]
"""One line as (style, text); styles are error, warning, strong, place, frame, hint, and empty."""

ReadLines = Callable[[str], Sequence[str] | None]
"""A function that returns the lines of a file by the path that findings name; None if it cannot be read."""

BEFORE, AFTER = 40, 60
"""How many characters of a long line are shown before and after the place of a finding."""

LINE_BREAK = re.compile(r"\r\n|[\n\r\x85\u2028\u2029]")
"""What YAML counts as the end of a line."""
_HIDDEN = frozenset({"Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp"})


def as_lines(findings: Iterable[Diagnostic], read: ReadLines) -> Iterator[Line]:
    """Yield the findings as text, each followed by an empty line."""
    for finding in findings:
        yield [(finding.severity, f"{finding.severity}[{finding.rule}]"), ("strong", f": {visible(finding.message)}")]
        margin = len(str(max(finding.span.line, *(span.line for span, _ in finding.related), 0)))
        yield [("frame", " " * margin + "--> "), ("place", place_text(finding.span))]
        yield from _frame(finding.span, margin, read, finding.severity)
        for span, message in finding.related:
            yield [("frame", " " * margin + "::: "), ("place", place_text(span)), ("", f": {visible(message)}")]
            yield from _frame(span, margin, read, "frame")
        if finding.hint:
            yield [("frame", " " * margin + " = "), ("hint", f"hint: {visible(finding.hint)}")]
        yield []


def as_data(findings: Iterable[Diagnostic]) -> list[dict[str, object]]:
    """Return the findings for JSON."""
    return [
        {
            "rule": finding.rule,
            "severity": finding.severity,
            "message": finding.message,
            **_place_data(finding.span),
            "hint": finding.hint,
            "related": [{"message": message, **_place_data(span)} for span, message in finding.related],
        }
        for finding in findings
    ]


def summary(report: Report) -> str:
    """Return one line such as `3 errors in 2 files; 1 warning`; empty when there are none."""
    errors, warnings = report.count_of("error"), report.count_of("warning")
    files = {finding.span.file for finding in report.findings if finding.severity == "error"}
    parts = [f"{counted(errors, 'error')} in {counted(len(files), 'file')}"] if errors else []
    return "; ".join(parts + ([counted(warnings, "warning")] if warnings else []))


def split_lines(text: str) -> list[str]:
    """Return the lines of a text."""
    return LINE_BREAK.split(text)


def place_text(span: Span) -> str:
    """Return a place as `file:line:column`."""
    return f"{visible(span.file)}:{span.line}:{span.column}"


def visible(text: str) -> str:
    """Return the text with its control, format and unassigned characters written as their numbers."""
    if text.isprintable():
        return text
    return "".join(_escaped(char) for char in text)


def _escaped(char: str) -> str:
    if char == "\t":
        return "    "
    return f"<U+{ord(char):04X}>" if unicodedata.category(char) in _HIDDEN else char


def _frame(span: Span, margin: int, read: ReadLines, style: str) -> Iterator[Line]:
    """Yield the line of the file around the place of a finding, and a mark below it."""
    lines = read(span.file)
    if lines is None or not 1 <= span.line <= len(lines):
        return
    text = lines[span.line - 1]
    if not text.strip():
        return
    at = min(max(span.column - 1, 0), len(text))
    start = 0 if at <= BEFORE + 10 else at - BEFORE
    end = len(text) if len(text) <= at + AFTER + 10 else at + AFTER
    before, marked = (
        visible(text[start:at].lstrip() if start else text[start:at]),
        text[at : min(at + span.width, end)],
    )
    before = f"... {before}" if start else before
    after = visible(text[at + len(marked) : end]) + (" ..." if end < len(text) else "")
    number = f"{span.line:>{margin}}"
    yield [("frame", f"{number} | "), ("", f"{before}{visible(marked)}{after}".rstrip())]
    mark = "^" * max(1, columns(visible(marked)))
    yield [("frame", " " * margin + " | "), (style, " " * columns(before) + mark)]


def columns(text: str) -> int:
    """Return how many columns of a terminal a text takes."""
    if text.isascii():
        return len(text)
    wide = sum(unicodedata.east_asian_width(char) in "WF" for char in text)
    return len(text) + wide - sum(unicodedata.combining(char) != 0 for char in text)


def _place_data(span: Span) -> dict[str, object]:
    return {"file": span.file, "line": span.line, "column": span.column, "width": span.width}
