"""Opens captures, whatever they are: packets (pcap, pcapng), messages (BLF, ASC), or lines of text."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from io import BufferedReader

from fieldscribe.listening.bus_files import bus_chunks, is_bus_file
from fieldscribe.listening.chunks import Chunk
from fieldscribe.listening.packet_files import Packet, is_packet_file, read_packets
from fieldscribe.listening.packets import Packets
from fieldscribe.user_errors import UnclearError

_LONGEST_LINE = 1 << 16
_ENOUGH = 1000
"""The lines without a frame at the beginning after which a file is no log."""


def chunks_of(
    stream: BufferedReader,
    ports: frozenset[int],
    chunk_of: Callable[[str], Chunk | None],
    each: Callable[[Packet], None] | None = None,
) -> Iterator[Chunk]:
    """Yield the chunks of a capture; `each` gets every packet, `chunk_of` reads a line of text (None: it has none).

    Raises UnclearError where a capture is cut off, lies, or is none.
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
    read = skipped = 0
    while line := stream.readline(_LONGEST_LINE):
        text = line.decode("utf-8-sig", "replace").strip()
        chunks = [chunk for frame in _frames_in(text) if (chunk := chunk_of(frame)) is not None]
        if chunks:
            read += 1
            yield from chunks
        elif text:
            skipped += 1
            if skipped == _ENOUGH and not read:
                raise UnclearError(*_NONE)
    if skipped and not read:
        raise UnclearError(*_NONE)


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


_NONE = (
    "it has no frame",
    "captures are pcap, pcapng, BLF, ASC, logs of candump, traces of `simulate`, lines of hexadecimal bytes with times",
)
