"""The factory setting of a point can be written to it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.wording.exact import number_text

if TYPE_CHECKING:
    from fractions import Fraction

    from fieldscribe.checks.subject import Subject
    from fieldscribe.model import Point
    from fieldscribe.resolve.points import Resolved

_LONGEST = 30


def check(subject: Subject) -> None:
    """Defaults that the range excludes."""
    for resolved in subject.resolved:
        point = resolved.point
        if point.default is None or resolved.draft.failed & {"scale", "range", "type", "enum"}:
            continue
        fault = _fault(point, point.default)
        if fault is not None:
            _report(subject, resolved, fault)


def _fault(point: Point, default: Fraction) -> str | None:
    if point.info.floating:
        held = not point.allowed.units or any(low <= default <= high for low, high in point.allowed.units)
        return None if held else "the range does not allow it"
    if point.scale is None:
        raw = default
    elif point.fixed_scale is None:
        return None  # only other points tell
    else:
        raw = point.fixed_scale.at(default)
    if raw.denominator != 1:
        shown = number_text(raw)
        return f"it lies between two raw numbers{f' (raw {shown})' if len(shown) < _LONGEST else ''}"
    if any(special.low <= raw <= special.high for special in point.specials):
        return None
    return _forbidden(point, raw.numerator)


def _forbidden(point: Point, raw: int) -> str | None:
    if not point.allowed.holds(raw):
        return f"the range does not allow its raw number {raw}"
    if point.digits is not None:
        names = {str(entry.raw) for entry in point.digits.enum.entries}
        wrong = next((digit for digit in str(raw).zfill(point.digits.count) if digit not in names), None)
        return None if wrong is None else f"no digit is {wrong}"
    if point.fixed is not None and point.bits is None and raw & point.fixed.mask != point.fixed.bits:
        return f"its bits {point.fixed.mask:04X}h are always written as {point.fixed.bits:04X}h"
    return None


def _report(subject: Subject, resolved: Resolved, fault: str) -> None:
    unit = f" {resolved.point.unit.symbol}" if resolved.point.unit.symbol else ""
    message = f"the default {resolved.draft.get('default')}{unit} cannot be written: {fault}"
    hint = "defaults are in the unit; correct it, the range or the scale"
    subject.report.error("default-outside-range", message, resolved.draft.span("default"), hint)
