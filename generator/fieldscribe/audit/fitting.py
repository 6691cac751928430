"""How well a cited line fits to a place of a text, by the facts that tell where it is."""

from __future__ import annotations

import re
from bisect import bisect_right
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from fieldscribe.audit.anchors import Anchor
    from fieldscribe.audit.manual import Manual

_LOST, _NOT_FIRST, _BELOW = 10.0, 1.0, 0.5
"""Costs of a place: no anchor stands in it; none stands on its first line; that line is not its section's heading."""
_MOST = 2
"""Several lost codes, sections and addresses of a line cost at most so many times as much as a single one."""
_NAME, _OTHERS = 3, 2
"""The weight of a code, a section or an address, and the weight of all other facts of a line together."""
_BLANK_CELL = re.compile(r"\|\s*\|")
_FITS, _FITS_NEARLY = 1.0, 7.0
"""A place that costs less fits: nothing is lost, and it begins as it should; or no name is lost."""
_CLOSE, _SOME = 8, 0.6
"""So close to where it was placed a line stands elsewhere if that costs so much less; farther off, if it begins so."""
_SEVERAL = 32
"""A fact that stands in more lines says nothing of where a place begins."""


class Fitting:
    """What it costs to place each cited line at a line of the text, and where it fits best nearby."""

    def __init__(
        self, manual: Manual, cited: Sequence[int], lengths: Sequence[int], anchors: Sequence[list[Anchor]]
    ) -> None:
        self.manual, self.cited, self.lengths, self.anchors = manual, cited, lengths, anchors
        self.named = [any(anchor.is_name for anchor in of_line) for of_line in anchors]
        self._headings = manual.headings
        self._is_heading = frozenset(manual.headings)
        self._with_blank_cells = {number for number, line in enumerate(manual.lines, 1) if _BLANK_CELL.search(line)}
        self._merged: dict[int, set[int]] = {}

    def cost(self, index: int, start: int) -> float:
        """How badly a place fits: the share of the line's anchors that do not stand in it, and how it begins."""
        anchors = self.anchors[index]
        if not anchors:
            return 0.0
        end = start + self.lengths[index]
        if start in self._is_heading:
            end = max(end, self.manual.section_of(start).last + 1)
        merged, is_merged = self._merged_from(start), self.manual.is_merged(start)
        names, names_lost, others, others_lost, beside = 0, 0, 0.0, 0.0, 0.0
        opens = below = False
        for anchor in anchors:
            stop = end if anchor.length is None else start + anchor.length
            stands = anchor.stands(start, stop) or any(anchor.stands(line, line + 1) for line in merged)
            lost = not stands and not any(low <= start <= high for low, high in anchor.spans)
            on_first_line = anchor.stands(start, start + 1)
            if anchor.is_name:
                names, names_lost = names + 1, names_lost + lost
            else:
                others += anchor.worth
                others_lost += anchor.worth * lost
                beside += anchor.worth * (not on_first_line)
            opens = opens or (on_first_line and (anchor.opens or (anchor.is_name and is_merged)))
            below = below or (bool(anchor.spans) and not on_first_line)
        whole = _NAME * names + (_OTHERS if others else 0)
        share = (_NAME * names_lost + (_OTHERS * others_lost / others if others else 0.0)) / max(whole, _NAME)
        cost = _LOST * share * min(_MOST, max(1, names))
        if is_merged and others:  # rows that have their name in common differ by what stands in them
            cost += _NOT_FIRST * beside / others
        return cost + (0.0 if opens else _NOT_FIRST) + (_BELOW if below else 0.0)

    def snapped(self, places: list[int]) -> list[int]:
        """Where each line stands: one that does not fit where its run leads stands where it fits, between its like."""
        places = list(places)
        costs = [self.cost(index, place) for index, place in enumerate(places)]
        below = [len(self.manual) + 1] * (len(places) + 1)
        for index in range(len(places) - 1, -1, -1):
            below[index] = places[index] if costs[index] < _FITS else below[index + 1]
        above, taken = 0, set(places)
        for index in range(len(places)):
            if costs[index] > (0.0 if self.named[index] else _NOT_FIRST):
                self._snap(index, places, costs, above, below[index + 1], taken)
            if not self.named[index]:
                places[index] = self._first_of(index, places[index])
            if costs[index] < _FITS:
                above = places[index]
        return places

    def _snap(  # noqa: PLR0913, PLR0917 - the state of one walk down the lines
        self, index: int, places: list[int], costs: list[float], above: int, below: int, taken: set[int]
    ) -> None:
        there = places[index]
        near = {place for anchor in self.anchors[index] for place in anchor.nearest(there)}
        between = [place for place in near if above < place < below and place not in taken]
        cost, away, place = min(
            ((self.cost(index, place), abs(place - there), place) for place in between), default=(_LOST, 0, 0)
        )
        enough = _FITS_NEARLY if self.named[index] else _FITS
        if cost < enough and cost <= costs[index] - (_SOME if away <= _CLOSE else _NOT_FIRST):
            places[index], costs[index] = place, cost

    def _first_of(self, index: int, place: int) -> int:
        """Where the facts begin that few lines have, of a place without a name: at the heading above, or with them."""
        anchors = self.anchors[index]
        if place in self._is_heading or any(anchor.of_erratum or anchor.length is not None for anchor in anchors):
            return place  # who names the last line means the first one, too; and errata are sentences on a passage
        end = place + self.lengths[index]
        several = (anchor for anchor in anchors if len(anchor.places) <= _SEVERAL)
        firsts = [next(at for at in anchor.places if at >= place) for anchor in several if anchor.stands(place, end)]
        first = min(firsts, default=place)
        above = bisect_right(self._headings, first)
        heading = self._headings[above - 1] if above else 0
        return heading if heading > place else first

    def _merged_from(self, start: int) -> set[int]:
        """The rows above from which a row has cells."""
        if start not in self._with_blank_cells:
            return set()
        if start not in self._merged:
            self._merged[start] = {line for line, _, _ in self.manual.merged_cells(start)}
        return self._merged[start]
