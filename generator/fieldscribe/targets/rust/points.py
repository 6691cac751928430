"""The view of one point."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from fieldscribe.targets.rust.documentation import point_doc, sentence
from fieldscribe.targets.rust.families import family_traits, space
from fieldscribe.targets.rust.layout import binding, short_array
from fieldscribe.targets.rust.literals import integer, mask, raw_literal, type_name, type_range
from fieldscribe.targets.rust.reading import read_view
from fieldscribe.targets.rust.rules import encoded_bounds, run_time_rules
from fieldscribe.targets.rust.special_codes import code_constants, coded_trait
from fieldscribe.targets.rust.views import BitsView, ConstantView, OrderView, PointView
from fieldscribe.targets.rust.writing import write_view
from fieldscribe.text import rust_string

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Point
    from fieldscribe.targets.rust.subjects import Scope, Subject

_ALIAS = re.compile(r"[\w.:/+-]+(?: [\w.:/+-]+)*")
_LETTERS = ("a", "b", "c", "d")


def point_view(subject: Subject, scope: Scope) -> PointView:
    """All that the templates need of a point."""
    point = subject.point
    low, high = point.outer
    reach = encoded_bounds(point, low, high)
    rules = run_time_rules(point, scope.points) if subject.form == "scaled" and subject.rule is None else ()
    code, coded = point.code, bool(point.specials)
    return PointView(
        doc=point_doc(point),
        alias=rust_string(code) if code and code != subject.name and _ALIAS.fullmatch(code) else "",
        name=subject.name,
        raw=subject.raw,
        value=f"runtime::Reading<{_value_type(subject)}, {subject.raw}>" if coded else _value_type(subject),
        constants=_constants(subject, low, high),
        order=None if point.text is not None else _order(point),
        scattered=point.text is not None and list(point.addresses) != sorted(point.addresses),
        bits=_bits(point),
        traits=(*([coded_trait(subject)] if coded else ()), *_digits(subject), *family_traits(subject, scope)),
        rules=rules,
        factors=subject.factors_type,
        last_rule_holds=bool(rules) and not rules[-1].held,
        read=read_view(subject, low, high) if "r" in point.access else None,
        write=write_view(subject, *reach, scope) if "w" in point.access else None,
        own_constants=(*_references(point), *(code_constants(subject) if coded and not point.shared_codes else ())),
        was=tuple(binding(0, f"pub type {type_name(old)}", subject.name) for old in point.was),
        coded=coded,
    )


def _value_type(subject: Subject) -> str:
    if subject.form in ("scaled", "float"):
        return "f64"
    if subject.point.text is not None:
        return f"runtime::Text<{subject.point.text.characters}>"
    if subject.enum is not None and subject.point.digits is not None:
        return f"[enums::{type_name(subject.enum.name)}; {subject.point.digits.count}]"
    if subject.enum is not None:
        return f"enums::{type_name(subject.enum.name)}"
    return f"flags::{subject.name}" if subject.form == "flags" else subject.raw


def _constants(subject: Subject, low: int, high: int) -> tuple[str, ...]:
    point = subject.point
    lines = [f"const NAME: &'static str = {rust_string(point.item)};"]
    if point.code:
        lines.append(f"const CODE: Option<&'static str> = Some({rust_string(point.code)});")
    lines.append(f"const SPACE: runtime::Space = {space(point.places[0].space)};")
    lines += _whereabouts(point)
    if point.words != 1:
        lines.append(f"const WORDS: u16 = {point.words};")
    if subject.form == "float":
        lines.append("const FLOATING: bool = true;")
    if subject.form == "scaled" and point.decimals:
        lines.append(f"const DECIMALS: u32 = {point.decimals};")
    if point.unit.symbol:
        lines.append(f"const UNIT: &'static str = {rust_string(point.unit.symbol)};")
    return (*lines, *_outer_limits(subject, low, high))


def _whereabouts(point: Point) -> Iterator[str]:
    """Addresses and what stands beside them, and the bits that are always a constant."""
    addresses = point.places[0].addresses
    yield f"const ADDRESS: u16 = 0x{min(addresses):04X};"
    if len(addresses) > 1:
        items = [f"0x{address:04X}" for address in addresses]
        yield from short_array(4, "const ADDRESSES: &'static [u16]", items)
    if point.index is not None:
        yield f"const INDEX: Option<u8> = Some({point.index});"
    if point.telegram is not None:
        yield from binding(4, "const TELEGRAM: Option<&'static str>", f"Some({rust_string(point.telegram)})")
    if point.fixed is not None:
        width = "u16" if point.words == 1 else "u32"
        yield f"const FIXED_MASK: u32 = {mask(point.fixed.mask, width)};"
        yield f"const FIXED_BITS: u32 = {mask(point.fixed.bits, width)};"


def _outer_limits(subject: Subject, low: int, high: int) -> Iterator[str]:
    """The ends of what may be written, where they are not the type's."""
    if subject.form in ("float", "text", "digits"):
        return
    raw = subject.raw
    least, greatest = type_range(raw)
    if low != least:
        yield f"const RAW_MIN: {raw} = {raw_literal(low, raw)};"
    if high != greatest:
        yield f"const RAW_MAX: {raw} = {raw_literal(high, raw)};"


def _order(point: Point) -> OrderView | None:
    """How reading order and address order map; None where the high part comes first."""
    addresses = point.places[0].addresses
    if len(addresses) == 1 or list(addresses) == sorted(addresses):
        return None
    letters = _LETTERS[: len(addresses)]
    by_address = [letters[place] for place in sorted(range(len(addresses)), key=addresses.__getitem__)]
    return OrderView(len(addresses), ", ".join(letters), ", ".join(by_address))


def _bits(point: Point) -> BitsView | None:
    if point.bits is None:
        return None
    high, low = point.bits
    bits = mask(((1 << (high - low + 1)) - 1) << low, "u16")
    signed = "signed_" if point.info.signed else ""
    return BitsView(low, bits, f"runtime::{signed}group::<Self>(word)")


def _digits(subject: Subject) -> Iterator[tuple[str, ...]]:
    """What tells the numbers that each digit may be."""
    if subject.form == "digits" and subject.enum is not None:
        numbers = sorted({entry.raw for entry in subject.enum.entries if 0 <= entry.raw <= 0xFFFF})
        array = short_array(4, "const NUMBERS: &'static [u16]", list(map(integer, numbers)))
        yield f"impl runtime::Digits for {subject.name} {{", *(f"    {line}" for line in array), "}"


def _references(point: Point) -> Iterator[ConstantView]:
    """The manual's other numberings of the point."""
    for key, number in point.references.items():
        if isinstance(number, str):
            type_, literal = "&'static str", rust_string(number)
        else:
            type_, literal = "u32" if 0 <= number < 1 << 32 else "i64", integer(number)
        doc = sentence(f"the number in the numbering {key}")
        yield ConstantView(doc, binding(4, f"pub const {key.upper()}: {type_}", literal))
