"""Vectors of facts beside the conversions: the places of a point, its constants and its words."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.model import item_of
from fieldscribe.targets.vectors.numbers import as_raw
from fieldscribe.targets.vectors.oracle import outer_bounds
from fieldscribe.text import line

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fieldscribe.existence import Condition
    from fieldscribe.model import Point
    from fieldscribe.targets.vectors.lines import Lines


def address(lines: Lines, point: Point) -> None:
    """Add vectors of addresses on the wire and in the manual, of the outer raw limits and the unit of counts."""
    if point.address is None:
        return
    low, high = outer_bounds(point) if point.form not in ("float", "text", "digits") else (None, None)
    lines.add(
        "address",
        point.space,
        point.address,
        point.words,
        None if point.code is None else line(point.code),
        low,
        high,
        point.decimals if point.form == "scaled" else None,
        {key: line(str(number)) for key, number in point.references.items()},
    )
    if point.write_place is not None:
        lines.add("write_address", min(point.write_place.addresses))
    if point.index is not None or point.telegram is not None or point.text is not None:
        lines.add("place", point.addresses, point.index, point.telegram)
    if point.unit.symbol:
        lines.add("symbol", point.unit.symbol)
    if point.display is not None:
        lines.add("display", point.display)


def facts(lines: Lines, point: Point, variants: Mapping[str, tuple[str, ...]]) -> None:
    """Add the vector of what a point is beside its numbers: group, type, unit, default, variant, place for writing."""
    apart = point.write_place
    lines.add(
        "facts",
        point.group,
        point.name,
        point.type,
        point.unit.symbol or None,
        None if point.default is None else float(point.default),
        None if point.changes == "always" else point.changes,
        point.changes_with,
        None if point.variant is None else str(point.variant),
        _only_for(point, variants),
        None if apart is None else point.space,
        None if apart is None else apart.addresses,
    )


def aliases(lines: Lines, point: Point) -> None:
    """Add vectors of old names; variants keep their suffix."""
    for old in point.was:
        lines.add("alias", item_of(old, point.variant), point.item)


def _only_for(point: Point, variants: Mapping[str, tuple[str, ...]]) -> tuple[str, ...] | None:
    """The axis that decides whether the point exists, followed by the values for which it can."""
    if point.when is None:
        return None
    for axis in point.when.names:
        left = [value for value in variants.get(axis, ()) if _possible_for(point.when, axis, value)]
        if len(left) < len(variants.get(axis, ())):
            return (axis, *left)
    return None


def _possible_for(condition: Condition, axis: str, value: str) -> bool:
    """Whether some clause of the condition can hold for this value of the axis."""
    return any(
        all(comparison.of != axis or comparison.holds(value) for comparison in clause) for clause in condition.clauses
    )


def words(lines: Lines, point: Point) -> None:
    """Add vectors of the words of a point, in ascending order of the addresses."""
    if (
        not point.addresses
        or point.bits is not None
        or point.text is not None
        or (point.words < 2 and not point.info.signed)
    ):
        return
    count = point.words
    addresses = point.addresses
    # words that share one address (a USS parameter) travel with the high word first
    order = sorted(range(count), key=addresses.__getitem__) if len(addresses) == count else list(range(count))
    for pattern in _wide_patterns(count) if count > 1 else _NARROW:
        raw = as_raw(point, pattern)
        whole = raw & (1 << 16 * count) - 1  # a signed byte is extended to its whole word
        parts = [whole >> 16 * (count - 1 - place) & 0xFFFF for place in order]
        lines.add("words", raw, parts)


_NARROW = (0x8000, 0x8001, 0xFFFD, 0x7FFE)
"""Samples of a signed word: the least number, negative odd numbers, a positive number."""


def _wide_patterns(count: int) -> tuple[int, ...]:
    top = 1 << 16 * count - 1
    ascending = sum(0x0001_0203_0405_0607 >> 64 - 16 * count & 0xFFFF << 16 * place for place in range(count))
    mixed = sum((0x8000 if place % 2 else 0x8001) << 16 * place for place in range(count))
    return (0, 1, ascending, top, top + 1, top - 1, mixed, (1 << 16 * count) - 1, 0xFFFF)
