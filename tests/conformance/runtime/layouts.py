"""Layouts: points of words that are transferred together, decoded and encoded at once."""

from __future__ import annotations

import pickle
from typing import Any

from conformance.package import Package
from conformance.runtime.bench import devices, refuses, table


def _points(package: Package) -> dict[str, Any]:
    """Points of many shapes in one block of registers: alone, wide, turned, and several in a word."""
    runtime = package.runtime
    number, scaled = runtime.Integer(runtime.U16), runtime.Scaled(runtime.S16, runtime.Rule(num=10), decimals=1)
    return {
        "speed": runtime.ReadWrite(scaled, at=runtime.holding(10)),
        "count": runtime.ReadWrite(runtime.Integer(runtime.S32), at=runtime.holding(11, 12)),
        "turned": runtime.ReadWrite(runtime.Integer(runtime.U32), at=runtime.holding(14, 13)),
        "low": runtime.ReadWrite(runtime.Integer(runtime.S8), at=runtime.holding(15), bits=(7, 0)),
        "high": runtime.ReadWrite(number, at=runtime.holding(15), bits=(15, 8)),
        "factor": runtime.ReadWrite(number, at=runtime.holding(16)),
        "scaled": runtime.ReadWrite(
            runtime.Scaled(runtime.U16, runtime.Rule(factors=(runtime.Factor("factor"),)), decimals=0),
            at=runtime.holding(17),
        ),
    }


DATA = bytes.fromhex("FF9C FFFFFFFE 0002 0001 03FE 0004 000C")
VALUES = {"speed": -10.0, "count": -2, "turned": 0x10002, "low": -2, "high": 3, "factor": 4, "scaled": 3.0}


def check_layouts(package: Package) -> None:
    """All points of the words, decoded and encoded."""
    runtime = package.runtime
    points = _points(package)
    every = list(table(package, **points).POINTS.values())
    layout = runtime.Layout(every, range(10, 18))
    for _ in range(2):
        assert (layout.decode(DATA), layout.encode(VALUES), layout.size) == (VALUES, DATA, 16)
        assert (list(layout.decode(DATA)), layout.points) == (list(VALUES), tuple(every))
    refuses(runtime.WrongLengthError, "takes 16 bytes, not 15", layout.decode, DATA[1:])
    few = runtime.Layout(every, range(10, 13))
    for _ in range(2):
        assert (few.decode(DATA[:6]), few.encode({"speed": -10.0, "count": -2})) == (
            {"speed": -10.0, "count": -2},
            DATA[:6],
        )
    refuses(runtime.WrongLengthError, "takes 6 bytes, not 8", few.decode, DATA[:8])
    assert few.points == tuple(every[:2])
    inner = runtime.Layout(every, range(11, 16), around=(2, 14))
    assert inner.decode(DATA[:14].ljust(26, b"x")) == {
        name: VALUES[name] for name in ("count", "turned", "low", "high")
    }
    for at in (10, 15):
        part = runtime.Layout(every, range(at, at + 1))
        assert part.decode(DATA[2 * at - 20 : 2 * at - 18]) == {
            point.facts.name: VALUES[point.facts.name] for point in part.points
        }


def check_layout_needs(package: Package) -> None:
    """A scale takes the points that it needs from the words, or from an argument."""
    runtime = package.runtime
    every = list(table(package, **_points(package)).POINTS.values())
    last = runtime.Layout(every, range(17, 18))
    assert (last.needs, last.gives, last.decode(b"\0\x0c", {"factor": 6})) == ({"factor"}, False, {"scaled": 2.0})
    assert last.encode({"scaled": 3.0}, {"factor": 4}) == b"\0\x0c"
    missing = "scaled: needs the raw number of factor: pass raws={'factor': ...}"
    refuses(runtime.MissingRawError, missing, last.decode, b"\0\x0c")
    refuses(runtime.MissingRawError, missing, last.encode, {"scaled": 3.0})
    assert (last.decode_known(b"\0\x0c", {}), last.decode_known(b"\0\x0c", {"factor": 6})) == ({}, {"scaled": 2.0})
    errors: dict[str, Exception] = {}
    assert last.decode_known(b"\0\x0c", {}, errors) == {}
    assert str(errors["scaled"]) == "scaled: needs factor, not known yet"
    both = runtime.Layout(every, range(16, 18), {"factor"})
    assert (both.decode(b"\0\4\0\x0c", {"factor": 6}), both.gives, both.wanted(b"\0\4\0\x0c")) == (
        {"factor": 4, "scaled": 3.0}, True, {"factor": 4},
    )  # fmt: skip
    assert both.decode_known(b"\0\4\0\x0c", {}) == {"factor": 4, "scaled": 3.0}


