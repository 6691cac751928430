"""Where the cited lines of a manual stand in an edition that changed.

No copy of the old edition is needed: codes, sections and addresses tell one place from another. Lines move in runs, so
the shifts of all cited lines are chosen together: as many as possible of their anchors stand where the shift leads,
with as few changes of the shift as possible.
"""

from __future__ import annotations

import re
from bisect import bisect_left, bisect_right
from collections import Counter
from typing import TYPE_CHECKING

from fieldscribe.records import dataclass

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence
    from fractions import Fraction

    from fieldscribe.audit.citing import Claim
    from fieldscribe.audit.manual import Manual

_LOST, _NOT_FIRST, _BELOW, _CHANGE, _BACK = 10.0, 1.0, 0.5, 6.0, 10.0
"""Costs of a place: no anchor stands in it; none stands on its first line; that line is not its section's heading;
it is shifted otherwise than the place above; it stands above that place, and not where rows between may be gone.

A changed shift costs more than half of a lost anchor, so that a line with one anchor does not move alone: most
likely its number was changed.
"""
_MOST = 2
"""Several lost codes, sections and addresses of a line cost at most so many times as much as a single one."""
_STRONG, _WEAK = 3, 2
"""The weight of a code, a section or an address, and the weight of all other facts of a line together."""
_BYTES = 8
"""A frame is searched by so many of its first digits."""
_LONGEST = 40
"""A place ends after at most so many lines, where the next cited line is farther away."""
_MERGED = 10
"""The text of a merged cell stands at most so many rows above."""
_GONE = 10
"""At most so many rows are gone together."""
_BLANK_CELL = re.compile(r"\|\s*\|")
_FITS, _FITS_NEARLY = 1.0, 7.0
"""A place that costs less fits: nothing is lost, and it begins with one of its anchors; or nothing of weight is lost."""
_HOPELESS = 3 * _CHANGE
"""A sequence of shifts that costs so much more than the best is given up: with one change the best is cheaper."""
_COMMON, _NEAREST = 12, 3
"""How many of the most frequent shifts are tried for every line, and how many of its own for each anchor."""
_RARE = 3
"""A fact that stands in at most so many lines tells by itself where its line is."""
_NEIGHBOURS, _FEW = 6, 3
"""Then each line tries the shifts of so many lines above and below, and those that differ by so little."""


@dataclass(frozen=True, slots=True)
class _Anchor:
    """A fact that tells where a cited line is now: the lines with it, spans in which the line may lie, its weight."""

    places: list[int]
    spans: tuple[tuple[int, int], ...] = ()
    weight: int = 1
    length: int | None = None
    """How many lines the fact may take from the cited line on; None: as long as the place is."""


def placement(
    manual: Manual,
    cited: Sequence[int],
    claims: Mapping[int, list[Claim]],
    numbers: Mapping[int, Iterable[Fraction]],
) -> dict[int, int]:
    """Where each line stands now that a claim cites, or an erratum (`numbers`: what it says is printed there)."""
    lines = sorted({*cited, *numbers})
    anchors = [_anchors(manual, line, claims.get(line, ()), numbers.get(line, ())) for line in lines]
    search = _Search(manual, lines, _lengths(lines, cited), anchors)
    if search.cost_of_staying < _CHANGE:  # nothing can be cheaper: each other way has a change in it
        return {line: line for line in lines}
    own_shifts = [_candidates(line, anchors_of_line) for line, anchors_of_line in zip(lines, anchors, strict=True)]
    common = [
        shift
        for shift, _ in Counter(shift for shifts_of_line in own_shifts for shift in shifts_of_line).most_common(_COMMON)
    ]
    states = [dict.fromkeys((0, *common, *shifts_of_line)) for shifts_of_line in own_shifts]
    shifts = search.cheapest(states)
    nearby = [shifts[max(0, at - _NEIGHBOURS) : at + _NEIGHBOURS + 1] for at in range(len(lines))]
    shifts = search.cheapest([dict.fromkeys(_around(shifts_nearby)) for shifts_nearby in nearby])
    return dict(zip(lines, search.snapped(shifts), strict=True))


