"""The places of points whose `at` is one whole number, as it mostly is: how they lie is known once for each kind."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from fieldscribe.language.numbers import plain_number
from fieldscribe.model import Place
from fieldscribe.resolve.telegrams import SPACE

if TYPE_CHECKING:
    from fieldscribe.language.nodes import Map
    from fieldscribe.resolve.addresses import Places
    from fieldscribe.resolve.point_facts import PointFacts
    from fieldscribe.resolve.shapes import Word


class _Layout(NamedTuple):
    """How numbers of a kind lie: how many words, the low one first or not, up to which first address; their numbering.

    Nothing lies at an address up to -1: then each place is worked out from its row.
    """

    words: int
    low_first: bool
    last: int
    numbering: Map | None


_FROM_ROW = _Layout(0, False, -1, None)


class PlainPlaces:
    """Finds the places of points."""

    def __init__(self, places: Places) -> None:
        self._places = places
        self._layouts: dict[int, _Layout] = {}

    def of(self, facts: PointFacts, word: Word, kind: int) -> tuple[Place, Place | None]:
        """Where a point is, and where it is written if that is elsewhere."""
        layout = self._layouts.get(kind)
        if layout is None:
            layout = self._layouts[kind] = self._layout(facts, word)
        at = plain_number(facts.get("at"))
        alone = facts.element is None and facts.use is None and facts.layer("write_at") is None
        if at is None or not (alone and 0 <= at <= layout.last):
            return self._places.places(facts, word.space, word.type, word.bits)
        addresses = (at,) if layout.words == 1 else tuple(range(at, at + layout.words))
        numbers = {} if layout.numbering is None else self._places.numberings.numbers(layout.numbering, at)
        return Place(addresses[::-1] if layout.low_first else addresses, numbers), None

    def _layout(self, facts: PointFacts, word: Word) -> _Layout:
        group = facts.group
        if word.type == "text" or word.space == SPACE or "addressing" in group or group.broken or facts.failed:
            return _FROM_ROW
        words = self._places.count(facts, word.space, word.type, word.bits)
        last = self._places.scope.family.last_address - words + 1
        return _Layout(words, self._places.low_first(facts, word.type), last, group.get("numbering"))
