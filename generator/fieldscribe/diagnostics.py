"""Findings about a description, their rendering as text and as JSON; and errors of requests that cannot be fulfilled.

Stages add findings to a `Report`; the command line prints it. A line of text is a list of (style, text), so that it can
be coloured. Control and bidi characters of a file are shown as their numbers.
"""

from __future__ import annotations

import os
import re
import unicodedata
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Literal, NamedTuple

from fieldscribe.text import counted, line

Severity = Literal["error", "warning"]
Line = list[tuple[str, str]]
"""One line as (style, text); styles are error, warning, strong, place, frame, hint, and empty."""

ReadLines = Callable[[str], Sequence[str] | None]
"""A function that returns the lines of a file by the path that findings name; None if it cannot be read."""

BEFORE, AFTER = 40, 60
"""How many characters of a long line are shown before and after the place of a finding."""

LINE_BREAK = re.compile(r"\r\n|[\n\r\x85\u2028\u2029]")
"""What YAML counts as the end of a line."""
_HIDDEN = frozenset({"Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp"})


class Span:
    """A place in a file: its path as the user named it, line and column from 1, and a width in characters.

    Most places are never shown, so `sought` defers the search for line and column until they are needed.
    """

    __slots__ = ("_at", "_find", "file", "width")

    def __init__(self, file: str, line: int, column: int, width: int = 1) -> None:
        self.file, self.width = file, width
        self._at = line, column
        self._find: Callable[[], tuple[int, int]] | None = None

    @classmethod
    def sought(cls, file: str, find: Callable[[], tuple[int, int]], width: int = 1) -> Span:
        """Return the place whose line and column `find` returns."""
        span = cls(file, 0, 0, width)
        span._find = find
        return span

    @property
    def at(self) -> tuple[int, int]:
        """Line and column."""
        if self._find is not None:
            self._at, self._find = self._find(), None
        return self._at

    @property
    def line(self) -> int:
        """The line, counted from 1."""
        return self.at[0]

    @property
    def column(self) -> int:
        """The column, counted from 1."""
        return self.at[1]

    def moved(self, columns: int, width: int | None = None) -> Span:
        """Return the place moved by a number of columns, with another width if one is given."""
        width = self.width if width is None else width
        return Span.sought(self.file, lambda: (self.line, self.column + columns), width)

    def in_file(self, name: str) -> Span:
        """Return the same place under another file name."""
        return Span(name, *self.at, self.width)

    def _facts(self) -> tuple[str, tuple[int, int], int]:
        return self.file, self.at, self.width

    def __eq__(self, other: object) -> bool:
        return self._facts() == other._facts() if isinstance(other, Span) else NotImplemented

    def __lt__(self, other: Span) -> bool:
        return self._facts() < other._facts()

    def __hash__(self) -> int:
        return hash(self._facts())


class Diagnostic(NamedTuple):
    """One finding: a stable rule id, what is wrong, where, what to do about it, and related places."""

    rule: str
    message: str
    span: Span
    hint: str | None = None
    related: tuple[tuple[Span, str], ...] = ()
    severity: Severity = "error"


MOST_FINDINGS = 1000
"""The most errors, and the most warnings, that one report keeps; it counts the others."""


