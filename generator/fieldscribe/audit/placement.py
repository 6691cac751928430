"""Where the cited lines of a manual stand in an edition that changed.

No copy of the old edition is needed: codes, sections and addresses tell one place from another. Lines move in runs, so
the shifts of all cited lines are chosen together: as many as possible of their anchors stand where the shift leads,
with as few changes of the shift as possible.
"""

from __future__ import annotations

import re
from bisect import bisect_left, bisect_right
from collections import Counter
from math import log2
from typing import TYPE_CHECKING

from fieldscribe.records import dataclass, replace

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
_GONE = 10
"""At most so many rows are gone together."""
_BLANK_CELL = re.compile(r"\|\s*\|")
_CLOSE, _SOME = 8, 0.6
"""A heading so close to where a line was placed is its own."""
_FITS, _FITS_NEARLY = 1.0, 7.0
"""A place that costs less fits: nothing is lost, and it begins as it should; or nothing of weight is lost."""
_HOPELESS = 3 * _CHANGE
"""A sequence of shifts that costs so much more than the best is given up: with one change the best is cheaper."""
_IN_SECTIONS = ("", "message", "telegram")
"""Of points, messages and telegrams a manual has sections, whose headings may be their titles."""
_BESIDE, _TORN = 2, 0.6
"""What came between lines that stood beside each other costs so much more."""
_NEAR = 0.01
"""Of shifts that fit alike the nearest is taken."""
_COMMON, _NEAREST = 12, 3
"""How many of the most frequent shifts are tried for every line, and how many of its own for each anchor."""
_SEVERAL = 32
"""A fact that stands in more lines says nothing of where a place begins."""
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
    worth: float = 1.0
    """How much one of little weight tells: the more, the fewer lines have it."""
    opens: bool = False
    """Whether the place begins with it: with a code, a section, an address without a code, or else anything."""
    is_address: bool = False
    is_title: bool = False


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
    of_line, headings = list(claims), frozenset(manual.headings)
    hidden = {claim.fact for claim in of_line if claim.fact == "code" or not _has_heading(manual, claim)}
    anchors = [_anchor(manual, claim, line) for claim in of_line if claim.fact not in hidden - {"code"}]
    if hidden:  # an address opens the place of a point that has no other name
        titles = hidden == {"section"}
        anchors = [
            replace(anchor, opens=titles and anchor.is_title) if anchor.is_address or anchor.is_title else anchor
            for anchor in anchors
        ]
    of_errata = (manual.lines_of.get(abs(number), []) for number in numbers)
    anchors += [_Anchor(places, worth=_worth(places)) for places in of_errata]
    anchors = [anchor for anchor in anchors if anchor.places]
    if all(anchor.weight < _STRONG for anchor in anchors):
        titled = [anchor for anchor in anchors if anchor.is_title and not headings.isdisjoint(anchor.places)]
        anchors = [replace(anchor, opens=not titled or anchor in titled) for anchor in anchors]
    return anchors


def _has_heading(manual: Manual, claim: Claim) -> bool:
    return claim.fact != "section" or claim.words[0] in manual.numbered


def _anchor(manual: Manual, claim: Claim, line: int) -> _Anchor:
    """The anchor of a claim."""
    if claim.fact == "section":
        heading = manual.numbered[claim.words[0]]
        return _Anchor([heading], ((heading, manual.end_of_section(claim.words[0])),), _STRONG, opens=True)
    places = _places(manual, claim)
    last = next((last - first for first, last in claim.cited if first == line and last), None)
    return _Anchor(
        places,
        (),
        _STRONG if claim.anchor else 1,
        None if last is None else last + 1,
        _worth(places),
        claim.anchor,
        claim.is_address,
        claim.fact == "title" and claim.kind_of_subject in _IN_SECTIONS,
    )


def _worth(places: Sequence[int]) -> float:
    return 1 / (1 + log2(len(places))) if places else 1.0


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


def _has(places: Sequence[int], first: int, stop: int) -> bool:
    """Whether one of sorted places lies from a line up to another."""
    at = bisect_left(places, first)
    return at < len(places) and places[at] < stop


