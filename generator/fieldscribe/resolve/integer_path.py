"""Decides which computations of a scaled point are exact: counts of 10^-k units in 64 bits, and values in binary64."""

from fractions import Fraction
from typing import NamedTuple

from fieldscribe.arithmetic.codec import MOST_EXPONENT
from fieldscribe.model import Linear, ScaleCase
from fieldscribe.resolve.bounds import Bounds
from fieldscribe.resolve.point_facts import PointFacts

MOST_DECIMALS = 12

_COUNTED = 1 << 62
"""The largest integer between counts and raw numbers.

Generated code computes with signed integers of 64 bits. One bit stays free for rounding, which adds half the divisor to
the numerator: both stay within this bound, so their sum is below 2^63.
"""

_WORD = 1 << 63
"""Every constant of a scale is smaller, because code holds it in a signed integer of 64 bits."""

_WIDE = 1 << 127
"""Signed integers of 128 bits are smaller."""

_EXACT = 1 << 53
"""Every integer up to this one is a binary64 number."""

_NARROW = 1 << 33
"""All raw numbers of 32 bits are smaller."""

_HALF = (1 << 52) - (1 << 8)
"""Half a raw step in units of 2^-53, less a margin for constants that are rounded."""

_MOST_ROUNDINGS = 5
"""The number of roundings in encoding if other points decide the rule: value, product, quotient, sum and offset."""

_MANTISSA = 24
"""The bits of an f32's mantissa. As a factor they widen the integers; the exponent only shifts the result."""


class Paths(NamedTuple):
    """How code computes a point. `decimals` is the k of its counts, None if no 64-bit integer holds them.

    `encodes_values` is True if every raw number comes back from its value in binary64. `most_raw` is the largest size
    of a raw number for which a scale with factors is exact, if the type holds larger ones. `in_ranges` is True if that
    holds only while the factors lie in the declared ranges of their points. `raw_alone` is True if the scale itself
    needs more than 64 bits: then code offers only the raw number.
    """

    decimals: int | None
    encodes_values: bool = True
    most_raw: int | None = None
    raw_alone: bool = False
    in_ranges: bool = False


class _Needs(NamedTuple):
    """The largest integers in a rule: raw numbers with their offset, numerators of values, constants.

    `down` is what raw numbers are multiplied by to give the numerator.
    """

    raw: int
    numerator: int
    constant: int
    down: int


def paths_of(facts: PointFacts, cases: tuple[ScaleCase, ...] | None, bounds: Bounds) -> Paths:
    """Return how code computes the point: with the stated decimals, or so many that a raw step is a count or more."""
    stated: int | None = facts.get("decimals")
    report = bounds.scales.scope.report
    if cases is None:
        if facts.get("type") == "f32":
            return Paths(stated or 0)
        if stated and "scale" not in facts.failed and facts.layer("scale") is None:
            message = "`decimals` belongs to a scale, and the raw number is the value here"
            hint = "leave it out: only an f32 has counts" if facts.floating else "leave it out, or give the `scale`"
            report.error("integer-path", message, facts.span("decimals"), hint)
        return Paths(0)
    span = facts.span("decimals" if stated is not None else "scale")
    if stated is None and any(bounds.scales.floats(case.rule) for case in cases):
        if "decimals" not in facts.failed:
            message = "nothing says how fine the counts are: a floating-point factor has no finest step"
            report.error("integer-path", message, span, "add `decimals: …`, the decimals that the device resolves")
        return Paths(0)
    chosen = _is_chosen(cases)
    needs = [_needs(case.rule, _largest(facts, bounds), bounds) for case in cases]
    widest = max(need.constant for need in needs)
    if widest >= _WORD:
        bits = widest.bit_length()
        message = (
            f"this scale needs integers of {bits} bits, and code computes with 63: the point has raw numbers alone"
        )
        report.warning("wide-scale", message, facts.span("scale"), _way_out(cases, bounds))
        return Paths(None, encodes_values=False, raw_alone=True)
    encodes = all(_survives(case.rule, need, chosen=chosen) for case, need in zip(cases, needs, strict=True))
    decimals = _decimals(facts, cases, bounds, needs)
    most_raw = _most_raw(facts, cases, bounds, _largest_numerator(decimals, encodes=encodes))
    raw = max(map(abs, bounds.encodings[facts].holds)) if most_raw is None else most_raw
    held = [_needs(case.rule, raw, bounds, held=True) for case in cases if case.rule.factors]
    exact = all(
        need.constant < _WORD
        and not (encodes and need.numerator > _EXACT)
        and (decimals is None or _fit([need], decimals))
        for need in held
    )
    return Paths(decimals, encodes, most_raw, in_ranges=not exact)


