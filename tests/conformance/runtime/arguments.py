"""Wrong arguments: the runtime raises its own errors, which say what it expects."""

from __future__ import annotations

from typing import Any

from conformance.package import Package
from conformance.runtime.bench import AsyncMemory, Memory, devices, refusal, refuses, table
from conformance.runtime.can_bus import Bus, beat_of
from conformance.runtime.can_bus import kinds_of as can_kinds
from conformance.runtime.uss_line import kinds_of as uss_kinds
from conformance.runtime.uss_line import on_lines
from conformance.scripts import now


class Thing:
    """Something that is none of what is expected."""

    def __repr__(self) -> str:
        return "thing"


class Index:
    """Something that stands for an integer, as the numbers of numpy do."""

    def __index__(self) -> int:
        return 3


WRONG: tuple[Any, ...] = (None, "5", b"\1", [1], {}, 1.5, 1j, Thing(), Thing, 10**5000)
"""Values that are neither raw numbers nor words nor addresses."""


def _points(package: Package) -> dict[str, Any]:
    """Points of all forms, and one whose scale and limits need others."""
    runtime = package.runtime
    rule = runtime.Rule(num=10, factors=(runtime.Factor("a"),))
    limit = runtime.Limit(rule, 0, 9, {"b": ((0, 0),)})
    names, holding = runtime.NamedNumber("Names", {"ONE": 1}), runtime.holding
    return {
        "whole": runtime.ReadWrite(runtime.Integer(runtime.U16), at=holding(1)),
        "bit": runtime.ReadWrite(runtime.Bit(), at=runtime.coil(1)),
        "named": runtime.ReadWrite(runtime.Named(runtime.U16, names), at=holding(2)),
        "scaled": runtime.ReadWrite(runtime.Scaled(runtime.U16, runtime.Rule(num=10), decimals=1), at=holding(3)),
        "coded": runtime.ReadWrite(
            runtime.WithCodes(runtime.Integer(runtime.U16), runtime.Codes({"off": 0, "band": (8, 9)})), at=holding(4)
        ),
        "number": runtime.ReadWrite(runtime.Floating(runtime.F32), at=holding(5, 6)),
        "text": runtime.ReadWrite(runtime.Text(2), at=holding(7)),
        "needy": runtime.ReadWrite(
            runtime.Scaled(runtime.U16, rule, decimals=1), at=holding(8), allowed=((0, limit),)
        ),
    }  # fmt: skip


def check_raw_numbers(package: Package) -> None:
    """A raw number is an integer, in every function that takes one; only of a bit it may be a bool."""
    runtime = package.runtime
    made = table(package, **_points(package)).POINTS
    for name, point in made.items():
        wrong = [*WRONG[:-1], *((True, 1.0) if name != "bit" else (1.0,))]
        functions = [point.decode, point.decode_count, point.extract, point.name_of, point.told]
        for function in functions:
            for _ in range(2):  # also after the first call, which specialises
                for number in wrong:
                    text = f"takes a raw number, which is an integer, not {number!r}"
                    refuses(runtime.WrongTypeError, f"{name}: {text}", function, number)
        for number in wrong[:-1]:
            for function in (point.check, point.to_words, *([point.from_words] if number != [1] else [])):
                found = refusal(function, number)
                assert (found.point, isinstance(found, runtime.CodecError)) == (name, True), (function, number)
            assert isinstance(refusal(point.special, number), runtime.WrongTypeError), number
        assert str(refusal(point.decode, 10**5000)).startswith(f"{name}: a number of thousands of digits is no raw")
        assert point.told(10**5000) == "raw a number of thousands of digits"
        assert refusal(point.encode_count, 10**5000).point == name
    assert (made["bit"].decode(True), made["bit"].decode(False), made["bit"].decode_count(True)) == (True, False, 1)
    assert type(made["bit"].decode_count(True)) is int
    assert (made["scaled"].decode(Index()), made["whole"].to_words(Index()), made["whole"].decode_count(Index())) == (
        0.3, (3,), 3,
    )  # fmt: skip
    assert made["scaled"].encode_count(Index()) == 3
    for words in ("1", b"\1", {1}, {1: 2}, None, 5):
        text = f"whole: takes words, as in [1], not {words!r}"
        refuses(runtime.WrongTypeError, text, made["whole"].from_words, words)
    assert made["whole"].from_words(iter([7])) == 7


