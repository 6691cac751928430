"""The symbol table: finds points by name, code and item."""

from collections.abc import Collection
from dataclasses import dataclass

from fieldscribe.diagnostics import Span
from fieldscribe.language.hints import nearest
from fieldscribe.resolve.point_facts import PointFacts
from fieldscribe.resolve.scope import Scope


@dataclass(slots=True)
class SymbolTable:
    """Points by name (several if variants differ), by code and by item."""

    scope: Scope
    by_name: dict[str, list[PointFacts]]
    by_code: dict[str, list[PointFacts]]
    by_items: dict[str, PointFacts]

    def find(self, word: str, used_by: PointFacts | None = None) -> PointFacts | None:
        """Return the point that a word names: by its name, or by a code that no other point has.

        An element of an array refers to the elements of other arrays that have its own index. Of a point that differs
        by variant, return the one of the variant that uses it, else the first.
        """
        of_element = () if used_by is None else self.by_name.get(word + used_by.suffix, ())
        found = self.by_name.get(word) or of_element or self.by_code.get(word, [])
        if not found or (len(found) > 1 and any(facts.name != found[0].name for facts in found)):
            return None
        variant = None if used_by is None else used_by.variant
        return next((facts for facts in found if facts.variant == variant), found[0])

    def by_item(self, item: str) -> PointFacts:
        """Return the point of a resolved reference: by item, or by name if all its variants are meant."""
        return self.by_items.get(item) or self.by_name[item][0]

    def siblings(self, facts: PointFacts) -> list[PointFacts]:
        """Return the point in all its variants."""
        return self.by_name[facts.name]

    def all(self, word: str) -> list[PointFacts]:
        """Return every point that a word names: by its name, or by a code that several may share."""
        return self.by_name.get(word) or self.by_code.get(word, [])

    def unknown(self, word: str, span: Span, axes: Collection[str] = ()) -> None:
        """Report a word that names no point, or several; it could also name one of the variant `axes`."""
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


def symbols_of(scope: Scope, points: list[PointFacts]) -> SymbolTable:
    """Return the symbol table; report and remove a point with the name of another, unless both are variants."""
    symbols = SymbolTable(scope, {}, {}, {})
    kept = []
    for facts in points:
        known = symbols.by_name.setdefault(facts.name, [])
        first = next((earlier for earlier in known if not _are_variants(earlier, facts)), None)
        if first is not None:
            related = [(first.span(), "first given here")]
            hint = "names are unique in a device; a point that differs by variant says so under `variants`"
            message = f"two points have the name `{facts.name}`"
            scope.report.error("duplicate-name", message, facts.span(), hint, related)
            continue
        known.append(facts)
        symbols.by_items.setdefault(facts.item, facts)
        if (code := facts.code) is not None:
            symbols.by_code.setdefault(code, []).append(facts)
        kept.append(facts)
    points[:] = kept
    return symbols


def _are_variants(facts: PointFacts, other: PointFacts) -> bool:
    """Return True if two points are one point in two variants."""
    return (
        facts.variant is not None and other.variant not in (None, facts.variant) and facts.layers[1] is other.layers[1]
    )
