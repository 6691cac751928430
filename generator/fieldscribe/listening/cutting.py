"""Cuts the bytes of serial lines into frames, where only their length and their check tell where a frame ends."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from fieldscribe.listening.chunks import Chunk, Cut
from fieldscribe.listening.packet_files import SERIAL, Packet

SILENCE = 0.1
"""The seconds without a byte after which a frame is at its end; many times what any protocol asks for."""
_MOST_LINES = 256

SizeAt = Callable[[bytes, bool], int]
"""Returns the size of the sound frame at the beginning of bytes; 0 if there is none, -1 if more bytes may make one.

The second argument is True where a frame may begin, False within noise.
"""


@dataclass(slots=True)
class _Line:
    """The bytes that wait for more, of which the first ones (`noise`) begin no frame; when they and the last came."""

    waiting: bytes = b""
    noise: int = 0
    since: float | None = None
    last: float | None = None


class ByteCutter:
    """Cuts the chunks of lines into frames; what is no sound frame comes as a damaged one.

    `longest` is the size of the longest frame; the byte `unit_at` of a frame is its unit.
    """

    def __init__(self, size_at: SizeAt, longest: int, framing: str | None, unit_at: int) -> None:
        self._size_at, self._longest, self._framing, self._unit_at = size_at, longest, framing, unit_at
        self._lines: OrderedDict[str, _Line] = OrderedDict()

    def take(self, chunk: Chunk) -> Iterator[Cut]:
        """Return the frames that are complete with this chunk; a silence ends the frame before it."""
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
        """Yield the frames in what waits. Behind noise, a sound frame ends the wait for one before it."""
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
