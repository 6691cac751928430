# SPDX-License-Identifier: 0BSD
"""Modbus devices over a transport, blocking and async."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from ..arguments import awaited, check_transport
from ..device import AnyAsyncDevice, AnyDevice
from .session import ModbusSession

if TYPE_CHECKING:
    from collections.abc import Mapping


_PARTS = {"framing": "'rtu', 'tcp' or 'pdu'", "exchange": "a method that sends a request and returns the whole reply"}
"""The parts of a transport."""


class Transport(Protocol):
    """Sends one request to the bus and returns its reply."""

    @property
    def framing(self) -> str:
        """The form of frames: `rtu`, `tcp`, or `pdu` (the unit and the request, without the rest of the frame)."""

    def exchange(self, request: bytes) -> bytes:
        """Send a frame and return the whole reply; raises TimeoutError when none comes in time.

        Nobody answers a broadcast: return no bytes for it (or wait and raise TimeoutError).
        """


class AsyncTransport(Protocol):
    """Sends one request to the bus and returns its reply, asynchronously."""

    @property
    def framing(self) -> str:
        """The form of frames: `rtu`, `tcp`, or `pdu` (the unit and the request, without the rest of the frame)."""

    async def exchange(self, request: bytes) -> bytes:
        """Send a frame and return the whole reply; raises TimeoutError when none comes in time.

        Nobody answers a broadcast: return no bytes for it (or wait and raise TimeoutError).
        """


class ModbusDevice(ModbusSession, AnyDevice):
    """A device on a Modbus line or network."""

    transport: Transport

    def __init__(self, transport: Transport, unit: int, variants: Mapping[str, str | None] | None = None) -> None:
        check_transport(transport, **_PARTS)
        super().__init__(transport.framing, unit, variants or {})
        self.transport = transport

    def _carry(self, request: bytes) -> bytes:
        return self.transport.exchange(request)

    def read_at(self, space: str, address: int, count: int = 1) -> tuple[int, ...]:
        """Read words or bits by address, as plain numbers."""
        return self._run(self._read_at_steps(space, address, count))

    def find_blocks(self) -> dict[int, tuple[int, int]]:
        """Return the address of each block that the addresses of points may count from, and its last word, by id.

        They are searched when first needed, and again after `forget()`. Raises BlockError.
        """
        blocks = self._run(self._blocks_steps())
        return {block: (start.address, start.last) for block, start in blocks.items()}

    def write_at(self, space: str, address: int, *values: int) -> None:
        """Write words or bits by address. Nothing is checked: this can set what no point allows."""
        self._run(self._write_at_steps(space, address, values))


class AsyncModbusDevice(ModbusSession, AnyAsyncDevice):
    """A device on a Modbus line or network, asynchronously."""

    transport: AsyncTransport

    def __init__(self, transport: AsyncTransport, unit: int, variants: Mapping[str, str | None] | None = None) -> None:
        check_transport(transport, **_PARTS)
        super().__init__(transport.framing, unit, variants or {})
        self.transport = transport

    async def _carry(self, request: bytes) -> bytes:
        return await awaited(self.transport, self.transport.exchange(request))

    async def read_at(self, space: str, address: int, count: int = 1) -> tuple[int, ...]:
        """Read words or bits by address, as plain numbers."""
        return await self._run(self._read_at_steps(space, address, count))

    async def find_blocks(self) -> dict[int, tuple[int, int]]:
        """Return the address of each block that the addresses of points may count from, and its last word, by id.

        They are searched when first needed, and again after `forget()`. Raises BlockError.
        """
        blocks = await self._run(self._blocks_steps())
        return {block: (start.address, start.last) for block, start in blocks.items()}

    async def write_at(self, space: str, address: int, *values: int) -> None:
        """Write words or bits by address. Nothing is checked: this can set what no point allows."""
        await self._run(self._write_at_steps(space, address, values))
