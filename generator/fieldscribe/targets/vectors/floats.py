"""Vectors of points that travel as binary32 or binary64 patterns."""

from collections.abc import Iterable, Iterator
from fractions import Fraction
from math import inf, isfinite, isnan, nan, nextafter, pi
from sys import float_info

from fieldscribe.model import Allowed, Shape
from fieldscribe.targets.vectors.lines import Lines
from fieldscribe.targets.vectors.oracle import bits_of, code_of, float_of_bits, half_away
from fieldscribe.targets.vectors.samples import PointEncoding, codes

_GREATEST = {32: 2.0**128 - 2.0**104, 64: float_info.max}
"""The greatest finite number by width."""

_DECODED = {
    32: (
        0.0,
        -0.0,
        2.0**-149,
        -(2.0**-149),
        2.0**-126,
        1.0,
        -1.5,
        0.1,
        0x10203 * 2.0**-149,
        pi,
        _GREATEST[32],
        -_GREATEST[32],
    ),
    64: (0.0, -0.0, 1.0, -1.5, 0.1, 5e-324, _GREATEST[64]),
}
"""Numbers whose patterns are decoded, by width, in addition to infinities and NaN."""

_TIES = (
    1 + 2.0**-24,
    1 + 3 * 2.0**-24,
    nextafter(1 + 2.0**-24, 2),
    2.0**-150,
    3 * 2.0**-150,
    1 - 2.0**-25,
    16777217.0,
    2.0**-126,
)
_LAST_COUNT = (1 << 63) - 1
_BEYOND_32 = 2.0**128 - 2.0**103
"""Halfway between the greatest binary32 and the next power of two: numbers from here on round to infinity."""


def floats(lines: Lines, encoding: PointEncoding, *, deep: bool) -> None:
    """Add vectors of decoding, encoding and checking; limits are compared after conversion to the type."""
    shape, width = encoding.shape, encoding.shape.width
    limits = _limits(encoding.allowed, width)
    if shape.readable:
        numbers = (*_DECODED[width], inf, -inf, nan) if deep else (-inf, nan)
        for bits in dict.fromkeys((*_patterns(numbers, width), *(codes(shape) if deep else ()))):
            code = code_of(shape, bits)
            result = ("ok", float_of_bits(bits, width)) if code is None else ("special", None, code.name)
            lines.add("decode", bits, *result)
    if shape.writable:
        values = _values(encoding, limits, deep=deep)
        for value in {bits_of(value, 64): value for value in values}.values():  # -0 is not 0
            lines.add("encode", value, *_encoded(shape, value, limits))
        for bits in dict.fromkeys((*_patterns_to_check(limits, width), *codes(shape))):
            code = code_of(shape, bits)
            coded = None if code is None else "ok" if code.writable else "special"
            lines.add("check", bits, coded or _admitted(float_of_bits(bits, width), limits))
    if width == 32 and shape.has_counts:
        _counts(lines, shape, 10 ** (shape.decimals or 0), limits)


