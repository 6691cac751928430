"""What only one point has, as texts of a language: its call is laid out once for many points, and filled with these."""

from __future__ import annotations

from collections.abc import Callable

from fieldscribe.model import Point
from fieldscribe.targets.runtime_calls.expressions import Leaf, Name
from fieldscribe.targets.runtime_calls.point_call import PointFields
from fieldscribe.targets.runtime_calls.point_expressions import addresses_of, is_limited, number

_MOST_ENDS = 16
"""The ends of at most so many intervals are fields."""
_SINGLE = 4
"""The fields behind these have several texts each."""

Encoders = tuple[Callable[[str], str], Callable[[Leaf], str]]
"""How a language writes a string, and how a string or number."""


def texts_of(point: Point, numbers: str, ends: tuple[str, ...], encoders: Encoders) -> tuple[str, ...]:
    """Return the texts of `PointFields`, one after the other."""
    string, leaf = encoders
    return (
        string(point.terms.group),
        string(point.code) if point.code else "",
        "" if point.default is None else leaf(number(point.default)),
        numbers,
        *map(leaf, addresses_of(point.place.addresses, point.terms.space)),
        *map(leaf, point.place.references.values()),
        *ends,
    )


def end_texts(point: Point, leaf: Callable[[Leaf], str]) -> tuple[str, ...]:
    """Return the ends of the intervals of raw numbers, where they are fields."""
    limits = point.allowed
    if point.form == "float" or limits.moves or len(limits.intervals) * 2 > _MOST_ENDS or not is_limited(point):
        return ()
    return tuple([leaf(end) for interval in limits.fixed for end in interval])


def fields_of_texts(texts: tuple[str, ...], point: Point) -> PointFields:
    """Return the fields of a point that have these texts, or placeholders for them."""
    fields = tuple(map(Name, texts))
    addresses = _SINGLE + len(point.place.addresses)
    references = addresses + len(point.place.references)
    group, code, default, numbers = fields[:_SINGLE]
    several = fields[_SINGLE:addresses], fields[addresses:references], fields[references:]
    return PointFields(group, code or None, default or None, numbers, *several)
