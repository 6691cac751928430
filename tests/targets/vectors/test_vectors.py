"""Conformance vectors: held against numbers worked out by hand, and against a second, plain reading of the model."""

from __future__ import annotations

import math
import struct
from collections import Counter
from dataclasses import replace
from decimal import ROUND_HALF_UP, Decimal
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import pytest
from fieldscribe.families import family
from fieldscribe.model import Device, Entry, Enum, Factor, Flag, Interval, Limit, Linear, Point, ScaleCase, Special
from fieldscribe.render import render
from fieldscribe.targets.vectors import outputs
from fieldscribe.targets.vectors.kinds import KINDS, table
from fieldscribe.targets.vectors.lines import Lines
from fieldscribe.targets.vectors.oracle import Oracle, Ratio, bits32, fixed_ratio, half_away, quotient
from fieldscribe.targets.vectors.samples import halves
from hypothesis import given as property_of
from hypothesis import strategies as st
from support.described import described, loaded_in
from support.models import (
    allowed,
    changed,
    linear,
    named,
    point,
    sample_bus,
    sample_device,
    scaled,
    titles,
    units,
    value_of,
)
from support.vector_file import Vector, counts_of, plain, vectors_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path


def text_of(device: Device) -> str:
    """The one file."""
    [(path, text)] = outputs(device, render)
    assert path == f"vectors/{device.id}.txt"
    return text


def vectors(device: Device) -> list[Vector]:
    """The vectors of a device that are not for other languages alone, without what is absent."""
    text = text_of(device)
    kinds = counts_of(text)
    return [plain(vector) for vector in vectors_of(text) if vector["kind"] in kinds]


SAMPLE = sample_device()
VECTORS = vectors(SAMPLE)


# The file


def test_one_vector_per_line_with_counts_before() -> None:
    text = text_of(SAMPLE)
    assert text.startswith("vectors\t2\tsample_drive\t1.2.0\t0123456789abcdef")
    assert text.endswith("\n")
    kinds = Counter(vector["kind"] for vector in VECTORS)
    known = KINDS | table(family(SAMPLE.family).part("targets.vectors").KINDS)
    assert counts_of(text) == {kind: kinds[kind] for kind in kinds if "python" in (known[kind].only or "python")}
    lines = Counter(line.split("\t")[0] for line in text.splitlines())
    assert {kind: lines[kind] for kind in kinds} == kinds


def test_units_of_points_are_vectors() -> None:
    symbols = {
        vector["point"]: vector["symbol"] for vector in vectors_of(text_of(SAMPLE)) if vector["kind"] == "symbol"
    }
    assert symbols == {
        point.item: point.unit.symbol for point in SAMPLE.points if point.generated and point.unit.symbol
    }


def test_the_same_text_twice_and_no_vector_twice() -> None:
    text = text_of(SAMPLE)
    assert text == text_of(sample_device())
    repeated = [line for line, times in Counter(map(repr, VECTORS)).items() if times > 1]
    assert repeated == []


def test_a_device_without_points_is_still_a_file() -> None:
    bus = replace(sample_bus(), framings=(), exceptions=())
    device = replace(sample_device(()), bus=bus, frames=(), blocks={}, commands=(), variants={})
    assert vectors(device) == []


@pytest.mark.parametrize("text", ["", "-", "%", "a\tb\nc", "x=1,2", "\u202e\u2028", "100 %", "\x00\x7f"])
def test_any_text_comes_back(text: str) -> None:
    lines = Lines()
    lines.set("point", "one")
    lines.add("name", 1, text)
    assert vectors_of(lines.text("device", "1", "0")) == [{"kind": "name", "point": "one", "raw": 1, "name": text}]


def test_a_line_that_the_table_does_not_know_is_refused() -> None:
    lines = Lines()
    with pytest.raises(TypeError, match="'x' is no int"):
        lines.add("check", "x", "ok")
    with pytest.raises(ValueError, match="check lacks status"):
        lines.add("check", 1)
    with pytest.raises(ValueError, match="check has no more than 2 fields"):
        lines.add("check", 1, "ok", 3)


def test_a_set_ends_those_behind_it() -> None:
    lines = Lines()
    lines.set("point", "one")
    lines.set("with", {"other": 5})
    lines.add("check", 1, "ok")
    lines.set("point", "two")
    lines.add("check", 1, "ok")
    lines.set("with", {"other": 5})
    lines.add("check", 2, "ok")
    found = [vector.get("with") for vector in vectors_of(lines.text("device", "1", "0"))]
    assert found == [{"other": "5"}, None, {"other": "5"}]


def test_documented_points_have_no_vectors() -> None:
    named_points = {vector["point"] for vector in VECTORS if "point" in vector}
    assert named_points == {one.item for one in SAMPLE.points if one.generated}


