"""The functions between a raw number and the words on the wire."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.arithmetic.words import group_mask
from fieldscribe.targets.c.layout import function
from fieldscribe.targets.c.literals import hexadecimal, raw_type
from fieldscribe.targets.c.views import Function

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Point
    from fieldscribe.targets.c.scope import HeaderScope


def has_words(point: Point) -> bool:
    """Whether the point has word functions: not a text, not a bit group, not a point whose word is the raw number."""
    info = point.info
    plain = info.bits == 1 or (info.bits <= 16 and not info.signed)
    return point.text is None and point.bits is None and not plain


def words_functions(point: Point, name: str) -> Iterator[Function]:
    """The functions between a raw number and its own words."""
    kind, info = raw_type(point), point.info
    if point.words == 1:
        mask, sign = ("words[0]", "0x8000U") if info.bits == 16 else ("words[0] & 0xFFU", "0x80U")
        split = "words[0] = (uint16_t)raw;"
        joined = f"({kind})fieldscribe_signed({mask}, {sign})"
    else:
        places = _high_first(point)
        into = ", ".join(f"&words[{place}]" for place in places)
        split = f"fieldscribe_split{info.bits}((uint{info.bits}_t)raw, {into});"
        joined = f"fieldscribe_join{info.bits}({', '.join(f'words[{place}]' for place in places)})"
        joined = f"fieldscribe_signed{info.bits}({joined})" if info.signed else joined
    words = f"uint16_t words[{point.words}]"
    yield Function(function("static inline void", f"{name}_to_words", (f"{kind} raw", words), split))
    yield Function(function(f"static inline {kind}", f"{name}_from_words", (f"const {words}",), f"return {joined};"))


def _high_first(point: Point) -> list[int]:
    """The places of the words among the addresses, that of the high word first."""
    order = sorted(point.addresses)
    whole = len(order) == point.words  # one address of a parameter may hold several words, the high one first
    return [order.index(address) for address in point.addresses] if whole else list(range(point.words))


def bits_functions(point: Point, name: str) -> Iterator[Function]:
    """The functions between a raw number and the word that it shares."""
    assert point.bits is not None
    kind, low = raw_type(point), point.bits[1]
    place = f"{hexadecimal(group_mask(point))}, {low}U"
    extract = f"fieldscribe_extract(word, {place})"
    if kind == "bool":
        extract = f"{extract} != 0U"
    elif point.info.signed:
        extract = f"({kind})fieldscribe_signed({extract}, {hexadecimal(1 << (point.width - 1), 1)})"
    elif kind != "uint16_t":
        extract = f"({kind})({extract})"
    number = "raw ? 1U : 0U" if kind == "bool" else "(uint16_t)raw" if point.info.signed else "raw"
    insert = f"fieldscribe_insert(word, {place}, {number})"
    if point.fixed is not None:
        insert = f"fieldscribe_fix({insert}, {_constant_bits(point)})"
    yield Function(function(f"static inline {kind}", f"{name}_extract", ("uint16_t word",), f"return {extract};"))
    parameters = ("uint16_t word", f"{kind} raw")
    yield Function(function("static inline uint16_t", f"{name}_insert", parameters, f"return {insert};"))


def _constant_bits(point: Point) -> str:
    """The mask of the constant bits, and their values."""
    assert point.fixed is not None
    return f"{hexadecimal(point.fixed.mask)}, {hexadecimal(point.fixed.bits)}"


def fixes(point: Point) -> bool:
    """Whether encoding sets the constant bits of the word; for a bit group, insertion sets them."""
    return point.fixed is not None and point.bits is None


def fixed_number(point: Point, _macro: str, _scope: HeaderScope, name: str) -> str:
    """An expression for the number `name` with the constant bits of the word set, in the point's raw type."""
    info = point.info
    width = max(16, info.bits)
    fixed = f"fieldscribe_fix{width if width > 16 else ''}((uint{width}_t){name}, {_constant_bits(point)})"
    if not info.signed:
        return fixed if info.bits > 8 else f"({fixed} != 0U)" if info.bits == 1 else f"({raw_type(point)}){fixed}"
    if info.bits > 16:
        return f"fieldscribe_signed{info.bits}({fixed})"
    sign, mask = hexadecimal(1 << (info.bits - 1)), hexadecimal((1 << info.bits) - 1)
    return f"({raw_type(point)})fieldscribe_signed((uint16_t)({fixed} & {mask}), {sign})"
