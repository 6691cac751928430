"""Takes packets apart: frames of a network down to the bytes of connections, messages of a bus, bytes of a line."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Container, Iterator
from dataclasses import dataclass, field

from fieldscribe.listening.chunks import BYTES, MESSAGE, STREAM, Chunk
from fieldscribe.listening.packet_files import BUS_SOCKET, SERIAL, Packet

_HEADS = {1: (14, 12), 113: (16, 14), 276: (20, 0), 0: (4, -1), 108: (4, -1), 101: (0, -1), 228: (0, -1), 229: (0, -1)}
"""Types of link of a network: the size of their head, and where it has the protocol; -1 for internet packets alone."""
_USERS = range(SERIAL, SERIAL + 16)
_IP4, _IP6, _VLAN, _BUS, _TCP = 0x0800, 0x86DD, (0x8100, 0x88A8), (0x000C, 0x000D), 6
_FIN, _SYN, _RST = 1, 2, 4
_MOST_CONNECTIONS, _MOST_HELD, _HALF = 1024, 32, 1 << 31
"""Limits: connections that are followed, segments that wait for one before them, half of the sequence numbers."""


@dataclass(slots=True)
class _Direction:
    """One direction of a connection: the next sequence number, and segments that came too early."""

    due: int | None = None
    held: dict[int, bytes] = field(default_factory=dict)


class Packets:
    """Turns packets into chunks; `ports` are those of the devices."""

    def __init__(self, ports: Container[int]) -> None:
        self._ports = ports
        self._directions: OrderedDict[tuple[bytes, bytes], _Direction] = OrderedDict()

    def chunks(self, packet: Packet) -> Iterator[Chunk]:
        """Return what a packet brings; any bytes are safe."""
        link, data = packet.link, packet.data
        if link in _USERS:
            yield Chunk(packet.time, BYTES, data)
        elif link == BUS_SOCKET:
            yield from _message(packet.time, data)
        elif link in _HEADS:
            size, place = _HEADS[link]
            protocol = _ip_of(data[size:]) if place < 0 else int.from_bytes(data[place : place + 2], "big")
            while protocol in _VLAN:
                protocol, size = int.from_bytes(data[size + 2 : size + 4], "big"), size + 4
            if protocol in _BUS:
                yield from _message(packet.time, data[size:])
            elif protocol in (_IP4, _IP6):
                yield from self._internet(packet.time, data[size:], protocol)

    def _internet(self, time: float | None, data: bytes, protocol: int) -> Iterator[Chunk]:
        if len(data) < 40:
            return
        if protocol == _IP4:
            head, last = (data[0] & 15) * 4, int.from_bytes(data[2:4], "big") or len(data)
            if data[9] != _TCP or int.from_bytes(data[6:8], "big") & 0x3FFF:
                return
            source, target = data[12:16], data[16:20]
        else:
            head, last = 40, 40 + int.from_bytes(data[4:6], "big")
            if data[6] != _TCP:
                return
            source, target = data[8:24], data[24:40]
        segment = data[head:last]
        if len(segment) >= 20:
            yield from self._segment(time, source, target, segment)

    def _segment(self, time: float | None, source: bytes, target: bytes, segment: bytes) -> Iterator[Chunk]:
        ports = int.from_bytes(segment[:2], "big"), int.from_bytes(segment[2:4], "big")
        sent = ports[1] in self._ports
        if not sent and ports[0] not in self._ports:
            return
        flags, data = segment[13], segment[(segment[12] >> 4) * 4 :]
        number = int.from_bytes(segment[4:8], "big")
        way = self._way((source + segment[:2], target + segment[2:4]))
        if flags & (_SYN | _RST):
            way.due, way.held = (number + 1) % (1 << 32), {}
        if data and not flags & _SYN:
            client, port = (source, ports[0]) if sent else (target, ports[1])
            place = f"{_address(client)}:{port}"
            for fresh, piece in _in_order(way, number, data):
                yield Chunk(time, STREAM, piece, place, sent, fresh)

    def _way(self, key: tuple[bytes, bytes]) -> _Direction:
        way = self._directions.setdefault(key, _Direction())
        self._directions.move_to_end(key)
        if len(self._directions) > _MOST_CONNECTIONS:
            self._directions.popitem(last=False)
        return way


def _in_order(way: _Direction, number: int, data: bytes) -> Iterator[tuple[bool, bytes]]:
    """Yield the bytes that follow now, once each and in their order; True with those behind lost ones."""
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


def _message(time: float | None, data: bytes) -> Iterator[Chunk]:
    """Yield the message of a packet of SocketCAN; error frames are no messages."""
    if len(data) < 8:
        return
    identifier, size = int.from_bytes(data[:4], "big"), data[4]
    if not identifier & 0x20000000 and size <= len(data) - 8:
        mask = 0x1FFFFFFF if identifier & 0x80000000 else 0x7FF
        remote = bool(identifier & 0x40000000)
        content = b"" if remote else data[8 : 8 + size]
        yield Chunk(time, MESSAGE, content, identifier=identifier & mask, remote=remote)


def _ip_of(data: bytes) -> int:
    return {4: _IP4, 6: _IP6}.get(data[0] >> 4 if data else 0, 0)


def _address(address: bytes) -> str:
    """Return an address as people write it."""
    if len(address) == 4:
        return ".".join(map(str, address))
    return f"[{':'.join(f'{address[at] << 8 | address[at + 1]:x}' for at in range(0, 16, 2))}]"
