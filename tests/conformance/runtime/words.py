"""Words of flags, special codes, and the forms around other forms."""

from __future__ import annotations

import enum
import types
from typing import Any

from conformance.package import Package
from conformance.runtime.bench import refusal, refuses, table


def _mode(package: Package) -> Any:
    """Names of a field."""
    return package.runtime.NamedNumber("Mode", {"IDLE": 0, "FAST": 2})


def _word(package: Package) -> Any:
    """A word with a flag, one that 0 makes true, a field and a field without names."""
    runtime = package.runtime

    flags = {"on": runtime.Flag(0), "fault": runtime.Flag(1, active=0)}
    fields = {"mode": runtime.Field(4, 2, _mode(package)), "rest": runtime.Field(8, 3)}
    return _named(type("Readers", (runtime.Word,), {**flags, **fields}))


def _named(readers: type) -> Any:
    """A word with one named bit, as generated ones are."""
    bases = (readers, enum.IntFlag)
    names = types.prepare_class("Word", bases)[1]
    names["ON"] = 1
    return enum.EnumType("Word", bases, names)  # type: ignore[arg-type]  # the names of an enum are of a type of their own


def check_flags(package: Package) -> None:
    """A word is read, shown and put together by what its flags mean."""
    word = _word(package)
    one, names = word(0x0521), word.mode.names
    assert (one.on, one.fault, one.mode, one.rest, type(one.mode)) == (True, True, names.FAST, 5, names)
    assert (str(one), repr(one)) == (
        "0x0521 (on, fault, mode=fast, rest=5)",
        "<Word 0x0521 (on, fault, mode=fast, rest=5)>",
    )
    assert (f"{one}", f"{one:04x}", word(0x0012).mode, word(0x0012).fault) == (str(one), "0521", 1, False)
    assert [word.on.place(True), word.on.place(False), word.fault.place(True), word.fault.place(False)] == [1, 0, 0, 2]
    assert (word.mode.place(names.FAST), word.rest.place(7), word._joined(1, 4, 5), word._joined()) == (32, 0x700, 5, 0)
    for number, text in (
        (4, "4 does not fit"),
        (-1, "-1 does not fit"),
        (10**5000, "a number of thousands of digits does not fit"),
    ):
        refuses(package.runtime.RangeError, f"{text} into 2 bits", word.mode.place, number)
    refuses(package.runtime.WrongTypeError, "takes an integer, not 'x'", word.mode.place, "x")
    assert (word.on.width, word.mode.width, word.mode.names, word.rest.names) == (1, 2, names, None)
    assert (word.on.told("on", 1), word.on.told("on", 0), word.mode.told("mode", 0x10)) == ("on", "", "mode=1")

    bare = _named(package.runtime.Word)
    assert (str(bare(2)), f"{bare(2)}") == ("0x0002", "0x0002")


def _codes(package: Package) -> Any:
    codes = {"off": 0, "fault": 0xFFFF, "band": (0xFFF0, 0xFFF4)}
    return package.runtime.Codes(codes, no_value=("fault", "band"), writable=("off",))


def check_codes(package: Package) -> None:
    """Codes are found by name, and by raw number also in a band."""
    codes, special = _codes(package), package.runtime.Special
    assert codes(0) == codes.off == codes["off"] == special("off", 0, False, True)
    assert [codes(raw) for raw in (0xFFEF, 0xFFF0, 0xFFF4, 0xFFF5)] == [
        None, special("band", 0xFFF0, True), special("band", 0xFFF4, True), None,
    ]  # fmt: skip
    assert (str(codes.fault), codes.fault.no_value, codes.fault.writable) == ("fault", True, False)
    assert (list(codes), len(codes)) == (["off", "fault", "band"], 3)
    known = "there is no special code {}, only off, fault, band"
    assert refusal(codes.__getitem__, "none").args == (known.format("none"),)
    assert refusal(codes.__getitem__, [1]).args == (known.format("[1]"),)
    band = "band is all of 65520..65524: call the codes with a raw number"
    assert refusal(codes.__getitem__, "band").args == (band,)
    refuses(AttributeError, known.format("none"), getattr, codes, "none")
    refuses(AttributeError, known.format("_own"), getattr, codes, "_own")
    refuses(AttributeError, band, getattr, codes, "band")
    assert not package.runtime.Special("x", 1).no_value
    assert not package.runtime.Special("x", 1).writable


