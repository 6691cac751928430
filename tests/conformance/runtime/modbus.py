"""Modbus devices: planned reads, shared words, unit numbers, broadcasts, framings, and the length of replies."""

from __future__ import annotations

import io
import itertools
from collections.abc import Callable
from typing import Any

from conformance.package import Package
from conformance.runtime.bench import AsyncMemory, Memory, devices, refusal, refuses
from conformance.scripts import now

_MOST = {1: 16, 2: 16, 3: 4, 4: 4, 5: 1, 6: 1, 15: 16, 16: 4}


def _made(package: Package, **facts: Any) -> tuple[Any, Any]:
    """A device with words in several spaces, a planned group, and bits of one word."""
    runtime = package.runtime
    word = runtime.Integer(runtime.U16)
    wide = runtime.Integer(runtime.U32)

    points = {
        "PROFILE": runtime.Profile(functions=_MOST, units=(1, 247), **facts),
        "BLOCKS": {"planned": (runtime.Block("holding", 3, 0, 3),)},
        "a": runtime.ReadOnly(word, at=runtime.holding(0), group="planned"),
        "b": runtime.ReadOnly(wide, at=runtime.holding(2, 1), group="planned"),
        "c": runtime.ReadOnly(word, at=runtime.holding(4), group="planned", code="C1"),
        "d": runtime.ReadOnly(word, at=runtime.holding(7)),
        "e": runtime.ReadOnly(word, at=runtime.input_register(7)),
        "f": runtime.ReadWrite(runtime.Bit(), at=runtime.coil(7)),
        "g": runtime.ReadOnly(runtime.Bit(), at=runtime.discrete(7)),
        "h": runtime.ReadOnly(word, at=runtime.holding(9, function=4)),
        "i": runtime.ReadOnly(word, at=runtime.holding(5)),
        "low": runtime.ReadWrite(word, at=runtime.holding(30), bits=(3, 0)),
        "high": runtime.WriteOnly(word, at=runtime.holding(30), bits=(7, 4), code="H1"),
        "pair": runtime.ReadWrite(wide, at=runtime.holding(41, 40)),
        "one": runtime.ReadWrite(word, at=runtime.holding(50, function=16)),
    }
    blocking, awaiting = devices(package, points, runtime.ModbusDevice, runtime.AsyncModbusDevice)
    return blocking, awaiting


def _devices(package: Package, words: dict[int, int], **facts: Any) -> list[tuple[Any, Memory]]:
    made = []
    for kind, line in zip(_made(package, **facts), (Memory, AsyncMemory), strict=True):
        memory = line(dict(words))
        made.append((kind(memory, 1), memory))
    return made


def check_many(package: Package) -> None:
    """Several points take the fewest requests; a group those that were planned."""
    for device, memory in _devices(package, {0: 1, 1: 2, 2: 3, 4: 4, 5: 5, 7: 1, 9: 9}):
        planned = {"a": 1, "b": 0x00030002, "c": 4}
        assert (now(device.read_many("planned")), memory.since()) == (planned, [(3, 0, 3), (3, 4, 1)])
        found = now(device.read_many(["d", type(device).c, "a"]))
        assert (found, memory.since()) == ({"d": 1, "c": 4, "a": 1}, [(3, 0, 1), (3, 4, 1), (3, 7, 1)])
        assert (now(device.read_many(["c", "i"])), memory.since()) == ({"c": 4, "i": 5}, [(3, 4, 2)])
        assert (now(device.read_many(["a", "b", "c"])), memory.since()) == (planned, [(3, 0, 3), (3, 4, 1)])
        found = now(device.read_many(["d", "e", "f", "g", "h"]))
        assert found == {"d": 1, "e": 1, "f": True, "g": True, "h": 9}
        assert memory.since() == [(1, 7, 1), (2, 7, 1), (3, 7, 1), (4, 9, 1), (4, 7, 1)]
        refuses(package.runtime.AccessError, "there is no group none, only planned", device.read_many, "none")
        refuses(package.runtime.AccessError, "H1 high cannot be read", device.read_many, ["high"])
        text = "nobody is no point of this device: its `POINTS` lists their names"
        refuses(package.runtime.AbsentError, text, device.read_many, ["nobody"])


