"""Exact encoding and decoding of points, what people type as values, and refusals in words."""

from __future__ import annotations

import math
import struct
from dataclasses import replace
from fractions import Fraction

import pytest
from fieldscribe.arithmetic import codec
from fieldscribe.arithmetic.codec import CodecError
from fieldscribe.arithmetic.exact import half_away
from fieldscribe.conversation.encoding import encode_point, read_settings, read_value
from fieldscribe.conversation.meanings import Meanings
from fieldscribe.conversation.refusals import amount
from fieldscribe.conversation.selection import choose_point, choose_variants
from fieldscribe.diagnostics import RefusedError, UnclearError
from fieldscribe.model import Device, Point, Special
from fieldscribe.pasted_numbers import HexError, parse_hex
from hypothesis import given
from hypothesis import strategies as st
from support.models import (
    FILTER_MODE,
    HERTZ,
    SECOND,
    allowed,
    changed,
    entry,
    named,
    point,
    sample_device,
    scaled,
    titles,
)

DEVICE = sample_device()
HOURS = replace(SECOND, symbol="h", name="hour")


def _point(item: str) -> Point:
    return named(DEVICE, item)


def _encode(item: str, value: str, device: Device = DEVICE, **settings: int) -> int:
    return encode_point(device, named(device, item), value, settings).raw


def _meaning(item: str, raw: int, **settings: int) -> str:
    return Meanings(DEVICE, _point(item)).text(raw, settings)


@pytest.mark.parametrize(
    ("item", "value", "raw"),
    [
        ("base_frequency", "50", 500),
        ("base_frequency", "50.0", 500),
        ("base_frequency", "50 Hz", 500),
        ("base_frequency", "50Hz", 500),
        ("base_frequency", "50 hz", 500),
        ("base_frequency", "50 hertz", 500),
        ("base_frequency", "5e1 Hz", 500),
        ("base_frequency", "  32h ", 500),
        ("base_frequency", "0.05", 1),
        ("base_frequency", "0.04", 0),
        ("temperature", "-0.3 °C", -1),
        ("temperature", "-0.3 C", -1),
        ("temperature", "-0.4 °C", -2),
        ("power_factor", "-0.99", -99),
        ("inverse", "-5 Hz", 50),
        ("third", "7", 3),
        ("pulse", "11 ms", 6),
        ("acceleration_time", "3000 seconds", 300000),
        ("frequency_source", "logic", 10),
        ("frequency_source", "Bedienfeld", 0),
        ("frequency_source", "10", 10),
        ("temperature_mode", "cold", -1),
        ("analog_filter", "500 ms", 17),
        ("analog_filter", "3", 3),
        ("run_command", "on", 1),
        ("run_command", "OFF", 0),
        ("running", "on", 1),  # read only: only frames that write it are refused
        ("run_command", "1", 1),
        ("upper_limit", "inactive", 0),
    ],
)
def test_typed_values(item: str, value: str, raw: int) -> None:
    assert _encode(item, value) == raw


@pytest.mark.parametrize(
    ("item", "value", "status", "words"),
    [
        ("base_frequency", "450", "out_of_range", "450 Hz is outside 0..400 Hz"),
        ("base_frequency", "-1", "out_of_range", "-1 Hz is outside"),
        ("base_frequency", "1e300", "out_of_range", "is outside"),
        ("power_factor", "0", "out_of_range", "-0.99..-0.7 or 0.7..1"),
        ("frequency_source", "7", "unknown_value", "does not take 7"),
        ("analog_filter", "18", "out_of_range", "does not take 18"),
        ("run_command", "2", "out_of_range", "raw 2 is outside"),
        ("baud_rate", "5", "not_generated", "not reachable over the bus"),
        ("upper_limit", "50", "missing", "its range depends on lower_limit"),
        ("voltage_setpoint", "50", "missing", "its scale depends on voltage_ratio"),
        ("float_setpoint", "650.5", "out_of_range", "0..650"),
        ("float_setpoint", "1e100", "out_of_range", "is outside"),
    ],
)
def test_refusals(item: str, value: str, status: str, words: str) -> None:
    with pytest.raises(RefusedError) as caught:
        _encode(item, value)
    assert caught.value.status == status
    assert words in caught.value.message


@pytest.mark.parametrize(
    ("item", "value", "message", "hint"),
    [
        ("base_frequency", "50 V", "is in Hz, not in `V`", "give the number in that unit"),
        ("base_frequency", "50,5 Hz", "decimal comma", "50.5"),
        ("base_frequency", "fast", "`fast` is no number", "it takes "),
        ("base_frequency", "", "missing", ""),
        ("third", "5 Hz", "has no unit", ""),
        ("frequency_source", "keypat", "has no name `keypat`", "`keypad`"),
        ("frequency_source", "1.5", "not a whole number", ""),
    ],
)
def test_unclear_values(item: str, value: str, message: str, hint: str) -> None:
    with pytest.raises(UnclearError) as caught:
        _encode(item, value)
    assert message in str(caught.value)
    assert hint in caught.value.hint


