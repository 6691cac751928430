"""Findings about a description, as data; report.py makes text and JSON of them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

Severity = Literal["error", "warning"]


class Span:
    """A place in a file: its path as the user named it, and line and column from 1; `width` characters are meant.

    A place may be `sought`: nobody asks for most places, so line and column are found when somebody does.
    """

    __slots__ = ("_at", "_find", "file", "width")

    def __init__(self, file: str, line: int, column: int, width: int = 1) -> None:
        self.file, self.width = file, width
        self._at = line, column
        self._find: Callable[[], tuple[int, int]] | None = None

    @classmethod
    def sought(cls, file: str, find: Callable[[], tuple[int, int]], width: int = 1) -> Span:
        """The place that `find` finds."""
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
        """The place so many columns further on, with another width if one is given."""
        width = self.width if width is None else width
        return Span.sought(self.file, lambda: (self.line, self.column + columns), width)

    def in_file(self, name: str) -> Span:
        """The same place in a file that has another name."""
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
    """One finding: a stable rule id, what is wrong, where, what to do about it, and other places that matter."""

    rule: str
    message: str
    span: Span
    hint: str | None = None
    related: tuple[tuple[Span, str], ...] = ()
    severity: Severity = "error"


MOST_FINDINGS = 1000
"""Findings that one report keeps: nobody reads more, and hostile input must not cost more."""


class Report:
    """All findings of a run. Stages add to it, drop what is broken and go on."""

    __slots__ = ("_findings",)

    def __init__(self) -> None:
        self._findings: dict[Diagnostic, None] = {}

    def error(
        self, rule: str, message: str, span: Span, hint: str | None = None, related: Iterable[tuple[Span, str]] = ()
    ) -> None:
        """Add an error; the same finding counts once."""
        self._add(Diagnostic(rule, _clean(message), span, hint and _clean(hint), tuple(related)))

    def warning(self, rule: str, message: str, span: Span, hint: str | None = None) -> None:
        """Add a warning: worth a look, but it does not stop the compilation."""
        self._add(Diagnostic(rule, _clean(message), span, hint and _clean(hint), (), "warning"))

    def extend(self, other: Report) -> None:
        """Add everything that another report found."""
        self._findings.update(other._findings)

    def also(self, span: Span, text: str) -> Report:
        """The same findings, each with a further place that matters, unless that is its own place."""
        result = Report()
        for finding in self._findings:
            elsewhere = (finding.span.file, finding.span.at) != (span.file, span.at)
            result._add(finding._replace(related=(*finding.related, (span, text))) if elsewhere else finding)
        return result

    def in_files(self, name_of: Callable[[str], str]) -> Report:
        """The same findings with other names of their files."""
        result = Report()
        for finding in self._findings:
            related = tuple((span.in_file(name_of(span.file)), text) for span, text in finding.related)
            result._add(finding._replace(span=finding.span.in_file(name_of(finding.span.file)), related=related))
        return result

    @property
    def findings(self) -> tuple[Diagnostic, ...]:
        """All findings by file and place, errors before warnings of the same place."""
        return tuple(
            sorted(self._findings, key=lambda finding: (finding.span, finding.severity, finding.rule, finding.message))
        )

    @property
    def count(self) -> int:
        """How many findings there are."""
        return len(self._findings)

    @property
    def has_errors(self) -> bool:
        """Whether one of the findings is an error, so that nothing may be compiled."""
        return any(finding.severity == "error" for finding in self._findings)

    @property
    def full(self) -> bool:
        """Whether there are so many findings that no more are kept, so that checks may stop."""
        return len(self._findings) >= MOST_FINDINGS

    def _add(self, finding: Diagnostic) -> None:
        if not self.full:
            self._findings.setdefault(finding)


def _clean(text: str) -> str:
    """The text without line breaks, control and bidi characters: it may quote a stranger's file on a terminal."""
    if text.isprintable():
        return text
    from fieldscribe.text import line

    return line(text)
