"""Modbus requests: builds their bytes, and reads bytes as requests. Pure functions, no I/O."""

from __future__ import annotations

from dataclasses import dataclass

from fieldscribe.families.modbus.functions import (
    PROTOCOL_MOST,
    READS,
    SINGLE,
    Profile,
)


@dataclass(frozen=True, slots=True)
class Request:
    """A request: `count` items from `address` on. `values` are what a write carries (0 or 1 for coils), else empty.

    For 08h `address` is the sub-function and the one value is the test data. `transaction` matters only to tcp.
    """

    unit: int
    function: int
    address: int
    count: int
    values: tuple[int, ...] = ()
    transaction: int = 0


def _crc_table() -> tuple[int, ...]:
    table = []
    for byte in range(256):
        crc = byte
        for _ in range(8):
            crc = crc >> 1 ^ 0xA001 if crc & 1 else crc >> 1
        table.append(crc)
    return tuple(table)


_CRC = _crc_table()


def crc16(data: bytes) -> int:
    """The CRC-16 of Modbus RTU; its low byte travels first."""
    crc = 0xFFFF
    for byte in data:
        crc = crc >> 8 ^ _CRC[(crc ^ byte) & 0xFF]
    return crc


def frame(framing: str, unit: int, transaction: int, pdu: bytes) -> bytes:
    """A PDU in its frame: with unit and CRC for rtu, with the MBAP header for tcp."""
    if framing == "tcp":
        return bytes((*divmod(transaction, 256), 0, 0, *divmod(len(pdu) + 1, 256), unit)) + pdu
    body = bytes((unit,)) + pdu
    return body + crc16(body).to_bytes(2, "little")


def pack_bits(values: tuple[int, ...], even: bool) -> bytes:
    """Bits packed from the lowest bit of the first byte on; an even number of bytes if `even`."""
    size = (len(values) + 7) // 8
    if even:
        size += size & 1
    return sum(bit << place for place, bit in enumerate(values)).to_bytes(size, "little")


def build(profile: Profile, framing: str, request: Request) -> tuple[str, bytes]:
    """The bytes of a request; (status, b"") when it must not be sent.

    The first failure wins: `bad_framing` (one that the device does not speak), `bad_function` (not one the device
    allows), `bad_unit` (outside the units, or broadcast
    with a function that does not go to all units), `bad_count` (none, more than the most, a single write without
    exactly one value), `bad_address` (beyond 65535; a sub-function of 08h other than 0), `bad_value` (a coil not
    0 or 1, a word not 16 bits).
    """
    status = _refusal(profile, request) if framing in profile.framings else "bad_framing"
    return (
        (status, b"")
        if status != "ok"
        else ("ok", frame(framing, request.unit, request.transaction, _pdu(profile, request)))
    )


def _refusal(profile: Profile, request: Request) -> str:
    most = profile.most.get(request.function)
    if most is None:
        return "bad_function"
    low, high = profile.units
    if request.unit == profile.broadcast:
        if request.function not in profile.broadcasts:
            return "bad_unit"
    elif not low <= request.unit <= high:
        return "bad_unit"
    if not 1 <= request.count <= most or (request.function not in READS and len(request.values) != request.count):
        return "bad_count"
    last = request.address if request.function == 0x08 else request.address + request.count - 1
    if request.address < 0 or last > (0 if request.function == 0x08 else 0xFFFF):
        return "bad_address"
    top = 1 if request.function in (0x05, 0x0F) else 0xFFFF
    return "ok" if all(0 <= value <= top for value in request.values) else "bad_value"


def _pdu(profile: Profile, request: Request) -> bytes:
    head = bytes((request.function, *divmod(request.address, 256)))
    if request.function in READS:
        return head + request.count.to_bytes(2, "big")
    if request.function in SINGLE:
        value = request.values[0]
        return head + (0xFF00 * value if request.function == 0x05 else value).to_bytes(2, "big")
    if request.function == 0x0F:
        data = pack_bits(request.values, profile.pad_coil_bytes_even)
    else:
        data = b"".join(value.to_bytes(2, "big") for value in request.values)
    return head + request.count.to_bytes(2, "big") + bytes((len(data),)) + data


