"""Findings about a description, as data; `report.py` renders them as text and JSON."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator
from typing import Literal, NamedTuple

Severity = Literal["error", "warning"]


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
    if text.isprintable():
        return text
    from fieldscribe.text import line

    return line(text)


def show_traceback(error: BaseException) -> None:
    """Print the traceback of an internal error if FIELDSCRIBE_DEBUG is set."""
    if os.environ.get("FIELDSCRIBE_DEBUG"):
        import traceback

        traceback.print_exception(error)
