"""The text of each point, as facts for the runtime's macro: laid out once for all points that are alike."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.arithmetic.words import group_mask
from fieldscribe.patterns import Pattern
from fieldscribe.targets.rust.access import read_lines, write_lines
from fieldscribe.targets.rust.documentation import point_doc
from fieldscribe.targets.rust.families import in_rust
from fieldscribe.targets.rust.families.spaces import space_variant
from fieldscribe.targets.rust.forms import form_lines
from fieldscribe.targets.rust.identity import KnownLimits, blanked, is_alias, words_of
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


def point_texts(scope: CrateScope, render: Render) -> tuple[str, bool]:
    """The texts of all points, and whether one of them names items of the runtime."""
    known_limits, patterns = KnownLimits(), dict[object, Pattern]()
    traits, texts, names_runtime = in_rust(scope.family).traits, [], False
    for subject in scope.subjects:
        limits = known_limits.of(subject)
        words, layout = words_of(subject, limits)
        own = tuple(traits(subject, scope))
        key = (subject.kin, limits.form, layout, own)
        pattern = patterns.get(key)
        if pattern is None:
            view = _view(subject, words, own, scope)
            names_runtime |= view.names_runtime
            pattern = patterns[key] = Pattern(render("rust/point.rs.j2", {"point": view}))
        texts.append(pattern.filled(words))
    return "".join(texts), names_runtime


def _view(subject: CratePoint, words: Words, traits: tuple[str, ...], scope: CrateScope) -> PointView:
    """All that the template needs of a point, with blanks for its words."""
    point, shown = subject.point, blanked(words)
    return PointView(
        doc=point_doc(point, shown, scope.errata),
        alias=shown.code if is_alias(point.code or "", subject.name) else "",
        name=shown.name,
        facts=(*_facts(subject._replace(name=shown.name), shown, scope), *traits),
        names_runtime=bool(traits) or _names_runtime(subject),
        was=tuple(binding(0, Item(f"pub type {type_name(old)}"), shown.name) for old in point.was),
    )


def _facts(subject: CratePoint, words: Words, scope: CrateScope) -> Iterator[str]:
    """The facts in the order of the macro."""
    point = subject.point
    yield f"{words.name}: {subject.raw} = \"{words.item}\"{words.code and ', '}{words.code};"
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
    if words.index:
        yield f"index {words.index};"
    if point.telegram is not None:
        yield f"telegram {rust_string(point.telegram)};"
    if point.bits is not None:
        yield f"bits {point.bits[1]} {mask(group_mask(point), 'u16')} {'signed_' if point.info.signed else ''}group;"
    if point.fixed is not None:
        width = "u16" if point.words == 1 else "u32"
        yield f"fixed {mask(point.fixed.mask, width)} {mask(point.fixed.bits, width)};"
