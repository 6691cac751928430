"""The text of each point, as facts for the runtime's macro: laid out once for all points with the same template."""

import re
from collections.abc import Iterator, Mapping
from typing import NamedTuple

from fieldscribe.arithmetic.texts import epoch_in_unix
from fieldscribe.arithmetic.words import group_mask
from fieldscribe.model import Point
from fieldscribe.resources import Render
from fieldscribe.targets.placeholders import TextTemplates
from fieldscribe.targets.rust.enums import old_names_text
from fieldscribe.targets.rust.layout import PointDoc, filled
from fieldscribe.targets.rust.literals import integer, mask, raw_literal, type_name, type_range
from fieldscribe.targets.rust.point_facts import code_lines, read_lines, write_lines
from fieldscribe.targets.rust.scope import CratePoint, CrateScope, in_rust, space_variant
from fieldscribe.targets.rust.value_forms import form_lines
from fieldscribe.text import rust_code, rust_string
from fieldscribe.wording import raw_range_text

_UNLIMITED = ("float", "text", "digits")
"""The forms of points whose limits are not raw numbers."""

_WIDTH = 116
"""Of the first line of a point, which is indented by 4."""
_ALIAS = re.compile(r"[\w.:/+-]+(?: [\w.:/+-]+)*")


class MacroFields(NamedTuple):
    """The words of one point, or placeholders for them; an absent fact is empty.

    `doc` is the whole doc comment. `alias` is the manual's code if people may search for it. `low` and `high` bound the
    raw numbers. `addresses` and `references` are facts of several lines. Only the first line breaks by their width.
    """

    doc: str
    item: str
    name: str
    enum: str
    code: str
    alias: str
    address: str
    low: str
    high: str
    addresses: str
    references: str


def point_texts(scope: CrateScope, render: Render) -> tuple[str, bool]:
    """Return the texts of all points, and whether one of them names items of the runtime."""
    templates = _PointTemplates(scope, render)
    texts = [templates.text(subject) for subject in scope.subjects]
    return "".join(texts), templates.names_runtime


class _PointTemplates:
    """Lays out the text of points once for each template."""

    def __init__(self, scope: CrateScope, render: Render) -> None:
        self._scope, self._render = scope, render
        self._traits = in_rust(scope.family).traits
        self._templates = TextTemplates()
        self._limits: dict[tuple[int, int], tuple[str, str, str]] = {}
        self._docs: dict[int, PointDoc] = {}
        self.names_runtime = False

    def text(self, subject: CratePoint) -> str:
        """Return the text of a point."""
        fields, traits = self._fields(subject), tuple(self._traits(subject, self._scope))
        whole = subject.key, traits, fields.alias == "", fields.low == "", _is_long(subject, fields, self._scope)
        return self._templates.fill(
            whole, fields, lambda fields: self._laid_out(subject, MacroFields._make(fields), traits, whole[-1])
        )

    def _fields(self, subject: CratePoint) -> MacroFields:
        point, item, name, _, _, key = subject
        enum = subject.enum
        doc = self._docs.get(key) or self._docs.setdefault(key, PointDoc(point, self._scope.lowered))
        limited = key, id(point.allowed)
        span, low, high = self._limits.get(limited) or self._limits.setdefault(limited, _limits_of(subject))
        addresses, code = point.place.addresses, point.code or ""
        address = addresses[0] if len(addresses) == 1 else min(addresses)
        literal = code and rust_string(code)
        return MacroFields(
            doc.of(item, code and rust_code(code), address, span),
            item,
            name,
            "" if enum is None else type_name(enum.name),
            literal,
            literal if code != name and _ALIAS.fullmatch(code) else "",
            f"0x{address:04X}",
            low,
            high,
            "" if len(addresses) == 1 else _addresses(addresses),
            _references(point.place.references),
        )

    def _laid_out(self, subject: CratePoint, fields: MacroFields, traits: tuple[str, ...], is_long: bool) -> str:
        self.names_runtime |= bool(traits) or _names_runtime(subject)
        named = subject.renamed(fields.item, fields.name)
        facts = (*_head(named, fields, self._scope, is_long), *_facts(named, fields, self._scope), *traits)
        text = self._render("rust/point.rs.j2", {"doc": fields.doc, "alias": fields.alias, "facts": facts})
        return text + old_names_text(fields.name, subject.point.old_items, self._render)


