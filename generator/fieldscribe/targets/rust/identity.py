"""What tells a point from others of its kin, as finished words of Rust."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, NamedTuple

from fieldscribe.patterns import blanks
from fieldscribe.targets.rust.documentation import is_long, sentence
from fieldscribe.targets.rust.layout import filled
from fieldscribe.targets.rust.literals import integer, raw_literal, type_name, type_range
from fieldscribe.text import rust_code, rust_string
from fieldscribe.wording import address_parts, raw_range_text

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from fieldscribe.model import Allowed, Point
    from fieldscribe.targets.rust.subjects import CratePoint, CrateShape

_UNLIMITED = ("float", "text", "digits")
"""The forms of points whose limits are no raw numbers."""

_ALIAS = re.compile(r"[\w.:/+-]+(?: [\w.:/+-]+)*")

Layout = tuple[object, ...]
"""What decides where lines are broken."""


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
    element: str
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


def words_of(subject: CratePoint, limits: Limits) -> Words:
    """The words of a point."""
    point, item, name, shape, *_ = subject
    addresses, code = point.place.addresses, point.code or ""
    address = addresses[0] if len(addresses) == 1 else min(addresses)
    hexadecimal, decimal = address_parts(address)
    return Words(
        item,
        sentence(item),
        name,
        "" if shape.enum is None else type_name(shape.enum.name),
        code and rust_string(code),
        code and rust_code(code),
        f"0x{address:04X}",
        hexadecimal,
        decimal,
        "" if point.index is None else str(point.index),
        limits.span,
        limits.low,
        limits.high,
        "" if len(addresses) == 1 else _addresses(addresses),
        _references(point.place.references),
    )


def layout_of(subject: CratePoint, words: Words) -> Layout:
    """What decides about the layout beside the widths of words in the doc comment."""
    point = subject.point
    return (
        words.sentence if is_long(words.sentence) else None,
        len(words.name) if point.was or subject.arguments else None,
        words.code == "",
        is_alias(point.code or "", words.name),
        words.span == "",
        words.low == "",
    )


def widths_of(words: Words) -> Layout:
    """The widths of the words in a doc comment of several lines; words in which a line may be broken themselves."""
    alone = [word if " " in word else len(word) for word in (words.code_shown, words.span)]
    return (*alone, len(words.hexadecimal), len(words.decimal), len(words.element))


def blanked(words: Words, *, kept: Iterable[str] = (), wider: int = 0) -> Words:
    """Blanks for the words, but for those `kept`, for names that would clash and for titles of several lines.

    The doc comment becomes `wider` than it would with the words.
    """
    names = [*kept]
    if words.name.endswith("_"):
        names.append("name")
    if is_long(words.sentence):
        names.append("sentence")
    shown = Words(*blanks(words))
    return shown._replace(
        decimal=shown.decimal + shown.decimal[:1] * wider, **{name: getattr(words, name) for name in names}
    )


def broken(words: Words) -> tuple[str, ...]:
    """The words of the doc comment within which a line may be broken."""
    return tuple(name for name in ("code_shown", "span") if " " in getattr(words, name))


def width_of(words: Words) -> int:
    """The width of all words that share a paragraph of the doc comment."""
    return len(words.code_shown) + len(words.hexadecimal) + len(words.decimal) + len(words.element) + len(words.span)


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
    return "\n    ".join([f"const {key.upper()}: {_typed(number)};" for key, number in references.items()])


def _typed(number: int | str) -> str:
    """The type of a numbering and the number in it."""
    if isinstance(number, str):
        return f"&'static str = {rust_string(number)}"
    return f"{'u32' if 0 <= number < 1 << 32 else 'i64'} = {integer(number)}"
