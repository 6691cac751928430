# SPDX-License-Identifier: 0BSD
"""A serial line, by pyserial: Modbus RTU and USS.

    from fieldscribe_runtime.transports.serial import SerialLine

    with SerialLine("/dev/ttyUSB0", 9600) as line:
        drive = HitachiL200(line, unit=1)

Bytes received before a request are dropped, and so are frames of other units. A late reply is not taken for the next
one: after a failure, the next request to the same unit waits until `timeout` has passed once more, requests to other
units do not wait, and a port that leads through a network is reopened.
"""

from __future__ import annotations

import os
import re
import time
from typing import TYPE_CHECKING, Any

from ..arguments import shown
from ..errors import RequestError
from ..modbus.frames import RTU
from ..receiving import Broadcast
from ..uss.frames import USS
from . import checks
from .line import Line
from .tcp import PIECE, Connection

try:
    import serial
except ModuleNotFoundError as missing:
    hint = "this needs pyserial: pip install pyserial"
    raise ModuleNotFoundError(hint, name=missing.name) from None

if TYPE_CHECKING:
    from typing import Self

_BITS = 11
"""The bits of a character with start, parity and stop bit."""
_MODE = re.compile("[78][NEO][12]")
_SLICE = 0.02
"""The seconds that one call of pyserial waits, so that deadlines are kept."""
_SILENCE = 3.5
"""Characters of silence between two frames."""
_PORT = "a device such as '/dev/ttyUSB0' or 'COM3', or a URL such as 'socket://192.168.0.20:4001'"
_OF_NETWORK = re.compile("socket://|rfc2217://")
_WITH_PORT = re.compile(r":\d+(?=[/?]|$)")
_SOCKET = re.compile(r"socket://\[?([^/?\]]+)\]?:(\d+)/?")
_CONNECT = 5.0
"""The most seconds to open a connection."""
_FASTEST = 10_000_000
_OF_PSEUDO_TERMINALS = {"bytesize": 8, "parity": "N"}
"""A pseudo terminal carries whole bytes, and refuses other settings."""


class _Port:
    """A port of pyserial, with the methods of a `Connection`."""

    def __init__(self, url: str, settings: dict[str, Any]) -> None:
        if os.path.realpath(url).startswith("/dev/pts/"):
            settings = settings | _OF_PSEUDO_TERMINALS
        try:
            self._serial: Any = serial.serial_for_url(url, **settings)
        except (OSError, ValueError, TypeError):
            raise
        except Exception as error:  # of settings that a port does not take, pyserial lets termios.error through
            raise OSError(f"{url} cannot be set as the line needs it: {error}") from error

    def drop_old(self) -> None:
        """Drop received bytes; raises OSError."""
        try:
            self._serial.reset_input_buffer()
        except Exception as error:  # of an adapter that is gone, pyserial lets termios.error through: no OSError
            raise OSError(*error.args) from error

    def send(self, request: bytes) -> None:
        """Send a frame; raises OSError."""
        self._serial.write(request)
        self._serial.flush()

    def read(self, most: int, until: float) -> bytes:
        """Return up to `most` received bytes; none if none arrives in time."""
        while time.monotonic() < until:
            received: bytes = self._serial.read(most)
            if received:
                return received
        return b""

    def close(self) -> None:
        """Close the port."""
        self._serial.close()


