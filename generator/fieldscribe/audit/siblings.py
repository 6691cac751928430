"""What many places print alike: where nearly all print a fact equally often, none prints it less often."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from fieldscribe.audit.citing import Claim
    from fieldscribe.audit.manual import Extent

_PLACES = 5
"""So many places have to print the same words before they show how often."""
_MANY_NUMBERS = 20
"""So many places have to print a kind of number before they show how often."""
_OF_ITS_OWN = ("code", "section", "title", "access")
"""Facts that each place prints as often as it likes."""
_ALIKE = 0.8
"""The share of places from which on all have to be alike."""


class Siblings:
    """How often each place prints the facts that cite it: their words, or the numbers that mean them."""

    def __init__(self) -> None:
        self._places: dict[tuple[str, tuple[str, ...]], dict[Extent, list[tuple[Claim, int]]]] = {}
        self._numbers: dict[tuple[str, str], list[tuple[Extent, Claim, int]]] = {}

    def note(self, claim: Claim, extent: Extent, folded: str) -> None:
        """A place of a fact with its text in small letters."""
        if claim.words and claim.fact not in _OF_ITS_OWN:
            times = sum(folded.count(word.casefold()) for word in claim.words)
            places = self._places.setdefault((claim.fact, claim.words), {})
            places.setdefault(extent, []).append((claim, times))

    def note_numbers(self, claim: Claim, extent: Extent, times: int) -> None:
        """A place of a fact, and how many of its numbers mean it."""
        if not claim.optional:
            kind = (claim.fact, claim.kind_of_subject)
            self._numbers.setdefault(kind, []).append((extent, claim, times))

    def lacking(self, subjects: Callable[[Extent], int]) -> Iterator[tuple[Claim, Extent]]:
        """The facts that stand less often in their place than in nearly all others with as many `subjects`."""
        for places in self._places.values():
            for facts in {len(noted) for noted in places.values()}:
                yield from _lacking([(extent, *noted[0]) for extent, noted in places.items() if len(noted) == facts])
        for noted in self._numbers.values():
            alike: dict[int, list[tuple[Extent, Claim, int]]] = {}
            for place in noted:
                alike.setdefault(subjects(place[0]), []).append(place)
            for places_alike in alike.values():
                yield from _one_lacking(places_alike)


def _lacking(places: list[tuple[Extent, Claim, int]]) -> Iterator[tuple[Claim, Extent]]:
    """The few of places with equally many facts that print their words less often than the others."""
    usual, count = Counter(times for _, _, times in places).most_common(1)[0]
    if len(places) >= _PLACES and _ALIKE * len(places) <= count < len(places):
        yield from ((claim, extent) for extent, claim, times in places if 0 < times < usual)


def _one_lacking(places: list[tuple[Extent, Claim, int]]) -> Iterator[tuple[Claim, Extent]]:
    """The place that prints its number less often than the others; another may print it more often in its stead."""
    numbers = {(extent, claim.numbers): (claim, times) for extent, claim, times in reversed(places)}
    usual, count = Counter(times for _, times in numbers.values()).most_common(1)[0]
    less_often = [(claim, extent) for (extent, _), (claim, times) in numbers.items() if 0 < times < usual]
    if len(numbers) >= _MANY_NUMBERS and count >= len(numbers) - 2 and len(less_often) == 1:
        yield from less_often
