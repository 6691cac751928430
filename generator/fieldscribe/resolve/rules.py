"""Scales as exact rules: from the author's formula to `raw = value * ratio * factors + offset`."""

from __future__ import annotations

from fractions import Fraction

from fieldscribe.diagnostics import Span
from fieldscribe.language.formula import Affine, FormulaError, parse_case, parse_scale, scale_rule
from fieldscribe.language.nodes import Map
from fieldscribe.model import Linear, ScaleCase
from fieldscribe.resolve.drafts import Draft
from fieldscribe.resolve.names import Index
from fieldscribe.resolve.scope import Scope
from fieldscribe.resolve.values import formula_finding

IDENTITY = Linear(Fraction(1), Fraction(0), ())


class Scales:
    """The scale of every point, computed when first asked for; a point that needs itself is a finding."""

    def __init__(self, scope: Scope, index: Index) -> None:
        self.scope = scope
        self.index = index
        self._known: dict[int, tuple[ScaleCase, ...] | None] = {}
        self._open: list[Draft] = []

    def cases(self, draft: Draft) -> tuple[ScaleCase, ...] | None:
        """The cases of the point's scale; None where the raw number is the value (also after a finding)."""
        key = id(draft)
        if key not in self._known:
            self._open.append(draft)
            self._known[key] = self._cases(draft)
            self._open.pop()
        return self._known[key]

    def _cases(self, draft: Draft) -> tuple[ScaleCase, ...] | None:
        raw = draft.get("scale")
        if raw is None:
            return None
        span = draft.span("scale")
        if isinstance(raw, str):
            rule = self._rule(raw, span)
            return None if rule is None or rule == IDENTITY else (ScaleCase(None, None, rule),)
        cases = [self._case(one) for one in raw]
        return tuple(case for case in cases if case is not None) or None

    def _case(self, one: Map) -> ScaleCase | None:
        rule = self._rule(one["rule"], one.span("rule"))
        try:
            name, constant = parse_case(one["when"])
        except FormulaError as error:
            formula_finding(error, one.span("when"), self.scope.report)
            return None
        chosen = self.index.find(name.name)
        if chosen is None:
            self.unknown(name.name, name.column, one.span("when"))
            return None
        return None if rule is None else ScaleCase(chosen.item, constant, rule)

    def _rule(self, text: str, span: Span) -> Linear | None:
        try:
            return scale_rule(parse_scale(text), lambda name, part: self.affine(name, part, text, span))
        except FormulaError as error:
            formula_finding(error, span, self.scope.report)
        except Unknown:
            pass
        return None

    def affine(self, name: str, part: str, text: str, span: Span) -> Affine:
        """A point's number in a formula: raw * slope + intercept."""
        used = self.index.find(name)
        if used is None:
            self.unknown(name, max(0, text.find(name)), span)
            raise Unknown
        if part == "raw":
            return Affine(used.item, Fraction(1), Fraction(0))
        if used in self._open:
            chain = " needs ".join(f"`{draft.name}`" for draft in [*self._open[self._open.index(used) :], used])
            self.scope.report.error(
                "scale-cycle",
                f"a scale that needs itself: {chain}",
                span,
                "use `.raw` of one of them, or break the circle",
            )
            raise Unknown
        cases = self.cases(used)
        if cases is None:
            return Affine(used.item, Fraction(1), Fraction(0))
        if len(cases) > 1 or cases[0].rule.factors:
            message = f"the value of `{name}` itself depends on another point"
            self.scope.report.error("bad-formula", message, span, f"use `{name}.raw`, or write its rule out here")
            raise Unknown
        rule = cases[0].rule
        return Affine(used.item, 1 / rule.ratio, -rule.offset / rule.ratio)

    def unknown(self, name: str, column: int, span: Span) -> None:
        """A finding for a name that no point has."""
        place = span._replace(column=span.column + column, width=len(name))
        self.scope.report.error("unknown-point", f"there is no point `{name}`", place, self.index.hint(name))


class Unknown(Exception):
    """A name in a formula could not be resolved; the finding is already reported."""