def check_layouts_that_are_not_encoded(package: Package) -> None:
    """Words with gaps, points that are only read, and other values than those of the points."""
    runtime = package.runtime
    read = runtime.ReadOnly(runtime.Integer(runtime.U16), at=runtime.holding(1), code="R1")
    bits = runtime.ReadWrite(runtime.Integer(runtime.U8), at=runtime.holding(2), bits=(7, 0))
    fixed = runtime.ReadWrite(runtime.Integer(runtime.U8), at=runtime.holding(4), bits=(7, 0), fixed=(0xFF00, 0x0300))
    write = runtime.WriteOnly(runtime.Integer(runtime.U16), at=runtime.holding(5))
    every = list(table(package, read=read, bits=bits, fixed=fixed, write=write).POINTS.values())
    whole = runtime.Layout(every, range(1, 6))
    assert whole.decode(bytes(range(10))) == {"read": 1, "bits": 3, "fixed": 7}
    refuses(runtime.AccessError, "R1 read cannot be written with these words", whole.encode, {})
    refuses(
        runtime.AccessError,
        "no points cover all bits of the words at 2, 3",
        runtime.Layout(every, range(2, 5)).encode,
        {},
    )
    last = runtime.Layout(every, range(4, 6))
    assert last.encode({"fixed": 7, "write": 0x1234}) == b"\3\7\x12\x34"
    for values, names in (({"fixed": 7}, "write"), ({"fixed": 7, "other": 1}, "other, write")):
        wrong = f"takes a value for each point and no others: check {names}"
        refuses(runtime.RequestError, wrong, last.encode, values)
    refuses(runtime.RangeError, "write: 65536 is outside 0..65535", last.encode, {"fixed": 7, "write": 65536})


def check_modbus_layouts(package: Package) -> None:
    """The registers of a group's planned reads, for the variants that are told."""
    runtime = package.runtime
    word = runtime.Integer(runtime.U16)
    block = package.modbus.Block
    points = {
        "PROFILE": runtime.Profile(functions={3: 4}),
        "VARIANTS": {"model": ("a", "b")},
        "BLOCKS": {
            "main": (block("coil", 1, 1, 1), block("holding", 3, 1, 2), block("input", 4, 1, 1)),
            "bits": (block("coil", 1, 1, 1),),
        },
        "bit": runtime.ReadOnly(runtime.Bit(), at=runtime.coil(1)),
        "plain": runtime.ReadOnly(word, at=runtime.holding(1)),
        "one_a": runtime.ReadOnly(word, at=runtime.holding(2), variant=("model", "a"), name="one"),
        "one_b": runtime.ReadOnly(word, at=runtime.holding(2), variant=("model", "b"), name="one"),
        "other": runtime.ReadOnly(word, at=runtime.input_register(1)),
    }
    for kind in devices(package, points, runtime.ModbusDevice, runtime.AsyncModbusDevice):
        found = [[point.facts.item for point in layout.points] for layout in kind.layouts("main")]
        assert found == [["bit"], ["plain"], ["other"]]
        _, first, _ = kind.layouts("main", model="b")
        assert (first.points, first.decode(b"\0\1\0\2")) == ((kind.plain, kind.one_b), {"plain": 1, "one": 2})
        assert [layout.decode(b"\1") for layout in kind.layouts("bits")] == [{"bit": True}]
        text = "there is no group none with planned reads, only main, bits"
        refuses(runtime.AccessError, text, kind.layouts, "none")
        refuses(runtime.AccessError, "a group is named by a text, not 5", kind.layouts, 5)
        text = "model is one of a, b, not 'c'"
        refuses(runtime.RequestError, text, lambda kind=kind: kind.layouts("main", model="c"))


def check_own_layouts(package: Package) -> None:
    """Every layout of the device makes of its words what each of their points makes of its own."""
    kind = package.device
    groups = (*kind.BLOCKS, *(one.name for one in getattr(kind.PROFILE, "telegrams", ())))
    variants = {axis: values[0] for axis, values in kind.VARIANTS.items()}
    assert all(kind.BLOCKS.values())
    for group in groups:
        status, layouts = package.outcome(lambda group=group: kind.layouts(group, **variants))
        for layout in layouts if status == "ok" else ():
            for seed in (1, 0x8001, 0xFF):
                most = 1 if isinstance(layout, package.modbus.BitLayout) else 0xFFFF
                _holds(package, layout, [(seed * (at + 1)) & most for at in range(len(layout.words))])


