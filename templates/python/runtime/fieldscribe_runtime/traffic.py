# SPDX-License-Identifier: 0BSD
"""Counts the traffic of one unit, and logs it to `fieldscribe` at debug level."""

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
    """Counts the requests of one unit, including repetitions, and its replies; times are in seconds.

    `replies` counts valid frames that answer a request, refusals too. Damaged, foreign and missing replies are only in
    `errors`, which counts failed requests by the status of their error. `longest` and `mean` are times from the end of
    the request to the reply, without the wait for a shared line; a transport of your own is timed as a whole.
    """

    def __init__(self, unit: int) -> None:
        self._unit = unit
        self._logger: Any = None
        self._is_logged = False
        self.about: Iterable[Labelled] = ()
        self._took: float | None = None
        """The time of the last received frame, from its request on."""
        self.is_split = False
        """True while a refused request is followed by one for each of its points."""
        self.clear()

    def clear(self) -> None:
        """Count from zero."""
        self.requests = self.replies = 0
        self.errors: dict[str, int] = {}
        self.total = self.longest = 0.0

    @property
    def mean(self) -> float:
        """The average time of a reply."""
        return self.total / self.replies if self.replies else 0.0

    def __repr__(self) -> str:
        errors = "".join(f", {number} {status}" for status, number in self.errors.items())
        times = f"{self.mean * 1000:.1f} ms each, {self.longest * 1000:.1f} ms at most"
        return f"<{type(self).__name__} {self.requests} requests, {self.replies} replies{errors}; {times}>"

    def sent(self, frame: Frame) -> float:
        """Count a request; return the time at which it is sent."""
        self.requests += 1
        self._took = None
        if self._logger is None and "logging" in sys.modules:  # only programs that log have imported it
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
        """Log a received frame; `sent` is the time of its request."""
        seconds: float | None = getattr(frame, "seconds", None)
        took = self._took = monotonic() - sent if seconds is None else seconds
        if self._is_logged:
            self._logger.debug("unit %d <- %s after %.1f ms", self._unit, frame.hex(" ").upper(), took * 1000)

    def answered(self) -> None:
        """Count the last received frame, if any, as a valid reply."""
        if self._took is not None:
            self.replies += 1
            self.total += self._took
            self.longest = max(self.longest, self._took)

    def failed(self, error: FieldscribeError, *, is_final: bool) -> None:
        """Count a failure (without a request if none was sent); log a final one as a warning."""
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
