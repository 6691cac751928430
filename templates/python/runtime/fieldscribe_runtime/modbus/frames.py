# SPDX-License-Identifier: 0BSD
"""Modbus requests and replies as bytes, RTU and TCP, without any I/O. Any bytes of any length are safe to parse."""

from __future__ import annotations

import struct
from functools import cache
from operator import itemgetter
from typing import TYPE_CHECKING

from ..arguments import check_bytes, check_integer, check_number, shown
from ..errors import (
    EchoError,
    ExceptionReplyError,
    FrameError,
    RequestError,
    WrongTypeError,
)
from ..receiving import Framing
from ..receiving import receive as receive_reply
from ..records import Record

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Mapping

READ_COILS, READ_DISCRETE, READ_HOLDING, READ_INPUT = 0x01, 0x02, 0x03, 0x04
WRITE_COIL, WRITE_REGISTER, DIAGNOSTICS, WRITE_COILS, WRITE_REGISTERS = 0x05, 0x06, 0x08, 0x0F, 0x10

BIT_READS = frozenset({READ_COILS, READ_DISCRETE})
READS = frozenset({READ_COILS, READ_DISCRETE, READ_HOLDING, READ_INPUT})
SINGLE_WRITES = frozenset({WRITE_COIL, WRITE_REGISTER})
BLOCK_WRITES = frozenset({WRITE_COILS, WRITE_REGISTERS})
WRITES = SINGLE_WRITES | BLOCK_WRITES
ECHOES = frozenset({WRITE_COIL, WRITE_REGISTER, DIAGNOSTICS})
_KNOWN = READS | WRITES | ECHOES

RTU, TCP = "rtu", "tcp"
_HEAD = struct.Struct(">HHHBB")
"""The header of TCP: transaction, protocol and size, then unit and function."""
PDU = "pdu"
"""The unit and the request without a frame, for transports that add their own."""


class Profile(Record):
    """What a device supports: functions with the most items of one request, unit numbers, and its peculiarities.

    `broadcast` is the unit number of all units, `broadcasts` the functions that may be sent to it. `framings` are those
    of the device: for a translating gateway, a subclass of the device can have a PROFILE with others.
    """

    functions: Mapping[int, int]
    units: tuple[int, int] = (1, 247)
    broadcast: int | None = 0
    pad_coil_bytes_even: bool = False
    exceptions: Mapping[int, str] = {}
    broadcasts: Collection[int] = WRITES
    framings: tuple[str, ...] = (RTU, TCP)


class Request(Record):
    """One request. Reads name `count`, writes `values`; a loop-back test (08h) sends values[0] to `address` 0."""

    unit: int
    function: int
    address: int
    count: int = 0
    values: tuple[int, ...] = ()

    @property
    def items(self) -> int:
        """The number of registers or bits."""
        return self.count if self.function in READS else len(self.values)


def _crc_table() -> tuple[int, ...]:
    table = []
    for byte in range(256):
        value = byte
        for _ in range(8):
            value = value >> 1 ^ (0xA001 if value & 1 else 0)
        table.append(value)
    return tuple(table)


_CRC = _crc_table()


def crc(data: bytes) -> int:
    """The CRC-16 of RTU frames; its low byte is sent first."""
    if not isinstance(data, (bytes, bytearray)):
        raise WrongTypeError(f"takes bytes, not {shown(data)}")
    value = 0xFFFF
    for byte in data:
        value = value >> 8 ^ _CRC[(value ^ byte) & 0xFF]
    return value


def check_framing(framing: str, profile: Profile) -> None:
    """Raises RequestError (bad_framing) if the device does not support the framing."""
    if framing in (*profile.framings, PDU):
        return
    hint = "; for a serial line take a SerialLine" if framing == "uss" else ""
    if framing in _FRAMINGS:
        spoken = profile.framings[0]
        subclass = f"a subclass with PROFILE = Device.PROFILE.replaced(framings=({framing!r},))"
        hint = f"; take a line with framing={spoken!r}, or where a gateway translates {subclass}"
    text = f"the device speaks {' and '.join(profile.framings)}, not {shown(framing)}{hint}"
    raise RequestError("bad_framing", text)


def _check_kinds(request: Request) -> None:
    """Raises RequestError unless the numbers are integers; unit and address are checked where they are used."""
    if not isinstance(request, Request):
        raise RequestError("bad_request", f"takes a Request, not {shown(request)}")
    check_integer("bad_function", "function", request.function)
    check_integer("bad_count", "count", request.count)
    if not isinstance(request.values, tuple):
        raise RequestError("bad_value", f"values are a tuple, not {shown(request.values)}")


