"""What tells a point from others of its kin, as finished words of Rust."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, NamedTuple

from fieldscribe.patterns import blanks
from fieldscribe.targets.rust.documentation import is_long, sentence
from fieldscribe.targets.rust.layout import filled
from fieldscribe.targets.rust.literals import integer, raw_literal, type_name, type_range
from fieldscribe.text import rust_code, rust_string
from fieldscribe.wording import address_text, raw_range_text

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fieldscribe.model import Allowed, Point
    from fieldscribe.targets.rust.subjects import CratePoint, CrateShape

_UNLIMITED = ("float", "text", "digits")
"""The forms of points whose limits are no raw numbers."""

_ALIAS = re.compile(r"[\w.:/+-]+(?: [\w.:/+-]+)*")

Layout = tuple[object, ...]
"""The widths of words in whose lines there are others, and the words themselves where a line may be broken inside."""


class Words(NamedTuple):
    """What tells a point from others of its kin, finished for code and for its doc comment; what is not is empty.

    The address in the doc comment is in two parts, between which a line may be broken. `span` is the range there, `low`
    and `high` are its ends in code. `addresses` and `references` are facts of several lines.
    """

    item: str
    sentence: str
    name: str
    enum: str
    code: str
    code_shown: str
    address: str
    hexadecimal: str
    decimal: str
    index: str
    span: str
    low: str
    high: str
    addresses: str
    references: str


class Limits(NamedTuple):
    """The words of limits, and what else decides about the text of a point that has them."""

    form: int | None
    span: str
    low: str
    high: str


class KnownLimits:
    """What limits say, worked out once for all points that share them."""

    def __init__(self) -> None:
        self._known: dict[tuple[int, CrateShape], Limits] = {}

    def of(self, subject: CratePoint) -> Limits:
        """The words of a point's limits."""
        key = (id(subject.point.allowed), subject.shape)
        limits = self._known.get(key)
        if limits is None:
            limits = self._known[key] = _limits(subject.point, subject.shape)
        return limits


def words_of(subject: CratePoint, limits: Limits) -> tuple[Words, Layout]:
    """The words of a point, and what decides where lines are broken."""
    point, item, name, shape, *_ = subject
    addresses, code, title = point.place.addresses, point.code or "", sentence(item)
    address = addresses[0] if len(addresses) == 1 else min(addresses)
    hexadecimal, decimal = address_text(address).split(" ")
    index = "" if point.index is None else str(point.index)
    shown = rust_code(code)
    _, span, low, high = limits
    words = Words(
        item,
        title,
        name,
        "" if shape.enum is None else type_name(shape.enum.name),
        code and rust_string(code),
        code and shown,
        f"0x{address:04X}",
        hexadecimal,
        decimal,
        index,
        span,
        low,
        high,
        "" if len(addresses) == 1 else _addresses(addresses),
        _references(point.place.references),
    )
    layout = (
        title if is_long(title) else None,
        shown if " " in shown else len(code),
        is_alias(code, name),
        span if " " in span else len(span),
        len(hexadecimal),
        len(decimal),
        len(index),
        len(name) if point.was or subject.arguments else None,
        low == "",
        len(addresses),
    )
    return words, layout


def blanked(words: Words) -> Words:
    """Blanks for the words, but for names that would clash, and for those within which a line may be broken."""
    kept = {"sentence": words.sentence} if is_long(words.sentence) else {}
    kept |= {"name": words.name} if words.name.endswith("_") else {}
    kept |= {key: word for key in ("code_shown", "span") if " " in (word := getattr(words, key))}
    return Words(*blanks(words))._replace(**kept)


def is_alias(code: str, name: str) -> bool:
    """Whether people may search for the manual's code, which is not the name of the type."""
    return code != name and _ALIAS.fullmatch(code) is not None


def _limits(point: Point, shape: CrateShape) -> Limits:
    """Limits that are more than one range of numbers are not told by their ends."""
    allowed, ends, raw = point.allowed, point.outer, shape.raw
    span = raw_range_text(point)
    told = shape.form in _UNLIMITED or ends == type_range(raw)
    low, high = ("", "") if told else (raw_literal(ends[0], raw), raw_literal(ends[1], raw))
    return Limits(_form(allowed), span and rust_code(span), low, high)


def _form(allowed: Allowed) -> int | None:
    single = len(allowed.intervals) == len(allowed.fixed) <= 1 and not allowed.units
    return None if single else id(allowed)


def _addresses(addresses: tuple[int, ...]) -> str:
    return "\n    ".join(filled("addresses [", ", ", [f"0x{address:04X}" for address in addresses], "];"))


def _references(references: Mapping[str, int | str]) -> str:
    """The manual's other numberings of the point."""
    return "\n    ".join([_reference(key.upper(), number) for key, number in references.items()])


def _reference(name: str, number: int | str) -> str:
    if isinstance(number, str):
        return f"const {name}: &'static str = {rust_string(number)};"
    return f"const {name}: {'u32' if 0 <= number < 1 << 32 else 'i64'} = {integer(number)};"
