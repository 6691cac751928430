# SPDX-License-Identifier: 0BSD
"""CAN devices over a transport, blocking and async."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol, runtime_checkable

from ..arguments import awaited, check_transport
from ..device import AnyAsyncDevice, AnyDevice
from .session import CanSession, Wanted

if TYPE_CHECKING:
    from collections.abc import Mapping

    from .frames import Frame


_PARTS = {"send": "a method that sends a frame", "receive": "one that returns the next frame, or raises TimeoutError"}
"""The methods that blocking and async transports share."""


class CanTransport(Protocol):
    """Carries frames to the bus and from it.

    An answer that comes too late looks like the answer to the next question for the same parameter. Before a request
    therefore everything that came earlier is taken off the queue: by `receive_waiting`, where the transport has that
    method (see `WaitingCanTransport`), else only after a request that nobody seemed to answer, by `receive`.
    """

    def send(self, frame: Frame) -> None:
        """Send a frame."""

    def receive(self) -> Frame:
        """The next frame from the bus, whoever sent it; raises TimeoutError when none comes in time."""


@runtime_checkable
class WaitingCanTransport(CanTransport, Protocol):
    """A transport that can return frames that have come already; with python-can that is `bus.recv(0)`."""

    def receive_waiting(self) -> Frame | None:
        """Return the next frame that has come already; None at once if there is none."""


class AsyncCanTransport(Protocol):
    """Carries frames to the bus and from it, asynchronously; `CanTransport` says what `receive_waiting` is for."""

    async def send(self, frame: Frame) -> None:
        """Send a frame."""

    async def receive(self) -> Frame:
        """The next frame from the bus, whoever sent it; raises TimeoutError when none comes in time."""


@runtime_checkable
class AsyncWaitingCanTransport(AsyncCanTransport, Protocol):
    """An asynchronous transport that can return frames that have come already."""

    def receive_waiting(self) -> Frame | None:
        """Return the next frame that has come already; None if there is none. It never waits, so it is not async."""


@runtime_checkable
class SharedCanTransport(CanTransport, Protocol):
    """A transport that several devices share, each with its own view of it."""

    def listener(self) -> CanTransport:
        """Return a transport over the same bus that receives every frame, whatever the others receive."""


@runtime_checkable
class AsyncSharedCanTransport(AsyncCanTransport, Protocol):
    """The same for async devices."""

    def listener(self) -> AsyncCanTransport:
        """Return a transport over the same bus that receives every frame, whatever the others receive."""


class CanDevice(CanSession, AnyDevice):
    """A device on a CAN bus."""

    transport: CanTransport

    def __init__(self, transport: CanTransport, unit: int, variants: Mapping[str, str | None] | None = None) -> None:
        check_transport(transport, **_PARTS)
        super().__init__(unit, variants or {})
        self.transport = transport
        self._line: CanTransport = transport.listener() if isinstance(transport, SharedCanTransport) else transport

    def _carry(self, request: Frame | Wanted) -> Frame | None:
        if request is Wanted.NEXT:
            return self._line.receive()
        if isinstance(request, Wanted):
            return self._line.receive_waiting() if isinstance(self._line, WaitingCanTransport) else None
        self._line.send(request)
        return None

    def read_at(self, space: str, address: int, count: int = 1) -> tuple[int, ...]:
        """Read parameters by address, or words of the telegram that `space` names, as raw words."""
        return self._run(self._read_at_steps(space, address, count))

    def write_at(self, space: str, address: int, *values: int) -> None:
        """Write parameters by address. Nothing is checked: this can write numbers that no point allows."""
        self._run(self._write_at_steps(space, address, values))


class AsyncCanDevice(CanSession, AnyAsyncDevice):
    """A device on a CAN bus, asynchronously."""

    transport: AsyncCanTransport

    def __init__(
        self, transport: AsyncCanTransport, unit: int, variants: Mapping[str, str | None] | None = None
    ) -> None:
        check_transport(transport, **_PARTS)
        super().__init__(unit, variants or {})
        self.transport = transport
        self._line: AsyncCanTransport = (
            transport.listener() if isinstance(transport, AsyncSharedCanTransport) else transport
        )

    async def _carry(self, request: Frame | Wanted) -> Frame | None:
        if request is Wanted.NEXT:
            return await awaited(self.transport, self._line.receive())
        if isinstance(request, Wanted):
            return self._line.receive_waiting() if isinstance(self._line, AsyncWaitingCanTransport) else None
        await awaited(self.transport, self._line.send(request))
        return None

    async def read_at(self, space: str, address: int, count: int = 1) -> tuple[int, ...]:
        """Read parameters by address, or words of the telegram that `space` names, as raw words."""
        return await self._run(self._read_at_steps(space, address, count))

    async def write_at(self, space: str, address: int, *values: int) -> None:
        """Write parameters by address. Nothing is checked: this can write numbers that no point allows."""
        await self._run(self._write_at_steps(space, address, values))
