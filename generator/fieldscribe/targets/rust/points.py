"""The text of each point, as facts for the runtime's macro: laid out once for all points that are alike."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

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
from fieldscribe.targets.rust.layout import Item, binding
from fieldscribe.targets.rust.literals import mask, type_name
from fieldscribe.targets.rust.special_codes import code_lines
from fieldscribe.targets.rust.views import PointView
from fieldscribe.text import rust_string

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Point
    from fieldscribe.render import Render
    from fieldscribe.targets.rust.identity import Words
    from fieldscribe.targets.rust.subjects import CratePoint, CrateScope


_STEP = 16
"""Doc comments are laid out as if they were as wide as the widest of so many: if they fit then, all fit."""


class _Plan(NamedTuple):
    """The text of points that are alike; `fits` says that their facts stand in one line of the doc comment."""

    pattern: Pattern
    fits: bool
    names_runtime: bool


def point_texts(scope: CrateScope, render: Render) -> tuple[str, bool]:
    """The texts of all points, and whether one of them names items of the runtime."""
    known_limits, plans, texts = KnownLimits(), dict[object, _Plan](), []
    traits = in_rust(scope.family).traits
    for subject in scope.subjects:
        limits = known_limits.of(subject)
        words, own = words_of(subject, limits), tuple(traits(subject, scope))
        kind = (subject.kin, limits.form, own, layout_of(subject, words))
        steps, rest = divmod(width_of(words), _STEP)
        plan = plans.get((kind, steps))
        if plan is None:
            shown = blanked(words, wider=_STEP - 1 - rest)
            plan = plans[kind, steps] = _laid_out(subject, shown, own, scope, render)
        if not plan.fits:
            exact = (kind, widths_of(words))
            plan = plans.get(exact)
            if plan is None:
                shown = blanked(words, kept=broken(words))
                plan = plans[exact] = _laid_out(subject, shown, own, scope, render)
        texts.append(plan.pattern.filled(words))
    return "".join(texts), any(plan.names_runtime for plan in plans.values())


def _laid_out(subject: CratePoint, words: Words, traits: tuple[str, ...], scope: CrateScope, render: Render) -> _Plan:
    """The text of a point with blanks for its words."""
    point = subject.point
    facts = facts_text(point, words)
    view = PointView(
        doc=point_doc(point, words.sentence, facts, scope.errata),
        alias=words.code if is_alias(point.code or "", subject.name) else "",
        name=words.name,
        facts=(*_facts(subject._replace(name=words.name), words, scope), *traits),
        was=tuple(binding(0, Item(f"pub type {type_name(old)}"), words.name) for old in point.was),
    )
    pattern = Pattern(render("rust/point.rs.j2", {"point": view}))
    return _Plan(pattern, not is_long(facts), bool(traits) or _names_runtime(subject))


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
