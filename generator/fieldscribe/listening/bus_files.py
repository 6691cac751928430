"""Reads captures of CAN tools, BLF and ASC, with the readers of python-can."""

from __future__ import annotations

from collections.abc import Iterator
from io import SEEK_END, BufferedReader, TextIOWrapper
from typing import Any

from fieldscribe.listening.chunks import MESSAGE, Chunk
from fieldscribe.user_errors import UnclearError

_BLF, _ASC = b"LOGG", b"date"
"""How such files begin."""


def is_bus_file(start: bytes) -> bool:
    """Return True if a file begins as BLF or ASC."""
    return start[:4] == _BLF or start[:4].lower() == _ASC


def bus_chunks(stream: BufferedReader) -> Iterator[Chunk]:
    """Yield the messages of a capture. Raises UnclearError without python-can, and where the file is damaged."""
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
    except Exception as error:  # the readers raise whatever a damaged file leads to
        raise UnclearError(f"it is no whole {'BLF' if is_blf else 'ASC'} file: {error}") from error
    if size is not None and is_blf and reader.file_size > size:  # its reader ends there without a word
        raise UnclearError(f"it is no whole BLF file: it has {size} of {reader.file_size} bytes")


def _asc(stream: BufferedReader) -> Any:
    from can import ASCReader

    return ASCReader(TextIOWrapper(stream, "utf-8", "replace"), relative_timestamp=False)


def _size(stream: BufferedReader) -> int | None:
    """Return the bytes of a file; None of what is no file."""
    if not stream.seekable():
        return None
    size = stream.seek(0, SEEK_END)
    stream.seek(0)
    return size
