"""Vectors of points that travel as binary32 or binary64 patterns."""

from collections.abc import Iterable, Iterator
from fractions import Fraction
from math import inf, isfinite, isnan, nan, nextafter, pi
from sys import float_info

from fieldscribe.targets.vectors.lines import Lines, real
from fieldscribe.targets.vectors.numbers import code_answer
from fieldscribe.targets.vectors.oracle import bits_of, code_of, float_of_bits, half_away
from fieldscribe.targets.vectors.samples import PointEncoding, codes

_GREATEST = {32: 2.0**128 - 2.0**104, 64: float_info.max}
"""The greatest finite number by width."""
_DECODED = {
    32: (
        *(0.0, -0.0, 2.0**-149, -(2.0**-149), 2.0**-126, 1.0, -1.5, 0.1, 0x10203 * 2.0**-149, pi),
        *(_GREATEST[32], -_GREATEST[32]),
    ),
    64: (0.0, -0.0, 1.0, -1.5, 0.1, 5e-324, _GREATEST[64]),
}
"""Numbers whose patterns are decoded, by width, in addition to infinities and NaN."""
_TIES = (
    *(1 + 2.0**-24, 1 + 3 * 2.0**-24, nextafter(1 + 2.0**-24, 2), 2.0**-150, 3 * 2.0**-150, 1 - 2.0**-25, 16777217.0),
    2.0**-126,
)
_LAST_COUNT = (1 << 63) - 1
_BEYOND_32 = 2.0**128 - 2.0**103
"""Halfway between the greatest binary32 and the next power of two: numbers from here on round to infinity."""
_SIGNALLING = {32: 0xFF80_0001, 64: 0xFFF0 << 48 | 1}


def floats(lines: Lines, encoding: PointEncoding, *, deep: bool) -> None:
    """Add vectors of decoding, encoding, checking and counting; limits are compared after conversion to the type."""
    shape, answers = encoding.shape, _Floats(encoding)
    if shape.readable:
        numbers = (*_DECODED[shape.width], inf, -inf, nan) if deep else (-inf, nan)
        lines.add_answers("decode", answers.decode, [*answers.patterns(numbers), *(codes(shape) if deep else ())])
    if shape.writable:
        lines.add_answers("encode", answers.encode, answers.values(deep=deep), real)
        lines.add_answers("check", answers.check, [*answers.patterns_to_check(), *codes(shape)])
    if shape.width == 32 and shape.has_counts:
        lines.add("f32_decimals", shape.decimals)
        if shape.readable:
            lines.add_answers("f32_decode_count", answers.decode_count, answers.patterns_to_count())
        if shape.writable:
            lines.add_answers("f32_encode_count", answers.encode_count, answers.counts())


