# SPDX-License-Identifier: 0BSD
"""A CAN bus, by python-can.

    import can
    from fieldscribe_runtime.transports.can import CanLine

    with CanLine(can.Bus("can0", interface="socketcan")) as line:
        genset = WoodwardMpu2s(line, unit=1)

Messages of more than 8 bytes are sent as CAN FD; open the bus for that, for example with `fd=True`.

Several devices, in threads or tasks of their own, can share a line: each receives every frame of the bus, and so does
a program that calls `receive` itself.
"""

from __future__ import annotations

import asyncio
import threading
import time
from collections import deque
from contextlib import suppress
from typing import TYPE_CHECKING
from weakref import WeakSet

from ..can.frames import Frame
from ..errors import LineError
from . import checks

try:
    import can
except ModuleNotFoundError as missing:
    hint = "this needs python-can: pip install python-can"
    raise ModuleNotFoundError(hint, name=missing.name) from None

if TYPE_CHECKING:
    from typing import Self

_PLAIN_BITS, _PLAIN_LENGTH = 11, 8
_LATE = 64
"""The most messages taken off the bus after the deadline, so that a flood of non-frames ends too."""
_KEPT = 4096
"""The most frames kept for a listener that does not read; the oldest are dropped."""


def _message(frame: Frame) -> can.Message:
    extended = frame.id >> _PLAIN_BITS > 0
    is_fd = len(frame.data) > _PLAIN_LENGTH
    return can.Message(arbitration_id=frame.id, data=frame.data, is_extended_id=extended, is_fd=is_fd)


def _frame(message: can.Message) -> Frame | None:
    """Return a data frame; None for any other message."""
    if message.is_error_frame or message.is_remote_frame:
        return None
    return Frame(message.arbitration_id, bytes(message.data))


def _checked(bus: can.BusABC) -> can.BusABC:
    takes = 'one of python-can, as in can.Bus("can0", interface="socketcan")'
    checks.object_with("the bus", takes, bus, "send", "recv", "shutdown")
    return bus


class Listener:
    """A view of a `CanLine` that receives all its frames; each device makes its own."""

    def __init__(self, line: CanLine) -> None:
        self._line = line
        self.frames: deque[Frame] = deque(maxlen=_KEPT)

    def send(self, frame: Frame) -> None:
        """Send a frame; raises LineError."""
        self._line.send(frame)

    def receive(self) -> Frame:
        """Return the next data frame, whoever sent it; raises TimeoutError and LineError."""
        frame = self._line.next_of(self.frames, self._line.timeout)
        if frame is None:
            raise TimeoutError("no frame came")
        return frame

    def receive_waiting(self) -> Frame | None:
        """Return the next frame that has already arrived; None if there is none."""
        return self._line.next_of(self.frames, 0)


class CanLine:
    """A bus for devices; leaving the context shuts it down. `receive` waits `timeout` seconds for a frame."""

    def __init__(self, bus: can.BusABC, *, timeout: float = 1.0) -> None:
        self.bus, self.timeout = _checked(bus), checks.seconds(timeout)
        self._listeners: WeakSet[Listener] = WeakSet()
        self._own: Listener | None = None
        self._turn = threading.Condition()
        self._is_heard = False

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.bus}>"

    def listener(self) -> Listener:
        """Return a new listener that receives every frame from now on, and sends."""
        made = Listener(self)
        with self._turn:
            self._listeners.add(made)
        return made

    def send(self, frame: Frame) -> None:
        """Send a frame; raises LineError."""
        try:
            self.bus.send(_message(frame), self.timeout)
        except (can.CanError, OSError) as error:
            raise LineError(f"{self.bus}: {error}", unsent=True) from error

    def receive(self) -> Frame:
        """Return the next data frame, whoever sent it; raises TimeoutError and LineError."""
        return self._listening().receive()

    def receive_waiting(self) -> Frame | None:
        """Return the next frame that has already arrived; None if there is none."""
        return self._listening().receive_waiting()

    def _listening(self) -> Listener:
        if self._own is None:
            self._own = self.listener()
        return self._own

    def next_of(self, frames: deque[Frame], timeout: float) -> Frame | None:
        """Return the next frame of a listener; None when none comes in time."""
        until, late = time.monotonic() + timeout, 0
        with self._turn:
            while not frames:
                left = until - time.monotonic()
                late += left <= 0
                if not self._is_heard:
                    if not self._hear(max(0.0, left)) and left <= 0:
                        return None
                    if late > _LATE:
                        return frames.popleft() if frames else None
                elif left <= 0:
                    return None
                else:
                    self._turn.wait(left)
            return frames.popleft()

    def _hear(self, timeout: float) -> bool:
        """Receive one message for all listeners, while other threads wait or send; return True if there was one."""
        self._is_heard = True
        self._turn.release()
        try:
            message = self.bus.recv(timeout)
        except (can.CanError, OSError) as error:
            raise LineError(f"{self.bus}: {error}") from error
        finally:
            self._turn.acquire()
            self._is_heard = False
            self._turn.notify_all()
        if message is not None and (frame := _frame(message)) is not None:
            for listener in self._listeners:
                listener.frames.append(frame)
        return message is not None

    def close(self) -> None:
        """Shut the bus down."""
        self.bus.shutdown()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


