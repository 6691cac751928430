# SPDX-License-Identifier: 0BSD
"""A CAN bus, by python-can.

import can
from fieldscribe_runtime.transports.can import CanLine

with CanLine(can.Bus("can0", interface="socketcan")) as line:
genset = WoodwardMpu2s(line, unit=1)
"""

from __future__ import annotations

import asyncio
import time
from contextlib import suppress
from typing import TYPE_CHECKING

from ..can.frames import Frame
from ..errors import LineError

try:
    import can
except ModuleNotFoundError as missing:
    hint = 'this needs python-can: pip install "fieldscribe-runtime[can]"'
    raise ModuleNotFoundError(hint, name=missing.name) from None

if TYPE_CHECKING:
    from typing import Self

_PLAIN_BITS = 11


def _message(frame: Frame) -> can.Message:
    extended = frame.id >> _PLAIN_BITS > 0
    return can.Message(arbitration_id=frame.id, data=frame.data, is_extended_id=extended)


def _frame(message: can.Message) -> Frame | None:
    """A data frame; None for what is none."""
    if message.is_error_frame or message.is_remote_frame:
        return None
    return Frame(message.arbitration_id, bytes(message.data))


class CanLine:
    """A bus for devices; leaving the context shuts it down."""

    def __init__(self, bus: can.BusABC, *, timeout: float = 1.0) -> None:
        self.bus, self.timeout = bus, timeout

    def send(self, frame: Frame) -> None:
        """Send a frame; raises LineError."""
        try:
            self.bus.send(_message(frame), self.timeout)
        except (can.CanError, OSError) as error:
            raise LineError(f"{self.bus}: {error}") from error

    def receive(self) -> Frame:
        """The next data frame, whoever sent it; raises TimeoutError and LineError."""
        until = time.monotonic() + self.timeout
        while (left := until - time.monotonic()) > 0:
            frame = self._next(left)
            if frame is not None:
                return frame
        raise TimeoutError("no frame came")

    def receive_waiting(self) -> Frame | None:
        """The next frame that has come already; None when there is none."""
        return self._next(0)

    def _next(self, timeout: float) -> Frame | None:
        try:
            message = self.bus.recv(timeout)
            while message is not None and (frame := _frame(message)) is None:
                message = self.bus.recv(0)
        except (can.CanError, OSError) as error:
            raise LineError(f"{self.bus}: {error}") from error
        return None if message is None else frame

    def close(self) -> None:
        """Shut the bus down."""
        self.bus.shutdown()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


class AsyncCanLine:
    """A bus for async devices: `async with AsyncCanLine(bus) as line`."""

    def __init__(self, bus: can.BusABC, *, timeout: float = 1.0) -> None:
        self.bus, self.timeout = bus, timeout
        self._frames: asyncio.Queue[Frame] = asyncio.Queue()
        self._notifier: can.Notifier | None = None

    async def __aenter__(self) -> Self:
        self._notifier = can.Notifier(self.bus, [self._keep], loop=asyncio.get_running_loop())
        return self

    async def __aexit__(self, *_: object) -> None:
        if self._notifier is not None:
            await asyncio.to_thread(self._notifier.stop)
        self.bus.shutdown()

    def _keep(self, message: can.Message) -> None:
        frame = _frame(message)
        if frame is not None:
            self._frames.put_nowait(frame)

    async def send(self, frame: Frame) -> None:
        """Send a frame; raises LineError."""
        try:
            await asyncio.to_thread(self.bus.send, _message(frame), self.timeout)
        except (can.CanError, OSError) as error:
            raise LineError(f"{self.bus}: {error}") from error

    async def receive(self) -> Frame:
        """The next data frame, whoever sent it; raises TimeoutError."""
        if self._notifier is None:
            raise LineError("nobody listens yet: use it as `async with AsyncCanLine(bus) as line`")
        async with asyncio.timeout(self.timeout):
            return await self._frames.get()

    def receive_waiting(self) -> Frame | None:
        """The next frame that has come already; None when there is none."""
        with suppress(asyncio.QueueEmpty):
            return self._frames.get_nowait()
        return None
