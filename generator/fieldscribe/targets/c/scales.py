"""Scales that are known at compile time, as C expressions whose integers are proven to fit.

Counts and raw numbers are converted without a division if a multiplication and a shift are proven exact for every
number that can occur.
"""

from __future__ import annotations

from functools import cached_property, lru_cache
from typing import NamedTuple

from fieldscribe.arithmetic.exact import Line
from fieldscribe.arithmetic.words import INT32, INT64
from fieldscribe.lowered import Plan, plan_of
from fieldscribe.model import Point
from fieldscribe.targets.c.syntax import bare, cast, raw_type, real, sign_and_size, signed, unsigned

_EXACT = 1 << 53


class Scaled:
    """The expressions of a scale without run-time factors; `low` and `high` are the outer raw limits of the point.

    `inside` is the test that the raw number of a count may be written, empty if it always may. `counts` are the
    counts inside. `direct` says that a count equals its raw number. `wide` says that values are always double.
    """

    def __init__(self, point: Point, low: int, high: int) -> None:
        plan = plan_of(point.shape)
        self._point, self._plan, self.counts = point, plan, plan.counts(low, high)
        self.direct, self.wide = plan.direct, not plan.fits_float
        self.count_type = "int64_t" if plan.count_wide else "int32_t"
        open_ended = self.counts == (INT64 if plan.count_wide else INT32)
        self.inside = "" if open_ended else f"fieldscribe_within{'_wide' if plan.count_wide else ''}"

    @cached_property
    def count_fits(self) -> str:
        """The test that the count of a raw number fits 64 bits; empty if every count does."""
        if self._plan.beyond is None:
            return ""
        low, high = self._plan.beyond
        if max(self._plan.raws) > INT64[1]:
            return f"fieldscribe_within_u64(raw, {unsigned(low)}, {unsigned(high)})"
        return f"fieldscribe_within_wide(raw, {bare(low)}, {bare(high)})"

    @cached_property
    def exact_count(self) -> str:
        """The status of computing the exact count of a raw number that fails `count_fits`; it may still fit 64 bits."""
        if self.direct:
            return "FIELDSCRIBE_OVERFLOW"
        factor, add, divisor = self._plan.to_count
        below, size = sign_and_size(self._point)
        negative = {"false": "true", "raw < 0": "raw >= 0"}[below] if factor < 0 else below
        numbers = [unsigned(abs(factor)), "true" if add < 0 else "false", unsigned(abs(add)), unsigned(divisor)]
        return f"fieldscribe_exact_count({negative}, {size}, {', '.join(numbers)}, count)"

    @cached_property
    def raw_of_count(self) -> str:
        """The raw number of a `count` that is inside."""
        return cast(raw_type(self._point), _raw_of_count(self._plan, self.counts))

    @property
    def count_of_raw(self) -> str:
        """The count of `raw`, cast to its type if C needs that."""
        number, wide = _count_of_raw(self._plan)
        becomes = self._plan.raws[1] <= INT64[1] and (self._plan.count_wide or not wide)
        return number if becomes else cast(self.count_type, number)

    @property
    def steps(self) -> str:
        """The unrounded raw number of `value`: times, divided by, plus; each step is rounded to floating point."""
        ratio, offset = self._plan.rule.ratio, self._plan.rule.offset
        kind, tail = ("double", "_wide") if self.wide else ("fieldscribe_real", "")
        text = "value" if ratio.numerator == 1 else f"fieldscribe_times{tail}(value, {_constant(ratio.numerator)})"
        if ratio.denominator != 1:
            text = f"{text} / ({kind}){_constant(ratio.denominator)}"
        if offset:
            number = real(abs(offset)) if offset.denominator != 1 else str(abs(offset))
            text = f"({text})" if " / " in text else text
            text += f" {'-' if offset < 0 else '+'} ({kind}){number}"
        return text

    @property
    def value_of_raw(self) -> str:
        """The value of `raw`; if numerators exceed 53 bits, (raw * factor + add) / divisor rounded once."""
        plan, (factor, add, divisor) = self._plan, self._plan.to_value
        if max(plan.numerator, divisor) > _EXACT:
            below, size = sign_and_size(self._point)
            above = "raw >= 0" if self._point.info.signed else "true"
            numbers = [unsigned(abs(factor)), "true" if add < 0 else "false", unsigned(abs(add)), unsigned(divisor)]
            return f"fieldscribe_quotient({above if factor < 0 else below}, {size}, {', '.join(numbers)})"
        line = linear("raw", factor, add, "int64_t" if plan.numerator > INT32[1] else "int32_t")
        number = "raw" if factor == 1 and add == 0 else line
        return f"fieldscribe_ratio{'_wide' if self.wide else ''}({number}, {divisor})"


def _constant(number: int) -> str:
    """Return an integer as a constant; beyond 2^53 as the nearest double."""
    return bare(number) if abs(number) <= _EXACT else f"{number}.0"


def linear(name: str, factor: int, add: int, cast: str) -> str:
    """Return `name * factor + add`, without a factor of 1 and an addend of 0."""
    start = f"({cast}){name}" if cast else name
    if factor == -1:
        start = f"-{start}"
    elif factor != 1:
        start = f"{start} * {signed(factor)}"
    if add == 0:
        return start
    start = f"({start})" if " * " in start else start
    return f"{start} {'-' if add < 0 else '+'} {abs(add)}"


