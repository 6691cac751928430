"""Modbus frames, requests and replies: built, and parsed from any bytes. Pure functions, no I/O.

The first half wraps a PDU for a serial line or for TCP, unwraps and measures it. The second half builds requests, and
reads a PDU as a request or as the reply to one.
"""

from dataclasses import dataclass
from functools import lru_cache

from fieldscribe.arithmetic.words import words_in
from fieldscribe.families.modbus import BIT_LISTS, FUNCTIONS, READS, SINGLE, Profile

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


# Requests and replies.


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


@dataclass(frozen=True, slots=True)
class Reply:
    """A reply: `values` only if `status` is ok, `exception` (the code) only if it is `exception`, else 0."""

    status: str
    values: tuple[int, ...] = ()
    exception: int = 0


def build(profile: Profile, framing: str, request: Request) -> tuple[str, bytes]:
    """Return ("ok", the bytes of a request), or (status, b"") if it must not be sent.

    The first failure wins: `bad_framing` (one that the device does not speak), `bad_function` (one that the device does
    not allow), `bad_unit` (outside the units, or broadcast with a function that does not go to all units), `bad_count`
    (none, more than the most, or a single write without exactly one value), `bad_address` (beyond 65535, or a
    sub-function of 08h other than 0), `bad_value` (a coil that is not 0 or 1, a word of more than 16 bits).
    """
    status = _refusal(profile, request) if framing in profile.framings else "bad_framing"
    if status != "ok":
        return status, b""
    return "ok", frame(framing, request.unit, request.transaction, _pdu(profile, request))


def _refusal(profile: Profile, request: Request) -> str:
    most = profile.most.get(request.function)
    if most is None:
        return "bad_function"
    low, high = profile.units
    broadcast = request.unit == profile.broadcast
    if request.function not in profile.broadcasts if broadcast else not low <= request.unit <= high:
        return "bad_unit"
    if not 1 <= request.count <= most or (request.function not in READS and len(request.values) != request.count):
        return "bad_count"
    last, highest = (request.address, 0) if request.function == 0x08 else (request.address + request.count - 1, 0xFFFF)
    if request.address < 0 or last > highest:
        return "bad_address"
    top = 1 if request.function in (0x05, 0x0F) else 0xFFFF
    return "ok" if all(0 <= value <= top for value in request.values) else "bad_value"


def _pdu(profile: Profile, request: Request) -> bytes:
    head = bytes((request.function, *divmod(request.address, 256)))
    if request.function in READS | SINGLE:
        return head + (_second_word(request) or 0).to_bytes(2, "big")
    if request.function == 0x0F:
        data = pack_bits(request.values, profile.pad_coil_bytes_even)
    else:
        data = b"".join(value.to_bytes(2, "big") for value in request.values)
    return head + request.count.to_bytes(2, "big") + bytes((len(data),)) + data


def _second_word(request: Request) -> int | None:
    """Return the word after the address: the value of a single write (None without one), else the count."""
    if request.function not in SINGLE:
        return request.count
    if len(request.values) != 1:
        return None
    return 0xFF00 * request.values[0] if request.function == 0x05 else request.values[0]


def parse_request(framing: str, data: bytes) -> Request | Flaw:
    """Return the request in the bytes, or what is wrong with them. Any bytes are safe."""
    unwrapped = unwrap(framing, data)
    return unwrapped.flaw or request_in(unwrapped)


def request_in(unwrapped: Unwrapped) -> Request | Flaw:
    """Return the request in a PDU, even that of a flawed frame; else the first flaw.

    `bad_function` (one that is not supported here), `short_request`, `long_request`, `bad_count`, and the flaws of
    the data that it writes.
    """
    pdu = unwrapped.pdu
    flaw = _head_flaw(pdu) if pdu else unwrapped.flaw or Flaw("short_request", 0, 5)
    if flaw is not None:
        return flaw
    function, (address, number) = pdu[0], words_in(pdu[1:5])
    count = 1 if function in SINGLE else number
    if not 1 <= count <= FUNCTIONS[function].most:
        return Flaw("bad_count", count, FUNCTIONS[function].most)
    one_value = function in READS | SINGLE
    values = _one_value(function, number) if one_value else _several_values(function, count, pdu[5:])
    if isinstance(values, Flaw):
        return values
    return Request(unwrapped.unit or 0, function, address, count, values, unwrapped.transaction)