def check_plan(package: Package) -> None:
    """A read brings whole places, no more than a function allows, and bridges only what is known."""
    runtime, modbus = package.runtime, package.modbus
    profile = runtime.Profile(functions=_MOST)
    holding = runtime.holding
    bridges = {("holding", 2), ("holding", 3)}

    def planned(*places: Any, over: Any = ()) -> list[tuple[int, int]]:
        return [(one.address, one.count) for one in modbus.plan(places, profile, over)]

    assert planned(holding(4), holding(1)) == [(1, 1), (4, 1)]
    assert planned(holding(4), holding(1), over=bridges) == [(1, 4)]
    assert planned(holding(4), holding(1), over={("holding", 2)}) == [(1, 1), (4, 1)]
    assert planned(holding(1), holding(2), holding(3, 4), holding(5)) == [(1, 4), (5, 1)]
    assert planned(holding(1, 2, 3, 4), holding(2)) == [(1, 4)]
    assert planned(holding(1), holding(1, 2)) == [(1, 2)]
    small = runtime.Profile(functions={})
    assert [(one.address, one.count) for one in modbus.plan([holding(1), holding(2)], small)] == [(1, 1), (2, 1)]
    refuses(
        runtime.RequestError,
        "there is no space 'parameter', only coil, discrete, holding, input",
        modbus.plan,
        [runtime.parameter(1)],
        profile,
    )
    block = runtime.Block("holding", 3, 2, 3)
    covered = [holding(2, 4), holding(1, 2), holding(4, 5), runtime.coil(3), holding(3)]
    assert [block.covers(one) for one in covered] == [True, False, False, False, True]
    functions = [holding(1, function=code) for code in (None, 4, 6)]
    assert [modbus.read_function(one) for one in functions] == [3, 4, 3]


def check_writing(package: Package) -> None:
    """One word, several, bits beside others, and words by address."""
    for device, memory in _devices(package, {30: 0xABCD}):
        now(device.low.write(2))
        assert (memory.words[30], memory.since()) == (0xABC2, [(3, 30, 1), (6, 30, 0xABC2)])
        refuses(
            package.runtime.AccessError, "H1 high: the other bits of its word cannot be read back", device.high.write, 1
        )
        now(device.pair.write(0x10002))
        now(device.f.write(True))
        now(device.one.write(3))
        assert memory.since() == [(16, 40, 2), (5, 7, 0xFF00), (16, 50, 1)]
        assert [memory.words[at] for at in (40, 41, 50)] == [2, 1, 3]
        now(device.write_at("holding", 60, 1, 2, 3))
        now(device.write_at("coil", 61, 1))
        now(device.write_at("holding", 61, 9))
        assert memory.since() == [(16, 60, 3), (5, 61, 0xFF00), (6, 61, 9)]
        assert (now(device.read_at("holding", 60, 3)), now(device.read_at("holding", 61))) == ((1, 9, 3), (9,))
        assert memory.since() == [(3, 60, 3), (3, 61, 1)]
        message = "the space 'input' cannot be written, only coil and holding"
        refuses(package.runtime.RequestError, message, device.write_at, "input", 1, 1)
        message = "there is no space 'none', only coil, discrete, holding, input"
        refuses(package.runtime.RequestError, message, device.read_at, "none", 1)
        assert refusal(device.read_at, "none", 1).status == "bad_space"
        assert refusal(device.write_at, "input", 1, 1).status == "bad_space"


def check_failures(package: Package) -> None:
    """What goes wrong names the point, and the device can be used again."""
    for device, memory in _devices(package, {4: 4}):
        memory.fails = TimeoutError("nothing came")
        silence = refusal(device.c.read)
        assert type(silence) is package.runtime.NoReplyError
        assert str(silence) == f"{device.c.label}: unit 1 did not reply to function 03h: nothing came"
        assert silence.__cause__ is memory.fails
        memory.fails = package.runtime.FrameError("bad_crc", "wrong")
        assert str(refusal(device.c.read)) == f"{device.c.label}: wrong"
        memory.fails = None
        assert now(device.c.read()) == 4
        refused = refusal(device.read_at, "holding", 0, 5)
        assert (refused.status, refused.point) == ("bad_count", None)