def check_raws_of_others(package: Package) -> None:
    """Raw numbers of other points are integers by name."""
    runtime = package.runtime
    needy = table(package, **_points(package)).needy
    assert (needy.decode(4, {"a": 2}), needy.encode(0.2, {"a": 2, "b": 1})) == (0.2, 4)
    both = runtime.Rule(factors=(runtime.Factor("a"), runtime.Factor("b")))
    two = table(package, two=runtime.ReadOnly(runtime.Scaled(runtime.U16, both, decimals=0), at=runtime.holding(1))).two
    assert [two.decode(12, {"a": 2, "b": 3}) for _ in range(2)] == [2.0, 2.0]
    for point in (needy, two):
        for wrong in (None, 5, [1], "x", Thing()):
            text = f"{point.label}: raws are raw numbers by name, as {{'a': 1}}, not {wrong!r}"
            refuses(runtime.WrongTypeError, text, point.decode, 4, wrong)
        for number in (None, "2", True, 2.0, [2], Thing()):
            text = f"{point.label}: the raw number of a is an integer, not {number!r}"
            refuses(runtime.WrongTypeError, text, point.decode, 4, {"a": number, "b": 3})
        text = "a number of thousands of digits is no raw number of a: it has more than 64 bits"
        refuses(runtime.RangeError, f"{point.label}: {text}", point.decode, 4, {"a": 10**5000, "b": 3})
    assert (needy.decode(4, {"a": Index()}), two.decode(12, {"a": Index(), "b": 2})) == (4 / 30, 2.0)
    refuses(runtime.WrongTypeError, "needy: the raw number of b is an integer, not None", needy.check, 4, {"b": None})


def check_what_may_be_written(package: Package) -> None:
    """Limits with equal ends are no range, and those that leave nothing say so."""
    runtime = package.runtime
    one = runtime.Scaled(runtime.U16, runtime.Rule(num=10), decimals=1)
    limit = runtime.Limit(runtime.Rule(factors=(runtime.Factor("least"),)), 0, 100, {})
    points = {
        "zero": runtime.ReadWrite(one, at=runtime.holding(1), unit="Hz", allowed=((0, 0),)),
        "few": runtime.ReadWrite(one, at=runtime.holding(2), unit="Hz", allowed=((10, 10), (20, 20), (30, 40))),
        "two": runtime.ReadWrite(one, at=runtime.holding(3), unit="Hz", allowed=((10, 20), (30, 40))),
        "float": runtime.ReadWrite(runtime.Floating(runtime.F32, units=((5.0, 5.0),)), at=runtime.holding(4, 5)),
        "none": runtime.ReadWrite(one, at=runtime.holding(6), unit="Hz", allowed=((limit, 50),)),
    }
    made = table(package, **points).POINTS
    for name, value, raw, (of_value, of_raw) in (
        ("zero", 5.0, 50, ("not 0 Hz", "not 0")),
        ("few", 5.0, 50, ("none of 1, 2, 3..4 Hz", "none of 10, 20, 30..40")),
        ("two", 5.0, 50, ("outside 1..2 or 3..4 Hz", "outside 10..20 or 30..40")),
    ):
        refuses(runtime.RangeError, f"{name}: {value:g} Hz is {of_value}", made[name].encode, value)
        refuses(runtime.RangeError, f"{name}: {value:g} Hz is {of_value}", made[name].encode_count, raw)
        refuses(runtime.RangeError, f"{name}: raw {raw} is {of_raw}", made[name].check, raw)
    refuses(runtime.RangeError, "float: 6 is not 5", made["float"].encode, 6.0)
    text = "none: 4 Hz is refused, as anything is now: least leave 6..5 Hz"
    refuses(runtime.RangeError, text, made["none"].encode, 4.0, {"least": 60})
    refuses(runtime.RangeError, "none: raw 40 is outside 45..50 (set by least)", made["none"].check, 40, {"least": 45})
    huge = "zero: a count of a number of thousands of digits Hz is not 0 Hz"
    refuses(runtime.RangeError, huge, made["zero"].encode_count, 10**5000)


def _lines(package: Package) -> list[tuple[Any, str]]:
    """Devices of all families, each with a space: two on Modbus with commands, one on CAN, two on USS."""
    runtime = package.runtime
    points = {
        "PROFILE": runtime.Profile(functions={3: 4, 5: 1, 6: 1, 16: 4}),
        "go": runtime.Command(at=runtime.holding(9)),
    }
    points["switch"] = runtime.Command(at=runtime.coil(9))
    made = devices(package, points, runtime.ModbusDevice, runtime.AsyncModbusDevice)
    lines = [(kind(line({}), 1), "holding") for kind, line in zip(made, (Memory, AsyncMemory), strict=True)]
    lines += [(kind(Bus(package), 9), "parameter") for kind in can_kinds(package)[:1]]
    return lines + [(device, "parameter") for device, _ in on_lines(package)]