class _Search:
    """Finds the cheapest sequence of shifts, line by line, keeping the best way to each shift."""

    def __init__(self, manual: Manual, cited: Sequence[int], lengths: list[int], anchors: list[list[_Anchor]]) -> None:
        self.manual, self.cited, self.lengths, self.anchors = manual, cited, lengths, anchors
        self.headings = frozenset(manual.headings)
        self._merged: dict[int, set[int]] = {}
        self.with_blank_cells = {number for number, line in enumerate(manual.lines, 1) if _BLANK_CELL.search(line)}

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
            torn = _TORN if self.cited[index] - self.cited[max(0, index - 1)] <= _BESIDE else 0.0
            now: dict[int, float] = {}
            step: dict[int, int] = {}
            for shift in dict.fromkeys((*states[index], *costs)):
                stays = costs.get(shift)
                near = _NEAR * min(abs(shift - best), _LONGEST)
                changed = costs[best] + near + torn + (_CHANGE if shift > above else _BACK)
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
            named = any(anchor.weight == _STRONG for anchor in self.anchors[index])
            if costs[index] > (0.0 if named else _NOT_FIRST):
                following = (at for at in range(index + 1, len(places)) if costs[at] < _FITS)
                below = next((places[at] for at in following), len(self.manual) + 1)
                own = self.anchors[index]
                between = {place for anchor in own for place in anchor.places if above < place < below}.difference(
                    places
                )
                tried = [(self._cost(index, place - line), abs(place - places[index]), place) for place in between]
                cost, _, place = min(tried, default=(_LOST, 0, 0))
                enough = _FITS_NEARLY if named else _FITS
                gain = _SOME if abs(place - places[index]) <= _CLOSE else _NOT_FIRST
                if cost < enough and cost <= costs[index] - gain:
                    places[index], costs[index] = place, cost
            places[index] = self._below_heading(index, places[index])
            if costs[index] < _FITS:
                above = places[index]
        return places

    def _below_heading(self, index: int, place: int) -> int:
        """The heading below which all facts stand that few lines have, of a place without a name; else its place."""
        anchors = self.anchors[index]
        if any(anchor.weight == _STRONG for anchor in anchors):
            return place
        end = place + self.lengths[index]
        firsts = [
            next((at for at in anchor.places if place <= at < end), None)
            for anchor in anchors
            if len(anchor.places) <= _SEVERAL
        ]
        first = min((at for at in firsts if at is not None), default=place)
        return max((line for line in self.manual.headings if place < line <= first), default=place)

    def _merged_from(self, start: int) -> set[int]:
        """The rows above from which a row has cells."""
        if start not in self.with_blank_cells:
            return set()
        if start not in self._merged:
            self._merged[start] = {line for line, _, _ in self.manual.merged_cells(start)}
        return self._merged[start]

    def _cost(self, index: int, shift: int) -> float:
        """How badly a place fits: the share of the line's anchors that do not stand in it, and how it begins."""
        anchors, line = self.anchors[index], self.cited[index]
        if not anchors:
            return 0.0
        start, end = line + shift, line + shift + self.lengths[index]
        if start in self.headings:
            end = max(end, self.manual.section_of(start).last + 1)
        merged, is_merged = self._merged_from(start), self.manual.is_merged(start)
        strong, weak = [0.0, 0.0], [0.0, 0.0]  # how much is lost, and how much there is
        opens, beside = False, 0.0
        for anchor in anchors:
            stop = end if anchor.length is None else start + anchor.length
            stands = _has(anchor.places, start, stop) or any(_has(anchor.places, line, line + 1) for line in merged)
            lost = not stands and not any(low <= start <= high for low, high in anchor.spans)
            count, worth = (strong, 1.0) if anchor.weight == _STRONG else (weak, anchor.worth)
            count[0] += worth if lost else 0.0
            count[1] += worth
            beside += 0.0 if count is strong or _has(anchor.places, start, start + 1) else worth
            opens = opens or (start in anchor.places and (anchor.opens or (anchor.weight == _STRONG and is_merged)))
        below = any(anchor.spans and start not in anchor.places for anchor in anchors)
        whole = _STRONG * strong[1] + (_WEAK if weak[1] else 0)
        share = (_STRONG * strong[0] + (_WEAK * weak[0] / weak[1] if weak[1] else 0.0)) / max(whole, _STRONG)
        cost = _LOST * share * min(_MOST, max(1, strong[1]))
        if is_merged and weak[1]:  # rows that have their name in common differ by what stands in them
            cost += _NOT_FIRST * beside / weak[1]
        return cost + (0.0 if opens else _NOT_FIRST) + (_BELOW if below else 0.0)