def _counts(lines: Lines, shape: Shape, tens: int, limits: list[tuple[float, float]]) -> None:
    """Add counts of `tens` a unit, where numbers have one: of small, large and typical ones, limits and no numbers."""
    if shape.readable:
        edges = [_LAST_COUNT // tens * one for one in (1.0, -1.0, 0.5, 1.1)]
        halves = (half / tens for half in (0.25, 0.49, 0.5, 0.51, -0.5, 1.5, -2.5, 12345.5))
        numbers = (*_DECODED[32], *edges, *halves, 2.0**23, -(2.0**24), 2.0**30, 2.0**63, inf, -inf, nan, -nan)
        for bits in dict.fromkeys((*_patterns(numbers, 32), *codes(shape), 0xFF80_0001)):
            lines.add("f32_decode_count", bits, *_count_of(shape, bits, tens))
    if shape.writable:
        edges = [*(end for pair in limits for end in pair), *(float_of_bits(raw, 32) for raw in codes(shape))]
        whole = [int(edge * tens) for edge in (*edges, 2.0**24 + 1) if abs(edge) * tens < _LAST_COUNT]
        near = [count + step for count in whole for step in (-1, 0, 1)]
        few = (0, 1, -1, 7, 215, 16777217, 33554431, 167772155, _LAST_COUNT, -_LAST_COUNT - 1)
        for count in dict.fromkeys((*few, *near)):
            bits = _nearest(Fraction(count, tens))
            status = "special" if code_of(shape, bits) else _admitted(float_of_bits(bits, 32), limits)
            lines.add("f32_encode_count", count, status, bits if status == "ok" else None)


def _count_of(shape: Shape, bits: int, tens: int) -> Iterator[object]:
    number, code = float_of_bits(bits, 32), code_of(shape, bits)
    if code is not None or not isfinite(number):
        yield "special" if code is not None else "not_a_number" if isnan(number) else "overflow"
        return
    count = half_away(*(Fraction(number) * tens).as_integer_ratio())
    yield from ("ok", count) if abs(count) <= _LAST_COUNT else ("overflow",)


def _nearest(value: Fraction) -> int:
    """Return the pattern of the binary32 nearest to a value, ties to even."""
    guess = bits_of(float(value), 32)
    near = [bits for bits in (guess - 1, guess, guess + 1) if 0 <= bits <= 0xFFFF_FFFF]
    return min(near, key=lambda bits: (abs(Fraction(float_of_bits(bits, 32)) - value), bits & 1))


def _patterns(numbers: Iterable[float], width: int) -> list[int]:
    return [bits_of(number, width) for number in numbers]


def _limits(allowed: Allowed, width: int) -> list[tuple[float, float]]:
    """Return the limits, rounded to numbers of the type as values are; without limits, the limits of the type."""
    limits = [(_typed(float(low), width), _typed(float(high), width)) for low, high in allowed.units]
    return limits or [(-_GREATEST[width], _GREATEST[width])]


def _typed(value: float, width: int) -> float:
    """Return the nearest number of the type."""
    return float_of_bits(bits_of(value, width), width)


def _values(encoding: PointEncoding, limits: list[tuple[float, float]], *, deep: bool) -> list[float]:
    width = encoding.shape.width
    if not deep:
        near = (value for low, high in limits for value in (low, high, nextafter(low, -inf), nextafter(high, inf)))
        return [0.1, *near]
    values = [0.0, -0.0, 0.1, -1.5]
    values += [value for raw in codes(encoding.shape) if isfinite(value := float_of_bits(raw, width))]
    for limit in (float(limit) for pair in encoding.allowed.units for limit in pair):
        values += [limit, nextafter(limit, inf), nextafter(limit, -inf), limit - 1, limit + 1]
    if width == 32:
        # for each limit: the middle between it and each neighbour in the type, and the values next to that middle
        for limit in _finite(limits) if encoding.allowed.units else ():
            for neighbour in _neighbours(limit, width):
                half = (limit + neighbour) / 2  # exact, because both are binary32 numbers
                values += [limit, half, nextafter(half, limit), nextafter(half, neighbour)]
        values += _TIES
        values += [_BEYOND_32, -_BEYOND_32, nextafter(_BEYOND_32, 0), nextafter(-_BEYOND_32, 0)]
    return [*values, nan, inf, -inf, 1e300, -1e300]


def _finite(limits: list[tuple[float, float]]) -> list[float]:
    return [limit for pair in limits for limit in pair if isfinite(limit)]


def _neighbours(value: float, width: int) -> list[float]:
    """Return the next numbers of the type below and above a number of the type."""
    if width == 64:
        return [nextafter(value, -inf), nextafter(value, inf)]
    if value == 0:
        return [-(2.0**-149), 2.0**-149]
    bits = bits_of(value, width)  # patterns are ordered by magnitude for either sign
    return [next_one for step in (-1, 1) if isfinite(next_one := float_of_bits(bits + step, width))]


def _patterns_to_check(limits: list[tuple[float, float]], width: int) -> list[int]:
    """Return the patterns of the limits, their neighbours, both zeros, the infinities and NaN."""
    numbers = [0.0, -0.0] if width == 32 else [0.0, -0.0, inf, -inf]
    for limit in _finite(limits):
        numbers += [limit, *_neighbours(limit, width)]
    signalling = 0xFF80_0001 if width == 32 else 0xFFF0 << 48 | 1
    return [*_patterns((*numbers, inf, -inf, nan), width), signalling]


def _encoded(shape: Shape, value: float, limits: list[tuple[float, float]]) -> tuple[object, ...]:
    if not isfinite(value):
        return ("not_a_number" if isnan(value) else "out_of_range",)
    pattern = bits_of(value, shape.width)
    number = float_of_bits(pattern, shape.width)
    if isfinite(number) and code_of(shape, pattern) is not None:
        return ("special",)
    status = _admitted(number, limits)
    return (status, pattern if status == "ok" else None)


def _admitted(number: float, limits: list[tuple[float, float]]) -> str:
    """Return the status of a number of the type for these limits."""
    if isnan(number):
        return "not_a_number"
    inside = isfinite(number) and any(low <= number <= high for low, high in limits)
    return "ok" if inside else "out_of_range"
