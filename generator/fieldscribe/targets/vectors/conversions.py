"""Raw numbers, values and counts of one shape under one ratio: each is worked out once, however many limits there are.

Nothing here knows limits: what may be written is asked anew for every sheet.
"""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

from fieldscribe.targets.vectors import samples
from fieldscribe.targets.vectors.kinds import Written, real
from fieldscribe.targets.vectors.numbers import quotient
from fieldscribe.targets.vectors.oracle import INT64, Ratio, code_of

if TYPE_CHECKING:
    from fieldscribe.model import Shape

INT32 = 1 << 31


class Conversions:
    """Between the raw numbers of a shape, their values, and their counts of 10^-decimals units."""

    def __init__(self, shape: Shape, ratio: Ratio) -> None:
        self.shape, self.ratio, self._decimals = shape, ratio, shape.decimals or 0
        telling = samples.raw_telling_division(ratio)
        self.telling = () if telling is None or not shape.least <= telling <= shape.greatest else (telling,)
        """The raw number that tells a division from a product with the reciprocal."""
        self.value, self.decoded, self.encoded = cache(self._value), cache(self._decoded), cache(self._encoded)
        self.count, self.counted = cache(self._count), cache(self._counted)
        self.raw_of_count, self.outside = cache(self._raw_of_count), cache(self._outside)

    def _value(self, raw: int) -> float:
        """The binary64 nearest to the value of a raw number."""
        return quotient(self.ratio.numerator(raw), self.ratio.denominator)

    def _outside(self, raw: int, side: int) -> float:
        """The value a quarter of a raw step below (side -1) or above it (side 1), which rounds to the number."""
        step = self.ratio.numerator(1) - self.ratio.numerator(0)
        return quotient(4 * self.ratio.numerator(raw) + side * step, 4 * self.ratio.denominator)

    def _decoded(self, raw: int) -> tuple[object, ...]:
        """Status and value; nothing where languages may differ in the last place."""
        shape, ratio = self.shape, self.ratio
        if (code := code_of(shape, raw)) is not None:
            return "special", None, code.name
        if self._is_too_large(raw):
            return ("overflow",)
        if ratio.divides_exactly(raw) or not (shape.scale_arguments and shape.encodes_values):
            return "ok", ratio.numerator(raw) / ratio.denominator
        return ()

    def _encoded(self, value: float) -> tuple[Written, int | None]:
        """A finite value as it is written, and its raw number; None if a step overflows."""
        return Written(real(value)), self.ratio.raw_of_float(value)

    def _count(self, raw: int) -> int:
        """The count of a raw number, whether or not it fits an integer."""
        return self.ratio.count_of_raw(raw, self._decimals)

    def _counted(self, raw: int) -> tuple[object, ...]:
        """Status and count."""
        if (code := code_of(self.shape, raw)) is not None:
            return "special", None, code.name
        count = self.count(raw)
        fits = -INT64 <= count < INT64 and not self._is_too_large(raw)
        return ("ok", count) if fits else ("overflow",)

    def _raw_of_count(self, count: int) -> int:
        """The raw number of a count."""
        return self.ratio.raw_of_count(count, self._decimals)

    def _is_too_large(self, raw: int) -> bool:
        """Whether a raw number is too large to compute with."""
        return self.shape.most_raw is not None and abs(raw) > self.shape.most_raw

    @property
    def edge(self) -> int:
        """The first count beyond the integers that hold all counts of the type."""
        ends = (self.count(self.shape.least), self.count(self.shape.greatest))
        return INT32 if all(-INT32 <= count < INT32 for count in ends) else INT64
