"""A description's claims held against a manual's text."""

from __future__ import annotations

import re
from collections import Counter
from functools import cached_property
from typing import TYPE_CHECKING

from fieldscribe.audit.facts import Facts
from fieldscribe.audit.instead import instead
from fieldscribe.audit.labels import Standing, standing
from fieldscribe.audit.outcome import Missing, Uncited, Unused
from fieldscribe.audit.places import nearly_all

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Iterator

    from fieldscribe.audit.citing import Claim
    from fieldscribe.audit.manual import Extent, Token
    from fieldscribe.audit.outcome import Audit

_SHORT = 100
"""Findings show at most so many characters of a line."""
_LISTED = 4
"""So many labels are a list: where nearly all of them stand, all have to."""
_COMPOUND = re.compile(r"-[^\W\d]{2,}")
"""What makes a number part of a word: `16-bit`."""
_CAPTION = re.compile(
    r"[\s*_]*(?:Abbildung|Abb\.|Bild|Tabelle|Tab\.|Figure|Fig\.|Picture|Table)\s+[0-9]+(?:[-.][0-9]+)*\s*[:.\u2013-]",
    re.I,
)
"""What counts a picture or a table is no fact."""
_FEWEST_LOST, _LOST = 4, 0.5
"""A place is lost where so many facts of a subject are missing, such a share of all, and nearly all its names."""
_LISTS = ("enum", "flags", "flag values", "answers", "refusals")
_LONGEST_MERGED = 10
"""A fact that rows share is printed once, in a cell merged with those below: it is missed once."""