class _Floats:
    """The right answers for an encoding, and what is asked.

    `limits` are rounded to numbers of the type as values are; without limits, they are those of the type.
    """

    def __init__(self, encoding: PointEncoding) -> None:
        self.shape, self.units = encoding.shape, [float(end) for pair in encoding.allowed.units for end in pair]
        ends = [self._typed(end) for end in self.units]
        greatest = _GREATEST[self.shape.width]
        self.limits = [*zip(ends[::2], ends[1::2], strict=True)] or [(-greatest, greatest)]
        self.tens = 10 ** (self.shape.decimals or 0)

    def _number(self, bits: int) -> float:
        return float_of_bits(bits, self.shape.width)

    def _typed(self, value: float) -> float:
        """Return the nearest number of the type."""
        return self._number(bits_of(value, self.shape.width))

    def decode(self, bits: int) -> str:
        """Return status and value."""
        return code_answer(self.shape, bits) or f"ok\t{real(self._number(bits))}"

    def encode(self, value: float) -> str:
        """Return the status of a value, and the pattern to write."""
        if not isfinite(value):
            return "not_a_number" if isnan(value) else "out_of_range"
        return self._put(bits_of(value, self.shape.width))

    def _put(self, bits: int) -> str:
        number = self._number(bits)
        status = "special" if isfinite(number) and code_of(self.shape, bits) is not None else self._admitted(number)
        return f"ok\t{bits}" if status == "ok" else status

    def check(self, bits: int) -> str:
        """Return the status of a pattern that is written directly."""
        code = code_of(self.shape, bits)
        return self._admitted(self._number(bits)) if code is None else "ok" if code.writable else "special"

    def _admitted(self, number: float) -> str:
        """Return the status of a number of the type."""
        if isnan(number):
            return "not_a_number"
        inside = isfinite(number) and any(low <= number <= high for low, high in self.limits)
        return "ok" if inside else "out_of_range"

    def decode_count(self, bits: int) -> str:
        """Return status and count."""
        number = self._number(bits)
        if code_of(self.shape, bits) is not None or not isfinite(number):
            return "special" if code_of(self.shape, bits) else "not_a_number" if isnan(number) else "overflow"
        count = half_away(*(Fraction(number) * self.tens).as_integer_ratio())
        return f"ok\t{count}" if abs(count) <= _LAST_COUNT else "overflow"

    def encode_count(self, count: int) -> str:
        """Return the status of a count, and the pattern to write: the nearest one, ties to even."""
        value = Fraction(count, self.tens)
        guess = bits_of(float(value), 32)
        near = [bits for bits in (guess - 1, guess, guess + 1) if 0 <= bits <= 0xFFFF_FFFF]
        return self._put(min(near, key=lambda bits: (abs(Fraction(self._number(bits)) - value), bits & 1)))

    def patterns(self, numbers: Iterable[float]) -> list[int]:
        """Return the patterns of numbers."""
        return [bits_of(number, self.shape.width) for number in numbers]

    def patterns_to_check(self) -> list[int]:
        """Return the patterns of the limits, their neighbours, both zeros, the infinities and NaN."""
        numbers = [number for limit in self._finite() for number in (limit, *self._neighbours(limit))]
        return [*self.patterns((0.0, -0.0, *numbers, inf, -inf, nan)), _SIGNALLING[self.shape.width]]

    def patterns_to_count(self) -> list[int]:
        """Return the patterns of small, large and typical numbers, and of no numbers."""
        edges = [_LAST_COUNT // self.tens * each for each in (1.0, -1.0, 0.5, 1.1)]
        halves = (half / self.tens for half in (0.25, 0.49, 0.5, 0.51, -0.5, 1.5, -2.5, 12345.5))
        numbers = (*_DECODED[32], *edges, *halves, 2.0**23, -(2.0**24), 2.0**30, 2.0**63, inf, -inf, nan, -nan)
        return [*self.patterns(numbers), *codes(self.shape), _SIGNALLING[32]]

    def counts(self) -> list[int]:
        """Return small, large and typical counts, and those around limits and special codes."""
        edges = [*(end for pair in self.limits for end in pair), *map(self._number, codes(self.shape)), 2.0**24 + 1]
        whole = [int(edge * self.tens) for edge in edges if abs(edge) * self.tens < _LAST_COUNT]
        few = (0, 1, -1, 7, 215, 16777217, 33554431, 167772155, _LAST_COUNT, -_LAST_COUNT - 1)
        return [*few, *(count + step for count in whole for step in (-1, 0, 1))]

    def values(self, *, deep: bool) -> Iterator[float]:
        """Yield the limits and their neighbours; if `deep`, also special codes, ties and no numbers."""
        if not deep:
            yield 0.1
            for low, high in self.limits:
                yield from (low, high, nextafter(low, -inf), nextafter(high, inf))
            return
        yield from (0.0, -0.0, 0.1, -1.5, *filter(isfinite, map(self._number, codes(self.shape))))
        for limit in self.units:
            yield from (limit, nextafter(limit, inf), nextafter(limit, -inf), limit - 1, limit + 1)
        if self.shape.width == 32:
            yield from (*_TIES, _BEYOND_32, -_BEYOND_32, nextafter(_BEYOND_32, 0), nextafter(-_BEYOND_32, 0))
            # for each limit: the middle between it and each neighbour in the type, and the values next to that middle
            for limit in self._finite() if self.units else ():
                for neighbour in self._neighbours(limit):
                    half = (limit + neighbour) / 2  # exact, because both are binary32 numbers
                    yield from (limit, half, nextafter(half, limit), nextafter(half, neighbour))
        yield from (nan, inf, -inf, 1e300, -1e300)

    def _finite(self) -> list[float]:
        return [limit for pair in self.limits for limit in pair if isfinite(limit)]

    def _neighbours(self, value: float) -> list[float]:
        """Return the next numbers of the type below and above a number of the type."""
        if self.shape.width == 64:
            return [nextafter(value, -inf), nextafter(value, inf)]
        if value == 0:
            return [-(2.0**-149), 2.0**-149]
        bits = bits_of(value, 32)  # patterns are ordered by magnitude for either sign
        return [next_one for step in (-1, 1) if isfinite(next_one := float_of_bits(bits + step, 32))]
