"""The lowered model: integers of rules, their widths, and what is known of the points that a rule needs."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise

import pytest
from fieldscribe.arithmetic.exact import Line, count_line, half_away
from fieldscribe.lowered import lower, plan_of
from fieldscribe.model import Limit, Special, Variant
from fieldscribe.targets.rust.value_forms import limit_lines
from hypothesis import assume, given
from hypothesis import strategies as st
from support.models import allowed, linear, point, sample_device, scaled, titles, value_of

RATIOS = st.fractions(max_denominator=10**6).filter(bool)


@given(RATIOS, st.fractions(max_denominator=1000), st.integers(0, 6), st.integers(-(10**9), 10**9))
def test_a_line_is_its_rule(ratio: Fraction, offset: Fraction, decimals: int, count: int) -> None:
    line = count_line(linear(str(ratio), str(offset)), decimals)
    raw = Fraction(count, 10**decimals) * ratio + offset
    assert Fraction(count * line.factor + line.add, line.divisor) == raw
    back = line.inverse
    assert (raw * back.factor + back.add) / back.divisor == count
    assert back.inverse == line
    assert min(line.divisor, back.divisor) > 0


@pytest.mark.parametrize(
    ("line", "ends", "largest"),
    [
        (Line(3, 1, 7), (0, 10), 31),
        (Line(-3, 1, 7), (0, 10), 30),
        (Line(-3, -1, 7), (0, 10), 31),
        (Line(2, -100, 7), (0, 10), 100),
        (Line(1, 5, 7), (-20, 3), 20),
        (Line(1, -5, 7), (-20, 3), 25),
        (Line(0, 0, 1), (-9, 4), 9),
    ],
)
def test_the_largest_integer_on_the_way_of_a_line(line: Line, ends: tuple[int, int], largest: int) -> None:
    """Of the argument, of its product, and of their sum, whatever its sign."""
    assert line.largest(*ends) == largest


def test_a_line_is_read_both_ways() -> None:
    line = Line(3, -2, 7)
    assert line.result(10) == 4
    assert line.argument(4) == 10
    assert line.argument(Fraction(1, 7)) == 1


def test_a_line_is_in_lowest_terms() -> None:
    assert count_line(linear(256), 1) == Line(128, 0, 5)
    assert count_line(linear("10"), 1).does_nothing
    assert count_line(linear(-10), 1).inverse == Line(-1, 0, 1)


@given(RATIOS, st.fractions(-100, 100, max_denominator=100), st.integers(-300, 0), st.integers(0, 300))
def test_the_counts_are_those_of_raw_numbers_in_the_limits(
    ratio: Fraction, offset: Fraction, low: int, high: int
) -> None:
    subject = point("subject", 0, "s16", scale=scaled(str(ratio), str(offset)), decimals=0)
    first, last = plan_of(subject.shape).counts(low, high)
    assume(first <= last)
    inside = [low <= half_away(count * ratio + offset) <= high for count in (first - 1, first, last, last + 1)]
    assert inside == [False, True, True, False]


@pytest.mark.parametrize(
    ("type_name", "ratio", "decimals", "wide"),
    [
        ("u16", "10", 1, (False, False, False)),
        ("u16", "256", 1, (False, False, False)),
        ("s16", "100", 2, (False, False, False)),
        ("u32", "100", 2, (True, True, True)),
        ("u16", "1/65536", 0, (True, True, True)),
        ("s32", "1 + 1", 0, (True, True, True)),  # counts from -2^31 - 1
        ("s32", "1 - 1", 0, (True, True, True)),  # counts to 2^31
        ("s32", "2 + 1", 0, (False, True, True)),
        ("s16", "1 - 1", 0, (False, False, False)),
    ],
)
def test_widths(type_name: str, ratio: str, decimals: int, wide: tuple[bool, bool, bool]) -> None:
    """32 bits suffice for the counts, on the way to a raw number, and on the way back; a rule is ratio and offset."""
    times, sign, offset = (ratio if " " in ratio else f"{ratio} + 0").split()
    subject = point("subject", 0, type_name, scale=scaled(times, f"{sign}{offset}"), decimals=decimals)
    plan = plan_of(subject.shape)
    encode_wide = plan.encode_wide(plan.counts(*subject.outer))
    assert (plan.count_wide, encode_wide, plan.decode_wide) == wide


@pytest.mark.parametrize(
    ("type_name", "ratio", "fits"),
    [
        ("u16", "10", True),
        ("s16", "1/100", True),
        ("u16", "1/256", True),
        ("u16", "1/257", False),
        ("s16", "1/512", True),
        ("s16", "1/513", False),
        ("u16", f"{1 << 24}", True),
        ("u16", f"{(1 << 24) + 2}", False),
        ("s32", "10", False),
    ],
)
def test_what_binary32_holds(type_name: str, ratio: str, fits: bool) -> None:
    """Every whole number up to 2^24 and no more: the constants of a rule, and all that it meets of any raw number."""
    subject = point("subject", 0, type_name, scale=scaled(ratio), decimals=0)
    assert plan_of(subject.shape).fits_float is fits


@pytest.mark.parametrize(
    ("type_name", "ratio", "offset", "beyond"),
    [
        ("s32", 1, 0, None),
        ("s64", 1, 0, None),
        ("s64", -1, 0, (-(2**63) + 1, 2**63 - 1)),
        ("s64", 1, -1, (-(2**63) + 2, 2**63 - 2)),  # neither the product nor the sum may leave 64 bits
        ("s64", 1, 1, (-(2**63) + 2, 2**63 - 2)),
        ("s64", 2, 0, (-(2**63) + 2, 2**63 - 2)),  # a half is added to the numerator: 1
        ("s64", 2, 1, (-(2**63) + 3, 2**63 - 3)),
        ("s64", 7, 0, (-(2**63) + 4, 2**63 - 4)),
        ("s64", "1/10", 0, (-922337203685477580, 922337203685477580)),
        ("u32", "1/4294967296", 0, (0, 2147483647)),
    ],
)
def test_raw_numbers_whose_counts_need_more_than_64_bits(
    type_name: str, ratio: int | str, offset: int, beyond: tuple[int, int] | None
) -> None:
    """A count is (raw - offset) / ratio: no numerator with its half may leave 64 bits, signs turned round included."""
    subject = point("subject", 0, type_name, scale=scaled(ratio, offset), decimals=0, access="r")
    assert plan_of(subject.shape).beyond == beyond


def test_nothing_that_a_plan_meets_is_wider_than_it_says() -> None:
    for type_name in ("u8", "s16", "u16", "s32", "u32"):
        for ratio, offset in (("10", 0), ("-1/7", 3), ("65537/10", "1/2"), ("1/1000000", -5)):
            subject = point("subject", 0, type_name, scale=scaled(ratio, offset), decimals=2)
            plan = plan_of(subject.shape)
            counts = plan.counts(*subject.outer)
            limit = 1 << (63 if plan.encode_wide(counts) else 31)
            assert all(abs(one) + plan.to_raw.divisor // 2 < limit for one in plan.to_raw.meets(counts))
            to_count = plan.to_raw.inverse
            limit = 1 << (63 if plan.decode_wide else 31)
            assert all(abs(one) + to_count.divisor // 2 < limit for one in to_count.meets(plan.beyond or plan.raws))


def test_an_operand_knows_its_point() -> None:
    codes = (Special(9, 9, "off", titles("Off"), True), Special(3, 4, "bad", titles("Bad"), False))
    exponent = point("exponent", 1, "s8", bits=(3, 0), allowed=allowed((-4, 4)))
    needed = (exponent, point("factor", 2, "u8", specials=codes), point("number", 3, "f32"))
    rule = linear(
        2, 1, value_of("exponent", ten_to=True), value_of("factor", -1, slope=-2, intercept=1), value_of("number")
    )
    lowered = lower(sample_device(needed))
    made = lowered.rule(rule)
    power, divisor, number = made.operands
    assert [operand.factor.point for operand in made.steps] == ["factor", "number", "exponent"]
    assert (power.within, power.held) == ((-4, 4), (-128, 127))
    assert (divisor.ends, divisor.over, divisor.largest, divisor.within) == ((-509, 1), True, 509, None)
    assert made.coded == (("factor", (9, 9)), ("factor", (3, 4)))
    assert (number.floating, number.ends) == (True, (-(1 << 24), 1 << 24))
    assert lowered.rule(linear(2, 1, *rule.factors)) is made


def test_a_device_is_lowered_once() -> None:
    device, other = sample_device(), sample_device(())
    assert lower(device) is lower(device)
    assert lower(other).device is other
    assert lower(device).device is device


def test_points_are_found_by_item_and_by_name() -> None:
    variants = tuple(point("speed", at, variant=Variant("size", size)) for at, size in enumerate(("s", "l")))
    points = lower(sample_device(variants)).points
    assert (points["speed"], points["speed_s"], points["speed_l"]) == (variants[0], *variants)
    assert all(first.name == second.name for first, second in pairwise(variants))


def test_a_power_of_ten_is_no_factor_that_may_be_zero() -> None:
    """In Rust a limit may be multiplied with zero, by a call of its own; powers come last."""
    exponent = point("exponent", 1, "s8", allowed=allowed((-4, 4)))
    lowered = lower(sample_device((exponent, point("factor", 2, "u8"))))
    rule = linear(3, 0, value_of("exponent", ten_to=True), value_of("factor"))
    text = "".join(map(str.strip, limit_lines(Limit(rule, (), 0, 100), lowered, lower=False)))
    assert ".limited_by(with.factor)?.times_ten_to(" in text
