"""The room of exact arithmetic by itself: tables of what goes in and what comes out."""

from __future__ import annotations

from fractions import Fraction

import pytest
from fieldscribe.arithmetic import exact, words
from fieldscribe.arithmetic.codec import CodecError, decode, encode, encode_checked, powers_last, setting_of
from fieldscribe.arithmetic.exact import half_away, nearest
from fieldscribe.model import Fixed, Text
from hypothesis import given
from hypothesis import strategies as st
from support.models import allowed, changed, linear, point, scaled, value_of


@pytest.mark.parametrize(
    ("number", "whole"),
    [
        ("0", 0),
        ("1/2", 1),
        ("-1/2", -1),
        ("3/2", 2),
        ("5/2", 3),
        ("-5/2", -3),
        ("49/100", 0),
        ("-51/100", -1),
        ("7", 7),
    ],
)
def test_halves_go_away_from_zero(number: str, whole: int) -> None:
    assert half_away(Fraction(number)) == whole


@given(st.integers(), st.integers().filter(bool))
def test_a_quotient_rounds_as_its_fraction(number: int, divisor: int) -> None:
    found, exact = nearest(number, divisor), Fraction(number, divisor)
    assert abs(found - exact) <= Fraction(1, 2)
    if abs(found - exact) == Fraction(1, 2):
        assert abs(found) > abs(exact)


@pytest.mark.parametrize(
    ("width", "signed", "ends"),
    [(1, False, (0, 1)), (1, True, (-1, 0)), (4, True, (-8, 7)), (16, False, (0, 65535)), (32, True, words.INT32)],
)
def test_ends_of_bits(width: int, signed: bool, ends: tuple[int, int]) -> None:
    assert words.ends_of(width, signed=signed) == ends
    assert [words.number_of(end & words.mask_of(width), width, signed=signed) for end in ends] == list(ends)


@pytest.mark.parametrize(
    ("raw", "count", "split"),
    [(0x12345678, 2, (0x1234, 0x5678)), (-2, 2, (0xFFFF, 0xFFFE)), (5, 1, (5,)), (1 << 48, 4, (1, 0, 0, 0))],
)
def test_words_have_the_high_part_first(raw: int, count: int, split: tuple[int, ...]) -> None:
    assert words.split(raw, count) == split
    assert words.number_of(words.joined(split), 16 * count, signed=raw < 0) == raw


def test_words_of_points() -> None:
    group = point("group", 0, "s8", bits=(7, 4))
    assert words.group_mask(group) == 0x00F0
    assert words.raw_of(group, [0xFFEF]) == -2
    assert words.insert(group, 0x1200, -2) == 0x12E0
    fixed = changed(group, fixed=Fixed(0x0003, 0x0001))
    assert words.insert(fixed, 0xFFFF, 0) == 0xFF0D
    text = changed(point("text", 0), type="text", text=Text(4, "ascii"))
    assert words.raw_of(text, [0x4142, 0x4344]) == 0x41424344
    assert words.words_of(text, 0x41424344) == (0x4142, 0x4344)


@pytest.mark.parametrize(("raw", "with_bits"), [(0, -0x8000), (0x7FFF, -1), (-1, -1), (5, -0x7FFB)])
def test_fixed_bits_reach_the_sign(raw: int, with_bits: int) -> None:
    word = point("word", 0, "s16", fixed=Fixed(0x8000, 0x8000))
    assert words.with_fixed(word, raw) == with_bits
    assert words.with_fixed(point("group", 0, "u8", bits=(3, 0), fixed=Fixed(0x8000, 0x8000)), 5) == 5


@pytest.mark.parametrize(
    ("value", "bits", "pattern"),
    [(1, 32, 0x3F800000), (-2, 64, 0xC000000000000000), (Fraction(1, 3), 32, 0x3EAAAAAB), (0, 32, 0)],
)
def test_patterns_of_floats(value: Fraction | int, bits: int, pattern: int) -> None:
    assert exact.pattern_of(Fraction(value), bits) == pattern
    assert exact.pattern_of(exact.float_of(pattern, bits), bits) == pattern


def test_a_number_that_no_float_holds_is_refused() -> None:
    with pytest.raises(OverflowError):
        exact.pattern_of(Fraction(10) ** 39, 32)
    with pytest.raises(CodecError) as refused:
        encode(point("number", 0, "f32"), Fraction(10) ** 39, {})
    assert refused.value.status == "out_of_range"


SPEED = point("speed", 0, scale=scaled("1/400", 0, value_of("ratio")), decimals=1, allowed=allowed((0, 4000)))
POWER = point("power", 0, scale=scaled(1, "1/2", value_of("base", -1), value_of("exponent", ten_to=True)))


@pytest.mark.parametrize(
    ("held", "value", "raw"), [(200, "10", 5), (200, "9", 5), (200, "-9", -5), (400, "4000", 4000), (1, "200", 1)]
)
def test_run_time_factors_are_multiplied(held: int, value: str, raw: int) -> None:
    assert encode(SPEED, Fraction(value), {"ratio": held}) == raw
    assert decode(SPEED, raw, {"ratio": held}) == Fraction(raw * 400, held)


@pytest.mark.parametrize(
    ("settings", "status"),
    [({}, "missing"), ({"base": 0, "exponent": 99}, "zero_factor"), ({"base": 1, "exponent": 99}, "overflow")],
)
def test_errors_name_their_status(settings: dict[str, int], status: str) -> None:
    with pytest.raises(CodecError) as refused:
        encode(POWER, Fraction(1), settings)
    assert refused.value.status == status


def test_the_range_is_checked_after_rounding() -> None:
    ratio = point("ratio", 1)
    settings = {"ratio": setting_of(ratio, 400)}
    assert encode_checked(SPEED, Fraction(80009, 20), settings) == 4000
    with pytest.raises(CodecError) as refused:
        encode_checked(SPEED, Fraction(8001, 2), settings)
    assert refused.value.status == "out_of_range"


def test_a_zero_factor_is_reported_before_a_large_exponent() -> None:
    rule = linear(1, 0, value_of("exponent", ten_to=True), value_of("base", -1))
    assert [factor.point for factor in powers_last(rule)] == ["base", "exponent"]
