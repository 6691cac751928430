# SPDX-License-Identifier: 0BSD
"""Locks for one event loop after another: asyncio's own locks are bound to one loop."""

from __future__ import annotations

from typing import Any

from .errors import AccessError


class Turns:
    """Provides the lock of the running event loop: `async with turns.lock()`; `what` is its name in messages."""

    def __init__(self, what: str) -> None:
        self._what = what
        self._loop: Any = None
        self._turn: Any = None

    @staticmethod
    def pause(seconds: float) -> Any:
        """Return an awaitable that takes this many seconds."""
        import asyncio

        return asyncio.sleep(seconds)

    def lock(self) -> Any:
        """Return the lock of the running loop; raises AccessError while another loop uses its lock."""
        import asyncio  # imported late: it costs more than this whole package

        try:
            loop = asyncio.get_running_loop()
        except RuntimeError:  # the coroutines run without an event loop
            loop = None
        if self._turn is None or loop is not self._loop:
            if self._turn is not None and self._turn.locked() and self._loop is not None and self._loop.is_running():
                raise AccessError(f"another event loop is talking to {self._what}: use it in one at a time")
            self._loop, self._turn = loop, asyncio.Lock()
        return self._turn
