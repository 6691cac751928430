"""Packets and captures by hand."""

from __future__ import annotations

import struct
from collections.abc import Iterable, Iterator

CLIENT, DEVICE = bytes((10, 0, 0, 1)), bytes((10, 0, 0, 2))


def segment(number: int, data: bytes, *, flags: int = 16, back: bool = False, port: int = 4000, seen: int = 0) -> bytes:
    """An Ethernet frame with a segment of a connection from a client to port 502, or back; `seen` acknowledges."""
    ports = (502, port) if back else (port, 502)
    tcp = struct.pack(">HHIIBBHHH", *ports, number & 0xFFFFFFFF, seen & 0xFFFFFFFF, 0x50, flags, 8192, 0, 0) + data
    ends = (DEVICE, CLIENT) if back else (CLIENT, DEVICE)
    return bytes(12) + b"\x08\0" + struct.pack(">BBHHHBBH4s4s", 0x45, 0, 20 + len(tcp), 0, 0, 64, 6, 0, *ends) + tcp


def classic(packets: Iterable[bytes], *, link: int = 1, step: float = 0.005) -> bytes:
    """A file (pcap) with these packets, one every `step` seconds."""
    return b"".join(classic_pieces(packets, link=link, step=step))


def classic_pieces(packets: Iterable[bytes], *, link: int = 1, step: float = 0.005) -> Iterator[bytes]:
    """The same, piece by piece."""
    yield struct.pack("<IHHiIII", 0xA1B2C3D4, 2, 4, 0, 0, 65535, link)
    for place, data in enumerate(packets):
        micros = 1_700_000_000_000_000 + round(place * step * 1e6)
        yield struct.pack("<IIII", *divmod(micros, 1_000_000), len(data), len(data)) + data