def check_places(package: Package) -> None:
    """Reading and writing by address in all families."""
    lines, request = _lines(package), package.runtime.RequestError
    for device, space in lines:
        for wrong in (None, 5, [1], b"x"):
            text = f"a space is named by a text such as 'holding', not {wrong!r}"
            for function in (device.read_at, device.write_at):
                refuses(request, text, function, wrong, 1, 1)
                assert refusal(function, wrong, 1, 1).status == "bad_space"
        for number in (None, "5", 1.5, True, [1], Thing()):
            for function in (device.read_at, device.write_at):
                refuses(request, f"address is an integer, not {number!r}", function, space, number, 1)
            assert refusal(device.write_at, space, 1, number).status == "bad_value", number
        for address in (-1, 65536, 10**5000):
            assert refusal(device.read_at, space, address).status == "bad_address"
        assert refusal(device.write_at, space, 1, 65536).status == "bad_value"
        refuses(request, "takes 1 to 65536 words or bits, not 0", device.write_at, space, 1)
        assert refusal(device.write_at, space, 1).status == "bad_count"
    for device, space in lines[:3]:
        text = "the number of words or bits is an integer, not '5'"
        refuses(request, text, device.read_at, space, 1, "5")
        assert refusal(device.read_at, space, 1, "5").status == "bad_count"
        assert refusal(device.read_at, space, 1, 0).status == "bad_count"
    for device, space in lines[3:]:
        refuses(request, "index is an integer, not '5'", device.read_at, space, 1, "5")
        assert refusal(device.read_at, space, 1, "5").status == "bad_index"


def check_commands(package: Package) -> None:
    """A command takes a number, of a coil a bool too."""
    request = package.runtime.RequestError
    for device, _ in _lines(package)[:2]:
        now(device.switch.send(True))
        for wrong in ("x", 1.5, True, [1], Thing()):
            refuses(request, f"the number of go is an integer, not {wrong!r}", device.go.send, wrong)
            assert refusal(device.go.send, wrong).status == "bad_value"
        assert refusal(device.go.send, 65536).status == "bad_value"
        assert repr(device.go) == "<Command go: holding 0x0009 of <Made unit 1>>"


def check_units(package: Package) -> None:
    """A unit is a number that the device can have, and no bool."""
    runtime = package.runtime
    points = {"PROFILE": runtime.Profile(functions={3: 4}, units=(1, 9))}
    makers: list[Any] = [
        lambda unit, kind=kind: kind(Memory({}), unit)
        for kind in devices(package, points, runtime.ModbusDevice, runtime.AsyncModbusDevice)
    ]
    makers += [lambda unit, kind=kind: kind(Bus(package), unit) for kind in can_kinds(package)]
    makers += [
        lambda unit, kind=kind: kind(on_lines(package)[0][1], unit, package.uss.Link(4, 3))
        for kind in uss_kinds(package)
    ]
    for make in makers:
        for unit in (True, False, None, "1", 1.0, [1], Thing()):
            error = refusal(make, unit)
            assert (type(error), error.status) == (runtime.RequestError, "bad_unit"), unit
            assert str(error).endswith(f", not {unit!r}")
        assert str(refusal(make, 10**5000)).endswith("not a number of thousands of digits")


