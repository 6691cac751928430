"""Lines in the world: TCP ports, serial ports and pseudo terminals, CAN buses; all in one event loop."""

from __future__ import annotations

import asyncio
import errno
import os
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from fieldscribe.simulation.faults import Outcome
from fieldscribe.simulation.line import Line, Stream
from fieldscribe.user_errors import UnclearError

if TYPE_CHECKING:
    import can

LOOPBACK = "127.0.0.1"
_QUIET = 0.02
"""Real seconds without a byte after which a request is not completed any more."""
_MOST_PENDING = 1000
"""Answers that may wait for their time; meanwhile nothing more is read."""
_EXTENDED = 1 << 31


class Server:
    """A line that is served at `url`; `close` ends that. `ended` is set when the line ends by itself."""

    def __init__(self, url: str, close: Callable[[], None], ended: asyncio.Event | None = None) -> None:
        self.url = url
        self.port = 0
        self.path = ""
        self.close = close
        self.ended = ended or asyncio.Event()


class _End(asyncio.Protocol):
    """One connection: bytes in, answers out, each in its time and none before an earlier one."""

    def __init__(self, line: Line, ends: set[_End]) -> None:
        self._loop = asyncio.get_running_loop()
        self._stream = Stream(line)
        self._ends = ends
        self._transport: Any = None
        self._timer: asyncio.TimerHandle | None = None
        self._free = 0.0
        self._pending = 0

    def connection_made(self, transport: Any) -> None:
        """Begin."""
        self._transport = transport
        self._ends.add(self)

    def connection_lost(self, exc: Exception | None) -> None:
        """End: what waits is dropped."""
        self._transport = None
        self._ends.discard(self)
        if self._timer is not None:
            self._timer.cancel()

    def data_received(self, data: bytes) -> None:
        """Answer what has come."""
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None
        for outcome in self._stream.received(data):
            self._send(outcome)
        if self._stream.waiting:
            self._timer = self._loop.call_later(_QUIET, self._quiet)

    def pause_writing(self) -> None:
        """Read no more while the other end does not take its answers."""
        self._transport.pause_reading()

    def resume_writing(self) -> None:
        """Read again."""
        self._transport.resume_reading()

    def close(self) -> None:
        """Break the connection."""
        if self._transport is not None:
            self._transport.close()

    def _quiet(self) -> None:
        self._timer = None
        for outcome in self._stream.received(b"", quiet=True):
            self._send(outcome)

    def _send(self, outcome: Outcome) -> None:
        delay = self._stream.line.clock.real(outcome.delay) if outcome.delay else 0.0
        if not delay and not self._pending:
            self._write(outcome)
            return
        self._free = max(self._free, self._loop.time() + delay)
        self._pending += 1
        self._loop.call_at(self._free, self._write_pending, outcome)
        if self._pending == _MOST_PENDING and self._transport is not None:
            self._transport.pause_reading()

    def _write_pending(self, outcome: Outcome) -> None:
        if self._pending == _MOST_PENDING and self._transport is not None:
            self._transport.resume_reading()
        self._pending -= 1
        self._write(outcome)

    def _write(self, outcome: Outcome) -> None:
        if self._transport is None:
            return
        if outcome.data:
            self._transport.write(outcome.data)
        if outcome.drop:
            self._transport.close()


async def serve_tcp(line: Line, host: str = LOOPBACK, port: int = 0) -> Server:
    """Serve a line at a TCP port; 0 chooses a free one. Raises UnclearError if the port cannot be had."""
    ends: set[_End] = set()
    try:
        listening = await asyncio.get_running_loop().create_server(lambda: _End(line, ends), host, port)
    except OSError as error:
        taken = error.errno == errno.EADDRINUSE
        reason = "it is taken" if taken else error.strerror or str(error)
        hint = "give another port, or 0 for any free one" if taken else "give an address of this machine and a port"
        raise UnclearError(f"port {port} of {host} cannot be served: {reason}", hint) from None

    def close() -> None:
        listening.close()
        for end in list(ends):
            end.close()

    port = listening.sockets[0].getsockname()[1]
    server = Server(f"tcp://{f'[{host}]' if ':' in host else host}:{port}", close)
    server.port = port
    return server


async def serve_serial(line: Line, path: str = "", baud: int = 0) -> Server:
    """Serve a line at a serial port, or at a new pseudo terminal without a path. Raises UnclearError."""
    import tty  # POSIX only, as pseudo terminals are

    spare = -1
    if path:
        own = _opened(path, baud)
    else:
        own, spare = os.openpty()  # the spare end stays open, so that clients may come and go
        tty.setraw(spare)
        os.set_blocking(own, False)
        path = os.ttyname(spare)
    ended = asyncio.Event()
    server = Server(path, _Port(own, spare, _End(line, set()), ended.set).close, ended)
    server.path = path
    return server


