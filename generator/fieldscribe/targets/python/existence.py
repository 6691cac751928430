"""For which variants a point exists, where its condition is about one variant axis."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fieldscribe.model import Point


def only_for(point: Point, variants: Mapping[str, tuple[str, ...]]) -> tuple[str, tuple[str, ...]] | None:
    """The axis and those of its values for which the point exists.

    None where the condition asks for something else too: that is for the reader of the documentation.
    """
    condition = point.when
    if condition is None or len(condition.names) != 1 or condition.names[0] not in variants:
        return None
    axis = condition.names[0]
    return axis, tuple([value for value in variants[axis] if condition.holds({axis: value})])
