"""Modbus frames and batched reads, held against manuals and against pymodbus, which shares nothing with them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest
from fieldscribe.conditions import Comparison, Condition
from fieldscribe.families.modbus import FUNCTIONS, ModbusBus, Profile, profile_of
from fieldscribe.families.modbus.frames import Flaw, Request, build, crc16, frame, parse_reply, parse_request
from fieldscribe.families.modbus.reading import plan_blocks
from fieldscribe.families.modbus.remarks import exception_text, flaw_text
from fieldscribe.families.modbus.targets.wire import ModbusWire
from fieldscribe.model import Bus, Code, FamilyFacts, Point, Variant
from fieldscribe.resources import templates_dir
from fieldscribe.targets.vectors.lines import Lines
from hypothesis import given
from hypothesis import strategies as st
from pymodbus.framer import FramerRTU, FramerSocket
from pymodbus.pdu import DecodePDU, ModbusPDU
from pymodbus.pdu.bit_message import (
    ReadCoilsRequest,
    ReadCoilsResponse,
    ReadDiscreteInputsRequest,
    ReadDiscreteInputsResponse,
    WriteMultipleCoilsRequest,
    WriteSingleCoilRequest,
)
from pymodbus.pdu.register_message import (
    ReadHoldingRegistersRequest,
    ReadHoldingRegistersResponse,
    ReadInputRegistersRequest,
    ReadInputRegistersResponse,
    WriteMultipleRegistersRequest,
    WriteSingleRegisterRequest,
)
from support.models import changed, point, sample_bus, sample_device, titles

OPEN = Profile(
    {number: function.most for number, function in FUNCTIONS.items()}, (1, 247), 0, pad_coil_bytes_even=False
)
L200 = Profile({1: 32, 3: 4, 5: 1, 6: 1, 8: 1, 15: 32, 16: 4}, (1, 32), 0, pad_coil_bytes_even=True)


def tail(text: str) -> str:
    """The CRC of the bytes as it travels."""
    return crc16(bytes.fromhex(text)).to_bytes(2, "little").hex(" ")


@pytest.mark.parametrize(
    ("body", "crc"),
    [
        # JUMO, sections 2.7 and 3
        ("07 03 00 CE 00 02", "a5 92"),
        ("07 03 04 00 00 41 C8", "ad f5"),
        ("01 03 31 00 00 04", "4a f5"),
        ("01 03 08 00 00 41 C8 00 00 41 20", "4a 9e"),
        ("01 06 00 77 80 00", "58 10"),
        ("01 06 00 78 43 89", "f9 45"),
        ("01 10 30 14 00 02 04 00 00 41 A0", "97 79"),
        ("01 10 30 14 00 02", "0e cc"),
        # Hitachi L200, the examples whose checksum is not misprinted
        ("08 01 01 17", "12 1a"),
        ("05 03 06 00 07 00 09 00 FF", "36 37"),
        ("", "ff ff"),
    ],
)
def test_crc(body: str, crc: str) -> None:
    assert tail(body) == crc


@pytest.mark.parametrize(
    ("request_", "expected"),
    [
        (Request(1, 3, 0x3100, 4), "01 03 31 00 00 04 4a f5"),
        (Request(1, 6, 0x0077, 1, (0x8000,)), "01 06 00 77 80 00 58 10"),
        (Request(1, 16, 0x3014, 2, (0x0000, 0x41A0)), "01 10 30 14 00 02 04 00 00 41 a0 97 79"),
        (Request(1, 8, 0, 1, (0xA537,)), "01 08 00 00 a5 37 da 8d"),
    ],
)
def test_build_what_manuals_print(request_: Request, expected: str) -> None:
    status, data = build(L200, "rtu", request_)
    assert (status, data.hex(" ")) == ("ok", expected)
    assert parse_request("rtu", data) == request_


def test_coil_bytes_are_padded_where_the_device_wants_it() -> None:
    request = Request(5, 15, 6, 5, (1, 1, 1, 0, 1))
    assert build(L200, "rtu", request)[1][:-2].hex(" ") == "05 0f 00 06 00 05 02 17 00"  # as Hitachi prints it
    plain = build(OPEN, "rtu", request)[1]
    assert plain[:-2].hex(" ") == "05 0f 00 06 00 05 01 17"
    assert parse_request("rtu", plain) == parse_request("rtu", build(L200, "rtu", request)[1]) == request


@pytest.mark.parametrize(
    ("request_", "status"),
    [
        (Request(1, 0x04, 0, 1), "bad_function"),
        (Request(1, 0x2B, 0, 1), "bad_function"),
        (Request(33, 0x04, 0, 0), "bad_function"),
        (Request(33, 0x03, 0, 0), "bad_unit"),
        (Request(0, 0x03, 0, 1), "bad_unit"),
        (Request(0, 0x08, 0, 1, (1,)), "bad_unit"),
        (Request(1, 0x03, 0, 0), "bad_count"),
        (Request(1, 0x03, 0xFFFF, 5), "bad_count"),
        (Request(1, 0x10, 0, 2, (1,)), "bad_count"),
        (Request(1, 0x10, 0, 0), "bad_count"),
        (Request(1, 0x06, 0, 2, (1, 2)), "bad_count"),
        (Request(1, 0x05, 0, 1), "bad_count"),
        (Request(1, 0x03, 0xFFFF, 2), "bad_address"),
        (Request(1, 0x03, -1, 2), "bad_address"),
        (Request(1, 0x08, 1, 1, (1,)), "bad_address"),
        (Request(1, 0x05, 0, 1, (2,)), "bad_value"),
        (Request(1, 0x06, 0, 1, (65536,)), "bad_value"),
        (Request(1, 0x06, 0, 1, (-1,)), "bad_value"),
        (Request(1, 0x03, 0xFFFC, 4), "ok"),
        (Request(0, 0x10, 0, 1, (7,)), "ok"),
    ],
)
def test_first_failure_of_build_wins(request_: Request, status: str) -> None:
    for framing in ("rtu", "tcp"):
        found, data = build(L200, framing, request_)
        assert found == status
        assert bool(data) == (status == "ok")


def test_a_broadcast_number_inside_the_units_still_does_not_read() -> None:
    profile = replace(OPEN, units=(0, 247))
    assert build(profile, "rtu", Request(0, 3, 0, 1))[0] == "bad_unit"
    assert build(replace(profile, broadcast=None), "rtu", Request(0, 3, 0, 1))[0] == "ok"


def test_a_manual_may_take_functions_from_broadcast() -> None:
    functions = (
        Code(5, "write_coil", titles("c"), None),
        Code(6, "write_register", titles("r"), None, broadcast=True),
        Code(15, "write_coils", titles("c"), None, broadcast=False),
        Code(16, "write_registers", titles("r"), None),
    )
    profile = profile_of(replace(sample_bus(), functions=functions))
    assert profile.broadcasts == {5, 6, 16}
    assert build(profile, "rtu", Request(0, 15, 0, 1, (1,)))[0] == "bad_unit"
    assert build(profile, "tcp", Request(0, 16, 0, 1, (1,)))[0] == "ok"
    assert build(profile, "rtu", Request(1, 15, 0, 1, (1,)))[0] == "ok"


@st.composite
def requests(draw: st.DrawFn) -> Request:
    """Any request that the open profile allows."""
    function = draw(st.sampled_from(sorted(FUNCTIONS)))
    count = 1 if function in (5, 6, 8) else draw(st.integers(1, OPEN.most[function]))
    address = 0 if function == 8 else draw(st.integers(0, 0x10000 - count))
    top = 1 if function in (5, 15) else 0xFFFF
    size = 0 if function <= 4 else count
    values = tuple(draw(st.lists(st.integers(0, top), min_size=size, max_size=size)))
    return Request(draw(st.integers(1, 247)), function, address, count, values, draw(st.integers(0, 0xFFFF)))


def peer_request(request: Request) -> bytes:
    """The PDU that pymodbus makes of the same request."""
    address, count = request.address, request.count
    bits, words = [value == 1 for value in request.values], list(request.values)
    if request.function == 8:
        return bytes((8, 0, 0)) + words[0].to_bytes(2, "big")  # its class has no types
    pdus: dict[int, Callable[[], ModbusPDU]] = {
        1: lambda: ReadCoilsRequest(address=address, count=count),
        2: lambda: ReadDiscreteInputsRequest(address=address, count=count),
        3: lambda: ReadHoldingRegistersRequest(address=address, count=count),
        4: lambda: ReadInputRegistersRequest(address=address, count=count),
        5: lambda: WriteSingleCoilRequest(address=address, bits=bits),
        6: lambda: WriteSingleRegisterRequest(address=address, registers=words),
        15: lambda: WriteMultipleCoilsRequest(address=address, bits=bits),
        16: lambda: WriteMultipleRegistersRequest(address=address, registers=words),
    }
    pdu = pdus[request.function]()
    return bytes((request.function,)) + pdu.encode()


@given(requests())
def test_build_agrees_with_pymodbus(request: Request) -> None:
    pdu = peer_request(request)
    rtu = FramerRTU(DecodePDU(is_server=False)).encode(pdu, request.unit, 0)
    tcp = FramerSocket(DecodePDU(is_server=False)).encode(pdu, request.unit, request.transaction)
    assert build(OPEN, "rtu", request) == ("ok", rtu)
    assert build(OPEN, "tcp", request) == ("ok", tcp)
    assert parse_request("rtu", rtu) == replace(request, transaction=0)
    assert parse_request("tcp", tcp) == request


@given(requests(), st.data())
def test_replies_of_pymodbus_are_understood(request: Request, data: st.DataObject) -> None:
    if request.function <= 2:
        bits = data.draw(st.lists(st.booleans(), min_size=request.count, max_size=request.count))
        made = (ReadCoilsResponse if request.function == 1 else ReadDiscreteInputsResponse)(bits=bits)
        pdu, values = bytes((request.function,)) + made.encode(), tuple(map(int, bits))
    elif request.function <= 4:
        words = data.draw(st.lists(st.integers(0, 0xFFFF), min_size=request.count, max_size=request.count))
        answer = (ReadHoldingRegistersResponse if request.function == 3 else ReadInputRegistersResponse)(
            registers=words
        )
        pdu, values = bytes((request.function,)) + answer.encode(), tuple(words)
    else:
        echo = peer_request(request)
        pdu, values = echo[:5], () if request.function > 8 else request.values
    for framing in ("rtu", "tcp"):
        reply = parse_reply(framing, request, frame(framing, request.unit, request.transaction, pdu))
        assert (reply.status, reply.values, reply.exception) == ("ok", values, 0)


@given(requests(), st.binary(max_size=300), st.sampled_from(("rtu", "tcp")))
def test_any_bytes_are_safe(request: Request, data: bytes, framing: str) -> None:
    reply = parse_reply(framing, request, data)
    assert reply.status == "ok" or reply.values == ()
    asked = parse_request(framing, data)
    assert isinstance(asked, Flaw | Request)


@given(requests(), st.binary(min_size=1, max_size=260), st.sampled_from(("rtu", "tcp")))
def test_any_pdu_in_a_sound_frame_is_safe(request: Request, pdu: bytes, framing: str) -> None:
    data = frame(framing, request.unit, request.transaction, pdu)
    reply = parse_reply(framing, request, data)
    assert reply.status not in ("bad_crc", "wrong_unit", "bad_protocol", "wrong_transaction")
    asked = parse_request(framing, data)
    if isinstance(asked, Request):
        assert build(replace(OPEN, units=(0, 255), broadcast=None), framing, asked)[0] in ("ok", "bad_address")


READ_TWO = Request(1, 3, 0x10, 2)


def rtu(text: str) -> bytes:
    """The bytes with their CRC behind them."""
    body = bytes.fromhex(text)
    return body + crc16(body).to_bytes(2, "little")


@pytest.mark.parametrize(
    ("request_", "data", "status", "values", "exception"),
    [
        (READ_TWO, rtu("01 03 04 00 01 80 00"), "ok", (1, 0x8000), 0),
        (READ_TWO, rtu("01 83 02"), "exception", (), 2),
        (READ_TWO, rtu("01 83 00"), "exception", (), 0),
        (READ_TWO, b"", "short_frame", (), 0),
        (READ_TWO, rtu("01 03"), "short_frame", (), 0),
        (READ_TWO, rtu("01 03 04 00 01 80"), "short_frame", (), 0),
        (READ_TWO, rtu("01 03 04 00 01 80 00 00"), "long_frame", (), 0),
        (READ_TWO, rtu("01 83 02 00"), "long_frame", (), 0),
        (READ_TWO, bytes.fromhex("01 03 04 00 01 80 00 00 00"), "bad_crc", (), 0),
        (READ_TWO, bytes.fromhex("01 2b 04 00 01 80 00 00 00"), "bad_crc", (), 0),
        (READ_TWO, rtu("02 03 04 00 01 80 00"), "wrong_unit", (), 0),
        (READ_TWO, rtu("02 83 02"), "wrong_unit", (), 0),
        (READ_TWO, rtu("02 04 04"), "wrong_unit", (), 0),
        (READ_TWO, rtu("01 04 04 00 01 80 00"), "wrong_function", (), 0),
        (READ_TWO, rtu("01 84 02"), "wrong_function", (), 0),
        (READ_TWO, rtu("01 03 02 00 01"), "bad_byte_count", (), 0),
        (READ_TWO, rtu("01 03 05 00 01 80 00 00"), "bad_byte_count", (), 0),
        (READ_TWO, rtu("01 03 00"), "bad_byte_count", (), 0),
        (Request(8, 1, 6, 5), rtu("08 01 01 17"), "ok", (1, 1, 1, 0, 1), 0),
        (Request(8, 1, 6, 5), rtu("08 01 01 F7"), "ok", (1, 1, 1, 0, 1), 0),
        (Request(8, 1, 6, 9), rtu("08 01 01 17"), "bad_byte_count", (), 0),
        (Request(8, 5, 6, 1, (1,)), rtu("08 05 00 06 FF 00"), "ok", (1,), 0),
        (Request(8, 5, 6, 1, (1,)), rtu("08 05 00 06 00 01"), "echo_mismatch", (), 0),
        (Request(8, 6, 6, 1, (1,)), rtu("08 06 00 07 00 01"), "echo_mismatch", (), 0),
        (Request(8, 8, 0, 1, (9,)), rtu("08 08 00 00 00 09"), "ok", (9,), 0),
        (Request(8, 16, 6, 2, (1, 2)), rtu("08 10 00 06 00 02"), "ok", (), 0),
        (Request(8, 16, 6, 2, (1, 2)), rtu("08 10 00 06 00 01"), "echo_mismatch", (), 0),
        (Request(8, 7, 6, 2), rtu("08 07 00 06 00 01"), "bad_function", (), 0),
    ],
)
def test_rtu_replies(request_: Request, data: bytes, status: str, values: tuple[int, ...], exception: int) -> None:
    reply = parse_reply("rtu", request_, data)
    assert (reply.status, reply.values, reply.exception) == (status, values, exception)


@pytest.mark.parametrize(
    ("text", "status"),
    [
        ("12 34 00 00 00 07 01 03 04 00 01 80 00", "ok"),
        ("12 34 00 00 00 03 01 83 02", "exception"),
        ("12 34 00 00 00 02 01 83", "short_frame"),
        ("12 34 00 01 00 09 01 03 04 00 01 80 00", "bad_protocol"),
        ("12 34 00 00 00 08 01 03 04 00 01 80 00", "short_frame"),
        ("12 34 00 00 00 06 01 03 04 00 01 80 00", "long_frame"),
        ("12 35 00 00 00 07 02 03 04 00 01 80 00", "wrong_transaction"),
        ("12 34 00 00 00 07 02 04 04 00 01 80 00", "wrong_unit"),
        ("12 34 00 00 00 07 01 04 04 00 01 80 00", "wrong_function"),
        ("12 34 00 00 00 04 01 83 02 00", "long_frame"),
        ("12 34 00 00 00 06 01 03 04 00 01 80", "bad_byte_count"),
        ("12 34 00 00 00 05 01 03 02 00 01", "bad_byte_count"),
    ],
)
def test_tcp_replies(text: str, status: str) -> None:
    assert parse_reply("tcp", replace(READ_TWO, transaction=0x1234), bytes.fromhex(text)).status == status


@pytest.mark.parametrize(("size", "status"), [(4, "short_frame"), (6, "long_frame"), (5, "ok")])
def test_tcp_echo_has_five_bytes(size: int, status: str) -> None:
    pdu = bytes.fromhex("06 00 06 00 01 00")[:size]
    assert parse_reply("tcp", Request(1, 6, 6, 1, (1,)), frame("tcp", 1, 0, pdu)).status == status


@pytest.mark.parametrize(
    ("framing", "data", "reason"),
    [
        ("rtu", bytes(3), "an RTU frame has at least 4 bytes, here are 3"),
        ("rtu", bytes.fromhex("05 06 10 28 01 F4 A8 54"), "the checksum is wrong"),
        ("rtu", bytes.fromhex("05 06 10 28 01 F4 91 0C"), "the bytes of the checksum are swapped"),
        ("rtu", rtu("01 07 00 00"), "function 07h is not one of the Modbus functions known here"),
        ("rtu", rtu("01 03 00 00"), "a request of function 03h has at least 5 bytes from the function on, here are 3"),
        ("rtu", rtu("01 03 00 00 00 01 00"), "a request of function 03h has 5 bytes from the function on, here are 6"),
        ("rtu", rtu("01 03 00 00 00 00"), "a count of 0 is outside 1 to 125"),
        ("rtu", rtu("01 05 00 00 00 01"), "a coil is written with FF00h or 0000h, here is 0001h"),
        ("rtu", rtu("01 10 00 00 00 01"), "the byte count is missing, here are 0 bytes of data"),
        ("rtu", rtu("01 10 00 00 00 01 02 00"), "the byte count says 2, here are 1 bytes of data"),
        ("rtu", rtu("01 10 00 00 00 01 01 00"), "1 words are 2 bytes, here are 1"),
        ("rtu", rtu("01 0F 00 00 00 05 03 00 00 00"), "5 coils are 1 bytes (or padded to an even number), here are 3"),
        ("tcp", bytes(7), "a TCP frame has at least 8 bytes, here are 7"),
        ("tcp", bytes.fromhex("00 00 00 01 00 06 01 03 00 00 00 01"), "the header does not say Modbus"),
        ("tcp", bytes.fromhex("00 00 00 00 00 07 01 03 00 00 00 01"), "the length in the header is wrong"),
    ],
)
def test_what_is_wrong_with_a_request(framing: str, data: bytes, reason: str) -> None:
    flaw = parse_request(framing, data)
    assert isinstance(flaw, Flaw)
    assert flaw_text(flaw) == reason


@pytest.mark.parametrize(
    ("code", "name"),
    [
        (0x01, "illegal function"),
        (0x02, "illegal data address"),
        (0x03, "illegal data value"),
        (0x04, "device failure"),
        (0x05, "acknowledged, still working"),
        (0x06, "device busy"),
        (0x08, "memory parity error"),
        (0x0A, "gateway path unavailable"),
        (0x0B, "gateway target did not answer"),
    ],
)
def test_exceptions_have_the_meaning_of_the_protocol(code: int, name: str) -> None:
    """The Modbus application protocol, section 7; a device may name others itself."""
    said = exception_text(sample_device(), code)
    assert name in said
    assert f"{code:02X}h" in said
    assert "value_out_of_range" in exception_text(sample_device(), 0x21)


def at(*addresses: int, **facts: Any) -> Point:
    """A readable word (or more) at these addresses, the high part first, named after the first."""
    type_name = {1: "u16", 2: "u32", 4: "u64"}[len(addresses)]
    return point(f"p{addresses[0]}", min(addresses), type_name, order=addresses, **facts)


def bus(*functions: tuple[int, int | None], **facts: Any) -> Bus:
    """The sample's bus with these functions and their most."""
    codes = tuple(Code(number, f"function_{number}", titles("Function"), most) for number, most in functions)
    return replace(sample_bus(), functions=codes, **facts)