def test_prefixes_of_units_keep_their_case() -> None:
    power = point("power_limit", 1, unit=replace(HERTZ, symbol="mW", name="milliwatt"))
    assert read_value(power, "5 mw").value == 5
    with pytest.raises(UnclearError, match="not in `MW`"):
        read_value(power, "5 MW")


def test_hours_are_not_hexadecimal() -> None:
    run_time = point("run_time", 1, unit=HOURS)
    with pytest.raises(UnclearError, match="hours or hexadecimal"):
        read_value(run_time, "10h")
    assert read_value(run_time, "10 h").value == 10
    assert read_value(run_time, "0x10").value == 16


def test_dependent_limits() -> None:
    assert _encode("upper_limit", "50", lower_limit=100) == 500
    assert _encode("upper_limit", "5", lower_limit=0) == 50
    with pytest.raises(RefusedError, match=r"what is allowed here, 10\.\.400 Hz") as caught:
        _encode("upper_limit", "5", lower_limit=100)
    assert caught.value.hint == "the nearest allowed value is 10 Hz"


def test_limits_that_leave_nothing() -> None:
    nothing = replace(_point("upper_limit"), allowed=replace(_point("upper_limit").allowed))
    nothing = changed(nothing, allowed=allowed((nothing.allowed.intervals[0].low, 10)), specials=())
    with pytest.raises(RefusedError, match="nothing"):
        encode_point(DEVICE, nothing, "50", {"lower_limit": 4000})


def test_run_time_factors() -> None:
    assert _encode("voltage_setpoint", "230", voltage_ratio=400) == 230
    assert _meaning("voltage_setpoint", 100, voltage_ratio=300) == "about 133.333333 V"
    assert "depends on voltage_ratio" in _meaning("voltage_setpoint", 100)
    assert "is zero" in _meaning("voltage_setpoint", 100, voltage_ratio=0)
    assert _meaning("power", 12, power_exponent=3) == "12000 W"
    assert "outside the range" in _meaning("power", 12, power_exponent=30000)
    assert _meaning("setpoint", 100, unit_mode=1) == "1 Hz"
    assert "reference_frequency" in _meaning("setpoint", 100, unit_mode=0)
    assert "no scale" in _meaning("setpoint", 100, unit_mode=7)


@pytest.mark.parametrize(
    ("item", "raw", "text"),
    [
        ("base_frequency", 500, "50 Hz"),
        ("temperature", 0x7FFF, "no_sensor (No sensor), no value"),
        ("frequency_source", 0, "keypad (Keypad / Bedienfeld)"),
        ("frequency_source", 9, "9, a number without a name in the manual"),
        ("run_command", 1, "on"),
        ("status_word", 0b100001, "ready, fault (its bit is 0), mode = 2"),
        (
            "status_word",
            0b1111001,
            "ready, mode = run; not set: fault (its bit is 1); also bit 6, which the manual does not name",
        ),
        ("status_word", 0b1000, "mode = stop; not set: ready, fault (its bit is 1)"),
        ("float_setpoint", struct.unpack("<I", struct.pack("<f", 0.1))[0], "0.1 Hz"),
        ("float_setpoint", struct.unpack("<I", struct.pack("<f", 3.4028234e38))[0], "3.4028235e+38 Hz"),
        ("float_setpoint", 0x7FC00000, "nan"),
        ("double_actual", struct.unpack("<Q", struct.pack("<d", -2.5))[0], "-2.5"),
    ],
)
def test_meanings(item: str, raw: int, text: str) -> None:
    assert _meaning(item, raw) == text


def test_flags_by_name() -> None:
    control = point("control_word", 1, flags=_point("status_word").flags)
    device = sample_device((control,))
    assert _encode("control_word", "ready|fault", device) == 0b0001
    assert _encode("control_word", "ready", device) == 0b1001
    assert _encode("control_word", "none", device) == 0b1000
    assert _encode("control_word", "mode=run | fault", device) == 0b110000
    assert _encode("control_word", "0x21", device) == 0x21
    with pytest.raises(UnclearError, match="no flag `redy`") as caught:
        _encode("control_word", "redy", device)
    assert "`ready`" in caught.value.hint
    with pytest.raises(UnclearError, match="has 2 bits"):
        _encode("control_word", "mode", device)
    with pytest.raises(UnclearError, match="does not fit"):
        _encode("control_word", "mode=4", device)


def test_rounding_is_reported() -> None:
    told = encode_point(DEVICE, _point("base_frequency"), "50.04", {})
    assert told.raw == 500
    assert told.notes == ("50.04 Hz is between two raw numbers; rounded to 50 Hz",)
    told = encode_point(DEVICE, _point("acceleration_time"), "100.05 s", {})
    assert told.notes == ("here the device keeps only raw numbers divisible by 10; expect 100 s back",)


