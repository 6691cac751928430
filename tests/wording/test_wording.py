"""Ranges, scales and units in words: exact, and the same for every output."""

from __future__ import annotations

from fractions import Fraction

import pytest
from fieldscribe import wording
from fieldscribe.model import Factor
from fieldscribe.wording.numbers import exact, fixed_rule, hex_text, number_text, shortest, value_multiple
from support.models import HERTZ, named, point, sample_device, scaled, value_of

DEVICE = sample_device()
POINTS = {one.name: one for one in DEVICE.points}


@pytest.mark.parametrize(
    ("numerator", "denominator", "text"),
    [
        (0, 7, "0"),
        (50, 1, "50"),
        (1, 10, "0.1"),
        (-1, 10, "-0.1"),
        (5, -10, "-0.5"),
        (-99, 100, "-0.99"),
        (7, 3, "7/3"),
        (-14, 6, "-7/3"),
        (1, 65536, "0.0000152587890625"),
        (10**30, 10, "1" + "0" * 29),
    ],
)
def test_exact_numbers(numerator: int, denominator: int, text: str) -> None:
    assert exact(numerator, denominator) == text
    assert number_text(Fraction(numerator, denominator)) == text


@pytest.mark.parametrize("places", [0, 1, 2, 5])
def test_counts_are_as_short_as_exact_numbers(places: int) -> None:
    for count in (0, 1, 10, 105, 500, 12_300, 100_000, 99_999_999, -1, -10, -50_500, -100_001):
        assert shortest(count, places) == exact(count, 10**places)


def test_hexadecimal_is_written_as_in_manuals() -> None:
    assert hex_text(0x1028) == "1028h"
    assert hex_text(6, 2) == "06h"
    assert wording.address_text(4136) == "1028h (4136)"


@pytest.mark.parametrize(
    ("item", "in_units", "in_raw"),
    [
        ("base_frequency", "0..400 Hz", "0..4000"),
        ("power_factor", "-0.99..-0.7 or 0.7..1", "-99..-70 or 70..100"),
        ("frequency_source", "0, 1, 10", "0, 1, 10"),
        ("temperature_mode", "-1, 2", "-1, 2"),
        ("temperature", "-40.25..124.75 °C", "-400..1250"),
        ("frequency_fine", "0..255.99609375 Hz", "0..65535"),
        ("pulse", "10..250 ms", "5..125"),
        ("third", "0..70000", "0..30000"),
        ("inverse", "-5..10 Hz", "-100..50"),
        ("float_setpoint", "0..650 Hz", ""),
        ("double_actual", "any number", ""),
        ("voltage_setpoint", "", "0..65535"),
        ("dc_level_200v", "330..390 V", "330..390"),
    ],
)
def test_ranges(item: str, in_units: str, in_raw: str) -> None:
    assert wording.range_text(named(DEVICE, item), POINTS) == in_units
    assert wording.raw_range_text(named(DEVICE, item)) == in_raw


def test_a_limit_of_another_point_is_said_with_what_lifts_it() -> None:
    upper, lower = named(DEVICE, "upper_limit"), named(DEVICE, "lower_limit")
    assert wording.range_text(upper, POINTS) == "lower_limit..400 Hz; while lower_limit.raw is 0: from 0"
    assert wording.raw_range_text(upper) == "lower_limit.raw..4000; while lower_limit.raw is 0: from 0"
    assert wording.range_text(lower, POINTS) == (
        "max(0.5, start_frequency)..min(400, upper_limit) Hz; while upper_limit.raw is 0: to 400"
    )
    assert "start_frequency.raw x 0.1" in wording.range_text(lower)


