"""Whether facts stand in the places that they cite."""

from __future__ import annotations

import re
from collections import Counter
from functools import cached_property
from itertools import chain
from typing import TYPE_CHECKING

from fieldscribe.audit.errata import Errata
from fieldscribe.audit.frames import other_bytes, runs_of_bytes, ways_of_bytes
from fieldscribe.audit.instead import printed_access
from fieldscribe.audit.manual import Extent, Token, has_word, places_in
from fieldscribe.audit.places import nearly_all

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from fieldscribe.audit.citing import Claim
    from fieldscribe.audit.passage import Passage

_RUN = re.compile(r"\bbis\b|\bto\b|\.\.|\u2026|[0-9]\s*[-\u2013]\s*[0-9]")
"""What tells a run of numbers ("0 to 4", "0..4"), with all numbers between its ends."""
_BEHIND_THE_FIRST = ("answers", "refusals")
"""Facts of a code that its row prints behind the code itself."""
_IN_BINARY = ("enum", "flag values", "special", "fixed bits", "default")
"""Facts that a manual may print with two or three binary digits."""
_FAR = 400
"""A section number that is no heading is searched in at most so many lines above."""


def runs_of(claim: Claim, passage: Passage) -> Iterator[list[Token]]:
    """The numbers of a claim wherever they follow each other as it says."""
    for way in claim.ways:
        for run in passage.in_order(way):
            if claim.fact in _IN_BINARY or all(map(Token.is_plainly, run, way)):
                yield run


def reading(claim: Claim, passage: Passage) -> list[Token]:
    """The numbers that can mean what a claim says."""
    hits = passage.reading(claim.numbers)
    return hits if claim.fact in _IN_BINARY else [token for token in hits if token.is_plainly(claim.numbers)]


def _are_alike(claim: Claim, other: Claim) -> bool:
    return (claim.subject, claim.alike) == (other.subject, other.alike)


class Facts(Errata):
    """How facts stand in the places of a text."""

    def _stands(self, claim: Claim, extent: Extent) -> int:
        """How often a claim stands in one of the places that it cites."""
        for facts, check in self._checks:
            if claim.fact in facts:
                return check(claim, extent)
        if claim.in_order:
            return self._numbers_stand(claim, extent)
        own = self._own_passage(claim, extent).text
        stands = [self._has(word, extent) and has_word(own, word) for word in claim.words]  # each marks what it uses
        is_named = bool(claim.names and claim.words) and not claim.optional
        if is_named and not any(stands) and self.passage(extent).joins(claim.names):
            return 0  # where the manual prints PZD2, a 2 alone is another fact
        return max(map(int, stands), default=0) or self._numbers_stand(claim, extent)

    @cached_property
    def _checks(self) -> tuple[tuple[tuple[str, ...], Callable[[Claim, Extent], int]], ...]:
        """What is looked for in its own way."""
        return (
            (("access",), self._access_agrees),
            (("bytes",), self._has_bytes),
            (("section",), lambda claim, extent: self._has(claim.words[0], extent) or self._lies_in(claim, extent)),
            (("code",), self._code_stands),
        )

    def _prints_alike(self, claim: Claim, extent: Extent) -> bool:
        """Whether a place prints nearly all facts that are alike, such as the values of bits beside each bit."""
        key = (extent, f"{claim.subject} {claim.alike}")
        if claim.alike and key not in self._parted:
            claims = [other for other in self._claims_in[extent, claim.fact] if _are_alike(claim, other)]
            stand = [bool(self._stands(other, extent)) for other in claims]
            most = bool(claim.words) and 2 * sum(stand) > len(stand)  # numbers with words are no chance
            self._parted[key] = most or nearly_all(stand)
        return self._parted.get(key, False)

    def _lists_another(self, claim: Claim, extent: Extent) -> bool:
        """Whether a place prints the list of a fact with another number in it."""
        if claim.apart:
            return False
        passage = self._own_passage(claim, extent)
        others = (other for way in claim.ways for other in passage.nearly_in_order(way, tight=claim.tight))
        return self._are_others(others, claim, extent)

    def _are_others(self, tokens: Iterable[Token], claim: Claim, extent: Extent) -> bool:
        """Whether one of these numbers is none that an erratum of the place prints or took."""
        errata = [erratum for erratum in self.taken.get(claim.about, ()) if self._speaks_of(erratum, [extent])]
        printed = (number for erratum in errata if not erratum.is_sentence for number in erratum.numbers)
        known = frozenset(printed).union(*(erratum.taken for erratum in errata))
        return any(not token.readings & known for token in tokens)

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
        hits = self.hits(claim, passage)
        if claim.optional:
            hits = [token for token in hits if token.line >= extent.first]  # merged cells say more of the row above
        self._use(hits)
        if hits:
            self.columns.note(claim, cited, hits)
            if cited.kind == "section":
                self.siblings.note_numbers(claim, cited, len(hits))
        if hits or not claim.between:
            return len(hits)
        readings = {reading for token in passage.tokens for reading in token.readings}
        return readings.issuperset(claim.between) and _RUN.search(self._text(extent)) is not None

    def _names_its_row(self, claim: Claim, line: int) -> bool:
        """Whether addresses stand in the first line of a row: in cells, or behind their names."""
        if self.manual.line(line).startswith("|"):
            return True
        return bool(claim.names) and bool(self.passage(Extent(line, line, "row")).behind_names(claim.names))

    def hits(self, claim: Claim, passage: Passage) -> list[Token]:
        """The numbers of a passage that state a fact: of those that can mean it, those in its row, cell or name."""
        hits = reading(claim, passage)
        if claim.under and (below := passage.under(claim.under)):
            self._use(hits)  # sentences say them again
            hits = [token for token in hits if token in below]
        if claim.row and (claim.optional or passage.behind(claim.row)):
            hits = [token for token in hits if token in passage.behind(claim.row)]
        if claim.opens:
            hits = [token for token in hits if token in passage.opening_rows]
        if claim.names and ((named := passage.behind_names(claim.names)) or claim.optional):
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
        runs = list(runs_of(claim, passage))
        if claim.tight:
            runs = [run for run in runs if passage.has_signs_alone(run[0], run[-1])]
        if claim.words:
            behind = passage.words_behind((run[-1] for run in runs), claim.words)
            self._use(token for places in behind for place in places for token in passage.inside(*place))
            runs = [run for run, places in zip(runs, behind, strict=True) if places]
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

    def _has_bytes(self, claim: Claim, extent: Extent) -> bool:
        """Whether a frame stands there whole, or each of its bytes as a number of its own, in any notation."""
        passage, digits = self.passage(extent), claim.shown
        ways = ways_of_bytes(digits)
        if pieces := list(passage.pieces_of_bytes(digits)):
            self._use(token for first, end in pieces for token in passage.overlapping(first, end))
            return True
        self._use(passage.reading(frozenset().union(*chain(*ways))))  # the names of bytes have them, too: Low byte (1)
        if any(runs_of_bytes(digits, passage)):
            return True
        if self._are_others(other_bytes(digits, passage), claim, extent):
            return False
        readings = Counter(reading for token in passage.tokens for reading in token.readings)
        return any(all(readings[part] >= times for (part,), times in Counter(way).items()) for way in ways)

    def _lies_in(self, claim: Claim, extent: Extent) -> bool:
        """Whether a line lies in a section: below its heading, and above the next that does not belong to it."""
        section, line = claim.words[0], extent.first
        start = self.manual.numbered.get(section)
        if start is None:
            return any(has_word(self.manual.line(above), section) for above in range(max(1, line - _FAR), line))
        return start <= line <= self.manual.end_of_section(section)
