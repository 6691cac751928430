"""What a description cites, in the lines of both editions.

A description counts the lines of the old edition until it is renumbered; what was written meanwhile may count those of
the new one. Which of them a subject means is where more of its facts stand.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, TypeVar

from fieldscribe.audit.citing import Claim, spans_of
from fieldscribe.audit.claims import by_line, claims_of, listed_in
from fieldscribe.audit.editions.tracing import Trace
from fieldscribe.audit.places import Asked
from fieldscribe.audit.printed_errata import PrintedErratum, printed_errata_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from fieldscribe.audit.editions.changes import Editions, Lines
    from fieldscribe.audit.editions.words import Words
    from fieldscribe.audit.manual import Manual
    from fieldscribe.diagnostics import Span
    from fieldscribe.language.nodes import Map
    from fieldscribe.resolve.analysis import Analysis

    Where = Callable[[int], Lines | None]

T = TypeVar("T", Claim, PrintedErratum)


@dataclass(frozen=True, slots=True)
class LookedThrough:
    """Lines that the description says hold nothing for it, or only these texts besides facts; where it says so."""

    lines: frozenset[int]
    numbers: frozenset[str]
    place: Span
    spans: tuple[tuple[int, int], ...]
    """The lines (first, last) as they are written."""
    beside: frozenset[str] = frozenset()
    """The points of the same group."""


@dataclass(slots=True)
class Cited:
    """What is cited, in the lines of one edition; nothing for what cites lines that this edition does not have."""

    claims: list[Claim | None]
    errata: list[PrintedErratum | None]
    looked_through: list[LookedThrough]

    def trace(self, manual: Manual, text: Words) -> Trace:
        """All of it held against the text."""
        claims = list(dict.fromkeys(claim for claim in self.claims if claim is not None))
        errata = [erratum for erratum in self.errata if erratum is not None]
        passed_over = by_line((line, passage.numbers) for passage in self.looked_through for line in passage.lines)
        return Trace(text, manual, Asked(claims, errata, passed_over))


class Citations:
    """All citations of a description. `counts_new` are the subjects and errata that count lines of the new edition."""

    def __init__(self, subject: Analysis, editions: Editions) -> None:
        self.editions = editions
        self.claims = list(dict.fromkeys(claims_of(subject)))
        self.errata = list(printed_errata_of(subject))
        self.looked_through = list(_passages_of(subject.scope.files))
        self.place_of_erratum = {erratum.erratum.id: erratum.node.span("id") for erratum in subject.errata}
        self.counts_new: set[str] = set()
        self.all_count_new = False

    def settle(self, old: Manual, new: Manual, *, accepted: bool) -> None:
        """Find out which subjects count lines of the new edition; `accepted`: whether its digest is recorded."""
        if self.is_unmoved:
            return
        lines = self._lines_of_subjects()
        now, then = self.editions.now, self.editions.then
        in_old, in_new = self.editions.old, self.editions.new
        as_old = self._least(lines, self._misses(old, in_old), self._misses(new, in_new, _of_words(in_old, now)))
        as_new = self._least(lines, self._misses(new, in_new), self._misses(old, in_old, _of_words(in_new, then)))
        fit_new = {name for name in lines if as_new[name] < as_old[name]}
        fit_old = {name for name in lines if as_old[name] < as_new[name]}
        renumbered = sum(any(then(line) is not None for line in lines[name]) for name in fit_new)
        left = sum(any(now(line) != (line, line) for line in lines[name]) for name in fit_old)
        self.all_count_new = accepted or renumbered > left
        self.counts_new = set(lines) if self.all_count_new else fit_new

    def _lines_of_subjects(self) -> dict[str, set[int]]:
        """The lines that each subject and each erratum cites first."""
        lines: dict[str, set[int]] = {}
        for claim in self.claims:
            lines.setdefault(claim.subject, set()).update(first for first, _ in claim.cited)
        for erratum in self.errata:
            lines.setdefault(erratum.id, set()).update(first for first, _ in erratum.cited)
        return lines

    @property
    def is_unmoved(self) -> bool:
        """Whether all cited lines have the same number in both editions."""
        cited = [*(claim.cited for claim in self.claims), *(erratum.cited for erratum in self.errata)]
        lines = {line for spans in cited for span in spans for line in span if line}
        lines |= {line for passage in self.looked_through for line in passage.lines}
        return all(self.editions.now(line) in (None, (line, line)) for line in lines)

    @staticmethod
    def _least(names: Iterable[str], before: Counter[str], after: Counter[str]) -> dict[str, int]:
        """What is missed with the lines of one edition, whether a subject was edited for the new edition or not yet."""
        return {name: min(before[name], after[name]) for name in names}

    def _misses(self, manual: Manual, text: Words, there: Where | None = None) -> Counter[str]:
        """How much of each subject does not stand in a text at the lines that are cited, or `there` from these."""
        claims = [claim if there is None else moved(claim, there) for claim in self.claims]
        errata = [erratum if there is None else moved(erratum, there) for erratum in self.errata]
        trace = Cited(claims, errata, []).trace(manual, text)
        gone = [claim.subject for claim, place in zip(self.claims, claims, strict=True) if place is None]
        gone += [erratum.id for erratum, place in zip(self.errata, errata, strict=True) if place is None]
        return Counter(claim.subject for claim in trace.missed) + Counter(trace.void) + Counter(gone)

    def in_old(self) -> Cited:
        """Everything in the lines of the old edition."""
        then = self.editions.then
        return Cited(
            [moved(claim, then) if claim.subject in self.counts_new else claim for claim in self.claims],
            [moved(erratum, then) if erratum.id in self.counts_new else erratum for erratum in self.errata],
            [
                _with_lines(passage, then, self.editions.new) if self.is_of_new(passage) else passage
                for passage in self.looked_through
            ],
        )

    def in_new(self) -> Cited:
        """Everything in the lines of the new edition."""
        now = self.editions.now
        return Cited(
            [claim if claim.subject in self.counts_new else moved(claim, now) for claim in self.claims],
            [erratum if erratum.id in self.counts_new else moved(erratum, now) for erratum in self.errata],
            [
                passage if self.is_of_new(passage) else _with_lines(passage, now, self.editions.old)
                for passage in self.looked_through
            ],
        )

    def is_of_new(self, passage: LookedThrough) -> bool:
        """Whether lines that were looked through are counted as in the new edition.

        They are if all points of their group do, or if all of them are new and have the numbers, and if in the old
        edition facts or other passages cite all of them.
        """
        if self.all_count_new or (passage.beside and passage.beside <= self.counts_new):
            return True
        editions = self.editions
        news = {line for line in passage.lines if editions.new.of_line(line)}
        olds = {line for line in passage.lines if editions.old.of_line(line)}
        if not news or not news <= editions.changed_new:
            return False
        if not all(any(number in editions.new.lines[line - 1] for line in news) for number in passage.numbers):
            return False
        others = (other.lines for other in self.looked_through if other is not passage)
        cited = {first for claim in self.claims for first, _ in claim.cited}
        return olds <= cited.union(*others)

    def counts_new_at(self, place: Span, first: int, last: int) -> bool:
        """Whether lines that are cited at a place in the files are those of the new edition.

        The place belongs to the subject that cites these lines and stands nearest above, or else nearest.
        """
        if self.all_count_new:
            return True
        passage = next((passage for passage in self.looked_through if place == passage.place), None)
        if passage is not None:
            return self.is_of_new(passage)
        if not self.counts_new:
            return False
        subjects = [(claim.place, claim.subject) for claim in self.claims if (first, last) in claim.cited]
        subjects += [(self.place_of_erratum[erratum.id], erratum.id) for erratum in self.errata]
        beside = [(_distance(place, other), name) for other, name in subjects if other.file == place.file]
        return bool(beside) and min(beside)[1] in self.counts_new

    def gone(self) -> Iterator[tuple[Claim | PrintedErratum, int]]:
        """What cites a line of the old edition that the new one does not have, with that line."""
        for claim in self.claims:
            yield from ((claim, line) for line in self._gone(claim.subject, claim.cited))
        for erratum in self.errata:
            yield from ((erratum, line) for line in self._gone(erratum.id, erratum.cited))

    def gone_passages(self) -> Iterator[tuple[LookedThrough, int]]:
        """Lines that were looked through of which the new edition has none, with the first of them."""
        for passage in (passage for passage in self.looked_through if not self.is_of_new(passage)):
            for first, last in passage.spans:
                lines = [line for line in range(first, max(first, last) + 1) if self.editions.old.of_line(line)]
                if lines and all(self.editions.now(line) is None for line in lines):
                    yield passage, lines[0]

    def _gone(self, name: str, cited: Iterable[tuple[int, int]]) -> list[int]:
        if name in self.counts_new:
            return []
        return [first for first, last in cited if span_there(first, last, self.editions.now) is None]


def _passages_of(files: Iterable[Map]) -> Iterator[LookedThrough]:
    """What the description says under `looked_through`."""
    for file in files:
        beside = frozenset(str(point.get("name")) for point in file.get("points", ()))
        for passage in file.get("looked_through", ()):
            spans = list(spans_of(passage["lines"]))
            lines = frozenset(line for first, last in spans for line in range(first, max(first, last) + 1))
            yield LookedThrough(lines, listed_in(passage), passage.span("lines"), tuple(spans), beside)


def _distance(place: Span, other: Span) -> tuple[bool, int]:
    return other.at > place.at, abs(place.line - other.line)


def span_there(first: int, last: int, there: Where) -> Lines | None:
    """The same lines in another edition; `last` is 0 where the line opens a row or section."""
    if not last:
        place = there(first)
        return None if place is None else (place[0], 0)
    places = [place for line in range(first, last + 1) if (place := there(line)) is not None]
    if not places:
        return None
    return min(places[0][0], places[-1][0]), max(places[0][1], places[-1][1])


def moved(item: T, there: Where) -> T | None:
    """The same with its lines in another edition; None if that has none of them."""
    cited = tuple(span for first, last in item.cited if (span := span_there(first, last, there)) is not None)
    return replace(item, cited=cited) if cited else None


def _of_words(text: Words, there: Where) -> Where:
    """The same for lines that have words: no fact stands on others."""
    return lambda line: there(line) if text.of_line(line) else None


def _with_lines(passage: LookedThrough, there: Where, text: Words) -> LookedThrough:
    spans = [place for line in passage.lines if text.of_line(line) and (place := there(line)) is not None]
    lines = frozenset(line for first, last in spans for line in range(first, last + 1))
    return replace(passage, lines=lines)
