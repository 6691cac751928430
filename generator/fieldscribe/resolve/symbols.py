"""Points by name and code, and what is known of them before any formula is read."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.language.hints import nearest, quoted
from fieldscribe.language.meant import bits_meant, space_hint
from fieldscribe.model import TYPES, TypeInfo
from fieldscribe.resolve.values import integer

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


def space_of(scope: Scope, facts: PointFacts) -> str:
    """The point's address space; a finding, and the family's first space of words, if there is none of that name."""
    space = str(facts.get("space"))
    known = scope.family.spaces
    if space in known:
        return space
    scope.unknown("space", space, facts.span("space"), known, space_hint(space, known))
    facts.failed.add("space")
    return next(name for name, holds in known.items() if holds == "word")


def bits_of(scope: Scope, facts: PointFacts, space: str) -> tuple[int, int] | None:
    """The (highest, lowest) bit that the point takes of its word, or None for the whole."""
    text = facts.get("bits")
    if text is None:
        return None
    span = facts.span("bits")
    if scope.family.spaces[space] == "bit":
        scope.report.error(
            "bit-outside-word", f"the space `{space}` holds single bits, not words", span, "leave `bits` out"
        )
        return None
    return _parse_bits(scope, str(text), span)


def _parse_bits(scope: Scope, text: str, span: Span) -> tuple[int, int] | None:
    meant = bits_meant(text)
    if meant is not None:
        message = f"{quoted(text)} is not a bit or bits"
        scope.report.error("wrong-form", message, span, f"write `bits: {meant}`")
        return None
    high_text, dots, low_text = text.partition("..")
    high = integer(high_text.strip(), span, scope.report)
    low = integer(low_text.strip(), span, scope.report) if dots else high
    if high is None or low is None:
        return None
    if low > high:
        hint = f"the higher bit stands first: {low}..{high}"
        scope.report.error("range-reversed", f"bits `{text}` run upwards", span, hint)
        return None
    outside = next((bit for bit in (high, low) if not 0 <= bit <= 15), None)
    if outside is not None:
        message = f"bit {outside} lies outside the 16-bit word"
        scope.report.error(
            "bit-outside-word", message, span, "bits are numbered 15..0; bit 16 is bit 0 of the next address"
        )
        return None
    return high, low


def type_of(scope: Scope, facts: PointFacts, space: str, bits: tuple[int, int] | None) -> str:
    """The point's wire type: as described, else by its space and bits; a finding if it does not fit them."""
    single = scope.family.spaces[space] == "bit"
    width = bits[0] - bits[1] + 1 if bits else None
    default = "bit" if single or width == 1 else "u8" if width is not None and width <= 8 else "u16"
    type_name = str(facts.get("type") or default) if facts.untyped is None else default
    fault = None if "space" in facts.failed else _type_fault(type_name, space, single, width, default)
    fault = fault or (None if bits else _carrier_fault(scope, type_name, space))
    if fault is None:
        return type_name
    facts.failed.add("type")
    span = facts.span("type" if facts.layer("type") is not None else "space")
    scope.report.error(fault[0], fault[1], span, fault[2])
    return default


def _carrier_fault(scope: Scope, type_name: str, space: str) -> tuple[str, str, str] | None:
    """Rule, message and hint for a type that is too wide for the bus, or None."""
    widest = scope.family.widest(space)
    if type_name == "text" and space in scope.family.indexed:
        message = f"a text does not fit an address of `{space}`, which carries {widest} bits"
        return (
            "type-outside-space",
            message,
            'write in place of `type` and `characters`: `untyped: "a text, one character an index"`, in words that fit',
        )
    if type_name == "text" or TYPES[type_name].bits <= widest:
        return None
    if space in scope.family.indexed:
        message = f"`{type_name}` does not fit an address of `{space}`, which carries {widest} bits"
        return "type-outside-space", message, "use u32, s32 or f32, or correct `space`"
    message = f"`{type_name}` does not fit into a message, which carries one word"
    return "type-outside-space", message, "give each address a point of its own"


def _type_fault(
    type_name: str, space: str, single: bool, width: int | None, default: str
) -> tuple[str, str, str] | None:
    """Rule, message and hint of what is wrong with the type, or None."""
    info: TypeInfo = TYPES[type_name]
    if type_name == "text" and (single or width is not None):
        return "type-outside-space", "a text takes whole words", "leave `bits` out, and choose a space of words"
    if width is not None:
        if width <= info.bits <= 16 and not info.floating:
            return None
        return "bit-outside-word", f"{width} bits do not fit the type `{type_name}`", f"use `{default}`"
    if single != (type_name == "bit"):
        message = (
            f"`{type_name}` does not fit the space `{space}`, which holds {'single bits' if single else '16-bit words'}"
        )
        return "type-outside-space", message, "use `bit`" if single else "use `bits` to take one bit of a word"
    if not single and info.bits < 16:
        message = f"`{type_name}` is smaller than the words of `{space}`"
        return "type-outside-space", message, "use u16 or s16, or say which `bits` of the word it takes"
    return None