def test_the_amount_stays_bounded() -> None:
    one = point("one", 1, scale=scaled(256), decimals=3, allowed=allowed((10, 4000)))
    kinds = Counter(vector["kind"] for vector in vectors(sample_device((one,))) if vector.get("point") == "one")
    assert kinds.total() - kinds["read"] - kinds["write"] <= 45  # the first point of a device has the bad answers


# Numbers worked out by hand


def by_hand(kind: str, item: str, **facts: object) -> Vector:
    """A vector of a point."""
    return {"kind": kind, "point": item, **facts}


def given(raws: dict[str, int]) -> dict[str, Any]:
    """The run-time numbers of a vector."""
    return {"with": raws}


def f64(value: float) -> str:
    """The bits of a binary64."""
    return struct.pack(">d", value).hex()


HAND = [
    by_hand("decode", "base_frequency", raw=4000, status="ok", float="4079000000000000"),
    by_hand("decode", "base_frequency", raw=65535, status="ok", float="40b9998000000000"),
    by_hand("encode", "base_frequency", float=f64(0.25), status="ok", raw=3),
    by_hand("encode", "base_frequency", float="3fcfffffffffffff", status="ok", raw=2),
    by_hand("encode", "base_frequency", float=f64(400.1), status="out_of_range"),
    by_hand("encode", "base_frequency", float=f64(-0.1), status="out_of_range"),
    by_hand("encode", "base_frequency", float="8000000000000000", status="ok", raw=0),
    by_hand("encode", "base_frequency", float="7ff8000000000000", status="not_a_number"),
    by_hand("encode", "base_frequency", float="7ff0000000000000", status="out_of_range"),
    by_hand("encode", "base_frequency", float=f64(1e300), status="out_of_range"),
    by_hand("encode_count", "base_frequency", count=4001, status="out_of_range"),
    by_hand("encode_count", "base_frequency", count=-2147483648, status="out_of_range"),
    by_hand("address", "base_frequency", space="holding", address=4136, words=1, code="A020", raw_min=0, raw_max=4000)
    | {"decimals": 1, "references": {"modicon": "4137", "reference": "404137"}},
    by_hand("address", "lower_limit", space="holding", address=4186, words=1, raw_min=5, raw_max=4000)
    | {"decimals": 1, "references": {"modicon": "4187"}},
    by_hand("address", "float_setpoint", space="holding", address=8212, words=2, references={"modicon": "8213"}),
    # raw = value * 10 + 5/2: raw 0 is -0.25, and 0.0 lies halfway between 2 and 3
    by_hand("decode", "temperature", raw=0, status="ok", float="bfd0000000000000"),
    by_hand("decode", "temperature", raw=32767, status="special", special="no_sensor"),
    by_hand("decode_count", "temperature", raw=32767, status="special", special="no_sensor"),
    by_hand("special", "temperature", special="no_sensor", low=32767, high=32767),
    by_hand("special_name", "temperature", raw=32767, name="no_sensor", no_value=1),
    by_hand("special_name", "temperature", raw=32766),
    by_hand("encode_count", "upper_limit", **given({"lower_limit": 0}), count=0, status="special"),
    by_hand("check", "upper_limit", **given({"lower_limit": 4000}), raw=0, status="ok"),
    # raw = value * 3 / 7: 7/3 has no end
    by_hand("decode", "third", raw=30000, status="ok", float=f64(70000.0)),
    by_hand("decode", "third", raw=65535, status="ok", float=f64(152915.0)),
    # raw = value * 256 in counts of 1/1000: 255996.09375 is 255996
    by_hand("decode_count", "frequency_fine", raw=65535, status="ok", count=255996),
    by_hand("encode_count", "frequency_fine", count=2, status="ok", raw=1),  # 0.512
    by_hand("encode_count", "frequency_fine", count=1, status="ok", raw=0),  # 0.256
    # raw = value * -10
    by_hand("decode", "inverse", raw=-100, status="ok", float=f64(10.0)),
    by_hand("encode", "inverse", float=f64(-5.1), status="out_of_range"),
    # two intervals: the hole between them
    by_hand("check", "power_factor", raw=-69, status="out_of_range"),
    by_hand("check", "power_factor", raw=69, status="out_of_range"),
    by_hand("check", "power_factor", raw=-70, status="ok"),
    by_hand("check", "frequency_source", raw=2, status="unknown_value"),
    by_hand("encode_count", "frequency_source", count=2147483647, status="unknown_value"),
    by_hand("encode_count", "analog_filter", count=18, status="out_of_range"),
    by_hand("encode_count", "analog_filter", count=17, status="ok", raw=17),
    by_hand("name", "analog_filter", raw=17, name="dead_band"),
    by_hand("name", "analog_filter", raw=18),
    by_hand("name", "temperature_mode", raw=-1, name="cold"),
    by_hand("encode_count", "run_command", count=2, status="out_of_range"),
    by_hand("flag_name", "status_word", flag="mode", raw=3, name="run"),
    by_hand("words", "signed_one", raw=-3, words=[0xFFFD]),
    by_hand("flag", "status_word", raw=0x30, flag="mode", number=3),
    by_hand("flag", "status_word", raw=0xFFF7, flag="fault", number=0, truth=1),
    # s8 in the bits 13..6 of a word: 0x80 there is -128
    by_hand("bits", "signed_byte", word=0x2000, raw=-128, replaced=127, result=0x1FC0),
    by_hand("bits", "delay_class", word=0xFFFF, raw=3, replaced=0, result=0x3FFF),
    by_hand("words", "acceleration_time", raw=0x00010203, words=[0x0001, 0x0203]),
    by_hand("words", "swapped_count", raw=0x00010203, words=[0x0203, 0x0001]),
    by_hand("words", "energy", raw=-(1 << 63), words=[0x8000, 0, 0, 0]),
    by_hand("words", "double_actual", raw=0x0001020304050607, words=[0x0001, 0x0203, 0x0405, 0x0607]),
    # binary32: 0.1 is 3DCCCCCDh, 1 + 2^-24 ties to the even 1, 1 + 3 * 2^-24 to the even 1 + 2^-22
    by_hand("encode", "float_setpoint", float=f64(0.1), status="ok", raw=0x3DCCCCCD),
    by_hand("encode", "float_setpoint", float="3ff0000010000000", status="ok", raw=0x3F800000),
    by_hand("encode", "float_setpoint", float="3ff0000030000000", status="ok", raw=0x3F800002),
    by_hand("encode", "float_setpoint", float=f64(650.0), status="ok", raw=0x44228000),
    # what binary32 cannot tell from 650 is 650: up to half of the step to the next number, and ties go to the even one
    by_hand("encode", "float_setpoint", float=f64(650.0000000000001), status="ok") | {"raw": 0x44228000},
    by_hand("encode", "float_setpoint", float=f64(650 + 2.0**-15), status="ok") | {"raw": 0x44228000},
    by_hand("encode", "float_setpoint", float="4084500010000001", status="out_of_range"),
    by_hand("check", "float_setpoint", raw=0x44228000, status="ok"),
    by_hand("check", "float_setpoint", raw=0x44228001, status="out_of_range"),
    by_hand("check", "float_setpoint", raw=0x80000000, status="ok"),
    by_hand("check", "float_setpoint", raw=0x80000001, status="out_of_range"),
    by_hand("check", "float_setpoint", raw=0x7FC00000, status="not_a_number"),
    by_hand("encode", "float_setpoint", float=f64(2.0**-150), status="ok", raw=0),
    by_hand("decode", "float_setpoint", raw=1, status="ok", float=f64(2.0**-149)),
    # raw = value * ratio / 400: with 50, 20000 is 160000
    by_hand("encode", "voltage_setpoint", **given({"voltage_ratio": 0}), float=f64(1.0), status="zero_factor"),
    by_hand("decode", "voltage_setpoint", **given({"voltage_ratio": 50}), raw=65535, status="ok")
    | {"float": f64(524280.0)},
    # value = raw * 10 ** exponent
    by_hand("decode", "power", **given({"power_exponent": -9}), raw=-32768, status="ok") | {"float": f64(-3.2768e-05)},
    by_hand("decode", "power", **given({"power_exponent": 10}), raw=1, status="overflow"),
    by_hand("decode_count", "power", **given({"power_exponent": -10}), raw=1, status="overflow"),
    # the rule that the mode chooses
    by_hand("decode", "setpoint", **given({"unit_mode": 1, "reference_frequency": 217}), raw=20000, status="ok")
    | {"float": f64(200.0)},
    by_hand("decode", "setpoint", **given({"unit_mode": 0, "reference_frequency": 650}), raw=-32768, status="ok")
    | {"float": f64(-1300.0)},
    by_hand("decode", "setpoint", **given({"unit_mode": 2, "reference_frequency": 217}), raw=1, status="no_case"),
    by_hand("decode", "setpoint", **given({"unit_mode": 0, "reference_frequency": 0}), raw=1, status="zero_factor"),
    # upper_limit: from lower_limit to 4000; 0 is a special code that may be written; lower_limit 0 lifts the limit
    by_hand("check", "upper_limit", **given({"lower_limit": 4000}), raw=3999, status="out_of_range"),
    by_hand("check", "upper_limit", **given({"lower_limit": 4000}), raw=4000, status="ok"),
    by_hand("check", "upper_limit", **given({"lower_limit": 0}), raw=1, status="ok"),
    by_hand(
        "check", "lower_limit", **given({"start_frequency": 99, "upper_limit": 1333}), raw=98, status="out_of_range"
    ),
    by_hand("check", "lower_limit", **given({"start_frequency": 99, "upper_limit": 1333}), raw=1333, status="ok"),
    by_hand("check", "lower_limit", **given({"start_frequency": 36, "upper_limit": 0}), raw=4000, status="ok"),
    # start_frequency 0 is outside its own 5..99: the limit is 5 all the same
    by_hand("check", "lower_limit", **given({"start_frequency": 0, "upper_limit": 1333}), raw=4, status="out_of_range"),
    by_hand("check", "lower_limit", **given({"start_frequency": 0, "upper_limit": 1333}), raw=5, status="ok"),
    by_hand("check", "dc_level_200v", raw=391, status="out_of_range"),
    by_hand("check", "dc_level_400v", raw=780, status="ok"),
]


