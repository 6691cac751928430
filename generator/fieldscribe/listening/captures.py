"""Opens captures of any kind: packets (pcap, pcapng), messages (BLF, ASC), or lines of text."""

import json
from collections.abc import Callable, Iterator
from io import SEEK_END, BufferedReader, TextIOWrapper
from typing import Any

from fieldscribe.diagnostics import UnclearError
from fieldscribe.listening.chunks import MESSAGE, Chunk, Packet
from fieldscribe.listening.packets import Packets, is_packet_file, read_packets

_LONGEST_LINE = 1 << 16
_ENOUGH = 1000
"""A file that starts with this many lines without a frame is no log."""


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
                raise UnclearError(*_NONE)
    if skipped and not has_frames:
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


_BLF, _ASC = b"LOGG", b"date"
"""The first bytes of such files."""


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
        for heard in reader:
            if not heard.is_error_frame:
                place = "" if heard.channel is None else f"can{heard.channel}"
                remote, identifier = heard.is_remote_frame, heard.arbitration_id
                yield Chunk(heard.timestamp, MESSAGE, bytes(heard.data), place, identifier=identifier, remote=remote)
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
