"""The lowered model: what all compiled languages need to know of a device, computed once, in numbers.

It comes between the model and the views of the targets: the integers of a scale with their widths, and what is known
of the points that a rule needs. A view reads it and writes the answer in its own language.
"""

from collections.abc import Hashable, Mapping
from dataclasses import replace
from fractions import Fraction
from functools import cached_property, lru_cache
from typing import NamedTuple

from fieldscribe.arithmetic.codec import powers_last
from fieldscribe.arithmetic.exact import Line, count_line, nearest, value_line
from fieldscribe.arithmetic.words import INT32, INT64
from fieldscribe.code_view import DeviceCache, has_same_points
from fieldscribe.model import Allowed, Device, Erratum, Factor, Linear, Point, Shape, Terms


class TemplateKeys:
    """Numbers kinds of points: those of a kind have the same text in every target, except for their fields.

    Fields are the name, title, code, group and source of a point, its addresses, the numbers of its references, its
    default, the ends of a single range, and the name of an enum that is called after the point.
    """

    def __init__(self) -> None:
        self._keys: dict[Hashable, int] = {}
        self._shapes: dict[int, int] = {}
        self._terms: dict[int, int] = {}

    def of(self, point: Point) -> int:
        """Return the number of the point's kind."""
        shape, allowed, addresses = point.shape, point.allowed, point.place.addresses
        is_single = point.was or point.variant is not None or point.write_place is not None
        if is_single or allowed.moves or not _is_shared(shape):
            return self._number(point.item)
        references, enum = point.place.references, shape.named_numbers
        is_named_after_point = enum is not None and (enum.name or point.enum_names[0]) == point.item
        return self._number(
            (
                self._shapes.get(id(shape)) or self._of_shape(shape),
                is_named_after_point,
                point.enum_names[is_named_after_point:],
                self._terms.get(id(point.terms)) or self._of_terms(point.terms),
                -len(allowed.intervals) if _is_range(allowed) else id(allowed),
                tuple([address - addresses[0] for address in addresses]) if len(addresses) > 1 else len(addresses),
                tuple(references),
                tuple(map(type, references.values())),
                point.code is None,
                point.default is None,
                point.index,
                point.errata,
            )
        )

    def _number(self, facts: Hashable) -> int:
        return self._keys.setdefault(facts, len(self._keys) + 1)

    def _of_shape(self, shape: Shape) -> int:
        number = self._shapes[id(shape)] = self._number(shape)
        return number

    def _of_terms(self, terms: Terms) -> int:
        number = self._terms[id(terms)] = self._number(replace(terms, group=""))
        return number


def _is_shared(shape: Shape) -> bool:
    """Return False for texts, digits and scales with other points: their code follows from more than the shape."""
    return shape.text is None and shape.digits is None and not shape.scale_arguments


def _is_range(allowed: Allowed) -> bool:
    """Return True if the limits are one range of raw numbers, or none: its ends are fields."""
    return len(allowed.intervals) <= 1 and not allowed.units


EXACT_FLOAT = 1 << 24
"""Every integer up to this one is a binary32 number."""


class Plan(NamedTuple):
    """The integers of a scale: `to_raw` turns counts into raw numbers, `to_count` and `to_value` turn these back.

    `raws` are the raw numbers of the type. `numerator` is the largest integer on the way from a raw number to its
    value. `beyond` are the raw numbers whose counts fit 64 bits, None for all. Each `_wide` says that 32 bits are not
    enough. `fits_float` says that binary32 holds every integer on the way to and from values.

    Every step is linear in its argument, so each intermediate is largest at one end of the arguments. To round a
    quotient, code adds up to half the divisor to the magnitude of the numerator: each proof leaves room for the whole
    divisor. Decoding accepts any raw number that the type holds.
    """

    rule: Linear
    raws: tuple[int, int]
    to_raw: Line
    to_count: Line
    to_value: Line
    count_wide: bool
    decode_wide: bool
    numerator: int
    beyond: tuple[int, int] | None
    fits_float: bool

    @property
    def direct(self) -> bool:
        """True if each raw number is its count."""
        return self.to_raw.does_nothing

    def counts(self, low: int, high: int) -> tuple[int, int]:
        """Return the counts whose raw numbers lie in low..high and that code can compute.

        They fit their type, and their numerators fit 64 bits; only special codes have larger ones.
        """
        least, greatest = INT64 if self.count_wide else INT32
        most = (INT64[1] - abs(self.to_raw.add)) // abs(self.to_raw.factor)
        first, last = _counts(self.to_raw, low, high)
        return max(first, least, -most), min(last, greatest, most)

    def encode_wide(self, counts: tuple[int, int]) -> bool:
        """Return True if encoding these counts needs 64 bits; code refuses all others before it computes."""
        return self.to_raw.largest(*counts) + self.to_raw.divisor > INT32[1]