def check_request(request: Request, profile: Profile) -> None:
    """Raises RequestError if the device does not take such a request."""
    _check_kinds(request)
    low, high = profile.units
    most = profile.functions.get(request.function)
    if most is None:
        raise RequestError("bad_function", f"the device has no function {request.function:02X}h")
    check_integer("bad_unit", "unit", request.unit)
    if request.unit == profile.broadcast:
        if request.function not in profile.broadcasts:
            raise RequestError("bad_unit", f"function {request.function:02X}h cannot be sent to all units")
    elif not low <= request.unit <= high:
        raise RequestError("bad_unit", f"unit {shown(request.unit)} is outside {low}..{high}")
    if not 1 <= request.items <= most:
        text = f"function {request.function:02X}h takes 1..{most} items, not {shown(request.items)}"
        raise RequestError("bad_count", text)
    check_integer("bad_address", "address", request.address)
    last = 0 if request.function == DIAGNOSTICS else 0x10000 - request.items
    if not 0 <= request.address <= last:
        text = f"{request.items} items from {shown(request.address)} on are outside 0..65535"
        raise RequestError("bad_address", text)
    largest = 1 if request.function in (WRITE_COIL, WRITE_COILS) else 0xFFFF
    for value in request.values:
        if not (isinstance(value, bool) and largest == 1):
            check_number("bad_value", "value", value, (0, largest))


def _words(*words: int) -> bytes:
    return b"".join(word.to_bytes(2, "big") for word in words)


def _head(request: Request) -> bytes:
    """Function, address, and count or value: the part of a write that a device repeats."""
    if request.function in ECHOES:
        value = request.values[0]
        if request.function == WRITE_COIL:
            value = 0xFF00 if value else 0
    else:
        value = request.items
    return bytes([request.function]) + _words(request.address, value)


def _pdu(request: Request, profile: Profile) -> bytes:
    head = _head(request)
    if request.function not in BLOCK_WRITES:
        return head
    data = _words(*request.values)
    if request.function == WRITE_COILS:
        size = (len(request.values) + 7) // 8
        size += size % 2 if profile.pad_coil_bytes_even else 0
        data = sum(value << place for place, value in enumerate(request.values)).to_bytes(size, "little")
    return head + bytes([len(data)]) + data


def build(request: Request, profile: Profile, framing: str = RTU, transaction: int = 0) -> bytes:
    """The bytes of a request; raises RequestError if the device does not take it."""
    check_framing(framing, profile)
    check_request(request, profile)
    pdu = _pdu(request, profile)
    if framing == TCP:
        check_integer("bad_transaction", "transaction", transaction)
        return _words(transaction & 0xFFFF, 0, len(pdu) + 1) + bytes([request.unit]) + pdu
    frame = bytes([request.unit]) + pdu
    return frame if framing == PDU else frame + crc(frame).to_bytes(2, "little")


def reply_size(received: bytes, framing: str = RTU) -> int | None:
    """Return the length of the reply that starts with these bytes; None while they are too few to tell.

    Raises FrameError if the reply would be longer than any frame can be, and RequestError for an unknown framing.
    """
    check_bytes(received)
    return framing_of(framing).size_of(received)


def framing_of(name: str) -> Framing:
    """Return what a receiver must know of a framing; raises RequestError for an unknown one."""
    if name not in _FRAMINGS:
        raise RequestError("bad_framing", f"frames are {' or '.join(_FRAMINGS)}, not {shown(name)}")
    return _FRAMINGS[name]


def receive(read: Callable[[int], bytes], request: bytes, framing: str = RTU) -> bytes:
    """Return the whole reply to a request. For transports: `read` returns up to so many bytes, as pyserial's does.

    Raises TimeoutError when `read` returns none, and FrameError for more bytes than any frame has.
    """
    return receive_reply(read, framing_of(framing), request)


def _tcp_size(received: bytes) -> int | None:
    return 6 + (received[4] << 8) + received[5] if len(received) >= 6 else None


def _rtu_size(received: bytes) -> int | None:
    if len(received) < 3:
        return None
    function = received[1] & 0x7F
    if function not in _KNOWN:
        return None
    if received[1] & 0x80:
        return 5
    return 5 + received[2] if function in READS else 8


_FRAMINGS = {
    RTU: Framing(_rtu_size, itemgetter(0), shortest=5, longest=256),
    TCP: Framing(_tcp_size, itemgetter(slice(2)), shortest=9, longest=260, hint=""),
}


