"""Raw numbers, values and counts of one shape under one ratio: each is worked out once, however many limits there are.

So are the lines that tell them, as far as they follow from them.
Nothing here knows limits: what may be written is asked anew for every sheet.
"""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

from fieldscribe.targets.vectors import samples
from fieldscribe.targets.vectors.kinds import line_of, real
from fieldscribe.targets.vectors.numbers import quotient
from fieldscribe.targets.vectors.oracle import INT64, Ratio, code_of

if TYPE_CHECKING:
    from fieldscribe.model import Shape

INT32 = 1 << 31

Encoding = tuple[str, int | None, str]
"""The line of a vector up to its status, the raw number (None if there is none), and the line if it may be written."""


class Conversions:
    """Between the raw numbers of a shape, their values, and their counts of 10^-decimals units."""

    def __init__(self, shape: Shape, ratio: Ratio) -> None:
        self.shape, self.ratio, self._decimals = shape, ratio, shape.decimals or 0
        telling = samples.raw_telling_division(ratio)
        self.telling = () if telling is None or not shape.least <= telling <= shape.greatest else (telling,)
        """The raw number that tells a division from a product with the reciprocal."""
        self.value, self.decoded, self.encoded = cache(self._value), cache(self._decoded), cache(self.encode_anew)
        self.count, self.counted = cache(self._count), cache(self._counted)
        self.encoded_count, self.outside = cache(self._encoded_count), cache(self._outside)

    def _value(self, raw: int) -> float:
        """The binary64 nearest to the value of a raw number."""
        return quotient(self.ratio.numerator(raw), self.ratio.denominator)

    def _outside(self, raw: int, side: int) -> float:
        """The value a quarter of a raw step below (side -1) or above it (side 1), which rounds to the number."""
        step = self.ratio.numerator(1) - self.ratio.numerator(0)
        return quotient(4 * self.ratio.numerator(raw) + side * step, 4 * self.ratio.denominator)

    def _decoded(self, raw: int) -> str:
        """The line that tells status and value; empty where languages may differ in the last place."""
        shape, ratio = self.shape, self.ratio
        if (code := code_of(shape, raw)) is not None:
            return line_of("decode", raw, "special", None, code.name)
        if self._is_too_large(raw):
            return line_of("decode", raw, "overflow")
        if ratio.divides_exactly(raw) or not (shape.scale_arguments and shape.encodes_values):
            return f"decode\t{raw}\tok\t{real(ratio.numerator(raw) / ratio.denominator)}"
        return ""

    def encode_anew(self, value: float) -> Encoding:
        """The lines of a finite value, without a raw number if a step overflows. To a cache, 0 and -0 are the same."""
        told, raw = f"encode\t{real(value)}\t", self.ratio.raw_of_float(value)
        return told, raw, f"{told}ok\t{raw}"

    def _count(self, raw: int) -> int:
        """The count of a raw number, whether or not it fits an integer."""
        return self.ratio.count_of_raw(raw, self._decimals)

    def _counted(self, raw: int) -> str:
        """The line that tells status and count."""
        if (code := code_of(self.shape, raw)) is not None:
            return line_of("decode_count", raw, "special", None, code.name)
        count = self.count(raw)
        fits = -INT64 <= count < INT64 and not self._is_too_large(raw)
        return f"decode_count\t{raw}\tok\t{count}" if fits else line_of("decode_count", raw, "overflow")

    def _encoded_count(self, count: int) -> Encoding:
        """The lines of a count."""
        told, raw = f"encode_count\t{count}\t", self.ratio.raw_of_count(count, self._decimals)
        return told, raw, f"{told}ok\t{raw}"

    def _is_too_large(self, raw: int) -> bool:
        """Whether a raw number is too large to compute with."""
        return self.shape.most_raw is not None and abs(raw) > self.shape.most_raw

    @property
    def edge(self) -> int:
        """The first count beyond the integers that hold all counts of the type."""
        ends = (self.count(self.shape.least), self.count(self.shape.greatest))
        return INT32 if all(-INT32 <= count < INT32 for count in ends) else INT64