def check_units(package: Package) -> None:
    """Unit numbers that a device can have; to all units nothing is read and nothing answers."""
    runtime = package.runtime
    for kind, line in zip(_made(package), (Memory, AsyncMemory), strict=True):
        for unit in (248, -1, "1"):
            refuses(runtime.RequestError, f"the device can be unit 1 to 247, not {unit!r}", kind, line({}), unit)
        memory = line({})
        every = kind(memory, 0)
        now(every.one.write(3))
        assert memory.since() == [(16, 50, 1)]
        refused = refusal(every.one.read)
        assert (refused.status, refused.point) == ("bad_unit", "one")
        assert str(refused) == "one: function 03h cannot be sent to all units"
        other = line({})
        other.framing = "ascii"
        refuses(runtime.RequestError, "the device speaks rtu and tcp, not 'ascii'", kind, other, 1)
    for kind in _made(package, broadcast=None, framings=("rtu",)):
        assert refusal(kind, Memory({}), 0).status == "bad_unit"
        other = Memory({})
        other.framing = "tcp"
        refused = refusal(kind, other, 1)
        assert refused.status == "bad_framing"
        subclass = "a subclass with PROFILE = Device.PROFILE.replaced(framings=('tcp',))"
        told = f"take a line with framing='rtu', or where a gateway translates {subclass}"
        assert str(refused) == f"the device speaks rtu, not 'tcp'; {told}"


def check_transactions(package: Package) -> None:
    """Over TCP each request has the next number, and 16 bits of it."""
    kind, _ = _made(package)
    sent: list[bytes] = []

    class Line:
        framing = "tcp"

        def exchange(self, request: bytes) -> bytes:
            sent.append(request)
            return request[:4] + b"\0\5" + request[6:8] + b"\2\0\7"

    device = kind(Line(), 5)
    assert (device.a.read(), device.a.read()) == (7, 7)
    assert sent == [bytes.fromhex("000100000006050300000001"), bytes.fromhex("000200000006050300000001")]
    device._transactions = itertools.count(0x10000)
    assert (device.a.read(), sent[2][:2]) == (7, b"\0\0")


def check_sizes(package: Package) -> None:
    """How long a reply is, as soon as that can be told; never longer than a frame can be."""
    size = package.modbus.reply_size
    rtu = {
        b"\1\3": None,
        b"\1\3\4": 9,
        b"\1\6\0": 8,
        b"\1\x83\2": 5,
        b"\1\x2b\0": None,
        b"\1\x10\0": 8,
        b"\1\xab\0": None,
    }
    assert {data: size(data) for data in rtu} == rtu
    assert (size(b"\1\1\2"), size(b"\1\x0f\2"), size(b"\1\x08\2"), size(b"\1\3\xfa"), size(b"")) == (7, 8, 8, 255, None)
    told = "3 bytes came (01 03 FC): the reply would have 257 bytes, and a frame has at most 256"
    refuses(package.runtime.FrameError, told, size, b"\1\3\xfc")
    assert size(b"\1\3\xfb") == 256
    tcp = {b"\0\0\0\0\0": None, b"\0\0\0\0\0\6": 12, b"\0\0\0\0\0\xfe": 260}
    assert {data: size(data, "tcp") for data in tcp} == tcp
    refused = refusal(size, b"\0\0\0\0\0\xff", "tcp")
    assert (refused.status, str(refused)) == (
        "long_frame",
        "6 bytes came (00 00 00 00 00 FF): the reply would have 261 bytes, and a frame has at most 260",
    )


def _pieces(data: bytes, size: int) -> Callable[[int], bytes]:
    """A read that gives so many bytes at most."""
    line = io.BytesIO(data)
    return lambda most: line.read(min(most, size))


