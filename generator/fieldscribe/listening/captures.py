"""Opens captures, whatever they are: packets (pcap, pcapng), or lines of text."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from io import BufferedReader

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
    read = skipped = 0
    while line := stream.readline(_LONGEST_LINE):
        text = line.decode("utf-8-sig", "replace").strip()
        chunk = chunk_of(text) if text else None
        if chunk is not None:
            read += 1
            yield chunk
        elif text:
            skipped += 1
            if skipped == _ENOUGH and not read:
                raise UnclearError(*_NONE)
    if skipped and not read:
        raise UnclearError(*_NONE)


_NONE = "it has no frame", "captures are pcap, pcapng, logs of candump, and lines of hexadecimal bytes with times"
