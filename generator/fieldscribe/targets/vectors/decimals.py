"""Vectors of decimal digits: of words whose digits each have a meaning, and of values as people see them."""

from collections.abc import Iterable, Iterator
from functools import partial
from math import inf, isfinite, nan
from operator import mul

from fieldscribe.model import Digits, Shape
from fieldscribe.targets.vectors import samples
from fieldscribe.targets.vectors.lines import Lines, text
from fieldscribe.targets.vectors.numbers import code_answer
from fieldscribe.targets.vectors.oracle import (
    INT64,
    WHOLE,
    Oracle,
    Ratio,
    bits_of,
    code_of,
    float_of_bits,
    half_away,
    outer_bounds,
)
from fieldscribe.targets.vectors.samples import PointEncoding, codes

_NEAR = range(-400, 401)
"""The range in which halves of the last decimal are searched."""


def digits(lines: Lines, shape: Shape) -> None:
    """Add vectors of words of digits: each digit with all its numbers and some that it cannot have."""
    if shape.digits is None:
        return
    allowed = {entry.raw for entry in shape.digits.enum.entries}
    places = [10**place for place in reversed(range(shape.digits.count))]
    top = 10**shape.digits.count

    def raw_of(number: tuple[int, ...]) -> int:
        return sum(map(mul, number, places))

    def digits_of(raw: int) -> list[int]:
        return [raw // places[0], *(raw // place % 10 for place in places[1:])]

    def decode(raw: int) -> str:
        return code_answer(shape, raw) or f"ok\t{_written(digits_of(raw))}"

    def check(raw: int) -> str:
        if (code := code_of(shape, raw)) is not None:
            return "ok" if code.writable else "special"
        return "ok" if allowed.issuperset(digits_of(raw)) else "unknown_value"

    def encode(number: tuple[int, ...]) -> str:
        raw = raw_of(number)
        if not allowed.issuperset(number) or raw > 0xFFFF:
            return "unknown_value"
        return f"ok\t{raw}" if code_of(shape, raw) is None else "special"

    numbers = _numbers(shape.digits, allowed)
    raws = (*map(raw_of, numbers), 0, top - 1, top, 12345, 0x7FFF, 0xFFFF, *codes(shape))
    words = [raw for raw in raws if raw <= 0xFFFF]
    lines.add_answers("digits", decode, words if shape.readable else ())
    lines.add_answers("check", check, words if shape.writable else ())
    lines.add_answers("digits_encode", encode, numbers if shape.writable else (), _written)


def _written(digits: Iterable[int]) -> str:
    return ",".join(map(str, digits))


def _numbers(layout: Digits, allowed: Iterable[int]) -> list[tuple[int, ...]]:
    """Return digits to try: each place with all its numbers and two invalid ones, all others at their least."""
    known = sorted(allowed)
    impossible = [next(digit for digit in range(256) if digit not in known), 10]
    base = (known[0],) * layout.count
    tried = [base, (known[-1],) * layout.count, tuple(known[place % len(known)] for place in range(layout.count))]
    for place in range(layout.count):
        tried += [(*base[:place], digit, *base[place + 1 :]) for digit in (*known, *impossible)]
    return tried


def displayed(lines: Lines, oracle: Oracle, encoding: PointEncoding, *, deep: bool) -> None:
    """Add the texts of the values of a point that says how many decimals people see."""
    shape = encoding.shape
    for settings in samples.settings(oracle, encoding, deep=deep):
        if settings:
            lines.set("with", settings)
        ratio = oracle.ratio(shape, settings) if shape.scale and not shape.info.floating else WHOLE
        if shape.info.floating:
            raws = _patterns(shape)
        else:
            raws = [0, 1] if isinstance(ratio, str) else _raws(encoding, ratio, deep=deep)
        lines.add_answers("told", partial(_decimals_text, encoding, ratio), raws)


def _decimals_text(encoding: PointEncoding, ratio: Ratio | str, raw: int) -> str:
    """Return the status of a raw number and its text; a special code has its name."""
    shape, tens = encoding.shape, 10 ** (encoding.shape.display or 0)
    code, unit = code_of(shape, raw), f" {encoding.symbol}" if encoding.symbol else ""
    if code is not None or isinstance(ratio, str):
        return f"ok\t{text(code.name)}" if code is not None else str(ratio)
    over, under = ratio.numerator(raw), ratio.denominator
    if shape.info.floating:
        number = float_of_bits(raw, shape.width)
        if not isfinite(number):
            return f"ok\t{text(f'{number}{unit}')}"
        over, under = number.as_integer_ratio()
    count = half_away(over * tens, under)
    beyond = not -INT64 <= count < INT64 or (shape.most_raw is not None and abs(raw) > shape.most_raw)
    if shape.scale_arguments and beyond:
        return "overflow"
    return f"ok\t{text(_decimal(count, shape.display or 0) + unit)}"


def _raws(encoding: PointEncoding, ratio: Ratio, *, deep: bool) -> list[int]:
    """Return limits; if deep, also the ends of the type, small numbers, halves and special codes."""
    shape = encoding.shape
    found = [*outer_bounds(shape, encoding.allowed), 1]
    if deep:
        found += [0, -1, 5, shape.least, shape.greatest, shape.greatest - 1]
        found += [*_halves(shape, ratio), *samples.codes(shape)]
    return [raw for raw in found if shape.least <= raw <= shape.greatest]


def _halves(shape: Shape, ratio: Ratio) -> Iterator[int]:
    """Yield the raw numbers next to zero whose value lies in the middle of two texts, above and below zero."""
    power, under = 10 ** (shape.display or 0), ratio.denominator
    middle = [raw for raw in _NEAR if 2 * ratio.numerator(raw) * power % (2 * under) == under]
    yield from [raw for raw in middle if ratio.numerator(raw) > 0][:2]
    yield from [raw for raw in middle if ratio.numerator(raw) < 0][-2:]


def _patterns(shape: Shape) -> list[int]:
    """Return patterns: halves of the last decimal, numbers that round to zero, the largest, and no numbers."""
    half = 0.5 ** ((shape.display or 0) + 1)
    numbers = (0.0, -0.0, 1.0, 0.1, half, -half, 3 * half, half / 2, -half / 2, 1.5e9, -12345678.0, 3e38)
    return [bits_of(number, shape.width) for number in (*numbers, inf, -inf, nan)]


def _decimal(count: int, decimals: int) -> str:
    """Return a count of 10^-decimals units, digit by digit; one that is zero has no sign."""
    whole, part = divmod(abs(count), 10**decimals)
    point = f".{part:0{decimals}d}" if decimals else ""
    return f"{'-' if count < 0 else ''}{whole}{point}"
