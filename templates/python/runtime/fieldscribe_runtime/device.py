# SPDX-License-Identifier: 0BSD
"""Devices over a transport, blocking and asynchronous; they share all but the waiting."""

from __future__ import annotations

import threading
import time
from abc import abstractmethod
from typing import TYPE_CHECKING, Any, TypeVar, overload

from .commands import AsyncCommandHandle, Command, CommandHandle
from .errors import FieldscribeError
from .receiving import Pause
from .session import Session, Steps, Value
from .steps import AsyncSteppedHandle, SteppedCommand, SteppedHandle
from .turns import Turns

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping
    from typing import Literal, Protocol

    from .descriptors import PointAttribute
    from .handles import AsyncHandle, AsyncReadWriteHandle, Handle, ReadWriteHandle
    from .points import Point

    G = TypeVar("G", bound=str)
    G_co = TypeVar("G_co", bound=str, covariant=True)

    class Grouped(Protocol[G_co]):
        """A device with the names of its groups as a Literal. To pyright, a ClassVar would be no such property."""

        @property
        def GROUPS(self) -> tuple[G_co, ...]:
            """The names."""

    class Several(Protocol):
        """A list, tuple or set of points and names. A str does not match, so type checkers find misspelt groups."""

        def __iter__(self) -> Iterator[str | Point]:
            """Return the points."""

        def __contains__(self, one: object, /) -> bool:
            """Return True if an item is in it. `str` takes only `str` here, so it does not match."""


T = TypeVar("T")


_pause: Callable[[float], object] = time.sleep


class AnyDevice(Session):
    """A device of any family. Use it, and a transport that devices share, from one thread at a time."""

    def __init__(self, unit: int, variants: Mapping[str, str | None]) -> None:
        super().__init__(unit, variants)
        self._lock = threading.Lock()
        self._handles: dict[Point, Handle] = {}

    @abstractmethod
    def _carry(self, request: Any) -> Any:
        """Carry out one step on the transport."""

    def _bound(self, point: PointAttribute[Any, Any]) -> Handle:
        """Return the point, bound to this device."""
        if (handle := self._handles.get(point)) is None:
            self._require(point)
            handle = self._handles[point] = point.handle(point, self)
        return handle

    def point(self, what: str) -> ReadWriteHandle[Any, Any]:
        """Return a point by its name, old name or code (`P0731[1]` is one element of an array), like its attribute.

        A read-only point has no `write`. Raises AccessError.
        """
        found: Any = self._bound(self._resolved(what))
        handle: ReadWriteHandle[Any, Any] = found
        return handle

    def _bound_command(self, command: Command) -> CommandHandle:
        """Return the command, bound to this device."""
        return CommandHandle(command, self)

    def _bound_steps(self, command: SteppedCommand) -> SteppedHandle:
        """Return the command, bound to this device."""
        return SteppedHandle(command, self)

    def _run(self, steps: Steps[T], *, prepares: bool = True) -> T:
        """Carry out an operation."""
        with self._lock:
            if self._first and prepares:
                steps = self._after_first_steps(steps)
            try:
                request = next(steps)
                while True:
                    try:
                        reply = _pause(request) if type(request) is Pause else self._carry(request)
                    except (TimeoutError, FieldscribeError) as error:
                        request = steps.throw(error)
                    else:
                        request = steps.send(reply)
            except StopIteration as done:
                result: T = done.value
                return result
            finally:
                steps.close()

    def identify(self) -> dict[str, str]:
        """Read the points that identify this device; return the matching value of each variant axis.

        An axis without a matching value is left out. Raises OtherDeviceError for another device.
        """
        return self._run(self._identify_steps(), prepares=False)

    @overload
    def read_many(
        self: Grouped[G], what: G | Several | Iterator[str | Point], *, errors: Literal["raise"] = "raise"
    ) -> dict[str, Value]: ...

    @overload
    def read_many(
        self: Grouped[G], what: G | Several | Iterator[str | Point], *, errors: Literal["return"]
    ) -> dict[str, Value | FieldscribeError]: ...

    def read_many(self: Any, what: str | Iterable[str | Point], *, errors: str = "raise") -> dict[str, Any]:
        """Read a group by its name, or several points, with few requests; values by point name.

        With errors="return", a point that is absent, refused or without a value has its error as its value; only a lost
        line raises. A point that the device refused with exception 01h to 03h is not requested again but has the same
        error, until it is read in another way or `forget()` is called.
        """
        values: dict[str, Any] = self._run(self._read_many_steps(what, errors))
        return values

    def write_together(self, values: Mapping[Any, Any]) -> None:
        """Write several points in one request, as `write_with` requires; `values` by point or name.

        Raises RequestError (not_together) if a point is missing, or if one request cannot write them.
        """
        self._run(self._write_together_steps(values))


