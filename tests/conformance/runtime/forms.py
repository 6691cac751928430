"""Integers, bits, enums, texts and digits: accepted and refused values, with the messages."""

from __future__ import annotations

import copy
import enum
import json
from typing import Any

from conformance.package import Package
from conformance.runtime.bench import refusal, refuses, table


def _names(package: Package, **numbers: int) -> Any:
    """An enum with these names."""
    return package.runtime.NamedNumber("Color", numbers)


class Other(enum.IntEnum):
    """The same numbers with other names."""

    ONE = 1


class Bits(enum.IntFlag):
    """Flags of a word."""

    LOW = 1
    TOP = 0x8000


def _point(package: Package, form: Any, **facts: Any) -> Any:
    """A point of that form."""
    runtime = package.runtime
    made = runtime.ReadWrite(form, at=runtime.holding(4, 5), code="A1", unit="V", **facts)
    return table(package, one=made).one


def check_types(package: Package) -> None:
    """The widths of types, and their limits."""
    runtime = package.runtime
    found = [(getattr(runtime, name).bits, getattr(runtime, name).signed) for name in ("BIT", "U8", "S16", "U32")]
    assert found == [(1, False), (8, False), (16, True), (32, False)]
    assert (runtime.F32.bits, runtime.F64.bits, runtime.S64.limits(64)) == (32, 64, (-(1 << 63), (1 << 63) - 1))
    assert [runtime.S8.number(pattern, 4) for pattern in (7, 8, 0xFF, 0x10)] == [7, -8, -1, 0]


def check_whole(package: Package) -> None:
    """Integers are accepted; values that only look like integers are refused."""
    runtime = package.runtime
    point = _point(package, runtime.Integer(runtime.U16), allowed=((2, 5), (9, 9)))
    assert (point.encode(5), point.label, point.raw_limits, point.allowed) == (5, "A1 one", (2, 9), ((2, 5), (9, 9)))
    refuses(runtime.RangeError, "A1 one: 6 V is none of 2..5, 9 V", point.encode, 6)
    refuses(runtime.RangeError, "A1 one: 6 V is none of 2..5, 9 V", point.encode_count, 6)
    refuses(runtime.RangeError, "A1 one: raw 6 is none of 2..5, 9", point.check, 6)
    refuses(runtime.WrongTypeError, "A1 one: takes a number, not True", point.encode, True)
    refuses(runtime.WrongTypeError, "A1 one: takes a number, not True", point.check, True)
    refuses(runtime.WrongTypeError, "A1 one: takes an integer, not 'x'", point.encode, "x")
    refuses(runtime.RangeError, "A1 one: 2.5 is no integer: only whole numbers are taken", point.encode, 2.5)
    assert type(point.encode(5.0)) is int
    assert refusal(point.encode, 6).__cause__ is None
    free = _point(package, runtime.Integer(runtime.S16))
    for function in (free.decode, free.decode_count):
        assert (function(-32768), function(32767)) == (-32768, 32767)
        sign = "A1 one: 32768 is no raw number, which is -32768..32767, with its sign: from_words gives it"
        refuses(runtime.RangeError, sign, function, 32768)
        refuses(
            runtime.RangeError, "A1 one: -1 is no raw number, which is 0..65535", getattr(point, function.__name__), -1
        )
    assert (free.raw_limits, free.allowed, free.name_of(1)) == ((-32768, 32767), ((-32768, 32767),), None)
    assert (free.decimals, free.names, free.scale_needs, free.limit_needs, free.size) == (0, None, (), (), 1)
    huge = refusal(free.encode, 10**5000)
    assert str(huge) == "A1 one: a number of thousands of digits V is outside -32768..32767 V"


