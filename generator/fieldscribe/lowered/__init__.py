"""The lowered model: what all compiled languages need to know of a device, worked out once, in numbers.

It stands between the model and the views of C, Rust and Python: the integers of a scale and their widths, and what is
known of the points that a rule needs. A view asks it and writes the answer in its own language.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from functools import cached_property
from typing import NamedTuple

from fieldscribe.arithmetic.codec import powers_last
from fieldscribe.lowered.plans import Plan, plan_of
from fieldscribe.lowered.template_keys import TemplateKeys
from fieldscribe.model import Device, Enum, Erratum, Factor, Linear, Point, Shape

__all__ = ["Lowered", "Operand", "Plan", "Rule", "lower", "named_numbers", "plan_of"]


Band = tuple[int, int]

_MANTISSA = 1 << 24
"""The limit of the mantissa of a binary32 number."""


class Operand(NamedTuple):
    """A factor of a rule, with what is known of its point.

    `held` are the least and greatest raw number of its type. `within` are the raw numbers with which the rule
    is computed; None for all. `codes` are its special codes, which are no quantities. A `floating` factor is a
    value, a mantissa of 24 bits times a power of two; any other is raw * slope + intercept, which lies between `ends`.
    """

    factor: Factor
    floating: bool
    held: Band
    within: Band | None
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


class Lowered:
    """A device in numbers. `points` finds points by item, and by name (of variants the first)."""

    def __init__(self, device: Device) -> None:
        self.device = device
        self.points: Mapping[str, Point] = _by_name(device)
        self._rules: dict[Linear, Rule] = {}
        self._errata = {erratum.id: erratum for erratum in device.errata if erratum.facts or erratum.leaves_open}

    def rule(self, linear: Linear) -> Rule:
        """Return the lowered rule, shared by all points that have the same."""
        lowered = self._rules.get(linear)
        if lowered is None:
            lowered = self._rules[linear] = _rule(linear, self.points)
        return lowered

    def errata_of(self, point: Point) -> tuple[list[str], list[Erratum]]:
        """Return the ids of errata that change a fact of the point, and those that leave one open.

        Others are in the documentation only.
        """
        errata = [self._errata[name] for name in point.errata if name in self._errata]
        return [each.id for each in errata if not each.leaves_open], [each for each in errata if each.leaves_open]

    @cached_property
    def template_keys(self) -> Mapping[int, int]:
        """The template key of each point, by the point's id."""
        key_of = TemplateKeys().of
        return {id(point): key_of(point) for point in self.device.points}


_kept: list[Lowered] = []
"""The devices that were lowered last: the one that is compiled, and its sample for the proof of distinct names."""


def lower(device: Device) -> Lowered:
    """Return the lowered model of a device, made once for all that ask for the same points and errata."""
    for lowered in tuple(_kept):
        if lowered.device.points is device.points and lowered.device.errata is device.errata:
            return lowered
    made = Lowered(device)
    _kept[:] = [made, *_kept[:1]]
    return made


def named_numbers(shape: Shape) -> Enum | None:
    """Return the enum that names the numbers of points, or each of their digits."""
    return shape.enum if shape.digits is None else shape.digits.enum


def _by_name(device: Device) -> dict[str, Point]:
    points = {point.item: point for point in reversed(device.points)}
    for point in device.points:
        if point.variant is not None:
            points.setdefault(point.name, point)
    return points


def _rule(linear: Linear, points: Mapping[str, Point]) -> Rule:
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
        within=(factor.within or point.outer) if factor.ten_to else factor.within,
        codes=tuple([(code.low, code.high) for code in point.specials]),
        ends=(-_MANTISSA, _MANTISSA) if floating else (low, high),
    )