AXES = {"class": ("200V", "400V")}


def planned(points: list[Point], **facts: Any) -> list[tuple[int, int, tuple[str, ...]]]:
    """Blocks of at most four words as (address, count, names)."""
    return [(block.address, block.count, block.points) for block in plan_blocks(bus((3, 4), **facts), points, AXES)]


def test_blocks_join_neighbours_up_to_the_most() -> None:
    points = [at(12), at(10), at(11), at(13), at(14), at(20)]
    assert planned(points) == [(10, 4, ("p10", "p11", "p12", "p13")), (14, 1, ("p14",)), (20, 1, ("p20",))]


def test_blocks_keep_several_words_together() -> None:
    assert planned([at(10), at(11, 12), at(14, 13)]) == [(10, 3, ("p10", "p11")), (13, 2, ("p14",))]


def test_blocks_cross_reserved_addresses_but_no_unknown_ones() -> None:
    reserved = changed(at(11), generated=False, reserved=True)
    assert planned([at(10), reserved, at(12)]) == [(10, 3, ("p10", "p12"))]
    assert planned([at(10), at(12)]) == [(10, 1, ("p10",)), (12, 1, ("p12",))]
    write_only = changed(at(11), access="w")
    assert planned([at(10), write_only, at(12)]) == [(10, 1, ("p10",)), (12, 1, ("p12",))]
    assert planned([reserved]) == []