@pytest.mark.parametrize("expected", HAND, ids=lambda vector: f"{vector['kind']}-{vector['point']}")
def test_worked_out_by_hand(expected: Vector) -> None:
    assert expected in VECTORS


def test_printed_frames() -> None:
    request = {"framing": "rtu", "unit": 5, "transaction": 0, "function": 6, "address": 0x1028, "count": 1}
    request["values"] = [500]
    printed = [vector for vector in VECTORS if vector["kind"].startswith("printed")]
    assert printed == [
        {"kind": "printed_build", "frame": "write_base", **request, "status": "ok", "bytes": "0506102801f40c91"},
        {"kind": "printed_reply", "frame": "write_base", **request, "bytes": "0506102801f4a854", "status": "bad_crc"},
    ]


def test_frames_meet_every_status() -> None:
    device = replace(SAMPLE, bus=replace(SAMPLE.bus, framings=("rtu", "tcp")))
    found = {
        (vector["kind"], vector["framing"], vector["status"])
        for vector in vectors(device)
        if vector["kind"] in ("build", "reply")
    }
    both = {("build", one) for one in ("ok", "bad_unit", "bad_function", "bad_count", "bad_address", "bad_value")}
    reply = ("ok", "short_frame", "long_frame", "wrong_unit", "wrong_function", "exception", "bad_byte_count")
    both |= {("reply", one) for one in (*reply, "echo_mismatch")}
    wanted = {(kind, framing, status) for kind, status in both for framing in ("rtu", "tcp")}
    wanted |= {("reply", "rtu", "bad_crc"), ("reply", "tcp", "bad_protocol"), ("reply", "tcp", "wrong_transaction")}
    assert wanted <= found


