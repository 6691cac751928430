"""Modbus frames: wrap a PDU for a serial line or for TCP, unwrap it, and compute its length. Pure functions, no I/O."""

from dataclasses import dataclass
from functools import lru_cache

from fieldscribe.arithmetic.words import words_in
from fieldscribe.families.modbus import BIT_LISTS, FUNCTIONS, READS, SINGLE

LEAST = {"rtu": 4, "tcp": 8}


@dataclass(frozen=True, slots=True)
class Flaw:
    """Why bytes are not a frame, or not a request: `here` is the number found, `due` the number expected.

    `of` is the function, or the number of items.
    """

    status: str
    here: int = 0
    due: int = 0
    of: int = 0

    @property
    def swapped(self) -> bool:
        """True if the two bytes of a checksum are in the wrong order."""
        return self.status == "bad_crc" and self.here == (self.due >> 8 | (self.due & 0xFF) << 8)


@dataclass(frozen=True, slots=True)
class Unwrapped:
    """Bytes with their PDU (from the function code on; empty if there are too few bytes)."""

    framing: str
    data: bytes
    pdu: bytes = b""
    transaction: int = 0
    flaw: Flaw | None = None

    @property
    def unit(self) -> int | None:
        """The unit number, if the frame is long enough to have one."""
        place = 6 if self.framing == "tcp" else 0
        return self.data[place] if len(self.data) > place else None


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
    """Return the CRC-16 of Modbus RTU; its low byte travels first."""
    crc = 0xFFFF
    for byte in data:
        crc = crc >> 8 ^ _CRC[(crc ^ byte) & 0xFF]
    return crc


def frame(framing: str, unit: int, transaction: int, pdu: bytes) -> bytes:
    """Return a PDU in its frame: with unit and CRC for rtu, with the MBAP header for tcp."""
    if framing == "tcp":
        return bytes((*divmod(transaction, 256), 0, 0, *divmod(len(pdu) + 1, 256), unit)) + pdu
    body = bytes((unit,)) + pdu
    return body + crc16(body).to_bytes(2, "little")


def pack_bits(values: tuple[int, ...], even: bool) -> bytes:
    """Pack bits from the lowest bit of the first byte on; `even` asks for an even number of bytes."""
    size = (len(values) + 7) // 8
    if even:
        size += size & 1
    return sum(bit << place for place, bit in enumerate(values)).to_bytes(size, "little")


@lru_cache(maxsize=16)  # called when pasted bytes are cut into frames, and again when these are decoded
def unwrap(framing: str, data: bytes) -> Unwrapped:
    """Unwrap a frame. Any bytes are safe. The first flaw wins: `short_frame` (fewer bytes than any frame has).

    rtu: `bad_crc`. tcp: `bad_protocol` (the protocol number is not 0), `bad_length` (not the length in the header).
    """
    if len(data) < LEAST[framing]:
        return Unwrapped(framing, data, flaw=Flaw("short_frame", len(data), LEAST[framing]))
    if framing == "rtu":
        here, right = int.from_bytes(data[-2:], "little"), crc16(data[:-2])
        return Unwrapped("rtu", data, data[1:-2], flaw=None if here == right else Flaw("bad_crc", here, right))
    transaction, protocol, length = words_in(data[:6])
    flaw = Flaw("bad_length", len(data) - 6, length) if length != len(data) - 6 else None
    return Unwrapped("tcp", data, data[7:], transaction, Flaw("bad_protocol", protocol) if protocol else flaw)


def without_crc(data: bytes) -> Unwrapped:
    """Unwrap an RTU frame whose checksum is missing."""
    return Unwrapped("rtu", data, data[1:], flaw=Flaw("no_crc", due=crc16(data)))


def request_length(pdu: bytes) -> int:
    """Return the length of the PDU of a request; 0 if it is none."""
    if pdu[0] not in FUNCTIONS:
        return 0
    return 5 if pdu[0] in READS | SINGLE else 6 + pdu[5] if len(pdu) > 5 else 0


def reply_length(pdu: bytes) -> int:
    """Return the length of the PDU of a reply; 0 if it is none."""
    if pdu[0] & 0x80:
        return 2
    if pdu[0] in READS:
        return 2 + pdu[1] if len(pdu) > 1 else 0
    return 5 if pdu[0] in FUNCTIONS else 0


def data_size(function: int, count: int) -> int:
    """Return the number of data bytes for so many items of a function."""
    return (count + 7) // 8 if function in BIT_LISTS else 2 * count


def values_in(function: int, data: bytes) -> tuple[int, ...]:
    """Return all bits or words in the data of a function."""
    if function in BIT_LISTS:
        return tuple(data[at >> 3] >> (at & 7) & 1 for at in range(8 * len(data)))
    return words_in(data)