def test_blocks_do_not_cross_gaps() -> None:
    points = [at(10), changed(at(11), generated=False), at(12)]
    assert planned(points, gaps={"holding": ((11, 11),)}) == [(10, 1, ("p10",)), (12, 1, ("p12",))]
    assert planned(points, gaps={"coil": ((11, 11),)}) == [(10, 3, ("p10", "p12"))]


def test_points_at_one_address_count_once() -> None:
    group = changed(at(10), name="low", bits=(3, 0), type="u8")
    other = changed(at(10), name="high", bits=(7, 4), type="u8")
    variants = [replace(at(11), variant=Variant("class", name)) for name in ("200V", "400V")]
    assert planned([group, other, *variants, at(12)]) == [(10, 3, ("high", "low", "p11", "p12"))]


def test_a_point_that_some_devices_lack_is_in_a_separate_block() -> None:
    """A device refuses all of a read that touches one address that it does not have."""
    large = Condition(((Comparison("class", "==", ("400V",)),),))
    for facts in (
        {"when": large},
        {"since": "firmware 2"},
        {"until": "firmware 3"},
        {"variant": Variant("class", "400V")},
    ):
        found = planned([at(10), changed(at(11), **facts), at(12)])
        assert found == [(10, 1, ("p10",)), (11, 1, ("p11",)), (12, 1, ("p12",))], facts
    both = [
        replace(at(11), variant=Variant("class", "200V")),
        replace(at(12), name="p11", variant=Variant("class", "400V")),
    ]
    assert planned([at(10), *both, at(13)]) == [
        (10, 1, ("p10",)),
        (11, 1, ("p11",)),
        (12, 1, ("p11",)),
        (13, 1, ("p13",)),
    ]
    reserved = changed(at(11), generated=False, reserved=True, when=large)
    assert planned([at(10), reserved, at(12)]) == [(10, 1, ("p10",)), (12, 1, ("p12",))]


