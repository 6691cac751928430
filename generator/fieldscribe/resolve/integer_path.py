"""The unit of the integer path: how many decimals a count needs so that no raw number is lost, and whether 64 bits hold it."""

from __future__ import annotations

from fractions import Fraction

from fieldscribe.diagnostics import Span
from fieldscribe.model import ScaleCase
from fieldscribe.resolve.allowed import Ranges
from fieldscribe.resolve.drafts import Draft

MOST_DECIMALS = 12
_INT64 = 1 << 62
_EXACT = 1 << 53


def decimals_of(draft: Draft, cases: tuple[ScaleCase, ...] | None, ranges: Ranges) -> int:
    """The k of the point's counts (10^-k units): the author's, or the smallest at which one raw step is at least one count."""
    if cases is None:
        return int(draft.get("decimals", 0))
    smallest = min((_least_step(case, ranges) for case in cases), default=Fraction(1))
    needed = 0
    while needed < MOST_DECIMALS and smallest * 10**needed < 1:
        needed += 1
    said = draft.get("decimals")
    span = draft.span("decimals" if said is not None else "scale")
    report = ranges.report
    if smallest * 10**needed < 1:
        hint = "give the points in the scale a narrower `range`"
        report.error(
            "integer-path",
            f"one raw step is {float(smallest):.3g} units, too fine for {MOST_DECIMALS} decimals",
            span,
            hint,
        )
    elif said is not None and said < needed:
        report.error(
            "integer-path",
            f"with {said} decimals two raw numbers would have one count",
            span,
            f"at least {needed} decimals are needed",
        )
    chosen = needed if said is None else int(said)
    for case in cases:
        _fits(draft, case, chosen, ranges, span)
    return chosen


def _least_step(case: ScaleCase, ranges: Ranges) -> Fraction:
    steps = [abs(corner - case.rule.offset) for corner in ranges.corners(case.rule)]
    largest = max((step for step in steps if step), default=abs(case.rule.ratio) or Fraction(1))
    return 1 / largest


def _fits(draft: Draft, case: ScaleCase, decimals: int, ranges: Ranges, span: Span) -> None:
    """A finding unless every intermediate of both paths is wide enough: 62 bits for integers, 53 for doubles."""
    rule = case.rule
    up, down = rule.ratio.numerator, rule.ratio.denominator
    for factor in rule.factors:
        used = ranges.scales.index.by_item(factor.point)
        ends = [factor.slope * ranges.hull(used, end) + factor.intercept for end in (0, 1)]
        above = factor.power == 1
        if factor.ten_to:
            most = 10 ** max(abs(end) for end in ends)
            up, down = up * most, down * most
        else:
            up, down = (up * max(map(abs, ends)), down) if above else (up, down * max(map(abs, ends)))
    least, greatest = ranges.widths[id(draft)]
    raw = max(abs(least), abs(greatest), abs(ranges.hull(draft, 0)), abs(ranges.hull(draft, 1)))
    wide = raw if raw < 1 << 33 else max(abs(ranges.hull(draft, 0)), abs(ranges.hull(draft, 1)))
    numerator = (wide * rule.offset.denominator + abs(rule.offset.numerator)) * abs(down)
    hint = "narrow the range of the point or of the points in its scale"
    if numerator > _EXACT or abs(up) * rule.offset.denominator > _EXACT:
        ranges.report.error("float-path", "some values of this point cannot be exact in a double", span, hint)
    elif 2 * numerator * 10**decimals > _INT64 or 2 * abs(up) * rule.offset.denominator * 10**decimals > _INT64:
        ranges.report.error(
            "integer-path",
            f"counts of 10^-{decimals} units do not fit into 64 bits",
            span,
            f"{hint}, or give fewer `decimals`",
        )
