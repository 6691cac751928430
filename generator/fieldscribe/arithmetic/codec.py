"""The exact arithmetic of one point: values to raw numbers and back, as rationals, with run-time factors given.

It knows neither words on the wire nor buses. A CodecError names the other points whose raw numbers are missing.
"""

from collections.abc import Iterable, Mapping
from fractions import Fraction
from math import isfinite, isnan
from typing import NamedTuple

from fieldscribe.arithmetic import exact
from fieldscribe.arithmetic.exact import half_away
from fieldscribe.arithmetic.words import with_fixed
from fieldscribe.model import Bound, Factor, Interval, Linear, Point, Special

Settings = Mapping[str, int | Fraction]
"""The raw numbers of other points by name, as rules need them; for f32 and f64 points the values (`setting_of`)."""

MOST_EXPONENT = 30
"""The largest exponent of ten that a point may hold: 10^30 is beyond any device."""


class CodecError(Exception):
    """A value or a raw number cannot be computed.

    `status` is the status in generated code (`out_of_range`, `zero_factor`, ...) or `missing`. `missing` names the
    points whose raw numbers are needed but not given, or the point that causes the error. `special` is the special code
    found instead of a quantity.
    """

    def __init__(self, status: str, missing: Iterable[str] = (), special: Special | None = None) -> None:
        super().__init__(status)
        self.status = status
        self.missing = tuple(dict.fromkeys(missing))
        self.special = special


class _NoQuantity(Fraction):
    """The setting of a floating-point point that holds a special code; rules and limits must not compute with it."""


class _Code(int):
    """The setting of any other point that holds a special code: its raw number."""


class Window(NamedTuple):
    """Raw numbers low..high that may be written now; the widest possible interval while points are `missing`."""

    low: int
    high: int
    missing: tuple[str, ...] = ()


def setting_of(point: Point, raw: int) -> int | Fraction:
    """Return the setting of a point that holds this raw number; 0 for a bit pattern that is not a number."""
    coded = point.special(raw) is not None
    if not point.info.floating:
        return _Code(raw) if coded else raw
    if coded:
        return _NoQuantity(0)
    number = float_of(point, raw)
    return Fraction(number) if isfinite(number) else Fraction(0)


def rule_in_force(point: Point, settings: Settings) -> tuple[Fraction, Fraction]:
    """Return (ratio, offset) with raw = value * ratio + offset. Raises CodecError."""
    if point.scale is None:
        return Fraction(1), Fraction(0)
    for case in point.scale:
        if case.point is None or _needed(case.point, settings) == case.raw:
            return _with_factors(case.rule, settings), case.rule.offset
    raise CodecError("no_case", point.scale_arguments)


def decode(point: Point, raw: int, settings: Settings) -> Fraction:
    """Return the exact value of a raw number. Raises CodecError, such as `not_a_number` for a bit pattern."""
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
    """Return the raw number itself. Raises CodecError (`special`) if it is a special code."""
    special = point.special(raw)
    if special is not None:
        raise CodecError("special", special=special)
    return raw


def encode(point: Point, value: Fraction, settings: Settings) -> int:
    """Return the raw number nearest to a value, halves away from zero; the range is not checked. Raises CodecError."""
    if point.info.floating:
        return _pattern_of(point, value)
    ratio, offset = rule_in_force(point, settings)
    return half_away(value * ratio + offset)


def encode_checked(point: Point, value: Fraction, settings: Settings) -> int:
    """Return the raw number to write for a value; never a special code. Raises CodecError."""
    raw = quantity(point, with_fixed(point, encode(point, value, settings)))
    check(point, raw, settings)
    return raw


def check(point: Point, raw: int, settings: Settings) -> None:
    """Raise CodecError if a raw number may not be written: `special`, `out_of_range`, `unknown_value`, ..."""
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
        hits = [window for window in windows(point, settings) if window.low <= raw <= window.high]
        if any(not window.missing for window in hits):
            return
        if hits:
            raise CodecError("missing", (name for window in hits for name in window.missing))
    raise CodecError("unknown_value" if closed else "out_of_range")