def test_what_stands_where_another_point_always_is_shares_its_block() -> None:
    large = Condition(((Comparison("class", "==", ("400V",)),),))
    word, bits = at(11), changed(at(11), name="bits", bits=(3, 0), type="u8", when=large)
    assert planned([at(10), word, bits, at(12)]) == [(10, 3, ("p10", "bits", "p11", "p12"))]
    alone = [
        changed(at(11), name=name, bits=(high, high - 3), type="u8", when=large) for name, high in (("a", 3), ("b", 7))
    ]
    assert planned([at(10), *alone]) == [(10, 1, ("p10",)), (11, 1, ("a", "b"))]


def test_what_no_read_can_bring_is_in_no_block() -> None:
    assert planned([at(10, 11, 12, 13)]) == [(10, 4, ("p10",))]
    assert plan_blocks(bus((3, 2)), [at(10, 11, 12, 13), at(20, 30)], {}) == ()
    assert plan_blocks(bus(), [at(10)], {}) == ()


def test_blocks_come_by_space_then_address() -> None:
    coil = point("coil", 5, "bit", space="coil")
    other = point("other", 1, space="input")
    blocks = plan_blocks(bus((1, None), (3, None), (4, None)), [other, at(2), coil], {})
    assert [(block.space, block.function, block.address) for block in blocks] == [
        ("coil", 1, 5),
        ("holding", 3, 2),
        ("input", 4, 1),
    ]


