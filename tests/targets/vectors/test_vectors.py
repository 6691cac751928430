"""Conformance vectors: held against numbers worked out by hand; each fact of a point shows in them."""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterator
from dataclasses import replace
from fractions import Fraction
from typing import Any

import pytest
from fieldscribe.families.modbus.targets import vectors as modbus_vectors
from fieldscribe.model import Device, Interval, Limit, Point, ScaleCase, Text
from fieldscribe.vendoring.selection import select
from support.models import changed, named, point, sample_device, units
from support.sample_vectors import SAMPLE, VECTORS, vectors
from support.vector_file import Vector


def f64(value: float) -> str:
    """Return the bits of a binary64."""
    return struct.pack(">d", value).hex()


def by_hand(kind: str, item: str, **facts: object) -> Vector:
    """A vector of a point."""
    return {"kind": kind, "point": item, **facts}


def given(raws: dict[str, int]) -> dict[str, Any]:
    """The run-time numbers of a vector."""
    return {"with": raws}


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
    printed = [vector for vector in VECTORS if vector.get("frame")]
    assert printed == [
        {"kind": "build", "frame": "write_base", **request, "status": "ok", "bytes": "0506102801f40c91"},
        {"kind": "reply", "frame": "write_base", **request, "bytes": "0506102801f4a854", "status": "bad_crc"},
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


@pytest.mark.parametrize("item", [subject.item for subject in SAMPLE.points if subject.generated])
def test_a_changed_fact_is_caught(item: str) -> None:
    right = [vector for vector in vectors_of(item, SAMPLE) if vector.get("point") == item]

    def is_caught(other: Point) -> bool:
        changed_vectors = vectors_of(item, sample_with(item, lambda _: other))
        return any(vector not in changed_vectors for vector in right)

    subject = next(point for point in SAMPLE.points if point.item == item)
    assert [what for what, other in one_fact_at_a_time(subject) if not is_caught(other)] == []


def vectors_of(item: str, device: Device) -> list[Vector]:
    """The vectors of a point and of those it depends on, without those of frames."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(modbus_vectors, "frames", lambda *_: None)
        return vectors(select(device, [item]))


@pytest.mark.parametrize("size", [256, 258, 1000])
def test_a_long_text_has_each_byte(size: int) -> None:
    """A text may be longer than there are bytes."""
    memo = point("memo", 0, "text", order=range(size // 2), text=Text(size, "ascii"))
    taken = [vector["words"] for vector in vectors(sample_device((memo,))) if vector["kind"] == "text_decode"]
    assert {len(words) for words in taken} == {size // 2}
    assert {byte for words in taken for word in words for byte in divmod(word, 256)} == set(range(256))
