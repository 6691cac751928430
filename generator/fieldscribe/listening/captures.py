"""The chunks of a capture of any kind: packets (pcap, pcapng), messages (BLF, ASC), or lines of text.

`listen` calls `chunks_of`. Packets are taken apart, and the segments of each connection joined in their order; any
bytes are safe.
"""

import json
from collections.abc import Callable, Container, Iterable, Iterator
from dataclasses import dataclass, field
from functools import lru_cache
from io import SEEK_END, BufferedReader, TextIOWrapper
from typing import Any

from fieldscribe.diagnostics import UnclearError
from fieldscribe.listening.chunks import BUS_SOCKET, BYTES, MESSAGE, SERIAL, STREAM, Chunk, Packet
from fieldscribe.listening.packet_files import is_packet_file, read_packets

_LONGEST_LINE = 1 << 16
_ENOUGH = 1000
"""A file that starts with this many lines without a frame is no log."""
_NO_FRAME = (
    "it has no frame",
    "captures are pcap, pcapng, BLF, ASC, logs of candump, bytes as hexadecimals, traces of `simulate` without CAN",
)
_BLF, _ASC = b"LOGG", b"date"
"""The first bytes of BLF and of ASC files."""


def chunks_of(
    stream: BufferedReader,
    ports: frozenset[int],
    chunk_of: Callable[[str], Chunk | None],
    each: Callable[[Packet], None] | None = None,
) -> Iterator[Chunk]:
    """Yield the chunks of a capture; `each` gets every packet, `chunk_of` reads a line of text (None: it has none).

    Raises UnclearError if a capture is cut off or corrupt, or if the file is none.
    """
    if is_packet_file(stream.peek(4)):
        packets = Packets(ports)
        for packet in read_packets(stream):
            if each is not None:
                each(packet)
            yield from packets.chunks(packet)
        return
    if is_bus_file(stream.peek(4)):
        yield from bus_chunks(stream)
        return
    has_frames, skipped = False, 0
    while line := stream.readline(_LONGEST_LINE):
        text = line.decode("utf-8-sig", "replace").strip()
        chunks = [chunk for frame in _frames_in(text) if (chunk := chunk_of(frame)) is not None]
        if chunks:
            has_frames = True
            yield from chunks
        elif text:
            skipped += 1
            if skipped == _ENOUGH and not has_frames:
                raise UnclearError(*_NO_FRAME)
    if skipped and not has_frames:
        raise UnclearError(*_NO_FRAME)


def _frames_in(text: str) -> list[str]:
    """Return the frames in a line of a log, each with its time; a line of the trace of `simulate` has two."""
    if not text.startswith("{"):
        return [text] if text else []
    try:
        entry = json.loads(text)
        begin = float(entry["time"])
        times = {"request": begin, "answer": begin + float(entry["delay"])}
        return [f"{time:.6f} {entry[key]}" for key, time in times.items() if entry[key]]
    except (ValueError, KeyError, TypeError, RecursionError):
        return [text]


def is_bus_file(start: bytes) -> bool:
    """Return True if a file starts like BLF or ASC."""
    return start[:4] == _BLF or start[:4].lower() == _ASC


def bus_chunks(stream: BufferedReader) -> Iterator[Chunk]:
    """Yield the messages of a capture. Raises UnclearError without python-can, or if the file is damaged."""
    try:
        from can import BLFReader
    except ModuleNotFoundError as error:
        raise UnclearError(f"BLF and ASC are read by python-can: {error}", "pip install 'fieldscribe[live]'") from error
    is_blf = stream.peek(4)[:4] == _BLF
    size = _size(stream)
    try:
        reader: Any = BLFReader(stream) if is_blf else _asc(stream)
        for frame in reader:
            if not frame.is_error_frame:
                place = "" if frame.channel is None else f"can{frame.channel}"
                remote, identifier = frame.is_remote_frame, frame.arbitration_id
                yield Chunk(frame.timestamp, MESSAGE, bytes(frame.data), place, identifier=identifier, remote=remote)
    except Exception as error:  # the readers raise any exception for a damaged file
        raise UnclearError(f"it is no whole {'BLF' if is_blf else 'ASC'} file: {error}") from error
    if size is not None and is_blf and reader.file_size > size:  # its reader just stops there
        raise UnclearError(f"it is no whole BLF file: it has {size} of {reader.file_size} bytes")


def _asc(stream: BufferedReader) -> Any:
    from can import ASCReader

    return ASCReader(TextIOWrapper(stream, "utf-8", "replace"), relative_timestamp=False)


def _size(stream: BufferedReader) -> int | None:
    """Return the bytes of a file; None if it is no file."""
    if not stream.seekable():
        return None
    size = stream.seek(0, SEEK_END)
    stream.seek(0)
    return size


# Packets.


