"""A description held against one edition, with the words of the text that bear each of its facts."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.audit.comparison import Comparison
from fieldscribe.audit.editions.words import Words
from fieldscribe.audit.manual import places_in
from fieldscribe.audit.outcome import Audit

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator
    from fractions import Fraction

    from fieldscribe.audit.citing import Claim
    from fieldscribe.audit.manual import Extent, Manual, Token
    from fieldscribe.audit.places import Asked
    from fieldscribe.audit.printed_errata import PrintedErratum


class Trace(Comparison):
    """What stands in one edition. All lines are those of this edition.

    `missed` are the claims that do not stand, `borne` the words that bear each of the others (`named`: those that are
    its own words); `void` are the errata that are not printed.
    """

    def __init__(self, text: Words, manual: Manual, asked: Asked) -> None:
        super().__init__(manual, asked, Audit("", "", True, len(manual)))
        self.text = text
        self.borne: dict[Claim, set[int]] = {}
        self.named: dict[Claim, set[int]] = {}
        self._used_by_facts: set[tuple[int, int]] = set()
        self.run()
        self.missed = {claim for claim, _ in self.absent}
        self.void = {unprinted.erratum for unprinted in self.outcome.unprinted}

    def extents_of(self, cited: Iterable[tuple[int, int]]) -> list[Extent]:
        """The lines that these citations mean."""
        return [self.extent(first, last) for first, last in cited]

    def words_of_number(self, number: Fraction, erratum: PrintedErratum) -> Iterator[range]:
        """The words of each number that an erratum may mean."""
        for extent in self._spoken_of(erratum):
            for token in self._with(abs(number), extent):
                yield self.words_of_token(token)

    def words_of_quote(self, quote: str, erratum: PrintedErratum) -> Iterator[range]:
        """The words of each place that an erratum may quote."""
        wanted = Words(quote).texts
        for extent in self._spoken_of(erratum):
            words = range(self.text.of_line(extent.first).start, self.text.of_line(extent.last).stop)
            for start in words[: len(words) - len(wanted) + 1]:
                if self.text.texts[start] == wanted[0] and self.text.texts[start : start + len(wanted)] == wanted:
                    yield range(start, start + len(wanted))

    def sides_of(self, claim: Claim) -> set[int]:
        """On which sides of its label a number stands with nothing but signs between: before (-1), behind (1)."""
        numbers = self.borne[claim] - self.named[claim]
        sides = set()
        for word in self.named[claim]:
            for side in (-1, 1):
                place = word + side
                while 0 <= place < len(self.text) and not self.text.texts[place].isalnum():
                    place += side
                if place in numbers:
                    sides.add(side)
        return sides

    def is_used(self, token: Token) -> bool:
        """Whether a number is a fact of what cites its line, or a code."""
        return token.text in self.codes or (token.line, token.column) in self._used_by_facts

    def _check(self, claim: Claim) -> None:
        self._note([claim], lambda: super(Trace, self)._check(claim))

    def _check_labels(self, claims: list[Claim]) -> None:
        self._note(claims, lambda: super(Trace, self)._check_labels(claims))

    def _note(self, claims: list[Claim], check: Callable[[], None]) -> None:
        """Note the words that a check finds used; a label stands on its own numbers."""
        before, self.used = self.used, set()
        check()
        tokens = [token for place in self.used for token in self._of_line(place[0]) if token.column == place[1]]
        for claim in claims:
            wanted = claim.beside or (claim.numbers if claim.entry is not None else frozenset())
            own = [token for token in tokens if not wanted or token.readings & wanted]
            self.named[claim] = self._words_of(claim)
            self.borne[claim] = {word for token in own for word in self.words_of_token(token)} | self.named[claim]
        before |= self.used
        self.used = before

    def _unused(self) -> None:
        self._used_by_facts = set(self.used)
        super()._unused()

    def _words_of(self, claim: Claim) -> set[int]:
        """The words of the text that are those of a claim; a label may be spelt or broken otherwise."""
        extents = self.extents_of(claim.cited)
        lines = {line for extent in extents for line in range(extent.first, extent.last + 1)}
        literal = {
            place
            for line in lines
            for word in claim.words
            for at in places_in(self.manual.line(line), word)
            for place in self._between(line, at + 1, len(word))
        }
        if literal or not claim.beside:
            return literal
        places = ((self.passage(extent), span) for extent in extents for span in self._spans(claim, extent))
        return {place for passage, span in places for piece in passage.parts(*span) for place in self._between(*piece)}

    def _spans(self, claim: Claim, extent: Extent) -> Iterator[tuple[int, int]]:
        return (span for word in claim.words for span in self.passage(extent).places(word))

    def words_of_token(self, token: Token) -> range:
        """The words that a number is made of."""
        return self._between(token.line, token.column, len(token.text))

    def _between(self, line: int, column: int, width: int) -> range:
        return range(self.text.at(line, column), self.text.at(line, column + width))
