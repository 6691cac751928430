"""A description held against two editions of its manual: what changed, whom it touches, and what is not explained."""

from __future__ import annotations

from bisect import bisect_right
from collections import Counter
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import TYPE_CHECKING

from fieldscribe.audit.citing import Claim
from fieldscribe.audit.editions.changes import Editions
from fieldscribe.audit.editions.citations import Citations
from fieldscribe.audit.editions.drafts import Drafts
from fieldscribe.audit.editions.explaining import Explaining, failing
from fieldscribe.audit.editions.findings import Cite, Comparison, Doubt, Finding, Place, Reason, Void
from fieldscribe.audit.editions.holding import Pair
from fieldscribe.audit.editions.joining import joined, said_once, with_elsewhere, with_void
from fieldscribe.audit.editions.notes import Notes
from fieldscribe.audit.editions.remarks import Remarks, is_reworded
from fieldscribe.audit.editions.vocabulary import Vocabulary
from fieldscribe.audit.editions.words import LINE_BREAK, Words
from fieldscribe.audit.manual import Manual
from fieldscribe.audit.wordings import Wordings

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from fieldscribe.audit.editions.changes import Change, Move
    from fieldscribe.audit.editions.tracing import Trace
    from fieldscribe.audit.manual import Extent
    from fieldscribe.audit.printed_errata import PrintedErratum
    from fieldscribe.diagnostics import Span
    from fieldscribe.resolve.analysis import Analysis

_NO_WORDS: Mapping[str, str] = MappingProxyType({})


@dataclass(frozen=True, slots=True)
class Edition:
    """The text of one edition: its file's name, and whether it is the one whose digest the description records."""

    name: str
    text: str
    is_recorded: bool | None


def compare(
    subject: Analysis,
    old: Edition,
    new: Edition,
    glossary: Mapping[str, str] = _NO_WORDS,
    held: frozenset[str] = frozenset(),
) -> tuple[Comparison, Citations]:
    """What the new edition means for the description, and what that cites.

    The glossary gives drafts English titles, `held` are the errata that somebody says still hold.
    """
    editions = Editions(old.text, new.text)
    citations = Citations(subject, editions)
    names = Wordings(subject.scope.header["documents"]).names
    manuals = Manual(old.text, names), Manual(new.text, names)
    citations.settle(*manuals, accepted=bool(new.is_recorded))
    device = str(subject.scope.header["device"])
    outcome = Comparison(device, old.name, new.name, old.is_recorded, new.is_recorded, editions.counts())
    _Comparing(subject, citations, manuals, outcome, glossary).run(held)
    return outcome, citations


