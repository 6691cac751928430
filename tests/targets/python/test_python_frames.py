"""The Python runtime's frames against pymodbus, which shares nothing with it."""

from __future__ import annotations

import random
import sys
from contextlib import suppress
from typing import Any, NamedTuple

import pytest
from support.models import sample_device
from support.python_package import imported, write_package

pytest.importorskip("pymodbus")
from collections.abc import Iterator

from pymodbus.framer import FramerRTU, FramerSocket
from pymodbus.pdu import DecodePDU, ExceptionResponse, bit_message, diag_message, register_message

REQUESTS: dict[int, tuple[Any, Any, int]] = {
    0x01: (bit_message.ReadCoilsRequest, bit_message.ReadCoilsResponse, 2000),
    0x02: (bit_message.ReadDiscreteInputsRequest, bit_message.ReadDiscreteInputsResponse, 2000),
    0x03: (register_message.ReadHoldingRegistersRequest, register_message.ReadHoldingRegistersResponse, 125),
    0x04: (register_message.ReadInputRegistersRequest, register_message.ReadInputRegistersResponse, 125),
    0x05: (bit_message.WriteSingleCoilRequest, bit_message.WriteSingleCoilResponse, 1),
    0x06: (register_message.WriteSingleRegisterRequest, register_message.WriteSingleRegisterResponse, 1),
    0x0F: (bit_message.WriteMultipleCoilsRequest, bit_message.WriteMultipleCoilsResponse, 1968),
    0x10: (register_message.WriteMultipleRegistersRequest, register_message.WriteMultipleRegistersResponse, 123),
}
BITS = frozenset({0x01, 0x02, 0x05, 0x0F})
READS = frozenset({0x01, 0x02, 0x03, 0x04})


@pytest.fixture(scope="module")
def modbus(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Any]:
    folder = write_package(sample_device(), tmp_path_factory.mktemp("python"))
    for _ in imported(folder, "sample_drive"):
        yield sys.modules["fieldscribe_runtime.modbus"]


@pytest.fixture(scope="module")
def profile(modbus: Any) -> Any:
    return modbus.Profile(functions={function: most for function, (_, _, most) in REQUESTS.items()} | {8: 1})


class Drawn(NamedTuple):
    """A random request, with numbers for its items."""

    function: int
    unit: int
    address: int
    items: int
    numbers: list[int]


def drawn(rng: random.Random, function: int) -> Drawn:
    """A random request of a function."""
    count = rng.randint(1, min(REQUESTS[function][2], 40)) if rng.random() < 0.9 else REQUESTS[function][2]
    top = 1 if function in BITS else 0xFFFF
    numbers = [rng.randint(0, top) for _ in range(count)]
    return Drawn(function, rng.randint(1, 247), rng.randint(0, 0x10000 - count), count, numbers)


def message(kind: Any, request: Drawn, *, answers: bool) -> Any:
    """pymodbus' message for it."""
    facts: dict[str, Any] = {"dev_id": request.unit, "address": request.address, "count": request.items}
    if answers or request.function not in READS:
        bits = [bool(one) for one in request.numbers]
        facts |= {"bits": bits} if request.function in BITS else {"registers": request.numbers}
    if request.function == 0x0F and not answers:
        del facts["count"]
    return kind(**facts)


@pytest.mark.parametrize("function", REQUESTS)
@pytest.mark.parametrize("framing", ["rtu", "tcp"])
def test_frames_are_those_of_pymodbus(modbus: Any, profile: Any, function: int, framing: str) -> None:
    rng = random.Random(function)
    framer = (FramerRTU if framing == "rtu" else FramerSocket)(DecodePDU(True))
    for _ in range(60):
        _, unit, address, count, numbers = one = drawn(rng, function)
        transaction = rng.randint(1, 0xFFFF)
        theirs = message(REQUESTS[function][0], one, answers=False)
        theirs.transaction_id = transaction
        values = () if function in READS else tuple(numbers)
        request = modbus.Request(unit, function, address, count if function in READS else 0, values)
        assert modbus.build(request, profile, framing, transaction) == framer.buildFrame(theirs)

        answer = message(REQUESTS[function][1], one, answers=True)
        answer.transaction_id = transaction
        reply = framer.buildFrame(answer)
        expected = () if function in (0x0F, 0x10) else tuple(numbers)
        assert modbus.parse(request, reply, profile, framing, transaction) == expected
        assert modbus.reply_size(reply[:6], framing) == len(reply)


