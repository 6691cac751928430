# SPDX-License-Identifier: 0BSD
"""CAN devices over a transport, blocking and async."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from ..device import AnyAsyncDevice, AnyDevice
from ..facts import Place
from .session import CanSession

if TYPE_CHECKING:
    from collections.abc import Mapping

    from .frames import Frame


class CanTransport(Protocol):
    """Carries frames to the bus and from it."""

    def send(self, frame: Frame) -> None:
        """Send a frame."""

    def receive(self) -> Frame:
        """The next frame from the bus, whoever sent it; raises TimeoutError when none comes in time."""


class AsyncCanTransport(Protocol):
    """Carries frames to the bus and from it, asynchronously."""

    async def send(self, frame: Frame) -> None:
        """Send a frame."""

    async def receive(self) -> Frame:
        """The next frame from the bus, whoever sent it; raises TimeoutError when none comes in time."""


class CanDevice(CanSession, AnyDevice):
    """A device on a CAN bus."""

    def __init__(self, transport: CanTransport, unit: int, variants: Mapping[str, str | None] | None = None) -> None:
        super().__init__(unit, variants or {})
        self.transport = transport

    def _carry(self, request: Frame | None) -> Frame | None:
        if request is None:
            return self.transport.receive()
        self.transport.send(request)
        return None

    def read_at(self, space: str, address: int, count: int = 1) -> tuple[int, ...]:
        """Read parameters by address, without any meaning."""
        return self.run(self.get_steps(Place(space, tuple(range(address, address + count)))))

    def write_at(self, space: str, address: int, *values: int) -> None:
        """Write parameters by address. Nothing is checked: this can set what no point allows."""
        self.run(self.put_steps(Place(space, tuple(range(address, address + len(values)))), values))


class AsyncCanDevice(CanSession, AnyAsyncDevice):
    """A device on a CAN bus, asynchronously."""

    def __init__(
        self, transport: AsyncCanTransport, unit: int, variants: Mapping[str, str | None] | None = None
    ) -> None:
        super().__init__(unit, variants or {})
        self.transport = transport

    async def _carry(self, request: Frame | None) -> Frame | None:
        if request is None:
            return await self.transport.receive()
        await self.transport.send(request)
        return None

    async def read_at(self, space: str, address: int, count: int = 1) -> tuple[int, ...]:
        """Read parameters by address, without any meaning."""
        return await self.run(self.get_steps(Place(space, tuple(range(address, address + count)))))

    async def write_at(self, space: str, address: int, *values: int) -> None:
        """Write parameters by address. Nothing is checked: this can set what no point allows."""
        await self.run(self.put_steps(Place(space, tuple(range(address, address + len(values)))), values))
