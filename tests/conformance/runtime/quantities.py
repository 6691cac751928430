"""Scaled quantities and IEEE 754 numbers: what is refused, and how limits are told."""

from __future__ import annotations

import math
from decimal import Decimal
from fractions import Fraction
from typing import Any

from conformance.package import Package
from conformance.runtime.bench import refusal, refuses, table


def _point(package: Package, form: Any, **facts: Any) -> Any:
    """A point of that form."""
    runtime = package.runtime
    made = runtime.ReadWrite(form, at=runtime.holding(4), unit="V", **facts)
    return table(package, one=made).one


def check_scaled(package: Package) -> None:
    """A scaled quantity is converted; NaN, text and numbers out of range are refused."""
    runtime = package.runtime
    point = _point(package, runtime.Scaled(runtime.U16, runtime.Rule(num=10), decimals=1), allowed=((5, 100), (7, 7)))
    assert (point.encode(1.25), point.encode(Decimal("0.5")), point.encode(Fraction(1)), point.decode(5)) == (
        13,
        5,
        10,
        0.5,
    )
    refuses(runtime.RangeError, "one: 10.1 V is none of 0.5..10, 0.7 V", point.encode, 10.1)
    refuses(runtime.RangeError, "one: 10.1 V is none of 0.5..10, 0.7 V", point.encode_count, 101)
    refuses(runtime.RangeError, "one: raw 101 is none of 5..100, 7", point.check, 101)
    refuses(runtime.RangeError, "one: 1e+300 V is none of 0.5..10, 0.7 V", point.encode, 1e300)
    assert refusal(point.encode, 10**400).status == "out_of_range"
    for nan in (math.nan, Decimal("NaN"), Decimal("sNaN")):
        refuses(runtime.NotANumberError, "one: the value is NaN", point.encode, nan)
    refuses(runtime.WrongTypeError, "one: takes a number, not True", point.encode, True)
    refuses(runtime.WrongTypeError, "one: takes a number, not 'x'", point.encode, "x")
    assert [refusal(point.encode, value).status for value in (math.inf, -math.inf, 1e308)] == ["out_of_range"] * 3
    assert (point.told(25), point.same(1, 1), point.same(1, 2)) == ("2.5 V", True, False)
    refuses(runtime.WrongTypeError, "one: takes an integer, not 'x'", point.encode_count, "x")
    wide = _point(package, runtime.Scaled(runtime.U64, runtime.Rule(), decimals=None, encodes=False))
    none = "no 64-bit integer holds the counts, so there are none: use raw numbers or values"
    refuses(runtime.WrongTypeError, f"one: {none}", wide.decode_count, 1)
    refuses(runtime.WrongTypeError, f"one: {none}", wide.encode_count, 1)
    only = "numbers of this scale have more than 53 bits, so values are only decoded: use raw numbers"
    refuses(runtime.WrongTypeError, f"one: {only}", wide.encode, 1.0)
    assert (wide.decimals, wide.size) == (None, 4)
    refuses(runtime.ResultOverflowError, "one: raw 9223372036854775808 gives a count beyond 64 bits",
            _point(package, runtime.Scaled(runtime.U64, runtime.Rule(), decimals=0)).decode_count, 1 << 63)  # fmt: skip


def check_texts(package: Package) -> None:
    """A value as people see it: what the device holds for it, with the decimals of the description."""
    runtime = package.runtime
    form = runtime.Scaled(runtime.S16, runtime.Rule(num=8), decimals=1)
    codes = runtime.Codes({"off": -5}, writable=("off",))
    for around in (form, runtime.WithWritableCodes(form, codes)):
        point = _point(package, around, display=2)
        assert (point.text(50), point.text(0.13), point.text(-0.124)) == ("50.00 V", "0.13 V", "-0.13 V")
        assert (point.told(1), point.told_exactly(1), point.told(1 << 15)) == ("0.13 V", "0.125 V", "raw 32768")
        assert repr(point).endswith(", shown with 2 decimals>")
        refuses(runtime.RangeError, "one: 40000 is outside -32768..32767", point.text, 5000)
        refuses(runtime.NotANumberError, "one: the value is NaN", point.text, math.nan)
        assert refusal(point.text, "x").status == "wrong_type"
    assert (point.text(point.special.off), point.text(point.decode(-5))) == ("off", "off")
    plain = _point(package, form)
    assert (plain.text(50), plain.told(1)) == ("50 V", "0.125 V")
    assert repr(_point(package, form, display=1)).endswith(", shown with 1 decimal>")
    floating = _point(package, runtime.Floating(runtime.F64), display=0)
    assert (floating.text(2.5), floating.text(-0.4), floating.text(1e22)) == ("3 V", "0 V", "1" + 22 * "0" + " V")
    refuses(runtime.RangeError, "one: inf is no value of this point", floating.text, math.inf)