class Report:
    """All findings of a device or of a run. Stages add to it, drop what is broken and go on."""

    __slots__ = ("_added", "_findings", "_left_out", "_stopped")

    def __init__(self) -> None:
        self._findings: dict[Diagnostic, None] = {}
        self._added: dict[Severity, int] = {"error": 0, "warning": 0}
        self._left_out: dict[tuple[Severity, int], Span] = {}
        """The places of findings beyond the limit, by level and hash."""
        self._stopped: Span | None = None
        """The last error within the limit, if the limit was reached: checks may have stopped there."""

    def error(
        self, rule: str, message: str, span: Span, hint: str | None = None, related: Iterable[tuple[Span, str]] = ()
    ) -> None:
        """Add an error; the same finding counts once."""
        self._add(Diagnostic(rule, _clean(message), span, hint and _clean(hint), tuple(related)))

    def warning(self, rule: str, message: str, span: Span, hint: str | None = None) -> None:
        """Add a warning, which does not stop the compilation; the same finding counts once."""
        self._add(Diagnostic(rule, _clean(message), span, hint and _clean(hint), (), "warning"))

    def extend(self, other: Report) -> None:
        """Add everything that another report holds; the limit is for each report, not for their sum."""
        self._findings.update(other._findings)
        self._left_out.update(other._left_out)
        self._stopped = self._stopped or other._stopped

    def with_place(self, span: Span, text: str) -> Report:
        """Return the same findings, each with a related place, unless that is its own place."""

        def extended(finding: Diagnostic) -> Diagnostic:
            elsewhere = (finding.span.file, finding.span.at) != (span.file, span.at)
            return finding._replace(related=(*finding.related, (span, text))) if elsewhere else finding

        return self._mapped(extended)

    def in_files(self, name_of: Callable[[str], str]) -> Report:
        """Return the same findings with other file names."""

        def renamed(finding: Diagnostic) -> Diagnostic:
            related = tuple((span.in_file(name_of(span.file)), text) for span, text in finding.related)
            return finding._replace(span=finding.span.in_file(name_of(finding.span.file)), related=related)

        return self._mapped(renamed)

    @property
    def findings(self) -> tuple[Diagnostic, ...]:
        """All findings by file and place, errors before warnings at one place; last how many are left out."""
        ordered = sorted(self._findings, key=lambda each: (each.span, each.severity, each.rule, each.message))
        return (*ordered, *self._more())

    @property
    def count(self) -> int:
        """The number of findings, including those left out."""
        return len(self._findings) + len(self._left_out)

    def count_of(self, severity: Severity) -> int:
        """Return the number of errors or warnings, including those left out."""
        kept = sum(finding.severity == severity for finding in self._findings)
        return kept + sum(level == severity for level, _ in self._left_out)

    @property
    def has_errors(self) -> bool:
        """True if a finding is an error; then nothing may be compiled."""
        return any(finding.severity == "error" for finding in self._findings)

    @property
    def full(self) -> bool:
        """True if there are so many errors that checks may stop."""
        return self._added["error"] >= MOST_FINDINGS

    def _add(self, finding: Diagnostic) -> None:
        if finding in self._findings:
            return
        if self._added[finding.severity] < MOST_FINDINGS:
            self._added[finding.severity] += 1
            self._findings[finding] = None
            if self.full:
                self._stopped = self._stopped or finding.span
        else:
            self._left_out.setdefault((finding.severity, hash(finding)), finding.span)

    def _mapped(self, change: Callable[[Diagnostic], Diagnostic]) -> Report:
        result = Report()
        result._findings = dict.fromkeys(map(change, self._findings))
        result._left_out, result._stopped = dict(self._left_out), self._stopped
        return result

    def _more(self) -> Iterator[Diagnostic]:
        """Yield a finding for each level that has findings left out."""
        levels: tuple[Severity, ...] = ("error", "warning")
        for level in levels:
            spans = [span for (severity, _), span in self._left_out.items() if severity == level]
            if spans:
                message = f"{len(spans)} more {level}{'s are' if len(spans) > 1 else ' is'} not shown"
                yield Diagnostic("more-findings", message, spans[0], "correct those above first", (), level)
            elif level == "error" and self._stopped is not None:
                message = f"checking stopped at {MOST_FINDINGS} errors: there may be more"
                yield Diagnostic("more-findings", message, self._stopped, "correct those above first")


def _clean(text: str) -> str:
    """Return the text without line breaks, control and bidi characters: it may quote any file on a terminal."""
    return text if text.isprintable() else line(text)


# Rendering.


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
    before = f"... {visible(text[start:at].lstrip())}" if start else visible(text[:at])
    marked = text[at : min(at + span.width, end)]
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


# Errors of requests.


class UnclearError(Exception):
    """The device does not have what the user named, or has several of them; `hint` may be empty."""

    def __init__(self, message: str, hint: str = "") -> None:
        super().__init__(message)
        self.message = message
        self.hint = hint
        if hint:
            self.add_note(f"hint: {hint}")  # tests of users see it


class RefusedError(Exception):
    """A value must not be sent. `status` is that of generated code, or `missing`, `read_only` and the like.

    `why` is the message without the name of the point.
    """

    def __init__(self, status: str, message: str, hint: str = "", *, why: str = "") -> None:
        super().__init__(message)
        self.status = status
        self.message = message
        self.hint = hint
        self.why = why or message


def did_you_mean(names: list[str]) -> str:
    """Return a hint that offers near names; empty if there are none."""
    return f"did you mean {either(names)}?" if names else ""


def either(names: list[str]) -> str:
    """Return names as a choice, each marked as code."""
    return " or ".join(f"`{line(name)}`" for name in names)


def show_traceback(error: BaseException) -> None:
    """Print the traceback of an internal error if FIELDSCRIBE_DEBUG is set."""
    if os.environ.get("FIELDSCRIBE_DEBUG"):
        import traceback

        traceback.print_exception(error)


def can_package(interface: str, error: Exception) -> str:
    """Return how to install the package that an interface of python-can lacks; empty for any other error."""
    if not ("not installed" in str(error) or isinstance(error, ImportError)):
        return ""
    from importlib.metadata import metadata

    extra = "multicast" if interface == "udp_multicast" else interface.replace("_", "-")
    known = metadata("python-can").get_all("Provides-Extra") or ()
    return f"pip install 'python-can[{extra}]'" if extra in known else ""
