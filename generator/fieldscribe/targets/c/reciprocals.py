"""Quotients without a division: a multiplication and a shift, proven exact for every number of a range."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple


class Reciprocal(NamedTuple):
    """number * num / den = number * (much + little / 2^fine) / 2^bits, to the nearest integer, halves away from zero."""

    much: int
    little: int
    fine: int
    bits: int


@lru_cache(maxsize=4096)
def reciprocal(low: int, high: int, num: int, den: int, most: int) -> Reciprocal | None:
    """The smallest one that is exact for all numbers of low..high; None where no intermediate up to `most` suffices."""
    size = max(abs(low), abs(high), 1)
    for bits in range(1, most.bit_length()):
        much = (num << bits) // den
        if size * (much + 1) + (1 << bits) > most:
            return None
        found = _finest(low, high, num, den, most, bits)
        if found is not None:
            return found
    return None


def _finest(low: int, high: int, num: int, den: int, most: int, bits: int) -> Reciprocal | None:
    """The one with that many bits and the fewest `fine` bits, if any."""
    size = max(abs(low), abs(high), 1)
    much, rest = divmod(num << bits, den)
    for fine in range(most.bit_length()):
        little = -(-(rest << fine) // den)
        if size * little > most:
            return None
        one = Reciprocal(much, little, fine, bits)
        if _is_exact(one, low, high, num, den):
            return one
    return None


def _is_exact(one: Reciprocal, low: int, high: int, num: int, den: int) -> bool:
    """Whether no number of low..high is rounded to another integer than its exact quotient.

    The factor is too large by `error` / (den * 2^shift). Quotients and a half are multiples of 1 / (2 * den), of 1 / den
    where that is even: an error below that never reaches the next integer from below, and one up to it leaves those of
    negative numbers above the integer before. Halves, which an even divisor alone has, need an error where they are
    negative: they round away from zero.
    """
    shift = one.bits + one.fine
    error = ((one.much << one.fine) + one.little) * den - (num << shift)
    parts = 1 if den % 2 == 0 else 2
    if low < 0 and den % 2 == 0 and error == 0:
        return False
    return parts * max(high, 0) * error < 1 << shift and parts * max(-low, 0) * error <= 1 << shift
