# SPDX-License-Identifier: 0BSD
"""Forms whose raw number is not the value: scaled quantities and IEEE 754 numbers."""

from __future__ import annotations

import math
import struct
import sys
from typing import TYPE_CHECKING, TypeVar

from .arguments import shown, whole
from .errors import NotANumberError, ResultOverflowError, WrongTypeError
from .fast import (
    checked,
    from_pattern,
    rounded,
    scaled,
    scaled_by,
    to_pattern,
    unchecked,
)
from .forms import Form, fixed_ends
from .rules import NO_RAWS, Case, Rule, chosen, decimal_text, outside

if TYPE_CHECKING:
    from .fast import Way
    from .forms import Allowed, Type
    from .rules import Raws


N = TypeVar("N", int, float)

_BINARY32 = struct.Struct("<f"), struct.Struct("<I")
_BINARY64 = struct.Struct("<d"), struct.Struct("<Q")


def _is_nan(value: float) -> bool:
    """Return True for NaN; raises WrongTypeError for what is no number, and OverflowError far beyond floats."""
    if isinstance(value, bool):
        raise WrongTypeError(f"takes a number, not {value}")
    try:
        return math.isnan(value)
    except TypeError:
        raise WrongTypeError(f"takes a number, not {shown(value)}") from None
    except ValueError:  # a signalling NaN
        return True


class Scaled(Form[float, float]):
    """A quantity: raw = value by a rule, or by the first of several cases that fits.

    With `decimals` None no 64-bit integer holds its counts, and there are none. Unless it `encodes`, numbers of its
    scale have more bits than a float, and values are only decoded. Raw numbers beyond `most` in size overflow.
    """

    def __init__(
        self,
        wire: Type,
        rule: Rule | tuple[Case, ...],
        *,
        decimals: int | None,
        encodes: bool = True,
        most: int | None = None,
    ) -> None:
        self.wire = wire
        self.rule = rule
        self.decimals = decimals
        self.encodes = encodes
        self.most = most
        cases = (Case(None, None, rule),) if isinstance(rule, Rule) else rule
        names = [name for case in cases for name in (case.point, *(factor.point for factor in case.rule.factors))]
        self.needs = tuple(dict.fromkeys(name for name in names if name is not None))

    def quick_decode(self, low: int, high: int, slow: Way) -> Way:
        """By a scale that is fixed, or that one other point decides."""
        if not isinstance(self.rule, Rule):
            return slow
        if self.most is not None:
            low, high = max(low, -self.most), min(high, self.most)
        if self.rule.factors:
            return checked(scaled_by(self.rule, low, high, slow), (low, high), self.needs, slow)
        return scaled(self.rule.line(NO_RAWS), low, high, slow) if self.rule.is_safe(NO_RAWS, low, high) else slow

    def sure_decode(self, low: int, high: int, slow: Way) -> Way:
        """By a scale that is fixed, or that other points decide, whatever the raw number is."""
        rule = self.rule
        if not isinstance(rule, Rule) or self.most is not None:
            return self.quick_decode(low, high, slow)
        if rule.factors:
            return scaled_by(rule, low, high, slow)
        return unchecked(rule.line(NO_RAWS)) if rule.is_safe(NO_RAWS, low, high) else slow

    def quick_encode(self, allowed: Allowed, slow: Way) -> Way:
        """By a fixed scale into one fixed range."""
        ends = fixed_ends(allowed)
        if not self.encodes or ends is None or not isinstance(self.rule, Rule) or self.rule.factors:
            return slow
        steps = self.rule.steps()
        return slow if steps is None else rounded(steps, *ends, slow)

    def _counted(self) -> int:
        """Return the decimals of the counts; raises WrongTypeError where there are none."""
        if self.decimals is None:
            raise WrongTypeError("no 64-bit integer holds the counts, so there are none: use raw numbers or values")
        return self.decimals

    def _rule(self, raws: Raws) -> Rule:
        return self.rule if isinstance(self.rule, Rule) else chosen(self.rule, raws)

    def decode(self, raw: int, raws: Raws) -> float:
        """Return the binary64 nearest to the exact value."""
        return self._bounded(raw, self._rule(raws).decode(raw, raws))

    def converted(self, value: float, raws: Raws) -> int | None:
        """Rounded to nearest, halves away from zero."""
        if not self.encodes:
            raise WrongTypeError(
                "numbers of this scale have more than 53 bits, so values are only decoded: use raw numbers"
            )
        try:
            if _is_nan(value):
                raise NotANumberError("the value is NaN")
        except OverflowError:
            return None
        return self._rule(raws).encode(value, raws)

    def decode_count(self, raw: int, raws: Raws) -> int:
        """Return the count nearest to the exact value, by integers alone."""
        return self._bounded(raw, self._rule(raws).decode_count(raw, self._counted(), raws))

    def _bounded(self, raw: int, found: N) -> N:
        """Return what was found; raises ResultOverflowError where the other languages cannot compute it exactly."""
        if self.most is not None and abs(raw) > self.most:
            raise ResultOverflowError(f"raw {raw} is beyond {self.most}, up to which the scale is exact")
        return found

    def bounds(self, low: int, high: int) -> tuple[float, float] | None:
        """Return the values, where no other point decides them."""
        if self.needs:
            return None
        ends = self.decode(low, NO_RAWS), self.decode(high, NO_RAWS)
        return min(ends), max(ends)

    def converted_count(self, count: int, raws: Raws) -> int:
        """As `converted`, by integers alone."""
        return self._rule(raws).encode_count(whole(count), self._counted(), raws)

    def shown(self, raw: int, raws: Raws, display: int | None = None) -> str:
        """Return the value, as people read it; with `display` rounded from the exact one."""
        if display is None:
            return f"{self.decode(raw, raws):.12g}"
        if self.needs:  # as counts, which other languages compute in 64 bits
            count = self._bounded(raw, self._rule(raws).decode_count(raw, display, raws))
            return decimal_text(count, 10**display, display)
        times, less, over = self._rule(raws).line(raws)
        return decimal_text(raw * times - less, over, display)


