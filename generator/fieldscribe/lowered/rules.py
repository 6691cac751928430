"""Rules that depend on other points, with what is known of those points."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from fieldscribe.arithmetic.codec import powers_last

if TYPE_CHECKING:
    from collections.abc import Mapping
    from fractions import Fraction

    from fieldscribe.model import Factor, Linear, Point

Band = tuple[int, int]

_MANTISSA = 1 << 24
"""The limit of the mantissa of a binary32 number."""


class Operand(NamedTuple):
    """A factor of a rule, with what is known of its point.

    `held` are the least and greatest raw number of its type. `exponents` are the raw numbers for which a power of ten
    is defined; None for other factors. `codes` are its special codes, which are no quantities. A `floating` factor is a
    value, a mantissa of 24 bits times a power of two; any other is raw * slope + intercept, which lies between `ends`.
    """

    factor: Factor
    floating: bool
    held: Band
    exponents: Band | None
    codes: tuple[Band, ...]
    ends: Band

    @property
    def largest(self) -> int:
        """The greatest magnitude of the operand; of a floating one, of its mantissa."""
        return max(abs(self.ends[0]), abs(self.ends[1]), 1)

    @property
    def over(self) -> bool:
        """Whether the rule divides by the operand."""
        return self.factor.power < 0


class Rule(NamedTuple):
    """result = argument * ratio * product(operands) + offset; `steps`: the operands in the order of generated code."""

    ratio: Fraction
    offset: Fraction
    operands: tuple[Operand, ...]
    steps: tuple[Operand, ...]

    @property
    def coded(self) -> tuple[tuple[str, Band], ...]:
        """The special codes of each operand's point: while it holds one, the rule cannot be computed."""
        by_point = {operand.factor.point: operand.codes for operand in self.operands}
        return tuple((name, band) for name, codes in by_point.items() for band in codes)


def rule_of(linear: Linear, points: Mapping[str, Point]) -> Rule:
    """Return a rule with its operands."""
    known = {id(factor): _operand(factor, points[factor.point]) for factor in linear.factors}
    return Rule(
        linear.ratio,
        linear.offset,
        tuple([known[id(factor)] for factor in linear.factors]),
        tuple([known[id(factor)] for factor in powers_last(linear)]),
    )


def _operand(factor: Factor, point: Point) -> Operand:
    floating = point.info.floating
    assert not floating or (factor.slope, factor.intercept, factor.ten_to) == (1, 0, False)
    low, high = sorted(raw * factor.slope + factor.intercept for raw in point.held)
    return Operand(
        factor=factor,
        floating=floating,
        held=point.held,
        exponents=(factor.exponents or point.outer) if factor.ten_to else None,
        codes=tuple([(code.low, code.high) for code in point.specials]),
        ends=(-_MANTISSA, _MANTISSA) if floating else (low, high),
    )
