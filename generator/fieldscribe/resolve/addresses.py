"""Where a point is: its address on the wire, its words in order, and the numbers that the manual prints for people."""

from __future__ import annotations

import re
from fractions import Fraction
from typing import TYPE_CHECKING

from fieldscribe.language.formula import FormulaError, evaluate, parse_expression
from fieldscribe.language.formula.syntax import names
from fieldscribe.language.nodes import Map
from fieldscribe.model import TYPES, Place
from fieldscribe.resolve.values import formula_finding, formula_value, integer
from fieldscribe.wording.exact import number_text

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fieldscribe.resolve.drafts import Draft
    from fieldscribe.resolve.scope import Scope

_FORMULA = re.compile(r"[A-Za-z0-9_)]\s*[-+*/]|\(|\bbase\b")

WIRE = "wire"
"""The name of the address on the wire in formulas of `numbering`."""


class Places:
    """The addressing of one device."""

    def __init__(self, scope: Scope) -> None:
        self.scope = scope
        self.report = scope.report
        self.last = scope.family.last_address
        bus = scope.bus
        self.words = None if bus is None else bus.get("words")
        self._numberings: dict[int, Mapping[str, tuple[int, int] | None]] = {}

    def address(self, draft: Draft) -> int | None:
        """The number on the wire; None if the manual prints none, or after a finding."""
        layer = draft.layer("at")
        if layer is None:
            if "at" not in draft.failed:
                hint = "add `at: …`, or `at: ~` if the manual prints none"
                self.report.error("missing-key", f"`{draft.name}` says no address", draft.span(), hint)
            return None
        raw = layer["at"]
        if raw is None or (draft.use is not None and draft.use.get("at", 0) is None):
            return None
        address = raw if isinstance(raw, int) else self._computed(draft, str(raw))
        if address is None or 0 <= address <= self.last:
            return address
        message = f"the address {address} lies outside 0..{self.last}"
        hint = "`at` is the number on the wire; the numbers for people (40001) go under `printed`"
        self.report.error("address-outside-space", message, draft.span("at"), hint)
        return None

    def _computed(self, draft: Draft, text: str) -> int | None:
        span = draft.span("at")
        if _FORMULA.search(text) is None:
            return integer(text, span, self.report)
        base = self._base(draft)
        if base is None:
            return None
        known = "`base` is where a record is used: it is known in the points of a record only" if not base else ""
        exact = formula_value(text, base, span, self.report, known)
        if exact is None:
            return None
        if exact.denominator != 1:
            message = f"the address {number_text(exact)} is not a whole number"
            self.report.error("bad-number", message, span, "`at` is the number on the wire")
            return None
        return exact.numerator

    def _base(self, draft: Draft) -> Mapping[str, Fraction] | None:
        """What an address may be computed from: the place where a record is used. None after a finding."""
        use = draft.use
        if use is None:
            return {}
        if "at" not in use:
            if "at" not in use.broken:
                hint = "add `at: …`, or `at: ~` if the manual prints none"
                self.report.error("missing-key", "the record stands at no address", use.span("name"), hint)
            return None
        base = integer(use["at"], use.span("at"), self.report)
        return None if base is None else {"base": Fraction(base)}

    def place(self, draft: Draft, space: str, type_name: str, bits: tuple[int, int] | None, address: int) -> Place:
        """The words of a point, the one with the high part first."""
        count = 1 if bits else max(1, TYPES[type_name].bits // 16)
        words = (address,) if count == 1 else tuple(range(address, address + count))
        if words[-1] > self.last:
            message = f"the last word of `{draft.name}` lies outside 0..{self.last}"
            self.report.error("address-outside-space", message, draft.span("at"), "check the address and the type")
        order = draft.get("words") or self._order(type_name)
        purpose = "write" if draft.get("access") == "w" else "read"
        return Place(purpose, space, words[::-1] if order == "low first" else words, None)

    def _order(self, type_name: str) -> str:
        if isinstance(self.words, Map):
            return str(self.words.get(type_name, "high first"))
        return str(self.words or "high first")

    def references(self, draft: Draft, address: int | None) -> Mapping[str, int]:
        """The printed numbers that follow from the address, by numbering."""
        numbering: Map | None = draft.group.get("numbering")
        if address is None or numbering is None:
            return {}
        key = id(numbering)
        if key not in self._numberings:
            self._numberings[key] = self._numbering(numbering)
        return {name: address * rule[0] + rule[1] for name, rule in self._numberings[key].items() if rule is not None}

    def _numbering(self, numbering: Map) -> Mapping[str, tuple[int, int] | None]:
        """Each numbering as (slope, offset) of the address; None after a finding."""
        rules: dict[str, tuple[int, int] | None] = {WIRE: (1, 0)}
        for name, text in numbering.items():
            if name == WIRE:
                hint = "`wire` is the address itself: choose another name"
                self.report.error(
                    "duplicate-name", "a numbering cannot be called `wire`", numbering.key_span(name), hint
                )
                continue
            rules[name] = self._rule(numbering, name, text, rules)
        del rules[WIRE]
        return rules

    def _rule(
        self, numbering: Map, name: str, text: str, known: Mapping[str, tuple[int, int] | None]
    ) -> tuple[int, int] | None:
        span = numbering.span(name)
        try:
            expression = parse_expression(text)
            if any(known.get(used.name, 0) is None for used in names(expression)):
                return None  # the finding stands where that numbering does
            at = [
                evaluate(expression, {one: Fraction(rule[0] * wire + rule[1]) for one, rule in known.items() if rule})
                for wire in (0, 1, 2, 0xFFFF)
            ]
        except FormulaError as error:
            formula_finding(error, span, self.report)
            return None
        slope, offset = at[1] - at[0], at[0]
        if (
            slope.denominator != 1
            or offset.denominator != 1
            or (at[2], at[3]) != (2 * slope + offset, 0xFFFF * slope + offset)
        ):
            message = f"`{name}` is not a whole number at every address"
            self.report.error("bad-formula", message, span, "write it as `wire + 1` or `40000 + wire`")
            return None
        return slope.numerator, offset.numerator
