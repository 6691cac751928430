"""Where the cited lines of a manual stand in an edition that changed.

No copy of the old edition is needed: codes, sections, addresses and what few lines have tell one place from another.
Lines move in runs, so the shifts of all cited lines are chosen together: as many as possible of their anchors stand
where the shift leads, with as few changes of the shift as possible.
"""

from __future__ import annotations

from bisect import bisect_right
from collections import Counter
from math import log2
from typing import TYPE_CHECKING

from fieldscribe.audit.anchors import anchors_of
from fieldscribe.audit.fitting import Fitting

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence
    from fractions import Fraction

    from fieldscribe.audit.anchors import Anchor
    from fieldscribe.audit.citing import Claim
    from fieldscribe.audit.manual import Manual

_CHANGE, _BACK, _TORN = 6.0, 10.0, 0.6
"""Costs of a shift: it is another than that of the line above; it leads above that line, and not where rows between may
be gone; something came between lines that stood beside each other.

A changed shift costs more than half of a lost anchor, so that a line with one anchor does not move alone: most
likely its number was changed.
"""
_BESIDE = 2
"""Lines stood beside each other if they are no farther apart."""
_NEAR = 0.1
"""Of shifts that fit alike the nearest is taken: what a shift costs for each time that it is twice as far."""
_GONE = 10
"""At most so many rows are gone together."""
_LONGEST = 40
"""A place ends after at most so many lines, where the next cited line is farther away."""
_HOPELESS = 3 * _CHANGE
"""A sequence of shifts that costs so much more than the best is given up: with one change the best is cheaper."""
_COMMON = 12
"""How many of the most frequent shifts are tried for every line, beside those that its own anchors ask for."""
_NEIGHBOURS, _FEW = 6, 3
"""Then each line tries the shifts of so many lines above and below, and those that differ by so little."""


def placement(
    manual: Manual,
    cited: Sequence[int],
    claims: Mapping[int, list[Claim]],
    numbers: Mapping[int, Iterable[Fraction]],
) -> dict[int, int]:
    """Where each line stands now that a claim cites, or an erratum (`numbers`: what it says is printed there)."""
    lines, headings = sorted({*cited, *numbers}), frozenset(manual.headings)
    anchors = [anchors_of(manual, line, claims.get(line, ()), numbers.get(line, ()), headings) for line in lines]
    search = _Search(Fitting(manual, lines, _lengths(lines, cited), anchors))
    if search.cost_of_staying < _CHANGE:  # nothing can be cheaper: each other way has a change in it
        return {line: line for line in lines}
    own = [list(_own_shifts(line, of_line)) for line, of_line in zip(lines, anchors, strict=True)]
    often = [shift for shift, _ in Counter(shift for of_line in own for shift in of_line).most_common(_COMMON)]
    shifts = search.cheapest([(0, *often, *of_line) for of_line in own])
    near = (shifts[max(0, at - _NEIGHBOURS) : at + _NEIGHBOURS + 1] for at in range(len(lines)))
    beside = (_shifts_beside(line, shifts[max(0, at - 1)], anchors[at]) for at, line in enumerate(lines))
    shifts = search.cheapest([(*_around(ours), *theirs) for ours, theirs in zip(near, beside, strict=True)])
    places = search.fitting.snapped([line + shift for line, shift in zip(lines, shifts, strict=True)])
    return dict(zip(lines, places, strict=True))


def _own_shifts(line: int, anchors: Iterable[Anchor]) -> Iterator[int]:
    """The shifts that bring a line to the nearest places of its names, and of what is rare; each once."""
    rare = (anchor for anchor in anchors if anchor.is_rare)
    yield from dict.fromkeys(place - line for anchor in rare for place in anchor.nearest(line))


def _shifts_beside(line: int, above: int, anchors: Iterable[Anchor]) -> Iterator[int]:
    """The shifts that bring a line to the places of its facts that are nearest to where the line above leads."""
    for anchor in anchors:
        yield from (place - line for place in anchor.nearest(line + above) if abs(place - line - above) <= _LONGEST)


def _around(shifts: Iterable[int]) -> Iterator[int]:
    """Shifts, and those that a few lines more or fewer between two places make of them."""
    for shift in dict.fromkeys(shifts):
        yield from range(shift - _FEW, shift + _FEW + 1)


def _lengths(lines: Sequence[int], cited: Sequence[int]) -> list[int]:
    """How many lines the place has that begins at each line: up to the next line that a claim cites."""
    ends = [*cited, lines[-1] + _LONGEST if lines else 0]
    return [min(_LONGEST, max(1, ends[min(bisect_right(cited, line), len(cited))] - line)) for line in lines]


class _Search:
    """Finds the cheapest sequence of shifts, line by line, keeping the best way to each shift."""

    def __init__(self, fitting: Fitting) -> None:
        self.fitting, self.cited = fitting, fitting.cited

    @property
    def cost_of_staying(self) -> float:
        """What it costs if no line moved."""
        return sum(self.fitting.cost(index, line) for index, line in enumerate(self.cited))

    def cheapest(self, tried: Iterable[Iterable[int]]) -> list[int]:
        """One shift for each cited line, of those that are tried for it, or for a line above."""
        costs: dict[int, float] = {0: 0.0}
        worst = self.cost_of_staying
        steps: list[dict[int, int]] = []
        for index, shifts in enumerate(tried):
            best = min(costs, key=lambda shift: (costs[shift], abs(shift), shift))
            gap = self.cited[index] - self.cited[max(0, index - 1)]
            torn = _TORN if gap <= _BESIDE else 0.0
            now: dict[int, float] = {}
            step: dict[int, int] = {}
            for shift in dict.fromkeys((*shifts, *costs)):
                stays = costs.get(shift)
                moves = _CHANGE if shift > best - gap - _GONE else _BACK
                changed = costs[best] + moves + torn + _NEAR * log2(1 + abs(shift - best))
                step[shift] = shift if stays is not None and stays <= changed else best
                now[shift] = changed if stays is None or step[shift] != shift else stays
                now[shift] += self.fitting.cost(index, self.cited[index] + shift)
            bound = min(worst, min(now.values()) + _HOPELESS)
            costs = {shift: cost for shift, cost in now.items() if cost <= bound}
            steps.append(step)
        shift = min(costs, key=lambda shift: (costs[shift], abs(shift), shift), default=0)
        result = []
        for step in reversed(steps):
            result.append(shift)
            shift = step[shift]
        return result[::-1]
