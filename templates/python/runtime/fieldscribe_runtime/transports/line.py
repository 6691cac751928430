# SPDX-License-Identifier: 0BSD
"""What lines of bytes have in common: one exchange at a time, and nothing of an old answer in a new one."""

from __future__ import annotations

import threading
from abc import ABC, abstractmethod
from functools import partial
from typing import TYPE_CHECKING

from ..errors import FrameError, LineError
from ..modbus import frames as modbus
from ..receiving import whole
from ..uss import frames as uss
from ..uss.frames import USS

if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Self


def size_of_reply(framing: str) -> Callable[[bytes], int | None]:
    """Return what tells the length of a reply by its first bytes. Raises RequestError for an unknown framing."""
    if framing == USS:
        return uss.reply_size
    told = partial(modbus.reply_size, framing=framing)
    told(b"")
    return told


class Line(ABC):
    """A line of bytes. `framing` is `rtu`, `tcp` or `uss`."""

    def __init__(self, framing: str) -> None:
        self.framing = framing
        self._size = size_of_reply(framing)
        self._turn = threading.Lock()

    @abstractmethod
    def _send(self, request: bytes) -> None:
        """Drop what came before, and send; raises OSError."""

    @abstractmethod
    def _read(self, most: int) -> bytes:
        """Up to so many bytes; none when nothing comes in time. Raises OSError."""

    @abstractmethod
    def close(self) -> None:
        """Give the line back; the next exchange opens it again."""

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self}, {self.framing}>"

    def exchange(self, request: bytes) -> bytes:
        """Send a frame and return the whole reply; raises TimeoutError, LineError and FrameError."""
        with self._turn:
            try:
                self._send(request)
                return whole(self._read, self._size)
            except (TimeoutError, FrameError):
                self._failed()
                raise
            except OSError as error:
                self.close()
                raise LineError(f"{self}: {error.strerror or error}") from error
            except BaseException:
                self.close()  # also where a program is interrupted: the answer must not come to the next request
                raise

    @abstractmethod
    def _failed(self) -> None:
        """Make sure that an answer which comes too late is not taken for the next one."""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
