# SPDX-License-Identifier: 0BSD
"""What went over the line for one unit: counted, and written to the log `fieldscribe` if that takes debug messages."""

from __future__ import annotations

import sys
from time import monotonic
from typing import TYPE_CHECKING, Any

from .errors import LineError

if TYPE_CHECKING:
    from collections.abc import Iterable
    from typing import Protocol

    from .errors import FieldscribeError

    class Labelled(Protocol):
        """A point, a command or a place."""

        @property
        def label(self) -> str:
            """The name for messages."""

    class Frame(Protocol):
        """Bytes, or a frame of CAN."""

        def hex(self, separator: str, /) -> str:
            """Return the bytes as text."""


_DEBUG = 10
"""The level of debug messages."""
_WARNING = 30


class Traffic:
    """Counts the requests of one unit, also those that are sent again, and its replies; times are in seconds.

    `replies` counts good frames that answer a request, refusals too; what is damaged, foreign or missing is in `errors`
    alone, which count failed requests by the status of their error. `longest` and `mean` are how long replies took once
    the request was sent, without the wait for a line that devices share; a transport of your own is timed as a whole.
    """

    def __init__(self, unit: int) -> None:
        self._unit = unit
        self._logger: Any = None
        self._is_logged = False
        self.about: Iterable[Labelled] = ()
        self._took: float | None = None
        """How long the frame took that came for the last request."""
        self.is_split = False
        """A request that is refused now is followed by one for each of its points."""
        self.clear()

    def clear(self) -> None:
        """Count from zero."""
        self.requests = self.replies = 0
        self.errors: dict[str, int] = {}
        self.total = self.longest = 0.0

    @property
    def mean(self) -> float:
        """How long a reply takes on average."""
        return self.total / self.replies if self.replies else 0.0

    def __repr__(self) -> str:
        errors = "".join(f", {number} {status}" for status, number in self.errors.items())
        times = f"{self.mean * 1000:.1f} ms each, {self.longest * 1000:.1f} ms at most"
        return f"<{type(self).__name__} {self.requests} requests, {self.replies} replies{errors}; {times}>"

    def sent(self, frame: Frame) -> float:
        """Count a request; return when it is sent."""
        self.requests += 1
        self._took = None
        if self._logger is None and "logging" in sys.modules:  # a program that logs has imported it: nobody else does
            self._logger = sys.modules["logging"].getLogger("fieldscribe")
            if not self._logger.handlers:
                self._logger.addHandler(sys.modules["logging"].NullHandler())  # no log set up: nothing is printed
        self._is_logged = self._logger is not None and self._logger.isEnabledFor(_DEBUG)
        if self._is_logged:
            self._logger.debug("unit %d -> %s (%s)", self._unit, frame.hex(" ").upper(), self._names())
        return monotonic()

    def _names(self) -> str:
        return ", ".join([one.label for one in self.about])

    def came(self, frame: Frame, sent: float) -> None:
        """Log a frame that came for a request that was sent then."""
        seconds: float | None = getattr(frame, "seconds", None)
        took = self._took = monotonic() - sent if seconds is None else seconds
        if self._is_logged:
            self._logger.debug("unit %d <- %s after %.1f ms", self._unit, frame.hex(" ").upper(), took * 1000)

    def answered(self) -> None:
        """Count what came last as a reply, if anything came: it is a good one."""
        if self._took is not None:
            self.replies += 1
            self.total += self._took
            self.longest = max(self.longest, self._took)

    def failed(self, error: FieldscribeError, *, is_final: bool) -> None:
        """Count a failure, and no request if none was sent; a final one, which the program gets, is a warning."""
        self.errors[error.status] = self.errors.get(error.status, 0) + 1
        if not error.lost:
            self.answered()
        if error.received and self._is_logged:
            self._logger.debug("unit %d <- %s", self._unit, error.received.hex(" ").upper())
        if unsent := isinstance(error, LineError) and error.unsent:
            self.requests -= 1
        if self._logger is not None:
            level = _WARNING if is_final and (error.lost or not self.is_split) else _DEBUG
            what = f"not sent: {error.status}" if unsent else error.status
            self._logger.log(level, "unit %d: %s: %s (%s)", self._unit, what, str(error), self._names())