def _around(shifts: Iterable[int]) -> Iterator[int]:
    """Shifts, and those that a few lines more or fewer between two places make of them."""
    for shift in dict.fromkeys(shifts):
        yield from range(shift - _FEW, shift + _FEW + 1)


def _lengths(lines: Sequence[int], cited: Sequence[int]) -> list[int]:
    """How many lines the place has that begins at each line: up to the next line that a claim cites."""
    ends = [*cited, lines[-1] + _LONGEST if lines else 0]
    return [min(_LONGEST, max(1, ends[min(bisect_right(cited, line), len(cited))] - line)) for line in lines]


def _anchors(manual: Manual, line: int, claims: Iterable[Claim], numbers: Iterable[Fraction]) -> list[_Anchor]:
    anchors = [_anchor(manual, claim, line) for claim in claims]
    anchors += [_Anchor(manual.lines_of.get(abs(number), [])) for number in numbers]
    return [anchor for anchor in anchors if anchor is not None and anchor.places]


def _anchor(manual: Manual, claim: Claim, line: int) -> _Anchor | None:
    """The anchor of a claim; None for a section that has no numbered heading."""
    if claim.fact == "section":
        heading = manual.numbered.get(claim.words[0])
        if heading is None:
            return None
        return _Anchor([heading], ((heading, manual.end_of_section(claim.words[0])),), _STRONG)
    places = _places(manual, claim)
    last = next((last - first for first, last in claim.cited if first == line and last), None)
    return _Anchor(places, (), _STRONG if claim.anchor else 1, None if last is None else last + 1)


def _places(manual: Manual, claim: Claim) -> list[int]:
    """The lines with a claim's numbers or words; a label whose words are glued to others is found by its number."""
    if claim.fact == "bytes":
        return manual.lines_with_bytes(claim.shown[:_BYTES])
    by_words = {place for word in claim.words for place in manual.lines_with(word)} if not claim.numbers else set()
    numbers = claim.numbers or (claim.beside if not by_words else ())
    return sorted(by_words.union(*(manual.lines_of.get(number, ()) for number in numbers)))


def _candidates(line: int, anchors: list[_Anchor]) -> dict[int, None]:
    """The shifts that bring a line to the nearest places of each of its strong anchors, and of what is rare."""
    shifts: dict[int, None] = {}
    for anchor in anchors:
        if anchor.weight < _STRONG and len(anchor.places) > _RARE:
            continue
        at = bisect_left(anchor.places, line)
        around = anchor.places[max(0, at - _NEAREST) : at + _NEAREST]  # places are sorted
        nearest = sorted(around, key=lambda place: (abs(place - line), place))[:_NEAREST]
        shifts.update(dict.fromkeys(place - line for place in nearest))
    return shifts


