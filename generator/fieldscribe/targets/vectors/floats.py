"""Vectors of points that travel as binary32 or binary64 patterns."""

from __future__ import annotations

from math import inf, isfinite, isnan, nan, nextafter
from typing import TYPE_CHECKING

from fieldscribe.targets.vectors.lines import Lines, subject
from fieldscribe.targets.vectors.numbers import bits32, bits64, exact_text, float_of_bits, float_text, hex64
from fieldscribe.targets.vectors.oracle import is_no_value

if TYPE_CHECKING:
    from fieldscribe.model import Point

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
_GREATEST_32 = 2.0**128 - 2.0**103
"""Halfway between the greatest binary32 and the next step: the first number that rounds to infinity."""


def floats(lines: Lines, point: Point) -> None:
    """Decoding of patterns and encoding of values; limits are compared in the unit, as binary64."""
    head, wide = subject(point.item), point.width == 64
    if point.readable:
        patterns = dict.fromkeys(_PATTERNS_64 if wide else _PATTERNS_32 + _EDGES_32)
        for special in point.specials:
            patterns.update({special.low: None, special.high: None})
        for bits in patterns:
            lines.add("decode", f'{head}, "raw": {bits}, {_decoded(point, bits)}')
    if point.writable:
        for value in dict.fromkeys(map(_Same, _values(point, wide))):
            text = f'"float": "{hex64(value.value)}", "value": "{float_text(value.value)}"'
            lines.add("encode", f"{head}, {text}, {_encoded(point, value.value, wide)}")


class _Same:
    """A value that differs from another if its bits do: -0 is not 0."""

    def __init__(self, value: float) -> None:
        self.value = value

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Same) and hex64(self.value) == hex64(other.value)

    def __hash__(self) -> int:
        return hash(hex64(self.value))


def _decoded(point: Point, bits: int) -> str:
    if is_no_value(point, bits):
        return '"status": "no_value"'
    value = float_of_bits(bits, point.width)
    text = exact_text(*value.as_integer_ratio()) if isfinite(value) else float_text(value)
    return f'"status": "ok", "float": "{hex64(value)}", "value": "{text if len(text) <= 40 else float_text(value)}"'


def _values(point: Point, wide: bool) -> list[float]:
    values = [0.0, -0.0, 0.1, -1.5]
    for low, high in point.allowed.units:
        for limit in (float(low), float(high)):
            values += [limit, nextafter(limit, inf), nextafter(limit, -inf), limit - 1, limit + 1]
    if not wide:
        values += _TIES
        values += [_GREATEST_32, -_GREATEST_32, nextafter(_GREATEST_32, 0), nextafter(-_GREATEST_32, 0)]
    return [*values, nan, inf, -inf, 1e300, -1e300]


def _encoded(point: Point, value: float, wide: bool) -> str:
    if isnan(value):
        return '"status": "not_a_number"'
    if not _inside(point, value):
        return '"status": "out_of_range"'
    pattern = bits64(value) if wide else bits32(value)
    return '"status": "out_of_range"' if pattern is None else f'"status": "ok", "raw": {pattern}'


def _inside(point: Point, value: float) -> bool:
    if not isfinite(value):
        return False
    units = point.allowed.units
    return not units or any(float(low) <= value <= float(high) for low, high in units)
