"""Takes bytes out of their frame and checks the checksum or header; damaged frames can still be read."""

from __future__ import annotations

from dataclasses import dataclass

from fieldscribe.families.modbus.functions import PROTOCOL_MOST, READS, SINGLE
from fieldscribe.families.modbus.requests import crc16
from fieldscribe.wording.buses import check_text, spaced, too_short

MOST_BYTES = {"rtu": 256, "tcp": 260}


@dataclass(frozen=True, slots=True)
class Wrapped:
    """Bytes taken out of their frame. `checks` describes the checksum or header, `fault` what is wrong with it.

    `mended` is the frame without that fault; None where the bytes are too short for a frame.
    """

    framing: str
    data: bytes
    mended: bytes | None
    checks: str
    fault: str

    @property
    def unit(self) -> int | None:
        """The unit number, if the frame is long enough to have one."""
        place = 6 if self.framing == "tcp" else 0
        return self.data[place] if len(self.data) > place else None

    @property
    def pdu(self) -> bytes:
        """The bytes from the function on, without the checksum; may be empty."""
        if self.mended is None:
            return b""
        return self.mended[7:] if self.framing == "tcp" else self.mended[1:-2]


def recognise(data: bytes, framings: tuple[str, ...], forced: str | None = None) -> Wrapped:
    """The bytes in the forced framing; else in the one that checksum or header fit, else in that of the device."""
    framing = forced or _framing(data, framings)
    return _tcp(data) if framing == "tcp" else _rtu(data)


def _framing(data: bytes, framings: tuple[str, ...]) -> str:
    if len(data) >= 4 and _crc(data[:-2]) == data[-2:]:
        return "rtu"
    if len(data) >= 8 and data[2:4] == b"\0\0" and 6 + int.from_bytes(data[4:6], "big") == len(data):
        return "tcp"
    return framings[0] if framings else "rtu"


def _crc(body: bytes) -> bytes:
    return crc16(body).to_bytes(2, "little")


def _rtu(data: bytes) -> Wrapped:
    if len(data) < 4:
        if _has_length(data[1:]):
            return _without_checksum(data)
        return Wrapped("rtu", data, None, "none", too_short("an RTU frame", 4, data))
    body, there = data[:-2], data[-2:]
    right = _crc(body)
    if right == there:
        return Wrapped("rtu", data, data, check_text(there, right), _too_long("rtu", data))
    if right == there[::-1]:
        said = f"its two bytes are swapped: {spaced(there)}, the low byte {spaced(right)} travels first"
        return Wrapped("rtu", data, body + right, said, "the bytes of the checksum are swapped")
    if not _has_length(data[1:-2]) and _has_length(data[1:]):
        return _without_checksum(data)
    return Wrapped("rtu", data, body + right, check_text(there, right), "the checksum is wrong")


def _without_checksum(data: bytes) -> Wrapped:
    right = _crc(data)
    return Wrapped("rtu", data, data + right, check_text(b"", right), "the checksum is missing")


def _tcp(data: bytes) -> Wrapped:
    if len(data) < 8:
        return Wrapped("tcp", data, None, "none", too_short("a TCP frame", 8, data))
    protocol, length = data[2:4], int.from_bytes(data[4:6], "big")
    right = len(data) - 6
    mended = data[:2] + b"\0\0" + (right & 0xFFFF).to_bytes(2, "big") + data[6:]
    transaction = int.from_bytes(data[:2], "big")
    if protocol != b"\0\0":
        said = f"wrong: protocol number {spaced(protocol)} in place of 00 00"
        return Wrapped("tcp", data, mended, said, "the header does not say Modbus")
    if length != right:
        said = f"wrong: it says {length} bytes follow, {right} do"
        return Wrapped("tcp", data, mended, said, "the length in the header is wrong")
    return Wrapped("tcp", data, data, f"ok (transaction {transaction})", _too_long("tcp", data))


def _has_length(pdu: bytes) -> bool:
    """Whether a PDU is as long as its function says, as a request or as a reply."""
    if not pdu:
        return False
    function, size = pdu[0], len(pdu)
    if function & 0x80:
        return size == 2
    if function not in PROTOCOL_MOST:
        return False
    if function in READS:
        return size == 5 or (size >= 2 and size == 2 + pdu[1])
    if function in SINGLE:
        return size == 5
    return size == 5 or (size >= 6 and size == 6 + pdu[5])


def _too_long(framing: str, data: bytes) -> str:
    most = MOST_BYTES[framing]
    return f"the frame has {len(data)} bytes, {most} are the most" if len(data) > most else ""
