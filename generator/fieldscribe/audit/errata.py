"""Errata: whether the manual prints what they say, and which facts the description took against it."""

from __future__ import annotations

import re
from bisect import bisect_left, bisect_right
from functools import cached_property
from typing import TYPE_CHECKING

from fieldscribe.audit.manual import Extent, Token, has_word
from fieldscribe.audit.outcome import Unprinted
from fieldscribe.audit.places import Places

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from fractions import Fraction

    from fieldscribe.audit.citing import Claim
    from fieldscribe.audit.printed_errata import PrintedErratum

_NEVER_PRINTED = ("scale", "default")
"""Facts that an erratum took of which it does not say that the manual prints them."""
_TAKEN_ANYWHERE = ("code", "range", "enum", "scale")
"""Facts of which an erratum may speak that cites another place."""
_TOLD = 2
"""A number of so many digits is known as that of a code without its letter."""


class Errata(Places):
    """What errata say of the places of a text."""

    def _is_taken(self, claim: Claim, extents: list[Extent]) -> bool:
        """Whether the description took this fact against the manual, as an erratum says."""
        codes = claim.words if claim.entry is not None or self._lacks_a_letter(claim, extents) else ()
        printed = claim.fact.startswith("printed ")
        for erratum in self.taken.get(claim.about, ()):
            here = self._speaks_of(erratum, extents)
            if claim.fact not in _TAKEN_ANYWHERE and not here:
                continue
            if self._is_of(erratum, claim, here=here) and (erratum.is_sentence or not printed):
                return True  # an erratum that gives printed facts tells apart what is printed and what was taken
            if any(has_word(erratum.taken_text, code) for code in codes):
                return True
        return False

    def _is_of(self, erratum: PrintedErratum, claim: Claim, *, here: bool) -> bool:
        """Whether an erratum took a number for such a fact: addresses for addresses, limits that are not printed."""
        if (claim.optional and not claim.names) or claim.row:
            return False
        if claim.is_address:
            return erratum.taken <= self._numbers_of_addresses[claim.subject] and bool(claim.numbers & erratum.taken)
        alone = erratum.taken.difference(erratum.numbers)
        if claim.fact in _NEVER_PRINTED or (claim.fact == "range" and (alone or not (here or claim.apart))):
            return bool(claim.numbers & alone)
        return bool(claim.numbers & erratum.taken)

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
