# SPDX-License-Identifier: 0BSD
"""A Modbus device, or a gateway to several, in a network: a plain socket, nothing to install.

from fieldscribe_runtime.transports.tcp import TcpLine

with TcpLine("192.168.0.20") as line:
drive = HitachiL200(line, unit=1)
"""

from __future__ import annotations

import asyncio
import socket
from typing import TYPE_CHECKING

from ..errors import LineError
from ..modbus.frames import TCP
from .line import Line, size_of_reply

if TYPE_CHECKING:
    from typing import Self

MODBUS_PORT = 502
_CLOSED = "the other side closed the connection"


class TcpLine(Line):
    """Connects when it is used first, and anew after a failure. `framing="rtu"` is for RTU frames over TCP."""

    def __init__(self, host: str, port: int = MODBUS_PORT, *, framing: str = TCP, timeout: float = 1.0) -> None:
        super().__init__(framing)
        self.host, self.port, self.timeout = host, port, timeout
        self._socket: socket.socket | None = None

    def __str__(self) -> str:
        return f"{self.host}:{self.port}"

    def _send(self, request: bytes) -> None:
        if self._socket is None:
            self._socket = socket.create_connection((self.host, self.port), self.timeout)
            self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._socket.sendall(request)

    def _read(self, most: int) -> bytes:
        assert self._socket is not None
        received = self._socket.recv(most)
        if not received:
            raise ConnectionError(_CLOSED)
        return received

    def _failed(self) -> None:
        self.close()  # an answer that comes too late comes to nobody

    def close(self) -> None:
        """Close the connection."""
        if self._socket is not None:
            self._socket.close()
            self._socket = None


class AsyncTcpLine:
    """The same for async devices."""

    def __init__(self, host: str, port: int = MODBUS_PORT, *, framing: str = TCP, timeout: float = 1.0) -> None:
        self.host, self.port, self.framing, self.timeout = host, port, framing, timeout
        self._size = size_of_reply(framing)
        self._turn = asyncio.Lock()
        self._streams: tuple[asyncio.StreamReader, asyncio.StreamWriter] | None = None

    def __repr__(self) -> str:
        return f"<AsyncTcpLine {self.host}:{self.port}>"

    async def exchange(self, request: bytes) -> bytes:
        """Send a frame and return the whole reply; raises TimeoutError, LineError and FrameError."""
        async with self._turn:
            try:
                async with asyncio.timeout(self.timeout):
                    return await self._exchanged(request)
            except OSError as error:
                self.close()
                if isinstance(error, TimeoutError):
                    raise
                raise LineError(f"{self.host}:{self.port}: {error.strerror or error}") from error
            except BaseException:
                self.close()  # also when the task is cancelled: the answer must not come to the next one
                raise

    async def _exchanged(self, request: bytes) -> bytes:
        if self._streams is None:
            self._streams = await asyncio.open_connection(self.host, self.port)
        reader, writer = self._streams
        writer.write(request)
        await writer.drain()
        received = b""
        while (size := self._size(received)) is None or len(received) < size:
            more = await reader.read(1 if size is None else size - len(received))
            if not more:
                raise ConnectionError(_CLOSED)
            received += more
        return received

    def close(self) -> None:
        """Close the connection; the next exchange opens it again."""
        if self._streams is not None:
            self._streams[1].close()
            self._streams = None

    async def __aenter__(self) -> Self:
        return self

    async def __aexit__(self, *_: object) -> None:
        self.close()
