# SPDX-License-Identifier: 0BSD
"""USS devices over a transport, blocking and async."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from ..arguments import awaited, check_transport, shown
from ..device import AnyAsyncDevice, AnyDevice
from ..errors import RequestError
from .frames import USS
from .session import UssSession

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from .frames import Link


_PARTS = {"exchange": "a method that sends a telegram and returns the whole reply"}
"""The methods that blocking and async transports share."""


def _check(transport: object) -> None:
    """Raises RequestError for a transport of another bus; a transport need not have `framing`."""
    check_transport(transport, **_PARTS)
    framing = getattr(transport, "framing", USS)
    if framing != USS:
        hint = "for a serial line take a UssLine"
        raise RequestError("bad_framing", f"the device speaks {USS}, and {shown(transport)} {shown(framing)}: {hint}")


class UssTransport(Protocol):
    """Carries one request to the line and one reply back."""

    def exchange(self, request: bytes) -> bytes:
        """Send a telegram and return the whole reply; raises TimeoutError when none comes in time.

        Nobody answers a broadcast: return no bytes for it, or raise TimeoutError after waiting.
        """


class AsyncUssTransport(Protocol):
    """Carries one request to the line and one reply back, asynchronously."""

    async def exchange(self, request: bytes) -> bytes:
        """Send a telegram and return the whole reply; raises TimeoutError when none comes in time.

        Nobody answers a broadcast: return no bytes for it, or raise TimeoutError after waiting.
        """


class UssDevice(UssSession, AnyDevice):
    """A device on a USS line.

    Its process data is 0 until it is written, and 0 again after a telegram that changes it failed: see `UssSession`.
    """

    transport: UssTransport

    def __init__(
        self, transport: UssTransport, unit: int, link: Link, variants: Mapping[str, str | None] | None = None
    ) -> None:
        _check(transport)
        super().__init__(link, unit, variants or {})
        self.transport = transport

    def _carry(self, request: bytes) -> bytes:
        return self.transport.exchange(request)

    def read_at(self, space: str, address: int, index: int | None = None) -> tuple[int, ...]:
        """Read the words of a parameter by number: one word, or two with the high one first.

        If `space` is the name of a telegram, read words of its process data, counted from 0.
        """
        return self._run(self._read_at_steps(space, address, index))

    def write_at(self, space: str, address: int, *words: int, index: int | None = None) -> None:
        """Write a parameter by number to RAM, or words of process data if `space` is the name of a telegram.

        Nothing is checked: this can write numbers that no point allows.
        """
        self._run(self._write_at_steps(space, address, words, index))

    def broadcast(self, mask: tuple[int, int, int, int], words: Sequence[int] | None = None) -> None:
        """Send process data to all units of the line, which nobody answers: `words`, or those written to this device.

        The mask says what counts: its first word which words (bit 1 the first one), its second which bits of the first
        word. Afterwards the process data of this device falls back to 0, see `drop_process_data`: call that on the
        objects of all other units too, or their next telegram takes the broadcast back.
        """
        self._run(self._broadcast_steps(mask, words))


class AsyncUssDevice(UssSession, AnyAsyncDevice):
    """A device on a USS line, asynchronously.

    Its process data is 0 until it is written, and 0 again after a telegram that changes it failed: see `UssSession`.
    """

    transport: AsyncUssTransport

    def __init__(
        self, transport: AsyncUssTransport, unit: int, link: Link, variants: Mapping[str, str | None] | None = None
    ) -> None:
        _check(transport)
        super().__init__(link, unit, variants or {})
        self.transport = transport

    async def _carry(self, request: bytes) -> bytes:
        return await awaited(self.transport, self.transport.exchange(request))

    async def read_at(self, space: str, address: int, index: int | None = None) -> tuple[int, ...]:
        """Read the words of a parameter by number: one word, or two with the high one first.

        If `space` is the name of a telegram, read words of its process data, counted from 0.
        """
        return await self._run(self._read_at_steps(space, address, index))

    async def write_at(self, space: str, address: int, *words: int, index: int | None = None) -> None:
        """Write a parameter by number to RAM, or words of process data if `space` is the name of a telegram.

        Nothing is checked: this can write numbers that no point allows.
        """
        await self._run(self._write_at_steps(space, address, words, index))

    async def broadcast(self, mask: tuple[int, int, int, int], words: Sequence[int] | None = None) -> None:
        """Send process data to all units of the line, which nobody answers: `words`, or those written to this device.

        The mask says what counts: its first word which words (bit 1 the first one), its second which bits of the first
        word. Afterwards the process data of this device falls back to 0, see `drop_process_data`: call that on the
        objects of all other units too, or their next telegram takes the broadcast back.
        """
        await self._run(self._broadcast_steps(mask, words))
