"""The view of one point: the facts for the runtime's macro."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from fieldscribe.arithmetic.words import group_mask
from fieldscribe.targets.rust.access import read_lines, write_lines
from fieldscribe.targets.rust.documentation import point_doc
from fieldscribe.targets.rust.families import in_rust
from fieldscribe.targets.rust.families.spaces import space_variant
from fieldscribe.targets.rust.forms import form_lines
from fieldscribe.targets.rust.layout import Item, binding, filled
from fieldscribe.targets.rust.literals import integer, mask, raw_literal, type_name, type_range
from fieldscribe.targets.rust.special_codes import code_lines
from fieldscribe.targets.rust.views import PointView
from fieldscribe.text import rust_string

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Point
    from fieldscribe.targets.rust.subjects import CratePoint, CrateScope

_ALIAS = re.compile(r"[\w.:/+-]+(?: [\w.:/+-]+)*")


def point_view(subject: CratePoint, scope: CrateScope) -> PointView:
    """All that the templates need of a point."""
    point, code = subject.point, subject.point.code
    traits = tuple(in_rust(scope.family).traits(subject, scope))
    return PointView(
        doc=point_doc(point, scope.errata),
        alias=rust_string(code) if code and code != subject.name and _ALIAS.fullmatch(code) else "",
        name=subject.name,
        facts=(*_facts(subject, scope), *traits),
        names_runtime=bool(traits) or _names_runtime(subject),
        was=tuple(binding(0, Item(f"pub type {type_name(old)}"), subject.name) for old in point.was),
    )


def _facts(subject: CratePoint, scope: CrateScope) -> Iterator[str]:
    """The facts in the order of the macro."""
    point = subject.point
    names = ", ".join(rust_string(name) for name in (point.item, point.code) if name)
    yield f"{subject.name}: {subject.raw} = {names};"
    yield from _whereabouts(point)
    yield from _references(point)
    if point.unit.symbol:
        yield f"unit {rust_string(point.unit.symbol)};"
    if subject.form == "scaled" and point.decimals:
        yield f"decimals {point.decimals};"
    if point.display is not None:
        yield f"display {point.display};"
    yield from _outer_limits(subject)
    yield from form_lines(subject, scope)
    yield from code_lines(subject)
    if point.readable:
        yield from read_lines(subject)
    if point.writable:
        yield from write_lines(subject, scope)


def _names_runtime(subject: CratePoint) -> bool:
    """Whether the facts name items of the runtime: the type of a text, the check of digits, or rules."""
    point = subject.point
    checked = point.digits is not None or bool(subject.limits)
    return point.text is not None or bool(subject.factors) or (point.writable and checked)


def _whereabouts(point: Point) -> Iterator[str]:
    """The facts about addresses, index, telegram and constant bits."""
    addresses = point.addresses
    yield f"at {space_variant(point.space)} 0x{min(addresses):04X};"
    if len(addresses) > 1:
        yield from filled("addresses [", ", ", [f"0x{address:04X}" for address in addresses], "];")
    if point.words != 1:
        yield f"words {point.words};"
    if point.write_place is not None:
        yield f"write_at 0x{min(point.write_place.addresses):04X};"
    if point.index is not None:
        yield f"index {point.index};"
    if point.telegram is not None:
        yield f"telegram {rust_string(point.telegram)};"
    if point.bits is not None:
        yield f"bits {point.bits[1]} {mask(group_mask(point), 'u16')} {'signed_' if point.info.signed else ''}group;"
    if point.fixed is not None:
        width = "u16" if point.words == 1 else "u32"
        yield f"fixed {mask(point.fixed.mask, width)} {mask(point.fixed.bits, width)};"


def _outer_limits(subject: CratePoint) -> Iterator[str]:
    """The fact about the outer limits, unless they are those of the type."""
    ends, raw = subject.point.outer, subject.raw
    if subject.form not in ("float", "text", "digits") and ends != type_range(raw):
        yield f"raw {raw_literal(ends[0], raw)}..={raw_literal(ends[1], raw)};"


def _references(point: Point) -> Iterator[str]:
    """The manual's other numberings of the point."""
    for key, number in point.references.items():
        if isinstance(number, str):
            type_, literal = "&'static str", rust_string(number)
        else:
            type_, literal = "u32" if 0 <= number < 1 << 32 else "i64", integer(number)
        yield f"const {key.upper()}: {type_} = {literal};"
