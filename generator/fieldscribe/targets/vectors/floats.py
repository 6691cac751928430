"""Vectors of points that travel as binary32 or binary64 patterns."""

from __future__ import annotations

from math import inf, isfinite, isnan, nan, nextafter

from fieldscribe.model import Allowed, Shape
from fieldscribe.targets.vectors.lines import Lines
from fieldscribe.targets.vectors.oracle import bits32, bits64, code_of, float_of_bits
from fieldscribe.targets.vectors.samples import PointEncoding, codes

_PATTERNS_32 = (
    0,
    0x8000_0000,
    1,
    0x8000_0001,
    0x0080_0000,
    0x3F80_0000,
    0xBFC0_0000,
    0x3DCC_CCCD,
    0x0001_0203,
    0x4049_0FDB,
)
_EDGES_32 = (0x7F7F_FFFF, 0xFF7F_FFFF, 0x7F80_0000, 0xFF80_0000, 0x7FC0_0000)
_PATTERNS_64 = tuple(map(bits64, (0.0, -0.0, 1.0, -1.5, 0.1, 5e-324, 1.7976931348623157e308, inf, -inf, nan)))
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
_BEYOND_32 = 2.0**128 - 2.0**103
"""Halfway between the greatest binary32 and the next power of two: numbers from here on round to infinity."""

_GREATEST_32 = 2.0**128 - 2.0**104
_GREATEST_64 = 1.7976931348623157e308


def floats(lines: Lines, encoding: PointEncoding, *, deep: bool) -> None:
    """Add vectors of decoding, encoding and checking; limits are compared after conversion to the type."""
    shape, allowed = encoding.shape, encoding.allowed
    wide = shape.width == 64
    limits = _limits(allowed, wide)
    if shape.readable:
        patterns = dict.fromkeys(_PATTERNS_64 if wide else _PATTERNS_32 + _EDGES_32)
        patterns = dict.fromkeys((*patterns, *codes(shape)) if deep else (*patterns,)[-2:])
        for bits in patterns:
            lines.add("decode", bits, *_decoded(shape, bits))
    if shape.writable:
        for value in dict.fromkeys(map(_Same, _values(encoding, limits, wide, deep=deep))):
            lines.add("encode", value.value, *_encoded(shape, value.value, limits))
        for bits in dict.fromkeys((*_patterns_to_check(limits, wide), *codes(shape))):
            code = code_of(shape, bits)
            coded = None if code is None else "ok" if code.writable else "special"
            lines.add("check", bits, coded or _admitted(float_of_bits(bits, shape.width), limits))


class _Same:
    """A value that is compared by its bits: -0 is not 0."""

    def __init__(self, value: float) -> None:
        self.value = value

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Same) and bits64(self.value) == bits64(other.value)

    def __hash__(self) -> int:
        return hash(bits64(self.value))


def _decoded(shape: Shape, bits: int) -> tuple[object, ...]:
    code = code_of(shape, bits)
    return ("ok", float_of_bits(bits, shape.width)) if code is None else ("special", None, code.name)


def _limits(allowed: Allowed, wide: bool) -> list[tuple[float, float]]:
    """Return the limits, rounded to numbers of the type as values are; without limits, the limits of the type."""
    greatest = _GREATEST_64 if wide else _GREATEST_32
    return [(_typed(float(low), wide), _typed(float(high), wide)) for low, high in allowed.units] or [
        (-greatest, greatest)
    ]


def _typed(value: float, wide: bool) -> float:
    """Return the nearest number of the type."""
    if wide:
        return value
    pattern = bits32(value)
    return (inf if value > 0 else -inf) if pattern is None else float_of_bits(pattern, 32)


def _values(encoding: PointEncoding, limits: list[tuple[float, float]], wide: bool, *, deep: bool) -> list[float]:
    values = [0.0, -0.0, 0.1, -1.5]
    if not deep:
        return [
            0.1,
            *(value for low, high in limits for value in (low, high, nextafter(low, -inf), nextafter(high, inf))),
        ]
    values += [value for raw in codes(encoding.shape) if isfinite(value := float_of_bits(raw, encoding.shape.width))]
    for low, high in encoding.allowed.units:
        for limit in (float(low), float(high)):
            values += [limit, nextafter(limit, inf), nextafter(limit, -inf), limit - 1, limit + 1]
    if not wide:
        if encoding.allowed.units:
            # for each limit: the middle between it and each neighbour in the type, and the values next to that middle
            for limit in (limit for pair in limits for limit in pair if isfinite(limit)):
                for neighbour in _neighbours(limit, wide):
                    half = (limit + neighbour) / 2  # exact, because both are binary32 numbers
                    values += [limit, half, nextafter(half, limit), nextafter(half, neighbour)]
        values += _TIES
        values += [_BEYOND_32, -_BEYOND_32, nextafter(_BEYOND_32, 0), nextafter(-_BEYOND_32, 0)]
    return [*values, nan, inf, -inf, 1e300, -1e300]


def _neighbours(value: float, wide: bool) -> list[float]:
    """Return the next numbers of the type below and above a number of the type."""
    if wide:
        return [nextafter(value, -inf), nextafter(value, inf)]
    if value == 0:
        return [-(2.0**-149), 2.0**-149]
    bits = bits32(value) or 0  # patterns are ordered by magnitude, whatever the sign
    return [next_one for step in (-1, 1) if isfinite(next_one := float_of_bits(bits + step, 32))]


def _patterns_to_check(limits: list[tuple[float, float]], wide: bool) -> list[int]:
    """Return the patterns of the limits, their neighbours, both zeros, the infinities and NaN."""
    numbers = [0.0, -0.0, inf, -inf]
    for limit in (limit for pair in limits for limit in pair if isfinite(limit)):
        numbers += [limit, *_neighbours(limit, wide)]
    if wide:
        patterns = [bits64(number) for number in numbers] + [0x7FF8 << 48, 0xFFF0 << 48 | 1]
    else:
        patterns = [bits for number in numbers if isfinite(number) and (bits := bits32(number)) is not None]
        patterns += [0x7F80_0000, 0xFF80_0000, 0x7FC0_0000, 0xFF80_0001]
    return list(dict.fromkeys(patterns))


def _encoded(shape: Shape, value: float, limits: list[tuple[float, float]]) -> tuple[object, ...]:
    if not isfinite(value):
        return ("not_a_number" if isnan(value) else "out_of_range",)
    wide = shape.width == 64
    pattern = bits64(value) if wide else bits32(value)
    if pattern is not None and code_of(shape, pattern) is not None:
        return ("special",)
    status = "out_of_range" if pattern is None else _admitted(_typed(value, wide), limits)
    return (status, pattern if status == "ok" else None)


def _admitted(number: float, limits: list[tuple[float, float]]) -> str:
    """Return whether a number of the type may be written within these limits."""
    if isnan(number):
        return "not_a_number"
    inside = isfinite(number) and any(low <= number <= high for low, high in limits)
    return "ok" if inside else "out_of_range"