def check_coded(package: Package) -> None:
    """A point with codes: none is computed with, and only some are written."""
    runtime, codes = package.runtime, _codes(package)
    facts = {"at": runtime.holding(1), "code": "A1", "unit": "V", "allowed": ((1, 0xFFFF),)}
    plain = runtime.Integer(runtime.U16)
    fixed_form = runtime.WithWritableCodes(plain, runtime.Codes({"off": 0x81}, writable=("off",)))
    made = table(
        package,
        read=runtime.ReadWrite(runtime.WithCodes(plain, codes), **facts),
        write=runtime.ReadWrite(runtime.WithWritableCodes(plain, codes), **facts),
        fixed=runtime.ReadWrite(fixed_form, fixed=(0x00F0, 0x0010), **facts),
    )
    read, write, fixed = made.read, made.write, made.fixed
    assert (read.decode(5), read.decode(0), read.encode(5), write.encode(codes.off), write.encode(5)) == (
        5,
        codes.off,
        5,
        0,
        5,
    )
    hints = {0: "to write that, write special.off", 0xFFFF: "it is only read"}
    for raw, hint in hints.items():
        name = str(codes(raw))
        for point in (read, write):
            would = f"A1 {point.facts.item}: raw {raw} would be the special code {name}: {hint}"
            refuses(runtime.SpecialCodeError, would, point.encode, raw)
            refuses(runtime.SpecialCodeError, would, point.encode_count, raw)
            is_one = f"A1 {point.facts.item}: raw {raw} is the special code {name}, which has no count: use decode"
            refuses(runtime.SpecialCodeError, is_one, point.decode_count, raw)
    assert refusal(write.encode, 0xFFFF).special == "fault"
    refuses(
        runtime.SpecialCodeError, "A1 write: raw 65535 is the special code fault: it is only read", write.check, 0xFFFF
    )
    refuses(
        runtime.UnknownValueError,
        "A1 write: other is no special code of this point",
        write.encode,
        runtime.Special("other", 0),
    )
    assert refusal(write.encode, codes.fault).status == "special"
    taken = "A1 write: takes a number or a special code, as in special.off, not 'off'"
    refuses(runtime.WrongTypeError, taken, write.encode, "off")
    assert (codes.said(codes.off), codes.said(codes(0xFFF1))) == ("special.off", "special(65521)")
    assert (write.check(0), write.check(7), read.special, read.special(0).name) == (None, None, codes, "off")
    assert (write.told(0), write.told(7)) == ("off", "7 V")
    assert (fixed.encode(0x0F), fixed.encode_count(0x0101), fixed.decode(0x81).name) == (0x1F, 0x0111, "off")
    message = "A1 fixed: raw 32 must have 0010h in the bits 00F0h"
    refuses(runtime.RangeError, message, fixed.check, 0x20)
    assert (fixed.check(0x10), fixed.check(0x81), fixed.encode(fixed.special.off)) == (None, None, 0x81)
    assert (fixed.decimals, fixed.width, fixed.raw_limits, fixed.name_of(1)) == (0, 16, (1, 0xFFFF), None)


def check_around(package: Package) -> None:
    """A form with special codes has all attributes of the form that it wraps."""
    runtime = package.runtime
    rule = runtime.Rule(num=10, factors=(runtime.Factor("other"),))
    scaled = runtime.Scaled(runtime.S16, rule, decimals=2)
    around = runtime.WithCodes(scaled, runtime.Codes({"off": 5}))
    assert (around.wire, around.needs, around.decimals, around.refused) == (
        runtime.S16,
        ("other",),
        2,
        runtime.RangeError,
    )
    assert (around.shown(30, {"other": 2}), around.limits(4), around.choices(" V")) == ("1.5", (-8, 7), None)
    named = runtime.WithCodes(
        runtime.Named(runtime.U16, mode := _mode(package), closed=True), runtime.Codes({"off": 5})
    )
    assert (named.names, named.name_of(2), named.refused) == (mode, "fast", runtime.UnknownValueError)
    assert (named.limits(16), named.choices("")) == ((0, 2), "none of 0 idle, 2 fast")
    floating = runtime.WithCodes(runtime.Floating(runtime.F32), runtime.Codes({"off": 5}))
    assert (floating.same(0, 1 << 31), floating.same(0, 1)) == (True, False)