# Rounding


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
        expected: int | None = int.from_bytes(struct.pack(">f", value), "big")
    except OverflowError:
        expected = None
    assert bits32(value) == expected


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


# A second reading of the model, slow and plain, that answers any vector of a point


def near(value: Fraction) -> int:
    """The nearest integer, halves away from zero."""
    return int(value + Fraction(1, 2)) if value >= 0 else -int(-value + Fraction(1, 2))


class RefusedError(Exception):
    """The status that is not ok."""


def factor_of(factor: Factor, given_: dict[str, int], source: Point) -> Fraction:
    """What a factor multiplies a rule by."""
    number = factor.slope * given_[factor.point] + factor.intercept
    if factor.ten_to:
        bounds = source.allowed.intervals[0]
        if not int(str(bounds.low)) <= given_[factor.point] <= int(str(bounds.high)):
            raise RefusedError("overflow")
        return Fraction(10) ** (factor.power * number)
    return Fraction(number) ** factor.power if number or factor.power > 0 else Fraction(0)


class Reading:
    """Answers vectors of one device's points."""

    def __init__(self, device: Device) -> None:
        self.device = device

    def answer(self, vector: Vector) -> Vector:
        """The vector as this reading has it."""
        subject = named(self.device, vector["point"])
        try:
            return getattr(self, vector["kind"])(subject, vector) or {}
        except RefusedError as refusal:
            return {"status": str(refusal)}

    def rule(self, subject: Point, vector: Vector) -> tuple[Fraction, Fraction]:
        """The ratio and the offset in force."""
        given_ = vector.get("with", {})
        for case in subject.scale or ():
            if case.point is None or given_[case.point] == case.raw:
                product = Fraction(1)
                for factor in case.rule.factors:
                    product *= factor_of(factor, given_, named(self.device, factor.point))
                if not product:
                    raise RefusedError("zero_factor")
                return case.rule.ratio * product, case.rule.offset
        raise RefusedError("no_case")

    def limit(self, bound: int | Limit, given_: dict[str, int], *, low: bool) -> int:
        """A bound at these settings."""
        if isinstance(bound, int):
            return bound
        if any(first <= given_[name] <= last for name, bands in bound.unless for first, last in bands):
            return bound.least if low else bound.greatest
        product = bound.rule.ratio
        for factor in bound.rule.factors:
            product *= factor_of(factor, given_, named(self.device, factor.point))
        found = near(product + bound.rule.offset)
        return max(found, bound.least) if low else min(found, bound.greatest)

    def admit(self, subject: Point, raw: int, given_: dict[str, int]) -> None:
        """Refuses what may not be written."""
        for one in subject.allowed.intervals:
            if self.limit(one.low, given_, low=True) <= raw <= self.limit(one.high, given_, low=False):
                return
        raise RefusedError("unknown_value" if subject.enum is not None and subject.enum.closed else "out_of_range")

    def present(self, subject: Point, raw: int) -> None:
        """Refuses numbers that are special codes."""
        if any(special.low <= raw <= special.high for special in subject.specials):
            raise RefusedError("special")

    def decode(self, subject: Point, vector: Vector) -> Vector:
        raw = vector["raw"]
        self.present(subject, raw)
        if subject.form == "float":
            form, size = (">f", 4) if subject.type == "f32" else (">d", 8)
            value = struct.unpack(form, raw.to_bytes(size, "big"))[0]
        else:
            ratio, offset = self.rule(subject, vector)
            value = float((raw - offset) / ratio)
        return {"status": "ok", "float": f64(math.nan if math.isnan(value) else value)}

    def encode(self, subject: Point, vector: Vector) -> Vector:
        value = struct.unpack(">d", bytes.fromhex(vector["float"]))[0]
        if math.isnan(value):
            raise RefusedError("not_a_number")
        if subject.form == "float":
            return self.encode_float(subject, value)
        self.rule(subject, vector)
        case = next(one for one in subject.scale or () if one.point is None or vector["with"][one.point] == one.raw)
        num, den = case.rule.ratio.numerator, case.rule.ratio.denominator
        for factor in case.rule.factors:
            number = factor_of(factor, vector["with"], named(self.device, factor.point))
            num, den = num * number.numerator, den * number.denominator
        value = value * float(num) / float(den) + float(case.rule.offset)
        if math.isinf(value):
            raise RefusedError("out_of_range")
        raw = near(Fraction(value))
        self.present(subject, raw)
        self.admit(subject, raw, vector.get("with", {}))
        return {"status": "ok", "raw": raw}

    def encode_float(self, subject: Point, value: float) -> Vector:
        form = ">f" if subject.type == "f32" else ">d"
        try:
            packed = struct.pack(form, value)
        except OverflowError:
            raise RefusedError("out_of_range") from None
        if math.isfinite(value):
            self.present(subject, int.from_bytes(packed, "big"))
        self.admit_float(subject, struct.unpack(form, packed)[0])
        return {"status": "ok", "raw": int.from_bytes(packed, "big")}

    def admit_float(self, subject: Point, number: float) -> None:
        """Refuses numbers of the type beyond the limits, as the type has those."""
        form = ">f" if subject.type == "f32" else ">d"
        if math.isnan(number):
            raise RefusedError("not_a_number")
        spans = [
            [struct.unpack(form, struct.pack(form, float(end)))[0] for end in one] for one in subject.allowed.units
        ]
        if math.isinf(number) or (spans and not any(low <= number <= high for low, high in spans)):
            raise RefusedError("out_of_range")

    def decode_count(self, subject: Point, vector: Vector) -> Vector:
        raw = vector["raw"]
        self.present(subject, raw)
        if subject.scale is None:
            return {"status": "ok", "count": raw}
        ratio, offset = self.rule(subject, vector)
        count = near((raw - offset) / ratio * 10 ** (subject.decimals or 0))
        if not -(2**63) <= count < 2**63:
            raise RefusedError("overflow")
        return {"status": "ok", "count": count}

    def encode_count(self, subject: Point, vector: Vector) -> Vector:
        ratio, offset = (Fraction(1), Fraction(0)) if subject.scale is None else self.rule(subject, vector)
        power = 1 if subject.scale is None else 10 ** (subject.decimals or 0)
        raw = near(Fraction(vector["count"], power) * ratio + offset)
        self.present(subject, raw)
        self.admit(subject, raw, vector.get("with", {}))
        return {"status": "ok", "raw": raw}

    def check(self, subject: Point, vector: Vector) -> Vector:
        if any(one.low <= vector["raw"] <= one.high and one.writable for one in subject.specials):
            return {"status": "ok"}
        self.present(subject, vector["raw"])
        if subject.form == "float":
            form, size = (">f", 4) if subject.type == "f32" else (">d", 8)
            self.admit_float(subject, struct.unpack(form, vector["raw"].to_bytes(size, "big"))[0])
            return {"status": "ok"}
        self.admit(subject, vector["raw"], vector.get("with", {}))
        return {"status": "ok"}

    def name(self, subject: Point, vector: Vector) -> Vector:
        entries = subject.enum.entries if subject.enum else ()
        return {"name": next((entry.name for entry in entries if entry.raw == vector["raw"]), None)}

    def special(self, subject: Point, vector: Vector) -> Vector:
        found = [one for one in subject.specials if one.name == vector["special"]]
        return {"low": found[0].low, "high": found[0].high} if found else {"low": None}

    def special_name(self, subject: Point, vector: Vector) -> Vector:
        found = [one for one in subject.specials if one.low <= vector["raw"] <= one.high]
        return {"name": found[0].name, "no_value": int(found[0].no_value)} if found else {}

    def flag(self, subject: Point, vector: Vector) -> Vector:
        found = [one for one in subject.flags if one.name == vector["flag"]]
        return {"number": (vector["raw"] >> found[0].low) % 2 ** found[0].width} if found else {"number": None}

    def flag_name(self, subject: Point, vector: Vector) -> Vector:
        found = [entry for one in subject.flags if one.name == vector["flag"] for entry in one.values]
        return {"name": next((entry.name for entry in found if entry.raw == vector["raw"]), None)}

    def bits(self, subject: Point, vector: Vector) -> Vector:
        assert subject.bits is not None
        low, size = subject.bits[1], 1 << subject.width
        raw = vector["word"] // 2**low % size
        rest = vector["word"] - raw * 2**low
        signed = subject.info.signed and raw >= size // 2
        return {"raw": raw - size if signed else raw, "result": rest + vector["replaced"] % size * 2**low}

    def words(self, subject: Point, vector: Vector) -> Vector:
        count = subject.words
        by_address = {
            where: vector["raw"] // 65536 ** (count - 1 - place) % 65536
            for place, where in enumerate(subject.addresses)
        }
        return {"words": [by_address[where] for where in sorted(by_address)]}

    def address(self, subject: Point, vector: Vector) -> Vector:
        del vector
        found: Vector = {"space": subject.space, "address": subject.address, "words": subject.words}
        found["references"] = {key: str(number) for key, number in subject.references.items()}
        found["code"] = subject.code
        if subject.form == "float":
            return found
        ends = [(one.low, one.high) for one in subject.allowed.intervals]
        lows = [low.least if isinstance(low, Limit) else low for low, _ in ends]
        highs = [high.greatest if isinstance(high, Limit) else high for _, high in ends]
        found |= {"raw_min": min(lows, default=subject.least), "raw_max": max(highs, default=subject.greatest)}
        return found | ({"decimals": subject.decimals} if subject.form == "scaled" else {})


