# SPDX-License-Identifier: 0BSD
"""USS devices over a transport, blocking and async."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from ..device import AnyAsyncDevice, AnyDevice
from ..facts import Place
from .session import UssSession

if TYPE_CHECKING:
    from collections.abc import Mapping

    from .frames import Link


class UssTransport(Protocol):
    """Carries one request to the line and one reply back."""

    def exchange(self, request: bytes) -> bytes:
        """Send a telegram and return the whole reply; raises TimeoutError when none comes in time."""


class AsyncUssTransport(Protocol):
    """Carries one request to the line and one reply back, asynchronously."""

    async def exchange(self, request: bytes) -> bytes:
        """Send a telegram and return the whole reply; raises TimeoutError when none comes in time."""


class UssDevice(UssSession, AnyDevice):
    """A device on a USS line."""

    def __init__(
        self, transport: UssTransport, unit: int, link: Link, variants: Mapping[str, str | None] | None = None
    ) -> None:
        super().__init__(link, unit, variants or {})
        self.transport = transport

    def _carry(self, request: bytes) -> bytes:
        return self.transport.exchange(request)

    def read_at(self, space: str, address: int, index: int | None = None) -> tuple[int, ...]:
        """Read a parameter by number, without any meaning: one word, or two with the high one first."""
        return self.run(self.get_steps(Place(space, (address,), index=index)))

    def write_at(self, space: str, address: int, *words: int, index: int | None = None) -> None:
        """Write a parameter by number to RAM. Nothing is checked: this can set what no point allows."""
        self.run(self.put_steps(Place(space, (address,), index=index), words))


class AsyncUssDevice(UssSession, AnyAsyncDevice):
    """A device on a USS line, asynchronously."""

    def __init__(
        self, transport: AsyncUssTransport, unit: int, link: Link, variants: Mapping[str, str | None] | None = None
    ) -> None:
        super().__init__(link, unit, variants or {})
        self.transport = transport

    async def _carry(self, request: bytes) -> bytes:
        return await self.transport.exchange(request)

    async def read_at(self, space: str, address: int, index: int | None = None) -> tuple[int, ...]:
        """Read a parameter by number, without any meaning: one word, or two with the high one first."""
        return await self.run(self.get_steps(Place(space, (address,), index=index)))

    async def write_at(self, space: str, address: int, *words: int, index: int | None = None) -> None:
        """Write a parameter by number to RAM. Nothing is checked: this can set what no point allows."""
        await self.run(self.put_steps(Place(space, (address,), index=index), words))