class _Search:
    """Finds the cheapest sequence of shifts, line by line, keeping the best way to each shift."""

    def __init__(self, manual: Manual, cited: Sequence[int], lengths: list[int], anchors: list[list[_Anchor]]) -> None:
        self.manual, self.cited, self.lengths, self.anchors = manual, cited, lengths, anchors
        self.headings = frozenset(manual.headings)
        self.with_blank_cells = {number for number, line in enumerate(manual.lines, 1) if _BLANK_CELL.search(line)}
        strong = ([anchor.places for anchor in of_line if anchor.weight == _STRONG] for of_line in anchors)
        self.opening = [min(places, key=len, default=[]) for places in strong]

    @property
    def cost_of_staying(self) -> float:
        """What it costs if no line moved."""
        return sum(self._cost(index, 0) for index in range(len(self.cited)))

    def cheapest(self, states: list[dict[int, None]]) -> list[int]:
        """One shift for each cited line, of those that are tried for it."""
        costs: dict[int, float] = {0: 0.0}
        worst = self.cost_of_staying
        steps: list[dict[int, int]] = []
        for index in range(len(self.cited)):
            best = min(costs, key=lambda shift: (costs[shift], abs(shift), shift))
            above = best + self.cited[max(0, index - 1)] - self.cited[index] - _GONE
            now: dict[int, float] = {}
            step: dict[int, int] = {}
            for shift in dict.fromkeys((*states[index], *costs)):
                stays = costs.get(shift)
                changed = costs[best] + (_CHANGE if shift > above else _BACK)
                step[shift] = shift if stays is not None and stays <= changed else best
                now[shift] = (changed if step[shift] != shift else costs[shift]) + self._cost(index, shift)
            bound = min(worst, min(now.values()) + _HOPELESS)
            costs = {shift: cost for shift, cost in now.items() if cost <= bound}
            steps.append(step)
        shift = min(costs, key=lambda shift: (costs[shift], abs(shift), shift), default=0)
        result = []
        for step in reversed(steps):
            result.append(shift)
            shift = step[shift]
        return result[::-1]

    def snapped(self, shifts: list[int]) -> list[int]:
        """Where each line stands: one that does not fit where its run leads stands where it fits, between its like."""
        places = [line + shift for line, shift in zip(self.cited, shifts, strict=True)]
        costs = [self._cost(index, shift) for index, shift in enumerate(shifts)]
        above = 0
        for index, line in enumerate(self.cited):
            if costs[index] >= _BELOW:
                following = (at for at in range(index + 1, len(places)) if costs[at] < _FITS)
                below = next((places[at] for at in following), len(self.manual) + 1)
                own = self.anchors[index]
                between = {place for anchor in own for place in anchor.places if above < place < below}
                tried = [(self._cost(index, place - line), abs(place - places[index]), place) for place in between]
                cost, _, place = min(tried, default=(_LOST, 0, 0))
                enough = _FITS_NEARLY if any(anchor.weight == _STRONG for anchor in own) else _FITS
                if cost < enough and cost <= costs[index] - _BELOW:
                    places[index], costs[index] = place, cost
            if costs[index] < _FITS:
                above = places[index]
        return places

    def _cost(self, index: int, shift: int) -> float:
        """How badly a place fits: the share of the line's anchors that do not stand in it, and how it begins."""
        anchors, line = self.anchors[index], self.cited[index]
        if not anchors:
            return 0.0
        start, end = line + shift, line + shift + self.lengths[index]
        if start in self.headings:
            end = max(end, self.manual.section_of(start).last + 1)
        above = start - _MERGED if start in self.with_blank_cells else start
        start_of_cells = above if self.manual.is_merged(start) else start
        strong, weak = [0, 0], [0, 0]  # how many are lost, and how many there are
        opens_weakly = False
        for anchor in anchors:
            stop = end if anchor.length is None else start + anchor.length
            at = bisect_left(anchor.places, start_of_cells if anchor.weight == _STRONG else above)
            stands = at < len(anchor.places) and anchor.places[at] < stop
            lost = not stands and not any(low <= start <= high for low, high in anchor.spans)
            count = strong if anchor.weight == _STRONG else weak
            count[0] += lost
            count[1] += 1
            opens_weakly = opens_weakly or start in anchor.places
        below = any(anchor.spans and start not in anchor.places for anchor in anchors)
        whole = _STRONG * strong[1] + (_WEAK if weak[1] else 0)
        share = (_STRONG * strong[0] + _WEAK * weak[0] / max(1, weak[1])) / max(whole, _STRONG)
        cost = _LOST * share * min(_MOST, max(1, strong[1]))
        first = start in self.opening[index] if strong[1] else opens_weakly
        return cost + (0.0 if first else _NOT_FIRST) + (_BELOW if below else 0.0)