@lru_cache(maxsize=1024)
def plan_of(shape: Shape) -> Plan:
    """Return the plan of a scale without run-time factors."""
    rule, raws = shape.fixed_scale, shape.held
    assert rule is not None
    to_raw, to_value = count_line(rule, shape.decimals or 0), value_line(rule)
    to_count = to_raw.inverse
    ends = [nearest(raw * to_count.factor + to_count.add, to_count.divisor) for raw in raws]
    numerator = to_value.largest(*raws)
    largest = max(abs(rule.ratio.numerator), rule.ratio.denominator, to_value.divisor, numerator)
    return Plan(
        rule,
        raws,
        to_raw,
        to_count,
        to_value,
        count_wide=not (INT32[0] <= min(ends) and max(ends) <= INT32[1]),
        decode_wide=to_count.largest(*raws) + to_count.divisor > INT32[1],
        numerator=numerator,
        beyond=_countable(to_raw, raws),
        fits_float=largest <= EXACT_FLOAT,
    )


def _countable(to_raw: Line, raws: tuple[int, int]) -> tuple[int, int] | None:
    """Return the raw numbers whose counts code computes in 64 bits; None if those are all of the type.

    A count is (raw * divisor - add) / factor, and rounding adds at most half the factor to the numerator: the product
    leaves room for that and for `add`. If nothing is computed, the smallest number of 64 bits is allowed too: it is
    never negated.
    """
    p, q, r = to_raw
    high = (INT64[1] - abs(p) // 2 - abs(q)) // r
    low = -high
    all_are = (low <= raws[0] or to_raw.does_nothing) and raws[1] <= high
    return None if all_are else (max(low, raws[0]), min(high, raws[1]))


def _counts(to_raw: Line, low: int, high: int) -> tuple[int, int]:
    """Return the least and the greatest count whose rounded raw number lies in low..high.

    A count belongs to the interval if its exact quotient rounds into it: if it lies less than a half outside the limit,
    or exactly a half and rounds towards the limit. A half rounds away from zero: up to a limit above zero, down to one
    below. Twice the numerator is compared, because that is a whole number.
    """
    p, q, r = to_raw
    if p < 0:
        first, last = _counts(Line(-p, q, r), low, high)
        return -last, -first
    below, above = (2 * low - 1) * r - 2 * q, (2 * high + 1) * r - 2 * q
    first = -(-below // (2 * p)) if low > 0 else below // (2 * p) + 1
    last = above // (2 * p) if high < 0 else -(-above // (2 * p)) - 1
    return first, last


__all__ = ["Lowered", "Operand", "Plan", "Rule", "lower", "plan_of"]


Band = tuple[int, int]

_MANTISSA = 1 << 24
"""The limit of the mantissa of a binary32 number."""


class Operand(NamedTuple):
    """A factor of a rule, with the numbers of its point.

    `held` are the least and greatest raw number of its type. `within` are the raw numbers with which the rule
    is computed; None for all. `codes` are its special codes. A `floating` factor is a
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
        """The special codes of each operand's point, for which the rule has no result."""
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
        """Return the lowered rule; equal rules are one object."""
        lowered = self._rules.get(linear)
        if lowered is None:
            lowered = self._rules[linear] = _rule(linear, self.points)
        return lowered

    def errata_of(self, point: Point) -> tuple[list[str], list[Erratum]]:
        """Return the ids of the errata that change a fact of the point or leave one open.

        Others are in the documentation only.
        """
        errata = [self._errata[name] for name in point.errata if name in self._errata]
        return [each.id for each in errata if not each.leaves_open], [each for each in errata if each.leaves_open]

    @cached_property
    def template_keys(self) -> Mapping[int, int]:
        """The template key of each point, by the point's id."""
        key_of = TemplateKeys().of
        return {id(point): key_of(point) for point in self.device.points}


_last: DeviceCache[Lowered] = DeviceCache(has_same_points, most=2)
"""The device that is compiled, and its sample for the proof of distinct names."""


def lower(device: Device) -> Lowered:
    """Return the lowered model of a device; devices with the same points and errata share one."""
    return _last.of(device, Lowered)


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
