"""Labels beside their numbers: the entries of an enum or of a word's flags, in the order of the description."""

from __future__ import annotations

from bisect import bisect_left
from collections import Counter
from dataclasses import dataclass
from itertools import islice, product
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence

    from fieldscribe.audit.citing import Claim
    from fieldscribe.audit.manual import Token
    from fieldscribe.audit.passage import Passage


_NEARLY_ALL = 0.75
"""The share of labels that stand right behind their numbers, from which on all have to."""
_FEW = 4
"""So many labels of a list have to stand before they show a column."""
_LABEL = 1000
"""A label weighs more than all numbers without one."""


@dataclass(frozen=True, slots=True)
class Standing:
    """Where a label stands: its claim, its place in the passage, and the numbers that belong to it."""

    claim: Claim
    place: int
    tokens: tuple[Token, ...]
    end: int
    """Where the next one may begin."""


def standing(claims: Sequence[Claim], passage: Passage) -> list[Standing]:
    """As many labels as stand beside their numbers, all on the same side of them, in one order and one column."""
    if len(claims) == 1 and not claims[0].beside and claims[0].words:
        return list(islice(_candidates(claims[0], passage, False, False, False), 1))
    anywhere = _beside_alike(_standing(claims, passage))
    columns = {with_words: _column(anywhere, passage, with_words=with_words) for with_words in (False, True)}
    strays = {label.claim for label in anywhere if _strays(label, passage, columns)}
    alone = Counter(_entry(claim) for claim in strays if claim.words)
    strays = {claim for claim in strays if not claim.words or alone[_entry(claim)] == 1}  # a whole entry may be apart
    if not strays:
        return anywhere
    in_column = [label for label in _standing(claims, passage, columns) if label.claim in strays]
    return [*(label for label in anywhere if label.claim not in strays), *in_column]


def _beside_alike(labels: list[Standing]) -> list[Standing]:
    """Without the labels beside another kind of number than nearly all others: a 2 is bit 2, or the mask of bit 1."""
    flags = [label for label in labels if label.claim.bit and label.tokens]
    at_bits = [label for label in flags if label.tokens[0].is_plainly(label.claim.bit)]
    if len(flags) < _FEW or len(at_bits) < _NEARLY_ALL * len(flags):
        return labels
    return [label for label in labels if label not in flags or label in at_bits]


def _entry(claim: Claim) -> int | None:
    return claim.entry[0] if claim.entry else None


def _column(labels: Iterable[Standing], passage: Passage, *, with_words: bool) -> int | None:
    """The column of a table in which nearly all labels (or numbers without one) of a list stand."""
    alike = [passage.column(label.place) for label in labels if bool(label.claim.words) == with_words]
    column, times = Counter(alike).most_common(1)[0] if alike else (None, 0)
    return column if times >= _NEARLY_ALL * len(alike) and len(alike) >= _FEW else None


def _strays(label: Standing, passage: Passage, columns: Mapping[bool, int | None]) -> bool:
    """Whether a label stands outside the column of its list."""
    column = columns[bool(label.claim.words)]
    return column is not None and passage.column(label.place) not in (None, column)


def _standing(
    claims: Sequence[Claim], passage: Passage, columns: Mapping[bool, int | None] | None = None
) -> list[Standing]:
    """The labels of a list in their order; one may also stand apart, before or behind all others."""
    numberings = (False, True) if any(claim.or_beside for claim in claims) else (False,)
    tight = _best(claims, passage, product((False, True), numberings, (True,)), columns)
    loose = _best(claims, passage, product((False, True), numberings, (False,)), columns)
    if not tight or _weight(tight) < _NEARLY_ALL * _weight(loose):
        return loose
    listed = {label.claim for label in tight}
    first, last = min(label.place for label in tight), max(label.place for label in tight)
    others = (label for label in loose if label.claim.words and label.claim not in listed)
    return [*tight, *(label for label in others if not first <= label.place <= last)]


