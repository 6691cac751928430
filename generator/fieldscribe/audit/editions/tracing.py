"""A description held against one edition, with the words of the text that bear each of its facts."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.audit.comparison import Comparison
from fieldscribe.audit.editions.words import Words
from fieldscribe.audit.manual import places_in
from fieldscribe.audit.outcome import Audit

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from fractions import Fraction

    from fieldscribe.audit.citing import Claim
    from fieldscribe.audit.manual import Extent, Manual
    from fieldscribe.audit.outcome import Missing
    from fieldscribe.audit.printed_errata import PrintedErratum


class Trace(Comparison):
    """What stands in one edition. All lines are those of this edition.

    `missed` are the claims that do not stand, `borne` the words that bear each of the others; `void` are the errata
    that are not printed.
    """

    def __init__(
        self, text: Words, manual: Manual, claims: list[Claim], errata: list[PrintedErratum], looked_through: set[int]
    ) -> None:
        super().__init__(manual, claims, errata, looked_through, Audit("", "", True, len(manual)))
        self.text = text
        self.missed: dict[Claim, Missing] = {}
        self.borne: dict[Claim, set[int]] = {}
        self.run()
        self.void = {unprinted.erratum for unprinted in self.outcome.unprinted}

    def extents_of(self, cited: Iterable[tuple[int, int]]) -> list[Extent]:
        """The lines that these citations mean."""
        return [self._extent(first, last) for first, last in cited]

    def words_of_number(self, number: Fraction, erratum: PrintedErratum) -> Iterator[range]:
        """The words of each number that an erratum may mean."""
        for extent in self._spoken_of(erratum):
            for token in self._with(abs(number), extent):
                yield self._between(token.line, token.column, len(token.text))

    def words_of_quote(self, quote: str, erratum: PrintedErratum) -> Iterator[range]:
        """The words of each place that an erratum may quote."""
        wanted = Words(quote).texts
        for extent in self._spoken_of(erratum):
            words = range(self.text.of_line(extent.first).start, self.text.of_line(extent.last).stop)
            for start in words[: len(words) - len(wanted) + 1]:
                if self.text.texts[start] == wanted[0] and self.text.texts[start : start + len(wanted)] == wanted:
                    yield range(start, start + len(wanted))

    def _check(self, claim: Claim) -> None:
        before, self.used = self.used, set()
        super()._check(claim)
        self.borne[claim] = self._words_at(self.used) | self._words_of(claim)
        before |= self.used
        self.used = before

    def _misses(self, claim: Claim, extents: list[Extent]) -> None:
        count = len(self.outcome.missing)
        super()._misses(claim, extents)
        self.missed.update((claim, missing) for missing in self.outcome.missing[count:])

    def _words_at(self, places: Iterable[tuple[int, int]]) -> set[int]:
        """The words of the numbers that stand at these places."""
        words = set()
        for line, column in places:
            token = next((token for token in self._of_line(line) if token.column == column), None)
            words.update(self._between(line, column, len(token.text) if token else 1))
        return words

    def _words_of(self, claim: Claim) -> set[int]:
        """The words of the text that are those of a claim."""
        lines = {line for extent in self.extents_of(claim.cited) for line in range(extent.first, extent.last + 1)}
        return {
            place
            for line in lines
            for word in claim.words
            for at in places_in(self.manual.line(line), word)
            for place in self._between(line, at + 1, len(word))
        }

    def _between(self, line: int, column: int, width: int) -> range:
        return range(self.text.at(line, column), self.text.at(line, column + width))
