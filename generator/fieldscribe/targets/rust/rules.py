"""Scales and limits as Rust expressions."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from math import gcd
from typing import TYPE_CHECKING

from fieldscribe.model import Bound, Factor, Limit, Linear, Point
from fieldscribe.targets.rust.literals import float_literal, integer, type_range, value_name
from fieldscribe.targets.rust.views import FactorView, LimitView, RuleView
from fieldscribe.wording.exact import inverse

if TYPE_CHECKING:
    from collections.abc import Mapping

_EXACT = 1 << 53
_PATTERN_WIDTH = 55
"""rustfmt breaks the arguments of a macro that take more columns than these and `raw, ` before them."""
_SOURCES = {"u32": 64, "i64": 64, "u64": 128}
"""The bits that a signed type needs to hold every number of these."""


@dataclass(frozen=True, slots=True)
class CountPath:
    """The integer path of a fixed scale: the count's type, both ways, whether decoding can overflow, counts in bounds.

    Each way is an expression for `scaled` (empty if nothing is divided), and one for the result.
    """

    type: str
    decode: tuple[str, str]
    overflows: bool
    encode: tuple[str, str]
    low: str
    high: str


@lru_cache(maxsize=4096)
def encode_float(rule: Linear) -> str:
    """A value as a raw number before rounding, each step rounded to binary64."""
    text = "value"
    if rule.ratio.numerator != 1:
        text += f" * {float_literal(float(rule.ratio.numerator))}"
    if rule.ratio.denominator != 1:
        text += f" / {float_literal(float(rule.ratio.denominator))}"
    if rule.offset:
        offset = float(rule.offset)
        text += f" {'-' if offset < 0 else '+'} {float_literal(abs(offset))}"
    return text


@lru_cache(maxsize=4096)
def decode_float(rule: Linear, raw: str) -> str:
    """The binary64 number nearest to the value: one division of integers that are exact, or of 128 bits."""
    multiply, add, divide = reduced = _reduced(*inverse(rule))
    ends = type_range(raw)
    wide = _wide(raw, reduced, ends)
    largest = max(abs(end * multiply) + abs(add) for end in ends)
    if max(largest, divide) > _EXACT:
        return f"arithmetic::quotient({_linear('i128::from(raw)', multiply, add)}, {integer(divide)})"
    if (multiply, add) == (1, 0) and raw not in ("i64", "u64"):
        text = "f64::from(raw)"
    elif wide == 32:
        text = f"f64::from({_linear(_cast('raw', raw, 'i32'), multiply, add)})"
    else:
        text = f"arithmetic::to_f64({_linear(_cast('raw', raw, 'i64'), multiply, add)})"
    return text if divide == 1 else f"{text} / {float_literal(float(divide))}"


@lru_cache(maxsize=16384)
def count_path(rule: Linear, decimals: int, raw: str, low: int, high: int) -> CountPath:
    """The integer path: all intermediates fit the narrowest of `i32`, `i64`, `i128` that holds them for every input."""
    multiply, add, divide = inverse(rule)
    power = 10**decimals
    decoded = _reduced(multiply * power, add * power, divide)
    decoded_wide = _wide(raw, decoded, type_range(raw))
    type_ = "i32" if decoded_wide == 32 else "i64"
    encoded = _encoded(rule, power)
    first, last = _counts(encoded, low, high)
    least, greatest = type_range(type_)
    first, last = max(first, least), min(last, greatest)
    return CountPath(
        type_,
        _division("raw", raw, decoded_wide, decoded),
        decoded_wide == 128,
        _division("count", type_, max(int(type_[1:]), _wide(type_, encoded, (first, last))), encoded),
        integer(first),
        integer(last),
    )


def run_time_rules(point: Point, points: Mapping[str, Point]) -> tuple[RuleView, ...]:
    """The cases of a scale that needs other points, in their order, up to one that always holds."""
    found: list[RuleView] = []
    for case in point.scale or ():
        held = "" if case.point is None else _raw_of(case.point)
        found.append(_rule(case.rule, held, integer(case.raw or 0), _factors(case.rule, points, limit=False)))
        if case.point is None:
            break
    return tuple(found)


def limit_views(point: Point, points: Mapping[str, Point]) -> tuple[tuple[LimitView, ...], tuple[str, ...]]:
    """The limits to work out, and for each interval the condition that `number` lies in it."""
    views: list[LimitView] = []
    conditions: list[str] = []
    for place, one in enumerate(point.allowed.intervals, 1):
        if isinstance(one.low, int) and isinstance(one.high, int):
            conditions.append(f"matches!(number, {interval(one.low, one.high)})")
            continue
        ends: list[str] = []
        for end, bound in (("low", one.low), ("high", one.high)):
            if isinstance(bound, Limit):
                views.append(_limit(f"{end}_{place}", bound, points))
            ends.append(f"{end}_{place}" if isinstance(bound, Limit) else integer(bound))
        conditions.append(f"({ends[0]}..={ends[1]}).contains(&number)")
    return tuple(views), tuple(conditions)


def interval(low: int, high: int) -> str:
    """A pattern for the numbers from `low` to `high`."""
    return integer(low) if low == high else f"{integer(low)}..={integer(high)}"


def merged(numbers: list[tuple[int, int]]) -> list[tuple[int, int]]:
    """The intervals in ascending order, neighbours joined."""
    found: list[tuple[int, int]] = []
    for low, high in sorted(numbers):
        if found and low <= found[-1][1] + 1:
            found[-1] = (found[-1][0], max(high, found[-1][1]))
        else:
            found.append((low, high))
    return found


def patterns(numbers: list[tuple[int, int]], rust_type: str) -> tuple[str, ...]:
    """Conditions, each short enough for one line, of which one holds if `raw` is in one of the intervals."""
    if rust_type == "bool":
        return ("raw" if numbers[0][0] else "!raw",)
    lines: list[list[str]] = [[]]
    width = 0
    for low, high in merged(numbers):
        part = interval(low, high)
        if width + len(part) > _PATTERN_WIDTH:
            lines.append([])
            width = 0
        lines[-1].append(part)
        width += len(part) + 3
    return tuple(f"matches!(raw, {' | '.join(line)})" for line in lines)


def outer(bound: Bound, *, lower: bool) -> int:
    """The number that a bound never goes beyond."""
    if isinstance(bound, int):
        return bound
    return bound.least if lower else bound.greatest


def _limit(local: str, limit: Limit, points: Mapping[str, Point]) -> LimitView:
    lower = local.startswith("low")
    unless = tuple((_raw_of(name), " | ".join(map(integer, codes))) for name, codes in limit.unless if codes)
    rule = _rule(limit.rule, "", "", _factors(limit.rule, points, limit=True))
    bound = integer(outer(limit, lower=lower))
    return LimitView(local, unless, bound, rule, f"max({bound})" if lower else f"min({bound})")


def _rule(rule: Linear, held: str, code: str, factors: list[FactorView]) -> RuleView:
    ratio = f"{integer(rule.ratio.numerator)}, {integer(rule.ratio.denominator)}"
    offset = f"{integer(rule.offset.numerator)}, {integer(rule.offset.denominator)}" if rule.offset else ""
    return RuleView(held, code, ratio, offset, tuple(factors))


def _factors(rule: Linear, points: Mapping[str, Point], *, limit: bool) -> list[FactorView]:
    """Exponents last: a zero factor is reported before an exponent that is out of its bounds."""
    factors = sorted(rule.factors, key=lambda factor: factor.ten_to)
    return [_factor(one, points, limit=limit) for one in factors]


def _factor(factor: Factor, points: Mapping[str, Point], *, limit: bool) -> FactorView:
    exponent_bounds = ""
    source = points.get(factor.point)
    if source is not None and source.type == "f32":
        method = "over" if factor.power < 0 else "limited_by" if limit else "times"
        return FactorView(_raw_of(factor.point), True, "", "", f"{method}_f32")
    if factor.ten_to:
        method = "times_ten_to" if factor.power > 0 else "over_ten_to"
        if source is not None:
            low, high = factor.exponents or source.outer
            exponent_bounds = f"{integer(low)}, {integer(high)}"
    elif factor.power > 0:
        method = "limited_by" if limit else "times"
    else:
        method = "over"
    plain = (factor.slope, factor.intercept) == (1, 0)
    line = "" if plain else f"{integer(factor.slope)}, {integer(factor.intercept)}"
    return FactorView(_raw_of(factor.point), False, exponent_bounds, line, method)


def _raw_of(name: str) -> str:
    return f"with.{value_name(name)}"


def _reduced(multiply: int, add: int, divide: int) -> tuple[int, int, int]:
    common = gcd(multiply, add, divide)
    return multiply // common, add // common, divide // common


def _encoded(rule: Linear, power: int) -> tuple[int, int, int]:
    """Integers (multiply, add, divide > 0) with raw = (count * multiply + add) / divide."""
    top, bottom = rule.ratio.numerator, rule.ratio.denominator
    over, under = rule.offset.numerator, rule.offset.denominator
    return _reduced(top * under, over * bottom * power, bottom * power * under)


def _rounded(number: int, divide: int) -> int:
    quotient = (2 * abs(number) + divide) // (2 * divide)
    return quotient if number >= 0 else -quotient


def _counts(encoded: tuple[int, int, int], low: int, high: int) -> tuple[int, int]:
    """The least and the greatest count whose raw number lies within low..=high."""
    multiply, add, divide = encoded
    # A raw number r comes from (r - 1/2) to (r + 1/2); which of the two halves is its own, the trial tells.
    below, above = (2 * low - 1) * divide - 2 * add, (2 * high + 1) * divide - 2 * add
    if multiply < 0:
        below, above = -above, -below
    first, last = -(-below // (2 * abs(multiply))), above // (2 * abs(multiply))
    first += not low <= _rounded(first * multiply + add, divide) <= high
    last -= not low <= _rounded(last * multiply + add, divide) <= high
    return first, last


def _wide(type_: str, rule: tuple[int, int, int], ends: tuple[int, int]) -> int:
    """The bits of the narrowest signed type that holds what is made of the type's numbers between `ends`."""
    multiply, add, divide = rule
    products = [end * multiply for end in ends]
    numbers = (*ends, *products, *(product + add for product in products), multiply, add, divide)
    least, greatest = min(numbers), max(numbers)
    fitting = next((bits for bits in (32, 64) if -(1 << (bits - 1)) <= least and greatest < 1 << (bits - 1)), 128)
    return max(fitting, _SOURCES.get(type_, 32))


def _division(name: str, type_: str, wide: int, rule: tuple[int, int, int]) -> tuple[str, str]:
    """`name` times and plus in a type of `wide` bits, and that divided and rounded."""
    multiply, add, divide = rule
    scaled = _linear(_cast(name, type_, f"i{wide}"), multiply, add)
    return ("", scaled) if divide == 1 else (scaled, f"arithmetic::div_round_i{wide}::<{integer(divide)}>(scaled)")


def _cast(name: str, type_: str, wanted: str) -> str:
    return name if type_ == wanted else f"{wanted}::from({name})"


def _linear(name: str, multiply: int, add: int) -> str:
    text = name if multiply == 1 else f"-{name}" if multiply == -1 else f"{name} * {integer(multiply)}"
    return text if add == 0 else f"{text} {'-' if add < 0 else '+'} {integer(abs(add))}"
