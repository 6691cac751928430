"""Serves lines at TCP ports, serial ports, pseudo terminals and CAN buses, in one event loop.

The command line calls `serve` for each line. Tests say `with simulated("hitachi_l200") as drive:`, which serves one
device on a line of its own, at a free port.
"""

from __future__ import annotations

import asyncio
import errno
import os
import threading
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fieldscribe.diagnostics import UnclearError, can_package
from fieldscribe.simulation.bench import Bench
from fieldscribe.simulation.line import Fault, Line, Outcome, Stream, Trace
from fieldscribe.text import shortened

if TYPE_CHECKING:
    import can

LOOPBACK = "127.0.0.1"
_LINES = ("tcp", "serial", "can")
_OF_LINE, _OF_BENCH = ("framing", "faults"), ("seed", "strict", "time_scale")
"""The settings of `simulated` that belong to the line, and to all lines."""
_QUIET = 0.02
"""Real seconds without a byte after which an incomplete request is given up."""
_EXTENDED = 1 << 31
_HEAD = 4
"""The bytes of the identifier, in front of the data of a frame."""


class Server:
    """A line that is served at `url`: a TCP port, or the path of a serial port; `close` stops it."""

    def __init__(self, url: str, close: Callable[[], None], *, port: int = 0, path: str = "") -> None:
        self.url, self.close, self.port, self.path = url, close, port, path


async def serve(line: Line) -> Server:
    """Serve a line at its place; without a host, a port is open only to this machine. Raises UnclearError."""
    if line.on == "serial":
        return await serve_serial(line, line.at, line.speed)
    if line.on == "can":
        interface, colon, channel = (line.at or f"virtual:{line.name}").partition(":")
        if not colon:
            raise UnclearError(f"`{line.at}` is no CAN bus", "name it as python-can does, such as socketcan:can0")
        return await serve_can(line, interface, channel)
    host, _, port = line.at.rpartition(":")
    if not (port or "0").isdecimal() or len(port) > 5 or int(port or 0) > 0xFFFF:
        raise UnclearError(f"`{line.at}` is no TCP port", "write [HOST:]PORT, such as 5020")
    return await serve_tcp(line, host.strip("[]") or LOOPBACK, int(port or 0))


async def serve_tcp(line: Line, host: str = LOOPBACK, port: int = 0) -> Server:
    """Serve a line at a TCP port; 0 chooses a free one. Raises UnclearError if the port is not available."""
    ends: set[_End] = set()
    try:
        listening = await asyncio.get_running_loop().create_server(lambda: _End(line, ends), host, port)
    except (OSError, OverflowError) as error:
        # newer versions of Python tell no number for an address that no socket could have
        number = (error.errno or errno.EADDRNOTAVAIL) if isinstance(error, OSError) else 0
        taken = number == errno.EADDRINUSE
        hint = "give another port, or 0 for any free one" if taken else "give an address of this machine, and a port"
        reason = "it is taken" if taken else os.strerror(number) if number > 0 else str(error)
        raise UnclearError(f"port {port} of {host} cannot be served: {reason}", hint) from None

    def close() -> None:
        listening.close()
        for end in list(ends):
            end.close()

    port = listening.sockets[0].getsockname()[1]
    return Server(f"tcp://{f'[{host}]' if ':' in host else host}:{port}", close, port=port)