@pytest.mark.parametrize(
    ("item", "scale", "resolution"),
    [
        ("base_frequency", "raw x 0.1 Hz", "0.1 Hz"),
        ("acceleration_time", "raw x 0.01 s", "0.01 s, from 100 s on 0.1 s"),
        ("temperature", "raw x 0.1 - 0.25 °C", "0.1 °C"),
        ("frequency_fine", "raw / 256 Hz", "0.00390625 Hz"),
        ("pulse", "raw x 2 ms", "2 ms"),
        ("third", "raw x 7 / 3", "7/3"),
        ("inverse", "raw x -0.1 Hz", "0.1 Hz"),
        ("voltage_ratio", "raw x 1 V", "1 V"),
        ("voltage_setpoint", "raw x 400 / voltage_ratio.raw V", ""),
        ("power", "raw x 10^power_exponent.raw W", ""),
        (
            "setpoint",
            "raw / 16384 x reference_frequency.raw Hz when unit_mode.raw is 0; raw x 0.01 Hz when unit_mode.raw is 1",
            "",
        ),
        ("frequency_source", "", ""),
        ("status_word", "", ""),
        ("float_setpoint", "", ""),
    ],
)
def test_scales(item: str, scale: str, resolution: str) -> None:
    assert wording.scale_text(named(DEVICE, item)) == scale
    assert wording.resolution_text(named(DEVICE, item)) == resolution


@pytest.mark.parametrize(
    ("item", "raw", "meaning"),
    [
        ("base_frequency", 500, "50 Hz"),
        ("frequency_source", 0, "keypad"),
        ("frequency_source", 7, ""),
        ("temperature", 0x7FFF, "no_sensor"),
        ("upper_limit", 0, "inactive"),
        ("voltage_setpoint", 5, ""),
        ("unit_mode", 1, ""),
    ],
)
def test_meanings(item: str, raw: int, meaning: str) -> None:
    assert wording.meaning_text(named(DEVICE, item), raw) == meaning


def test_a_scale_that_nobody_knows_is_not_made_up() -> None:
    unknown = point("display", 0x1008, "u32", unit=HERTZ, generated=False, reason="the scale is not settled")
    assert fixed_rule(unknown) is None
    assert wording.scale_text(unknown) == ""
    assert wording.range_text(unknown) == ""
    assert wording.raw_range_text(unknown) == "0..4294967295"


@pytest.mark.parametrize(
    ("factor", "text"),
    [
        (value_of("unit_mode", slope=2), "raw / (unit_mode.raw x 2)"),
        (value_of("unit_mode", intercept=-3), "raw / (unit_mode.raw - 3)"),
        (value_of("unit_mode", slope=-1, intercept=3), "raw / (unit_mode.raw x -1 + 3)"),
        (value_of("unit_mode", -1, slope=2), "raw x (unit_mode.raw x 2)"),
        (value_of("unit_mode", slope=2, ten_to=True), "raw / 10^(unit_mode.raw x 2)"),
    ],
)
def test_a_factor_of_a_scale_says_how_it_is_made_of_a_raw_number(factor: Factor, text: str) -> None:
    assert wording.scale_text(point("subject", 1, scale=scaled(1, 0, factor))) == text


def test_words_bits_and_flags() -> None:
    assert wording.words_text(named(DEVICE, "swapped_count")) == "2001h (8193) high, 2000h (8192) low"
    assert wording.words_text(named(DEVICE, "energy")).endswith("201Fh (8223) (high part first)")
    assert wording.words_text(named(DEVICE, "setpoint_display")) == ""
    assert wording.type_text(named(DEVICE, "delay_class")) == "u8, bits 15..14"
    ready, fault, mode = named(DEVICE, "status_word").flags
    assert [wording.flag_bits(flag) for flag in (ready, fault, mode)] == ["0", "3", "5..4"]
    assert wording.flag_meaning(ready) == "ready (Ready / Bereit)"
    assert wording.flag_meaning(fault) == "fault (Fault), true when 0"
    assert wording.flag_meaning(mode) == "mode (Mode): 0 = stop (stop), 3 = run (run)"


def test_what_keeps_a_value() -> None:
    base = named(DEVICE, "base_frequency")
    assert wording.keeps_text(DEVICE, base) == (
        "only after the command enter (write any value to holding 0900h (2304) with function 06h); "
        "the memory is rated for 100000 writes"
    )
    assert wording.keeps_text(DEVICE, named(DEVICE, "third")) == ""


def test_a_factor_that_is_a_multiple_of_the_value() -> None:
    celsius = point("celsius", 1, "s16", scale=scaled(10, 5))
    assert value_multiple(Factor("celsius", 1, -5, 1, False), celsius) == 10
    assert value_multiple(Factor("celsius", 2, -10, 1, False), celsius) == 20
    assert value_multiple(Factor("celsius", 1, 0, 1, False), celsius) is None
