"""Quotients without a division: a multiplication and a shift, proven exact for every number of a range."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple


class Reciprocal(NamedTuple):
    """Computes number * ratio, rounded to nearest, as number * (much + little / 2^fine) / 2^bits."""

    much: int
    little: int
    fine: int
    bits: int


class Numbers(NamedTuple):
    """The numbers from low to high, to be multiplied by num / den; num and den are positive."""

    low: int
    high: int
    num: int
    den: int

    @property
    def size(self) -> int:
        """The greatest magnitude of the numbers."""
        return max(abs(self.low), abs(self.high), 1)


def reciprocal(numbers: Numbers, most: int) -> Reciprocal | None:
    """The reciprocal with the fewest bits that is exact for all numbers; None if intermediates would exceed `most`.

    What fails for some numbers fails for more: the first reciprocal for fewer numbers is the first here if it serves.
    """
    met = _met(numbers.num, numbers.den, most)
    for factors, fewer in met.items():
        if numbers.low <= fewer.low and fewer.high <= numbers.high and (not factors or _serves(factors, numbers, most)):
            return factors
    first = _fewest(numbers, most)
    met[first] = numbers
    return first


@lru_cache(maxsize=4096)
def _met(_num: int, _den: int, _most: int) -> dict[Reciprocal | None, Numbers]:
    """The reciprocals of a ratio that were found, with the numbers for which they were."""
    return {}


def _serves(factors: Reciprocal, numbers: Numbers, most: int) -> bool:
    """Whether a reciprocal is exact for all numbers, and no intermediate exceeds `most`."""
    whole = numbers.size * (factors.much + 1) + (1 << factors.bits) <= most
    return whole and numbers.size * factors.little <= most and _is_exact(factors, numbers)


def _fewest(numbers: Numbers, most: int) -> Reciprocal | None:
    for bits in range(1, most.bit_length()):
        much = (numbers.num << bits) // numbers.den
        if numbers.size * (much + 1) + (1 << bits) > most:
            return None
        finest = _finest(numbers, most, bits)
        if finest is not None:
            return finest
    return None


def _finest(numbers: Numbers, most: int, bits: int) -> Reciprocal | None:
    """The exact reciprocal with that many bits and the fewest `fine` bits, if there is one."""
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
    """Whether every number gives the same integer as its exact quotient rounded.

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
