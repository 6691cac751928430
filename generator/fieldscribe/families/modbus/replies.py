"""Modbus replies: reads bytes as the answer to a request. Pure functions, no I/O."""

from __future__ import annotations

from dataclasses import dataclass

from fieldscribe.arithmetic.words import words_in
from fieldscribe.families.modbus.frames import Unwrapped, data_size, reply_length, unwrap, values_in
from fieldscribe.families.modbus.functions import PROTOCOL_MOST, READS, SINGLE
from fieldscribe.families.modbus.requests import Request


@dataclass(frozen=True, slots=True)
class Reply:
    """An answer: `values` only if `status` is ok, `exception` (the code) only if it is `exception`, else 0."""

    status: str
    values: tuple[int, ...] = ()
    exception: int = 0


def parse_reply(framing: str, request: Request, data: bytes) -> Reply:
    """`data` read as the answer to `request`. Any bytes at any length are safe; the first failure wins.

    `bad_function` (the request's), `short_frame` (of any answer), in rtu `short_frame` or `long_frame` (not the length
    that its function gives), `bad_crc` or `bad_protocol`, in tcp `short_frame` or `long_frame` (not the length that the
    header says) and `wrong_transaction`, `wrong_unit`, `exception` (`long_frame` if more than the code follows),
    `wrong_function`, `bad_byte_count` (a read brings another number of bytes than was asked for), `short_frame` or
    `long_frame` (a write that does not repeat two words), `echo_mismatch` (a write or 08h repeats other words).
    """
    return reply_in(request, unwrap(framing, data))


def reply_in(request: Request, unwrapped: Unwrapped) -> Reply:
    """What `parse_reply` says of bytes that were taken out of their frame."""
    if request.function not in PROTOCOL_MOST:
        return Reply("bad_function")
    status = _frame_status(request, unwrapped)
    if status != "ok":
        return Reply(status)
    pdu = unwrapped.pdu
    if pdu[0] == request.function | 0x80:
        return Reply("exception", (), pdu[1]) if len(pdu) == 2 else Reply("long_frame")
    return _parse_pdu(request, pdu) if pdu[0] == request.function else Reply("wrong_function")


def done_in(pdu: bytes) -> Request | None:
    """The write of several items that a reply says was done; its unit and its values are not told."""
    if pdu[0] not in (0x0F, 0x10) or len(pdu) != 5:
        return None
    address, count = words_in(pdu[1:])
    return Request(0, pdu[0], address, count)


def _frame_status(request: Request, unwrapped: Unwrapped) -> str:
    """What is wrong with the frame round the PDU, or its addressee; an RTU frame has the length of its function."""
    pdu, flaw = unwrapped.pdu, unwrapped.flaw
    if len(pdu) < 2:
        return "short_frame"
    if unwrapped.framing == "rtu" and pdu[0] & 0x7F == request.function and len(pdu) != reply_length(pdu):
        return _size_status(len(pdu), reply_length(pdu))
    if flaw is not None:
        return _size_status(flaw.here, flaw.due) if flaw.status == "bad_length" else flaw.status
    if unwrapped.framing == "tcp" and unwrapped.transaction != request.transaction:
        return "wrong_transaction"
    return "ok" if unwrapped.unit == request.unit else "wrong_unit"


def _size_status(here: int, due: int) -> str:
    return "short_frame" if here < due else "long_frame"


def _parse_pdu(request: Request, pdu: bytes) -> Reply:
    """The PDU (two bytes at least) of a reply that carries the request's function."""
    if request.function in READS:
        size = data_size(request.function, request.count)
        if pdu[1] != size or len(pdu) != 2 + size:
            return Reply("bad_byte_count")
        return Reply("ok", values_in(request.function, pdu[2:])[: request.count])
    if len(pdu) != 5:
        return Reply("short_frame" if len(pdu) < 5 else "long_frame")
    if words_in(pdu[1:]) != (request.address, _echoed(request)):
        return Reply("echo_mismatch")
    return Reply("ok", request.values if request.function in SINGLE else ())


def _echoed(request: Request) -> int | None:
    """The second word that the answer repeats: the value of a single write, else the count."""
    if request.function not in SINGLE:
        return request.count
    if len(request.values) != 1:
        return None
    return 0xFF00 * request.values[0] if request.function == 0x05 else request.values[0]
