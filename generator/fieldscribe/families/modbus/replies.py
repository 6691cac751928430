"""Modbus replies: reads bytes as the answer to a request. Pure functions, no I/O."""

from __future__ import annotations

from dataclasses import dataclass

from fieldscribe.families.modbus.functions import PROTOCOL_MOST, READ_BITS, READS, SINGLE
from fieldscribe.families.modbus.requests import Request, crc16


@dataclass(frozen=True, slots=True)
class Reply:
    """An answer: `values` only if `status` is ok, `exception` (the code) only if it is `exception`, else 0."""

    status: str
    values: tuple[int, ...] = ()
    exception: int = 0


def parse_reply(framing: str, request: Request, data: bytes) -> Reply:
    """`data` read as the answer to `request`. Any bytes at any length are safe; the first failure wins.

    rtu, with F the request's function and f the reply's:
    1. `short_frame`: fewer than 5 bytes;
    2. `short_frame` or `long_frame`: not the length that f says (f = F + 80h: 5; f = F: reads 5 + byte count, else 8;
       any other f has no length);
    3. `bad_crc`  4. `wrong_unit`  5. `wrong_function`  6. `exception`
    7. `bad_byte_count`: a read brings another number of bytes than was asked for
    8. `echo_mismatch`: a write or 08h does not repeat the request.

    tcp:
    1. `short_frame`: fewer than 9 bytes  2. `bad_protocol`: the protocol number is not 0
    3. `short_frame` or `long_frame`: not the length that the header says
    4. `wrong_transaction`  5. `wrong_unit`  6. `wrong_function`
    7. f = F + 80h: `long_frame` if more than the code follows, else `exception`
    8. reads: `bad_byte_count`: the byte count or the length is not what was asked for
    9. others: `short_frame` or `long_frame`: the PDU is not 5 bytes  10. `echo_mismatch`.

    A request of a function that is none of Modbus gives `bad_function` before all.
    """
    if request.function not in PROTOCOL_MOST:
        return Reply("bad_function")
    return _parse_tcp(request, data) if framing == "tcp" else _parse_rtu(request, data)


def _parse_rtu(request: Request, data: bytes) -> Reply:
    if len(data) < 5:
        return Reply("short_frame")
    function = data[1]
    refused = function == request.function | 0x80
    if refused:
        expected = 5
    elif function == request.function:
        expected = 5 + data[2] if function in READS else 8
    else:
        expected = len(data)
    if len(data) != expected:
        return Reply("short_frame" if len(data) < expected else "long_frame")
    if crc16(data[:-2]) != data[-2] | data[-1] << 8:
        return Reply("bad_crc")
    if data[0] != request.unit:
        return Reply("wrong_unit")
    if refused:
        return Reply("exception", (), data[2])
    return _parse_pdu(request, data[1:-2]) if function == request.function else Reply("wrong_function")


def _parse_tcp(request: Request, data: bytes) -> Reply:
    if len(data) < 9:
        return Reply("short_frame")
    if data[2] or data[3]:
        return Reply("bad_protocol")
    expected = 6 + (data[4] << 8 | data[5])
    if len(data) != expected:
        return Reply("short_frame" if len(data) < expected else "long_frame")
    if data[0] << 8 | data[1] != request.transaction or data[6] != request.unit:
        return Reply("wrong_unit" if data[0] << 8 | data[1] == request.transaction else "wrong_transaction")
    pdu = data[7:]
    if pdu[0] == request.function | 0x80:
        return Reply("exception", (), pdu[1]) if len(pdu) == 2 else Reply("long_frame")
    return _parse_pdu(request, pdu) if pdu[0] == request.function else Reply("wrong_function")


def _parse_pdu(request: Request, pdu: bytes) -> Reply:
    """The PDU (two bytes at least) of a reply that carries the request's function."""
    if request.function in READS:
        bits = request.function in READ_BITS
        wanted = (request.count + 7) // 8 if bits else 2 * request.count
        if pdu[1] != wanted or len(pdu) != 2 + wanted:
            return Reply("bad_byte_count")
        if bits:
            return Reply("ok", tuple(pdu[2 + (at >> 3)] >> (at & 7) & 1 for at in range(request.count)))
        return Reply("ok", tuple(pdu[at] << 8 | pdu[at + 1] for at in range(2, len(pdu), 2)))
    if len(pdu) != 5:
        return Reply("short_frame" if len(pdu) < 5 else "long_frame")
    if pdu[1] << 8 | pdu[2] != request.address or pdu[3] << 8 | pdu[4] != _echoed(request):
        return Reply("echo_mismatch")
    return Reply("ok", request.values if request.function in SINGLE else ())


def _echoed(request: Request) -> int | None:
    """The second word that the answer repeats: the value of a single write, else the count."""
    if request.function not in SINGLE:
        return request.count
    if len(request.values) != 1:
        return None
    return 0xFF00 * request.values[0] if request.function == 0x05 else request.values[0]
