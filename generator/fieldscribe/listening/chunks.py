"""Chunks of bytes from a line, a log or a capture, and the frames in them.

On a serial line, only the length and the checksum of a frame show where it ends.
"""

import re
import time
from collections import OrderedDict
from collections.abc import Callable, Hashable, Iterator
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import Any, NamedTuple

from fieldscribe.diagnostics import UnclearError
from fieldscribe.live.lines import LineAddress
from fieldscribe.pasted_numbers import parse_hex

BYTES, STREAM, MESSAGE, SILENT = "bytes", "stream", "message", ""
"""The kind of a chunk: serial bytes, bytes of a network connection, a message with an identifier, or nothing."""


class Chunk(NamedTuple):
    """Bytes that arrived together; empty if nothing arrived for a while.

    `place` identifies the line or connection. `fresh`: bytes before these are lost. `sent`: whether they go to the
    device, if that is known. `identifier` is that of a message; `remote` messages only request data.
    """

    time: float | None
    kind: str
    data: bytes
    place: str = ""
    sent: bool | None = None
    fresh: bool = False
    identifier: int = 0
    remote: bool = False


class Cut(NamedTuple):
    """A frame: as its family's decoder takes it, and as bytes.

    `unit` is the unit that it is for or from, if the bytes alone show it. Only requests and answers with the same
    `exchange` belong together. `damaged`: the frame is invalid, so its content may be wrong.
    """

    time: float | None
    frame: Any
    data: bytes
    framing: str | None
    unit: int | None = None
    place: str = ""
    exchange: Hashable = None
    sent: bool | None = None
    damaged: bool = False


SERIAL, BUS_SOCKET = 147, 227
"""The link types of written captures: serial bytes (a type for private use), and SocketCAN messages."""


class Packet(NamedTuple):
    """A packet: its time, link type and bytes."""

    time: float | None
    link: int
    data: bytes


SILENCE = 0.1
"""The seconds of silence that end a frame; many times what any protocol requires."""
_MOST_LINES = 256

SizeAt = Callable[[bytes, bool], int]
"""Returns the size of the valid frame at the start of bytes; 0 if there is none, -1 if more bytes may complete one.

The second argument is True if a frame may start there, False within noise.
"""


@dataclass(slots=True)
class _Line:
    """The bytes that wait for more; the first `noise` bytes start no frame; times of the first and last byte."""

    waiting: bytes = b""
    noise: int = 0
    since: float | None = None
    last: float | None = None


class ByteCutter:
    """Splits the chunks of lines into frames; invalid bytes become damaged frames.

    `longest` is the size of the longest frame; the byte `unit_at` of a frame is its unit.
    """

    def __init__(self, size_at: SizeAt, longest: int, framing: str | None, unit_at: int) -> None:
        self._size_at, self._longest, self._framing, self._unit_at = size_at, longest, framing, unit_at
        self._lines: OrderedDict[str, _Line] = OrderedDict()

    def take(self, chunk: Chunk) -> Iterator[Cut]:
        """Return the frames that this chunk completes; a silence ends the frame before it."""
        line = self._lines.setdefault(chunk.place, _Line())
        self._lines.move_to_end(chunk.place)
        silent = chunk.time is not None and line.last is not None and not 0 <= chunk.time - line.last <= SILENCE
        if line.waiting and (silent or chunk.fresh or not chunk.data):
            yield from self._cut(chunk.place, line, ended=True)
        line.since, line.last = chunk.time if not line.waiting else line.since, chunk.time
        line.waiting += chunk.data
        yield from self._cut(chunk.place, line, ended=False)
        if len(self._lines) > _MOST_LINES:
            yield from self._cut(*self._lines.popitem(last=False), ended=True)

    def rest(self) -> Iterator[Cut]:
        """Return what is left on each line."""
        for place, line in self._lines.items():
            yield from self._cut(place, line, ended=True)

    def _cut(self, place: str, line: _Line, *, ended: bool) -> Iterator[Cut]:
        """Yield the frames in the waiting bytes. A valid frame after noise ends the wait for one before it."""
        data, at, start, wanting = line.waiting, line.noise, 0, -1
        while at < len(data):
            size = self._size_at(data[at : at + self._longest], at == start)
            if size > 0:
                yield from self._damaged(data[start:at], place, line)
                yield self._made(data[at : at + size], place, line)
                start = at = at + size
                wanting = -1
                continue
            if size < 0 and wanting < 0 and not ended and len(data) - at < self._longest:
                wanting = at
                if at == start:
                    break
            at += 1
        if ended:
            yield from self._damaged(data[start:], place, line)
            start = at = len(data)
        at = wanting if wanting >= 0 else at
        if at - start > self._longest:
            yield from self._damaged(data[start:at], place, line)
            start = at
        line.waiting, line.noise = data[start:], at - start

    def _damaged(self, data: bytes, place: str, line: _Line) -> Iterator[Cut]:
        if data:
            yield self._made(data[: self._longest], place, line, damaged=True)

    def _made(self, data: bytes, place: str, line: _Line, *, damaged: bool = False) -> Cut:
        unit = data[self._unit_at] if len(data) > self._unit_at else None
        time, line.since = line.since, line.last
        return Cut(time, data, data, self._framing, unit, place, damaged=damaged)