class AsyncListener:
    """A view of an `AsyncCanLine` that receives all its frames; each async device makes its own."""

    def __init__(self, line: AsyncCanLine) -> None:
        self._line = line
        self._frames: asyncio.Queue[Frame] = asyncio.Queue(_KEPT)

    def keep(self, frame: Frame) -> None:
        """Keep a received frame."""
        if self._frames.full():
            self._frames.get_nowait()
        self._frames.put_nowait(frame)

    async def send(self, frame: Frame) -> None:
        """Send a frame; raises LineError."""
        await self._line.send(frame)

    async def receive(self) -> Frame:
        """Return the next data frame, whoever sent it; raises TimeoutError and LineError."""
        self._line.check()
        try:
            async with asyncio.timeout(self._line.timeout):
                return await self._frames.get()
        except TimeoutError:
            self._line.check()
            raise

    def receive_waiting(self) -> Frame | None:
        """Return the next frame that has already arrived; None if there is none."""
        with suppress(asyncio.QueueEmpty):
            return self._frames.get_nowait()
        return None


class AsyncCanLine:
    """A bus for async devices: `async with AsyncCanLine(bus) as line`."""

    def __init__(self, bus: can.BusABC, *, timeout: float = 1.0) -> None:
        self.bus, self.timeout = _checked(bus), checks.seconds(timeout)
        self._listeners: WeakSet[AsyncListener] = WeakSet()
        self._own: AsyncListener | None = None
        self._notifier: can.Notifier | None = None

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.bus}>"

    async def __aenter__(self) -> Self:
        self._notifier = can.Notifier(self.bus, [self._keep], loop=asyncio.get_running_loop())
        return self

    async def __aexit__(self, *_: object) -> None:
        if self._notifier is not None:
            await asyncio.to_thread(self._notifier.stop)
        self.bus.shutdown()

    def _keep(self, message: can.Message) -> None:
        if (frame := _frame(message)) is not None:
            for listener in self._listeners:
                listener.keep(frame)

    def check(self) -> None:
        """Raises LineError unless the line receives from the bus."""
        if self._notifier is None:
            raise LineError("nobody listens yet: use it as `async with AsyncCanLine(bus) as line`")
        if self._notifier.exception is not None:
            raise LineError(f"{self.bus}: {self._notifier.exception}") from self._notifier.exception

    def listener(self) -> AsyncListener:
        """Return a new listener that receives every frame from now on, and sends."""
        made = AsyncListener(self)
        self._listeners.add(made)
        return made

    async def send(self, frame: Frame) -> None:
        """Send a frame; raises LineError."""
        try:
            await asyncio.to_thread(self.bus.send, _message(frame), self.timeout)
        except (can.CanError, OSError) as error:
            raise LineError(f"{self.bus}: {error}", unsent=True) from error

    async def receive(self) -> Frame:
        """Return the next data frame, whoever sent it; raises TimeoutError and LineError."""
        return await self._listening().receive()

    def receive_waiting(self) -> Frame | None:
        """Return the next frame that has already arrived; None if there is none."""
        return self._listening().receive_waiting()

    def _listening(self) -> AsyncListener:
        if self._own is None:
            self._own = self.listener()
        return self._own