def test_loop_back_and_exceptions(modbus: Any, profile: Any) -> None:
    framer = FramerRTU(DecodePDU(True))
    request = modbus.Request(5, 8, 0, values=(0x1234,))
    frame = framer.buildFrame(diag_message.ReturnQueryDataRequest(0x1234, dev_id=5))
    assert modbus.build(request, profile) == frame
    assert modbus.parse(request, frame, profile) == (0x1234,)
    refusal = framer.buildFrame(ExceptionResponse(8, 2, device_id=5))
    with pytest.raises(Exception, match="exception 02h") as caught:
        modbus.parse(request, refusal, profile)
    assert getattr(caught.value, "code", None) == 2


@pytest.mark.parametrize(
    ("function", "values", "answer", "text"),
    [
        (6, (500,), (40, 7), "500 was written to 0028h, but the device answered 7"),
        (6, (500,), (41, 500), "01F4h was written to 0028h, but the reply repeats 01F4h at 0029h"),
        (5, (1,), (40, 0), "FF00h was written to 0028h, but the reply repeats 0000h at 0028h"),
        (16, (1, 2), (40, 3), "0002h was written to 0028h, but the reply repeats 0003h at 0028h"),
    ],
)
def test_other_echoes_tell_both_numbers(
    modbus: Any, function: int, values: tuple[int, ...], answer: tuple[int, int], text: str
) -> None:
    profile = modbus.Profile(functions={function: 2})
    reply = bytes((5, function)) + b"".join(word.to_bytes(2, "big") for word in answer)
    reply += modbus.crc(reply).to_bytes(2, "little")
    with pytest.raises(Exception, match=f"^{text}$") as caught:
        modbus.parse(modbus.Request(5, function, 40, values=values), reply, profile)
    error: Any = caught.value
    assert (error.status, error.lost) == ("echo_mismatch", False)
    if "answered" in text:
        assert (error.written, error.answered) == ((500,), (7,))


def test_padding_of_coils(modbus: Any) -> None:
    """Some devices want an even number of data bytes, which pymodbus does not do."""
    padded = modbus.Profile(functions={15: 32}, pad_coil_bytes_even=True)
    frame = modbus.build(modbus.Request(8, 15, 6, values=(1, 1, 1, 0, 1)), padded)
    assert frame[:-2].hex() == "080f00060005021700"


@pytest.mark.parametrize("framing", ["rtu", "tcp"])
def test_any_bytes_are_safe(modbus: Any, profile: Any, framing: str) -> None:
    rng = random.Random(1)
    error = sys.modules["fieldscribe_runtime"].FrameError
    for _ in range(3000):
        function = rng.choice(list(REQUESTS))
        _, unit, address, count, numbers = drawn(rng, function)
        request = modbus.Request(unit, function, address, count, tuple(numbers))
        reply = bytearray(rng.randbytes(rng.randint(0, 24)))
        if len(reply) > 8 and rng.random() < 0.7:
            reply[0:2] = (unit, function) if framing == "rtu" else (0, 0)
            reply[2:8] = (0, 0, 0, len(reply) - 6, unit, function) if framing == "tcp" else reply[2:8]
            if framing == "rtu" and rng.random() < 0.5:
                reply[-2:] = modbus.crc(bytes(reply[:-2])).to_bytes(2, "little")
        with suppress(error):
            modbus.parse(request, bytes(reply), profile, framing)


@pytest.mark.parametrize("values", [(), (1,) * 2100])
@pytest.mark.parametrize("function", [5, 6, 8, 15, 16])
def test_answers_to_requests_that_cannot_be_sent(modbus: Any, profile: Any, function: int, values: tuple[int]) -> None:
    """More values than a frame holds, and none, are no reason for another error than ours."""
    body = bytes((9, function, 0, 0, 0, 0))
    request = modbus.Request(9, function, 0, values=values)
    with pytest.raises(sys.modules["fieldscribe_runtime.errors"].FrameError, match=r"repeat|answered 0"):
        modbus.parse(request, body + modbus.crc(body).to_bytes(2, "little"), profile)
