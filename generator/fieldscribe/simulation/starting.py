"""A plausible raw number for each point at the start: its default, else one in range that is no special code."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from random import Random

from fieldscribe.arithmetic import codec
from fieldscribe.arithmetic.codec import CodecError, Settings
from fieldscribe.arithmetic.texts import pattern_of_text
from fieldscribe.arithmetic.words import with_fixed
from fieldscribe.model import Point
from fieldscribe.simulation.layout import Layout

_ELECTRIC = {"voltage": 230, "current": 5, "frequency": 50, "power": 1000, "energy": 1000}
_USUAL = _ELECTRIC | {"temperature": 40, "ratio": 50, "rotational speed": 1500, "time": 10}
"""What a measured value is about, in the base unit of its quantity, where its range does not say."""


_NUMBERS = 100
"""The end of the numbers that a point starts with, if neither its range nor its unit says more."""

_WIDE = 20_000
"""The width of a range that is no more than what the bits can hold."""


def starting_raw(layout: Layout, point: Point, settings: Settings, random: Random) -> int:
    """Return the raw number that a point holds at the start, with the settings that it depends on."""
    identifying, others = _identifying(layout, point)
    if identifying:
        return identifying[0]
    if point.default_raw is not None:
        return point.default_raw
    try:
        if point.default is not None:
            return codec.encode(point, point.default, settings)
        found = (raw for raw in _candidates(layout, point, settings, random) if _allowed(point, raw, settings))
        return next(raw for raw in found if raw not in others)
    except (CodecError, StopIteration):
        return with_fixed(point, 0)


def _identifying(layout: Layout, point: Point) -> tuple[list[int], set[int]]:
    """Return the raw numbers by which a point tells this device, the best one first, and those of other variants."""
    asked: list[list[int]] = []
    others: set[int] = set()
    for known in layout.device.identifications:
        if known.point == point.name:
            raws = [*known.raws, *(pattern_of_text(point.text, text) for text in known.texts if point.text is not None)]
            if known.variant is None or layout.variants[known.variant.axis] == known.variant.value:
                asked.append(raws)
            else:
                others.update(raws)
    both = [raw for raw in asked[0] if all(raw in raws for raws in asked)] if asked else []
    return sorted(both, key=lambda raw: (raw in others, raw != point.default_raw)), others


def corrected_raw(point: Point, raw: int, settings: Settings) -> int:
    """Return the raw number, or the nearest one that may be written with the settings as all points have them."""
    if _allowed(point, raw, settings) or point.info.floating or point.text is not None:
        return raw
    try:
        nearest = codec.nearest_allowed(point, raw, settings)
    except CodecError:
        nearest = None
    return raw if nearest is None else with_fixed(point, nearest)


def _allowed(point: Point, raw: int, settings: Settings) -> bool:
    try:
        codec.check(point, raw, settings)
    except CodecError:
        return False
    return True


def _candidates(layout: Layout, point: Point, settings: Settings, random: Random) -> Iterator[int]:
    """Yield raw numbers, the most plausible one first."""
    if point.text is not None:
        yield 0 if point.text.is_bytes else pattern_of_text(point.text, "")
    if point.enum is not None:
        yield from (entry.raw for entry in point.enum.entries)
    if point.flags or point.digits is not None or point.width == 1 or point.name in layout.least:
        yield with_fixed(point, 0)
    usual = _USUAL.get(point.unit.quantity)
    if usual is not None:
        yield codec.encode(point, Fraction(usual), settings)
    for low, high in _ranges(point, settings):
        share = Fraction(random.randint(25, 75), 100)
        number = low + (high - low) * share
        yield codec.encode(point, Fraction(round(number)), settings) if point.info.floating else round(number)
        yield codec.encode(point, low, settings) if point.info.floating else int(low)


def _ranges(point: Point, settings: Settings) -> Iterator[tuple[Fraction, Fraction]]:
    """Yield the ranges of the point: in the unit for floating-point numbers, else in raw numbers."""
    if point.info.floating:
        yield from point.allowed.units or ((Fraction(0), Fraction(_NUMBERS)),)
    elif point.allowed.intervals:
        for low, high in ((window.low, window.high) for window in codec.windows(point, settings)):
            wide = high - low > _WIDE and low <= 0 <= high - _NUMBERS
            yield (Fraction(0), Fraction(_NUMBERS)) if wide else (Fraction(low), Fraction(high))
    else:
        yield Fraction(0), Fraction(min(_NUMBERS, point.greatest))
