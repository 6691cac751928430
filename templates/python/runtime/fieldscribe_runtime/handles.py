# SPDX-License-Identifier: 0BSD
"""The attributes of a device: the conversions of a point, and reading and writing through the device."""

from __future__ import annotations

from typing import TYPE_CHECKING, Generic, TypeVar

from .points import Decoding, Encoding, Point

if TYPE_CHECKING:
    from .device import AnyAsyncDevice, AnyDevice

R_co = TypeVar("R_co", covariant=True)
W_contra = TypeVar("W_contra", contravariant=True)


class Handle(Point):
    """A point of a device."""

    def __init__(self, point: Point, device: AnyDevice) -> None:
        self._form = point._form
        self.facts = point.facts
        self._device = device

    def __repr__(self) -> str:
        return f"{super().__repr__()[:-1]} of {self._device!r}>"


class AsyncHandle(Point):
    """A point of an async device."""

    def __init__(self, point: Point, device: AnyAsyncDevice) -> None:
        self._form = point._form
        self.facts = point.facts
        self._device = device

    def __repr__(self) -> str:
        return f"{super().__repr__()[:-1]} of {self._device!r}>"


class ReadHandle(Handle, Decoding[R_co]):
    """A point of a device, to be read."""

    def read(self) -> R_co:
        """Read the value from the device (and other points that its scale needs)."""
        if self._form.needs:
            return self._device._run(self._device._read_steps(self))
        return self.decode(self._device._run(self._device._read_raw_steps(self)))

    def read_raw(self) -> int:
        """Read the raw number from the device."""
        return self._device._run(self._device._read_raw_steps(self))


class WriteHandle(Handle, Encoding[W_contra]):
    """A point of a device, to be written."""

    def write(self, value: W_contra) -> None:
        """Write a value that the range allows; bits of other points in the same word are preserved."""
        self._device._run(self._device._write_steps(self, value))

    def write_raw(self, raw: int) -> None:
        """Write a raw number that the range allows."""
        self._device._run(self._device._write_raw_steps(self, raw))


class ReadWriteHandle(ReadHandle[R_co], WriteHandle[W_contra], Generic[R_co, W_contra]):
    """A point of a device, to be read and written."""


class AsyncReadHandle(AsyncHandle, Decoding[R_co]):
    """A point of an async device, to be read."""

    async def read(self) -> R_co:
        """Read the value from the device (and other points that its scale needs)."""
        if self._form.needs:
            return await self._device._run(self._device._read_steps(self))
        return self.decode(await self._device._run(self._device._read_raw_steps(self)))

    async def read_raw(self) -> int:
        """Read the raw number from the device."""
        return await self._device._run(self._device._read_raw_steps(self))


class AsyncWriteHandle(AsyncHandle, Encoding[W_contra]):
    """A point of an async device, to be written."""

    async def write(self, value: W_contra) -> None:
        """Write a value that the range allows; bits of other points in the same word are preserved."""
        await self._device._run(self._device._write_steps(self, value))

    async def write_raw(self, raw: int) -> None:
        """Write a raw number that the range allows."""
        await self._device._run(self._device._write_raw_steps(self, raw))


class AsyncReadWriteHandle(AsyncReadHandle[R_co], AsyncWriteHandle[W_contra], Generic[R_co, W_contra]):
    """A point of an async device, to be read and written."""
