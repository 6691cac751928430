"""The least and the greatest number that a point, or a formula of points, can hold."""

from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from functools import lru_cache
from typing import Any

from fieldscribe.arithmetic.codec import MOST_EXPONENT
from fieldscribe.arithmetic.exact import half_away
from fieldscribe.arithmetic.words import ends_without
from fieldscribe.diagnostics import Span
from fieldscribe.language.formula.normal import Affine, evaluate, limit_rule
from fieldscribe.language.formula.parser import parse_range
from fieldscribe.language.formula.syntax import Expression, FormulaError, Part, names
from fieldscribe.language.nodes import Seq
from fieldscribe.model import Factor, Linear
from fieldscribe.resolve.encodings import Encoding
from fieldscribe.resolve.point_facts import PointFacts
from fieldscribe.resolve.scales import Scales
from fieldscribe.resolve.values import FactError, Written

_DEEPEST = 30


def as_text(raw: Any) -> str:
    """Return a range as the text that the parser reads: the items of a YAML list with commas between."""
    return ", ".join(str(item) for item in raw) if isinstance(raw, Seq) else str(raw)


@lru_cache(maxsize=16384)
def constant_range(text: str) -> tuple[tuple[Fraction, Fraction], ...] | None:
    """Return the intervals of a range of constants; None if it names a point. Raises FormulaError."""
    alternatives = parse_range(text).alternatives
    if any(names(end) for ends in alternatives for end in ends):
        return None
    return tuple((evaluate(low, {}), evaluate(high, {})) for low, high in alternatives)