def parse_request(framing: str, data: bytes) -> Request | str:
    """The request in the bytes, or a sentence about what is wrong with them. Any bytes are safe."""
    unframed = _unframe_tcp(data) if framing == "tcp" else _unframe_rtu(data)
    if isinstance(unframed, str):
        return unframed
    unit, transaction, pdu = unframed
    function = pdu[0]
    if function not in PROTOCOL_MOST:
        return f"function {function:02X}h is not one of the Modbus functions known here"
    if len(pdu) < 5:
        return f"a request of function {function:02X}h has at least 5 bytes from the function on, here are {len(pdu)}"
    address, count = int.from_bytes(pdu[1:3], "big"), int.from_bytes(pdu[3:5], "big")
    if function in READS or function in SINGLE:
        if len(pdu) != 5:
            return f"a request of function {function:02X}h has 5 bytes from the function on, here are {len(pdu)}"
        return _short_request(Request(unit, function, address, count, (), transaction))
    return _long_request(Request(unit, function, address, count, (), transaction), pdu[5:])


def _unframe_rtu(data: bytes) -> tuple[int, int, bytes] | str:
    if len(data) < 4:
        return f"an RTU frame has at least 4 bytes, here are {len(data)}"
    right, there = crc16(data[:-2]).to_bytes(2, "little"), data[-2:]
    if right != there:
        return f"the CRC is {there[0]:02X} {there[1]:02X}, the bytes give {right[0]:02X} {right[1]:02X}"
    return data[0], 0, data[1:-2]


def _unframe_tcp(data: bytes) -> tuple[int, int, bytes] | str:
    if len(data) < 8:
        return f"a TCP frame has at least 8 bytes, here are {len(data)}"
    protocol, length = int.from_bytes(data[2:4], "big"), int.from_bytes(data[4:6], "big")
    if protocol != 0:
        return f"the protocol number is {protocol}, Modbus is 0"
    if length != len(data) - 6:
        return f"the length field says {length} bytes, here are {len(data) - 6}"
    return data[6], int.from_bytes(data[:2], "big"), data[7:]


def _short_request(head: Request) -> Request | str:
    """A read or a single write; `head.count` holds its last two bytes."""
    if head.function in READS:
        if not 1 <= head.count <= PROTOCOL_MOST[head.function]:
            return f"a count of {head.count} is outside 1 to {PROTOCOL_MOST[head.function]}"
        return head
    value = head.count
    if head.function == 0x05:
        if value not in (0x0000, 0xFF00):
            return f"a coil is written with FF00h or 0000h, here is {value:04X}h"
        value //= 0xFF00
    return Request(head.unit, head.function, head.address, 1, (value,), head.transaction)


def _long_request(head: Request, rest: bytes) -> Request | str:
    """A write of several items; `rest` is what follows the count: the byte count and the data."""
    most = PROTOCOL_MOST[head.function]
    if not 1 <= head.count <= most:
        return f"a count of {head.count} is outside 1 to {most}"
    if not rest or rest[0] != len(rest) - 1:
        said = f"says {rest[0]}" if rest else "is missing"
        return f"the byte count {said}, here are {max(0, len(rest) - 1)} bytes of data"
    data = rest[1:]
    if head.function == 0x10:
        if len(data) != 2 * head.count:
            return f"{head.count} words are {2 * head.count} bytes, here are {len(data)}"
        values = tuple(int.from_bytes(data[at : at + 2], "big") for at in range(0, len(data), 2))
    else:
        size = (head.count + 7) // 8
        if len(data) not in (size, size + (size & 1)):
            return f"{head.count} coils are {size} bytes (or padded to an even number), here are {len(data)}"
        values = tuple(data[at >> 3] >> (at & 7) & 1 for at in range(head.count))
    return Request(head.unit, head.function, head.address, head.count, values, head.transaction)
