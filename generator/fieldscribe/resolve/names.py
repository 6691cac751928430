"""Which points exist under which name and code, and what is clear about them before any formula is read."""

from __future__ import annotations

from dataclasses import dataclass

from fieldscribe.diagnostics import Span
from fieldscribe.families import FAMILIES
from fieldscribe.model import TYPES, TypeInfo
from fieldscribe.resolve.drafts import Draft
from fieldscribe.resolve.scope import Scope, unknown_name
from fieldscribe.resolve.values import interval


@dataclass(slots=True)
class Index:
    """Drafts by name and by code; a code that several points carry (a record's) names none of them."""

    by_name: dict[str, Draft]
    by_code: dict[str, list[Draft]]
    by_items: dict[str, Draft]

    def find(self, word: str) -> Draft | None:
        """The point that a formula or an erratum means by `word`: its name, or a code that only one point has."""
        found = self.by_name.get(word)
        if found is not None:
            return found
        coded = self.by_code.get(word, [])
        return coded[0] if len({draft.name for draft in coded}) == 1 else None

    def by_item(self, item: str) -> Draft:
        """The point of that item name, which a formula was resolved to."""
        return self.by_items[item]

    def all(self, word: str) -> list[Draft]:
        """Every point that `word` names: itself, or all that carry the code."""
        found = self.by_name.get(word)
        return [found] if found is not None else self.by_code.get(word, [])

    def hint(self, word: str) -> str:
        """What an unknown word may have meant."""
        several = self.by_code.get(word, [])
        if several:
            return f"`{word}` is the code of {len(several)} points; name one of them, such as `{several[0].name}`"
        return unknown_name(word, [*self.by_name, *self.by_code], "points")


def index_of(scope: Scope, drafts: list[Draft]) -> Index:
    """All drafts by name and code; two points of one name (not variants of each other) are a finding, the second is dropped."""
    index = Index({}, {}, {})
    kept = []
    for draft in drafts:
        first = index.by_name.get(draft.name)
        if first is not None and not (draft.variant and first.variant and draft.own is first.own):
            related = [(first.span(), "first given here")]
            scope.report.error(
                "duplicate-name",
                f"two points have the name `{draft.name}`",
                draft.span(),
                "names are unique in a device",
                related,
            )
            continue
        index.by_name.setdefault(draft.name, draft)
        index.by_items[draft.item] = draft
        if draft.code is not None:
            index.by_code.setdefault(draft.code, []).append(draft)
        kept.append(draft)
    drafts[:] = kept
    return index


def space_of(scope: Scope, draft: Draft) -> str:
    """The point's address space; a finding if the family has none of that name."""
    space = str(draft.get("space"))
    known = FAMILIES[scope.family].spaces
    if space not in known:
        scope.report.error(
            "unknown-space",
            f"the family {scope.family} has no space `{space}`",
            draft.span("space"),
            f"known: {', '.join(known)}",
        )
    return space


def bits_of(scope: Scope, draft: Draft) -> tuple[int, int] | None:
    """The (highest, lowest) bit that the point takes of its word, or None for the whole."""
    text = draft.get("bits")
    if text is None:
        return None
    high_text, dots, low_text = str(text).partition("..")
    found = interval(f"{low_text}..{high_text}" if dots else high_text, draft.span("bits"), scope.report)
    if found is None:
        return None
    if found[1] > 15:
        scope.report.error(
            "bit-outside-word",
            f"bit {found[1]} lies outside the 16-bit word",
            draft.span("bits"),
            "bits are numbered 15..0",
        )
        return None
    return found[1], found[0]


def type_of(scope: Scope, draft: Draft, space: str, bits: tuple[int, int] | None) -> str:
    """The point's wire type: said, or what its space and bits ask for; a finding if they do not fit each other."""
    family = FAMILIES[scope.family]
    single = family.spaces.get(space) == "bit"
    width = bits[0] - bits[1] + 1 if bits else None
    default = "bit" if single or width == 1 else "u8" if width is not None and width <= 8 else "u16"
    said = str(draft.get("type", default))
    info: TypeInfo = TYPES[said]
    if bits is None and single != (said == "bit"):
        message = (
            f"`{said}` does not fit the space `{space}`, which holds {'single bits' if single else '16-bit words'}"
        )
        hint = "use `bit`" if single else "use `bits` to take one bit of a word"
        scope.report.error("type-outside-space", message, _type_span(draft), hint)
        return default
    if bits is None and not single and info.bits < 16:
        message = f"`{said}` is smaller than the words of `{space}`"
        scope.report.error(
            "type-outside-space", message, _type_span(draft), "use u16 or s16, or say which `bits` of the word it takes"
        )
        return default
    if width is not None and (width > info.bits or info.floating or info.bits > 16):
        message = f"{width} bits do not fit the type `{said}`"
        scope.report.error("bit-outside-word", message, _type_span(draft), f"use `{default}`")
        return default
    return said


def _type_span(draft: Draft) -> Span:
    return draft.span("type" if draft.layer("type") is not None else "space")
