"""Listens on a serial line, without sending anything."""

from __future__ import annotations

import time
from collections.abc import Iterator

from fieldscribe.listening.chunks import BYTES, Chunk
from fieldscribe.listening.cutting import SILENCE
from fieldscribe.live.lines import LineAddress
from fieldscribe.user_errors import UnclearError


def serial_chunks(line: LineAddress, mode: str) -> Iterator[Chunk]:
    """Yield what comes on a serial line, or through a socket; nothing for a while is a chunk, too.

    `mode` is the usual form of a byte, such as 8N1. Raises UnclearError for a line that cannot be opened, or went away.
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