@pytest.mark.parametrize(
    ("framing", "function", "addresses", "words", "sent", "received"),
    [
        ("rtu", 3, (0x1013, 0x1014), (1, 2), "01 03 10 13 00 02", "01 03 04 00 01 00 02"),
        ("rtu", 3, (0x1014, 0x1013), (1, 2), "01 03 10 13 00 02", "01 03 04 00 01 00 02"),
        ("rtu", 6, (0xFFFF,), (7,), "01 06 FF FF 00 07", "01 06 FF FF 00 07"),
        ("rtu", 16, (5, 6), (7, 8), "01 10 00 05 00 02 04 00 07 00 08", "01 10 00 05 00 02"),
        ("rtu", 1, (9,), (1,), "01 01 00 09 00 01", "01 01 01 01"),
        ("tcp", 3, (9,), (3,), "00 01 00 00 00 06 01 03 00 09 00 01", "00 01 00 00 00 05 01 03 02 00 03"),
    ],
)
def test_vectors_exchange_what_stands_in_a_row(  # noqa: PLR0917 - the columns of the table
    framing: str, function: int, addresses: tuple[int, ...], words: tuple[int, ...], sent: str, received: str
) -> None:
    """By hand, from the protocol: the lowest address travels, and a single write is answered by itself."""
    script = ModbusWire(Lines(), sample_device(), framing).script(function, addresses, words)
    whole = [(text + tail(text)) if framing == "rtu" else text for text in (f"{sent} ", f"{received} ")]
    assert script == [(bytes.fromhex(whole[0]), bytes.fromhex(whole[1]))]


