"""A description's claims held against a manual's text."""

from __future__ import annotations

import re
from bisect import bisect_left, bisect_right
from collections import Counter
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING

from fieldscribe.audit.claims import claims_of, looked_through_of
from fieldscribe.audit.columns import Columns
from fieldscribe.audit.instead import instead, printed_access
from fieldscribe.audit.labels import Standing, standing
from fieldscribe.audit.manual import Extent, Manual, Token, has_word, places_in
from fieldscribe.audit.outcome import Audit, Missing, Moved, Uncited, Unprinted, Unused
from fieldscribe.audit.passage import Passage
from fieldscribe.audit.placement import placement
from fieldscribe.audit.printed_errata import PrintedErratum, printed_errata_of
from fieldscribe.audit.siblings import Siblings
from fieldscribe.audit.wordings import Wordings

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping

    from fieldscribe.audit.citing import Claim
    from fieldscribe.model import About
    from fieldscribe.resolve.subject import Subject

_SHORT = 100
"""Findings show at most so many characters of a line."""
_RUN = re.compile(r"\bbis\b|\bto\b|\.\.|\u2026|[0-9]\s*[-\u2013]\s*[0-9]")
"""What tells a run of numbers ("0 to 4", "0..4"), with all numbers between its ends."""
_BEHIND_THE_FIRST = ("answers", "refusals")
"""Facts of a code that its row prints behind the code itself."""
_PARTED = ("bits", "fixed bits", "enum", "flags", "flag values")
"""Facts that a place may print anew behind the address of each of its subjects."""
_TAKEN_ANYWHERE = ("code", "range", "enum", "scale")
"""Facts of which an erratum may speak that cites another place."""
_OF_CODES = ("max", "answers", "refusals")
"""Facts that no manual prints with two or three binary digits."""
_NEARLY_ALL = 0.75
"""The share of facts from which on all have to stand alike; of some more one may always be another."""
_LISTED = 4
"""So many labels are a list: where nearly all of them stand, all have to."""
_TOLD = 2
"""A number of so many digits is known as that of a code without its letter."""
_LONGEST_MERGED = 10
"""A fact that rows share is printed once, in a cell merged with those below: it is missed once."""
_FAR = 400
"""A section number that is no heading is searched in at most so many lines above."""


def audit(subject: Subject, device: str, manual_name: str, text: str, *, same_text: bool | None) -> Audit:
    """Everything that does not agree. `same_text`: whether it is the text that was transcribed, None if unknown."""
    return Auditor(subject).audit(device, manual_name, text, same_text=same_text)


def _nearly_all(stand: list[bool], but_one_of: int = 4) -> bool:
    enough = sum(stand) > _NEARLY_ALL * len(stand)
    return enough or (len(stand) >= but_one_of and sum(stand) == len(stand) - 1)


def _are_alike(claim: Claim, other: Claim) -> bool:
    return (claim.subject, claim.alike) == (other.subject, other.alike)


class Asked:
    """What is looked for in a text."""

    def __init__(
        self, claims: list[Claim], errata: list[PrintedErratum], looked_through: Mapping[int, frozenset[str]]
    ) -> None:
        self.claims, self.errata, self.looked_through = claims, errata, looked_through


class Auditor(Asked):
    """What a description takes from its manual, read once for any number of texts."""

    def __init__(self, subject: Subject) -> None:
        claims = list(dict.fromkeys(claims_of(subject)))  # an address printed in three notations is one fact
        super().__init__(claims, list(printed_errata_of(subject)), looked_through_of(subject))
        self.names = Wordings(subject.scope.header["documents"]).names

    def audit(self, device: str, manual_name: str, text: str, *, same_text: bool | None) -> Audit:
        """Everything that does not agree with a text."""
        manual = Manual(text, self.names)
        return Comparison(manual, self, Audit(device, manual_name, same_text, len(manual))).run()


