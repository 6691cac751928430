"""The factory setting of a point can be written to it."""

from fieldscribe.model import Point
from fieldscribe.resolve.analysis import Analysis
from fieldscribe.resolve.points import ResolvedPoint
from fieldscribe.wording.numbers import fixed_rule, number_text

_LONGEST, _MOST_NAMES = 30, 12


def check(analysis: Analysis) -> None:
    """Report defaults that the range excludes."""
    for resolved in analysis.resolved:
        point = resolved.point
        if resolved.facts.failed & {"scale", "range", "type", "enum"}:
            continue
        fault = _fault(point)
        if fault is not None:
            _report(analysis, resolved, fault)


def _fault(point: Point) -> str | None:
    """Return why the default cannot be written; None if it can, or if that depends on other points."""
    default, raw = point.default, point.default_raw
    if raw is not None:
        return None if point.special(raw) else _forbidden(point, raw)
    if default is None:
        return None
    if point.info.floating:
        held = not point.allowed.units or any(low <= default <= high for low, high in point.allowed.units)
        return None if held else "the range does not allow it"
    rule = fixed_rule(point)
    if rule is None:
        return None
    text = number_text(rule.argument(default))
    return f"it lies between two raw numbers{f' (raw {text})' if len(text) < _LONGEST else ''}"


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


def _report(analysis: Analysis, resolved: ResolvedPoint, fault: str) -> None:
    point, facts = resolved.point, resolved.facts
    raw = facts.layer("default") is not None
    key = "default" if raw else "default_in_units"
    unit = f" {point.unit.symbol}" if point.unit.symbol and not raw else ""
    stated = facts.get(key)
    hint = "it is in the unit; correct it, the range or the scale"
    if raw:
        hint = (
            f"write `default_in_units: {point.default_raw}`"
            if _fits_in_units(point)
            else "it is a raw number; correct it, or the range"
        )
        if point.enum is not None and point.enum.closed:
            names = ", ".join(entry.name for entry in point.enum.entries[:_MOST_NAMES])
            hint = f"it is the raw number or one of the names: {names}"
    message = f"the default {stated}{unit} cannot be written: {fault}"
    analysis.report.error("default-outside-range", message, facts.span(key), hint)


def _fits_in_units(point: Point) -> bool:
    """Return True if the raw default would be allowed as a value in the unit, which was probably intended."""
    rule = fixed_rule(point)
    if rule is None or point.default_raw is None or point.default == point.default_raw:
        return False
    raw = rule.argument(point.default_raw)
    return raw.denominator == 1 and _forbidden(point, raw.numerator) is None