class SerialLine(Line):
    """A serial line with Modbus RTU: opened on first use, and again after a failure of the port.

    `port` is a device, or a URL of pyserial such as `socket://192.168.0.20:4001` for RTU over a serial server. `mode`
    is data bits, parity (N, E, O) and stop bits. A reply must start within `timeout` seconds, and then has the time of
    the longest frame at the baud rate. With `echo`, the line first receives what it sends, as on many RS-485 adapters
    with two wires.
    """

    FRAMING = RTU
    MODE = "8N1"

    turnaround = 0.1
    """The seconds of rest after a broadcast, so that the units can carry it out. Set it to what they need."""

    def __init__(
        self, port: str, baudrate: int = 9600, mode: str = "", *, timeout: float = 0.5, echo: bool = False
    ) -> None:
        super().__init__(self.FRAMING, checks.seconds(timeout))
        self.port, self.echo, mode = checks.text("a port", _PORT, port), echo, mode or self.MODE
        if _OF_NETWORK.match(port) and not _WITH_PORT.search(port):
            checks.refuse("a port", _PORT, port)
        if not isinstance(mode, str) or not _MODE.fullmatch(mode):
            raise RequestError("bad_mode", f"a mode is data bits, parity and stop bits, as in 8E1, not {shown(mode)}")
        self._mode = mode
        self._settings: dict[str, Any] = {
            "baudrate": checks.number("a baud rate", baudrate, (1, _FASTEST)),
            "bytesize": int(mode[0]),
            "parity": mode[1],
            "stopbits": int(mode[2]),
            "timeout": min(self.timeout, _SLICE),
        }
        self._is_network = _OF_NETWORK.match(port) is not None
        self._socket = _SOCKET.fullmatch(port)
        self._silence = 0.0 if self._is_network else max(_SILENCE * _BITS / baudrate, 0.00175)
        self.FRAME_SECONDS = self._framing.longest * _BITS / baudrate
        self._rests_until = 0.0
        self._late: tuple[int | bytes, float] | None = None
        """The unit whose reply may still arrive, and until when."""
        self._open: _Port | Connection | None = None

    def __str__(self) -> str:
        return f"{self.port} at {self._settings['baudrate']} baud, {self._mode}"

    def _send(self, request: bytes) -> None:
        if self._open is None:
            self._open = self._opened()
        self._rest(request)
        self._open.drop_old()
        self._open.send(request)
        if self.echo and self._echoed(len(request)) != request:
            raise TimeoutError("what was sent was not heard: another speaks, or the adapter gives no echo")

    def _rest(self, request: bytes) -> None:
        """Wait until the line is free: silent, after a broadcast, and after a late reply of this unit."""
        now = time.monotonic()
        free = max(self._rests_until, now + self._silence)
        if self._late is not None and self._late[0] == self._framing.address(request):
            free = max(free, self._late[1])
            self._late = None
        if free > now:
            time.sleep(free - now)

    def _echoed(self, size: int) -> bytes:
        assert self._open is not None
        until, echoed = time.monotonic() + self.timeout, b""
        while len(echoed) < size and (more := self._open.read(size - len(echoed), until)):
            echoed += more
        return echoed

    def _opened(self) -> _Port | Connection:
        if self._socket is not None:
            return Connection(self._socket[1], int(self._socket[2]), _CONNECT)
        try:
            return _Port(self.port, self._settings)
        except (ValueError, TypeError) as error:  # an unknown or incomplete URL
            raise RequestError("bad_transport", f"{error}; a port is {_PORT}") from error

    def _read(self, most: int, until: float) -> bytes:
        assert self._open is not None
        return self._open.read(most if self._socket is None else PIECE, until)  # pyserial waits for all

    def _after_broadcast(self) -> bytes:
        self._rests_until = time.monotonic() + self.turnaround
        return b""

    def _failed(self, request: bytes) -> None:
        if self._is_network:
            self.close()  # an answer that a network delays is lost
        elif not isinstance(request, Broadcast):
            self._late = self._framing.address(request), time.monotonic() + self.timeout

    def close(self) -> None:
        """Close the port; the next exchange opens it again."""
        if self._open is not None:
            self._open.close()
            self._open = None


class UssLine(SerialLine):
    """The same for USS, with even parity by default."""

    FRAMING = USS
    MODE = "8E1"


class AsyncSerialLine:
    """A serial line for async devices, which waits in a thread: `AsyncSerialLine(SerialLine(...))`."""

    def __init__(self, line: SerialLine) -> None:
        if not isinstance(line, SerialLine):
            checks.refuse("the line", "a SerialLine, as in AsyncSerialLine(SerialLine('/dev/ttyUSB0', 9600))", line)
        self.line, self.framing = line, line.framing

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.line}>"

    async def exchange(self, request: bytes) -> bytes:
        """Send a frame and return the whole reply; raises TimeoutError, LineError and FrameError."""
        import asyncio  # only async programs need it

        return await asyncio.to_thread(self.line.exchange, request)

    async def __aenter__(self) -> Self:
        return self

    async def __aexit__(self, *_: object) -> None:
        self.line.close()
