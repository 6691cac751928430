"""Resolves scales: from the author's formula to the exact rule `raw = value * ratio * factors + offset`."""

from collections.abc import Iterator
from fractions import Fraction

from fieldscribe.diagnostics import Span
from fieldscribe.language.formula.conditions import parse_case
from fieldscribe.language.formula.normal import Affine, scale_rule
from fieldscribe.language.formula.parser import parse_scale
from fieldscribe.language.formula.suggestions import cut_off, suggest_scale
from fieldscribe.language.formula.syntax import FormulaError, Part
from fieldscribe.language.nodes import Map
from fieldscribe.model import Factor, Linear, ScaleCase
from fieldscribe.resolve.point_facts import PointFacts
from fieldscribe.resolve.scope import Scope
from fieldscribe.resolve.symbols import SymbolTable
from fieldscribe.resolve.values import FactError, Written, formula_finding

IDENTITY = Linear(Fraction(1), Fraction(0), ())


_LONGEST_CHAIN = 100
"""The most points that the search for a circle visits; longer circles are refused elsewhere."""


class Scales:
    """Resolves the scale of a point when it is first needed; reports scales that need themselves."""

    def __init__(self, scope: Scope, symbols: SymbolTable) -> None:
        self.scope = scope
        self.symbols = symbols
        self._known: dict[PointFacts, tuple[ScaleCase, ...] | None] = {}

    def cases(self, facts: PointFacts) -> tuple[ScaleCase, ...] | None:
        """Return the cases of the point's scale; None if the raw number is the value, or after a finding."""
        if facts not in self._known:
            self._known[facts] = self._cases(facts)
        return self._known[facts]

    def affine(self, facts: PointFacts, name: str, part: Part, formula: Written, *, in_scale: bool = False) -> Affine:
        """Return a point's number in a formula as raw * slope + intercept. Raises FactError."""
        place = formula.of(name)
        used = self._find(facts, name, place)
        self._check_settled(used, name, part, place)
        if used.floating:
            self._check_floating(used, name, part, place, in_scale=in_scale)
            return Affine(self._model_name(facts, used, place), Fraction(1), Fraction(0))
        if part == "raw":
            return Affine(self._model_name(facts, used, place), Fraction(1), Fraction(0))
        if in_scale and (chain := self._circle(facts, used)):
            message = f"a scale that needs itself: {' needs '.join(f'`{needed}`' for needed in chain)}"
            hint = f"use `{name}.raw`, or break the circle"
            raise FactError("scale-cycle", message, place, hint)
        rule = self._rule_of_its_own(used, name, place)
        if len({self.cases(sibling) for sibling in self.symbols.siblings(used)}) > 1 and used.variant != facts.variant:
            raise bad_formula(
                place, f"the scale of `{name}` differs by variant", f"use `{name}.raw`, or give `variants` here too"
            )
        return Affine(self._model_name(facts, used, place), 1 / rule.ratio, -rule.offset / rule.ratio)

    def _check_settled(self, used: PointFacts, name: str, part: Part, place: Span) -> None:
        """Raise FactError for a point that is not a number, or whose type or scale is not settled."""
        if used.no_number:
            raise bad_formula(place, f"`{name}` is {used.no_number}", "a formula takes only points that hold a number")
        if used.untyped:
            raise bad_formula(place, f"no type says what `{name}` is", "a formula needs a number: say its `type`")
        for key in ("type",) if part == "raw" else ("type", "scale"):
            if used.layer(key) is not None and used.get(key) is None and key not in used.failed:
                hint = "a formula needs what is settled: write `scale: ~` here too, or settle it"
                raise bad_formula(place, f"the {key} of `{name}` is not settled", hint)

    def _model_name(self, facts: PointFacts, used: PointFacts, place: Span) -> str:
        """Return the model's name of a point that `facts` uses: its item in the same variant, else its plain name."""
        if used.variant is None or used.variant == facts.variant:
            return used.item
        if len({sibling.get("type") or "" for sibling in self.symbols.siblings(used)}) > 1:
            hint = "give `variants` here too"
            raise bad_formula(place, f"the type of `{used.name}` differs by variant", hint)
        return used.name

    def _check_floating(self, used: PointFacts, name: str, part: Part, place: Span, *, in_scale: bool) -> None:
        """Report a floating-point number that is not allowed here; a scale may have the value of an f32 as a factor."""
        if not in_scale:
            message = f"`{name}` is a floating-point number, which a limit cannot name"
            raise bad_formula(place, message, "write the widest range")
        if part == "raw":
            message = f"the raw number of `{name}` is a floating-point pattern"
            raise bad_formula(place, message, f"use its value: {name}")
        if used.get("type") != "f32":
            raise bad_formula(
                place, f"`{name}` is wider than 32 bits and cannot be a factor", "factors are f32 or whole"
            )

    def floats(self, rule: Linear) -> list[Factor]:
        """Return the factors of a rule that are floating-point numbers."""
        return [factor for factor in rule.factors if self.symbols.by_item(factor.point).floating]

    def _cases(self, facts: PointFacts) -> tuple[ScaleCase, ...] | None:
        raw = facts.get("scale")
        if raw is None:
            return None
        if isinstance(raw, str):
            rule = self._rule(facts, raw, facts.span("scale"))
            return None if rule is None or rule == IDENTITY else (ScaleCase(None, None, rule, written(raw)),)
        seen: dict[tuple[str, int], Span] = {}
        cases = tuple(case for entry in raw if (case := self._case(facts, entry, seen)) is not None)
        if not cases:
            facts.failed.add("scale")
        return cases or None

    def _case(self, facts: PointFacts, entry: Map, seen: dict[tuple[str, int], Span]) -> ScaleCase | None:
        rule, place = self._rule(facts, entry["rule"], entry.span("rule")), entry.span("when")
        try:
            name, constant = parse_case(entry["when"])
            chosen = self._model_name(facts, self._find(facts, name.name, place.moved(name.column)), place)
        except FormulaError as error:
            formula_finding(error, place, self.scope.report)
        except FactError as error:
            error.report(self.scope.report)
        else:
            first = seen.setdefault((chosen, constant), place)
            if first is not place:
                message, related = "two rules hold in this case", [(first, "first given here")]
                self.scope.report.error("duplicate-case", message, place, "remove one of them", related)
            return None if rule is None else ScaleCase(chosen, constant, rule, written(entry["rule"]))
        facts.failed.add("scale")
        return None

    def _rule(self, facts: PointFacts, text: str, span: Span) -> Linear | None:
        formula = Written(text, span)
        try:
            rule = scale_rule(
                parse_scale(text), lambda name, part: self.affine(facts, name, part, formula, in_scale=True)
            )
            if all((factor.slope, factor.intercept, factor.ten_to) == (1, 0, False) for factor in self.floats(rule)):
                self._warn_of_cut_decimal(text, span)
                return rule
            message = "a floating-point number can be a factor, but no exponent and no part of a sum"
            raise bad_formula(span, message, "multiply with it, or divide by it")
        except FormulaError as error:
            _suggest_scale(error, text, "rule" if isinstance(facts.get("scale"), list) else "scale")
            formula_finding(error, span, self.scope.report)
        except FactError as error:
            error.report(self.scope.report)
        facts.failed.add("scale")
        return None

    def _warn_of_cut_decimal(self, text: str, span: Span) -> None:
        """Warn of a decimal that looks cut off (0.33333): a later reader cannot tell which number was intended."""
        decimal = cut_off(text)
        if decimal is not None:
            message = f"{decimal.typed} looks like {decimal.exact}, cut off"
            self.scope.report.warning("cut-decimal", message, span, f"write `{decimal.line}` to keep it exact")

    def _rule_of_its_own(self, used: PointFacts, name: str, place: Span) -> Linear:
        """Return the rule of a point whose value another formula uses; it must not depend on a third point."""
        moves = any(True for _ in self._needs(used)) or isinstance(used.get("scale"), list)
        cases = None if moves else self.cases(used)
        if moves or (cases is not None and cases[0].rule.factors):
            hint = f"use `{name}.raw`, or write its rule out here"
            raise bad_formula(place, f"the value of `{name}` itself depends on another point", hint)
        if "scale" in used.failed:
            raise FactError
        return IDENTITY if cases is None else cases[0].rule

    def _circle(self, facts: PointFacts, used: PointFacts) -> list[str]:
        """Return the names from `facts` through `used` back to `facts` if their values need each other in a circle."""
        came_from: dict[PointFacts, PointFacts | None] = {used: None}
        waiting = [used]
        while waiting and len(came_from) < _LONGEST_CHAIN:
            visited = waiting.pop()
            if visited is facts:
                chain = [visited.name]
                step = came_from[visited]
                while step is not None:
                    chain.append(step.name)
                    step = came_from[step]
                return [facts.name, *reversed(chain)]
            for needed in self._needs(visited):
                if needed not in came_from:
                    came_from[needed] = visited
                    waiting.append(needed)
        return []

    def _needs(self, facts: PointFacts) -> Iterator[PointFacts]:
        """Yield the points whose values the scale of this point needs."""
        raw = facts.get("scale")
        for text in (raw,) if isinstance(raw, str) else (entry["rule"] for entry in raw or ()):
            try:
                uses = parse_scale(text).uses
            except FormulaError:
                continue
            for name in uses:
                needed = self.symbols.find(name.name, facts) if name.part == "value" else None
                if needed is not None:
                    yield needed

    def _find(self, facts: PointFacts, name: str, place: Span) -> PointFacts:
        """Return the point that a formula of `facts` names. Raises FactError."""
        used = self.symbols.find(name, facts)
        if used is None:
            self.symbols.unknown(name, place)
            raise FactError
        return used


def bad_formula(place: Span, message: str, hint: str) -> FactError:
    """Return the error for a formula that cannot be used."""
    return FactError("bad-formula", message, place, hint)


def written(text: str) -> str:
    """Return a formula on one line, as its author wrote it."""
    return " ".join(text.split())


def _suggest_scale(error: FormulaError, text: str, key: str) -> None:
    """Add the scale that was probably intended as a hint, if one can be guessed from the text."""
    try:
        parse_scale(text)
    except FormulaError:
        suggestion = suggest_scale(text)
        if suggestion is not None:
            error.hint = f"write `{key}: {suggestion}`"
