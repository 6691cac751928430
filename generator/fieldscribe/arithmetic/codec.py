"""The exact arithmetic of one point: values to raw numbers and back, in rationals, with run-time factors put in.

It knows no words and no buses. `Settings` are raw numbers of other points by name; what is missing there is said.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from math import isfinite, isnan
from typing import TYPE_CHECKING

from fieldscribe.arithmetic import floats
from fieldscribe.arithmetic.rounding import half_away
from fieldscribe.arithmetic.words import with_fixed

if TYPE_CHECKING:
    from fieldscribe.model import Bound, Factor, Interval, Linear, Point, Special

Settings = Mapping[str, int | Fraction]
"""What rules take of other points, by name: raw numbers; of f32 and f64 points the value, see `setting_of`."""

MOST_EXPONENT = 30
"""The largest exponent of ten that a point may give: 10^30 is beyond any device."""


class CodecError(Exception):
    """Why there is no value or no raw number.

    `status` is the one that generated code gives (`out_of_range`, `zero_factor`, ...) or `missing`; `missing` names the
    points whose raw numbers are needed and not given, or the point that is to blame. `special` is the special code in
    the place of a quantity.
    """

    def __init__(self, status: str, missing: Iterable[str] = (), special: Special | None = None) -> None:
        super().__init__(status)
        self.status = status
        self.missing = tuple(dict.fromkeys(missing))
        self.special = special


class _NoQuantity(Fraction):
    """What a floating-point point holds while that is a special code: known to rules and limits as none."""


class _Code(int):
    """The same of a point of whole numbers: the raw number."""


@dataclass(frozen=True, slots=True)
class Window:
    """Raw numbers low..high that may be written now; while points are `missing`, the widest that it can be."""

    low: int
    high: int
    missing: tuple[str, ...] = ()


def setting_of(point: Point, raw: int) -> int | Fraction:
    """What rules take of a point that holds a raw number; 0 for a bit pattern that is no number."""
    coded = point.special(raw) is not None
    if not point.info.floating:
        return _Code(raw) if coded else raw
    if coded:
        return _NoQuantity(0)
    number = float_of(point, raw)
    return Fraction(number) if isfinite(number) else Fraction(0)


def rule_in_force(point: Point, settings: Settings) -> tuple[Fraction, Fraction]:
    """(ratio, offset) with raw = value * ratio + offset. Raises CodecError."""
    if point.scale is None:
        return Fraction(1), Fraction(0)
    for case in point.scale:
        if case.point is None or _needed(case.point, settings) == case.raw:
            return _with_factors(case.rule, settings), case.rule.offset
    raise CodecError("no_case", point.scale_arguments)


def decode(point: Point, raw: int, settings: Settings) -> Fraction:
    """The exact value of a raw number (of a bit pattern that is no number: `not_a_number`). Raises CodecError."""
    quantity(point, raw)
    if point.info.floating:
        number = float_of(point, raw)
        if not isfinite(number):
            raise CodecError("not_a_number")
        return Fraction(number)
    ratio, offset = rule_in_force(point, settings)
    if point.most_raw is not None and abs(raw) > point.most_raw:
        raise CodecError("overflow")
    return (raw - offset) / ratio


def quantity(point: Point, raw: int) -> int:
    """The raw number itself, if it is a quantity. Raises CodecError: `special`."""
    special = point.special(raw)
    if special is not None:
        raise CodecError("special", special=special)
    return raw


def encode(point: Point, value: Fraction, settings: Settings) -> int:
    """The raw number nearest to a value, halves away from zero; not yet held against the range. Raises CodecError."""
    if point.info.floating:
        return _pattern_of(point, value)
    ratio, offset = rule_in_force(point, settings)
    return half_away(value * ratio + offset)


def encode_checked(point: Point, value: Fraction, settings: Settings) -> int:
    """The raw number to write for a value, which no special code is. Raises CodecError."""
    raw = quantity(point, with_fixed(point, encode(point, value, settings)))
    check(point, raw, settings)
    return raw


def check(point: Point, raw: int, settings: Settings) -> None:
    """Whether a raw number may be written. Raises CodecError: `special`, `out_of_range`, `unknown_value`, ..."""
    special = point.special(raw)
    if special is not None and special.writable:
        return
    quantity(point, raw)
    if point.info.floating:
        _check_units(point, raw)
        return
    if with_fixed(point, raw) != raw:
        raise CodecError("out_of_range")
    if strange_digits(point, raw):
        raise CodecError("unknown_value")
    closed = point.enum is not None and point.enum.closed
    if point.least <= raw <= point.greatest:
        hits = [one for one in windows(point, settings) if one.low <= raw <= one.high]
        if any(not one.missing for one in hits):
            return
        if hits:
            raise CodecError("missing", (name for one in hits for name in one.missing))
    raise CodecError("unknown_value" if closed else "out_of_range")


def digits(point: Point, raw: int) -> tuple[int, ...]:
    """The decimal digits of a word, the highest first, which takes what is left."""
    found = []
    for place in reversed(range(0 if point.digits is None else point.digits.count)):
        digit, raw = divmod(raw, 10**place)
        found.append(digit)
    return tuple(found)


def strange_digits(point: Point, raw: int) -> bool:
    """Whether a digit of the word is none of the numbers that it may be."""
    known = {one.raw for one in point.digits.enum.entries} if point.digits is not None else set()
    return not known.issuperset(digits(point, raw))


def windows(point: Point, settings: Settings) -> tuple[Window, ...]:
    """The intervals in force; all that the bits can hold where there are none. Raises CodecError: `zero_factor`."""
    found = tuple(_window(one, settings) for one in point.allowed.intervals)
    return found or (Window(point.least, point.greatest),)


def nearest_allowed(point: Point, raw: int, settings: Settings) -> int | None:
    """The quantity (no special code) closest to `raw` that may surely be written; None where nobody knows."""
    known = [one for one in windows(point, settings) if not one.missing and one.low <= one.high]
    ends = [end for one in known if point.special(end := min(max(raw, one.low), one.high)) is None]
    return min(ends, key=lambda end: (abs(end - raw), end), default=None)


def float_of(point: Point, pattern: int) -> float:
    """The number that the bit pattern of an f32 or f64 point is."""
    return floats.float_of(pattern, point.info.bits)


def _needed(name: str, settings: Settings) -> int | Fraction:
    if name not in settings:
        raise CodecError("missing", (name,))
    return settings[name]


def _with_factors(rule: Linear, settings: Settings) -> Fraction:
    missing = [factor.point for factor in rule.factors if factor.point not in settings]
    if missing:
        raise CodecError("missing", missing)
    coded = [factor.point for factor in rule.factors if isinstance(settings[factor.point], (_NoQuantity, _Code))]
    if coded:
        raise CodecError("zero_factor", coded)
    return _product(rule, settings, zero=False)


def _product(rule: Linear, settings: Settings, *, zero: bool) -> Fraction:
    """The ratio times all factors; what is divided by is never zero, what is multiplied with only if `zero` may be."""
    product = rule.ratio
    for factor in powers_last(rule):
        number = _factor(factor, settings)
        if number == 0 and not (zero and factor.power > 0):
            raise CodecError("zero_factor", (factor.point,))
        product *= number**factor.power
    return product


def powers_last(rule: Linear) -> list[Factor]:
    """The factors in the order in which generated code looks at them: a zero counts before an exponent too large."""
    return sorted(rule.factors, key=lambda factor: factor.ten_to)


def _factor(factor: Factor, settings: Settings) -> Fraction:
    number = Fraction(factor.slope * settings[factor.point] + factor.intercept)
    if not factor.ten_to:
        return number
    low, high = factor.exponents or (-MOST_EXPONENT, MOST_EXPONENT)
    if not low <= settings[factor.point] <= high:
        raise CodecError("overflow", (factor.point,))
    return Fraction(10) ** int(number)


def _window(interval: Interval, settings: Settings) -> Window:
    low, low_missing = _bound(interval.low, settings, lower=True)
    high, high_missing = _bound(interval.high, settings, lower=False)
    return Window(low, high, tuple(dict.fromkeys((*low_missing, *high_missing))))


def _bound(bound: Bound, settings: Settings, *, lower: bool) -> tuple[int, tuple[str, ...]]:
    """The bound, and the points without which it is only the outermost one."""
    if isinstance(bound, int):
        return bound, ()
    outermost = bound.outermost(low=lower)
    if any(_is_code(settings.get(name), codes) for name, codes in bound.unless):
        return outermost, ()
    needed = [*(factor.point for factor in bound.rule.factors), *(name for name, _ in bound.unless)]
    missing = tuple(name for name in dict.fromkeys(needed) if name not in settings)
    if missing:
        return outermost, missing
    number = half_away(_product(bound.rule, settings, zero=True) + bound.rule.offset)
    return (max(outermost, number) if lower else min(outermost, number)), ()


def _is_code(held: int | Fraction | None, codes: tuple[tuple[int, int], ...]) -> bool:
    """Whether what a point holds is one of its special codes."""
    if isinstance(held, int):
        return any(low <= held <= high for low, high in codes)
    return isinstance(held, _NoQuantity)


def _pattern_of(point: Point, value: Fraction) -> int:
    try:
        return floats.pattern_of(value, point.info.bits)
    except OverflowError as error:
        raise CodecError("out_of_range") from error


def _check_units(point: Point, pattern: int) -> None:
    """Limits of floating points are rounded as the value is, and compared with the number that the pattern is."""
    number = float_of(point, pattern)
    if isnan(number):
        raise CodecError("not_a_number")
    spans = point.allowed.units
    limits = [[float_of(point, _pattern_of(point, end)) for end in span] for span in spans]
    if not isfinite(number) or (spans and not any(low <= number <= high for low, high in limits)):
        raise CodecError("out_of_range")
