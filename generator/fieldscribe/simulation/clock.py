"""The time of simulated devices."""

from __future__ import annotations

import time


class Clock:
    """Seconds since the start, `scale` times as fast as real ones; with a scale of 0 only `advance` moves them."""

    def __init__(self, scale: float = 1.0) -> None:
        self.scale = scale
        self._start = time.monotonic()
        self._ahead = 0.0

    def now(self) -> float:
        """Return the seconds since the start."""
        return (time.monotonic() - self._start) * self.scale + self._ahead

    def advance(self, seconds: float) -> None:
        """Let so many seconds pass at once."""
        self._ahead += seconds

    def real(self, seconds: float) -> float:
        """Return how many real seconds a delay takes; none while the clock stands."""
        return seconds / self.scale if self.scale else 0.0