def check_receiving(package: Package) -> None:
    """A whole reply is read, however it comes; frames of others are dropped; what is no frame ends."""
    rtu, tcp = b"\1\3\2\0\7\x38\x46", b"\0\1\0\0\0\3\1\x83\2"
    refused, foreign = b"\1\x83\2\xc0\xf1", b"\2\3\2\0\7\x7c\x46"
    late = b"\0\0" + tcp[2:]
    receive, ask = package.modbus.receive, {"rtu": b"\1\3\0\0\0\1", "tcp": b"\0\1\0\0\0\6\1\3\0\0\0\1"}
    for framing, before, reply in (
        ("rtu", b"", rtu), ("rtu", b"", refused), ("rtu", foreign, rtu), ("tcp", b"", tcp), ("tcp", late + late, tcp),
    ):  # fmt: skip
        for size in (1, 2, 5, 300):
            assert receive(_pieces(before + reply + b"rest", size), ask[framing], framing) == reply
    assert receive(_pieces(foreign, 9), ask["rtu"]) == foreign, "the error names the unit that answered"
    for data, told in (
        (b"", "no byte came"),
        (rtu[:4], "4 bytes came (01 03 02 00), which are no reply; is the baud rate right?"),
        (foreign + rtu[:4], "4 bytes came (01 03 02 00), which are no reply; is the baud rate right?"),
    ):
        silent = refusal(receive, _pieces(data, 9), ask["rtu"])
        assert (isinstance(silent, TimeoutError), str(silent)) == (True, told)
        assert getattr(silent, "received", b"") == data[-4:]
    cut = refusal(receive, _pieces(tcp[:4], 9), ask["tcp"], "tcp")
    assert str(cut) == "4 bytes came (00 01 00 00), which are no reply"
    noise = f"256 bytes came ({' '.join(['55'] * 16)} ...), more than any frame has; is the baud rate right?"
    refuses(package.runtime.FrameError, noise, receive, _pieces(b"\x55" * 999, 1), ask["rtu"])
    long = "5 bytes came (01 03 FF 00 00): the reply would have 260 bytes, and a frame has at most 256"
    refuses(package.runtime.FrameError, long, receive, _pieces(b"\1\3\xff\0\0", 5), ask["rtu"])


def check_requests(package: Package) -> None:
    """What may not be asked, with the reason."""
    modbus, request = package.modbus, package.modbus.Request
    profile = package.runtime.Profile(functions=_MOST, units=(1, 9), broadcasts=(6,))
    reasons = {
        request(1, 7, 0): "the device has no function 07h",
        request(0, 16, 0, values=(1,)): "function 10h cannot be sent to all units",
        request(10, 3, 0, 1): "unit 10 is outside 1..9",
        request(1, 3, 0, 5): "function 03h takes 1..4 items, not 5",
        request(1, 16, 0): "function 10h takes 1..4 items, not 0",
        request(1, 3, 0xFFFF, 2): "2 items from 65535 on are outside 0..65535",
        request(1, 6, 0, values=(0x10000,)): "value 65536 is outside 0..65535",
        request(1, 5, 0, values=(2,)): "value 2 is outside 0..1",
    }
    for one, reason in reasons.items():
        refuses(package.runtime.RequestError, reason, modbus.build, one, profile)
    assert (request(1, 6, 0).count, request(1, 6, 0).values) == (0, ())
    assert modbus.build(request(0, 6, 1, values=(2,)), profile)[:6] == bytes.fromhex("000600010002")
    known = package.runtime.Profile(functions=_MOST, exceptions={2: "bad_address"})
    for code, name in ((2, "bad_address"), (3, None)):
        reply = Memory({})._closed(bytes((1, 0x83, code)))
        error = refusal(modbus.parse, request(1, 3, 0, 1), reply, known)
        assert (error.code, error.name, error.status) == (code, name, "exception")
    refuses(package.runtime.FrameError, "unit 2 answered instead of 1", modbus.parse, request(1, 3, 0, 1),
            Memory({})._closed(bytes((2, 3, 2, 0, 1))), known)  # fmt: skip