def parse(
    request: Request, reply: bytes, profile: Profile, framing: str = RTU, transaction: int = 0
) -> tuple[int, ...]:
    """Return words, bits as 0 or 1, the echoed value, or nothing for a block write, from a reply to `request`.

    Raises FrameError unless this is a valid answer; its subclass ExceptionReplyError has the device's code.
    """
    check_framing(framing, profile)
    check_bytes(reply)
    return parse_checked(request, reply, profile, framing, transaction)


def parse_checked(request: Request, reply: bytes, profile: Profile, framing: str, transaction: int) -> tuple[int, ...]:
    """As `parse`, for bytes and a framing that were checked."""
    if framing == PDU:
        reply = bytes(reply) + crc(reply).to_bytes(2, "little")  # as if it had a CRC
    pdu = _open_tcp(request, reply, transaction & 0xFFFF) if framing == TCP else _open_rtu(request, reply)
    if pdu[0] != request.function:
        raise ExceptionReplyError(pdu[1], profile.exceptions.get(pdu[1]))
    return _answer(request, pdu)


def _open_rtu(request: Request, reply: bytes) -> bytes:
    if len(reply) < 5:
        raise FrameError("short_frame", f"{len(reply)} bytes are too few for a reply")
    size = _rtu_size(reply)
    if size is not None and reply[1] & 0x7F == request.function:
        _check_size(len(reply), size)
    if crc(reply[:-2]) != int.from_bytes(reply[-2:], "little"):
        raise FrameError("bad_crc", "the CRC of the reply is wrong")
    _check_address(request, reply[0], reply[1])
    return reply[1:-2]


def _open_tcp(request: Request, reply: bytes, transaction: int) -> bytes:
    if len(reply) < 9:
        raise FrameError("short_frame", f"{len(reply)} bytes are too few for a reply")
    head = number, protocol, size, unit, function = _HEAD.unpack_from(reply)
    if head == (transaction, 0, len(reply) - 6, request.unit, request.function) and function in READS:
        return reply[7:]
    if protocol != 0:
        raise FrameError("bad_protocol", "the protocol number is not 0")
    _check_size(len(reply), 6 + size)
    if number != transaction:
        raise FrameError("wrong_transaction", f"the reply is to transaction {number} instead of {transaction}")
    _check_address(request, unit, function)
    if function & 0x80 or request.function not in READS:
        _check_size(size - 1, 2 if function & 0x80 else 5)
    return reply[7:]


def _check_size(size: int, expected: int) -> None:
    if size != expected:
        status = "short_frame" if size < expected else "long_frame"
        raise FrameError(status, f"the reply has {size} bytes where {expected} belong")


def _check_address(request: Request, unit: int, function: int) -> None:
    if unit != request.unit:
        raise FrameError("wrong_unit", f"unit {unit} answered instead of {request.unit}")
    if function & 0x7F != request.function:
        text = f"the reply is to function {function & 0x7F:02X}h instead of {request.function:02X}h"
        raise FrameError("wrong_function", text)


def _answer(request: Request, pdu: bytes) -> tuple[int, ...]:
    count = request.count
    if request.function in READS:
        bits = request.function in BIT_READS
        size = (count + 7) // 8 if bits else count * 2
        if pdu[1] != size or len(pdu) != 2 + size:
            has = len(pdu) - 2 if pdu[1] == size else pdu[1]
            raise FrameError("bad_byte_count", f"the reply has {has} data bytes where {size} belong")
        if bits:
            return tuple([pdu[2 + (place >> 3)] >> (place & 7) & 1 for place in range(count)])
        return _registers(count).unpack_from(pdu, 2)
    if not request.values:
        raise FrameError("echo_mismatch", "the reply repeats a request without values")
    head = _head(request)
    if pdu != head:
        raise _other_echo(request, head, pdu)
    return request.values if request.function in ECHOES else ()


@cache
def _registers(count: int) -> struct.Struct:
    return struct.Struct(f">{count}H")


def _other_echo(request: Request, head: bytes, pdu: bytes) -> FrameError:
    """Return the error for a reply that does not repeat a write; of one register it has what the device took."""
    to, written, at, answered = (
        int.from_bytes(one[start : start + 2], "big") for one in (head, pdu) for start in (1, 3)
    )
    if request.function == WRITE_REGISTER and at == to:
        text = f"{written} was written to {to:04X}h, but the device answered {answered}"
        return EchoError(text, (written,), (answered,))
    text = f"{written:04X}h was written to {to:04X}h, but the reply repeats {answered:04X}h at {at:04X}h"
    return FrameError("echo_mismatch", text)
