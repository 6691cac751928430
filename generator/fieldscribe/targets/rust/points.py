"""The text of each point, as facts for the runtime's macro: laid out once for all points that are alike."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.arithmetic.words import group_mask
from fieldscribe.patterns import Pattern
from fieldscribe.targets.rust.access import read_lines, write_lines
from fieldscribe.targets.rust.documentation import facts_text, is_long, point_doc
from fieldscribe.targets.rust.families import in_rust
from fieldscribe.targets.rust.families.spaces import space_variant
from fieldscribe.targets.rust.forms import form_lines
from fieldscribe.targets.rust.identity import (
    KnownLimits,
    blanked,
    broken,
    is_alias,
    layout_of,
    width_of,
    widths_of,
    words_of,
)
from fieldscribe.targets.rust.literals import mask
from fieldscribe.targets.rust.special_codes import code_lines
from fieldscribe.targets.rust.views import PointView
from fieldscribe.targets.rust.words import old_names_text
from fieldscribe.text import rust_string

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Point
    from fieldscribe.render import Render
    from fieldscribe.targets.rust.identity import Words
    from fieldscribe.targets.rust.subjects import CratePoint, CrateScope


_STEP = 8
"""Doc comments are laid out as if they were as wide as the widest of so many: if they fit then, all fit."""


def point_texts(scope: CrateScope, render: Render) -> tuple[str, bool]:
    """The texts of all points, and whether one of them names items of the runtime."""
    known_limits, layouts, texts = KnownLimits(), _Layouts(scope, render), []
    traits = in_rust(scope.family).traits
    for subject in scope.subjects:
        limits = known_limits.of(subject)
        words, own = words_of(subject, limits), tuple(traits(subject, scope))
        kind = (subject.kin, limits.form, own, layout_of(subject, words))
        texts.append(layouts.pattern(subject, words, kind, own).filled(words))
    return "".join(texts), layouts.names_runtime


class _Layouts:
    """The texts of points, laid out once for all that are of one kind and have words of one width.

    If the facts of the doc comment fit in one line, the width of all words together is enough, and rounded up.
    """

    def __init__(self, scope: CrateScope, render: Render) -> None:
        self._scope, self._render = scope, render
        self._patterns: dict[object, Pattern | None] = {}
        self.names_runtime = False

    def pattern(self, subject: CratePoint, words: Words, kind: object, traits: tuple[str, ...]) -> Pattern:
        """The text with blanks for the words."""
        steps, rest = divmod(width_of(words), _STEP)
        key: object = (kind, steps)
        if key not in self._patterns:
            self.names_runtime |= bool(traits) or _names_runtime(subject)
            wide = blanked(words, wider=_STEP - 1 - rest)
            facts = facts_text(subject.point, wide)
            self._patterns[key] = None if is_long(facts) else self._laid_out(subject, wide, facts, traits)
        return self._patterns[key] or self._exact(subject, words, kind, traits)

    def _exact(self, subject: CratePoint, words: Words, kind: object, traits: tuple[str, ...]) -> Pattern:
        key = (kind, widths_of(words))
        pattern = self._patterns.get(key)
        if pattern is None:
            shown = blanked(words, kept=broken(words))
            pattern = self._laid_out(subject, shown, facts_text(subject.point, shown), traits)
            self._patterns[key] = pattern
        return pattern

    def _laid_out(self, subject: CratePoint, words: Words, facts: str, traits: tuple[str, ...]) -> Pattern:
        """The text with these words; `facts` are those of the doc comment."""
        point = subject.point
        view = PointView(
            doc=point_doc(point, words.sentence, facts, self._scope.errata),
            alias=words.code if is_alias(point.code or "", subject.name) else "",
            name=words.name,
            facts=(*_facts(subject._replace(name=words.name), words, self._scope), *traits),
        )
        old_names = old_names_text(words.name, point.old_items, self._render)
        return Pattern(self._render("rust/point.rs.j2", {"point": view}) + old_names)


def _facts(subject: CratePoint, words: Words, scope: CrateScope) -> Iterator[str]:
    """The facts in the order of the macro."""
    point = subject.point
    yield f'{words.name}: {subject.raw} = "{words.item}"{words.code and ", "}{words.code};'
    yield from _whereabouts(point, words)
    if words.references:
        yield words.references
    if point.unit.symbol:
        yield f"unit {rust_string(point.unit.symbol)};"
    if subject.form == "scaled" and point.decimals:
        yield f"decimals {point.decimals};"
    if point.display is not None:
        yield f"display {point.display};"
    if words.low:
        yield f"raw {words.low}..={words.high};"
    yield from form_lines(subject, words, scope)
    yield from code_lines(subject)
    if point.readable:
        yield from read_lines(subject)
    if point.writable:
        yield from write_lines(subject, scope)


def _names_runtime(subject: CratePoint) -> bool:
    """Whether the facts name items of the runtime: the type of a text, the check of digits, or rules."""
    point = subject.point
    checked = point.digits is not None or bool(point.limit_arguments)
    return point.text is not None or bool(subject.factors) or (point.writable and checked)


def _whereabouts(point: Point, words: Words) -> Iterator[str]:
    """The facts about addresses, index, telegram and constant bits."""
    yield f"at {space_variant(point.space)} {words.address};"
    if words.addresses:
        yield words.addresses
    if point.words != 1:
        yield f"words {point.words};"
    if point.write_place is not None:
        yield f"write_at 0x{min(point.write_place.addresses):04X};"
    if words.element:
        yield f"index {words.element};"
    if point.telegram is not None:
        yield f"telegram {rust_string(point.telegram)};"
    if point.bits is not None:
        yield f"bits {point.bits[1]} {mask(group_mask(point), 'u16')} {'signed_' if point.info.signed else ''}group;"
    if point.fixed is not None:
        width = "u16" if point.words == 1 else "u32"
        yield f"fixed {mask(point.fixed.mask, width)} {mask(point.fixed.bits, width)};"
