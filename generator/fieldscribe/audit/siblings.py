"""Words that many places print alike: where nearly all print them equally often, none prints them less often."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.audit.citing import Claim
    from fieldscribe.audit.manual import Extent

_PLACES = 5
"""So many places have to print the same words before they show how often."""
_OF_ITS_OWN = ("code", "section", "title", "access")
"""Facts that each place prints as often as it likes."""
_ALIKE = 0.8
"""The share of places from which on all have to be alike."""


class Siblings:
    """How often each place prints the words of the facts that cite it."""

    def __init__(self) -> None:
        self._places: dict[tuple[str, tuple[str, ...]], dict[Extent, list[tuple[Claim, int]]]] = {}

    def note(self, claim: Claim, extent: Extent, folded: str) -> None:
        """A place of a fact with its text in small letters."""
        if claim.words and claim.fact not in _OF_ITS_OWN:
            times = sum(folded.count(word.casefold()) for word in claim.words)
            places = self._places.setdefault((claim.fact, claim.words), {})
            places.setdefault(extent, []).append((claim, times))

    def lacking(self) -> Iterator[tuple[Claim, Extent]]:
        """The facts whose words stand less often in their place than in nearly all others like it."""
        for places in self._places.values():
            for facts in {len(noted) for noted in places.values()}:
                yield from _lacking([(extent, *noted[0]) for extent, noted in places.items() if len(noted) == facts])


def _lacking(places: list[tuple[Extent, Claim, int]]) -> Iterator[tuple[Claim, Extent]]:
    """The few of places with equally many facts that print their words less often than the others."""
    usual, count = Counter(times for _, _, times in places).most_common(1)[0]
    if len(places) >= _PLACES and _ALIKE * len(places) <= count < len(places):
        yield from ((claim, extent) for extent, claim, times in places if 0 < times < usual)
