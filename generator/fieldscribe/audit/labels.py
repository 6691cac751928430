"""Labels beside their numbers: the entries of an enum or of a word's flags, in the order of the description."""

from __future__ import annotations

from bisect import bisect_left
from typing import TYPE_CHECKING

from fieldscribe.records import dataclass

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from fieldscribe.audit.citing import Claim
    from fieldscribe.audit.manual import Token
    from fieldscribe.audit.passage import Passage


@dataclass(frozen=True, slots=True)
class Standing:
    """Where a label stands: its claim, its place in the passage, and the numbers that belong to it."""

    claim: Claim
    place: int
    tokens: tuple[Token, ...]


def standing(claims: Sequence[Claim], passage: Passage) -> list[Standing]:
    """As many labels as stand beside their numbers, all on the same side of them, in one order.

    A label may also stand apart from the list, before or behind all others.
    """
    best: list[Standing] = []
    for after in (False, True):
        candidates = {claim: list(_candidates(claim, passage, after=after)) for claim in claims}
        for backwards in (False, True):
            ordered = sorted(claims, key=lambda claim: _rank(claim, backwards=backwards))
            chain = _longest_chain([candidates[claim] for claim in ordered])
            chain += _apart(chain, [candidates[claim] for claim in claims])
            best = max(best, chain, key=len)
            if len(best) == len(claims):
                return best
    return best


def _apart(chain: Sequence[Standing], rows: Iterable[Sequence[Standing]]) -> list[Standing]:
    if not chain:
        return []
    listed = {label.claim for label in chain}
    first, last = chain[0].place, chain[-1].place
    others = (row for row in rows if row and row[0].claim not in listed)
    outside = ([label for label in row if not first <= label.place <= last] for row in others)
    return [labels[0] for labels in outside if labels]


def _rank(claim: Claim, *, backwards: bool) -> tuple[int, int]:
    entry, part = claim.entry or (0, 0)
    return (-entry if backwards else entry, part)


def _candidates(claim: Claim, passage: Passage, *, after: bool) -> Iterator[Standing]:
    for first, end in sorted({place for words in claim.words for place in passage.places(words)}):
        beside = passage.after(end) if after else passage.before(first)
        if not claim.beside:
            yield Standing(claim, first, tuple(passage.inside(first, end)))
        elif beside is not None and beside.readings & claim.beside:
            yield Standing(claim, first, (beside, *passage.inside(first, end)))


def _longest_chain(rows: Iterable[Sequence[Standing]]) -> list[Standing]:
    """At most one of each row, at rising places, as many as there can be."""
    ends: list[int] = []
    last: list[int] = []
    links: list[tuple[Standing, int]] = []
    for row in rows:
        for label in reversed(row):  # the farthest first, so that one row never follows itself
            at = bisect_left(ends, label.place)
            links.append((label, last[at - 1] if at else -1))
            if at == len(ends):
                ends.append(label.place)
                last.append(len(links) - 1)
            else:
                ends[at], last[at] = label.place, len(links) - 1
    chain: list[Standing] = []
    link = last[-1] if last else -1
    while link >= 0:
        label, link = links[link]
        chain.append(label)
    return chain[::-1]
