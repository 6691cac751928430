# SPDX-License-Identifier: 0BSD
"""A Modbus device or gateway in a network, through a plain socket: nothing to install.

    from fieldscribe_runtime.transports.tcp import TcpLine

    with TcpLine("192.168.0.20") as line:
        drive = HitachiL200(line, unit=1)

Bytes received before a request are dropped, and the line reconnects after a failure: a late or repeated reply is not
taken for the next one.
"""

from __future__ import annotations

import select
import socket
import time
from typing import TYPE_CHECKING

from ..errors import LineError
from ..modbus.frames import TCP
from ..receiving import Broadcast, Receiver, Reply
from ..turns import Turns
from . import checks
from .line import Line, framing_of

if TYPE_CHECKING:
    import asyncio
    from collections.abc import Callable
    from typing import Self

MODBUS_PORT = 502
_OLD = 16
"""The most pieces of old bytes to read before the connection is given up."""
PIECE = 4096
"""The most bytes to read at once."""
_CLOSED = "the other side closed the connection"


def _poll(made: socket.socket) -> Callable[[float], object]:
    """Return a function that waits for bytes of a socket; its result is true if there are any."""
    if not hasattr(select, "poll"):  # Windows
        return lambda milliseconds: select.select([made], [], [], milliseconds / 1000)[0]
    poll = select.poll()
    poll.register(made, select.POLLIN)
    return poll.poll


class Connection:
    """The address of a line, and its socket while it is open. It must open within `timeout` seconds."""

    def __init__(self, host: str, port: int, timeout: float) -> None:
        takes = "a name or an address such as '192.168.0.20'"
        self.host = checks.text("the host", takes, host)
        if host.count(":") == 1:
            checks.refuse("the host", f"{takes}, and the port another argument", host)
        self.port = checks.number("the port", port, (1, 65535))
        self.timeout = checks.seconds(timeout)
        self.socket: socket.socket | None = None
        self._has_bytes: Callable[[float], object] = bool
        """Waits until there is something to receive, or the end, for at most this many milliseconds."""

    def __str__(self) -> str:
        return f"{self.host}:{self.port}"

    def drop_old(self) -> None:
        """Drop received bytes; close a connection that the other side has closed or floods."""
        left = _OLD
        while self.socket is not None and self._has_bytes(0):
            left -= 1
            try:
                is_open = self.socket.recv(PIECE) != b""
            except ConnectionError:
                is_open = False
            if not is_open or left <= 0:
                self.close()

    def send(self, request: bytes) -> None:
        """Send a frame, over a new connection if there is none; raises OSError."""
        if self.socket is None:
            try:
                self.opened(socket.create_connection((self.host, self.port), self.timeout))
            except TimeoutError as error:
                raise self.no_connection() from error
        assert self.socket is not None
        self.socket.sendall(request)

    def no_connection(self) -> ConnectionError:
        """Return the error for a connection that does not open in time."""
        return ConnectionError(f"no connection within {self.timeout:g} s")

    def read(self, most: int, until: float) -> bytes:
        """Return up to `most` received bytes; none if none arrives in time. Raises OSError."""
        assert self.socket is not None
        left = until - time.monotonic()
        if left <= 0 or not self._has_bytes(left * 1000):
            return b""
        if not (received := self.socket.recv(most)):
            raise ConnectionError(_CLOSED)
        return received

    def opened(self, made: socket.socket) -> socket.socket:
        """Keep a socket that is connected."""
        made.setblocking(False)
        made.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._has_bytes = _poll(made)
        self.socket = made
        return made

    def close(self) -> None:
        """Close the connection."""
        if self.socket is not None:
            self.socket.close()
            self.socket = None


class TcpLine(Line):
    """Connects on first use, and again after a failure. `framing="rtu"` is for RTU frames over TCP.

    A whole exchange may take `timeout` seconds.
    """

    def __init__(self, host: str, port: int = MODBUS_PORT, *, framing: str = TCP, timeout: float = 1.0) -> None:
        super().__init__(framing, checks.seconds(timeout))
        self._connection = Connection(host, port, timeout)

    def __str__(self) -> str:
        return str(self._connection)

    def _send(self, request: bytes) -> None:
        self._connection.drop_old()
        self._connection.send(request)

    def _read(self, most: int, until: float) -> bytes:
        del most  # bytes after a reply are dropped before the next request
        return self._connection.read(PIECE, until)

    def _failed(self, request: bytes) -> None:
        del request
        self.close()  # a late answer is lost

    def close(self) -> None:
        """Close the connection; the next exchange opens it again."""
        self._connection.close()


class AsyncTcpLine:
    """The same for async devices, in one event loop at a time; a whole exchange may take `timeout` seconds."""

    def __init__(self, host: str, port: int = MODBUS_PORT, *, framing: str = TCP, timeout: float = 1.0) -> None:
        self.framing = framing
        self._framing = framing_of(framing)
        self._connection = Connection(host, port, timeout)
        self._turns = Turns("the line")

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self._connection}, {self.framing}>"

    async def exchange(self, request: bytes) -> bytes:
        """Send a frame and return the whole reply, or no bytes at once after a Broadcast.

        Raises TimeoutError, LineError and FrameError.
        """
        import asyncio  # only async programs need it

        async with self._turns.lock():
            loop = asyncio.get_running_loop()
            receiver, is_sent = Receiver(self._framing, request), False
            try:
                async with asyncio.timeout(self._connection.timeout):
                    await asyncio.sleep(0)  # other tasks, and timeouts, get their turn even if all bytes are there
                    line = await self._send(request, loop)
                    is_sent = True
                    return b"" if isinstance(request, Broadcast) else await self._received(line, receiver, loop)
            except TimeoutError:
                is_open = self._connection.socket is not None
                self.close()
                if is_open:
                    return receiver.give_up()
                text = f"{self._connection}: {self._connection.no_connection()}"
                raise LineError(text, unsent=True) from None
            except OSError as error:
                self.close()
                raise LineError(f"{self._connection}: {error.strerror or error}", unsent=not is_sent) from error
            except BaseException:
                self.close()  # also when the task is cancelled: the answer must not reach the next request
                raise

    async def _send(self, request: bytes, loop: asyncio.AbstractEventLoop) -> socket.socket:
        self._connection.drop_old()
        line = self._connection.socket or await self._connected(loop)
        await loop.sock_sendall(line, request)
        return line

    async def _received(self, line: socket.socket, receiver: Receiver, loop: asyncio.AbstractEventLoop) -> bytes:
        since = time.monotonic()
        while data := await loop.sock_recv(line, PIECE):
            if (reply := receiver.take(data)) is not None:
                return Reply.timed(reply, since)
        raise ConnectionError(_CLOSED)

    async def _connected(self, loop: asyncio.AbstractEventLoop) -> socket.socket:
        """Return a connection to the first address of the host that answers."""
        to = self._connection
        failure = OSError("the host has no address")
        for family, kind, protocol, _, address in await loop.getaddrinfo(to.host, to.port, type=socket.SOCK_STREAM):
            made = socket.socket(family, kind, protocol)
            made.setblocking(False)
            try:
                await loop.sock_connect(made, address)
            except OSError as error:
                made.close()
                failure = error
            except BaseException:
                made.close()
                raise
            else:
                return to.opened(made)
        raise failure

    def close(self) -> None:
        """Close the connection; the next exchange opens it again."""
        self._connection.close()

    async def __aenter__(self) -> Self:
        return self

    async def __aexit__(self, *_: object) -> None:
        self.close()