class Comparison(Facts):
    """The state of one audit: what is absent, and which numbers were used."""

    def run(self, held: Collection[Claim] = ()) -> Audit:
        """All findings, but for claims that are known to hold."""
        self._held = held
        labels: dict[tuple[str, str, tuple[tuple[int, int], ...]], list[Claim]] = {}
        for claim in self.claims:
            if claim.entry is None and not claim.beside and claim.fact != "title":
                self._check(claim)
            else:
                labels.setdefault((claim.subject, claim.fact, claim.cited), []).append(claim)
        for together in labels.values():
            self._check_labels(together)
        strays = self.columns.strays(
            lambda extent: len(self.subjects[extent]) > 1, lambda claim, extent: self._is_taken(claim, [extent])
        )
        for claim, extent in (*strays, *self.siblings.lacking(lambda extent: len(self.subjects[extent]))):
            if all(claim is not absent for absent, _ in self.absent):
                self._misses(claim, [extent])
        for erratum in self.errata:
            self._check_erratum(erratum)
        self._unused()
        self._report_absent()
        self._uncited()
        self.outcome.facts = sum(not claim.optional for claim in self.claims)
        self.outcome.errata = len(self.errata)
        return self.outcome

    def _check_labels(self, claims: list[Claim]) -> None:
        """Labels of one list are looked for together: beside their numbers, in their order."""
        extents = self._cited_by(claims[0])
        for claim in claims[1:]:
            self._cited_by(claim)
        places = [(extent, self._standing(claims, extent)) for extent in extents]
        for extent, here in places:
            for label in here:
                self.columns.note_columns(label.claim, extent, self._columns_of(label, extent))
                if label.claim.fact == "title":
                    self.columns.note_heading(label.claim, extent, self._stands_in_heading(label.claim, extent))
        labels = [label for _, here in places for label in here]
        self._use(token for label in labels for token in label.tokens)
        self.added += (token for extent, here in places for token in self._added_to(here, extent))
        stands = {label.claim for label in labels}
        for extent, here in places:
            listed = {label.claim for label in here}
            if len(claims) >= _LISTED and nearly_all([claim in listed for claim in claims]):
                stands -= {claim for claim in stands - listed if not self._is_added(claim, extent)}
        masks = [claim for claim in stands if claim.fact == "flags" and not claim.words]
        for passage in (self._own_passage(claims[0], extent) for extent in extents):  # 0x0001 may be any 1 of the list
            self._use(token for mask in masks for token in passage.reading(mask.numbers))
        for claim in claims:
            if claim not in stands and not any(self._stands_in_line(claim, extent) for extent in extents):
                self._misses(claim, extents)

    def _stands_in_line(self, claim: Claim, extent: Extent) -> bool:
        """Whether a place prints a flag's value in a line of its own: `Bit 8 = 0: input 4 not delayed`."""
        return any(
            self._stands(line, extent)
            for line in self._claims_in[extent, claim.fact]
            if line.in_order and line.words and line.place == claim.place
            if line.in_order[-1] == claim.beside or (not claim.words and line.in_order[0] <= claim.numbers)
        )

    def _added_to(self, labels: list[Standing], extent: Extent) -> Iterator[Token]:
        """The number right behind the last label of an enum, if it is the next one and has a label, too."""
        listed = [label for label in labels if label.claim.fact == "enum" and label.claim.beside]
        if len(listed) < 2:
            return
        passage, end = self._own_passage(listed[0].claim, extent), max(label.end for label in listed)
        token = passage.after(end)
        highest = max(number for label in listed for number in label.claim.beside)
        if token is not None and highest + 1 in token.readings and passage.follows_as_entry(token, end):
            yield token

    def _columns_of(self, label: Standing, extent: Extent) -> set[int | None]:
        """The column of a label, or all in which a title stands."""
        passage = self._own_passage(label.claim, extent)
        titles = [first for word in label.claim.words for first, _ in passage.places(word)]
        return {passage.column(place) for place in ([label.place] if label.claim.beside else titles or [label.place])}

    def _stands_in_heading(self, claim: Claim, extent: Extent) -> bool:
        """Whether a title stands in the first line of its place."""
        passage = self.passage(extent)
        end = len(self.manual.line(extent.first))
        return any(place <= end for word in claim.words for _, place in passage.places(word))

    def _standing(self, claims: list[Claim], extent: Extent) -> list[Standing]:
        """The labels that stand in a place, or in the claims' own part of it."""
        return standing(claims, self._own_passage(claims[0], extent))

    def _cited_by(self, claim: Claim) -> list[Extent]:
        extents = [self.extent(*cited) for cited in claim.cited]
        for extent in extents:
            self.subjects.setdefault(extent, {}).setdefault(claim.subject, claim.where)
            self.siblings.note(claim, extent, self.passage(extent).folded)
        return extents

    def _check(self, claim: Claim) -> None:
        extents = self._cited_by(claim)
        stands = [self._stands(claim, extent) for extent in extents]  # no short cut: each call marks the numbers used
        enough = all(stands) if claim.fact == "code" else sum(stands) >= claim.times
        expected = not claim.optional or any(self._prints_alike(claim, extent) for extent in extents)
        if (not enough and expected) or any(self._lists_another(claim, extent) for extent in extents):
            self._misses(claim, extents)

    def _misses(self, claim: Claim, extents: list[Extent]) -> None:
        if claim in self._held or self._is_taken(claim, extents):
            return
        self.absent.append((claim, extents))

    def _report_absent(self) -> None:
        """What does not stand where it is cited, with what stands there instead."""
        numbers = self.outcome.unused
        unused = {extent: [number for number in numbers if number.line in extent] for extent in self.subjects}
        told: set[Unused] = set()
        nearby: dict[tuple[str, str, str | None], Missing] = {}
        told_once = list(self._without_repetition())
        lost = self._lost_together([claim for claim, _ in told_once])
        subjects = {claim.subject for claim in lost}
        for claim, extents in told_once:
            gone = lost.get(claim, [claim])
            if claim is not gone[0]:
                continue
            there = [number for extent in extents for number in unused[extent]]
            printed = instead(claim, [self.passage(extent) for extent in extents], there)
            told.update(number for number in there if number.number == printed)
            first, last = extents[0].first, extents[0].last
            nearest = None if printed else self._nearest(claim, first)
            shown = claim.shown
            if claim.fact in _LISTS and len(gone) > 1:
                shown = ", ".join(one.shown for one in gone[:_LISTED]) + (", ..." if len(gone) > _LISTED else "")
            missing = Missing(claim.subject, claim.fact, shown, first, last, nearest, claim.where, printed)
            missing.lost = len(gone)
            if len(gone) > 1:  # what stands there now is not of this subject
                told.update(number for number in there if subjects.issuperset(number.subjects))
            same = (claim.fact, shown, printed)
            if same in nearby and first - nearby[same].last <= _LONGEST_MERGED:
                nearby[same].spread(missing)
            else:
                nearby[same] = missing
                self.outcome.missing.append(missing)
        self.outcome.unused = [number for number in numbers if number not in told]

    def _lost_together(self, missing: Iterable[Claim]) -> dict[Claim, list[Claim]]:
        """What is missing together, by each of its facts: nearly all of a subject, its name first; most of a list."""
        absent: dict[tuple[str, tuple[tuple[int, int], ...]], list[Claim]] = {}
        of_list: dict[tuple[str, tuple[tuple[int, int], ...], str], list[Claim]] = {}
        for claim in missing:
            if not claim.optional:
                absent.setdefault((claim.subject, claim.cited), []).append(claim)
            if claim.fact in _LISTS:
                of_list.setdefault((claim.subject, claim.cited, claim.fact), []).append(claim)
        stated = Counter((claim.subject, claim.cited) for claim in self.claims if not claim.optional)
        anchors = Counter((claim.subject, claim.cited) for claim in self.claims if claim.anchor)
        listed = Counter((claim.subject, claim.cited, claim.fact) for claim in self.claims)
        gone = (claims for key, claims in of_list.items() if len(claims) >= min(_LISTED, listed[key]))
        lost = {claim: claims for claims in gone for claim in claims}
        for key, claims in absent.items():
            is_lost = _FEWEST_LOST <= len(claims) >= _LOST * stated[key]
            if is_lost and sum(claim.anchor for claim in claims) >= anchors[key] - (anchors[key] > 1):
                lost |= dict.fromkeys(claims, sorted(claims, key=lambda claim: not claim.anchor))
        return lost

    def _without_repetition(self) -> Iterator[tuple[Claim, list[Extent]]]:
        """What is absent, without what only tells the same of a thing in another way."""
        told = {(claim.subject, claim.where) for claim, _ in self.absent if not claim.optional}
        for claim, extents in self.absent:
            if not claim.optional or (claim.subject, claim.where) not in told:
                told.add((claim.subject, claim.where))
                yield claim, extents

    def _nearest(self, claim: Claim, line: int) -> int | None:
        places: Iterable[int] = ()
        if claim.numbers:
            places = [place for number in claim.numbers for place in self.manual.lines_of.get(number, ())]
        elif claim.words:
            places = self.manual.lines_with(claim.words[0])
        return min(places, key=lambda place: (abs(place - line), place), default=None)

    def _unused(self) -> None:
        self.strays: set[tuple[int, int]] = set()
        self.used -= {(token.line, token.column) for token in self.added}
        passed_over = self.empty | self.manual.page_lines
        for extent, subjects in self.subjects.items():
            place = next(iter(subjects.values()))
            for line in (number for number in range(extent.first, extent.last + 1) if number not in passed_over):
                for column, text in self._without_fact(line):
                    if (line, column) not in self.used:
                        self.used.add((line, column))
                        self.strays.add((line, column))
                        self.outcome.unused.append(Unused(line, column, text, tuple(subjects), place))
        self.outcome.unused.sort(key=lambda unused: (unused.line, unused.column))

    def _without_fact(self, line: int) -> Iterator[tuple[int, str]]:
        """The numbers of a line, and the words that look like codes but are none of the description."""
        passed_over = self.codes | self.no_facts.get(line, frozenset())
        text = self.manual.line(line)
        for token in self._of_line(line):
            if (
                token.text not in passed_over
                and not is_of_caption(text, token.column)
                and not _COMPOUND.match(text, token.column - 1 + len(token.text))
            ):
                yield token.column, token.text
        for match in self._code_forms.finditer(self.manual.line(line)):
            if match[0] not in passed_over and (line, match.start() + 1) not in self.used:
                yield match.start() + 1, match[0]

    @cached_property
    def _code_forms(self) -> re.Pattern[str]:
        """Letters and at least three digits, as some code of the description has them."""
        codes = [code for code in self.codes if re.fullmatch("[A-Za-z]+[0-9]{3,}", code)]
        forms = {re.sub("[0-9]", "[0-9]", code) for code in codes}
        return re.compile(rf"(?<!\w)(?:{'|'.join(sorted(forms))})(?!\w)" if forms else "(?!)")

    def _uncited(self) -> None:
        covered = {line for extent in self.subjects for line in range(extent.first, extent.last + 1)}
        cited = [self.extent(first, last or first) for erratum in self.errata for first, last in erratum.cited]
        covered |= {line for extent in cited for line in range(extent.first, extent.last + 1)}
        covered |= self.empty
        manual = self.manual
        for line in manual.headings:
            section = manual.section_of(line)
            if not any(number in covered for number in range(section.first, section.last + 1)):
                self.outcome.uncited.append(Uncited(line, line, "section", manual.line(line).strip()[:_SHORT]))
        rows = (line for line in range(1, len(manual) + 1) if line not in manual.page_lines and line not in covered)
        for first, last in _runs(line for line in rows if manual.is_row(line) and manual.tokens[line - 1]):
            section = manual.section_of(first)
            among_cited = any(number in covered for number in range(section.first, section.last + 1))
            shown = manual.line(first).strip()[:_SHORT]
            self.outcome.uncited.append(Uncited(first, last, "row", shown, among_cited=among_cited))
        self.outcome.uncited.sort(key=lambda uncited: uncited.line)


def is_of_caption(text: str, column: int) -> bool:
    """Whether a place of a line is in what counts a picture or a table: `Figure 2-1:`."""
    caption = _CAPTION.match(text)
    return caption is not None and column <= caption.end()


def _runs(lines: Iterable[int]) -> Iterator[tuple[int, int]]:
    """The first and last of lines that follow each other."""
    first = last = 0
    for line in lines:
        if line != last + 1:
            if first:
                yield first, last
            first = line
        last = line
    if first:
        yield first, last