class Floating(Form[float, float]):
    """An IEEE 754 number (`F32` or `F64`): the raw number is its bit pattern; limits are in the unit.

    Limits hold as the nearest numbers of the type, so that no value is refused that the type cannot tell from a limit.
    """

    def __init__(self, wire: Type, *, units: tuple[tuple[float, float], ...] = ()) -> None:
        self.wire = wire
        self.units = units
        self._limits = tuple((self._nearest(low), self._nearest(high)) for low, high in units)

    @property
    def _structs(self) -> tuple[struct.Struct, struct.Struct]:
        """What takes the bits for a number, and for an integer."""
        return _BINARY32 if self.wire.bits == 32 else _BINARY64

    def sure_decode(self, low: int, high: int, slow: Way) -> Way:
        """Return the number that the bits are."""
        del low, high, slow
        return from_pattern(*self._structs)

    def quick_encode(self, allowed: Allowed, slow: Way) -> Way:
        """Return the nearest number of the type within one pair of limits, or any finite one."""
        if len(self._limits) > 1:
            return slow
        low, high = self._limits[0] if self._limits else (-sys.float_info.max, sys.float_info.max)
        return to_pattern(*self._structs, low, high, slow)

    def decode(self, raw: int, raws: Raws) -> float:
        """Return the number that the bits are."""
        number, word = self._structs
        value: float = number.unpack(word.pack(raw))[0]
        return value

    def converted(self, value: float, raws: Raws) -> int | None:
        """Return the nearest number of the type, ties to even, if that is finite."""
        nearest = self._nearest(value)
        if math.isnan(nearest):
            raise NotANumberError("the value is NaN")
        if math.isinf(nearest):
            return None
        number, word = self._structs
        pattern: int = word.unpack(number.pack(nearest))[0]
        return pattern

    def bounds(self, low: int, high: int) -> tuple[float, float] | None:
        """Return the outer limits, which are in the unit."""
        return (min(self.units)[0], max(self.units)[1]) if self.units else None

    def _nearest(self, value: float) -> float:
        """Return the number of the type nearest to a value; infinity beyond the largest."""
        try:
            if _is_nan(value):
                return math.nan
            number, _ = self._structs
            nearest: float = number.unpack(number.pack(value))[0]
        except (OverflowError, struct.error):  # integers beyond the type raise the latter
            return math.inf if value > 0 else -math.inf
        return nearest

    def _fits(self, number: float) -> bool:
        if math.isnan(number):
            raise NotANumberError("the value is NaN")
        inside = any(low <= number <= high for low, high in self._limits) if self._limits else True
        return inside and math.isfinite(number)

    def checked(self, raw: int, allowed: Allowed, raws: Raws) -> int | None:
        """Return the same bits if they are a number within the limits."""
        inside = 0 <= raw < 1 << self.wire.bits
        return raw if inside and self._fits(self.decode(raw, raws)) else None

    def decode_count(self, raw: int, raws: Raws) -> int:
        """There is none: raises WrongTypeError."""
        raise WrongTypeError("a floating-point number has no counts: use raw numbers or values")

    def converted_count(self, count: int, raws: Raws) -> int:
        """There is none: raises WrongTypeError."""
        raise WrongTypeError("a floating-point number has no counts: use raw numbers or values")

    def shown(self, raw: int, raws: Raws, display: int | None = None) -> str:
        """Return the number, as people read it; with `display` rounded from the exact one."""
        number = self.decode(raw, raws)
        if display is None or not math.isfinite(number):
            return self._shortest(number)
        return decimal_text(*number.as_integer_ratio(), display)

    def _shortest(self, number: float) -> str:
        """Return as few digits, from 6 on, as it takes to be the same number of the type; at most 12."""
        for digits in range(6, 10) if self.wire.bits == 32 else ():
            rounded = float(f"{number:.{digits}g}")
            if self._nearest(rounded) == number:
                return f"{rounded:.12g}"
        return f"{number:.12g}"

    def same(self, raw: int, other: int) -> bool:
        """Return True if both are the same number: 0 and -0 are."""
        return raw == other or self.decode(raw, NO_RAWS) == self.decode(other, NO_RAWS)

    def choices(self, unit: str) -> str | None:
        """Return the limits in the unit; without limits any number of the type may be written."""
        if not self.units:
            return f"no finite binary{self.wire.bits}"
        return outside([(f"{low:.12g}", f"{high:.12g}") for low, high in self.units], unit)