def check_transports(package: Package) -> None:
    """A transport that lacks something, is of the other kind or gives something else is told what one has."""
    runtime, request = package.runtime, package.runtime.RequestError
    points = {
        "PROFILE": runtime.Profile(functions={3: 4}),
        "one": runtime.ReadOnly(runtime.Integer(runtime.U16), at=runtime.holding(1), code="A1"),
    }
    blocking, awaiting = devices(package, points, runtime.ModbusDevice, runtime.AsyncModbusDevice)
    exchange = "`exchange` (a method that sends a request and returns the whole reply)"
    needs = f"a transport has `framing` ('rtu', 'tcp' or 'pdu') and {exchange}"
    for kind in (blocking, awaiting):
        refuses(request, f"{needs}; thing has no framing and no exchange", kind, Thing(), 1)
        assert refusal(kind, type("Half", (Thing,), {"framing": "rtu"})(), 1).status == "bad_transport"
    for kind in can_kinds(package):
        assert str(refusal(kind, Thing(), 9)).endswith("thing has no send and no receive")
    for kind in uss_kinds(package):
        assert str(refusal(kind, Thing(), 9, package.uss.Link(4, 3))).endswith("thing has no exchange")
        text = "the link is a Link, as Link(pkw=4, pzd=2), not 5"
        refuses(request, text, kind, on_lines(package)[0][1], 9, 5)
        assert refusal(kind, on_lines(package)[0][1], 9, 5).status == "bad_link"
    given: Any = type("Given", (), {"framing": "rtu", "exchange": lambda self, request: None})
    refuses(runtime.FrameError, "A1 one: a reply is bytes, not None", blocking(given(), 1).one.read)
    assert refusal(blocking(given(), 1).one.read).status == "wrong_type"
    async_line = AsyncMemory({})
    error = refusal(blocking(async_line, 1).one.read)
    assert (type(error), str(error).endswith("an async transport belongs to the async device")) == (
        runtime.FrameError,
        True,
    )
    error = refusal(awaiting(Memory({1: 5}), 1).one.read)
    assert (error.status, str(error).endswith("an async device takes an async transport")) == (
        "bad_transport", True,
    )  # fmt: skip
    for kind in can_kinds(package)[:1]:
        silent: Any = type("Silent", (), {"send": lambda self, frame: None, "receive": lambda self: None})
        text = "a transport gives a Frame(id, data) or raises TimeoutError; this one gave None"
        refuses(request, f"P5 speed: {text}", kind(silent(), 9).speed.read)
        assert refusal(kind(silent(), 9).speed.read).status == "bad_transport"


def check_modbus_requests(package: Package) -> None:
    """Requests of Modbus that are put together by hand."""
    modbus = package.modbus
    profile = package.runtime.Profile(functions={3: 4, 6: 1})
    request = package.runtime.RequestError
    refuses(request, "takes a Request, not None", modbus.build, None, profile)
    assert refusal(modbus.build, None, profile).status == "bad_request"
    refuses(package.runtime.WrongTypeError, "takes bytes, not None", modbus.crc, None)
    good = {"unit": 1, "function": 3, "address": 1, "count": 1}
    for field in good:
        for wrong in (None, "1", 1.5, True, [1]):
            error = refusal(modbus.build, modbus.Request(**{**good, field: wrong}), profile)
            assert (type(error), str(error)) == (request, f"{field} is an integer, not {wrong!r}"), field
            assert error.status == f"bad_{field}"
    refuses(request, "values are a tuple, not [1]", modbus.build, modbus.Request(1, 6, 1, values=[1]), profile)
    refuses(request, "value is an integer, not True", modbus.build, modbus.Request(1, 6, 1, values=(True,)), profile)
    for values in ([1], (True,), ("1",)):
        assert refusal(modbus.build, modbus.Request(1, 6, 1, values=values), profile).status == "bad_value"
    refuses(request, "frames are rtu or tcp, not None", modbus.reply_size, b"\1\3", None)
    assert refusal(modbus.reply_size, b"\1\3", None).status == "bad_framing"
    refuses(request, "transaction is an integer, not None", modbus.build, modbus.Request(**good), profile, "tcp", None)
    assert refusal(modbus.build, modbus.Request(**good), profile, "tcp", None).status == "bad_transaction"
    for function in (modbus.reply_size, lambda reply: modbus.parse(modbus.Request(**good), reply, profile)):
        refuses(package.runtime.FrameError, "a reply is bytes, not 'x'", function, "x")


def check_uss_requests(package: Package) -> None:
    """Requests of USS that are put together by hand."""
    uss, request = package.uss, package.runtime.RequestError
    link, kind = uss.Link(4, 3), uss_kinds(package)[0]
    asked = uss.Request(9, 1, 1)
    refuses(package.runtime.FrameError, "a reply is bytes, not None", uss.parse, asked, None, kind.PROFILE, link)
    wanted = {"unit": 9, "task": 2, "parameter": 1, "index": 0, "width": 1, "value": 1, "words": (0, 0, 0)}
    for field in wanted:
        for wrong in (None, "1", 1.5, True):
            error = refusal(uss.build, uss.Request(**{**wanted, field: wrong}), kind.PROFILE, link)
            assert (type(error), str(error).endswith(f"not {wrong!r}")) == (request, True), field
            told = {"width": "bad_value", "words": "bad_value"}.get(field, f"bad_{field}")
            assert error.status == told, (field, wrong, str(error))
    for mask in (None, 5, (1, 2), ("a", 1, 1, 1)):
        assert type(refusal(uss.broadcast, mask, (0, 0, 0), kind.PROFILE, link)) is request
    for broken in (uss.Link("4", 3), uss.Link(4, None), uss.Link(True, 3)):
        assert refusal(kind, on_lines(package)[0][1], 9, broken).status == "bad_link"


