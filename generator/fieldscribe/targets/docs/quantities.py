"""The numbers of a point's row: the scale as factor and offset, the limits, the factory setting, all exact."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe import wording
from fieldscribe.arithmetic.exact import SAME
from fieldscribe.targets.docs.tables import decimal
from fieldscribe.wording.exact import exact, fixed_rule, number_text

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fieldscribe.arithmetic.exact import Line
    from fieldscribe.model import Point
    from fieldscribe.targets.docs.tables import Encode


def scale_cells(point: Point, points: Mapping[str, Point], encode: Encode) -> tuple[str, str, str]:
    """Factor and offset, or the rule as text where they cannot say it."""
    line = line_of(point)
    if line is not None:
        factor, offset = exact(line.factor, line.divisor), exact(line.add, line.divisor)
        if "/" not in factor + offset:
            return factor, offset, ""
    return "", "", encode(wording.scale_text(point, points) if point.scale is not None else "")


def line_of(point: Point) -> Line | None:
    """The rule from numbers of the type to values, if they are quantities and it needs no other point."""
    if point.form not in ("scaled", "integer", "float"):
        return None
    if point.scale is not None:
        return fixed_rule(point)
    return SAME if point.generated or point.reserved else None


def ends_of(point: Point) -> tuple[str, str, str, str]:
    """The least and the greatest raw number and value."""
    if point.info.floating:
        units = point.allowed.units
        return "", "", *((decimal(number_text(units[0][0])), decimal(number_text(units[-1][1]))) if units else ("", ""))
    outer, line = _without_codes(point, wording.outer_raw(point)), line_of(point)
    if outer is None or point.text is not None:
        return "", "", "", ""
    if line is None:
        return str(outer[0]), str(outer[1]), "", ""
    low, high = (exact(raw * line.factor + line.add, line.divisor) for raw in (outer[:: -1 if line.factor < 0 else 1]))
    return str(outer[0]), str(outer[1]), decimal(low), decimal(high)


def _without_codes(point: Point, ends: tuple[int, int] | None) -> tuple[int, int] | None:
    """The ends without the special codes there; None if nothing is left."""
    if ends is None or not point.specials:
        return ends
    low, high = ends
    while low <= high and (code := point.special(low)) is not None:
        low = code.high + 1
    while low <= high and (code := point.special(high)) is not None:
        high = code.low - 1
    return (low, high) if low <= high else None


def range_of(point: Point, points: Mapping[str, Point]) -> str:
    """What least and greatest do not say: other points, gaps, and numbers that are no decimals."""
    allowed, line = point.allowed, line_of(point)
    parts = allowed.units if point.info.floating else allowed.intervals
    unsaid = line is not None and bool(parts) and "" in ends_of(point)[2:]
    if len(parts) <= 1 and not allowed.moves and not unsaid:
        return ""
    text = wording.range_text(point, points) if line is not None else ""
    raw = "" if text else wording.raw_range_text(point)
    return f"only {text}" if text else f"only raw {raw}" if raw else ""


def default_of(point: Point) -> str:
    """The factory setting as a value; a special code is none."""
    raw = point.default_raw
    if point.default is None or (raw is not None and point.special(raw) is not None):
        return ""
    return decimal(number_text(point.default))
