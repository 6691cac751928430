"""A description compared with a text: where each of its claims is printed, and which numbers of the text they use."""

import re
from bisect import bisect_right
from collections.abc import Callable, Iterable
from fractions import Fraction
from functools import cached_property
from typing import NamedTuple

from fieldscribe.audit.claims import Cited, Claim, Label, Number, Run
from fieldscribe.audit.claims_of_device import PrintedErratum, claims_of, passed_over, printed_errata
from fieldscribe.audit.evidence import Found, found, labels_found, lies_in_section
from fieldscribe.audit.manual import Extent, Manual, Passage, has_word
from fieldscribe.audit.numbers import Notation, Token
from fieldscribe.audit.point_claims import KEYS_OF_PRINTED
from fieldscribe.grouping import grouped
from fieldscribe.resolve.analysis import Analysis

_BINARY_FACTS = ("enum", "flag values", "special", "fixed bits", "default")
"""Facts that a manual may print with two or three binary digits."""
_SPREAD_FACTS = ("enum", "flags", "flag values", "says")
"""Facts of several numbers: each of several cited places prints some of them."""
_WORDS_OF_ROW = ("access", "type", "unit")
_NEAR = 200
"""The most lines above and below the cited line of which a sentence of an erratum may speak."""
_NEVER_PRINTED = ("scale", "default")
"""Facts that an erratum took of which it does not say that the manual prints them."""
_TAKEN_ANYWHERE = ("code", "range", "enum", "scale")
"""Facts that an erratum may be about although it cites another place."""


class Citations:
    """Everything that a description cites: its claims, its errata, and the lines that it passes over."""

    def __init__(self, subject: Analysis) -> None:
        self.device = str(subject.scope.header["device"])
        self.claims = claims_of(subject)
        self.errata = printed_errata(subject)
        self.passed_over = passed_over(subject)
        self.names = Notation(subject.scope.header["documents"]).names
        self.codes = {word for claim in self.claims if claim.fact == "code" for word in claim.words}

    def manual(self, text: str) -> Manual:
        """Return a text as the description reads it."""
        return Manual(text, self.names)


class Place(NamedTuple):
    """One place that a claim cites, as it is in the text, and what is found there."""

    extent: Extent
    found: Found