def check_can_frames(package: Package) -> None:
    """Wrong frames, words and telegrams are refused."""
    can, request = package.can, package.runtime.RequestError
    device, can_kind = can_kinds(package)[0](Bus(package), 9), can_kinds(package)[0]
    decoder = can.Decoder(can_kind, "beat", 9)
    for wrong in (None, b"x", Thing(), can.Frame(beat_of(package, 0, 1, 2, 3).id, None)):
        for function in (device.take, decoder.take, decoder.decode):
            refuses(request, f"takes a Frame(id, data), not {wrong!r}", function, wrong)
            assert refusal(function, wrong).status == "bad_frame"
    of_python_can = type("Message", (), {"arbitration_id": 1})()
    hint = "; this is Frame(message.arbitration_id, bytes(message.data))"
    assert str(refusal(decoder.decode, of_python_can)).endswith(hint)
    raws = "raws are raw numbers by name, as {'name': 1}, not [1]"
    refuses(package.runtime.WrongTypeError, raws, decoder.decode, beat_of(package, 0, 1, 2, 3), [1])
    for wrong in (None, 5, "x", [], (1.0,)):
        assert (type(refusal(decoder.words, wrong)), refusal(decoder.words, wrong).status) == (request, "bad_address")
        assert refusal(decoder.word, wrong).status in ("bad_address", "missing")
    refuses(request, "takes the class of a CAN device, not None", can.Decoder, None, "beat", 9)
    assert refusal(can.Decoder, None, "beat", 9).status == "bad_device"
    refuses(package.runtime.AccessError, "a telegram is named by a text, not None", can.Decoder, can_kind, None, 9)
    refuses(request, "the device has no variants by 'x'", lambda: can.Decoder(can_kind, "beat", 9, x="y"))


def check_lists_of_points(package: Package) -> None:
    """Reading many takes a group, or points and their names; what else is meant is told."""
    runtime = package.runtime
    access, absent = runtime.AccessError, runtime.AbsentError
    word = runtime.Integer(runtime.U16)
    points: dict[str, Any] = {
        "PROFILE": runtime.Profile(functions={3: 4}),
        "VARIANTS": {"model": ("a", "b")},
        "DOCUMENTED": {"odd_": runtime.Documented("nobody knows", code="O1")},
        "one": runtime.ReadOnly(word, at=runtime.holding(1), group="main", code="A1"),
        "way_a": runtime.ReadOnly(word, at=runtime.holding(2), variant=("model", "a"), name="way"),
        "go": runtime.Command(at=runtime.holding(9)),
    }
    points["way"] = runtime.ByVariant("model", {"a": points["way_a"]})
    made = devices(package, points, runtime.ModbusDevice, runtime.AsyncModbusDevice)
    for kind, line in zip(made, (Memory, AsyncMemory), strict=True):
        device = kind(line({1: 5, 2: 6}), 1, {"model": "a"})
        other = kind(line({}), 1, {"model": "a"})
        for wrong in (None, 5, b"x", Thing()):
            text = f"takes the name of a group, or a list of points and their names, not {wrong!r}"
            refuses(access, text, device.read_many, wrong)
        assert str(refusal(device.read_many, device.one)).startswith("takes the name of a group, or a list of points")
        for one in (5, None, Thing(), ""):
            refuses(access, f"a point is named by a text, not {one!r}", device.read_many, [one])
        refuses(access, "A1 one is a point of another device", device.read_many, [other.one])
        refuses(access, "there is no group one; it is a point: read_many(['one']) reads it", device.read_many, "one")
        refuses(access, "there is no group A1; it is a point: read_many(['A1']) reads it", device.read_many, "A1")
        refuses(access, "a group is named by a text, not ''", device.read_many, "")
        refuses(absent, "go is a command of this device: go.send() sends it", device.point, "go")
        refuses(absent, "main is a group of this device: read_many('main') reads it", device.point, "main")
        for what in ("odd_", "odd", "o1"):
            shown = f"{what} is documented only{'' if what == 'odd_' else ', as odd_'}: nobody knows"
            refuses(absent, shown, device.point, what)
        assert now(device.read_many([kind.way, kind.one])) == {"way": 6, "one": 5}
