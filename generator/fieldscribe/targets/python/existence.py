"""For which variants a point can exist, and whether that depends on anything else."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.conditions import absent

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fieldscribe.model import Point


def only_for(point: Point, variants: Mapping[str, tuple[str, ...]]) -> tuple[str, tuple[str, ...]] | None:
    """The first axis on which the point's condition depends, and the values for which the point can exist."""
    for axis in () if point.when is None else point.when.names:
        values = variants.get(axis, ())
        left = tuple([value for value in values if not absent(point.when, {**variants, axis: (value,)})])
        if left != values:
            return axis, left
    return None


def uncertain(point: Point, variants: Mapping[str, tuple[str, ...]]) -> bool:
    """Whether the existence of the point depends on more than one axis: on others, on points or on the firmware."""
    narrowed = only_for(point, variants)
    others = set() if point.when is None else {*point.when.names} - ({narrowed[0]} if narrowed else set())
    return bool(others) or point.since is not None or point.until is not None