class _End(asyncio.Protocol):
    """One connection: bytes in, answers out, each at its time and in order."""

    def __init__(self, line: Line, ends: set[_End]) -> None:
        self._loop = asyncio.get_running_loop()
        self._stream, self._ends = Stream(line), ends
        self._reader: asyncio.ReadTransport | None = None
        self._writer: asyncio.WriteTransport | None = None
        self._timer: asyncio.TimerHandle | None = None
        self._free, self._pending = 0.0, 0

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Connect; a serial port connects its output first."""
        self._ends.add(self)
        if isinstance(transport, asyncio.WriteTransport):
            self._writer = transport
        if isinstance(transport, asyncio.ReadTransport):
            self._reader = transport

    def connection_lost(self, exc: Exception | None) -> None:
        """End the connection; drop what waits."""
        self.close()
        self._reader = self._writer = None
        self._ends.discard(self)
        if self._timer is not None:
            self._timer.cancel()

    def data_received(self, data: bytes, *, quiet: bool = False) -> None:
        """Answer received bytes."""
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None
        for outcome in self._stream.received(data, quiet=quiet):
            self._send(outcome)
        if self._stream.waiting:
            self._timer = self._loop.call_later(_QUIET, lambda: self.data_received(b"", quiet=True))

    def pause_writing(self) -> None:
        """Pause reading while the other end does not take its answers."""
        if self._reader is not None:
            self._reader.pause_reading()

    def resume_writing(self) -> None:
        """Resume reading."""
        if self._reader is not None:
            self._reader.resume_reading()

    def close(self) -> None:
        """Break the connection."""
        for transport in (self._reader, self._writer):
            if transport is not None:
                transport.close()

    def _send(self, outcome: Outcome) -> None:
        delay = self._stream.line.clock.real(outcome.delay) if outcome.delay else 0.0
        if not delay and not self._pending:
            self._write(outcome)
            return
        self._free = max(self._free, self._loop.time() + delay)
        self._pending += 1
        self._loop.call_at(self._free, self._write_pending, outcome)

    def _write_pending(self, outcome: Outcome) -> None:
        self._pending -= 1
        self._write(outcome)

    def _write(self, outcome: Outcome) -> None:
        if self._writer is None or self._writer.is_closing():
            return
        if outcome.data:
            self._writer.write(outcome.data)
        writer: object = self._writer
        if outcome.drop and writer is self._reader:  # a serial port stays
            self.close()


async def serve_serial(line: Line, path: str = "", baud: int = 0) -> Server:
    """Serve a line at a serial port, or at a new pseudo terminal without a path. Raises UnclearError."""
    import tty  # POSIX only, as pseudo terminals are

    port, spare = (_opened(path, baud), -1) if path else os.openpty()
    if not path:  # keep the other end open, so that clients can come and go
        tty.setraw(spare)
        path = os.ttyname(spare)
    loop, end = asyncio.get_running_loop(), _End(line, set())
    await loop.connect_write_pipe(lambda: end, os.fdopen(os.dup(port), "wb", 0))
    await loop.connect_read_pipe(lambda: end, os.fdopen(port, "rb", 0))

    def close() -> None:
        end.close()
        if spare >= 0:
            os.close(spare)

    return Server(path, close, path=path)


def _opened(path: str, baud: int) -> int:
    import termios
    import tty

    port = -1
    try:
        port = os.open(path, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        tty.setraw(port)
        settings = termios.tcgetattr(port)
        settings[4] = settings[5] = getattr(termios, f"B{baud}") if baud else settings[4]
        termios.tcsetattr(port, termios.TCSANOW, settings)
    except (OSError, termios.error, AttributeError) as error:
        if port >= 0:
            os.close(port)
        reason = f"it has no speed of {baud} baud" if isinstance(error, AttributeError) else str(error.args[-1])
        hint = "name a serial port or a pseudo terminal; without a name a new pseudo terminal is made"
        raise UnclearError(f"`{path}` cannot be served: {reason}", hint) from None
    return port


async def serve_can(line: Line, interface: str, channel: str) -> Server:
    """Serve a line at a CAN bus, as python-can names it. Raises UnclearError."""
    try:
        import can
    except ModuleNotFoundError:
        raise UnclearError("CAN needs python-can", "pip install python-can") from None
    options: dict[str, Any] = {"bitrate": line.speed} if line.speed else {}
    try:
        bus = can.Bus(channel, interface=interface, **options)
    except Exception as error:  # each interface raises errors of its own
        hint = can_package(interface, error) or "name it as python-can does: `socketcan:can0`, `slcan:/dev/ttyUSB0`"
        raise UnclearError(f"the bus `{interface}:{channel}` cannot be opened: {str(error)[:200]}", hint) from None
    end = _CanEnd(line, bus)
    return Server(f"can://{interface}/{channel}", end.close)


class _CanEnd:
    """A bus: frames in, answers and cyclic frames out."""

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

        if len(data) < _HEAD:  # a fault cut the identifier
            return
        identifier = int.from_bytes(data[:_HEAD], "big")
        extended = bool(identifier & _EXTENDED)
        long = len(data) > _HEAD + 8
        message = can.Message(
            arbitration_id=identifier & ~_EXTENDED, is_extended_id=extended, data=data[_HEAD:], is_fd=long
        )
        try:
            self._bus.send(message)
        except (can.CanError, ValueError):  # nobody acknowledges the frame: a device would try again
            return


# Devices for tests.


class Simulated:
    """A running simulated device: it answers at `port`, `path` or `url`.

    `values` has its values by name; writing them ignores the rules. `conditions` are what must be true before some
    writes, all true at first. `complaints` are violations of the manual by clients, if it is strict. `restart()`
    switches it off and on.
    """

    def __init__(self, line: Line, server: Server) -> None:
        self.device, self.line, self.unit = line.core.devices[0], line, line.core.devices[0].unit
        self.port, self.path, self.url = server.port, server.path, server.url
        self.values, self.conditions = self.device.values, self.device.conditions
        self.complaints, self.restart = self.device.complaints, self.device.restart
        self.advance = self.device.clock.advance

    @property
    def requests(self) -> int:
        """Return the number of requests."""
        return self.line.requests

    def fault(self, text: str) -> None:
        """Add a fault, such as `late 0.5 x3`; see `line.KINDS`."""
        self.line.faults.waiting.append(Fault.of(text))


@contextmanager
def simulated(
    device: str | Path,
    *,
    on: str = "",
    variants: Iterable[str] = (),
    behaviour: bool = False,
    trace: Trace | None = None,
    **settings: Any,
) -> Iterator[Simulated]:
    """Run a device, by its id or the path of its folder, until the end of the context.

    `on` is the line: `tcp`, `serial` (a new pseudo terminal) or `can` (a bus of python-can's interface `virtual`, named
    after the device). `variants` are texts such as `voltage=400V`. With `behaviour`, its numbers follow the file next
    to the description. The other settings are those of a bench file: `unit`, `values`, `given`, `unmet`, `refusals`,
    `framing`, `faults`, `seed`, `strict`, `time_scale`. A strict device raises AssertionError at the end, with all
    violations of the manual by clients. With a `time_scale` of 0, only `advance` lets time pass. Raises UnclearError.
    """
    line: dict[str, Any] = {key: settings.pop(key) for key in _OF_LINE if key in settings}
    bench = {key: settings.pop(key) for key in _OF_BENCH if key in settings}
    if on not in ("", *_LINES):
        raise UnclearError(f"there is no line `{shortened(on)}`", f"`on` is one of {', '.join(_LINES)}")
    if wrong := [text for text in variants if "=" not in text]:
        raise UnclearError(f"`{shortened(wrong[0])}` is no variant", "write AXIS=VALUE, as in voltage=400V")
    settings["variant"] = dict(text.split("=", 1) for text in variants)
    line["devices"] = [{"device": str(device), "behaviour": behaviour, **settings}]
    if on:
        line[on] = ""
    (made,) = Bench({"lines": [line], **bench}, trace=trace).lines
    server = asyncio.run_coroutine_threadsafe(serve(made), _loop()).result()
    running = Simulated(made, server)
    try:
        yield running
    finally:
        asyncio.run_coroutine_threadsafe(_called(server.close), _loop()).result()
    if running.complaints:
        raise AssertionError("\n".join(map(str, running.complaints)))


@cache
def _loop() -> asyncio.AbstractEventLoop:
    """Return the event loop of all devices of the process, in a thread of its own."""
    loop = asyncio.new_event_loop()
    threading.Thread(target=loop.run_forever, name="simulated devices", daemon=True).start()
    return loop


async def _called(close: Callable[[], None]) -> None:
    close()
