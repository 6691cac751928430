"""Cuts what is heard of Modbus into frames: by length and CRC on a serial line, by the header in a network."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Iterator
from dataclasses import replace

from fieldscribe.families.frame_results import FrameResult
from fieldscribe.families.modbus import FUNCTIONS
from fieldscribe.families.modbus.frames import reply_length, request_length, unwrap
from fieldscribe.listening.chunks import BYTES, STREAM, Chunk, Cut
from fieldscribe.listening.cutting import ByteCutter, packet
from fieldscribe.listening.lines import serial_chunks
from fieldscribe.listening.logs import logged_bytes
from fieldscribe.live.lines import LineAddress
from fieldscribe.user_errors import UnclearError

__all__ = ["KINDS", "PORTS", "action", "chunk_of_text", "cutter", "hear", "packet"]

KINDS = (BYTES, STREAM)
PORTS = frozenset({502})
_LONGEST, _LONGEST_TCP, _LEAST_TCP = 256, 260, 8
_MOST_STREAMS = 2048
_COUNTED = frozenset(number for number, function in FUNCTIONS.items() if function.does == "write_many")
"""Functions whose requests say how long they are."""


class ModbusCutter:
    """Cuts the bytes of serial lines and of connections into frames."""

    def __init__(self) -> None:
        self._serial = ByteCutter(_size_at, _LONGEST, "rtu", 0)
        self._streams: OrderedDict[tuple[str, bool | None], bytes] = OrderedDict()

    def take(self, chunk: Chunk) -> Iterator[Cut]:
        """Return the frames that are complete with this chunk; RTU frames may travel in a connection, too."""
        if chunk.kind == BYTES:
            yield from self._serial.take(chunk)
            return
        key = chunk.place, chunk.sent
        data = (b"" if chunk.fresh else self._streams.pop(key, b"")) + chunk.data
        while len(data) >= _LEAST_TCP:
            size = 6 + int.from_bytes(data[4:6], "big")
            if data[2:4] != b"\0\0" or not _LEAST_TCP <= size <= _LONGEST_TCP:
                yield from self._without_header(chunk, data)
                data = b""
            elif len(data) < size:
                break
            else:
                yield _framed(chunk, data[:size])
                data = data[size:]
        if data:
            self._streams[key] = data
            if len(self._streams) > _MOST_STREAMS:
                self._streams.popitem(last=False)

    def rest(self) -> Iterator[Cut]:
        """Return what is left at the end."""
        yield from self._serial.rest()
        for (place, sent), data in self._streams.items():
            yield Cut(None, data, data, "tcp", None, place, None, sent)

    def _without_header(self, chunk: Chunk, data: bytes) -> Iterator[Cut]:
        if unwrap("rtu", data).flaw is None:
            yield Cut(chunk.time, data, data, "rtu", data[0], chunk.place, None, chunk.sent)
        else:
            yield Cut(chunk.time, data[:_LONGEST_TCP], data[:_LONGEST_TCP], "tcp", None, chunk.place, None, chunk.sent)


def _framed(chunk: Chunk, data: bytes) -> Cut:
    """Return a frame of a connection. Its number goes into the exchange, so that equal frames have equal bytes."""
    return Cut(chunk.time, b"\0\0" + data[2:], data, "tcp", data[6], chunk.place, data[:2], chunk.sent)


def _size_at(data: bytes, begins: bool) -> int:
    pdu = data[1:]
    if len(pdu) < 2:
        return -1
    sizes = {size + 3 for size in (request_length(pdu), reply_length(pdu)) if 0 < size <= _LONGEST - 3}
    for size in sorted(sizes, key=lambda size: (size != len(data), size)):
        if size <= len(data) and unwrap("rtu", data[:size]).flaw is None:
            return size
    if any(size > len(data) for size in sizes) or (len(pdu) < 6 and pdu[0] in _COUNTED):
        return -1
    return len(data) if begins and unwrap("rtu", data).flaw is None else 0


def cutter() -> ModbusCutter:
    """Return what cuts chunks into frames."""
    return ModbusCutter()


def chunk_of_text(text: str) -> Chunk:
    """Return the bytes in a line of a log, perhaps a frame of a network. Raises HexError for a line without any."""
    chunk = logged_bytes(text)
    if unwrap("rtu", chunk.data).flaw is None or unwrap("tcp", chunk.data).flaw is not None:
        return chunk
    return replace(chunk, kind=STREAM)


def hear(line: LineAddress) -> Iterator[Chunk]:
    """Yield what comes on a line. Raises UnclearError."""
    if line.scheme == "tcp":
        message = "a network does not bring what others say"
        raise UnclearError(message, "capture it where it passes, as with tcpdump -w FILE, and give --capture FILE")
    return serial_chunks(line, "8N1")


def action(result: FrameResult) -> str:
    """Return what an exchange does, in a word."""
    function = FUNCTIONS.get((result.function or 0) & 0x7F)
    return "function" if function is None else function.does.partition("_")[0]
