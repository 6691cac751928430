# SPDX-License-Identifier: 0BSD
"""Parameters that are written to RAM, or kept in EEPROM if the caller says so."""

from __future__ import annotations

from typing import TYPE_CHECKING, Generic, TypeVar

from ..descriptors import PointAttribute
from ..handles import AsyncReadHandle, AsyncWriteHandle, ReadHandle, WriteHandle
from ..points import Decoding, Encoding, Point
from .frames import EEPROM

if TYPE_CHECKING:
    from typing import Unpack

    from ..facts import FactArguments, Place
    from ..forms import Encodes, Form

R_co = TypeVar("R_co", covariant=True)
W_contra = TypeVar("W_contra", contravariant=True)


def _place(point: Point, keep: bool) -> Place:
    """Return the place to which a value is written, with the task that keeps it in EEPROM if it is to be kept."""
    at = point.facts.at
    return at.replaced(function=EEPROM.get((point.size, at.index is not None))) if keep else at


class StoredWriteHandle(WriteHandle[W_contra]):
    """A parameter of a device, to be written."""

    def write(self, value: W_contra, *, keep: bool = False) -> None:
        """Write a value that the range allows; with `keep` it survives power-off, which wears the EEPROM."""
        self._device._run(self._device._write_steps(self, value, _place(self, keep)))

    def write_raw(self, raw: int, *, keep: bool = False) -> None:
        """Write a raw number that the range allows; with `keep` it survives power-off, which wears the EEPROM."""
        self._device._run(self._device._write_raw_steps(self, raw, _place(self, keep)))


class StoredHandle(ReadHandle[R_co], StoredWriteHandle[W_contra], Generic[R_co, W_contra]):
    """A parameter of a device, to be read and written."""


class AsyncStoredWriteHandle(AsyncWriteHandle[W_contra]):
    """A parameter of an async device, to be written."""

    async def write(self, value: W_contra, *, keep: bool = False) -> None:
        """Write a value that the range allows; with `keep` it survives power-off, which wears the EEPROM."""
        await self._device._run(self._device._write_steps(self, value, _place(self, keep)))

    async def write_raw(self, raw: int, *, keep: bool = False) -> None:
        """Write a raw number that the range allows; with `keep` it survives power-off, which wears the EEPROM."""
        await self._device._run(self._device._write_raw_steps(self, raw, _place(self, keep)))


class AsyncStoredHandle(AsyncReadHandle[R_co], AsyncStoredWriteHandle[W_contra], Generic[R_co, W_contra]):
    """A parameter of an async device, to be read and written."""


class StoredWriteOnly(
    PointAttribute[StoredWriteHandle[W_contra], AsyncStoredWriteHandle[W_contra]], Encoding[W_contra]
):
    """A parameter that can only be written, to RAM or EEPROM."""

    handle = StoredWriteHandle
    async_handle = AsyncStoredWriteHandle

    def __init__(self, form: Encodes[W_contra], **facts: Unpack[FactArguments]) -> None:
        super().__init__(form, **facts)


class Stored(
    PointAttribute[StoredHandle[R_co, W_contra], AsyncStoredHandle[R_co, W_contra]],
    Decoding[R_co],
    Encoding[W_contra],
):
    """A parameter that can be read, and written to RAM or EEPROM."""

    handle = StoredHandle
    async_handle = AsyncStoredHandle

    def __init__(self, form: Form[R_co, W_contra], **facts: Unpack[FactArguments]) -> None:
        super().__init__(form, **facts)