def shows(facts: PointFacts, cases: tuple[ScaleCase, ...], bounds: Bounds, decimals: int, *, counted: bool) -> bool:
    """Return True if code computes every value with this many decimals by integers alone.

    If other points choose the rule, the numerator of a point with counts has 64 bits, and 40 more for the decimals stay
    below 128. With a fixed scale any raw number of the type may occur.
    """
    if _is_chosen(cases):
        return counted
    needs = _needs(cases[0].rule, max(map(abs, bounds.encodings[facts].holds)), bounds)
    power: int = 10**decimals
    return 2 * max(needs.numerator, needs.constant) * power < _WIDE


def _is_chosen(cases: tuple[ScaleCase, ...]) -> bool:
    """Return True if other points decide the rule at run time. Code then computes with 64-bit integers throughout."""
    return any(case.point is not None or case.rule.factors for case in cases)


def _survives(rule: Linear, needs: _Needs, *, chosen: bool) -> bool:
    """Return True if every raw number comes back from its value in binary64.

    Decoding gives the binary64 nearest to the exact value. Encoding rounds the product, the quotient and the sum, and
    uses rounded constants where binary64 does not hold them. Each rounding is off by at most 2^-53 of a number that is
    no larger than the raw number with its offset. While all of them together stay below half a raw step, rounding to
    the nearest integer gives the same raw number. The numerator need not be exact, because decoding divides exactly.
    Only if other points choose the rule, decoding also computes in binary64, and then the numerator must be exact
    there.
    """
    if chosen:
        return needs.numerator <= _EXACT and _MOST_ROUNDINGS * needs.raw <= _HALF
    top, bottom, offset = abs(rule.ratio.numerator), rule.ratio.denominator, rule.offset
    steps = (True, top != 1, bottom != 1, bool(offset))
    constants = (top > _EXACT, bottom > _EXACT, Fraction(float(offset)) != offset)
    return (sum(steps) + sum(constants)) * needs.raw <= _HALF


def asks_limits(holds: tuple[int, int]) -> bool:
    """Return True if the type is so wide that the limits decide how code computes a point."""
    return max(map(abs, holds)) >= _NARROW


def _largest(facts: PointFacts, bounds: Bounds) -> int:
    """Return the largest raw number that must come back unchanged.

    For types of up to 32 bits that is any number that the device may send. For wider types it is any number in range:
    to ask it of all numbers would rule out most scales, and decoding reports larger ones as an overflow.
    """
    holds = bounds.encodings[facts].holds
    return max(map(abs, bounds.own_hull(facts) if asks_limits(holds) else holds))


def _largest_numerator(decimals: int | None, *, encodes: bool) -> int | None:
    """Return the largest numerator for which all computations of a point are exact; None if 128 bits hold any.

    Values in binary64 need a numerator that is exact there. Counts are 10^decimals times as large, and rounding
    compares them with their own half: twice that must stay within the bound.
    """
    counts = None if decimals is None else _COUNTED // (2 * 10**decimals)
    limits = [limit for limit in (_EXACT if encodes else None, counts) if limit is not None]
    return min(limits, default=None)


