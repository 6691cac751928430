"""The facts that tell where a cited line stands in a text: codes, sections, addresses, and what few lines have."""

from __future__ import annotations

from bisect import bisect_left
from math import log2
from typing import TYPE_CHECKING

from fieldscribe.records import dataclass, replace

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable
    from fractions import Fraction

    from fieldscribe.audit.citing import Claim
    from fieldscribe.audit.manual import Manual

_BYTES = 8
"""A frame is searched by so many of its first digits."""
_NEAREST = 3
"""How many places of a fact are tried for its line."""
_RARE = 3
"""A fact that stands in at most so many lines tells by itself where its line is."""
_WITH_TITLES = ("", "message", "telegram")
"""Points, messages and telegrams have sections, whose headings may be their titles."""


@dataclass(frozen=True, slots=True)
class Anchor:
    """A fact that tells where a cited line is now: the lines that have it, in order."""

    places: list[int]
    spans: tuple[tuple[int, int], ...] = ()
    """The lines of its section, in which the line may lie."""
    is_name: bool = False
    """Whether it is a code, a section or an address."""
    length: int | None = None
    """How many lines the fact may take from the cited line on; None: as long as the place is."""
    opens: bool = False
    """Whether the place begins with it."""
    is_title: bool = False
    of_erratum: bool = False
    """Whether it is a number that an erratum says is printed there."""

    @property
    def worth(self) -> float:
        """How much it tells: the more, the fewer lines have it."""
        return 1.0 if self.is_name else 1 / (1 + log2(len(self.places)))

    @property
    def is_rare(self) -> bool:
        """Whether it tells by itself where its line is."""
        return self.is_name or len(self.places) <= _RARE

    def stands(self, first: int, stop: int) -> bool:
        """Whether it stands from a line up to another."""
        at = bisect_left(self.places, first)
        return at < len(self.places) and self.places[at] < stop

    def nearest(self, line: int) -> list[int]:
        """The places that are nearest to a line, the nearest first."""
        at = bisect_left(self.places, line)
        around = self.places[max(0, at - _NEAREST) : at + _NEAREST]
        return sorted(around, key=lambda place: (abs(place - line), place))[:_NEAREST]


def anchors_of(
    manual: Manual, line: int, claims: Collection[Claim], numbers: Iterable[Fraction], headings: Collection[int]
) -> list[Anchor]:
    """All anchors of a line: those of the claims that cite it, and the numbers that errata say are printed there."""
    with_heading = [claim for claim in claims if claim.fact != "section" or claim.words[0] in manual.numbered]
    has_code = any(claim.fact == "code" for claim in claims)
    lacks_heading = len(with_heading) < len(claims)
    anchors = [_anchor(manual, claim, line, has_code, lacks_heading) for claim in with_heading]
    anchors += [Anchor(manual.lines_of.get(abs(number), []), of_erratum=True) for number in numbers]
    anchors = [anchor for anchor in anchors if anchor.places]
    if any(anchor.is_name for anchor in anchors):
        return anchors
    titled = [anchor for anchor in anchors if anchor.is_title and not set(anchor.places).isdisjoint(headings)]
    return [replace(anchor, opens=not titled or anchor in titled) for anchor in anchors]


def _anchor(manual: Manual, claim: Claim, line: int, has_code: bool, lacks_heading: bool) -> Anchor:
    if claim.fact == "section":
        heading = manual.numbered[claim.words[0]]
        return Anchor([heading], ((heading, manual.end_of_section(claim.words[0])),), is_name=True, opens=True)
    last = next((last - first for first, last in claim.cited if first == line and last), None)
    is_title = claim.fact == "title" and claim.kind_of_subject in _WITH_TITLES
    if claim.is_address:
        opens = claim.anchor and not (has_code or lacks_heading)
    else:
        opens = claim.anchor or (is_title and lacks_heading and not has_code)
    length = None if last is None else last + 1
    return Anchor(_places(manual, claim), (), claim.anchor, length, opens, is_title)


def _places(manual: Manual, claim: Claim) -> list[int]:
    """The lines with a claim's numbers or words; a label whose words are glued to others is found by its number."""
    if claim.fact == "bytes":
        return manual.lines_with_bytes(claim.shown[:_BYTES])
    by_words = {place for word in claim.words for place in manual.lines_with(word)} if not claim.numbers else set()
    numbers = claim.numbers or (claim.beside if not by_words else ())
    return sorted(by_words.union(*(manual.lines_of.get(number, ()) for number in numbers)))
