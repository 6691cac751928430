"""What tells a point from others of its shape, as finished words of Rust."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from fieldscribe.targets.rust.documentation import sentence
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


class Words(NamedTuple):
    """What tells a point from others of its shape, finished for code and for its doc comment; what is not is empty.

    The address in the doc comment is in two parts, between which a line may be broken. `span` is the range there, `low`
    and `high` are its ends in code. `addresses` and `references` are facts of several lines.
    """

    item: str
    sentence: str
    name: str
    enum: str
    code: str
    shown_code: str
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


class Identities:
    """The words of a device's points. What limits say is worked out once for all points that share them."""

    def __init__(self) -> None:
        self._limits: dict[tuple[int, CrateShape], Limits] = {}

    def limits(self, subject: CratePoint) -> Limits:
        """The words of a point's limits; equal limits are one object."""
        point, shape = subject.point, subject.shape
        key = (id(point.allowed), shape)
        limits = self._limits.get(key)
        if limits is None:
            limits = self._limits[key] = _limits(point, shape)
        return limits


def words_of(subject: CratePoint, limits: Limits) -> Words:
    """The words of a point."""
    point, item, name, shape = subject
    code, addresses = point.code or "", point.addresses
    address = addresses[0] if len(addresses) == 1 else min(addresses)
    hexadecimal, decimal = address_text(address).split(" ")
    return Words(
        f'"{item}"',
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
        _references(point.references) if point.references else "",
    )


def _limits(point: Point, shape: CrateShape) -> Limits:
    """Limits that are more than one range of numbers are not told by their ends."""
    allowed, ends, raw = point.allowed, point.outer, shape.raw
    span = raw_range_text(point)
    told = shape.form in _UNLIMITED or ends == type_range(raw)
    low, high = ("", "") if told else (raw_literal(ends[0], raw), raw_literal(ends[1], raw))
    return Limits(_form(shape, allowed), span and rust_code(span), low, high)


def _form(shape: CrateShape, allowed: Allowed) -> int | None:
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