def _head_flaw(pdu: bytes) -> Flaw | None:
    """Return what is wrong with the function of a request, or with the length that the function gives."""
    function = pdu[0]
    if function not in FUNCTIONS:
        return Flaw("bad_function", of=function)
    if len(pdu) < 5:
        return Flaw("short_request", len(pdu), 5, function)
    return Flaw("long_request", len(pdu), 5, function) if function in READS | SINGLE and len(pdu) > 5 else None


def _one_value(function: int, number: int) -> tuple[int, ...] | Flaw:
    """Return the value in the second word of a single write; nothing for a read."""
    if function == 0x05:
        return Flaw("bad_coil", number) if number % 0xFF00 else (number // 0xFF00,)
    return (number,) if function in SINGLE else ()


def _several_values(function: int, count: int, rest: bytes) -> tuple[int, ...] | Flaw:
    """Return the values of a write of several items, from the bytes after the count: the byte count and the data."""
    data, size = rest[1:], data_size(function, count)
    if not rest:
        return Flaw("no_byte_count")
    if rest[0] != len(data):
        return Flaw("bad_byte_count", len(data), rest[0])
    # coils may be padded to an even number of bytes
    if len(data) not in (size, size + (size & 1)):
        return Flaw("bad_coils" if function == 0x0F else "bad_words", len(data), size, count)
    return values_in(function, data)[:count]


def parse_reply(framing: str, request: Request, data: bytes) -> Reply:
    """Return `data` as the reply to `request`. Any bytes at any length are safe; the first failure wins.

    `bad_function` (the request's), `short_frame` (of any reply), in rtu `short_frame` or `long_frame` (not the length
    that its function gives), `bad_crc` or `bad_protocol`, in tcp `short_frame` or `long_frame` (not the length in the
    header) and `wrong_transaction`, `wrong_unit`, `exception` (`long_frame` if more than the code follows),
    `wrong_function`, `bad_byte_count` (a read brings another number of bytes than requested), `short_frame` or
    `long_frame` (a write that does not repeat two words), `echo_mismatch` (a write or 08h repeats other words).
    """
    return reply_in(request, unwrap(framing, data))


def reply_in(request: Request, unwrapped: Unwrapped) -> Reply:
    """Return what `parse_reply` returns, for bytes that are unwrapped already."""
    if request.function not in FUNCTIONS:
        return Reply("bad_function")
    status = _frame_status(request, unwrapped)
    if status != "ok":
        return Reply(status)
    pdu = unwrapped.pdu
    if pdu[0] == request.function | 0x80:
        return Reply("exception", (), pdu[1]) if len(pdu) == 2 else Reply("long_frame")
    return _parse_pdu(request, pdu) if pdu[0] == request.function else Reply("wrong_function")


def confirmed_write(pdu: bytes) -> Request | None:
    """Return the write of several items that a reply confirms; unit and values are not in it."""
    if pdu[0] not in (0x0F, 0x10) or len(pdu) != 5:
        return None
    address, count = words_in(pdu[1:])
    return Request(0, pdu[0], address, count)


def _frame_status(request: Request, unwrapped: Unwrapped) -> str:
    """Return what is wrong with the frame of a reply or its unit; an RTU frame has the length of its function."""
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
    """Return the reply in a PDU of at least two bytes that carries the request's function."""
    if request.function in READS:
        size = data_size(request.function, request.count)
        if pdu[1] != size or len(pdu) != 2 + size:
            return Reply("bad_byte_count")
        return Reply("ok", values_in(request.function, pdu[2:])[: request.count])
    if len(pdu) != 5:
        return Reply(_size_status(len(pdu), 5))
    if words_in(pdu[1:]) != (request.address, _second_word(request)):
        return Reply("echo_mismatch")
    return Reply("ok", request.values if request.function in SINGLE else ())