def test_settings_are_typed_like_values() -> None:
    settings = read_settings(DEVICE, ["voltage_ratio=400 V", "unit_mode.raw=1", "lower_limit=inactive"])
    assert settings == {"voltage_ratio": 400, "unit_mode": 1, "lower_limit": 0}
    assert read_settings(DEVICE, ["voltage_ratio=400", "voltage_setpoint=100"])["voltage_setpoint"] == 100
    for wrong in ("voltage_ratio", "voltage_ratio=", "voltage_ratio.raw=1.5", "voltage_ratio.raw=x"):
        with pytest.raises(UnclearError):
            read_settings(DEVICE, [wrong])
    with pytest.raises(RefusedError):
        read_settings(DEVICE, ["voltage_ratio.raw=65536"])


def test_points_and_variants_are_chosen_by_name() -> None:
    assert choose_point(DEVICE, "A020").name == "base_frequency"
    with pytest.raises(UnclearError, match="several points"):
        choose_point(DEVICE, str(0x2003))
    with pytest.raises(UnclearError, match="differs between variants"):
        choose_point(DEVICE, "b131")
    fixed = choose_variants(DEVICE, ["voltage_class=400V"])
    assert choose_point(fixed, "b131").item == "dc_level_400v"
    assert _encode("dc_level_400v", "700 V", fixed) == 700
    for wrong, hint in (("voltage_class=500V", "400V"), ("colour=red", "voltage_class=200V|400V"), ("x", "axis=value")):
        with pytest.raises(UnclearError) as caught:
            choose_variants(DEVICE, [wrong])
        assert hint in caught.value.hint


@given(st.integers(0, 0xFFFF))
def test_every_raw_survives(raw: int) -> None:
    for item in ("base_frequency", "temperature", "third", "inverse", "frequency_fine"):
        one = changed(_point(item), specials=())
        own = raw - 0x10000 if one.info.signed and raw > one.greatest else raw
        assert codec.encode(one, codec.decode(one, own, {}), {}) == own


@given(st.integers(0, 0xFFFFFFFF))
def test_float_patterns_survive(raw: int) -> None:
    one = _point("float_setpoint")
    number = codec.float_of(one, raw)
    if math.isfinite(number) and (raw != 1 << 31):
        assert codec.encode(one, codec.decode(one, raw, {}), {}) == raw
    else:
        assert math.isnan(number) or math.isinf(number) or number == 0
    assert isinstance(_meaning("float_setpoint", raw), str)


@given(st.fractions())
def test_halves_go_away_from_zero(number: Fraction) -> None:
    nearest = half_away(number)
    assert abs(nearest - number) <= Fraction(1, 2)
    assert half_away(-number) == -nearest
    if abs(nearest - number) == Fraction(1, 2):
        assert abs(nearest) > abs(number)


def test_special_codes_are_never_the_nearest_allowed_number() -> None:
    off = Special(0, 0, "off", titles("Off"), False)
    speed = point("speed", 1, allowed=allowed((0, 0), (100, 200)), specials=(off,), scale=scaled(10), unit=HERTZ)
    assert codec.nearest_allowed(speed, 10, {}) == 100
    with pytest.raises(CodecError):
        codec.check(speed, 10, {})


def test_amounts() -> None:
    assert amount(Fraction(1, 3)) == "about 0.333333333"
    assert amount(Fraction(-5, 2)) == "-2.5"
    assert amount(Fraction(10**20)) == str(10**20)
    assert amount(Fraction(1, 2**30)) == "about 9.31322575e-10"


def test_names_come_before_numbers() -> None:
    device = sample_device((point("gear", 1, enum=replace(FILTER_MODE, entries=(entry(3, "low"), entry(1, "3")))),))
    assert _encode("gear", "3", device) == 1


@pytest.mark.parametrize(
    "text",
    [
        "05 06 10 28",
        "05061028",
        "0x05,0x06,0x10,0x28",
        "0x05061028",
        "0x5 0x6 0x10 0x28",
        "05:06:10:28",
        "05-06-10-28",
        "\\x05\\x06\\x10\\x28",
        "05h 06h 10h 28h",
        "0506 1028\n",
    ],
)
def test_bytes_in_many_forms(text: str) -> None:
    assert parse_hex(text) == bytes.fromhex("05061028")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "no bytes"),
        ("05 6", "`6` (piece 2) has 1 digit;"),
        ("05061", "has 5 digits"),
        ("05 1G", "`1G` (piece 2) is not hexadecimal"),
        ("05 \x1b[31m", "is not hexadecimal"),
        ("０５", "is not hexadecimal"),
    ],
)
def test_texts_that_are_no_bytes(text: str, words: str) -> None:
    with pytest.raises(HexError) as caught:
        parse_hex(text)
    assert words in str(caught.value)
    assert str(caught.value).isprintable()
