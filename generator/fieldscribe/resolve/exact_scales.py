"""A value through a scale whose run-time factors are known: for worked examples that say what other points hold."""

from __future__ import annotations

import struct
from fractions import Fraction
from typing import TYPE_CHECKING

from fieldscribe.resolve.bounds import MOST_EXPONENT, round_half_away

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fieldscribe.model import Linear, Point, ScaleCase

Held = dict[str, Fraction]
"""What points hold, by item: the raw number, of a floating-point number its value."""

_FORMATS = {32: ">f", 64: ">d"}


def pattern(bits: int, value: Fraction) -> int | None:
    """The bits of the floating-point number nearest to a value; None if there is none."""
    try:
        return int.from_bytes(struct.pack(_FORMATS[bits], float(value)), "big")
    except OverflowError:
        return None


def held_by(point: Point, raw: int) -> Fraction:
    """What a point with that raw number brings into the scales of others."""
    if not point.info.floating:
        return Fraction(raw)
    bits = point.info.bits
    return Fraction(struct.unpack(_FORMATS[bits], raw.to_bytes(bits // 8, "big"))[0])


def encoded(cases: tuple[ScaleCase, ...], value: Fraction, held: Mapping[str, Fraction]) -> int | None:
    """The raw number of a value, rounded half away from zero; None if no rule holds or a factor is zero."""
    for case in cases:
        if case.point is None or held[case.point] == case.raw:
            ratio = _ratio(case.rule, held)
            return None if ratio is None else round_half_away(value * ratio + case.rule.offset)
    return None


def _ratio(rule: Linear, held: Mapping[str, Fraction]) -> Fraction | None:
    ratio = rule.ratio
    for factor in rule.factors:
        number = held[factor.point] * factor.slope + factor.intercept
        if factor.ten_to:
            if number.denominator != 1 or abs(number) > MOST_EXPONENT:
                return None
            number = Fraction(10) ** number.numerator
        if number == 0:
            return None
        ratio = ratio * number if factor.power == 1 else ratio / number
    return ratio