def check_words(package: Package) -> None:
    """Words that are none, too few of them, and the order of two."""
    runtime = package.runtime
    point = _point(package, runtime.Integer(runtime.S32))
    assert (point.from_words((0xFFFF, 0xFFFE)), point.to_words(-2)) == (-2, (0xFFFF, 0xFFFE))
    refuses(runtime.WrongLengthError, "A1 one: takes 2 words, not 1", point.from_words, (1,))
    refuses(runtime.RangeError, "A1 one: 65536 is outside 0..65535", point.from_words, (0, 0x10000))
    refuses(runtime.RangeError, "A1 one: -1 is outside 0..65535", point.from_words, (-1, 0))
    refuses(runtime.WrongTypeError, "A1 one: takes an integer, not None", point.from_words, (None, 0))
    refuses(runtime.RangeError, f"A1 one: {1 << 31} is outside {-1 << 31}..{(1 << 31) - 1}", point.to_words, 1 << 31)
    refuses(runtime.WrongTypeError, "A1 one: takes a number, not False", point.from_words, (False, 1))
    refuses(runtime.WrongTypeError, "A1 one: takes a number, not True", point.to_words, True)
    single = runtime.ReadWrite(runtime.Integer(runtime.U32), at=runtime.parameter(7))
    assert (single.from_words((1, 2)), single.to_words(0x30004)) == (0x10002, (3, 4))
    turned = runtime.ReadWrite(runtime.Integer(runtime.U32), at=runtime.holding(8, 7), write_at=runtime.holding(1, 2))
    assert (turned.from_words((1, 2)), turned.to_words(0x30004)) == (0x20001, (3, 4))


def check_bits(package: Package) -> None:
    """One bit, and bits of a word."""
    runtime = package.runtime
    bit = _point(package, runtime.Bit())
    assert (bit.encode(True), bit.encode(0), bit.decode(1), bit.decode(0)) == (1, 0, True, False)
    assert (bit.check(True), bit.width, bit.size) == (None, 1, 1)
    assert type(bit.encode(True)) is int
    refuses(runtime.RangeError, "A1 one: 2 V is outside 0..1 V", bit.encode, 2)
    refuses(runtime.RangeError, "A1 one: 0.5 is no integer: only whole numbers are taken", bit.encode, 0.5)
    refuses(runtime.WrongTypeError, "A1 one: takes an integer, not '1'", bit.encode, "1")
    group = _point(package, runtime.Integer(runtime.S16), bits=(6, 4), fixed=(0x8001, 0x0001))
    assert (group.width, group.size, group.extract(0x0070), group.from_words((0x30,))) == (3, 1, -1, 3)
    assert (group.insert(0xFFFF, 0), group.insert(0, -1), group.raw_limits) == (0x7F8F, 0x71, (-4, 3))
    assert bit.insert(0xFFFE, 1) == 0xFFFF


def check_names(package: Package) -> None:
    """Enums, open and closed, and words of flags."""
    runtime, color = package.runtime, _names(package, RED=1, BLUE=3)
    closed = _point(package, runtime.Named(runtime.U16, color, closed=True))
    assert (closed.decode(3), closed.decode(2), closed.encode(color.RED)) == (color.BLUE, color(2), 1)
    assert (closed.raw_limits, closed.name_of(1), closed.name_of(2)) == ((1, 3), "red", None)
    refuses(runtime.UnknownValueError, "A1 one: 2 V is none of 1 red, 3 blue", closed.encode, 2)
    refuses(runtime.UnknownValueError, "A1 one: raw 2 is none of 1 red, 3 blue", closed.check, 2)
    refuses(runtime.UnknownValueError, f"A1 one: {Other.ONE!r} is no Color", closed.encode, Other.ONE)
    refuses(runtime.WrongTypeError, "A1 one: takes Color.RED, not 'red'", closed.encode, "red")
    refuses(runtime.WrongTypeError, "A1 one: takes Color.RED or Color.BLUE, not True", closed.encode, True)
    bounded = _point(package, runtime.Named(runtime.U16, color, closed=True), allowed=((0, 2),))
    assert bounded.encode(1) == 1
    assert refusal(bounded.encode, 3).status == "unknown_value"
    refuses(runtime.UnknownValueError, "A1 one: 2 V is none of 1 red, 3 blue", closed.encode, color(2))
    opened = _point(package, runtime.Named(runtime.U16, color))
    assert (opened.encode(color(2)), type(opened.encode(color(2))), type(opened.decode(2))) == (2, int, color)
    refuses(runtime.WrongTypeError, "A1 one: takes a raw number, which is an integer, not 2.5", opened.decode, 2.5)
    assert (opened.encode(2), opened.raw_limits) == (2, (0, 65535))
    refuses(runtime.RangeError, "A1 one: 65536 V is outside 0..65535 V", opened.encode, 65536)
    word = _point(package, runtime.Flags(runtime.S16, Bits))
    assert (word.decode(-1), word.encode(Bits.TOP), word.encode(Bits.LOW)) == (Bits(0xFFFF), -0x8000, 1)
    assert (word.encode(-2), word.names) == (-2, Bits)
    refuses(runtime.UnknownValueError, f"A1 one: {color.RED!r} is no Bits", word.encode, color.RED)
    assert refusal(word.encode, 0x10000).status == "out_of_range"
    assert refusal(_point(package, runtime.Flags(runtime.U16, Bits)).encode, -1).status == "out_of_range"