def wrong(device: Device, against: list[Vector]) -> Iterator[Vector]:
    """Vectors that the plain reading of `device` does not answer as they say."""
    reading = Reading(device)
    for vector in against:
        if hasattr(reading, vector["kind"]):
            answer = reading.answer(vector)
            if any(vector.get(key) != value for key, value in answer.items()):
                yield {**vector, "instead": answer}


def test_a_second_reading_of_the_model_agrees() -> None:
    assert list(wrong(SAMPLE, VECTORS)) == []


def test_what_decodes_in_range_encodes_back() -> None:
    encoded = {
        (vector["point"], str(vector.get("with")), vector["float"]): vector.get("raw")
        for vector in VECTORS
        if vector["kind"] == "encode" and named(SAMPLE, vector["point"]).form == "scaled"
    }
    pairs = [
        (vector["raw"], encoded.get((vector["point"], str(vector.get("with")), vector["float"])))
        for vector in VECTORS
        if vector["kind"] == "decode" and vector["status"] == "ok"
    ]
    there = [(raw, back) for raw, back in pairs if back is not None]
    assert len(there) > 20
    assert all(raw == back for raw, back in there)


# What the vectors catch: one fact changed at a time must make the plain reading fail


def sample_with(item: str, change: Callable[[Point], Point]) -> Device:
    """The sample with one point changed."""
    return replace(SAMPLE, points=tuple(change(one) if one.item == item else one for one in SAMPLE.points))


