"""The unit of the integer path: the decimals that a count needs to lose no raw number, and whether 64 bits hold it."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

from fieldscribe.language.formula import Affine, cut_off, parse_scale, scale_rule
from fieldscribe.model import ScaleCase

if TYPE_CHECKING:
    from fieldscribe.model import Linear
    from fieldscribe.resolve.bounds import Bounds
    from fieldscribe.resolve.drafts import Draft

MOST_DECIMALS = 12
_INT64 = 1 << 62
_EXACT = 1 << 53
_MANTISSA = 24
"""Of an f32 that is a factor the mantissa takes part; its exponent only shifts the result."""

_WIDE = 1 << 33
"""From here on not all raw numbers of a type can have counts, but those of its range."""


def decimals_of(draft: Draft, cases: tuple[ScaleCase, ...] | None, bounds: Bounds) -> int:
    """The k of the point's counts (10^-k units): the author's, or the least at which a raw step is a count at least."""
    said: int | None = draft.get("decimals")
    report = bounds.scales.scope.report
    if cases is None:
        if said and "scale" not in draft.failed and draft.layer("scale") is None and not draft.floating:
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
        report.error("integer-path", message, draft.span("scale"), _way_out(draft, cases, needed, 0, bounds))
        return MOST_DECIMALS
    if said is not None and said < needed:
        message = f"with {said} decimals two raw numbers would have one count"
        if _faults(draft, cases, needed, bounds):
            span, said = draft.span("scale"), None  # what is needed is no way out: tell why
        else:
            report.error("integer-path", message, span, f"write `decimals: {needed}`, or leave it out")
            return needed
    chosen = needed if said is None else said
    for rule, message in _faults(draft, cases, chosen, bounds):
        report.error(rule, message, span, _way_out(draft, cases, needed, chosen, bounds))
    return chosen


def _faults(draft: Draft, cases: tuple[ScaleCase, ...], decimals: int, bounds: Bounds) -> list[tuple[str, str]]:
    """Rule and message of each case of the scale that one of the paths is too narrow for."""
    raw = max(map(abs, bounds.holds[draft]))  # every raw number survives where the type is not too wide for that
    if raw >= _WIDE:
        raw = max(map(abs, bounds.own_hull(draft)))
    found = [_fault(case.rule, decimals, raw, bounds) for case in cases]
    return [fault for fault in found if fault is not None]


def _way_out(draft: Draft, cases: tuple[ScaleCase, ...], needed: int, chosen: int, bounds: Bounds) -> str:
    """What to do about a fault: something that leads into no other one."""
    for fewer in range(chosen - 1, needed - 1, -1):
        if not _faults(draft, cases, fewer, bounds):
            return f"write `decimals: {fewer}`"
    said = draft.get("scale")
    cut = cut_off(said) if isinstance(said, str) else None
    if cut is not None and _fits(draft, cut.line, bounds):
        return f"the decimal was cut off: write `scale: {cut.line}`"
    used = {bounds.scales.index.by_item(factor.point).name for case in cases for factor in case.rule.factors}
    if used:
        return f"give {' and '.join(f'`{name}`' for name in sorted(used))} a narrower `range`"
    if needed <= MOST_DECIMALS and max(map(abs, bounds.holds[draft])) >= _WIDE:
        return "give the point a narrower `range`"
    return "write a scale of fewer digits, or `scale: ~`: the point is then documented only"


def _fits(draft: Draft, scale: str, bounds: Bounds) -> bool:
    """Whether the point would have no fault with that scale, which uses no other point."""
    parsed = parse_scale(scale)
    if parsed.uses:
        return False
    cases = (ScaleCase(None, None, scale_rule(parsed, lambda _, __: Affine("", Fraction(1), Fraction(0)))),)
    needed = _needed(cases[0].rule, bounds)
    return needed <= MOST_DECIMALS and not _faults(draft, cases, needed, bounds)


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


def _fault(rule: Linear, decimals: int, raw: int, bounds: Bounds) -> tuple[str, str] | None:
    """Rule and message unless all intermediates of both paths are wide enough: 62 bits integer, 53 as double."""
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
        return "float-path", "some values of this point cannot be exact in a double"
    if 2 * max(numerator, up * part) * 10**decimals > _INT64:
        return "integer-path", f"counts of 10^-{decimals} units do not fit into 64 bits"
    return None
