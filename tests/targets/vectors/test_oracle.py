"""The arithmetic of the oracle: rounding, binary32, halves, and rules with factors."""

from __future__ import annotations

import math
import struct
from decimal import ROUND_HALF_UP, Decimal
from fractions import Fraction
from pathlib import Path

import pytest
from fieldscribe.model import Linear
from fieldscribe.targets.vectors.oracle import Oracle, Ratio, bits_of, fixed_ratio, half_away, quotient
from fieldscribe.targets.vectors.samples import halves
from hypothesis import given as property_of
from hypothesis import strategies as st
from support.described import described, loaded_in
from support.models import linear


@property_of(st.integers(-(10**20), 10**20), st.integers(1, 10**9))
def test_half_away(over: int, under: int) -> None:
    whole, rest = divmod(abs(over), under)
    exact = Decimal(whole) + (
        Decimal("0.5") if 2 * rest == under else Decimal("0.7") if 2 * rest > under else Decimal(0)
    )
    rounded = int(exact.quantize(Decimal(1), ROUND_HALF_UP))
    assert half_away(over, under) == (rounded if over >= 0 else -rounded)


@property_of(st.floats(allow_nan=False, allow_infinity=False))
def test_binary32_is_what_the_machine_makes(value: float) -> None:
    try:
        expected = int.from_bytes(struct.pack(">f", value), "big")
    except OverflowError:
        expected = 0x7F80_0000 if value > 0 else 0xFF80_0000
    assert bits_of(value, 32) == expected


@property_of(st.integers(-(2**80), 2**80), st.integers(1, 2**60))
def test_quotient(over: int, under: int) -> None:
    exact = Fraction(over, under)
    assert quotient(over, under) == float(exact)


def test_quotient_overflows_to_infinity() -> None:
    assert quotient(-(10**400), 1) == -math.inf
    assert quotient(-(10**400), -1) == math.inf


@st.composite
def rules(draw: st.DrawFn) -> Linear:
    """A rule without factors."""
    ratio = draw(st.fractions(max_denominator=5000).filter(lambda one: one != 0 and abs(one) < 10**6))
    offset = draw(st.sampled_from((Fraction(0), Fraction(5, 2), Fraction(-40), Fraction(1, 3))))
    return Linear(ratio, offset, ())


@property_of(rules(), st.floats(allow_nan=False, allow_infinity=False))
def test_steps_are_those_of_the_machine(rule: Linear, value: float) -> None:
    stepped = value * float(rule.ratio.numerator) / float(rule.ratio.denominator) + float(rule.offset)
    found = fixed_ratio(rule).raw_of_float(value)
    if math.isinf(value * float(rule.ratio.numerator)):
        assert found is None
    else:
        assert found == half_away(*stepped.as_integer_ratio())


@property_of(rules(), st.integers(-(2**15), 2**15), st.integers(2, 2**16))
def test_halves_lie_exactly_between(rule: Linear, low: int, more: int) -> None:
    for value in halves(fixed_ratio(rule), [(low, low + more)]):
        assert (Fraction(value) * rule.ratio + rule.offset) % 1 == Fraction(1, 2)


def test_halves_are_found_where_there_are_some() -> None:
    assert halves(fixed_ratio(linear(10)), [(0, 4000)]) == [0.25, 399.75]
    assert halves(fixed_ratio(linear(1)), [(-3, 3)]) == [-2.5, 2.5, -0.5]
    assert halves(fixed_ratio(linear(2, "1/4")), [(0, 9)]) == [0.125, 4.125]
    assert halves(fixed_ratio(linear(2, "1/3")), [(0, 9)]) == []


FACTORS = """\
- {name: a, at: 0, range: 0..100, special: {0FFFFh: {name: nothing, no_value: yes}}}
- {name: b, at: 1, range: 0..100, special: {0FFFFh: {name: nothing, no_value: yes}}}
- {name: e, at: 2, type: s16, range: -3..3}
- {name: product, at: 3, scale: value = raw * a.raw * b.raw}
- {name: quotient, at: 4, scale: value = raw * a.raw / b.raw}
- {name: power, at: 5, scale: value = raw * a.raw * 10 ** e}
- {name: below, at: 6, range: 0..1000 / a.raw}
- {name: tens, at: 7, range: 0..10 ** e}
"""


@pytest.mark.parametrize(
    ("name", "settings", "answer"),
    [
        ("product", {"a": 5, "b": 7}, Ratio(1, 35, 0, 1)),
        ("product", {"a": 0xFFFF, "b": 7}, "zero_factor"),
        ("product", {"a": 5, "b": 0xFFFF}, "zero_factor"),
        ("product", {"a": 5, "b": 0}, "zero_factor"),
        ("quotient", {"a": 5, "b": 7}, Ratio(7, 5, 0, 1)),
        ("quotient", {"a": 5, "b": 0}, "zero_factor"),
        ("quotient", {"a": 0, "b": 5}, "zero_factor"),
        ("power", {"a": 5, "e": 2}, Ratio(1, 500, 0, 1)),
        ("power", {"a": 5, "e": -2}, Ratio(100, 5, 0, 1)),
        ("power", {"a": 5, "e": 4}, "overflow"),
        ("power", {"a": 0, "e": 2}, "zero_factor"),
        ("below", {"a": 8}, [(0, 125)]),
        ("below", {"a": 0}, "zero_factor"),
        ("tens", {"e": 3}, [(0, 1000)]),
        ("tens", {"e": 4}, "overflow"),
    ],
)
def test_what_the_oracle_answers_for_factors(
    name: str, settings: dict[str, int], answer: object, tmp_path: Path
) -> None:
    points = {one.name: one for one in loaded_in(tmp_path, described(FACTORS)).points}
    oracle = Oracle(points)
    one = points[name]
    limited = name in ("below", "tens")
    found = oracle.limits(one.shape, one.allowed, settings) if limited else oracle.ratio(one.shape, settings)
    assert (found if isinstance(found, str | Ratio) else list(found)) == answer