def check_open_enums(package: Package) -> None:
    """A number without a name is a member all the same."""
    color = _names(package, RED=1, BLUE=3)
    unknown, red = color(77), color.RED
    assert (unknown, hash(unknown), int(unknown), unknown.value) == (77, hash(77), 77, 77)
    assert (isinstance(unknown, color), unknown.is_named, red.is_named, list(color)) == (
        True,
        False,
        True,
        [red, color.BLUE],
    )
    assert (repr(unknown), unknown.name, str(unknown), f"{unknown}", f"{unknown:04x}") == (
        "Color(77)", "Color(77)", "77", "77", "004d",
    )  # fmt: skip
    assert (repr(red), red.name, str(red), f"{red}", f"{red:d}") == ("<Color.RED: 1>", "RED", "red", "red", "1")
    assert (unknown == color(77), unknown != color(78), {unknown: "x"}[77], json.dumps(unknown)) == (
        True,
        True,
        "x",
        "77",
    )
    assert (copy.deepcopy(unknown), color(True)) == (unknown, red)
    for bad in ("RED", 2.5, None):
        assert str(refusal(color, bad)) == f"{bad!r} is not a valid Color"


def check_texts(package: Package) -> None:
    """Texts and digits."""
    runtime, color = package.runtime, _names(package, RED=1, BLUE=3)
    text = _point(package, runtime.Text(4))
    assert (text.decode(0x41422020), text.encode("AB"), text.encode("")) == ("AB", 0x41422020, 0x20202020)
    for bad in ("ABCDE", "\u20ac", "\xe4", "\x7f", 5):
        message = f"A1 one: {bad} V is no text of at most 4 printable ascii characters"
        refuses(runtime.RangeError, message, text.encode, bad)
    assert _point(package, runtime.Text(4, "latin-1")).encode("\xe4\xa0") == 0xE4A02020
    assert refusal(_point(package, runtime.Text(4, "latin-1")).encode, "\x9f").status == "out_of_range"
    text.check(0x41424344)
    for bad_raw in (-1, 1 << 32, 0x41420041):
        assert refusal(text.check, bad_raw).status == "out_of_range"
    for function in (text.decode_count, text.encode_count):
        refuses(runtime.WrongTypeError, "A1 one: a text has no counts: use raw numbers or values", function, 1)
    refuses(runtime.RangeError, "A1 one: 4294967296 is no raw number, which is 0..4294967295", text.decode, 1 << 32)
    digits = _point(package, runtime.Digits(runtime.U16, color, count=3))
    assert (digits.decode(4132), digits.encode((1, color.BLUE, 1))) == ((41, color.BLUE, 2), 131)
    assert [type(digit) for digit in digits.decode(4132)] == [color] * 3
    digits.check(131)
    assert [refusal(digits.check, raw).status for raw in (132, -1, 65536 + 133)] == ["unknown_value"] * 3
    assert (digits.name_of(3), digits.name_of(2)) == ("blue", None)
    refuses(runtime.WrongTypeError, "A1 one: takes 3 digits, not 131", digits.encode, 131)
    refuses(runtime.WrongTypeError, "A1 one: takes 3 digits, not '131'", digits.encode, "131")
    refuses(runtime.WrongLengthError, "A1 one: takes 3 digits, not 2", digits.encode, (1, 3))
    refuses(runtime.UnknownValueError, f"A1 one: {Other.ONE!r} is no Color", digits.encode, (1, 3, Other.ONE))
    wrong = "A1 one: (1, 2, 3) V is not made of 3 digits out of 1 red, 3 blue"
    refuses(runtime.UnknownValueError, wrong, digits.encode, (1, 2, 3))
    narrow = _point(package, runtime.Digits(runtime.U8, color, count=3))
    edge = _point(package, runtime.Digits(runtime.U8, _names(package, TWO=2, FIVE=5, SIX=6), count=3))
    assert (edge.encode((2, 5, 5)), refusal(edge.encode, (2, 5, 6)).status) == (255, "unknown_value")
    assert (narrow.encode((1, 1, 1)), refusal(narrow.encode, (3, 3, 3)).status) == (111, "unknown_value")