def digits(point: Point, raw: int) -> tuple[int, ...]:
    """Return the decimal digits of a word, the highest first; the highest may be more than 9."""
    digits = []
    for place in reversed(range(0 if point.digits is None else point.digits.count)):
        digit, raw = divmod(raw, 10**place)
        digits.append(digit)
    return tuple(digits)


def strange_digits(point: Point, raw: int) -> bool:
    """Return True if a digit of the word has no name in the enum of the digits."""
    known = {entry.raw for entry in point.digits.enum.entries} if point.digits is not None else set()
    return not known.issuperset(digits(point, raw))


def windows(point: Point, settings: Settings) -> tuple[Window, ...]:
    """Return the intervals in force; without any, all that the bits can hold. Raises CodecError (`zero_factor`)."""
    in_force = tuple(_window(interval, settings) for interval in point.allowed.intervals)
    return in_force or (Window(point.least, point.greatest),)


def nearest_allowed(point: Point, raw: int, settings: Settings) -> int | None:
    """Return the number closest to `raw` that may certainly be written and is not a special code; None without one."""
    known = [window for window in windows(point, settings) if not window.missing and window.low <= window.high]
    ends = [end for window in known if point.special(end := min(max(raw, window.low), window.high)) is None]
    return min(ends, key=lambda end: (abs(end - raw), end), default=None)


def float_of(point: Point, pattern: int) -> float:
    """Return the number that an f32 or f64 point holds as a bit pattern."""
    return exact.float_of(pattern, point.info.bits)


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
    """Return the ratio times all factors. Raises CodecError for a zero divisor, or a zero factor unless `zero`."""
    product = rule.ratio
    for factor in powers_last(rule):
        number = _factor(factor, settings)
        if number == 0 and not (zero and factor.power > 0):
            raise CodecError("zero_factor", (factor.point,))
        if factor.within is not None and not factor.within[0] <= settings[factor.point] <= factor.within[1]:
            raise CodecError("overflow", (factor.point,))
        product *= number**factor.power
    return product


def powers_last(rule: Linear) -> list[Factor]:
    """Return the factors in the order of generated code: it reports a zero factor before a too large exponent."""
    return sorted(rule.factors, key=lambda factor: factor.ten_to)


def _factor(factor: Factor, settings: Settings) -> Fraction:
    number = Fraction(factor.slope * settings[factor.point] + factor.intercept)
    if not factor.ten_to:
        return number
    low, high = factor.within or (-MOST_EXPONENT, MOST_EXPONENT)
    if not low <= settings[factor.point] <= high:
        raise CodecError("overflow", (factor.point,))
    return Fraction(10) ** int(number)


def _window(interval: Interval, settings: Settings) -> Window:
    low, low_missing = _bound(interval.low, settings, lower=True)
    high, high_missing = _bound(interval.high, settings, lower=False)
    return Window(low, high, tuple(dict.fromkeys((*low_missing, *high_missing))))


def _bound(bound: Bound, settings: Settings, *, lower: bool) -> tuple[int, tuple[str, ...]]:
    """Return the bound and the missing points; if any are missing, the outermost number that the bound can be."""
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
    """Return True if a setting is one of the point's special codes."""
    if isinstance(held, int):
        return any(low <= held <= high for low, high in codes)
    return isinstance(held, _NoQuantity)


def _pattern_of(point: Point, value: Fraction) -> int:
    try:
        return exact.pattern_of(value, point.info.bits)
    except OverflowError as error:
        raise CodecError("out_of_range") from error


def _check_units(point: Point, pattern: int) -> None:
    """Raise CodecError unless a limit of the point allows the number; limits are rounded to the type as values are."""
    number = float_of(point, pattern)
    if isnan(number):
        raise CodecError("not_a_number")
    spans = point.allowed.units
    limits = [[float_of(point, _pattern_of(point, end)) for end in span] for span in spans]
    if not isfinite(number) or (spans and not any(low <= number <= high for low, high in limits)):
        raise CodecError("out_of_range")
