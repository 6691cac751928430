"""Where the cited lines of a manual stand in an edition that changed.

No copy of the old edition is needed: codes, sections and addresses tell one place from another. Lines move in runs, so
the shifts of all cited lines are chosen together: as many as possible of their anchors stand where the shift leads,
with as few changes of the shift as possible.
"""

from __future__ import annotations

from bisect import bisect_left
from collections import Counter
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from fieldscribe.audit.claims import Claim
    from fieldscribe.audit.manual import Manual

_LOST, _NOT_FIRST, _BELOW, _CHANGE = 10.0, 1.0, 0.5, 3.0
"""What it costs: no anchor stands in the place; none opens it; its section's heading does not; the shift changes."""
_LONGEST = 40
"""A place without a cited line below it is not longer."""
_MERGED = 10
"""A cell that is merged with those below it stands at most so many rows above."""
_HOPELESS = 60.0
"""A sequence that costs so much more than the best is given up."""
_COMMON, _NEAREST = 12, 3
"""How many shifts are tried for all lines, and how many places of an anchor for its own line."""


@dataclass(frozen=True, slots=True)
class _Anchor:
    """The lines that have an anchor, and the spans in which what it belongs to may begin."""

    places: list[int]
    spans: tuple[tuple[int, int], ...] = ()


def placement(manual: Manual, cited: Sequence[int], claims: Mapping[int, list[Claim]]) -> dict[int, int]:
    """The line where each cited line stands now."""
    anchors = [[found for claim in claims.get(line, ()) if (found := _anchor(manual, claim))] for line in cited]
    own = [_candidates(line, one) for line, one in zip(cited, anchors, strict=True)]
    common = [shift for shift, _ in Counter(shift for one in own for shift in one).most_common(_COMMON)]
    states = [dict.fromkeys((0, *common, *one)) for one in own]
    shifts = _Search(manual, cited, anchors).cheapest(states)
    return {line: line + shift for line, shift in zip(cited, shifts, strict=True)}


def _anchor(manual: Manual, claim: Claim) -> _Anchor | None:
    """Where an anchor stands; None for one that tells no place (a section without a number, a fact that is nowhere)."""
    if claim.fact == "section":
        heading = manual.numbered.get(claim.words[0])
        return None if heading is None else _Anchor([heading], ((heading, manual.end_of_section(claim.words[0])),))
    if claim.words:
        places = manual.lines_with(claim.words[0])
    else:
        places = sorted({place for number in claim.numbers for place in manual.lines_of.get(number, ())})
    return _Anchor(places) if places else None


def _candidates(line: int, anchors: list[_Anchor]) -> dict[int, None]:
    """Shifts that lead from a line to places of its anchors, the nearest of each."""
    shifts: dict[int, None] = {}
    for anchor in anchors:
        at = bisect_left(anchor.places, line)
        around = anchor.places[max(0, at - _NEAREST) : at + _NEAREST]  # they are in order
        nearest = sorted(around, key=lambda place: (abs(place - line), place))[:_NEAREST]
        shifts.update(dict.fromkeys(place - line for place in nearest))
    return shifts


class _Search:
    """Finds the cheapest sequence of shifts, line by line, keeping the best way to each shift."""

    def __init__(self, manual: Manual, cited: Sequence[int], anchors: list[list[_Anchor]]) -> None:
        self.manual, self.cited, self.anchors = manual, cited, anchors
        self.headings = frozenset(manual.headings)

    def cheapest(self, states: list[dict[int, None]]) -> list[int]:
        """One shift for each cited line, of those that are tried for it."""
        costs: dict[int, float] = {0: 0.0}
        steps: list[dict[int, int]] = []
        for index in range(len(self.cited)):
            best = min(costs, key=lambda shift: (costs[shift], abs(shift), shift))
            changed = costs[best] + _CHANGE
            now: dict[int, float] = {}
            step: dict[int, int] = {}
            for shift in dict.fromkeys((*states[index], *costs)):
                stays = costs.get(shift)
                step[shift] = shift if stays is not None and stays <= changed else best
                now[shift] = (changed if step[shift] != shift else costs[shift]) + self._cost(index, shift)
            least = min(now.values())
            costs = {shift: cost for shift, cost in now.items() if cost <= least + _HOPELESS}
            steps.append(step)
        shift = min(costs, key=lambda one: (costs[one], abs(one), one), default=0)
        result = []
        for step in reversed(steps):
            result.append(shift)
            shift = step[shift]
        return result[::-1]

    def _cost(self, index: int, shift: int) -> float:
        """How badly a place fits: the share of its anchors that do not stand in it, and whether one opens it."""
        anchors, line = self.anchors[index], self.cited[index]
        if not anchors:
            return 0.0
        length = self.cited[index + 1] - line if index + 1 < len(self.cited) else _LONGEST
        start, end = line + shift, line + shift + min(length, _LONGEST)
        if start in self.headings:
            end = max(end, self.manual.section_of(start).last + 1)
        start_of_cells = start - _MERGED if self.manual.is_merged(start) else start
        lost, opens = 0, False
        for anchor in anchors:
            at = bisect_left(anchor.places, start_of_cells)
            there = at < len(anchor.places) and anchor.places[at] < end
            if not there and not any(low <= start <= high for low, high in anchor.spans):
                lost += 1
            opens = opens or start in anchor.places
        below = any(anchor.spans and start not in anchor.places for anchor in anchors)
        return _LOST * lost / len(anchors) + (0.0 if opens else _NOT_FIRST) + (_BELOW if below else 0.0)
