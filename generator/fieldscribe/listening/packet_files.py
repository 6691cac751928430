"""Reads packets from pcap and pcapng files, and writes pcapng.

Captures are untrusted: an impossible length is an error that names the packet, and nothing large is read. `captures`
takes the packets apart.
"""

import struct
from collections.abc import Iterator
from typing import BinaryIO

from fieldscribe.diagnostics import UnclearError
from fieldscribe.listening.chunks import Packet

_CLASSIC = {
    b"\xd4\xc3\xb2\xa1": ("<", 1e6),
    b"\xa1\xb2\xc3\xd4": (">", 1e6),
    b"\x4d\x3c\xb2\xa1": ("<", 1e9),
    b"\xa1\xb2\x3c\x4d": (">", 1e9),
}
"""The first bytes of a pcap file, with its byte order and fractions of a second."""
_SECTION = b"\x0a\x0d\x0d\x0a"
_INTERFACE, _SIMPLE, _ENHANCED = 1, 3, 6
_RESOLUTION = 9
"""The option of an interface with the fractions of a second."""
_MOST_BYTES = 1 << 20
"""The most bytes of a packet or block; a larger one means that the file is corrupt."""
_MOST_INTERFACES = 1024


def is_packet_file(start: bytes) -> bool:
    """Return True if a file starts like pcap or pcapng."""
    return start[:4] in _CLASSIC or start[:4] == _SECTION


def read_packets(stream: BinaryIO) -> Iterator[Packet]:
    """Return the packets of a capture. Raises UnclearError if the file is cut off or corrupt."""
    magic = _exactly(stream, 4, "the header")
    return _enhanced(stream) if magic == _SECTION else _classic(stream, *_CLASSIC[magic])


def _classic(stream: BinaryIO, order: str, parts: float) -> Iterator[Packet]:
    link = struct.unpack(f"{order}HHiIII", _exactly(stream, 20, "the header"))[-1] & 0xFFFF
    head = struct.Struct(f"{order}IIII")
    number = 1
    while start := stream.read(16):
        if len(start) < 16:
            raise _cut_off(number)
        seconds, part, size, _ = head.unpack(start)
        yield Packet(seconds + part / parts, link, _exactly(stream, size, number))
        number += 1


def _enhanced(stream: BinaryIO) -> Iterator[Packet]:
    """Yield the packets of pcapng, whose first four bytes are read."""
    interfaces: list[tuple[int, float]] = []
    order, number, start = "<", 1, _SECTION
    while start:
        start += _exactly(stream, 4, number)
        if start[:4] == _SECTION:
            interfaces, mark = [], _exactly(stream, 4, number)
            order = "<" if mark == b"\x4d\x3c\x2b\x1a" else ">"
            body = _exactly(stream, struct.unpack(f"{order}I", start[4:])[0] - 16, number)
            _exactly(stream, 4, number)
        else:
            kind, size = struct.unpack(f"{order}II", start)
            body = _exactly(stream, size - 12, number)
            _exactly(stream, -size % 4 + 4, number)
            if kind == _INTERFACE and len(interfaces) < _MOST_INTERFACES:
                interfaces.append(_interface(order, body))
            elif kind in (_ENHANCED, _SIMPLE) and (packet := _packet(order, kind, body, interfaces)):
                yield packet
                number += 1
        start = stream.read(4)
        if 0 < len(start) < 4:
            raise _cut_off(number)


def _interface(order: str, body: bytes) -> tuple[int, float]:
    """Return the link type of an interface, and the fractions of a second of its times."""
    link = int.from_bytes(body[:2], "little" if order == "<" else "big")
    at, parts = 8, 1e6
    while at + 4 < len(body):
        code, size = struct.unpack_from(f"{order}HH", body, at)
        if code == _RESOLUTION and size:
            power = body[at + 4]
            parts = float(2 ** (power & 0x7F) if power & 0x80 else 10 ** min(power, 30))
        at += 4 + size + -size % 4
    return link, parts


def _packet(order: str, kind: int, body: bytes, interfaces: list[tuple[int, float]]) -> Packet | None:
    """Return the packet of a block; None if it has no interface."""
    if kind == _SIMPLE:
        return Packet(None, interfaces[0][0], body[4:]) if interfaces else None
    if len(body) < 20:
        return None
    interface, high, low, size, _ = struct.unpack_from(f"{order}IIIII", body)
    if interface >= len(interfaces):
        return None
    link, parts = interfaces[interface]
    return Packet((high << 32 | low) / parts, link, body[20 : 20 + size])


def _exactly(stream: BinaryIO, size: int, where: int | str) -> bytes:
    """Return `size` bytes. Raises UnclearError."""
    if not 0 <= size <= _MOST_BYTES:
        place = f"packet {where}" if isinstance(where, int) else where
        raise UnclearError(f"{place} says that it has {size} bytes", "the capture is damaged from there on")
    data = stream.read(size)
    if len(data) < size:
        raise _cut_off(where)
    return data


def _cut_off(where: int | str) -> UnclearError:
    place = f"packet {where}" if isinstance(where, int) else where
    return UnclearError(f"the capture is cut off within {place}", "what comes before it was read")


class PacketWriter:
    """Writes packets to a stream as pcapng; each type of link becomes an interface."""

    def __init__(self, stream: BinaryIO) -> None:
        self._stream = stream
        self._interfaces: dict[int, int] = {}
        self._block(0x0A0D0D0A, struct.pack("<IHHq", 0x1A2B3C4D, 1, 0, -1))

    def write(self, packet: Packet) -> None:
        """Write a packet."""
        if packet.link not in self._interfaces:
            self._interfaces[packet.link] = len(self._interfaces)
            self._block(_INTERFACE, struct.pack("<HHI", packet.link, 0, 0))
        moment, size = max(0, round((packet.time or 0) * 1e6)), len(packet.data)
        interface = self._interfaces[packet.link]
        head = struct.pack("<IIIII", interface, moment >> 32 & 0xFFFFFFFF, moment & 0xFFFFFFFF, size, size)
        self._block(_ENHANCED, head + packet.data)

    def _block(self, kind: int, body: bytes) -> None:
        size = len(body) + -len(body) % 4 + 12
        self._stream.write(struct.pack("<II", kind, size) + body.ljust(size - 12, b"\0") + struct.pack("<I", size))