class AnyAsyncDevice(Session):
    """An asynchronous device of any family. Use it, and a transport that devices share, from one task at a time."""

    def __init__(self, unit: int, variants: Mapping[str, str | None]) -> None:
        super().__init__(unit, variants)
        self._turns = Turns("the device")
        self._handles: dict[Point, AsyncHandle] = {}

    @abstractmethod
    async def _carry(self, request: Any) -> Any:
        """Carry out one step on the transport."""

    def _bound(self, point: PointAttribute[Any, Any]) -> AsyncHandle:
        """Return the point, bound to this device."""
        if (handle := self._handles.get(point)) is None:
            self._require(point)
            handle = self._handles[point] = point.async_handle(point, self)
        return handle

    def point(self, what: str) -> AsyncReadWriteHandle[Any, Any]:
        """Return a point by its name, old name or code (`P0731[1]` is one element of an array), like its attribute.

        A read-only point has no `write`. Raises AccessError.
        """
        found: Any = self._bound(self._resolved(what))
        handle: AsyncReadWriteHandle[Any, Any] = found
        return handle

    def _bound_command(self, command: Command) -> AsyncCommandHandle:
        """Return the command, bound to this device."""
        return AsyncCommandHandle(command, self)

    def _bound_steps(self, command: SteppedCommand) -> AsyncSteppedHandle:
        """Return the command, bound to this device."""
        return AsyncSteppedHandle(command, self)

    async def _run(self, steps: Steps[T], *, prepares: bool = True) -> T:
        """Carry out an operation."""
        async with self._turns.lock():
            if self._first and prepares:
                steps = self._after_first_steps(steps)
            try:
                request = next(steps)
                while True:
                    try:
                        reply = await (self._turns.pause(request) if type(request) is Pause else self._carry(request))
                    except (TimeoutError, FieldscribeError) as error:
                        request = steps.throw(error)
                    else:
                        request = steps.send(reply)
            except StopIteration as done:
                result: T = done.value
                return result
            finally:
                steps.close()

    async def identify(self) -> dict[str, str]:
        """Read the points that identify this device; return the matching value of each variant axis.

        An axis without a matching value is left out. Raises OtherDeviceError for another device.
        """
        return await self._run(self._identify_steps(), prepares=False)

    @overload
    async def read_many(
        self: Grouped[G], what: G | Several | Iterator[str | Point], *, errors: Literal["raise"] = "raise"
    ) -> dict[str, Value]: ...

    @overload
    async def read_many(
        self: Grouped[G], what: G | Several | Iterator[str | Point], *, errors: Literal["return"]
    ) -> dict[str, Value | FieldscribeError]: ...

    async def read_many(self: Any, what: str | Iterable[str | Point], *, errors: str = "raise") -> dict[str, Any]:
        """Read a group by its name, or several points, with few requests; values by point name.

        With errors="return", a point that is absent, refused or without a value has its error as its value; only a lost
        line raises. A point that the device refused with exception 01h to 03h is not requested again but has the same
        error, until it is read in another way or `forget()` is called.
        """
        values: dict[str, Any] = await self._run(self._read_many_steps(what, errors))
        return values

    async def write_together(self, values: Mapping[Any, Any]) -> None:
        """Write several points in one request, as `write_with` requires; `values` by point or name.

        Raises RequestError (not_together) if a point is missing, or if one request cannot write them.
        """
        await self._run(self._write_together_steps(values))