def _opened(path: str, baud: int) -> int:
    import termios
    import tty

    try:
        port = os.open(path, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
    except OSError as error:
        hint = "name a serial port or a pseudo terminal; without a name a new pseudo terminal is made"
        raise UnclearError(f"`{path}` cannot be opened: {error.strerror}", hint) from None
    try:
        tty.setraw(port)
        if baud:
            settings = termios.tcgetattr(port)
            settings[4] = settings[5] = getattr(termios, f"B{baud}")
            termios.tcsetattr(port, termios.TCSANOW, settings)
    except AttributeError:
        os.close(port)
        raise UnclearError(f"this machine has no speed of {baud} baud", "give a usual one, such as 9600") from None
    except termios.error:
        os.close(port)
        raise UnclearError(f"`{path}` is no serial port", "name a serial port or a pseudo terminal") from None
    return port


class _Port:
    """A transport over a file descriptor."""

    def __init__(self, own: int, spare: int, end: _End, ended: Callable[[], object]) -> None:
        self._loop = asyncio.get_running_loop()
        self._own, self._spare, self._end, self._ended = own, spare, end, ended
        self._waiting = b""
        end.connection_made(self)
        self.resume_reading()

    def write(self, data: bytes) -> None:
        """Send bytes, now or when the port takes them."""
        self._waiting += data
        self._flush()

    def close(self) -> None:
        """Close the port, and drop what waits."""
        if self._own < 0:
            return
        self._loop.remove_reader(self._own)
        self._loop.remove_writer(self._own)
        for descriptor in (self._own, self._spare):
            if descriptor >= 0:
                os.close(descriptor)
        self._own = -1
        self._end.connection_lost(None)
        self._ended()

    def pause_reading(self) -> None:
        """Read no more for now."""
        self._loop.remove_reader(self._own)

    def resume_reading(self) -> None:
        """Read again."""
        self._loop.add_reader(self._own, self._read)

    def _read(self) -> None:
        try:
            data = os.read(self._own, 4096)
        except BlockingIOError:
            return
        except OSError:
            data = b""
        if data:
            self._end.data_received(data)
        else:
            self.close()

    def _flush(self) -> None:
        try:
            sent = os.write(self._own, self._waiting) if self._waiting else 0
        except BlockingIOError:
            sent = 0
        except OSError:
            self.close()
            return
        full, self._waiting = bool(self._waiting), self._waiting[sent:]
        if self._waiting:
            self._loop.add_writer(self._own, self._flush)
            self.pause_reading()
        elif full:
            self._loop.remove_writer(self._own)
            self.resume_reading()


async def serve_can(line: Line, interface: str, channel: str, bitrate: int | None = None) -> Server:
    """Serve a line at a CAN bus, as python-can names it. Raises UnclearError."""
    try:
        import can
    except ModuleNotFoundError:
        raise UnclearError("CAN needs python-can", "pip install python-can") from None
    options: dict[str, Any] = {} if bitrate is None else {"bitrate": bitrate}
    try:
        bus = can.Bus(channel, interface=interface, **options)
    except Exception as error:  # each interface raises errors of its own
        hint = "name it as python-can does: `socketcan:can0`, `slcan:/dev/ttyUSB0`"
        raise UnclearError(f"the bus `{interface}:{channel}` cannot be opened: {str(error)[:200]}", hint) from None
    end = _CanEnd(line, bus)
    return Server(f"can://{interface}/{channel}", end.close)


class _CanEnd:
    """A bus: frames in, answers out, and what the devices send unasked."""

    def __init__(self, line: Line, bus: can.BusABC) -> None:
        import can

        self._line, self._bus = line, bus
        self._loop = asyncio.get_running_loop()
        self._notifier = can.Notifier(bus, [self._received], loop=self._loop)
        self._timer: asyncio.TimerHandle | None = None
        self._unasked()

    def close(self) -> None:
        """Leave the bus."""
        if self._timer is not None:
            self._timer.cancel()
        self._notifier.stop(0.5)
        self._bus.shutdown()

    def _received(self, message: can.Message) -> None:
        if message.is_error_frame or message.is_remote_frame:
            return
        identifier = message.arbitration_id | (_EXTENDED if message.is_extended_id else 0)
        for outcome in self._line.answer(identifier.to_bytes(4, "big") + bytes(message.data)):
            self._loop.call_later(self._line.clock.real(outcome.delay), self._send, outcome.data)

    def _unasked(self) -> None:
        frames, after = self._line.due()
        for frame in frames:
            self._send(frame)
        if after is not None:
            self._timer = self._loop.call_later(max(after, 0.001), self._unasked)

    def _send(self, data: bytes) -> None:
        import can

        identifier = int.from_bytes(data[:4], "big")
        extended = bool(identifier & _EXTENDED)
        message = can.Message(arbitration_id=identifier & ~_EXTENDED, is_extended_id=extended, data=data[4:12])
        try:
            self._bus.send(message)
        except can.CanError:  # nobody takes the frame: a device would try again
            return