def _holds(package: Package, layout: Any, words: list[int]) -> None:
    by_address = dict(zip(layout.words, words, strict=True))
    raws = dict.fromkeys(layout.needs, 1)
    numbers = {}
    for point in layout.points:
        first, addresses = point.facts.at.address, point.facts.at.addresses
        own = sorted(addresses) if len(addresses) > 1 else range(first, first + point.size)
        numbers[point] = point.from_words([by_address[at] for at in own])
    raws |= {point.facts.name: raw for point, raw in numbers.items() if point.facts.name in raws}
    read = {point: raw for point, raw in numbers.items() if hasattr(point, "decode")}
    made = {point.facts.name: package.outcome(point.decode, raw, raws) for point, raw in read.items()}
    data = b"".join(word.to_bytes(2, "big") for word in words)
    if isinstance(layout, package.modbus.BitLayout):
        data = sum(bit << at for at, bit in enumerate(words)).to_bytes(layout.size, "little")
    status, values = package.outcome(layout.decode, data, dict.fromkeys(layout.needs, 1))
    assert status in {one for one, _ in made.values()} or not made, (layout.words, status)
    if status == "ok":
        assert repr(values) == repr({name: value for name, (_, value) in made.items()}), layout.words
        copied = pickle.loads(pickle.dumps(layout))
        assert repr(copied.decode(data, dict.fromkeys(layout.needs, 1))) == repr(values)


def check_bit_layouts(package: Package) -> None:
    """Bits of a planned read, the first one lowest in its byte."""
    runtime = package.runtime
    switch = runtime.NamedNumber("Switch", {"OFF": 0, "ON": 1})
    points = {
        f"bit_{at}": runtime.ReadWrite(runtime.Bit(), at=runtime.coil(at), code=f"B{at}") for at in range(100, 110)
    }
    points["named"] = runtime.ReadWrite(runtime.Named(runtime.BIT, switch), at=runtime.coil(110))
    every = list(table(package, **points).POINTS.values())
    layout = package.modbus.BitLayout(reversed(every), range(100, 111))
    values = {name: name in ("bit_100", "bit_107", "bit_108") for name in points} | {"named": switch.ON}
    for _ in range(2):
        assert (layout.decode(b"\x81\5"), layout.encode(values)) == (values, b"\x81\5")
    assert (list(layout.decode(b"\x81\5")), layout.points, layout.size) == (list(points), tuple(every), 2)
    assert layout.decode(b"\0\0")["named"] is switch.OFF
    assert repr(package.modbus.BitLayout(every, range(100, 102))) == "<BitLayout of 1 bytes: bit_100, bit_101>"
    refuses(runtime.WrongLengthError, "takes 2 bytes, not 1", layout.decode, b"\1")
    refuses(runtime.WrongTypeError, "takes 2 bytes, not [1, 2]", layout.decode, [1, 2])
    refuses(runtime.RangeError, "B100 bit_100: 2 is outside 0..1", layout.encode, {**values, "bit_100": 2})
    missing = "takes a value for each point and no others: check named"
    refuses(runtime.RequestError, missing, layout.encode, {name: False for name in points if name != "named"})
    wide = package.modbus.BitLayout(every[:2], range(99, 103))
    assert wide.decode(b"\2") == {"bit_100": True, "bit_101": False}
    refuses(runtime.AccessError, "no points cover all bits of the words at 99, 102", wide.encode, {})


def check_layouts_take_what_they_say(package: Package) -> None:
    """What is no bytes, no values by name or no raw numbers by name is refused by name."""
    runtime = package.runtime
    every = list(table(package, **_points(package)).POINTS.values())
    for words in (range(10, 13), range(10, 18)):
        layout = runtime.Layout(every, words)
        for data in (None, 5, "x" * layout.size):
            refuses(runtime.WrongTypeError, f"takes {layout.size} bytes, not {data!r}", layout.decode, data)
        for values in (None, 5, "ab", [1] * len(layout.points)):
            text = f"takes values by the names of points, as a dict, not {values!r}"
            refuses(runtime.RequestError, text, layout.encode, values)
        assert layout.decode(bytearray(DATA[: layout.size])) == layout.decode(DATA[: layout.size])
    refuses(runtime.WrongTypeError, "raws are raw numbers by name, as {'name': 1}, not [4]", layout.decode, DATA, [4])
    refuses(runtime.WrongTypeError, "raws are raw numbers by name, as {'name': 1}, not 4", layout.encode, VALUES, 4)
    assert repr(runtime.Layout(every, range(10, 13))) == "<Layout of 6 bytes: speed, count>"
    text = "takes a value for each point and no others: check 5, speed"
    refuses(runtime.RequestError, text, runtime.Layout(every, range(10, 11)).encode, {5: 1})
