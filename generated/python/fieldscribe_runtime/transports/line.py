# SPDX-License-Identifier: 0BSD
"""The common part of lines of bytes: one exchange at a time, and no byte of an old reply in a new one."""

from __future__ import annotations

import threading
import time
from abc import ABC, abstractmethod
from typing import TYPE_CHECKING

from ..errors import FrameError, LineError
from ..modbus import frames as modbus
from ..receiving import Broadcast, Receiver, Reply

if TYPE_CHECKING:
    from typing import Self

    from ..receiving import Framing


def framing_of(name: str) -> Framing:
    """Return what a receiver must know of `rtu`, `tcp` or `uss`; raises RequestError for any other framing."""
    if name == "uss":
        from ..uss.frames import FRAMING  # Modbus needs no USS

        return FRAMING
    return modbus.framing_of(name)


class Line(ABC):
    """A line of bytes. `framing` is `rtu`, `tcp` or `uss`. A reply must start within `timeout` seconds."""

    FRAME_SECONDS = 0.0
    """The additional seconds for a reply after its first byte."""

    def __init__(self, framing: str, timeout: float) -> None:
        self.framing, self.timeout = framing, timeout
        self._framing = framing_of(framing)
        self._turn = threading.Lock()

    @abstractmethod
    def _send(self, request: bytes) -> None:
        """Drop bytes received before, and send; raises OSError."""

    @abstractmethod
    def _read(self, most: int, until: float) -> bytes:
        """Return at least one byte, or none if none arrives before `until` on the monotonic clock. Raises OSError."""

    @abstractmethod
    def close(self) -> None:
        """Close the line; the next exchange opens it again."""

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self}, {self.framing}>"

    def exchange(self, request: bytes) -> bytes:
        """Send a frame and return the whole reply, or no bytes at once after a Broadcast.

        Raises TimeoutError, LineError and FrameError.
        """
        with self._turn:
            is_sent = False
            try:
                self._send(request)
                is_sent = True
                return self._after_broadcast() if isinstance(request, Broadcast) else self._received(request)
            except (TimeoutError, FrameError):
                self._failed(request)
                raise
            except OSError as error:
                self.close()
                raise LineError(f"{self}: {error.strerror or error}", unsent=not is_sent) from error
            except BaseException:
                self.close()  # also on an interrupt: the answer must not reach the next request
                raise

    def _received(self, request: bytes) -> bytes:
        receiver = Receiver(self._framing, request)
        since = time.monotonic()
        until = since + self.timeout
        last = until + self.FRAME_SECONDS
        while data := self._read(receiver.missing, until):
            until = last
            if (reply := receiver.take(data)) is not None:
                return Reply.timed(reply, since)
        reply = receiver.give_up()
        self._failed(request)
        return Reply.timed(reply, since)

    def _after_broadcast(self) -> bytes:
        """Return no bytes, after a broadcast."""
        return b""

    @abstractmethod
    def _failed(self, request: bytes) -> None:
        """Make sure that a late reply is not taken for the next one."""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