def _head(subject: CratePoint, fields: MacroFields, scope: CrateScope, is_long: bool) -> tuple[str, ...]:
    """Return the names and types of the point; the names in texts on a line of their own if they are long."""
    type_ = f"{fields.name} of crate::{scope.device_type}: {subject.raw}"
    named = f'= "{fields.item}"{fields.code and ", "}{fields.code};'
    return (type_, f"    {named}") if is_long else (f"{type_} {named}",)


def _is_long(subject: CratePoint, fields: MacroFields, scope: CrateScope) -> bool:
    return len(_head(subject, fields, scope, False)[0]) > _WIDTH


def _facts(subject: CratePoint, fields: MacroFields, scope: CrateScope) -> Iterator[str]:
    """Yield the further facts in the order of the macro."""
    point = subject.point
    yield from _whereabouts(point, fields, scope)
    if fields.references:
        yield fields.references
    if point.unit.symbol:
        yield f"unit {rust_string(point.unit.symbol)};"
    if point.form == "scaled" and point.decimals:
        yield f"decimals {point.decimals};"
    if point.display is not None:
        yield f"display {point.display};"
    if point.epoch:
        yield f"epoch {integer(epoch_in_unix(point.epoch))};"
    if fields.low:
        yield f"raw {fields.low}..={fields.high};"
    yield from form_lines(subject, fields.enum, scope)
    yield from code_lines(subject)
    if point.readable:
        yield from read_lines(subject)
    if point.writable:
        yield from write_lines(subject, scope)


def _names_runtime(subject: CratePoint) -> bool:
    """Return True if the facts name items of the runtime: the type of a text, the check of digits, or rules."""
    point = subject.point
    checked = point.digits is not None or bool(point.limit_arguments)
    return point.text is not None or bool(point.scale_arguments) or (point.writable and checked)


def _requests(point: Point, scope: CrateScope) -> Iterator[str]:
    """Yield the facts about what goes out before the request of a point, and with it."""
    held = [f"{type_name(other.item)} {integer(raw)}" for other, raw in scope.lowered.device.selections(point)]
    partners = [*map(rust_string, point.write_with)]
    for fact, items, end in (("selects ", held, ";"), ("written_with [", partners, "];")):
        if items:
            yield "\n    ".join(filled(fact, ", ", items, end))


def _whereabouts(point: Point, fields: MacroFields, scope: CrateScope) -> Iterator[str]:
    """Yield the facts about addresses, what goes before and with them, index, telegram and constant bits."""
    counted = f" from {rust_string(point.base)}" if point.base else ""
    yield f"at {space_variant(point.space)} {fields.address}{counted};"
    yield from _requests(point, scope)
    if fields.addresses:
        yield fields.addresses
    if point.words != 1:
        yield f"words {point.words};"
    if point.shape.narrow:
        yield f"width {point.width};"
    yield from ["low_byte_first true;"] * point.swapped + ["coded true;"] * bool(point.coding)
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


def _limits_of(subject: CratePoint) -> tuple[str, str, str]:
    """Return the limits of a point for its doc comment, and their ends in code; several ranges have no ends."""
    point, raw = subject.point, subject.raw
    ends, span = point.outer, raw_range_text(point)
    unwritten = point.form in _UNLIMITED or ends == type_range(raw)
    low, high = ("", "") if unwritten else (raw_literal(ends[0], raw), raw_literal(ends[1], raw))
    return span and rust_code(span), low, high


def _addresses(addresses: tuple[int, ...]) -> str:
    return "\n    ".join(filled("addresses [", ", ", [f"0x{address:04X}" for address in addresses], "];"))


def _references(references: Mapping[str, int | str]) -> str:
    """Return the manual's other numberings of the point."""
    return "\n    ".join([f"const {key.upper()}: {_typed(number)};" for key, number in references.items()])


def _typed(number: int | str) -> str:
    """Return the type of a numbering and the number in it."""
    if isinstance(number, str):
        return f"&'static str = {rust_string(number)}"
    return f"{'u32' if 0 <= number < 1 << 32 else 'i64'} = {integer(number)}"