class _Comparing:
    def __init__(
        self,
        subject: Analysis,
        citations: Citations,
        manuals: tuple[Manual, Manual],
        outcome: Comparison,
        glossary: Mapping[str, str],
    ) -> None:
        old, new = manuals
        self.citations, self.editions, self.outcome = citations, citations.editions, outcome
        in_old, in_new = citations.in_old(), citations.in_new()
        self.old = in_old.trace(old, self.editions.old)
        self.new = in_new.trace(new, self.editions.new)
        pairs = list(map(Pair, citations.claims, in_old.claims, in_new.claims))
        self._looked_through = in_new.looked_through
        self.errata = list(zip(citations.errata, in_old.errata, in_new.errata, strict=True))
        self.drafts = Drafts(subject, self.editions, pairs, glossary)
        self.notes = Notes(subject, self.old, self.editions)
        places = {line: _told(passage.place) for passage in self._looked_through for line in passage.lines}
        self.explaining = Explaining(self.editions, (self.old, self.new), pairs, Vocabulary(subject), places)

    def run(self, held: frozenset[str]) -> None:
        """All findings, in the order of the new edition, and what else is told; `held` are errata that still hold."""
        outcome, editions = self.outcome, self.editions
        self._beside = sorted(self._places_by_line().items())
        reasons: dict[int, list[Reason]] = {}
        for number, reason in self._of_gone_lines():
            reasons.setdefault(number, []).append(reason)
        findings = [
            self._finding(number, change, (*reasons.get(number, ()), *self.explaining.reasons(number, change)))
            for number, change in enumerate(editions.changes)
        ]
        told = list(zip(editions.changes, findings, strict=True))
        findings = joined(sorted((*findings, *map(self._of_move, editions.moves)), key=self._order))
        findings = list(map(self.explaining.swapped, findings))
        elsewhere = [*reasons.get(-1, ()), *(failing(pair.claim) for pair in self.explaining.holding.elsewhere)]
        findings, outcome.elsewhere = with_elsewhere(findings, elsewhere)
        findings, outcome.void = with_void(findings, self._void())
        bearing = set().union(*self.old.borne.values()), set().union(*self.new.borne.values())
        outcome.findings, outcome.remarks = Remarks(editions, self.new.manual, bearing).sort(findings)
        passed_over = {place for remark in outcome.remarks if remark.kind != "wording" for place in remark.places}
        outcome.notes = self.notes.stale((change, one) for change, one in told if one.places[0] not in passed_over)
        outcome.doubts = list(self._doubts(held))
        outcome.shifted = self._shifted()
        outcome.renumbered = self.citations.all_count_new

    def _of_gone_lines(self) -> Iterator[tuple[int, Reason]]:
        """What cites lines that are gone, with the number of the change that took them away, -1 if none is known."""
        for item, line in self.citations.gone():
            name, place = (item.subject, item.where) if isinstance(item, Claim) else self._named(item)
            yield self._gone_line(name, line, place)
        for passage, line in self.citations.gone_passages():
            yield self._gone_line("looked_through", line, _told(passage.place))

    def _gone_line(self, name: str, line: int, place: str) -> tuple[int, Reason]:
        changes = (number for number, change in enumerate(self.editions.changes) if line in change.old)
        return next(changes, -1), Reason("gone", f": cited line {line} is gone", place, (name,))

    def _named(self, erratum: PrintedErratum) -> tuple[str, str]:
        return f"erratum {erratum.id}", _told(self.citations.place_of_erratum[erratum.id])

    def _finding(self, number: int, change: Change, reasons: Iterable[Reason]) -> Finding:
        olds, news = self.editions.old, self.editions.new
        reasons = said_once(reasons)
        cites = (*self.explaining.cites(number, change), *self._errata_at(change), *self._looked_through_at(change))
        return Finding(
            change.kind,
            (Place(_ends(change.old), _ends(change.new)),),
            _shown(olds.lines, change.old),
            _shown(news.lines, change.new),
            _starts(olds, change.old, [old for old, _ in change.gaps]),
            _starts(news, change.new, [new for _, new in change.gaps]),
            self._words(change),
            tuple(dict.fromkeys(cites)),
            reasons,
            tuple(self.drafts.of(change.new)) if reasons else (),
            "" if cites else self._place_above(change),
        )

    def _words(self, change: Change) -> tuple[tuple[str, str], ...]:
        """The words that were changed, numbers whole."""
        olds, news = self.editions.old, self.editions.new
        pairs: dict[tuple[range, range], None] = {}
        for old, new in change.gaps:
            pairs[(olds.whole(old), news.whole(new)) if old and new else (old, new)] = None
        return tuple((olds.shown(old), news.shown(new)) for old, new in pairs)

    def _places_by_line(self) -> dict[int, str]:
        """Where the description says what stands on each cited line of the new edition."""
        places: dict[int, str] = {}
        for extent, subjects in self.new.subjects.items():
            for name in subjects:
                places.setdefault(extent.first, self.explaining.place_of.get(name, ""))
        return {line: place for line, place in places.items() if place}

    def _place_above(self, change: Change) -> str:
        """Where the description says what stands above lines that nothing cites; the first place if nothing does."""
        line = change.new[0] if change.new else self._order_of_old(change.old[0])
        at = bisect_right(self._beside, line, key=lambda item: item[0])
        return self._beside[max(0, at - 1)][1] if self._beside else ""

    def _order(self, finding: Finding) -> tuple[int, int]:
        """Where a finding stands in the new edition; what was removed, below what stood above it."""
        if finding.new is not None:
            return finding.new
        assert finding.old is not None
        return self._order_of_old(finding.old[0]), len(self.editions.new.lines) + 1

    def _order_of_old(self, line: int) -> int:
        return next((place[1] for above in range(line - 1, 0, -1) if (place := self.editions.now(above))), 0)

    def _doubts(self, held: frozenset[str]) -> Iterator[Doubt]:
        """The errata in words that cite lines of findings and are not void, but for those that are said to hold."""
        void = {void.erratum for finding in self.outcome.findings for void in finding.void}
        worded = [finding for remark in self.outcome.remarks for finding in remark.findings if is_reworded(finding)]
        for erratum in self.citations.errata:
            if not erratum.is_sentence or erratum.id in void | held:
                continue
            name, place = self._named(erratum)
            lines = [
                finding.new or finding.old
                for finding in (*self.outcome.findings, *worded)
                if finding.kind != "moved" and any(cite.subject == name for cite in finding.cited_by)
            ]
            if lines:
                yield Doubt(erratum.id, place, tuple(ends for ends in lines if ends))

    def _errata_at(self, change: Change) -> Iterator[Cite]:
        for erratum, in_old, in_new in self.errata:
            olds = [self._paragraph(self.old, *span) for span in in_old.cited] if in_old else []
            news = [self._paragraph(self.new, *span) for span in in_new.cited] if in_new else []
            at = any(line in extent for extent in olds for line in change.old)
            if at or any(self._is_of(extent, change) for extent in news):
                name, place = self._named(erratum)
                yield Cite(name, "", "", place)

    @staticmethod
    def _paragraph(trace: Trace, first: int, last: int) -> Extent:
        """What an erratum speaks of: a section by its heading, an entry of a list, else the lines up to a blank one."""
        extent = trace.extent(first, last)
        if last or extent.kind == "section":
            return extent
        lines = range(extent.first + 1, extent.last + 1)
        entries = trace.text.entries if extent.first in trace.text.entries else ()
        end = next((line for line in lines if line in entries or not trace.manual.line(line).strip()), lines.stop)
        return replace(extent, last=end - 1)

    def _is_of(self, extent: Extent, change: Change) -> bool:
        """Whether a change is in these lines: what was added is if some of them stand below it, too."""
        if change.kind == "added" and change.new[0] - 1 in extent and self.editions.new.goes_on(change.new[0]):
            return True
        if not any(line in extent for line in change.new):
            return False
        below = range(change.new[-1] + 1, extent.last + 1)
        return change.kind != "added" or any(self._was_there(line) for line in below)

    def _was_there(self, line: int) -> bool:
        return any(not self.editions.is_new(word) for word in self.editions.new.of_line(line))

    def _looked_through_at(self, change: Change) -> Iterator[Cite]:
        lines = set(change.new)
        for passage, in_new in zip(self.citations.looked_through, self._looked_through, strict=True):
            if lines & in_new.lines:
                yield Cite("looked_through", "", "", _told(passage.place))

    def _of_move(self, move: Move) -> Finding:
        lines = range(move.first, move.last + 1)
        cites: dict[Cite, None] = {}
        for extent, subjects in self.old.subjects.items():
            if extent.first in lines:
                cites.update((Cite(name, "", "", self.explaining.place_of.get(name, "")), None) for name in subjects)
        shown = _shown(self.editions.old.lines, (move.first,))
        now = (move.now, move.now + move.last - move.first)
        return Finding("moved", (Place((move.first, move.last), now),), shown, shown, (0,), (0,), (), tuple(cites), ())

    def _void(self) -> Iterator[Void]:
        """Errata that were printed in the old edition and are not in the new one."""
        for erratum, in_old, in_new in self.errata:
            if in_new is None:
                continue
            if in_old is not None and self._is_mended(in_old, in_new):
                yield Void(erratum.id, self._named(erratum)[1], True, in_new.cited[0][0])
                continue
            if erratum.id not in self.new.void:
                continue
            if in_old is None or not (erratum.id in self.old.void or self._survives(in_old)):
                yield Void(erratum.id, self._named(erratum)[1], self._is_corrected(in_new), in_new.cited[0][0])

    def _is_mended(self, in_old: PrintedErratum, in_new: PrintedErratum) -> bool:
        """Whether what an erratum took came in its lines, and what only the manual printed went."""
        printed, taken = (Counter(Words(text).texts) for text in (in_old.shown, in_old.taken_text))
        if in_old.is_sentence or not (came := taken - printed) or not (went := printed - taken):
            return False
        editions = self.editions
        lines = [range(extent.first, extent.last + 1) for extent in self.old.extents_of(in_old.cited)]
        gone = {
            word for span in lines for line in span for word in editions.old.of_line(line) if editions.is_gone(word)
        }
        lines = [range(extent.first, extent.last + 1) for extent in self.new.extents_of(in_new.cited)]
        new = {word for span in lines for line in span for word in editions.new.of_line(line) if editions.is_new(word)}
        return went <= Counter(editions.old.texts[word] for word in gone) and came <= Counter(
            editions.new.texts[word] for word in new
        )

    def _survives(self, in_old: PrintedErratum) -> bool:
        """Whether all that an erratum names is printed as it was, if in another layout."""
        quotes = [self.old.words_of_quote(quote, in_old) for quote in in_old.texts]
        numbers = [self.old.words_of_number(number, in_old) for number in in_old.numbers]
        return all(any(map(self._is_literal, places)) for places in quotes) and all(
            any(not any(map(self.editions.is_gone, words)) for words in places) for places in numbers
        )

    def _is_literal(self, words: range) -> bool:
        """Whether words are written in the new edition just as they were, but for line breaks and cells."""
        there = [self.editions.there(word) for word in words]
        if min(there) < 0 or there != sorted(there):
            return False
        pieces = (self.editions.old.shown(words), self.editions.new.shown(range(there[0], there[-1] + 1)))
        was, now = (piece.replace("|", " ").replace(LINE_BREAK, " ").split() for piece in pieces)
        return was == now

    def _is_corrected(self, in_new: PrintedErratum) -> bool:
        """Whether the manual prints now what an erratum took."""
        numbers = all(any(self.new.words_of_number(number, in_new)) for number in in_new.taken)
        quotes = bool(in_new.taken) or any(self.new.words_of_quote(in_new.taken_text, in_new))
        return numbers and quotes

    def _shifted(self) -> int:
        counts_old = [claim for claim in self.citations.claims if claim.subject not in self.citations.counts_new]
        lines = {first for claim in counts_old for first, _ in claim.cited}
        places = {line: self.editions.now(line) for line in lines}
        return sum(place is not None and place[0] != line for line, place in places.items())


def _starts(text: Words, lines: tuple[int, ...], gaps: list[range]) -> tuple[int, ...]:
    """Where in each line, as it is shown, the first of the changed words stands, or what took its place."""
    first: dict[int, int] = {}
    for gap in gaps:
        for word in gap or range(gap.start, min(gap.start + 1, len(text))):
            first.setdefault(text.line_of[word], text.column_of[word])
    return tuple(len(" ".join(text.line(line)[: first.get(line, 0)].split())) for line in lines)


def _told(span: Span) -> str:
    return f"{span.file}:{span.line}:{span.column}"


def _ends(lines: tuple[int, ...]) -> tuple[int, int] | None:
    return (lines[0], lines[-1]) if lines else None


def _shown(text: list[str], lines: tuple[int, ...]) -> tuple[str, ...]:
    return tuple(" ".join(text[line - 1].split()) for line in lines)
