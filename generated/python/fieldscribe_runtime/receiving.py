# SPDX-License-Identifier: 0BSD
"""Finds replies in received bytes, without I/O; every transport uses `Receiver`."""

from __future__ import annotations

from time import monotonic
from typing import TYPE_CHECKING, NamedTuple

from .errors import FrameError

if TYPE_CHECKING:
    from collections.abc import Callable

_QUOTED = 16
"""The most bytes that an error quotes."""


class Broadcast(bytes):
    """A request to all units. No unit answers it, so a transport sends it and returns no bytes."""


class Pause(float):
    """A step that only waits: the next request follows after this many seconds."""


class Reply(bytes):
    """A reply with the `seconds` from sending its request to its arrival, without the wait for the line."""

    seconds: float

    @classmethod
    def timed(cls, reply: bytes, since: float) -> Reply:
        """Return a reply to a request that was sent at `since`."""
        made = cls(reply)
        made.seconds = monotonic() - since
        return made


class NoFrameError(TimeoutError):
    """Bytes arrived, but no reply: `received`."""

    def __init__(self, message: str, received: bytes) -> None:
        super().__init__(message)
        self.received = received


class Framing(NamedTuple):
    """What a receiver must know of the frames on a line: sizes in bytes, and the sender of a frame.

    `size` returns the length of the frame that starts with these bytes, or None if they are too few to tell. `address`
    returns what a reply and its request have in common: the unit, or the bytes of the transaction.
    """

    size: Callable[[bytes], int | None]
    address: Callable[[bytes], int | bytes]
    shortest: int
    longest: int
    hint: str = "; is the baud rate right?"
    """What may help where bytes are no reply."""

    def size_of(self, received: bytes) -> int | None:
        """Return the length as `size` does; raises FrameError (long_frame) if it is too long for a frame."""
        size = self.size(received)
        if size is not None and size > self.longest:
            text = f"{_quoted(received)}: the reply would have {size} bytes, and a frame has at most {self.longest}"
            raise FrameError("long_frame", text)
        return size


class Receiver:
    """Collects the reply to one request. Whole frames with another address are dropped."""

    def __init__(self, framing: Framing, request: bytes) -> None:
        self._framing = framing
        self._address = framing.address(request)
        self._foreign = b""
        self.received = b""
        self.missing = framing.shortest
        """The least number of missing bytes."""

    def take(self, data: bytes) -> bytes | None:
        """Add received bytes; return the reply once it is complete.

        Raises FrameError (long_frame) if there are more bytes than any frame has, but no frame.
        """
        self.received = received = self.received + data if self.received else data
        framing = self._framing
        if framing.size(received) == len(received) <= framing.longest and framing.address(received) == self._address:
            return received  # nearly always: exactly the reply
        try:
            return self._reply()
        except FrameError as error:
            error.received = self.received
            raise

    def _reply(self) -> bytes | None:
        framing = self._framing
        while True:
            length = len(self.received)
            size = framing.size_of(self.received)
            if size is None or length < size:
                if length >= framing.longest:
                    text = f"{_quoted(self.received)}, more than any frame has{framing.hint}"
                    raise FrameError("long_frame", text)
                self.missing = max(framing.shortest, size or 0, length + 1) - length
                return None
            frame, self.received = self.received[:size], self.received[size:]
            if framing.address(frame) == self._address:
                return frame
            self._foreign = frame

    def give_up(self) -> bytes:
        """Return the last frame with another address, for the error message; raises TimeoutError if there is none."""
        if self._foreign and not (self.received and self._framing.address(self.received) == self._address):
            return self._foreign
        if self.received:
            raise NoFrameError(f"{_quoted(self.received)}, which are no reply{self._framing.hint}", self.received)
        raise TimeoutError("no byte came")


def _quoted(received: bytes) -> str:
    """Return the number of received bytes, and the first of them."""
    more = " ..." if len(received) > _QUOTED else ""
    return f"{len(received)} bytes came ({received[:_QUOTED].hex(' ').upper()}{more})"


def receive(read: Callable[[int], bytes], framing: Framing, request: bytes) -> bytes:
    """Return the complete reply to a request. `read` returns up to the given number of bytes; none: timeout.

    Raises TimeoutError if no more bytes arrive, and FrameError as `Receiver.take` does.
    """
    receiver = Receiver(framing, request)
    while data := read(receiver.missing):
        if (reply := receiver.take(data)) is not None:
            return reply
    return receiver.give_up()
