"""An audit from end to end: a text, in the layout that was transcribed if that is known, held against a description."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from fieldscribe.audit.claims import claims_of, looked_through_of
from fieldscribe.audit.comparison import Comparison, is_of_caption
from fieldscribe.audit.layout import Relaid
from fieldscribe.audit.manual import Manual, has_word
from fieldscribe.audit.outcome import Audit, Moved
from fieldscribe.audit.places import Asked
from fieldscribe.audit.printed_errata import printed_errata_of
from fieldscribe.audit.wordings import Wordings

if TYPE_CHECKING:
    from collections.abc import Callable

    from fieldscribe.audit.layout import Fingerprint
    from fieldscribe.resolve.analysis import Analysis


class Auditor(Asked):
    """What a description takes from its manual, read once for any number of texts."""

    def __init__(self, subject: Analysis) -> None:
        claims = list(dict.fromkeys(claims_of(subject)))  # an address printed in three notations is one fact
        super().__init__(claims, list(printed_errata_of(subject)), looked_through_of(subject))
        self.device = str(subject.scope.header["device"])
        self.names = Wordings(subject.scope.header["documents"]).names

    def audit(self, name: str, text: str, *, same_text: bool | None, kept: Fingerprint | None = None) -> Audit:
        """Everything that does not agree with a text.

        `same_text`: whether it is the text that was transcribed, None if unknown. `kept` is the fingerprint of that
        one: with it a text in another layout is read as that one was laid out.
        """
        if kept is None or same_text:
            manual = Manual(text, self.names)
            return Comparison(manual, self, Audit(self.device, name, same_text, len(manual))).run()
        return self._read_both_ways(Relaid(kept, text), name, text)

    def _read_both_ways(self, relaid: Relaid, name: str, text: str) -> Audit:
        """What agrees neither with the new text as it is nor with the same in the old layout."""
        manual, laid = Manual(text, self.names), Manual(relaid.text, self.names, relaid.sections)
        ways = (relaid.now, relaid.of_new)  # lines may count the new text already: --renumber comes before --accept
        now = max(ways, key=lambda way: self._stand(laid, way))
        outcomes = [Audit(self.device, name, False, len(manual), has_fingerprint=True) for _ in ways]
        gone_to = relaid.gone_to if now == relaid.now else {}
        as_it_is = Comparison(manual, self, outcomes[0], lambda line: gone_to.get(line) or relaid.in_new(now(line))[0])
        as_it_is.run()
        absent = {claim for claim, _ in as_it_is.absent}
        outcome = Comparison(laid, self, outcomes[1], now).run({claim for claim in self.claims if claim not in absent})
        changed = [relaid.is_new(number.line, number.column, len(number.number)) for number in outcome.unused]
        self._locate(outcome, relaid, now)
        counts = [is_of_caption(manual.line(number.line), number.column) for number in outcome.unused]
        outcome.unused = [
            number
            for number, is_new, is_label in zip(outcome.unused, changed, counts, strict=True)
            if (place := (number.line, number.column)) in as_it_is.strays
            or (is_new and not is_label and place not in as_it_is.used)
        ]
        outcome.unused.sort(key=lambda unused: (unused.line, unused.column))
        unprinted = {erratum.erratum for erratum in outcomes[0].unprinted}
        outcome.unprinted = [erratum for erratum in outcome.unprinted if erratum.erratum in unprinted]
        added = {line for place in outcomes[0].added for line in range(place.line, place.last + 1)}
        outcome.uncited = [
            place
            for place in outcome.uncited
            if not place.among_cited or not added.isdisjoint(range(place.line, place.last + 1))
        ]
        return outcome

    def _stand(self, manual: Manual, now: Callable[[int], int]) -> int:
        """How many words of the description stand on the lines that it cites, if those are meant so."""
        lines = ((claim.words, manual.line(now(first))) for claim in self.claims for first, _ in claim.cited[:1])
        return sum(any(has_word(line, word) for word in words) for words, line in lines)

    def _locate(self, outcome: Audit, relaid: Relaid, now: Callable[[int], int]) -> None:
        """The same with the lines of the new text, and which cited lines stand on another one."""
        for fact in outcome.missing:
            fact.line = relaid.in_new(fact.line)[0]
            fact.last = max(fact.line, relaid.last_in_new(fact.last))
            fact.nearest = None if fact.nearest is None else relaid.in_new(fact.nearest)[0]
        for number, unused in enumerate(outcome.unused):
            line, column = relaid.in_new(unused.line, unused.column)
            outcome.unused[number] = replace(unused, line=line, column=column)
        for number, place in enumerate(outcome.uncited):
            line = relaid.in_new(place.line)[0]
            outcome.uncited[number] = replace(place, line=line, last=max(line, relaid.last_in_new(place.last)))
        for number, erratum in enumerate(outcome.unprinted):
            if erratum.nearest is not None:
                outcome.unprinted[number] = replace(erratum, nearest=relaid.in_new(erratum.nearest)[0])
        outcome.uncited.sort(key=lambda place: place.line)
        cites = {
            (first, claim.subject): None for claim in self.claims if not claim.optional for first, _ in claim.cited
        }
        for line, subject in cites:
            stands = relaid.in_new(now(line))[0] if relaid.has_words(now(line)) else relaid.gone_to.get(line, line)
            if stands != line:
                outcome.moved.append(Moved(subject, line, stands))


def audit(subject: Analysis, name: str, text: str, *, same_text: bool | None, kept: Fingerprint | None = None) -> Audit:
    """Everything that does not agree, as `Auditor.audit` has it."""
    return Auditor(subject).audit(name, text, same_text=same_text, kept=kept)
