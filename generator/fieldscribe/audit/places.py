"""The places that a description cites, as they stand in a text: lines, passages, and the parts of passages."""

from __future__ import annotations

from bisect import bisect_right
from functools import cached_property
from typing import TYPE_CHECKING

from fieldscribe.audit.columns import Columns
from fieldscribe.audit.labels import standing
from fieldscribe.audit.manual import Extent, Manual, Token
from fieldscribe.audit.passage import Passage
from fieldscribe.audit.siblings import Siblings

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping
    from fractions import Fraction

    from fieldscribe.audit.citing import Claim
    from fieldscribe.audit.outcome import Audit
    from fieldscribe.audit.printed_errata import PrintedErratum
    from fieldscribe.model import About

_PARTED = ("bits", "fixed bits", "enum", "flags", "flag values")
"""Facts that a place may print anew behind the address of each of its subjects."""
_NEARLY_ALL = 0.75
"""The share of facts from which on all have to stand alike; of some more one may always be another."""


class Asked:
    """What is looked for in a text."""

    def __init__(
        self, claims: list[Claim], errata: list[PrintedErratum], looked_through: Mapping[int, frozenset[str]]
    ) -> None:
        self.claims, self.errata, self.looked_through = claims, errata, looked_through


def nearly_all(stand: list[bool], but_one_of: int = 4) -> bool:
    """Whether so many of what is alike stand that all have to."""
    enough = sum(stand) > _NEARLY_ALL * len(stand)
    return enough or (len(stand) >= but_one_of and sum(stand) == len(stand) - 1)


class Places:
    """Where cited lines stand now, with what was found in them so far."""

    def __init__(self, manual: Manual, asked: Asked, outcome: Audit, now: Callable[[int], int] | None = None) -> None:
        """`now` tells where a line of the transcribed text stands in this one; without it each is where it was."""
        claims, errata, looked_through = asked.claims, asked.errata, asked.looked_through
        self.manual, self.claims, self.errata, self.outcome = manual, claims, errata, outcome
        self._now = now = now or _where_it_was
        self.used: set[tuple[int, int]] = set()
        self.taken: dict[About, list[PrintedErratum]] = {}
        for erratum in errata:
            for name in erratum.subjects:
                self.taken.setdefault(name, []).append(erratum)
        self.codes = {word for claim in claims if claim.fact == "code" for word in claim.words}
        self.subjects: dict[Extent, dict[str, str]] = {}
        self.absent: list[tuple[Claim, list[Extent]]] = []
        self.starts = sorted({now(first) for claim in claims for first, last in claim.cited if not last})
        self.empty = {now(line) for line, numbers in looked_through.items() if not numbers}
        self.no_facts: dict[int, frozenset[str]] = {}
        for line, numbers in looked_through.items():
            if numbers:  # lines that were joined have those of each
                self.no_facts[now(line)] = self.no_facts.get(now(line), frozenset()) | _with_parts(numbers)
        self._extents: dict[tuple[int, int], Extent] = {}
        self._passages: dict[Extent, Passage] = {}
        self._own_parts: dict[tuple[Extent, frozenset[Fraction]], Passage] = {}
        self._parted: dict[tuple[Extent, str], bool] = {}
        self.added: list[Token] = []
        self.columns, self.siblings = Columns(manual), Siblings()

    def extent(self, first: int, last: int) -> Extent:
        """The lines that a citation means in this text."""
        key = (first, last)
        if key not in self._extents:
            start = self._now(first)
            place = bisect_right(self.starts, start)
            following = self.starts[place] if place < len(self.starts) else None
            self._extents[key] = (
                Extent(start, self._now(last), "lines") if last else self.manual.extent(start, following)
            )
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

    def _use(self, tokens: Iterable[Token]) -> None:
        self.used.update((token.line, token.column) for token in tokens)

    def _own_passage(self, claim: Claim, extent: Extent) -> Passage:
        """A place, or the part of it behind the subject's own address where the manual prints such facts so."""
        part = self._part(claim.subject, extent) if claim.fact in _PARTED else None
        own = part if part is not None and self._parts(extent, claim.fact) else self.passage(extent)
        return own.of_short_lines if claim.closing else own

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
            self._parted[key] = nearly_all(stand, but_one_of=3)
        return self._parted[key]


def _where_it_was(line: int) -> int:
    return line


def _with_parts(numbers: frozenset[str]) -> frozenset[str]:
    """Listed numbers, those of a row that is listed as a whole, too."""
    return numbers.union(*map(str.split, numbers))