def one_fact_at_a_time(subject: Point) -> Iterator[tuple[str, Point]]:
    """Near misses of a point: each fact that reaches generated code, a little wrong."""
    if subject.writable:
        for index, one in enumerate(subject.allowed.intervals):
            for what, other in near_intervals(one, subject):
                intervals = list(subject.allowed.intervals)
                intervals[index] = other
                yield (
                    f"range {index}: {what}",
                    replace(subject, allowed=replace(subject.allowed, intervals=tuple(intervals))),
                )
    for low, high in subject.allowed.units:
        yield "units low", replace(subject, allowed=units(str(low - Fraction(1, 10**4)), str(high)))
        yield "units high", replace(subject, allowed=units(str(low), str(high + Fraction(1, 10**4))))
    for index, case in enumerate(subject.scale or ()):
        for what, changed_case in near_cases(case):
            cases = list(subject.scale or ())
            cases[index] = changed_case
            yield f"case {index}: {what}", changed(subject, scale=tuple(cases))
    if subject.scale is not None:
        yield "decimals", changed(subject, decimals=(subject.decimals or 0) + 1)
    yield from names_and_places(subject)


def near_intervals(one: Interval, subject: Point) -> Iterator[tuple[str, Interval]]:
    """The interval with one end moved by one, or with a limit that nothing lifts."""
    for side in ("low", "high"):
        bound = getattr(one, side)
        for step in (-1, 1):
            if isinstance(bound, Limit):
                rule = replace(bound.rule, offset=bound.rule.offset + step)
                yield f"{side} {step:+}", replace(one, **{side: replace(bound, rule=rule)})
            elif subject.least <= bound + step <= subject.greatest:
                yield f"{side} {step:+}", replace(one, **{side: bound + step})
    # A low limit that is lifted is the least number that may be: nothing changes, so only the high one counts.
    if isinstance(one.high, Limit) and one.high.unless:
        yield "never lifted", replace(one, high=replace(one.high, unless=()))


