"""The numbers that a manual prints for people, as rules of the address on the wire."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

from fieldscribe.language.formula import FormulaError, evaluate, parse_expression
from fieldscribe.language.formula.syntax import names
from fieldscribe.resolve.values import formula_finding

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fieldscribe.diagnostics import Report
    from fieldscribe.language.nodes import Map

WIRE = "wire"
"""The name of the address on the wire in formulas of `numbering`."""

_Rule = tuple[int, int]
"""Slope and offset of a printed number over the address."""
_PROBES = (0, 1, 2, 0xFFFF)
"""Addresses at which a formula is tried, to see whether it is such a rule."""


class Numberings:
    """The rules of all groups, each read once."""

    def __init__(self, report: Report) -> None:
        self.report = report
        self._known: dict[int, Mapping[str, _Rule | None]] = {}

    def numbers(self, numbering: Map, address: int) -> Mapping[str, int]:
        """The number of an address in each numbering of a group that can be read."""
        key = id(numbering)
        if key not in self._known:
            self._known[key] = self._rules(numbering)
        return {name: address * rule[0] + rule[1] for name, rule in self._known[key].items() if rule is not None}

    def _rules(self, numbering: Map) -> Mapping[str, _Rule | None]:
        """Each numbering as (slope, offset) of the address; None after a finding."""
        rules: dict[str, _Rule | None] = {WIRE: (1, 0)}
        for name, text in numbering.items():
            if name == WIRE:
                hint = "`wire` is the address itself: choose another name"
                message = "a numbering cannot be called `wire`"
                self.report.error("duplicate-name", message, numbering.key_span(name), hint)
                continue
            rules[name] = self._rule(numbering, name, text, rules)
        del rules[WIRE]
        return rules

    def _rule(self, numbering: Map, name: str, text: str, known: Mapping[str, _Rule | None]) -> _Rule | None:
        span = numbering.span(name)
        try:
            expression = parse_expression(text)
            if any(known.get(used.name, 0) is None for used in names(expression)):
                return None  # the finding stands where that numbering does
            at = [
                evaluate(
                    expression, {other: Fraction(rule[0] * wire + rule[1]) for other, rule in known.items() if rule}
                )
                for wire in _PROBES
            ]
        except FormulaError as error:
            formula_finding(error, span, self.report)
            return None
        slope, offset = at[1] - at[0], at[0]
        straight = all(result == slope * wire + offset for wire, result in zip(_PROBES, at, strict=True))
        if slope.denominator != 1 or offset.denominator != 1 or not straight:
            message = f"`{name}` is not a whole number at every address"
            self.report.error("bad-formula", message, span, "write it as `wire + 1` or `40000 + wire`")
            return None
        return slope.numerator, offset.numerator