class Comparison:
    """The state of one audit: where cited lines stand now, and which numbers were used."""

    def __init__(self, manual: Manual, asked: Asked, outcome: Audit) -> None:
        claims, errata, looked_through = asked.claims, asked.errata, asked.looked_through
        self.manual, self.claims, self.errata, self.outcome = manual, claims, errata, outcome
        self.used: set[tuple[int, int]] = set()
        self.taken: dict[About, list[PrintedErratum]] = {}
        for erratum in errata:
            for name in erratum.subjects:
                self.taken.setdefault(name, []).append(erratum)
        self.codes = {word for claim in claims if claim.fact == "code" for word in claim.words}
        self.subjects: dict[Extent, dict[str, str]] = {}
        self.absent: list[tuple[Claim, list[Extent]]] = []
        cited = sorted({first for claim in claims for first, _ in claim.cited})
        self.now = {line: line for line in cited} if outcome.same_text else self._moved(cited)
        self.cited = sorted(self.now)
        self.starts = sorted({self.now[first] for claim in claims for first, last in claim.cited if not last})
        places = [(place, numbers) for line, numbers in looked_through.items() for place in self._may_be(line)]
        self.empty = {place for place, numbers in places if not numbers}
        self.no_facts = {place: numbers for place, numbers in places if numbers}
        self._extents: dict[tuple[int, int], Extent] = {}
        self._passages: dict[Extent, Passage] = {}
        self._own_parts: dict[tuple[Extent, frozenset[Fraction]], Passage] = {}
        self._parted: dict[tuple[Extent, str], bool] = {}
        self.added: list[Token] = []
        self.columns, self.siblings = Columns(manual), Siblings()

    def run(self) -> Audit:
        """All findings."""
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
        for claim, extent in (*strays, *self.siblings.lacking()):
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

    def _now(self, line: int) -> int:
        """Where any line of the transcribed text stands in this text: it moved with the nearest cited line above it."""
        place = bisect_right(self.cited, line)
        return line + self.now[self.cited[place - 1]] - self.cited[place - 1] if place else line

    def _may_be(self, line: int) -> set[int]:
        """Where a line that no fact cites may stand: it moved with the cited line above it, or with the one below."""
        below = self.cited[bisect_right(self.cited, line) :][:1]
        return {self._now(line), *(line + self.now[cited] - cited for cited in below)}

    def extent(self, first: int, last: int) -> Extent:
        """The lines that a citation means in this text."""
        key = (first, last)
        if key not in self._extents:
            start = self._now(first)
            if last:
                extent = Extent(start, start + last - first, "lines")
            else:
                place = bisect_right(self.starts, start)
                extent = self.manual.extent(start, self.starts[place] if place < len(self.starts) else None)
            self._extents[key] = extent
        return self._extents[key]

    def passage(self, extent: Extent) -> Passage:
        """Their text, with the cells that are merged from above."""
        if extent not in self._passages:
            lines = [(line, 0, self.manual.line(line)) for line in range(extent.first, extent.last + 1)]
            self._passages[extent] = Passage(self.manual, (*lines, *self.manual.merged_cells(extent.first)))
        return self._passages[extent]

    def _tokens(self, extent: Extent) -> list[Token]:
        return self.passage(extent).tokens

    def _text(self, extent: Extent) -> str:
        return self.passage(extent).text

    def _of_line(self, line: int) -> list[Token]:
        return self.manual.tokens[line - 1] if 1 <= line <= len(self.manual) else []

    def _check_labels(self, claims: list[Claim]) -> None:
        """Labels of one list are looked for together: beside their numbers, in their order."""
        extents = self._cited_by(claims[0])
        for claim in claims[1:]:
            self._cited_by(claim)
        places = [(extent, self._standing(claims, extent)) for extent in extents]
        for extent, here in places:
            for label in here:
                self.columns.note_columns(label.claim, extent, self._columns_of(label, extent))
        labels = [label for _, here in places for label in here]
        self._use(token for label in labels for token in label.tokens)
        self.added += (token for extent, here in places for token in self._added_to(here, extent))
        stands = {label.claim for label in labels}
        for extent, here in places:
            listed = {label.claim for label in here}
            if len(claims) >= _LISTED and _nearly_all([claim in listed for claim in claims]):
                stands -= {claim for claim in stands - listed if not self._is_added(claim, extent)}
        masks = [claim for claim in stands if claim.fact == "flags" and not claim.words]
        for passage in (self._own_passage(claims[0], extent) for extent in extents):  # 0x0001 may be any 1 of the list
            self._use(token for mask in masks for token in passage.reading(mask.numbers))
        for claim in claims:
            if claim not in stands:
                self._misses(claim, extents)

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

    def _standing(self, claims: list[Claim], extent: Extent) -> list[Standing]:
        """The labels that stand in a place, or in the claims' own part of it."""
        return standing(claims, self._own_passage(claims[0], extent))

    def _own_passage(self, claim: Claim, extent: Extent) -> Passage:
        """A place, or the part of it behind the subject's own address where the manual prints such facts so."""
        part = self._part(claim.subject, extent) if claim.fact in _PARTED else None
        return part if part is not None and self._parts(extent, claim.fact) else self.passage(extent)

    @cached_property
    def _addresses(self) -> dict[Extent, dict[str, frozenset[Fraction]]]:
        """Whose addresses are cited in each place."""
        addresses: dict[Extent, dict[str, frozenset[Fraction]]] = {}
        for claim in self.claims:
            if claim.fact == "address" and claim.anchor:
                for cited in claim.cited:
                    addresses.setdefault(self.extent(*cited), {})[claim.subject] = claim.numbers
        return addresses

    @cached_property
    def _claims_in(self) -> dict[tuple[Extent, str], list[Claim]]:
        claims: dict[tuple[Extent, str], list[Claim]] = {}
        for claim in self.claims:
            for cited in claim.cited:
                claims.setdefault((self.extent(*cited), claim.fact), []).append(claim)
        return claims

    def _part(self, subject: str, extent: Extent) -> Passage | None:
        """What stands behind a subject's own address, up to the next one; None if the place has only one address."""
        addresses = self._addresses.get(extent, {})
        if subject not in addresses or len(set(addresses.values())) == 1:
            return None
        key = (extent, addresses[subject])
        if key not in self._own_parts:
            others = frozenset().union(*addresses.values())
            self._own_parts[key] = self.passage(extent).part(addresses[subject], others)
        return self._own_parts[key]

    def _parts(self, extent: Extent, fact: str) -> bool:
        """Whether the manual prints such a fact behind the address of each subject: for nearly all of them."""
        key = (extent, fact)
        if key not in self._parted:
            parts = [(claim, self._part(claim.subject, extent)) for claim in self._claims_in[key] if not claim.optional]
            stand = [part is not None and bool(standing([claim], part)) for claim, part in parts]
            self._parted[key] = _nearly_all(stand, but_one_of=3)
        return self._parted[key]

    def _use(self, tokens: Iterable[Token]) -> None:
        self.used.update((token.line, token.column) for token in tokens)

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

    def _prints_alike(self, claim: Claim, extent: Extent) -> bool:
        """Whether a place prints nearly all facts that are alike, such as the values of bits beside each bit."""
        key = (extent, f"{claim.subject} {claim.alike}")
        if claim.alike and key not in self._parted:
            claims = [other for other in self._claims_in[extent, claim.fact] if _are_alike(claim, other)]
            self._parted[key] = _nearly_all([bool(self._numbers_stand(other, extent)) for other in claims])
        return self._parted.get(key, False)

    def _lists_another(self, claim: Claim, extent: Extent) -> bool:
        """Whether a place prints the list of a fact with another number in it."""
        if claim.apart:
            return False
        errata = (erratum for erratum in self.taken.get(claim.about, ()) if self._speaks_of(erratum, [extent]))
        known = frozenset().union(*(erratum.taken.union(erratum.numbers) for erratum in errata))
        passage = self._own_passage(claim, extent)
        others = (other for way in claim.ways for other in passage.nearly_in_order(way))
        return any(not other.readings & known for other in others)

    def _misses(self, claim: Claim, extents: list[Extent]) -> None:
        if self._is_taken(claim, extents):
            return
        self.absent.append((claim, extents))

    def _report_absent(self) -> None:
        """What does not stand where it is cited, with what stands there instead."""
        numbers = self.outcome.unused
        unused = {extent: [number for number in numbers if number.line in extent] for extent in self.subjects}
        told: set[Unused] = set()
        nearby: dict[tuple[str, str, str | None], Missing] = {}
        for claim, extents in self._without_repetition():
            there = [number for extent in extents for number in unused[extent]]
            printed = instead(claim, [self.passage(extent) for extent in extents], there)
            told.update(number for number in there if number.number == printed)
            first, last = extents[0].first, extents[0].last
            nearest = None if printed else self._nearest(claim, first)
            missing = Missing(claim.subject, claim.fact, claim.shown, first, last, nearest, claim.where, printed)
            same = (claim.fact, claim.shown, printed)
            if same in nearby and first - nearby[same].last <= _LONGEST_MERGED:
                nearby[same].spread(missing)
            else:
                nearby[same] = missing
                self.outcome.missing.append(missing)
        self.outcome.unused = [number for number in numbers if number not in told]

    def _without_repetition(self) -> Iterator[tuple[Claim, list[Extent]]]:
        """What is absent, without what only tells the same of a thing in another way."""
        told = {(claim.subject, claim.where) for claim, _ in self.absent if not claim.optional}
        for claim, extents in self.absent:
            if not claim.optional or (claim.subject, claim.where) not in told:
                told.add((claim.subject, claim.where))
                yield claim, extents

    def _is_taken(self, claim: Claim, extents: list[Extent]) -> bool:
        """Whether the description took this fact against the manual, as an erratum says."""
        codes = claim.words if claim.entry is not None or self._lacks_a_letter(claim, extents) else ()
        printed = claim.fact.startswith("printed ")
        for erratum in self.taken.get(claim.about, ()):
            if claim.fact not in _TAKEN_ANYWHERE and not self._speaks_of(erratum, extents):
                continue
            if self._is_of(erratum, claim) and (erratum.is_sentence or not printed):
                return True  # an erratum that gives printed facts tells apart what is printed and what was taken
            if any(has_word(erratum.taken_text, code) for code in codes):
                return True
        return False

    def _is_of(self, erratum: PrintedErratum, claim: Claim) -> bool:
        """Whether an erratum took a number for such a fact: addresses for addresses, what is not printed for a scale."""
        if claim.optional or claim.row:
            return False
        if claim.is_address:
            return erratum.taken <= self._numbers_of_addresses[claim.subject] and bool(claim.numbers & erratum.taken)
        taken = erratum.taken.difference(erratum.numbers) if claim.fact == "scale" else erratum.taken
        return bool(claim.numbers & taken)

    @cached_property
    def _numbers_of_addresses(self) -> dict[str, frozenset[Fraction]]:
        """All numbers of the addresses of each subject."""
        numbers: dict[str, frozenset[Fraction]] = {}
        for claim in self.claims:
            if claim.is_address:
                numbers[claim.subject] = numbers.get(claim.subject, frozenset()) | claim.numbers
        return numbers

    def _lacks_a_letter(self, claim: Claim, extents: list[Extent]) -> bool:
        """Whether the manual nowhere prints a code, but its number in these places."""
        digits = "".join(filter(str.isdigit, claim.words[0])) if claim.fact == "code" else ""
        if len(digits.lstrip("0")) < _TOLD or any(map(self.manual.lines_with, claim.words)):
            return False
        alone = re.compile(rf"(?<![0-9])0*{int(digits)}(?![0-9])")
        return any(alone.search(self._text(extent)) for extent in extents)

    def _is_added(self, claim: Claim, extent: Extent) -> bool:
        """Whether an erratum says of a list that it lacks a number, which stands elsewhere."""
        errata = (erratum for erratum in self.taken.get(claim.about, ()) if self._speaks_of(erratum, [extent]))
        return any(claim.beside & erratum.taken for erratum in errata)

    def _speaks_of(self, erratum: PrintedErratum, extents: list[Extent]) -> bool:
        """Whether an erratum cites lines of a place."""
        lines = [self.extent(*cited) for cited in erratum.cited]
        return any(one.first <= extent.last and extent.first <= one.last for one in lines for extent in extents)

    def _stands(self, claim: Claim, extent: Extent) -> int:
        """How often a claim stands in one of the places that it cites."""
        for facts, check in self._checks:
            if claim.fact in facts:
                return check(claim, extent)
        own = self._own_passage(claim, extent).text
        stands = [self._has(word, extent) and has_word(own, word) for word in claim.words]  # each marks what it uses
        if not any(stands) and claim.names and self.passage(extent).joins(claim.names):
            return 0  # where the manual prints PZD2, a 2 alone is another fact
        return max(map(int, stands), default=0) or self._numbers_stand(claim, extent)

    @cached_property
    def _checks(self) -> tuple[tuple[tuple[str, ...], Callable[[Claim, Extent], int]], ...]:
        """What is looked for in its own way."""
        return (
            (("access",), self._access_agrees),
            (("bytes",), lambda claim, extent: self._has_bytes(claim.shown, extent)),
            (("section",), lambda claim, extent: self._has(claim.words[0], extent) or self._lies_in(claim, extent)),
            (("code",), self._code_stands),
        )

    def _code_stands(self, claim: Claim, extent: Extent) -> int:
        """Whether a code stands in the place, and no other one names the row in its first cell."""
        stands = [self._has(word, extent) for word in claim.words]
        for word in claim.words:
            columns = {self.manual.column(extent.first, at) for at in places_in(self.manual.line(extent.first), word)}
            self.columns.note_columns(claim, extent, columns)
        first_cell = self.manual.line(extent.first).split("|")[1:2]
        form = re.sub(r"[0-9]", "[0-9]", re.escape(claim.words[0]))
        named = re.findall(rf"(?<!\w){form}(?!\w)", first_cell[0]) if first_cell else []
        return any(stands) and (not named or claim.words[0] in named)

    def _numbers_stand(self, claim: Claim, extent: Extent) -> int:
        cited = extent
        if claim.is_address and extent.kind == "row" and self._names_its_row(claim, extent.first):
            extent = Extent(extent.first, extent.first, "row")  # the rows below belong to the point's other words
        passage = self._own_passage(claim, extent)
        if claim.in_order:
            return self._stand_in_order(claim, passage, cited)
        if claim.behind and (runs := list(passage.in_order(claim.behind))):
            return any(self._stands_behind(claim, run[-1], passage) for run in runs)
        hits = self._hits(claim, passage)
        if claim.optional:
            hits = [token for token in hits if token.line >= extent.first]  # merged cells say more of the row above
        self._use(hits)
        if hits:
            self.columns.note(claim, cited, hits)
        if hits or not claim.between:
            return len(hits)
        readings = {reading for token in passage.tokens for reading in token.readings}
        return readings.issuperset(claim.between) and _RUN.search(self._text(extent)) is not None

    def _names_its_row(self, claim: Claim, line: int) -> bool:
        """Whether addresses stand in the first line of a row: in cells, or behind their names."""
        if self.manual.line(line).startswith("|"):
            return True
        return bool(claim.names) and bool(self.passage(Extent(line, line, "row")).behind_names(claim.names))

    def _hits(self, claim: Claim, passage: Passage) -> list[Token]:
        """The numbers of a passage that state a fact: of those that can mean it, those in its row, cell or name."""
        hits = passage.reading(claim.numbers)
        if claim.fact in _OF_CODES:
            hits = [token for token in hits if token.is_plainly(claim.numbers)]
        if claim.row and (claim.optional or passage.behind(claim.row)):
            hits = [token for token in hits if token in passage.behind(claim.row)]
        if claim.opens:
            hits = [token for token in hits if token in passage.opening_rows]
        if claim.names and (named := passage.behind_names(claim.names)):
            hits = [token for token in hits if token in named]
        if claim.fact in _BEHIND_THE_FIRST and len(passage.in_first_cell) < len(passage.tokens):
            hits = [token for token in hits if token not in passage.in_first_cell]
        if claim.first and claim.optional:  # bytes are counted without zeros in front
            hits = [token for token in hits if not token.text.startswith("0")]
        if claim.first:
            hits = [token for token in hits if token in passage.in_first_cell]
        if claim.unit:
            hits = [token for token in hits if passage.is_followed_by(token, claim.unit)] or hits
        return hits

    def _stand_in_order(self, claim: Claim, passage: Passage, extent: Extent) -> bool:
        """Whether the numbers stand one after the other, or each somewhere where they may: a range in one line."""
        runs = [run for way in claim.ways for run in passage.in_order(way)]
        if claim.tight:
            runs = [run for run in runs if passage.has_signs_alone(run[0], run[-1])]
        self._use(token for run in runs for token in run)
        self.columns.note(claim, extent, (run[0] for run in runs))
        if runs or not claim.apart:
            return bool(runs)
        apart = [[passage.reading(numbers) for numbers in way] for way in claim.ways]
        self._use(token for hits in apart for tokens in hits for token in tokens)
        if "range" not in claim.fact:
            return any(all(hits) for hits in apart)
        lines = [[{token.line for token in tokens} for tokens in hits] for hits in apart]
        return any(set.intersection(*hits) for hits in lines)

    def _stands_behind(self, claim: Claim, token: Token, passage: Passage) -> bool:
        """Whether the next number behind another one is that of a claim, or its word stands between."""
        end = passage.end_of(token)
        following = passage.after(end)
        between = passage.text[end : passage.start_of(following) if following else None]
        if any(has_word(between, word) for word in claim.words):
            return True
        if following is None or not following.readings & claim.numbers:
            return False
        self._use([following])
        return True

    def _access_agrees(self, claim: Claim, extent: Extent) -> bool:
        """Whether the row prints this access, or none at all."""
        printed = printed_access(claim, self.manual.line(extent.first))
        return not printed or not set(claim.words).isdisjoint(printed)

    def _has(self, word: str, extent: Extent) -> bool:
        """Whether a word stands in the extent; if so, the numbers in it count as used."""
        for line in range(extent.first, extent.last + 1):
            for at in places_in(self.manual.line(line), word):
                self.used.update(
                    (line, token.column) for token in self._of_line(line) if at < token.column <= at + len(word)
                )
        return has_word(self._text(extent), word)

    def _has_bytes(self, digits: str, extent: Extent) -> bool:
        """Whether the bytes stand there in one piece, or each of them as a number of its own, in any notation."""
        passage = self.passage(extent)
        pieces = list(passage.pieces_of_bytes(digits))
        self._use(token for first, end in pieces for token in passage.overlapping(first, end))
        if pieces:
            return True
        wholes = [int(digits[at : at + 2], 16) for at in range(0, len(digits), 2)]
        words = [int(digits[at : at + 4], 16) for at in range(0, len(digits), 4)]
        self._use(passage.reading(frozenset(map(Fraction, {*wholes, *words}))))
        readings = Counter(reading for token in passage.tokens for reading in token.readings)
        return any(
            all(readings[Fraction(part)] >= times for part, times in Counter(parts).items())
            for parts in (wholes, words)
        )

    def _nearest(self, claim: Claim, line: int) -> int | None:
        places: Iterable[int] = ()
        if claim.numbers:
            places = [place for number in claim.numbers for place in self.manual.lines_of.get(number, ())]
        elif claim.words:
            places = self.manual.lines_with(claim.words[0])
        return min(places, key=lambda place: (abs(place - line), place), default=None)

    def _check_erratum(self, erratum: PrintedErratum) -> None:
        if not erratum.numbers and not erratum.texts:
            self.outcome.uncheckable += 1
            return
        cited = [self.extent(*lines) for lines in erratum.cited]
        extents = self._spoken_of(erratum)
        absent = False
        for number in map(abs, erratum.numbers):
            hits = [token for extent in extents for token in self._with(number, extent)]
            near = (token for token in hits if any(token.line in extent for extent in cited))
            self.used.update((token.line, token.column) for token in near)
            absent = absent or not (hits or any(self._in_a_name(number, extent) for extent in extents))
        if absent or (erratum.texts and self._lacks(erratum.texts, extents)):
            first = extents[0].first
            places = [place for number in erratum.numbers for place in self.manual.lines_of.get(abs(number), ())]
            nearest = min(places, key=lambda place: (abs(place - first), place), default=None)
            self.outcome.unprinted.append(Unprinted(erratum.id, erratum.shown, erratum.cited[0][0], nearest))

    def _spoken_of(self, erratum: PrintedErratum) -> list[Extent]:
        """The lines that an erratum cites. A sentence may speak of the whole section; only numbers there are used."""
        cited = [self.extent(*lines) for lines in erratum.cited]
        if not erratum.is_sentence:
            return cited
        sections = [self.manual.section_of(extent.first) for extent in cited]
        return [
            Extent(min(extent.first, section.first), max(extent.last, section.last), "section")
            for extent, section in zip(cited, sections, strict=True)
        ]

    def _in_a_name(self, number: Fraction, extent: Extent) -> bool:
        """Whether a number stands in an extent at least as part of a name or of another number."""
        return has_word(self._text(extent), str(number))

    def _with(self, number: Fraction, extent: Extent) -> Iterator[Token]:
        """The tokens of an extent that can mean a number."""
        lines = self.manual.lines_of.get(number, [])
        for line in lines[bisect_left(lines, extent.first) : bisect_right(lines, extent.last)]:
            yield from (token for token in self._of_line(line) if number in token.readings)
        for line, column, cell in self.manual.merged_cells(extent.first):
            yield from (token for token in self.manual.tokens_in(cell, line, column) if number in token.readings)

    def _lacks(self, texts: Iterable[str], extents: list[Extent]) -> bool:
        """Whether one of the texts does not stand in the extents."""
        printed = " ".join(" ".join(self._text(extent) for extent in extents).split())
        return any(" ".join(text.split()) not in printed for text in texts)

    def _lies_in(self, claim: Claim, extent: Extent) -> bool:
        """Whether a line lies in a section: below its heading, and above the next that does not belong to it."""
        section, line = claim.words[0], extent.first
        start = self.manual.numbered.get(section)
        if start is None:
            return any(has_word(self.manual.line(above), section) for above in range(max(1, line - _FAR), line))
        return start <= line <= self.manual.end_of_section(section)

    def _unused(self) -> None:
        self.used -= {(token.line, token.column) for token in self.added}
        for extent, subjects in self.subjects.items():
            place = next(iter(subjects.values()))
            for line in (number for number in range(extent.first, extent.last + 1) if number not in self.empty):
                for column, text in self._without_fact(line):
                    if (line, column) not in self.used:
                        self.used.add((line, column))
                        self.outcome.unused.append(Unused(line, column, text, tuple(subjects), place))
        self.outcome.unused.sort(key=lambda unused: (unused.line, unused.column))

    def _without_fact(self, line: int) -> Iterator[tuple[int, str]]:
        """The numbers of a line, and the words that look like codes but are none of the description."""
        passed_over = self.codes | self.no_facts.get(line, frozenset())
        for token in self._of_line(line):
            if token.text not in passed_over:
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
                self.outcome.uncited.append(Uncited(line, "section", manual.line(line).strip()[:_SHORT]))
        for line in range(1, len(manual) + 1):
            if line not in covered and manual.is_row(line) and manual.tokens[line - 1]:
                section = manual.section_of(line)
                among_cited = any(number in covered for number in range(section.first, section.last + 1))
                shown = manual.line(line).strip()[:_SHORT]
                self.outcome.uncited.append(Uncited(line, "row", shown, among_cited=among_cited))
        self.outcome.uncited.sort(key=lambda uncited: uncited.line)

    def _moved(self, cited: list[int]) -> dict[int, int]:
        """Where each cited line stands in a manual that changed; what moved is noted."""
        anchors: dict[int, list[Claim]] = {}
        for claim in self.claims:
            if not claim.optional:
                for first, _ in claim.cited:
                    anchors.setdefault(first, []).append(claim)
        numbers: dict[int, list[Fraction]] = {}
        for erratum in self.errata:
            if not erratum.is_sentence:
                for first, _ in erratum.cited:
                    numbers.setdefault(first, []).extend(erratum.numbers)
        now = placement(self.manual, cited, anchors, numbers)
        for line in [line for line in cited if now[line] != line]:
            for name in dict.fromkeys(claim.subject for claim in anchors.get(line, [])):
                self.outcome.moved.append(Moved(name, line, now[line]))
        return now
