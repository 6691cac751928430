"""The unit of the integer path: the decimals that a count needs to lose no raw number, and whether 64 bits hold it."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from fieldscribe.model import Linear, ScaleCase
    from fieldscribe.resolve.bounds import Bounds
    from fieldscribe.resolve.drafts import Draft

MOST_DECIMALS = 12
_INT64 = 1 << 62
_EXACT = 1 << 53
_MANTISSA = 24
"""Of an f32 that is a factor the mantissa takes part; its exponent only shifts the result."""

_NARROW = "narrow the range of the point or of the points in its scale"


def decimals_of(draft: Draft, cases: tuple[ScaleCase, ...] | None, bounds: Bounds) -> int:
    """The k of the point's counts (10^-k units): the author's, or the least at which a raw step is a count at least."""
    said: int | None = draft.get("decimals")
    report = bounds.scales.scope.report
    if cases is None:
        if said and "scale" not in draft.failed and draft.get("scale") is None and not draft.floating:
            message = "`decimals` belongs to a scale, and the raw number is the value here"
            report.error("integer-path", message, draft.span("decimals"), "leave it out, or give the `scale`")
        return 0
    span = draft.span("decimals" if said is not None else "scale")
    if said is None and any(bounds.scales.floats(case.rule) for case in cases):
        message = "nothing says how fine the counts are: a floating-point factor has no finest step"
        report.error("integer-path", message, span, "add `decimals: …`, the decimals that the device resolves")
        return 0
    needed = max(_needed(case.rule, bounds) for case in cases)
    if needed > MOST_DECIMALS:
        message = f"one raw step can be finer than 10^-{MOST_DECIMALS} units"
        report.error("integer-path", message, span, "give the points in the scale a narrower `range`")
        return MOST_DECIMALS
    if said is not None and said < needed:
        message = f"with {said} decimals two raw numbers would have one count"
        report.error("integer-path", message, span, f"at least {needed} decimals are needed")
        return needed
    chosen = needed if said is None else said
    raw = max(map(abs, bounds.holds[draft]))  # every raw number survives where the type is not too wide for that
    if raw >= 1 << 33:
        raw = max(map(abs, bounds.own_hull(draft)))
    for case in cases:
        fault = _fault(case.rule, chosen, raw, bounds)
        if fault is not None:
            report.error(fault[0], fault[1], span, fault[2])
    return chosen


def _needed(rule: Linear, bounds: Bounds) -> int:
    """The decimals at which the smallest raw step is one count at least; one more than the most if there are none."""
    counts, steps = abs(rule.ratio.numerator), rule.ratio.denominator
    if any(bounds.float_range(factor) is None for factor in bounds.scales.floats(rule)):
        return 0  # the author's decimals are all that is known
    if rule.factors:
        corners = [abs(corner - rule.offset) for corner in bounds.corners(rule)]
        largest = max((corner for corner in corners if corner), default=abs(rule.ratio))
        counts, steps = largest.numerator, largest.denominator
    needed = 0
    while needed <= MOST_DECIMALS and steps * 10**needed < counts:
        needed += 1
    return needed


def _fault(rule: Linear, decimals: int, raw: int, bounds: Bounds) -> tuple[str, str, str] | None:
    """Rule, message and hint unless all intermediates of both paths are wide enough: 62 bits integer, 53 as double."""
    up, down = abs(rule.ratio.numerator), rule.ratio.denominator
    floats = bounds.scales.floats(rule)
    for factor in rule.factors:
        if factor in floats:
            up, down = (up << _MANTISSA, down) if factor.power == 1 else (up, down << _MANTISSA)
            continue
        most = max(map(abs, bounds.ends_of(factor)))
        if factor.ten_to:
            up, down = up * 10**most, down * 10**most
        elif factor.power == 1:
            up *= most
        else:
            down *= most
    part = rule.offset.denominator
    numerator = (raw * part + abs(rule.offset.numerator)) * down
    if numerator > _EXACT or up * part > _EXACT:
        return "float-path", "some values of this point cannot be exact in a double", _NARROW
    if 2 * max(numerator, up * part) * 10**decimals > _INT64:
        message = f"counts of 10^-{decimals} units do not fit into 64 bits"
        return "integer-path", message, f"{_NARROW}, or give fewer `decimals`"
    return None
