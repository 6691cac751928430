# SPDX-License-Identifier: 0BSD
"""Devices over a transport, in two flavours that share everything but the waiting."""

from __future__ import annotations

import asyncio
import threading
from typing import TYPE_CHECKING, Protocol, TypeVar

from .commands import AsyncCommandHandle, Command, CommandHandle
from .descriptors import ReadOnly, ReadWrite
from .facts import Place
from .handles import (
    AsyncReadHandle,
    AsyncReadWriteHandle,
    AsyncWriteHandle,
    ReadHandle,
    ReadWriteHandle,
    WriteHandle,
)
from .planner import read_function
from .session import Session, Steps, Value

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from .points import Point

T = TypeVar("T")


class Transport(Protocol):
    """Carries one request to the bus and one reply back."""

    @property
    def framing(self) -> str:
        """`rtu` or `tcp`: what the frames look like."""

    def exchange(self, request: bytes) -> bytes:
        """Send a frame and return the whole reply; for a broadcast (nobody answers) return no bytes."""


class AsyncTransport(Protocol):
    """Carries one request to the bus and one reply back, asynchronously."""

    @property
    def framing(self) -> str:
        """`rtu` or `tcp`: what the frames look like."""

    async def exchange(self, request: bytes) -> bytes:
        """Send a frame and return the whole reply; for a broadcast (nobody answers) return no bytes."""


class Device(Session):
    """A device on a bus. One thread at a time talks to it; a transport that devices share has to do the same."""

    def __init__(self, transport: Transport, unit: int, variants: Mapping[str, str | None] | None = None) -> None:
        super().__init__(transport.framing, unit, variants or {})
        self.transport = transport
        self._lock = threading.Lock()

    def handle(self, point: Point) -> Point:
        """The point, bound to this device."""
        self.require(point)
        if isinstance(point, ReadWrite):
            return ReadWriteHandle(point, self)
        return ReadHandle(point, self) if isinstance(point, ReadOnly) else WriteHandle(point, self)

    def command(self, command: Command) -> CommandHandle:
        """The command, bound to this device."""
        return CommandHandle(command, self)

    def run(self, steps: Steps[T]) -> T:
        """Carry out an operation."""
        with self._lock:
            try:
                request = next(steps)
                while True:
                    request = steps.send(self.transport.exchange(request))
            except StopIteration as done:
                result: T = done.value
                return result

    def read_many(self, what: str | Iterable[str | Point]) -> dict[str, Value]:
        """Read a group by its name, or several points, with few requests; values by point name."""
        return self.run(self.read_many_steps(what))

    def read_at(self, space: str, address: int, count: int = 1) -> tuple[int, ...]:
        """Read words or bits by address, without any meaning."""
        return self.run(self.ask(read_function(Place(space, (address,))), address, count))

    def write_at(self, space: str, address: int, *values: int) -> None:
        """Write words or bits by address. Nothing is checked: this can set what no point allows."""
        self.run(self.put_steps(Place(space, tuple(range(address, address + len(values)))), values))


class AsyncDevice(Session):
    """A device on a bus, asynchronously. One task at a time talks to it; see `Device` for shared transports."""

    def __init__(self, transport: AsyncTransport, unit: int, variants: Mapping[str, str | None] | None = None) -> None:
        super().__init__(transport.framing, unit, variants or {})
        self.transport = transport
        self._lock = asyncio.Lock()

    def handle(self, point: Point) -> Point:
        """The point, bound to this device."""
        self.require(point)
        if isinstance(point, ReadWrite):
            return AsyncReadWriteHandle(point, self)
        return AsyncReadHandle(point, self) if isinstance(point, ReadOnly) else AsyncWriteHandle(point, self)

    def command(self, command: Command) -> AsyncCommandHandle:
        """The command, bound to this device."""
        return AsyncCommandHandle(command, self)

    async def run(self, steps: Steps[T]) -> T:
        """Carry out an operation."""
        async with self._lock:
            try:
                request = next(steps)
                while True:
                    request = steps.send(await self.transport.exchange(request))
            except StopIteration as done:
                result: T = done.value
                return result

    async def read_many(self, what: str | Iterable[str | Point]) -> dict[str, Value]:
        """Read a group by its name, or several points, with few requests; values by point name."""
        return await self.run(self.read_many_steps(what))

    async def read_at(self, space: str, address: int, count: int = 1) -> tuple[int, ...]:
        """Read words or bits by address, without any meaning."""
        return await self.run(self.ask(read_function(Place(space, (address,))), address, count))

    async def write_at(self, space: str, address: int, *values: int) -> None:
        """Write words or bits by address. Nothing is checked: this can set what no point allows."""
        await self.run(self.put_steps(Place(space, tuple(range(address, address + len(values)))), values))
