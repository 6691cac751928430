"""Points by name and code, and what is known of them before any formula is read."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.language.hints import nearest

if TYPE_CHECKING:
    from collections.abc import Collection

    from fieldscribe.diagnostics import Span
    from fieldscribe.model import Variant
    from fieldscribe.resolve.point_facts import PointFacts
    from fieldscribe.resolve.scope import Scope


@dataclass(slots=True)
class SymbolTable:
    """Drafts by name (several where variants differ) and by code; a code that several points have finds none."""

    scope: Scope
    by_name: dict[str, list[PointFacts]]
    by_code: dict[str, list[PointFacts]]
    by_items: dict[str, PointFacts]

    def find(self, word: str, variant: Variant | None = None) -> PointFacts | None:
        """The point that a formula or an erratum means by `word`: its name, or a code that no other point has.

        Of a point that differs by variant it is the one of this variant, else the first.
        """
        expanded = self.by_name.get(word) or self.by_code.get(word, [])
        if not expanded or (len(expanded) > 1 and any(facts.name != expanded[0].name for facts in expanded)):
            return None
        return next((facts for facts in expanded if facts.variant == variant), expanded[0])

    def by_item(self, item: str) -> PointFacts:
        """The point that a formula was resolved to: by its item name, or by its name where its variants are alike."""
        return self.by_items.get(item) or self.by_name[item][0]

    def siblings(self, facts: PointFacts) -> list[PointFacts]:
        """The point in all its variants."""
        return self.by_name[facts.name]

    def all(self, word: str) -> list[PointFacts]:
        """Every point that `word` names: itself, or all that carry the code."""
        return self.by_name.get(word) or self.by_code.get(word, [])

    def unknown(self, word: str, span: Span, axes: Collection[str] = ()) -> None:
        """A finding for a word that means no point, or several; it could also mean one of the variant `axes`."""
        several = self.by_code.get(word, [])
        if several:
            message = f"`{word}` is the code of {len(several)} points"
            self.scope.report.error("unknown-point", message, span, f"name one of them, such as `{several[0].name}`")
            return
        hexadecimal = word.isupper() and all(char in "0123456789ABCDEF" for char in word)
        hint = f"if a hexadecimal number is meant, write 0{word}h" if hexadecimal else None
        near = nearest(word, (*axes, *self.by_name, *self.by_code)) if axes else None
        hint = f"did you mean the axis `{near}`?" if near in axes else hint
        self.scope.unknown("point", word, span, [*self.by_name, *self.by_code], hint)


def symbols_of(scope: Scope, expanded: list[PointFacts]) -> SymbolTable:
    """All expanded by name and code; of two points of one name that are not variants the second is a finding."""
    index = SymbolTable(scope, {}, {}, {})
    kept = []
    for facts in expanded:
        known = index.by_name.setdefault(facts.name, [])
        first = _other(known, facts) if known else None
        if first is not None:
            related = [(first.span(), "first given here")]
            hint = "names are unique in a device; a point that differs by variant says so under `variants`"
            scope.report.error(
                "duplicate-name", f"two points have the name `{facts.name}`", facts.span(), hint, related
            )
            continue
        known.append(facts)
        index.by_items.setdefault(facts.item, facts)
        if facts.code is not None:
            index.by_code.setdefault(facts.code, []).append(facts)
        kept.append(facts)
    expanded[:] = kept
    return index


def _other(known: list[PointFacts], facts: PointFacts) -> PointFacts | None:
    """The first point of the same name that is not the same point in another variant."""
    return next((earlier for earlier in known if not _are_variants(earlier, facts)), None)


def _are_variants(facts: PointFacts, other: PointFacts) -> bool:
    """Whether two expanded are one point in two variants."""
    return (
        facts.variant is not None and other.variant not in (None, facts.variant) and facts.layers[1] is other.layers[1]
    )