def check_exact(package: Package) -> None:
    """Where the other languages cannot compute a scale exactly, it overflows."""
    runtime = package.runtime
    point = _point(package, runtime.Scaled(runtime.S32, runtime.Rule(), decimals=0, most=100))
    for function in (point.decode, point.decode_count):
        assert (function(100), function(-100)) == (100, -100)
        for raw in (101, -101):
            beyond = f"one: raw {raw} is beyond 100, up to which the scale is exact"
            refuses(runtime.ResultOverflowError, beyond, function, raw)


def check_floating(package: Package) -> None:
    """binary32 and binary64 numbers, with limits and without."""
    runtime = package.runtime
    point = _point(package, runtime.Floating(runtime.F32, units=((0.1, 2.0), (5.0, 6.0))))
    assert (point.encode(0.1), point.decode(0x40000000), point.told(0x3FC00000)) == (0x3DCCCCCD, 2.0, "1.5 V")
    texts = [point.text(value) for value in (25.3, 100.0, 16777216.0, 1e-9)]
    assert texts == ["25.3 V", "100 V", "16777216 V", "1e-09 V"]
    refuses(runtime.RangeError, "one: 3 V is outside 0.1..2 or 5..6 V", point.encode, 3)
    refuses(runtime.RangeError, "one: raw 0 is outside 0.1..2 or 5..6 V", point.check, 0)
    assert point.check(0x40B00000) is None
    free = _point(package, runtime.Floating(runtime.F32))
    for value in (1e39, -1e39, 10**400, -(10**400), math.inf, -math.inf):
        assert refusal(free.encode, value).status == "out_of_range"
    refuses(runtime.RangeError, "one: inf V is no finite binary32", free.encode, math.inf)
    refuses(runtime.NotANumberError, "one: the value is NaN", free.encode, math.nan)
    refuses(runtime.NotANumberError, "one: the value is NaN", free.check, 0x7FC00000)
    assert [refusal(free.check, raw).status for raw in (0x7F800000, -1, 1 << 32)] == ["out_of_range"] * 3
    assert (free.same(0, 1 << 31), free.same(1, 2), free.same(3, 3)) == (True, False, True)
    assert (free.same(0x7FC00000, 0x7FC00000), free.decimals) == (True, 0)
    for function in (free.decode_count, free.encode_count):
        refuses(runtime.WrongTypeError, "one: a floating-point number has no counts: use raw numbers or values",
                function, 1)  # fmt: skip
    open_ended = _point(package, runtime.Floating(runtime.F32, units=((-1e39, 5.0),)))
    assert (open_ended.encode(1.0), refusal(open_ended.encode, 6.0).status) == (0x3F800000, "out_of_range")
    assert _point(package, runtime.Floating(runtime.F64)).encode(0.1) == 0x3FB999999999999A


def check_factors(package: Package) -> None:
    """Scales and limits that other points set, and what those may be."""
    runtime = package.runtime
    factor = runtime.Factor("other", slope=2, intercept=1, codes=((7, 9),))
    point = _point(package, runtime.Scaled(runtime.U16, runtime.Rule(factors=(factor,)), decimals=0))
    assert (point.scale_needs, point.encode(3, {"other": 2}), point.decode(15, {"other": 2})) == (("other",), 15, 3.0)
    missing = "one: needs the raw number of other: pass raws={'other': ...}"
    refuses(runtime.MissingRawError, missing, point.decode, 15)
    refuses(runtime.MissingRawError, missing, point.encode, 15)
    code = "one: other holds a special code, which is no quantity"
    assert [str(refusal(point.decode, 1, {"other": raw})) for raw in (7, 9)] == [code, code]
    assert point.decode(13, {"other": 6}) == 1.0
    assert point.told(15) == "raw 15"
    floating = runtime.Factor("other", f32=True)
    number = _point(package, runtime.Scaled(runtime.U16, runtime.Rule(factors=(floating,)), decimals=0))
    assert number.encode(2, {"other": 0x3FC00000}) == 3
    for raw in (0, 0x7FC00000, 0x7F800000):
        refuses(runtime.ZeroFactorError, "one: other is no number or zero", number.decode, 1, {"other": raw})
    plain = _point(package, runtime.Scaled(runtime.U16, runtime.Rule(factors=(runtime.Factor("other"),)), decimals=0))
    refuses(runtime.ZeroFactorError, "one: other is zero", plain.decode, 1, {"other": 0})
    power = runtime.Rule(factors=(runtime.Factor("other", ten_to=(-2, 3)),))
    ten = _point(package, runtime.Scaled(runtime.U16, power, decimals=0))
    assert [ten.encode(5, {"other": raw}) for raw in (0, 3)] == [5, 5000]
    assert ten.decode(5, {"other": -2}) == 500.0
    refuses(runtime.ResultOverflowError, "one: other is 4, outside -2..3", ten.decode, 1, {"other": 4})
    refuses(runtime.ResultOverflowError, "one: other is -3, outside -2..3", ten.decode, 1, {"other": -3})


