"""How a raw number lies in the words on the wire."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.targets.c.literals import hexadecimal, raw_type
from fieldscribe.targets.c.views import BitsView, WordsView

if TYPE_CHECKING:
    from fieldscribe.model import Point
    from fieldscribe.targets.c.scope import Scope


def words_view(point: Point, scope: Scope) -> WordsView | None:
    """Conversions between raw and words; None for a text, and where one word is the raw number or holds several."""
    info = point.info
    if point.text is not None or point.bits is not None or info.bits == 1 or (info.bits <= 16 and not info.signed):
        return None
    target = raw_type(point)
    if point.words == 1:
        mask, sign = ("words[0]", "0x8000U") if info.bits == 16 else ("words[0] & 0xFFU", "0x80U")
        return WordsView(1, "", ((0, "(uint16_t)raw"),), f"({target}){scope.helper('signed')}({mask}, {sign})")
    bits = f"uint{info.bits}_t"
    order = sorted(point.addresses) if point.addresses else []
    whole = len(order) == point.words  # one address of a parameter may hold several words, the high one first
    high_first = [order.index(address) for address in point.addresses] if whole else list(range(point.words))
    shifts = [(16 * (point.words - 1 - place), index) for place, index in enumerate(high_first)]
    stores = tuple(
        (index, f"(uint16_t)(bits >> {shift})" if shift else "(uint16_t)(bits & 0xFFFFU)")
        for shift, index in sorted(shifts, key=lambda one: one[1])
    )
    joined = " | ".join(
        f"(({bits})words[{index}] << {shift})" if shift else f"words[{index}]" for shift, index in shifts
    )
    if info.signed:
        joined = f"{scope.helper(f'signed{info.bits}')}({joined})"
    return WordsView(point.words, bits, stores, joined)


def bits_view(point: Point, macro: str, scope: Scope) -> BitsView | None:
    """Conversions between raw and the word it shares; None for points with words of their own."""
    if point.bits is None:
        return None
    target, low = raw_type(point), point.bits[1]
    field = f"((uint32_t)word & {macro}_MASK) >> {macro}_SHIFT" if low else f"word & {macro}_MASK"
    if target == "bool":
        extract = f"(word & {macro}_MASK) != 0U"
    elif point.info.signed:
        sign = hexadecimal(1 << (point.width - 1), 1)
        extract = f"({target}){scope.helper('signed')}((uint16_t)({field}), {sign})"
    else:
        extract = f"({target})({field})"
    number = "(raw ? 1U : 0U)" if target == "bool" else "(uint16_t)raw"
    shifted = f"(uint32_t){number} << {macro}_SHIFT" if low else f"(uint32_t){number}"
    changed = f"(word & ~(uint32_t){macro}_MASK) | (({shifted}) & {macro}_MASK)"
    if point.fixed is not None:
        changed = f"(({changed}) & ~(uint32_t){macro}_FIXED_MASK) | {macro}_FIXED_BITS"
    return BitsView(extract, f"(uint16_t)({changed})")


def fixes(point: Point) -> bool:
    """Whether encoding puts constant bits into the raw number; for a bit group its insertion does."""
    return point.fixed is not None and point.bits is None


def fixed_number(point: Point, macro: str, scope: Scope, name: str) -> str:
    """The number `name` of the point's raw type with the constant bits of its word put in."""
    info, bits = point.info, f"uint{max(32, point.info.bits)}_t"
    number = f"(({bits}){name} & ~({bits}){macro}_FIXED_MASK) | {macro}_FIXED_BITS"
    if not info.signed:
        return f"({raw_type(point)})({number})"
    if info.bits > 16:
        return f"{scope.helper(f'signed{info.bits}')}({number})"
    sign = hexadecimal(1 << (info.bits - 1))
    mask = f"({number}) & {hexadecimal((1 << info.bits) - 1)}"
    return f"({raw_type(point)}){scope.helper('signed')}((uint16_t)({mask}), {sign})"
