"""Which raw numbers a point allows: from ranges, enums and types, with limits that other points set."""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from itertools import product
from typing import Any

from fieldscribe.diagnostics import Span
from fieldscribe.language.formula import Affine, Expression, FormulaError, limit_rule, parse_range
from fieldscribe.language.nodes import Seq
from fieldscribe.model import Allowed, Bound, Enum, Interval, Limit, Linear, Special
from fieldscribe.resolve.drafts import Draft
from fieldscribe.resolve.rules import Scales, Unknown
from fieldscribe.resolve.values import formula_finding

_MOST_LISTED = 4096


def round_half_away(number: Fraction) -> int:
    """The nearest whole number, halves away from zero."""
    doubled = 2 * abs(number.numerator) + number.denominator
    magnitude = doubled // (2 * number.denominator)
    return magnitude if number.numerator >= 0 else -magnitude


def as_text(raw: Any) -> str:
    """A range in the one notation that the parser reads: a YAML list is its items with commas."""
    return ", ".join(str(one) for one in raw) if isinstance(raw, Seq) else str(raw)


class Ranges:
    """The allowed numbers of every point, and the bounds that they can never leave."""

    def __init__(
        self, scales: Scales, widths: dict[int, tuple[int, int]], specials: dict[int, tuple[Special, ...]]
    ) -> None:
        self.scales = scales
        self.report = scales.scope.report
        self.widths = widths
        self.specials = specials
        self._hulls: dict[tuple[int, int], int] = {}

    def allowed(self, draft: Draft, enum: Enum | None, floating: bool) -> Allowed:
        """What may be written to the point: its range, else its enum's numbers, else all that the type holds."""
        least, greatest = self.widths[id(draft)]
        if floating:
            return Allowed((), False, self._units(draft))
        for key in ("range", "range_in_units"):
            if draft.layer(key) is not None:
                found = self.intervals(draft, draft.get(key), draft.span(key), key == "range_in_units")
                return found if found is not None else Allowed((Interval(least, greatest),), False, ())
        if enum is not None and not draft.get("open", False):
            numbers = [entry.raw for entry in enum.entries if least <= entry.raw <= greatest]
            return Allowed(_merged([(one, one) for one in numbers]), True, ())
        return Allowed((Interval(least, greatest),), False, ())

    def _units(self, draft: Draft) -> tuple[tuple[Fraction, Fraction], ...]:
        key = "range_in_units" if draft.layer("range_in_units") is not None else "range"
        result = []
        for low, high in self._alternatives(draft, key):
            ends = [limit_rule(end, self._refuse_names) for end in (low, high)]
            result.append((ends[0].ratio + ends[0].offset, ends[1].ratio + ends[1].offset))
        return tuple(sorted(result))

    def _refuse_names(self, name: str, part: str) -> Affine:
        raise FormulaError(
            f"`{name}`: a range of floating-point numbers takes constants only", 0, "write the widest range"
        )

    def _alternatives(self, draft: Draft, key: str) -> tuple[tuple[Expression, Expression], ...]:
        raw = draft.get(key)
        if raw is None:
            return ()
        try:
            return parse_range(as_text(raw)).alternatives
        except FormulaError as error:
            formula_finding(error, draft.span(key), self.report)
            return ()

    def intervals(self, draft: Draft, raw: Any, span: Span, in_units: bool) -> Allowed | None:
        """The raw numbers that a range (its YAML value, in raw numbers or in units) allows; None after a finding."""
        text = as_text(raw)
        try:
            parsed = parse_range(text)
            found = [
                tuple(self._bound(draft, end, text, span, in_units) for end in ends) for ends in parsed.alternatives
            ]
        except FormulaError as error:
            formula_finding(error, span, self.report)
            return None
        except Unknown:
            return None
        pairs = [(high, low) if in_units and self._falls(draft) else (low, high) for low, high in found]
        if not all([self._checked(draft, low, high, span) for low, high in pairs]):
            return None
        fixed = [(low, high) for low, high in pairs if isinstance(low, int) and isinstance(high, int)]
        moving = [Interval(low, high) for low, high in pairs if not (isinstance(low, int) and isinstance(high, int))]
        return Allowed((*_merged(fixed), *moving), parsed.listed, ())

    def _falls(self, draft: Draft) -> bool:
        cases = self.scales.cases(draft)
        return bool(cases) and cases is not None and cases[0].rule.ratio < 0

    def _checked(self, draft: Draft, low: Bound, high: Bound, span: Span) -> bool:
        if isinstance(low, int) and isinstance(high, int) and low > high:
            self.report.error(
                "range-reversed",
                f"the range {low}..{high} runs downwards",
                span,
                f"write {high}..{low} if that is meant",
            )
            return False
        least, greatest = self.widths[id(draft)]
        for end in (low, high):
            if isinstance(end, int) and not least <= end <= greatest:
                message = f"{end} lies outside the type, which holds {least}..{greatest}"
                self.report.error("range-outside-type", message, span, "correct the range, or give the right `type`")
                return False
        return True

    def _bound(self, draft: Draft, end: Expression, text: str, span: Span, in_units: bool) -> Bound:
        rule = limit_rule(end, lambda name, part: self.scales.affine(name, part, text, span))
        if in_units:
            rule = self._encoded(draft, rule, span)
        if rule.factors:
            return self._limit(draft, rule, span)
        exact = rule.ratio + rule.offset
        if not in_units and exact.denominator != 1:
            hint = "a range is in raw numbers; limits in the unit go under `range_in_units`"
            self.report.error("bad-number", f"the limit {exact} is not a whole raw number", span, hint)
            raise Unknown
        return round_half_away(exact)

    def _encoded(self, draft: Draft, limit: Linear, span: Span) -> Linear:
        cases = self.scales.cases(draft)
        if cases is None:
            return limit
        scale = cases[0].rule
        if len(cases) > 1 or (limit.factors and limit.offset):
            self.report.error(
                "bad-formula",
                "limits in units need one rule and no sum here",
                span,
                "give the limits as raw numbers under `range`",
            )
            raise Unknown
        if not limit.factors:
            return Linear((limit.ratio + limit.offset) * scale.ratio, scale.offset, scale.factors)
        return Linear(limit.ratio * scale.ratio, scale.offset, (*limit.factors, *scale.factors))

    def _limit(self, draft: Draft, rule: Linear, span: Span) -> Limit:
        own_least, own_greatest = self.widths[id(draft)]
        corners = [round_half_away(one) for one in self.corners(rule)]
        unless = []
        for factor in rule.factors:
            used = self.scales.index.by_item(factor.point)
            codes = [
                code
                for special in self.specials[id(used)]
                for code in range(special.low, min(special.high, special.low + _MOST_LISTED) + 1)
            ]
            if codes:
                unless.append((factor.point, tuple(codes)))
        least = max(own_least, min(corners, default=own_least))
        greatest = min(own_greatest, max(corners, default=own_greatest))
        if least > greatest:
            message = f"the limit can only be {min(corners)}..{max(corners)}, outside the type"
            self.report.error("range-outside-type", message, span, "check the factor in the formula")
            raise Unknown
        return Limit(rule, tuple(unless), least, greatest)

    def corners(self, rule: Linear) -> list[Fraction]:
        """The rule's results (applied to 1) at the ends of what its factors can hold; empty if one can be zero below the line."""
        ends: list[tuple[Fraction, ...]] = []
        for factor in rule.factors:
            used = self.scales.index.by_item(factor.point)
            low, high = (factor.slope * self.hull(used, end) + factor.intercept for end in (0, 1))
            if factor.ten_to:
                ends.append(tuple(Fraction(10) ** (factor.power * exponent) for exponent in (low, high)))
            elif factor.power == 1:
                ends.append((Fraction(low), Fraction(high)))
            elif min(low, high) <= 0 <= max(low, high):
                nonzero = [Fraction(1, one) for one in (low, high, 1) if one]
                ends.append(tuple(nonzero))
            else:
                ends.append((Fraction(1, low), Fraction(1, high)))
        result = []
        for combination in product(*ends):
            number = rule.ratio
            for part in combination:
                number *= part
            result.append(number + rule.offset)
        return result

    def hull(self, draft: Draft, end: int) -> int:
        """The least (0) or greatest (1) raw number that the point can hold, whatever its dependent limits say."""
        key = (id(draft), end)
        if key not in self._hulls:
            self._hulls[key] = self.widths[id(draft)][end]
            self._hulls[key] = self._hull(draft, end)
        return self._hulls[key]

    def _hull(self, draft: Draft, end: int) -> int:
        bound = self.widths[id(draft)]
        key = "range" if draft.layer("range") is not None else "range_in_units"
        if draft.layer(key) is None:
            return bound[end]
        found: list[int] = []
        span, text = draft.span(key), as_text(draft.get(key))
        for alternative in self._alternatives(draft, key):
            try:
                rule = limit_rule(alternative[end], lambda name, part: self.scales.affine(name, part, text, span))
                rule = self._encoded(draft, rule, span) if key == "range_in_units" else rule
            except (FormulaError, Unknown):
                return bound[end]
            found.extend(round_half_away(one) for one in self.corners(rule))
        pick = max if end else min
        inside = pick(found, default=bound[end])
        return max(bound[0], min(bound[1], inside))


def _merged(pairs: Iterable[tuple[int, int]]) -> tuple[Interval, ...]:
    """Intervals in ascending order, neighbours and overlaps joined."""
    joined: list[tuple[int, int]] = []
    for low, high in sorted(pairs):
        if joined and low <= joined[-1][1] + 1:
            joined[-1] = (joined[-1][0], max(joined[-1][1], high))
        else:
            joined.append((low, high))
    return tuple(Interval(low, high) for low, high in joined)
