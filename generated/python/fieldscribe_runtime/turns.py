# SPDX-License-Identifier: 0BSD
"""One task at a time, in one event loop after the other: asyncio's own locks are bound to the loop they are used in."""

from __future__ import annotations

from typing import Any

from .errors import AccessError


class Turns:
    """Gives the lock of the event loop that runs: `async with turns.lock()`. `what` is used by one at a time."""

    def __init__(self, what: str) -> None:
        self._what = what
        self._loop: Any = None
        self._turn: Any = None

    @staticmethod
    def pause(seconds: float) -> Any:
        """Return what is awaited for so long."""
        import asyncio

        return asyncio.sleep(seconds)

    def lock(self) -> Any:
        """Return the lock, in the next loop once the one before is done; raises AccessError where it is not."""
        import asyncio  # costs more than all of this package, so it is imported where it is needed

        try:
            loop = asyncio.get_running_loop()
        except RuntimeError:  # whoever drives the coroutines is no event loop
            loop = None
        if self._turn is None or loop is not self._loop:
            if self._turn is not None and self._turn.locked() and self._loop is not None and self._loop.is_running():
                raise AccessError(f"another event loop is talking to {self._what}: use it in one at a time")
            self._loop, self._turn = loop, asyncio.Lock()
        return self._turn
