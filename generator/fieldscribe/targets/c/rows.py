"""The facts of a point as a row of a table of the user's: how its number follows from the raw one, and its limits."""

from __future__ import annotations

from fieldscribe.arithmetic.exact import Line
from fieldscribe.arithmetic.words import INT32
from fieldscribe.lowered import plan_of
from fieldscribe.targets.c.conversions import is_rechecked
from fieldscribe.targets.c.views import PointView
from fieldscribe.text import c_string

_ITSELF = Line(1, 0, 1)
"""The line from a raw number to itself."""


def has_row(view: PointView) -> bool:
    """Return True if 32 bits hold the raw number, as it is."""
    return view.point.text is None and view.point.info.bits <= 32 and not view.point.coding


def is_written_by_row(view: PointView) -> bool:
    """Return True if two fixed limits say what may be written."""
    return view.shape != "digits" and not is_rechecked(view.point)


def facts_of(view: PointView, raw_decimals: str) -> list[str]:
    """Return the limits, the factor, addend and divisor to raw, the decimals, the name and the unit as literals.

    `raw_decimals` says that the number is the raw one, because its meaning takes more.
    """
    point, fields = view.point, view.fields
    low, high, line, decimals = fields.low, fields.high, _ITSELF, raw_decimals
    if view.special is None and view.shape == "plain":
        decimals = "0"
    elif view.special is None and view.shape == "scaled" and point.has_counts:
        plan = plan_of(point.shape)
        if plan.beyond is None and plan.to_raw.factor > 0 and max(map(abs, plan.to_raw)) <= INT32[1]:
            low, high, line, decimals = fields.first, fields.last, plan.to_raw, f"{point.decimals}"
    ends = (low, high) if point.writable and is_written_by_row(view) else ("0", "0")
    return [*ends, *map(str, line), decimals, f'"{fields.item}"', c_string(point.unit.symbol)]