def _raw_of_count(plan: Plan, counts: tuple[int, int]) -> str:
    """Return the raw number of a `count` that is one of these."""
    factor, add, divisor = plan.to_raw
    encode_wide = plan.encode_wide(counts)
    wider = "int64_t" if encode_wide and not plan.count_wide else ""
    line = linear("count", factor, add, wider)
    if divisor == 1:
        return line
    if add == 0:
        numbers = Numbers(*counts, factor, divisor)
        narrow, wide = ("(int32_t)count", "count") if plan.count_wide else ("count", "(int64_t)count")
        quotient = _quotient(narrow, numbers, wide=False) or _quotient(wide, numbers, wide=True)
    else:
        numbers = _numerators(counts, plan.to_raw)
        quotient = "" if encode_wide or plan.count_wide else _quotient(line, numbers, wide=False)
        quotient = quotient or _quotient(line, numbers, wide=True)
    return quotient or f"fieldscribe_divide({line}, {divisor})"


def _numerators(ends: tuple[int, int], line: Line) -> Numbers:
    """Return the numerators of the line's division, for the arguments between two ends."""
    low, high = sorted(end * line.factor + line.add for end in ends)
    return Numbers(low, high, 1, line.divisor)


def _quotient(number: str, numbers: Numbers, *, wide: bool) -> str:
    """Return an expression for number * num / den, rounded, without a division; empty if none is proven exact."""
    most = (INT64 if wide else INT32)[1]
    if numbers.size > most:
        return ""
    if numbers.num < 0:
        turned = Numbers(-numbers.high, -numbers.low, -numbers.num, numbers.den)
        return _quotient(f"-{number}", turned, wide=wide)
    tail, bits = "_wide" if wide else "", numbers.den.bit_length() - 1
    if numbers.den == 1 << bits and numbers.size * numbers.num + numbers.den <= most:
        return f"fieldscribe_halves{tail}({linear(number, numbers.num, 0, '')}, {bits}U)"
    factors = reciprocal(numbers, most)
    if factors is None:
        return ""
    much, little, fine, shift = factors
    return f"fieldscribe_nearly{tail}({number}, {much}, {little}, {fine}U, {shift}U)"


def _count_of_raw(plan: Plan) -> tuple[str, bool]:
    """Return the expression for the count of a raw number, and whether its type has 64 bits."""
    wide = plan.decode_wide
    if plan.direct:
        return "raw", wide
    to_count = plan.to_count
    line = linear("raw", to_count.factor, to_count.add, "int64_t" if wide else "int32_t")
    if to_count.divisor == 1:
        return line, wide
    numbers = _numerators(plan.beyond or plan.raws, to_count)
    narrow = "" if wide else _quotient(line, numbers, wide=False)
    if narrow:
        return narrow, False
    return _quotient(line, numbers, wide=True) or f"fieldscribe_divide({line}, {to_count.divisor})", True


class Reciprocal(NamedTuple):
    """Computes number * ratio, rounded to nearest, as number * (much + little / 2^fine) / 2^bits."""

    much: int
    little: int
    fine: int
    bits: int


class Numbers(NamedTuple):
    """The numbers from low to high that are multiplied by num / den; num and den are positive."""

    low: int
    high: int
    num: int
    den: int

    @property
    def size(self) -> int:
        """The greatest magnitude of the numbers."""
        return max(abs(self.low), abs(self.high), 1)


@lru_cache(maxsize=4096)
def reciprocal(numbers: Numbers, most: int) -> Reciprocal | None:
    """Return the exact reciprocal with the fewest bits; None if intermediate results would exceed `most`."""
    for bits in range(1, most.bit_length()):
        much = (numbers.num << bits) // numbers.den
        if numbers.size * (much + 1) + (1 << bits) > most:
            return None
        finest = _finest(numbers, most, bits)
        if finest is not None:
            return finest
    return None


def _finest(numbers: Numbers, most: int, bits: int) -> Reciprocal | None:
    """Return the exact reciprocal with this many bits and the fewest `fine` bits; None if there is none."""
    much, rest = divmod(numbers.num << bits, numbers.den)
    for fine in range(most.bit_length()):
        little = -(-(rest << fine) // numbers.den)
        if numbers.size * little > most:
            return None
        candidate = Reciprocal(much, little, fine, bits)
        if _is_exact(candidate, numbers):
            return candidate
    return None


def _is_exact(reciprocal: Reciprocal, numbers: Numbers) -> bool:
    """Return True if every number gives the same integer as its exact quotient rounded.

    The factor is too large by `error` / (den * 2^shift). The distance of a quotient from the next half is a multiple of
    1 / (2 * den), or of 1 / den if den is even. So a positive number is right if its error is less than that distance,
    a negative one if it is at most that. Exact halves occur only if den is even; negative ones need some error, because
    they round away from zero.
    """
    shift, even = reciprocal.bits + reciprocal.fine, numbers.den % 2 == 0
    error = ((reciprocal.much << reciprocal.fine) + reciprocal.little) * numbers.den - (numbers.num << shift)
    if numbers.low < 0 and even and error == 0:
        return False
    parts = 1 if even else 2
    above, below = (parts * max(end, 0) * error for end in (numbers.high, -numbers.low))
    return above < 1 << shift and below <= 1 << shift