def _best(
    claims: Sequence[Claim],
    passage: Passage,
    ways: Iterable[tuple[bool, bool, bool]],
    columns: Mapping[bool, int | None] | None,
) -> list[Standing]:
    best: list[Standing] = []
    orders = (False, True) if any(claim.beside or not claim.words for claim in claims) else (False,)
    for after, otherwise, tight in ways:
        candidates = {claim: list(_candidates(claim, passage, after, otherwise, tight)) for claim in claims}
        beside = {label.tokens[0] for labels in candidates.values() for label in labels if label.claim.beside}
        for claim, labels in candidates.items():
            if claim.fact == "flags" and not claim.words:  # the number beside a label is no mask
                labels[:] = [label for label in labels if label.tokens[0] not in beside]
        if columns is not None:
            candidates = {
                claim: [label for label in labels if not _strays(label, passage, columns)]
                for claim, labels in candidates.items()
            }
        for backwards in orders:  # bits may be listed from the highest; words alone have only their order
            ordered = sorted(claims, key=lambda claim: _rank(claim, backwards=backwards))
            chain = _weightiest_chain([candidates[claim] for claim in ordered])
            chain += _apart(chain, [candidates[claim] for claim in claims])
            best = max(best, chain, key=_weight)
            if len(best) == len(claims):
                return best
    return best


def _weight(chain: Sequence[Standing]) -> int:
    return sum(_LABEL if label.claim.words else 1 for label in chain)


def _apart(chain: Sequence[Standing], rows: Iterable[Sequence[Standing]]) -> list[Standing]:
    if not chain:
        return []
    listed = {label.claim for label in chain}
    first, last = chain[0].place, chain[-1].place
    others = (row for row in rows if row and row[0].claim.beside and row[0].claim not in listed)
    outside = ([label for label in row if not first <= label.place <= last] for row in others)
    return [labels[0] for labels in outside if labels]


def _rank(claim: Claim, *, backwards: bool) -> tuple[int, int]:
    entry, part = claim.entry or (0, 0)
    return (-entry if backwards else entry, part)


def _candidates(claim: Claim, passage: Passage, after: bool, otherwise: bool, tight: bool) -> Iterator[Standing]:
    """Where a label may stand: behind its number or `after` it, beside that or the other one, right beside or not."""
    wanted = claim.or_beside if otherwise and claim.or_beside else claim.beside
    if not claim.words:
        for token, start in zip(passage.tokens, passage.starts, strict=True):
            if token.readings & claim.numbers:
                yield Standing(claim, start, (token,), start + 1)
    for first, end in sorted({place for words in claim.words for place in passage.places(words)}):
        beside = passage.after(end) if after else passage.before(first)
        if not wanted:
            yield Standing(claim, first, tuple(passage.inside(first, end)), end)
        elif beside is not None and beside.readings & wanted and not (tight and passage.is_apart(beside, first, end)):
            yield Standing(claim, first, (beside, *passage.inside(first, end)), end)


def _weightiest_chain(rows: Sequence[Sequence[Standing]]) -> list[Standing]:
    """At most one of each row, at rising places: as many labels as there can be, and as many numbers beside."""
    places = sorted({label.place for row in rows for label in row})
    best: list[tuple[int, int]] = [(0, -1)] * (len(places) + 1)  # a tree: the best chain that ends before each place
    links: list[tuple[Standing, int]] = []
    for row in rows:
        ends = []
        for label in row:
            rank = bisect_left(places, label.place)
            weight, before = _best_before(best, rank)
            links.append((label, before))
            ends.append(
                (bisect_left(places, label.end) - 1, weight + (_LABEL if label.claim.words else 1), len(links) - 1)
            )
        for rank, weight, link in ends:  # at once, so that one row never follows itself
            _add(best, rank, (weight, link))
    chain: list[Standing] = []
    _, link = _best_before(best, len(places))
    while link >= 0:
        label, link = links[link]
        chain.append(label)
    return chain[::-1]


def _best_before(best: list[tuple[int, int]], rank: int) -> tuple[int, int]:
    result = best[0]
    while rank > 0:
        result = max(result, best[rank])
        rank -= rank & -rank
    return result


def _add(best: list[tuple[int, int]], rank: int, end: tuple[int, int]) -> None:
    rank += 1
    while rank < len(best):
        best[rank] = max(best[rank], end)
        rank += rank & -rank