class Held:
    """The claims of a description in one text. `now` gives the lines of this text for cited ones, None if gone."""

    def __init__(
        self,
        citations: Citations,
        manual: Manual,
        now: Callable[[Cited], tuple[int, int] | None] | None = None,
        other_rows: Iterable[int] = (),
    ) -> None:
        """`other_rows` are lines that end the row above them as a cited line does."""
        self.citations, self.manual, self._other_rows = citations, manual, other_rows
        self._now = now or (lambda cited: cited.lines)
        self._extents: dict[tuple[int, int], Extent] = {}
        self._passages: dict[Extent, Passage] = {}
        self.used: set[tuple[int, int]] = set()
        """Line and column of each number that states a fact."""
        self.places: dict[Claim, list[Place]] = {}
        self.extents: dict[Extent, dict[str, str]] = {}
        """Each cited place with the subjects that cite it, and where the description says each."""
        self.errata_of = grouped((about, erratum) for erratum in citations.errata for about in erratum.subjects)
        self._hold()

    def _hold(self) -> None:
        lists: dict[tuple[object, ...], list[Claim]] = {}
        for claim in self.citations.claims:
            if isinstance(claim.evidence, Label):
                fact = "flags" if claim.fact == "flag values" else claim.fact
                lists.setdefault((claim.subject, fact, *(cited.lines for cited in claim.cited)), []).append(claim)
            else:
                self.places[claim] = [self._place(claim, extent) for extent in self._extents_of(claim)]
        for claims in lists.values():
            self._hold_labels(claims)
        self._not_for_each = self._labels_not_for_each()

    def _hold_labels(self, claims: list[Claim]) -> None:
        """Labels of one list are looked for together."""
        labels = [claim.evidence for claim in claims if isinstance(claim.evidence, Label)]
        for claim in claims:
            self.places[claim] = []
        first, *_ = [self._extents_of(claim) for claim in claims]
        for extent in first:
            there = labels_found(labels, self.passage(extent))
            for claim in claims:
                place = there[claim.evidence]  # type: ignore[index]  # all of them are labels
                self.places[claim].append(Place(extent, place))
                self._use(place.tokens)

    def _place(self, claim: Claim, extent: Extent) -> Place:
        here = found(claim.evidence, self.passage(extent), binary=claim.fact in _BINARY_FACTS)
        if claim.fact == "section" and lies_in_section(claim.words[0], extent.first, self.passage(extent)):
            here = Found(1, here.tokens, here.lines)
        tokens = here.tokens
        if claim.optional:
            tokens = tuple(token for token in tokens if token.line >= extent.first)  # merged cells belong to rows above
        self._use(tokens)
        return Place(extent, here)

    def _extents_of(self, claim: Claim) -> list[Extent]:
        extents = [extent for cited in claim.cited if (extent := self.extent(cited)) is not None]
        for extent in extents:
            self.extents.setdefault(extent, {}).setdefault(claim.subject, claim.where)
        return extents

    def extent(self, cited: Cited) -> Extent | None:
        """Return the lines of this text for a citation; None if they are gone."""
        span = self._now(cited)
        if span is None:
            return None
        if span not in self._extents:
            first, last = span
            place = bisect_right(self._starts, first)
            following = self._starts[place] if place < len(self._starts) else None
            self._extents[span] = Extent(first, last, "lines") if last else self.manual.extent(first, following)
        return self._extents[span]

    @cached_property
    def _starts(self) -> list[int]:
        """Return the first lines of all cited rows and sections."""
        cited = (cited for claim in self.citations.claims for cited in claim.cited if not cited.last)
        return sorted({span[0] for line in cited if (span := self._now(line)) is not None} | set(self._other_rows))

    def passage(self, extent: Extent) -> Passage:
        """Return the text of an extent, with the cells that are merged from above."""
        if extent not in self._passages:
            lines = [(line, 0, self.manual.line(line)) for line in extent.lines]
            self._passages[extent] = Passage(self.manual, (*lines, *self.manual.merged_cells(extent.first)))
        return self._passages[extent]

    def _use(self, tokens: Iterable[Token]) -> None:
        self.used.update((token.line, token.column) for token in tokens)

    def _labels_not_for_each(self) -> set[Claim]:
        """Yield labels that several subjects or flags share, that a place prints several times, but not for each."""
        by_place: dict[tuple[object, ...], list[tuple[Claim, Place]]] = {}
        for claim, places in self.places.items():
            for place in places if isinstance(claim.evidence, Label) else ():
                by_place.setdefault((place.extent, claim.fact, claim.stated), []).append((claim, place))
        return {claim for shared in by_place.values() for claim, place in shared if 1 < place.found.times < len(shared)}

    def is_printed(self, claim: Claim) -> bool:
        """Return True if the text prints a claim where it is cited."""
        if claim in self._not_for_each:
            return False
        times = [place.found.times for place in self.places[claim]]
        if isinstance(claim.evidence, Number) and claim.evidence.times > 1:
            return sum(times) >= claim.evidence.times
        return any(times) if claim.fact in _SPREAD_FACTS else bool(times) and all(times)

    def stands(self, claim: Claim) -> bool:
        """Return True if the text prints a claim where it is cited, or an erratum explains that it does not."""
        return self.is_printed(claim) or self.is_taken(claim)

    def is_taken(self, claim: Claim) -> bool:
        """Return True if an erratum says that the description took this fact against the manual."""
        extents = [place.extent for place in self.places[claim]]
        codes = claim.words if claim.fact == "code" and self._lacks_a_letter(claim, extents) else ()
        if (isinstance(claim.evidence, Label) and claim.evidence.adjacent) or claim.fact in _WORDS_OF_ROW:
            codes = claim.words
        for erratum in self.errata_of.get(claim.about, ()):
            here = self._cites_one_of(erratum, extents)
            if claim.fact not in _TAKEN_ANYWHERE and not here:
                continue
            if self._is_about(erratum, claim, here=here) and (
                erratum.is_sentence or not claim.fact.startswith("printed ")
            ):
                return True
            if any(has_word(erratum.taken_text, code) for code in codes):
                return True
        return False

    def _is_about(self, erratum: PrintedErratum, claim: Claim, *, here: bool) -> bool:
        """Return True if an erratum took a number for such a fact: an address for an address, a limit for a limit."""
        if _is_address(claim):
            numbers = self._numbers_of_addresses[claim.subject]
            return erratum.taken <= numbers and bool(claim.numbers & erratum.taken)
        alone = erratum.taken.difference(erratum.numbers)
        spread = isinstance(claim.evidence, Run) and claim.evidence.spread
        if claim.fact in _NEVER_PRINTED or (claim.fact == "range" and (alone or not (here or spread))):
            return bool(claim.numbers & alone)
        return bool(claim.numbers & erratum.taken)

    @cached_property
    def _numbers_of_addresses(self) -> dict[str, frozenset[Fraction]]:
        """Return all numbers of the addresses of each subject."""
        numbers: dict[str, frozenset[Fraction]] = {}
        for claim in self.citations.claims:
            if _is_address(claim):
                numbers[claim.subject] = numbers.get(claim.subject, frozenset()) | claim.numbers
        return numbers

    def _lacks_a_letter(self, claim: Claim, extents: list[Extent]) -> bool:
        """Return True if the manual prints the number of a code in these places, but never with its letter."""
        digits = "".join(filter(str.isdigit, claim.words[0])).lstrip("0")
        if len(digits) < 2 or any(has_word(line, word) for word in claim.words for line in self.manual.lines):
            return False
        alone = re.compile(rf"(?<![0-9])0*{digits}(?![0-9])")
        return any(alone.search(self.passage(extent).text) for extent in extents)

    def _cites_one_of(self, erratum: PrintedErratum, extents: list[Extent]) -> bool:
        lines = [extent for cited in erratum.cited if (extent := self.extent(cited)) is not None]
        return any(one.first <= extent.last and extent.first <= one.last for one in lines for extent in extents)

    def erratum_stands(self, erratum: PrintedErratum) -> bool:
        """Return True if the text prints what an erratum quotes; its numbers count as used."""
        cited = [extent for line in erratum.cited if (extent := self.extent(line)) is not None]
        extents = [self._around(extent) for extent in cited] if erratum.is_sentence else cited
        passages = [self.passage(extent) for extent in extents]
        stands = bool(extents)
        for number in erratum.numbers:
            wanted = frozenset((number,))  # sets keep hashes: that of a fraction takes long
            tokens = [each for passage in passages for each in passage.tokens if not each.readings.isdisjoint(wanted)]
            self._use(token for token in tokens if any(token.line in extent for extent in cited))
            in_names = any(has_word(passage.text, str(number)) for passage in passages)
            stands = stands and bool(tokens or in_names)
        text = " ".join(" ".join(passage.text for passage in passages).split())
        return stands and all(" ".join(quoted.split()) in text for quoted in erratum.texts)

    def _around(self, extent: Extent) -> Extent:
        """Return the section around a cited place, or the near part of it: a text without headings is one section."""
        section = self.manual.section_around(extent.first)
        first, last = max(section.first, extent.first - _NEAR), min(section.last, extent.first + _NEAR)
        return Extent(min(extent.first, first), max(extent.last, last), "section")

    @cached_property
    def passed_over(self) -> dict[int, frozenset[str]]:
        """The passed-over lines of this text, each with its numbers that are not facts; no numbers for whole lines."""
        lines: dict[int, frozenset[str]] = {}
        for cited, listed in self.citations.passed_over:
            if (span := self._now(cited)) is not None:
                numbers = listed.union(*(text.split() for text in listed))  # several may be one text: "1 0 1"
                before = lines.get(span[0], numbers)
                lines[span[0]] = before | numbers if before and numbers else frozenset()
        return lines


def _is_address(claim: Claim) -> bool:
    """Return True for an address, in the protocol or in a numbering of the manual."""
    name = claim.fact.removeprefix("printed ")
    is_numbering = name != claim.fact and name not in KEYS_OF_PRINTED and not name.startswith(("low_", "high_"))
    return claim.fact == "address" or is_numbering
