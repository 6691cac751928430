# SPDX-License-Identifier: 0BSD
"""Devices over a transport, in two flavours that share everything but the waiting."""

from __future__ import annotations

import threading
from abc import abstractmethod
from typing import TYPE_CHECKING, Any, TypeVar

from .commands import AsyncCommandHandle, Command, CommandHandle
from .errors import AccessError, LineError
from .session import Session, Steps, Value

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from .descriptors import PointAttribute
    from .handles import AsyncHandle, AsyncReadWriteHandle, Handle, ReadWriteHandle
    from .points import Point

T = TypeVar("T")


class AnyDevice(Session):
    """A device of any family. One thread at a time talks to it; a transport that devices share has to do the same."""

    def __init__(self, unit: int, variants: Mapping[str, str | None]) -> None:
        super().__init__(unit, variants)
        self._lock = threading.Lock()
        self._handles: dict[Point, Handle] = {}

    @abstractmethod
    def _carry(self, request: Any) -> Any:
        """Do what one step asks of the transport."""

    def _bound(self, point: PointAttribute[Any, Any]) -> Handle:
        """The point, bound to this device."""
        if (handle := self._handles.get(point)) is None:
            self._require(point)
            handle = self._handles[point] = point.handle(point, self)
        return handle

    def point(self, what: str) -> ReadWriteHandle[Any, Any]:
        """A point by its name, old name or code (`P0731[1]` is one element of an array), as its attribute is.

        It has the methods that the point has: one that is only read has no `write`. Raises AccessError.
        """
        found: Any = self._bound(self._resolved(what))
        handle: ReadWriteHandle[Any, Any] = found
        return handle

    def _bound_command(self, command: Command) -> CommandHandle:
        """The command, bound to this device."""
        return CommandHandle(command, self)

    def _run(self, steps: Steps[T]) -> T:
        """Carry out an operation."""
        with self._lock:
            try:
                request = next(steps)
                while True:
                    try:
                        reply = self._carry(request)
                    except (TimeoutError, LineError) as error:
                        request = steps.throw(error)
                    else:
                        request = steps.send(reply)
            except StopIteration as done:
                result: T = done.value
                return result
            finally:
                steps.close()

    def read_many(self, what: str | Iterable[str | Point]) -> dict[str, Value]:
        """Read a group by its name, or several points, with few requests; values by point name."""
        return self._run(self._read_many_steps(what))


class AnyAsyncDevice(Session):
    """A device of any family, asynchronously. One task at a time talks to it; see `AnyDevice` for shared transports."""

    def __init__(self, unit: int, variants: Mapping[str, str | None]) -> None:
        super().__init__(unit, variants)
        self._loop: Any = None
        self._turn: Any = None
        self._handles: dict[Point, AsyncHandle] = {}

    @abstractmethod
    async def _carry(self, request: Any) -> Any:
        """Do what one step asks of the transport."""

    def _bound(self, point: PointAttribute[Any, Any]) -> AsyncHandle:
        """The point, bound to this device."""
        if (handle := self._handles.get(point)) is None:
            self._require(point)
            handle = self._handles[point] = point.async_handle(point, self)
        return handle

    def point(self, what: str) -> AsyncReadWriteHandle[Any, Any]:
        """A point by its name, old name or code (`P0731[1]` is one element of an array), as its attribute is.

        It has the methods that the point has: one that is only read has no `write`. Raises AccessError.
        """
        found: Any = self._bound(self._resolved(what))
        handle: AsyncReadWriteHandle[Any, Any] = found
        return handle

    def _bound_command(self, command: Command) -> AsyncCommandHandle:
        """The command, bound to this device."""
        return AsyncCommandHandle(command, self)

    def _lock(self) -> Any:
        """What lets one task at a time talk to the device: asyncio's locks are bound to one event loop.

        The device may be used in the next loop once the one before is done; raises AccessError where it is not.
        """
        import asyncio  # costs more than all of this package, so it is imported where it is needed

        try:
            loop = asyncio.get_running_loop()
        except RuntimeError:  # whoever drives the coroutines is no event loop
            loop = None
        if self._turn is None or loop is not self._loop:
            if self._turn is not None and self._turn.locked() and self._loop is not None and self._loop.is_running():
                raise AccessError("another event loop is talking to the device: use it in one at a time")
            self._loop, self._turn = loop, asyncio.Lock()
        return self._turn

    async def _run(self, steps: Steps[T]) -> T:
        """Carry out an operation."""
        async with self._lock():
            try:
                request = next(steps)
                while True:
                    try:
                        reply = await self._carry(request)
                    except (TimeoutError, LineError) as error:
                        request = steps.throw(error)
                    else:
                        request = steps.send(reply)
            except StopIteration as done:
                result: T = done.value
                return result
            finally:
                steps.close()

    async def read_many(self, what: str | Iterable[str | Point]) -> dict[str, Value]:
        """Read a group by its name, or several points, with few requests; values by point name."""
        return await self._run(self._read_many_steps(what))