def _most_raw(facts: PointFacts, cases: tuple[ScaleCase, ...], bounds: Bounds, numerator: int | None) -> int | None:
    """Return the largest raw number that code can compute for all factors; None if the type holds no larger one."""
    if not _is_chosen(cases) or numerator is None:
        return None
    least = _largest(facts, bounds)
    parts = [(case.rule.offset, _needs(case.rule, 0, bounds).down) for case in cases]
    # without `down` a factor is always 0, and so is the numerator for every raw number
    mosts = [(numerator // down - abs(offset.numerator)) // offset.denominator for offset, down in parts if down]
    most = min(mosts, default=None)
    return None if most is None or most >= max(map(abs, bounds.encodings[facts].holds)) else max(least, most)


def _decimals(facts: PointFacts, cases: tuple[ScaleCase, ...], bounds: Bounds, needs: list[_Needs]) -> int | None:
    """Return the decimals of the counts; None (without a finding) if no 64-bit integer holds the counts."""
    stated: int | None = facts.get("decimals")
    needed = max(_least_decimals(case.rule, bounds) for case in cases)
    fits = needed <= MOST_DECIMALS and _fit(needs, needed)
    if stated is None:
        return needed if fits else None
    if stated < needed:
        message = f"with {stated} decimals two raw numbers would have one count"
        no_counts = "leave `decimals` out: no 64-bit integer holds counts that tell them apart, so the point has none"
        hint = f"write `decimals: {needed}`, or leave it out" if fits else no_counts
        bounds.scales.scope.report.error("integer-path", message, facts.span("decimals"), hint)
        return needed
    if fits and not _fit(needs, stated):
        message = f"counts of 10^-{stated} units do not fit into 64 bits"
        hint = f"write `decimals: {max(count for count in range(needed, stated) if _fit(needs, count))}`"
        bounds.scales.scope.report.error("integer-path", message, facts.span("decimals"), hint)
    return stated if fits else None


def _way_out(cases: tuple[ScaleCase, ...], bounds: Bounds) -> str:
    """Return a hint for a scale whose integers do not fit: a change that causes no other finding."""
    factors = [factor for case in cases for factor in case.rule.factors]
    names = " and ".join(
        f"`{name}`" for name in sorted({bounds.scales.symbols.by_item(factor.point).name for factor in factors})
    )
    tens = [factor.ten_to for factor in factors]

    def fits(most: int) -> bool:
        return all(_needs(case.rule, 0, bounds, limit=most).constant < _WORD for case in cases)

    if any(tens) and not all(tens):
        return f"for values give {names} a narrower `range`"
    tries = range(MOST_EXPONENT, 0, -1) if any(tens) else [(1 << bits) - 1 for bits in range(63, 0, -1)]
    room = next((most for most in tries if fits(most)), 0) if factors else 0
    if room > 1:
        within = f"within -{room}..{room}" if any(tens) else f"that ends at {room} at most"
        return f"for values give {names} a narrower `range` {within}"
    return "for values take the unit with another prefix (kW, mm), which brings the factor nearer to 1"


def _fit(needs: list[_Needs], decimals: int) -> bool:
    """Return True if counts of this many decimals, and all intermediate integers, stay within 62 bits.

    Encoding and decoding of counts compute the same three products: the raw number with its offset times
    `down`, and the constants times at most 10^decimals. The factor of two is for the half that rounding compares with.
    """
    return all(2 * max(need.numerator, need.constant) * 10**decimals <= _COUNTED for need in needs)


def _least_decimals(rule: Linear, bounds: Bounds) -> int:
    """Return the fewest decimals at which a raw step is a count or more; above MOST_DECIMALS if none are enough."""
    counts, steps = abs(rule.ratio.numerator), rule.ratio.denominator
    if any(bounds.float_range(factor) is None for factor in bounds.scales.floats(rule)):
        return 0  # a floating-point factor without limits: only the stated decimals count
    if rule.factors:
        corners = [abs(corner - rule.offset) for corner in bounds.corners(rule)]
        largest = max((corner for corner in corners if corner), default=abs(rule.ratio))
        counts, steps = largest.numerator, largest.denominator
    needed = 0
    while needed <= MOST_DECIMALS and steps * 10**needed < counts:
        needed += 1
    return needed


def _needs(rule: Linear, raw: int, bounds: Bounds, *, limit: int | None = None, held: bool = False) -> _Needs:
    """Return the largest integers in a rule for the ranges of its factors, or for factors of at most `limit`.

    With `held`, factors are all that their types hold.
    """
    up, down = abs(rule.ratio.numerator), rule.ratio.denominator
    floats = bounds.scales.floats(rule)
    for factor in rule.factors:
        if factor in floats:
            up, down = (up << _MANTISSA, down) if factor.power == 1 else (up, down << _MANTISSA)
            continue
        most = max(map(abs, bounds.ends_of(factor, held=held and not factor.ten_to)))
        most = most if limit is None else min(most, limit)
        if factor.ten_to:
            up, down = up * 10**most, down * 10**most
        elif factor.power == 1:
            up *= most
        else:
            down *= most
    part, lift = rule.offset.denominator, abs(rule.offset.numerator)
    numerator = (raw * part + lift) * down
    constant = max(up * part, down * part, lift * down)
    return _Needs(raw + lift // part, max(numerator, up * part), constant, down)
