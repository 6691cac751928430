"""Vectors of what tells a point from others: its places, references, old names, type and limits, read from the point."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.targets.vectors.oracle import outer_bounds
from fieldscribe.text import line

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fieldscribe.existence import Condition
    from fieldscribe.model import Point
    from fieldscribe.targets.vectors.lines import Lines


def identity(lines: Lines, point: Point, variants: Mapping[str, tuple[str, ...]]) -> None:
    """Name the point, and add what is its own. Nothing here is shared, so that whoever shares too much is caught."""
    lines.set("point", point.item)
    _address(lines, point)
    _facts(lines, point, variants)
    _aliases(lines, point)


def _address(lines: Lines, point: Point) -> None:
    """Add vectors of addresses on the wire and in the manual, of the outer raw limits and the unit of counts."""
    if point.address is None:
        return
    low, high = outer_bounds(point.shape, point.allowed) if point.form not in ("float", "text", "digits") else (None, None)
    lines.add(
        "address",
        point.places[0].space,
        point.address,
        point.words,
        None if point.code is None else line(point.code),
        low,
        high,
        point.decimals if point.form == "scaled" else None,
        {key: line(str(number)) for key, number in point.references.items()},
    )
    if point.index is not None or point.telegram is not None or point.text is not None:
        lines.add("place", point.addresses, point.index, point.telegram)
    if point.unit.symbol:
        lines.add("symbol", point.unit.symbol)
    if point.display is not None:
        lines.add("display", point.display)


def _facts(lines: Lines, point: Point, variants: Mapping[str, tuple[str, ...]]) -> None:
    """Add the vector of what a point is beside its numbers: group, type, unit, default, variant, place for writing."""
    other = next((place for place in point.places if place.purpose == "write"), None)
    apart = other is not None and other is not point.places[0]
    lines.add(
        "facts",
        point.group,
        point.name,
        point.type,
        point.unit.symbol or None,
        None if point.default is None else float(point.default),
        None if point.changes == "always" else point.changes,
        point.changes_with,
        point.variant,
        _only_for(point, variants),
        other.space if other is not None and apart else None,
        other.addresses if other is not None and apart else None,
    )


def _aliases(lines: Lines, point: Point) -> None:
    """Add vectors of old names; variants keep their suffix."""
    for old in point.was:
        lines.add("alias", old + point.item.removeprefix(point.name), point.item)


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
