"""For which variants a point exists, where its condition is about one variant axis."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.language.formula.conditions import (
    AllOf,
    AnyOf,
    Comparison,
    Condition,
    Not,
    condition_names,
    parse_condition,
)

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fieldscribe.model import Point


def only_for(point: Point, variants: Mapping[str, tuple[str, ...]]) -> tuple[str, tuple[str, ...]] | None:
    """The axis and those of its values for which the point exists.

    None where the condition asks for something else too: that is for the reader of the documentation.
    """
    if point.when is None:
        return None
    condition = parse_condition(point.when)
    axes = {name.name for name in condition_names(condition)}
    if len(axes) != 1 or not axes <= variants.keys():
        return None
    axis = axes.pop()
    return axis, tuple([value for value in variants[axis] if _holds(condition, value)])


def _holds(condition: Condition, value: str) -> bool:
    match condition:
        case Not(operand):
            return not _holds(operand, value)
        case AllOf(parts):
            return all(_holds(part, value) for part in parts)
        case AnyOf(parts):
            return any(_holds(part, value) for part in parts)
        case Comparison():
            named = any(str(constant.value) == value for constant in condition.constants)
            return named != (condition.op == "!=")
