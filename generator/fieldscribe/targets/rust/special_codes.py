"""Special codes as Rust constants: those of each point, and those that many share, once."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.targets.rust.documentation import sentence
from fieldscribe.targets.rust.layout import Item, Lines, binding, calls
from fieldscribe.targets.rust.literals import mask, raw_literal, type_name
from fieldscribe.targets.rust.views import ConstantView
from fieldscribe.text import rust_string

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Special
    from fieldscribe.targets.rust.subjects import CratePoint, CrateScope

_WIDTH = 100


@dataclass(frozen=True, slots=True)
class SharedView:
    """Codes that several points share: a type with a constant for each code and a table of all."""

    name: str
    of: str
    constants: tuple[ConstantView, ...]
    table: tuple[str, ...]


def shared_views(scope: CrateScope) -> Iterator[SharedView]:
    """The shared codes, in the order of their first point."""
    first: dict[str, CratePoint] = {}
    for subject in scope.subjects:
        if subject.point.shared_codes:
            first.setdefault(subject.point.shared_codes, subject)
    for of, subject in first.items():
        item = Item("pub const CODES", f"&'static [runtime::Code<{subject.raw}>]")
        yield SharedView(type_name(of), of, tuple(code_constants(subject)), _table(subject, item))


def code_lines(subject: CratePoint) -> Iterator[str]:
    """The fact about the codes of a point, its own or shared ones."""
    shared = subject.point.shared_codes
    if shared:
        yield f"codes (special::{type_name(shared)}::CODES);"
    elif subject.point.specials:
        yield "codes {"
        for special in subject.point.specials:
            name, band = special.name.upper(), special.low != special.high
            ends = "..=".join(
                _literal(end, special, subject.raw) for end in ((special.low, special.high) if band else (special.low,))
            )
            last = f" {name}_LAST" if band else ""
            yield f"    /// {sentence(f'{special.name}, the first of a band' if band else special.name)}"
            yield f"    {name}{last} = {_kind(special)}({rust_string(special.name)}, {ends});"
        yield "};"


def _kind(special: Special) -> str:
    """The runtime's constructor for the kind of code."""
    words = (word for word, holds in (("writable", special.writable), ("no_value", special.no_value)) if holds)
    return "_".join(words) or "new"


def code_constants(subject: CratePoint) -> Iterator[ConstantView]:
    """A constant for each code; of a band, its first code and the last raw number."""
    for special in subject.point.specials:
        item = Item(f"pub const {special.name.upper()}", f"runtime::Special<{subject.raw}>")
        call = f"{_kind(special)}({rust_string(special.name)}, {_literal(special.low, special, subject.raw)})"
        lines = _constant(item, f"runtime::Special::{call}")
        if special.low != special.high:
            last_item = Item(f"pub const {special.name.upper()}_LAST", subject.raw)
            last = binding(4, last_item, _literal(special.high, special, subject.raw))
            yield ConstantView(sentence(f"{special.name}, the first of a band"), lines)
            yield ConstantView(sentence(f"the last raw number of {special.name}"), last)
        else:
            yield ConstantView(sentence(special.name), lines)


def _table(subject: CratePoint, item: Item) -> Lines:
    items: list[tuple[str, Lines]] = []
    for special in subject.point.specials:
        name = f"Self::{special.name.upper()}"
        band = ("runtime::Code::band", (name, f"{name}_LAST"))
        items.append(("runtime::Code::one", (name,)) if special.low == special.high else band)
    return calls(4, item, items)


def _constant(item: Item, call: str) -> Lines:
    """The lines of a constant as rustfmt breaks them; with `rustfmt::skip` if the name itself is too long."""
    lines = binding(4, item, call)
    if all(4 + len(line) <= _WIDTH for line in (*lines, f"{item} =")):
        return lines
    return "#[rustfmt::skip] // its name is longer than a line", f"{item} = {call};"


def _literal(raw: int, special: Special, rust_type: str) -> str:
    return mask(raw, rust_type) if special.hexadecimal and raw >= 0 else raw_literal(raw, rust_type)