@pytest.mark.parametrize(
    ("function", "addresses", "words"),
    [(3, (5, 7), (1, 2)), (3, (0xFFFF, 0x10000), (1, 2)), (4, (5,), (1,)), (3, tuple(range(5)), (0,) * 5)],
    ids=["a hole", "behind the last address", "no such function", "more than at once"],
)
def test_vectors_exchange_nothing_that_one_request_cannot_carry(
    function: int, addresses: tuple[int, ...], words: tuple[int, ...]
) -> None:
    assert ModbusWire(Lines(), sample_device(), "rtu").script(function, addresses, words) is None


def test_a_bus_without_facts_pads_nothing() -> None:
    assert not profile_of(bus(family_facts=FamilyFacts())).pad_coil_bytes_even
    assert profile_of(bus(family_facts=ModbusBus("even"))).pad_coil_bytes_even


def test_profile_takes_the_smaller_most() -> None:
    assert dict(profile_of(bus((1, None), (3, 500), (43, 1))).most) == {1: 2000, 3: 125}


def test_c_has_room_for_all_functions() -> None:
    """The profile of a device in C has a largest count for each function up to the last one."""
    header = (templates_dir() / "c/runtime/fieldscribe_modbus_facts.h").read_text("utf-8")
    assert f"#define FIELDSCRIBE_MODBUS_FUNCTIONS {max(FUNCTIONS) + 1}U" in header