def near_cases(case: ScaleCase) -> Iterator[tuple[str, ScaleCase]]:
    """The case with its rule a little wrong, or chosen by another number."""
    rule = case.rule
    for what, other in (
        ("ratio * 1.001", replace(rule, ratio=rule.ratio * Fraction(1001, 1000))),
        ("1 / ratio", replace(rule, ratio=1 / rule.ratio)),
        ("offset + 1", replace(rule, offset=rule.offset + 1)),
        ("offset - 1/2", replace(rule, offset=rule.offset - Fraction(1, 2))),
        ("no factors", replace(rule, factors=())),
        ("other power", replace(rule, factors=tuple(replace(one, power=-one.power) for one in rule.factors))),
    ):
        if other != rule:
            yield what, replace(case, rule=other)
    if case.raw is not None:
        yield "other number", replace(case, raw=case.raw + 5)


def near_codes(subject: Point) -> Iterator[tuple[str, Point]]:
    """The point with a special code a little wrong, or without its codes."""
    for index, special in enumerate(subject.specials):
        specials = list(subject.specials)
        specials[index] = replace(special, low=special.low - 1)
        yield f"special {special.name}", changed(subject, specials=tuple(specials))
        specials[index] = replace(special, no_value=not special.no_value)
        yield f"no value {special.name}", changed(subject, specials=tuple(specials))
        if subject.writable:
            specials[index] = replace(special, writable=not special.writable)
            yield f"writable {special.name}", changed(subject, specials=tuple(specials))
    if subject.specials:
        yield "no specials", changed(subject, specials=())


def names_and_places(subject: Point) -> Iterator[tuple[str, Point]]:
    """The point with a name's number, a bit, a code or an address a little wrong."""
    for index, entry in enumerate(subject.enum.entries if subject.enum else ()):
        assert subject.enum is not None
        entries = list(subject.enum.entries)
        entries[index] = replace(entry, raw=entry.raw + 5)
        yield f"entry {entry.name}", changed(subject, enum=replace(subject.enum, entries=tuple(entries)))
    for index, flag in enumerate(subject.flags):
        flags = list(subject.flags)
        others = [replace(flag, low=flag.low + 1), replace(flag, width=flag.width + 1)]
        if flag.values:
            moved = replace(flag.values[0], raw=flag.values[-1].raw + 7)
            others.append(replace(flag, values=(moved, *flag.values[1:])))
        for other in others:
            flags[index] = other
            yield f"flag {flag.name}", changed(subject, flags=tuple(flags))
    yield from near_codes(subject)
    place = subject.place
    yield "code", replace(subject, code=f"{subject.code}x")
    for key, number in subject.references.items():
        assert isinstance(number, int)
        other_numbers = replace(place, references={**subject.references, key: number + 1})
        yield f"reference {key}", replace(subject, place=other_numbers)
    yield "address", replace(subject, place=replace(place, addresses=tuple(one + 1 for one in place.addresses)))
    if len(place.addresses) > 1:
        yield "word order", replace(subject, place=replace(place, addresses=place.addresses[::-1]))
    if subject.bits is not None:
        high, low = subject.bits
        yield "lower bits", changed(subject, bits=(high - 1, low - 1))
        yield "fewer bits", changed(subject, bits=(high - 1, low))


