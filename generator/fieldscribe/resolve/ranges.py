"""Resolves which raw numbers a point allows, from range, enum and type, with limits that other points set."""

import re
from collections.abc import Iterable
from decimal import Decimal
from fractions import Fraction
from typing import Any

from fieldscribe.arithmetic.exact import half_away
from fieldscribe.diagnostics import Span
from fieldscribe.language.formula.parser import parse_range
from fieldscribe.language.formula.syntax import Expression, FormulaError
from fieldscribe.language.nodes import Seq
from fieldscribe.language.suggestions import suggest_interval
from fieldscribe.model import Allowed, Bound, Enum, Interval, Limit, Linear
from fieldscribe.resolve.bounds import Bounds, as_text, constant_range
from fieldscribe.resolve.point_facts import PointFacts
from fieldscribe.resolve.values import FactError, formula_finding
from fieldscribe.wording.numbers import number_text

_ONE_SIDED = tuple("<>\u2264\u2265")
_DECIMAL_END = re.compile(r"(?:^|\.\.|[|,])\s*([-+]?[0-9]+\.[0-9]+)\s*(?=$|\.\.|[|,])")


class Ranges:
    """Resolves which raw numbers may be written to each point."""

    def __init__(self, bounds: Bounds) -> None:
        self.bounds = bounds
        self.report = bounds.scales.scope.report

    def allowed(self, facts: PointFacts, enum: Enum | None) -> Allowed:
        """Return what may be written: the point's range, else the numbers of its enum, else all of the type."""
        if facts.floating:
            return Allowed((), False, self._float_range(facts))
        if facts.text:
            return Allowed((), False, ())
        least, greatest = self.bounds.encodings[facts].holds
        type_range = Allowed((Interval(least, greatest),), False, ())
        for key in ("range", "range_in_units"):
            if facts.layer(key) is not None:
                if key == "range_in_units" and (values := self._values_alone(facts)):
                    return Allowed(type_range.intervals, False, values)
                ranged = self.intervals(facts, facts.get(key), facts.span(key), key == "range_in_units")
                if ranged is None:
                    facts.failed.add("range")
                return ranged or type_range
        if enum is not None and not facts.get("open", False):
            numbers = [entry.raw for entry in enum.entries if least <= entry.raw <= greatest]
            return Allowed(_merged([(number, number) for number in numbers]), True, ()) if numbers else type_range
        return type_range

    def _values_alone(self, facts: PointFacts) -> tuple[tuple[Fraction, Fraction], ...] | None:
        """Return constant limits in the unit whose raw numbers are unknown, as the scale is; None for others."""
        if facts.layer("scale") is None or facts.get("scale") is not None:
            return None
        try:
            values = constant_range(as_text(facts.get("range_in_units")))
        except FormulaError:
            return None  # `intervals` reports it
        return None if values is None or any(low > high for low, high in values) else tuple(sorted(values))

    def intervals(
        self, facts: PointFacts, raw: Any, span: Span, in_units: bool, *, printed: bool = False
    ) -> Allowed | None:
        """Return the raw numbers that a range allows, from its YAML value; None after a finding.

        A range that is only `printed` in the manual may lie outside the type or run downwards, as misprints do.
        """
        text = as_text(raw)
        decimal = _DECIMAL_END.search(text) if not in_units and not printed else None
        if decimal is not None:
            message = f"`{decimal[1]}` has a decimal point, and `range` is in raw numbers"
            hint = f"write `range_in_units: {text}`, or the raw numbers without a decimal point"
            self.report.error("bad-number", message, span, hint)
            return None
        if isinstance(raw, Seq) and not printed and self._two_meanings(raw, span):
            return None
        try:
            parsed = parse_range(text)
            pairs = [
                (self._bound(facts, low, text, span, in_units), self._bound(facts, high, text, span, in_units))
                for low, high in parsed.alternatives
            ]
        except FormulaError as error:
            suggestion = suggest_interval(text)
            if text.lstrip()[:1] in _ONE_SIDED:
                error.hint = "an interval has both ends, low..high; those of the type where nothing else limits it"
            elif suggestion is not None:
                error.hint = (
                    f"write `{suggestion}`"
                    if printed
                    else f"write `{'range_in_units' if in_units else 'range'}: {suggestion}`"
                )
            formula_finding(error, span, self.report)
            return None
        except FactError as error:
            error.report(self.report)
            return None
        if in_units and self.bounds.falls(facts):
            pairs = [(high, low) for low, high in pairs]
        checked = [printed or self._checked(facts, low, high, span) for low, high in pairs]
        if not all(checked):
            return None
        intervals = [Interval(low, high) for low, high in pairs]
        fixed = [interval.fixed for interval in intervals if interval.fixed is not None]
        moving = [interval for interval in intervals if interval.fixed is None]
        return Allowed((*_merged(fixed), *moving), parsed.listed, ())

    def _two_meanings(self, raw: Seq, span: Span) -> bool:
        """Report `[0, 100]`: it is a list of two numbers here, and the ends of an interval in other tools."""
        first, last = (raw[0], raw[1]) if len(raw) == 2 else (0, 0)
        if not all(isinstance(end, int | Decimal) for end in (first, last)) or last - first <= 1:
            return False
        message = f"[{first}, {last}] could be an interval or two single numbers"
        hint = f"write `{first}..{last}` for all between them, `{first} | {last}` for only these two"
        self.report.error("two-meanings", message, span, hint)
        return True

    def _bound(self, facts: PointFacts, end: Expression, text: str, span: Span, in_units: bool) -> Bound:
        """Return one end: a raw number, or a limit that other points set. Raises FormulaError or FactError."""
        rule = self.bounds.limit(facts, end, text, span, in_units)
        if rule.factors:
            return self._limit(facts, rule, span)
        exact = rule.ratio + rule.offset
        if in_units or exact.denominator == 1:
            return half_away(exact)
        hint = "a range is in raw numbers; limits in the unit go under `range_in_units`"
        message = f"the limit {number_text(exact)} is not a whole raw number"
        raise FactError("bad-number", message, span, hint)

    def _checked(self, facts: PointFacts, low: Bound, high: Bound, span: Span) -> bool:
        """Return True if the type holds both ends and the interval is not empty; report it otherwise."""
        least, greatest = self.bounds.encodings[facts].holds
        for end in (low, high):
            if isinstance(end, int) and not least <= end <= greatest:
                if "type" not in facts.failed:
                    message = f"{end} lies outside the type, which holds {least}..{greatest}"
                    hint = "correct the range, or give the right `type`"
                    self.report.error("range-outside-type", message, span, hint)
                return False
        interval = Interval(low, high)
        lowest, highest = interval.outer
        if lowest > highest:
            fixed = interval.fixed is not None
            message = f"the range {lowest}..{highest} {'runs downwards' if fixed else 'can never hold a number'}"
            hint = f"write {highest}..{lowest} if that is meant" if fixed else "check the points that limit it"
            self.report.error("range-reversed", message, span, hint)
            return False
        return True

    def _limit(self, facts: PointFacts, rule: Linear, span: Span) -> Limit:
        """Return a limit that other points set, with its least and greatest possible number."""
        rule = self.bounds.with_exponents(rule, span)
        own_least, own_greatest = self.bounds.encodings[facts].holds
        corners = [half_away(corner) for corner in self.bounds.corners(rule)]
        least, greatest = max(own_least, min(corners)), min(own_greatest, max(corners))
        if least > greatest:
            message = f"the limit can only be {min(corners)}..{max(corners)}, outside the type"
            raise FactError("range-outside-type", message, span, "check the factor in the formula")
        names = dict.fromkeys(factor.point for factor in rule.factors)
        unless = ((name, self._codes(name)) for name in names)
        return Limit(rule, tuple((name, codes) for name, codes in unless if codes), least, greatest)

    def _codes(self, name: str) -> tuple[tuple[int, int], ...]:
        """Return the special codes of a point: while it holds one of them, a limit that it sets does not apply."""
        specials = self.bounds.encodings[self.bounds.scales.symbols.by_item(name)].specials
        return tuple(sorted((special.low, special.high) for special in specials))

    def _float_range(self, facts: PointFacts) -> tuple[tuple[Fraction, Fraction], ...]:
        """Return the range of a floating-point point in its unit."""
        if facts.layer("range") is not None:
            message = "`range` is in raw numbers, which are bit patterns here"
            self.report.error("float-fact", message, facts.span("range"), "write `range_in_units`")
        if facts.layer("range_in_units") is None:
            return ()
        span = facts.span("range_in_units")
        try:
            intervals = constant_range(as_text(facts.get("range_in_units")))
        except FormulaError as error:
            formula_finding(error, span, self.report)
            return ()
        if intervals is None:
            message = "a range of floating-point numbers takes constants only"
            self.report.error("float-fact", message, span, "write the widest range")
            return ()
        for low, high in intervals:
            if low > high:
                low_text, high_text = number_text(low), number_text(high)
                hint = f"write {high_text}..{low_text} if that is meant"
                self.report.error("range-reversed", f"the range {low_text}..{high_text} runs downwards", span, hint)
                return ()
        return tuple(sorted(intervals))


def _merged(pairs: Iterable[tuple[int, int]]) -> tuple[Interval, ...]:
    """Return intervals in ascending order, with neighbours and overlaps joined."""
    joined: list[tuple[int, int]] = []
    for low, high in sorted(pairs):
        if joined and low <= joined[-1][1] + 1:
            joined[-1] = (joined[-1][0], max(joined[-1][1], high))
        else:
            joined.append((low, high))
    return tuple(Interval(low, high) for low, high in joined)