def packet(cut: Cut) -> Packet:
    """Return a frame of a serial line as a packet of a capture."""
    return Packet(cut.time, SERIAL, cut.data)


def serial_chunks(line: LineAddress, mode: str) -> Iterator[Chunk]:
    """Yield chunks from a serial line, or through a socket; a silence is a chunk too.

    `mode` is the usual form of a byte, such as 8N1. Raises UnclearError if the line cannot be opened, or is lost.
    """
    try:
        import serial
    except ModuleNotFoundError as error:
        raise UnclearError(f"{line.scheme}://: {error}", "pip install 'fieldscribe[live]'") from error
    through_socket = line.scheme.endswith("+tcp")
    settings = line.serial(mode)
    host, port = line.host_and_port(None) if through_socket else ("", 0)
    bits, parity, stop = settings["mode"]
    try:
        opened = serial.serial_for_url(
            f"socket://{host}:{port}" if through_socket else settings["port"],
            settings["baudrate"],
            bytesize=int(bits),
            parity=parity,
            stopbits=int(stop),
            timeout=SILENCE,
        )
    except (OSError, ValueError) as error:
        raise line.wrong(f"it cannot be opened: {error}") from error
    with opened:
        while True:
            try:
                data = opened.read(opened.in_waiting or 1)
            except OSError as error:
                raise line.wrong(f"it went away: {error}") from error
            yield Chunk(time.time(), BYTES, data)


_TIME = re.compile(
    r"[\[(]?(?:(?P<date>\d{4}-\d\d-\d\d)[T ])?(?P<hour>\d{1,2}):(?P<minute>\d\d):(?P<second>\d\d(?:[.,]\d{1,9})?)"
    r"(?:Z|[+-]\d\d:?\d\d)?[\])]?[\s:;,]+|[\[(]?(?P<epoch>\d{1,12}[.,]\d{1,9})[\])]?[\s:;,]+"
)
_WAYS = re.compile(r"(?:(?:TX|RX|REQ|RES|SENT|RECV|SEND|REQUEST|RESPONSE|REPLY|<-|->|<<|>>|<|>)[\s:]*)+", re.IGNORECASE)


def timed(text: str) -> tuple[float | None, str]:
    """Return the time at the beginning of a line, in seconds, and the rest of the line."""
    match = _TIME.match(text)
    if match is None:
        return None, text
    rest = text[match.end() :]
    if match["epoch"]:
        return float(match["epoch"].replace(",", ".")), rest
    seconds = int(match["hour"]) * 3600 + int(match["minute"]) * 60 + float(match["second"].replace(",", "."))
    if match["date"] is None:
        return seconds, rest
    try:
        day = datetime.strptime(match["date"], "%Y-%m-%d").replace(tzinfo=UTC)
    except ValueError:
        return seconds, rest
    return day.timestamp() + seconds, rest


def logged_bytes(text: str) -> Chunk:
    """Return the bytes in a line of a log. Raises HexError for a line without any."""
    time, rest = timed(text)
    way = _WAYS.match(rest)
    return Chunk(time, BYTES, parse_hex(rest[way.end() :] if way else rest))