class Bounds:
    """Computes bounds of raw numbers. A type holds an interval; a point's hull is the part that its range allows."""

    def __init__(self, scales: Scales, encodings: Mapping[PointFacts, Encoding]) -> None:
        self.scales = scales
        self.encodings = encodings
        self._ends: dict[tuple[PointFacts, int], int] = {}
        self._depth = 0

    def hull(self, item: str) -> tuple[int, int]:
        """Return the least and greatest raw number of a point, over its variants and moving limits at their widest."""
        symbols = self.scales.symbols
        ends = [self.own_hull(sibling) for sibling in symbols.siblings(symbols.by_item(item))]
        return min(low for low, _ in ends), max(high for _, high in ends)

    def own_hull(self, facts: PointFacts) -> tuple[int, int]:
        """Return the least and greatest raw number of one variant of a point."""
        return self._end(facts, 0), self._end(facts, 1)

    def _end(self, facts: PointFacts, end: int) -> int:
        """Return the least (`end` 0) or the greatest (1) number of the hull.

        Each end is computed separately, because a fixed end often breaks a circle of points that limit each other.
        """
        key = (facts, end)
        bound = self._ends.get(key)
        if bound is None:
            held: int = self.encodings[facts].holds[end]
            bound = self._ends[key] = held  # for points in a circle, which ask again
            self._depth += 1
            if self._depth <= _DEEPEST:
                bound = self._ends[key] = self._computed_end(facts, end)
            self._depth -= 1
        return bound

    def ends_of(self, factor: Factor, *, held: bool = False) -> tuple[int, int]:
        """Return raw * slope + intercept at both ends of the range of the factor's point, or of its type."""
        facts = self.scales.symbols.by_item(factor.point)
        low, high = self.encodings[facts].holds if held else self.hull(factor.point)
        return factor.slope * low + factor.intercept, factor.slope * high + factor.intercept

    def corners(self, rule: Linear) -> list[Fraction]:
        """Return the extreme results of a rule for the value 1, over all that its factors can hold."""
        if not rule.factors:
            return [rule.ratio + rule.offset]
        results = {rule.ratio}
        for factor in rule.factors:
            products = {result * end for result in results for end in self._factor_ends(factor)}
            results = {min(products), max(products)}
        return sorted(result + rule.offset for result in results)

    def float_range(self, factor: Factor) -> tuple[Fraction, Fraction] | None:
        """Return the limits of a floating-point factor; None if its point has none."""
        facts = self.scales.symbols.by_item(factor.point)
        if facts.layer("range_in_units") is None:
            return None
        try:
            intervals = constant_range(as_text(facts.get("range_in_units")))
        except FormulaError:
            return None
        return (min(low for low, _ in intervals), max(high for _, high in intervals)) if intervals else None

    def _factor_ends(self, factor: Factor) -> set[Fraction]:
        """Return the extreme values of a factor: a number, its reciprocal, or a power of ten."""
        if self.scales.symbols.by_item(factor.point).floating:
            ends = set(self.float_range(factor) or ())
            return {end**factor.power for end in ends if end} or {Fraction(1)}
        low, high = self.ends_of(factor)
        if factor.ten_to:
            exponents = {max(-MOST_EXPONENT, min(MOST_EXPONENT, end)) for end in (low, high)}
            return {Fraction(10) ** (factor.power * exponent) for exponent in exponents}
        if factor.power == 1:
            return {Fraction(low), Fraction(high)}
        nearest = {divisor for divisor in (1, -1) if low <= divisor <= high}  # zero itself is an error at run time
        return {Fraction(1, divisor) for divisor in {low, high, *nearest} if divisor} or {Fraction(1)}

    def with_exponents(self, rule: Linear, span: Span) -> Linear:
        """Return the rule with the raw numbers that each exponent of ten may hold.

        Raises FactError for an exponent that can exceed MOST_EXPONENT.
        """
        return replace(rule, factors=tuple([self._with_exponents(factor, span) for factor in rule.factors]))

    def _with_exponents(self, factor: Factor, span: Span) -> Factor:
        if not factor.ten_to:
            return factor
        low, high = self.ends_of(factor)
        if max(abs(low), abs(high)) > MOST_EXPONENT:
            name = self.scales.symbols.by_item(factor.point).name
            message = f"`{name}` is an exponent and can be {low}..{high}"
            hint = f"give `{name}` a `range` within -{MOST_EXPONENT}..{MOST_EXPONENT}"
            raise FactError("exponent-range", message, span, hint)
        return replace(factor, within=self._without_codes(factor.point))

    def with_ranges(self, rule: Linear) -> Linear:
        """Return the rule with the declared range of each point that is an integer factor."""
        floats = self.scales.floats(rule)
        factors = [
            factor if factor in floats else replace(factor, within=self._without_codes(factor.point))
            for factor in rule.factors
        ]
        return replace(rule, factors=tuple(factors))

    def _without_codes(self, item: str) -> tuple[int, int]:
        """Return the hull of a point without the special codes at its ends."""
        return ends_without(self.encodings[self.scales.symbols.by_item(item)].specials, *self.hull(item))

    def encoded(self, facts: PointFacts, limit: Linear, span: Span) -> Linear:
        """Return a limit in units as a limit in raw numbers. Raises FactError."""
        if "scale" in facts.failed:
            raise FactError
        cases = self.scales.cases(facts)
        if cases is None:
            return limit
        scale = cases[0].rule
        if self.scales.floats(scale):
            message = "limits in units cannot be computed from a floating-point number"
            hint = "give the limits as raw numbers under `range`"
            raise FactError("bad-formula", message, span, hint)
        if len(cases) > 1 or (limit.factors and limit.offset):
            message = "limits in units need one rule, and no sum of points and numbers"
            hint = "give the limits as raw numbers under `range`"
            raise FactError("bad-formula", message, span, hint)
        if not limit.factors:
            return Linear((limit.ratio + limit.offset) * scale.ratio, scale.offset, scale.factors)
        return Linear(limit.ratio * scale.ratio, scale.offset, (*limit.factors, *scale.factors))

    def limit(self, facts: PointFacts, end: Expression, text: str, span: Span, in_units: bool) -> Linear:
        """Return one end of a range as a rule that gives it for the value 1. Raises FormulaError or FactError."""
        rule = limit_rule(end, lambda name, part: self._of_another(facts, name, part, Written(text, span)))
        return self.encoded(facts, rule, span) if in_units else rule

    def _of_another(self, facts: PointFacts, name: str, part: Part, formula: Written) -> Affine:
        """Return the number of one point in a limit of another. Raises FactError."""
        used = self.scales.symbols.find(name, facts)
        if used is not None and used.name == facts.name:
            message = f"`{name}` cannot limit itself"
            hint = "name another point, or write the fixed end that the manual prints"
            raise FactError("bad-formula", message, formula.of(name), hint)
        return self.scales.affine(facts, name, part, formula)

    def falls(self, facts: PointFacts) -> bool:
        """Return True if the raw number falls as the value rises."""
        cases = self.scales.cases(facts)
        return cases is not None and cases[0].rule.ratio < 0

    def _computed_end(self, facts: PointFacts, end: int) -> int:
        """Return one end of the part of the type that the range allows; that of the type if the range is unusable."""
        key = "range" if facts.layer("range") is not None else "range_in_units"
        least, greatest = self.encodings[facts].holds
        if facts.layer(key) is None or facts.floating or facts.text:
            return self.encodings[facts].holds[end]
        text, span = as_text(facts.get(key)), facts.span(key)
        pick = max if end else min
        in_units = key != "range"
        side = 1 - end if in_units and self.falls(facts) else end
        try:
            rules = [self.limit(facts, ends[side], text, span, in_units) for ends in parse_range(text).alternatives]
            candidates = [corner for rule in rules for corner in self.corners(rule)]
        except (FormulaError, FactError):
            return self.encodings[facts].holds[end]
        return max(least, min(greatest, half_away(pick(candidates))))