def check_beyond_binary64(package: Package) -> None:
    """A scale that takes numbers beyond binary64 is refused there, and right elsewhere."""
    runtime = package.runtime
    point = _point(package, runtime.Scaled(runtime.U16, runtime.Rule(den=10**400), decimals=0))
    assert point.decode(0) == 0.0
    refuses(runtime.ResultOverflowError, "one: raw 1 gives no binary64", point.decode, 1)
    assert runtime.Layout([point], range(4, 5)).decode(b"\0\0") == {"one": 0.0}
    overflows = "one: raw 1 gives no binary64"
    refuses(runtime.ResultOverflowError, overflows, runtime.Layout([point], range(4, 5)).decode, b"\0\1")
    edge = _point(package, runtime.Scaled(runtime.U16, runtime.Rule(den=10**305), decimals=0))
    assert edge.decode(100) == 1e307
    refuses(runtime.ResultOverflowError, "one: raw 2000 gives no binary64", edge.decode, 2000)


def check_cases(package: Package) -> None:
    """A scale that another point chooses."""
    runtime = package.runtime
    cases = (runtime.Case("mode", 1, runtime.Rule(num=10)), runtime.Case("mode", 2, runtime.Rule()))
    point = _point(package, runtime.Scaled(runtime.U16, cases, decimals=0))
    assert (point.scale_needs, point.decode(20, {"mode": 1}), point.decode(20, {"mode": 2})) == (("mode",), 2.0, 20.0)
    refuses(runtime.NoCaseError, "one: no scale for these raw numbers of mode", point.decode, 1, {"mode": 3})
    ended = (cases[0], runtime.Case(None, None, runtime.Rule(num=100)))
    other = _point(package, runtime.Scaled(runtime.U16, ended, decimals=0))
    assert other.decode(200, {"mode": 3}) == 2.0


def check_limits(package: Package) -> None:
    """Limits that follow another point, but for some of its numbers, and never beyond what is ever allowed."""
    runtime = package.runtime
    rule = runtime.Rule(factors=(runtime.Factor("top"),))
    limit = runtime.Limit(rule, least=2, greatest=50, unless={"switch": ((0, 1), (4, 4))})
    point = _point(package, runtime.Integer(runtime.U16), allowed=((2, limit), (limit, 60)))
    assert (point.limit_needs, point.raw_limits) == (("top", "switch"), (2, 60))
    only = _point(package, runtime.Integer(runtime.U16), allowed=((1, limit),))
    held = {"top": 20, "switch": 2}
    assert only.encode(20, held) == 20
    refuses(runtime.RangeError, "one: 21 V is outside 1..20 V (set by top and switch)", only.encode, 21, held)
    refuses(runtime.RangeError, "one: raw 21 is outside 1..20 (set by top and switch)", only.check, 21, held)
    assert only.encode(50, {**held, "switch": 1}) == 50
    assert only.encode(50, {**held, "switch": 4}) == 50
    refuses(
        runtime.RangeError,
        "one: 51 V is outside 1..50 V (set by top and switch)",
        only.encode,
        51,
        {**held, "switch": 0},
    )
    refuses(
        runtime.RangeError, "one: 51 V is outside 1..50 V (set by top and switch)", only.encode, 51, {**held, "top": 99}
    )
    assert refusal(only.encode, 1, {**held, "top": 0}).status == "out_of_range"
    low = _point(package, runtime.Integer(runtime.U16), allowed=((limit, 60),))
    refuses(runtime.RangeError, "one: 19 V is outside 20..60 V (set by top and switch)", low.encode, 19, held)
    assert (low.encode(2, {**held, "switch": 0}), low.encode(2, {**held, "top": 1})) == (2, 2)