_HEADS = {1: (14, 12), 113: (16, 14), 276: (20, 0), 0: (4, -1), 108: (4, -1), 101: (0, -1), 228: (0, -1), 229: (0, -1)}
"""Network link types: the size of their header, and the offset of the protocol; -1 for plain IP packets."""
_USERS = range(SERIAL, SERIAL + 16)
_IP4, _IP6, _VLAN, _BUS, _TCP = 0x0800, 0x86DD, (0x8100, 0x88A8), (0x000C, 0x000D), 6
_FIN, _SYN, _RST = 1, 2, 4
_MOST_CONNECTIONS, _MOST_HELD, _HALF = 1024, 32, 1 << 31
"""Limits: connections that are followed, segments that wait for an earlier one, half of the sequence numbers."""


@dataclass(slots=True)
class _Direction:
    """One direction of a connection: the next sequence number, and segments that arrived too early."""

    due: int | None = None
    held: dict[int, bytes] = field(default_factory=dict)


class Packets:
    """Turns packets into chunks; `ports` are those of the devices."""

    def __init__(self, ports: Container[int]) -> None:
        self._ports = ports
        self._way = lru_cache(_MOST_CONNECTIONS)(lambda _source, _target: _Direction())

    def chunks(self, packet: Packet) -> Iterable[Chunk]:
        """Return the chunks of a packet; any bytes are safe."""
        link, data = packet.link, packet.data
        if link == BUS_SOCKET:
            return _message(packet.time, data)
        if link in _USERS:
            return (Chunk(packet.time, BYTES, data),)
        if link in _HEADS:
            size, place = _HEADS[link]
            protocol = _ip_of(data[size:]) if place < 0 else int.from_bytes(data[place : place + 2], "big")
            while protocol in _VLAN:
                protocol, size = int.from_bytes(data[size + 2 : size + 4], "big"), size + 4
            if protocol in _BUS:
                return _message(packet.time, data[size:])
            if protocol in (_IP4, _IP6):
                return self._internet(packet.time, data[size:], protocol)
        return ()

    def _internet(self, time: float | None, data: bytes, protocol: int) -> Iterable[Chunk]:
        if len(data) < 40:
            return ()
        if protocol == _IP4:
            head, last = (data[0] & 15) * 4, int.from_bytes(data[2:4], "big") or len(data)
            if data[9] != _TCP or int.from_bytes(data[6:8], "big") & 0x3FFF:
                return ()
            source, target = data[12:16], data[16:20]
        else:
            head, last = 40, 40 + int.from_bytes(data[4:6], "big")
            if data[6] != _TCP:
                return ()
            source, target = data[8:24], data[24:40]
        segment = data[head:last]
        return self._segment(time, source, target, segment) if len(segment) >= 20 else ()

    def _segment(self, time: float | None, source: bytes, target: bytes, segment: bytes) -> Iterator[Chunk]:
        ports = int.from_bytes(segment[:2], "big"), int.from_bytes(segment[2:4], "big")
        sent = ports[1] in self._ports
        if not sent and ports[0] not in self._ports:
            return
        flags, data = segment[13], segment[(segment[12] >> 4) * 4 :]
        number = int.from_bytes(segment[4:8], "big")
        way = self._way(source + segment[:2], target + segment[2:4])
        if flags & (_SYN | _RST):
            way.due, way.held = (number + 1) % (1 << 32), {}
        if data and not flags & _SYN:
            client, port = (source, ports[0]) if sent else (target, ports[1])
            place = f"{_address(client)}:{port}"
            for fresh, piece in _in_order(way, number, data):
                yield Chunk(time, STREAM, piece, place, sent, fresh)


def _in_order(way: _Direction, number: int, data: bytes) -> Iterator[tuple[bool, bytes]]:
    """Yield the bytes that follow now, once each and in order; True with those after lost ones."""
    fresh = way.due is None
    due = number if way.due is None else way.due
    way.held[number] = data
    while way.held:
        first = min(way.held, key=lambda at: (at - due) % (1 << 32) if (at - due) % (1 << 32) < _HALF else -1)
        ahead = (first - due) % (1 << 32)
        if 0 < ahead < _HALF and len(way.held) < _MOST_HELD:
            break
        piece = way.held.pop(first)
        if 0 < ahead < _HALF:
            fresh, due, ahead = True, first, 0
        piece = piece[-ahead % (1 << 32) :]
        if piece:
            yield fresh, piece
            due, fresh = (due + len(piece)) % (1 << 32), False
    way.due = due


def _message(time: float | None, data: bytes) -> tuple[Chunk, ...]:
    """Return the message of a packet of SocketCAN; error frames are no messages."""
    if len(data) < 8:
        return ()
    identifier, size = int.from_bytes(data[:4], "big"), data[4]
    if identifier & 0x20000000 or size > len(data) - 8:
        return ()
    mask = 0x1FFFFFFF if identifier & 0x80000000 else 0x7FF
    remote = bool(identifier & 0x40000000)
    content = b"" if remote else data[8 : 8 + size]
    return (Chunk(time, MESSAGE, content, "", None, False, identifier & mask, remote),)


def _ip_of(data: bytes) -> int:
    return {4: _IP4, 6: _IP6}.get(data[0] >> 4 if data else 0, 0)


def _address(address: bytes) -> str:
    """Return an address in its usual notation."""
    if len(address) == 4:
        return ".".join(map(str, address))
    return f"[{':'.join(f'{address[at] << 8 | address[at + 1]:x}' for at in range(0, 16, 2))}]"