CHANGES = [
    pytest.param(subject.item, other, id=f"{subject.item}: {what}")
    for subject in SAMPLE.points
    if subject.generated
    for what, other in one_fact_at_a_time(subject)
]


@pytest.mark.parametrize(("item", "other"), CHANGES)
def test_a_changed_fact_is_caught(item: str, other: Point) -> None:
    own = [vector for vector in VECTORS if vector.get("point") == item]
    assert next(wrong(sample_with(item, lambda _: other), own), None) is not None


# Corners that the sample does not have


def test_u64_numbers_beyond_int64_are_raw_only() -> None:
    found = vectors(sample_device((point("wide", 1, "u64"),)))
    counts = [vector["count"] for vector in found if "count" in vector and "point" in vector]
    assert max(counts) == 2**63 - 1
    assert {"kind": "check", "point": "wide", "raw": 2**64 - 1, "status": "ok"} in found


def test_a_limit_that_divides_by_zero() -> None:
    limit = Limit(linear(100, 0, value_of("ratio", -1)), (), 1, 100)
    subject = point("subject", 1, scale=scaled(10), decimals=1, allowed=allowed((0, limit)))
    found = vectors(sample_device((subject, point("ratio", 2, allowed=allowed((1, 100))))))
    zero = [vector for vector in found if vector.get("with") == {"ratio": 0}]
    assert {(vector["kind"], vector["status"]) for vector in zero} == {
        (kind, "zero_factor") for kind in ("encode", "encode_count", "check")
    }


def test_a_point_that_only_lifts_a_limit_is_an_argument() -> None:
    limit = Limit(linear(7), (("mode", ((2, 2), (4, 4))),), 0, 100)
    subject = point("subject", 1, allowed=allowed((0, limit)))
    found = vectors(sample_device((subject, point("mode", 2, allowed=allowed((0, 9))))))
    checks = {(one["with"]["mode"], one["status"]) for one in found if one["kind"] == "check" and one.get("raw") == 100}
    assert subject.arguments == subject.limit_arguments == ("mode",)
    assert {(2, "ok"), (4, "ok")} <= checks
    wrong_limits = [one for one in found if one.get("with", {}).get("mode") in (0, 9) and one["kind"] == "check"]
    assert {one["raw"]: one["status"] for one in wrong_limits} | {7: "ok", 8: "out_of_range"} == {
        one["raw"]: one["status"] for one in wrong_limits
    }


def test_factors_with_slope_and_intercept_find_their_zero() -> None:
    subject = point("subject", 1, scale=scaled(1, 0, value_of("other", slope=2, intercept=-8)))
    found = vectors(sample_device((subject, point("other", 2, allowed=allowed((0, 9))))))
    zeros = {vector["with"]["other"] for vector in found if vector.get("status") == "zero_factor"}
    assert zeros == {4}


def test_counts_reach_the_ends_of_int64_only_where_the_type_does() -> None:
    narrow = point("narrow", 1, scale=scaled(10), decimals=1)
    wide = point("wide", 2, "u32", scale=scaled(1), decimals=2)
    found = vectors(sample_device((narrow, wide)))
    tops = {
        item: max(one["count"] for one in found if one.get("point") == item and one["kind"] == "encode_count")
        for item in ("narrow", "wide")
    }
    assert tops == {"narrow": 2**31 - 1, "wide": 2**63 - 1}


def test_read_only_and_write_only_points() -> None:
    found = vectors(sample_device((point("read", 1, access="r"), point("write", 2, access="w"))))
    kinds = {item: {one["kind"] for one in found if one.get("point") == item} for item in ("read", "write")}
    reads = {"address", "facts", "decode_count", "read"}
    assert kinds == {"read": reads, "write": {"address", "facts", "encode_count", "check", "write"}}


def test_names_cannot_break_the_file() -> None:
    enum = Enum("odd", titles("Odd"), (Entry(1, 'a"b\n', titles("x"), None),), True)
    flag = Flag(0, 1, '"', titles("x"), 1, ())
    special = Special(3, 3, "\\", titles("x"), False)
    device = sample_device(
        (point("a", 1, enum=enum, allowed=allowed((1, 1))), point("b", 2, flags=(flag,), specials=(special,)))
    )
    found = vectors(device)
    assert {"kind": "name", "point": "a", "raw": 1, "name": 'a"b\n'} in found
    assert {"kind": "special", "point": "b", "special": "\\", "low": 3, "high": 3} in found


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
