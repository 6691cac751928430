"""How a raw number lies in the words on the wire."""

from __future__ import annotations

from fieldscribe.model import Point
from fieldscribe.targets.c.literals import hexadecimal, raw_type
from fieldscribe.targets.c.scope import Scope
from fieldscribe.targets.c.views import BitsView, WordsView


def words_view(point: Point, scope: Scope) -> WordsView | None:
    """Conversions between raw and words; None where the one word is the raw number, or its bits are shared."""
    info = point.info
    if point.bits is not None or info.bits == 1 or (info.bits <= 16 and not info.signed):
        return None
    target = raw_type(point)
    if point.words == 1:
        mask, sign = ("words[0]", "0x8000U") if info.bits == 16 else ("words[0] & 0xFFU", "0x80U")
        return WordsView(1, "", ((0, "(uint16_t)raw"),), f"({target}){scope.helper('signed')}({mask}, {sign})")
    bits = f"uint{info.bits}_t"
    order = sorted(point.addresses) if point.addresses else []
    high_first = [order.index(address) for address in point.addresses] if order else list(range(point.words))
    shifts = [(16 * (point.words - 1 - place), index) for place, index in enumerate(high_first)]
    stores = tuple(
        (index, f"(uint16_t)(bits >> {shift})" if shift else "(uint16_t)(bits & 0xFFFFU)")
        for shift, index in sorted(shifts, key=lambda one: one[1])
    )
    joined = " | ".join(f"(({bits})words[{index}] << {shift})" if shift else f"words[{index}]" for shift, index in shifts)
    if info.signed:
        joined = f"{scope.helper(f'signed{info.bits}')}({joined})"
    return WordsView(point.words, bits, stores, joined)


def bits_view(point: Point, scope: Scope) -> BitsView | None:
    """Conversions between raw and the word it shares; None for points with words of their own."""
    if point.bits is None:
        return None
    low, width, target = point.bits[1], point.width, raw_type(point)
    ones = (1 << width) - 1
    field = f"(uint16_t)(word >> {low})" if low else "word"
    field = f"{field} & {hexadecimal(ones, 1)}"
    if target == "bool":
        extract = f"(word & {hexadecimal(ones << low)}) != 0U"
    elif point.info.signed:
        extract = f"({target}){scope.helper('signed')}({field}, {hexadecimal(1 << (width - 1), 1)})"
    else:
        extract = f"({target})({field})"
    number = "(raw ? 1U : 0U)" if target == "bool" else "(uint16_t)raw"
    shifted = f"((uint32_t){number} << {low})" if low else f"(uint32_t){number}"
    kept = hexadecimal(0xFFFF & ~(ones << low))
    return BitsView(extract, f"(uint16_t)((word & {kept}) | ({shifted} & {hexadecimal(ones << low)}))")
