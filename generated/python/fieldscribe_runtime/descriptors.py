# SPDX-License-Identifier: 0BSD
"""Points as attributes: on the class they are pure codecs, on a device they read and write."""

from __future__ import annotations

import copy
import warnings
from typing import TYPE_CHECKING, Any, Generic, Never, TypeVar, Unpack, overload

from .errors import AccessError
from .facts import FactArguments, Facts
from .points import Decoding, Encoding, Point

if TYPE_CHECKING:
    from collections.abc import Mapping

    from .device import AsyncDevice, Device
    from .forms import Decodes, Encodes, Form
    from .handles import (
        AsyncReadHandle,
        AsyncReadWriteHandle,
        AsyncWriteHandle,
        ReadHandle,
        ReadWriteHandle,
        WriteHandle,
    )

R = TypeVar("R")
W = TypeVar("W")
R_co = TypeVar("R_co", covariant=True)
W_contra = TypeVar("W_contra", contravariant=True)
P_co = TypeVar("P_co", bound=Point, covariant=True)


class _Attribute:
    """What an attribute of a table of points knows of its name; a renamed one still works and warns."""

    old_name: str | None = None
    new_name: str | None = None

    def __set__(self, device: Any, value: Never) -> None:
        raise AttributeError("a point is not assigned to: use its write method")

    def _warn(self) -> None:
        if self.new_name is not None:
            warnings.warn(f"{self.old_name} is now called {self.new_name}", DeprecationWarning, stacklevel=3)


class PointAttribute(_Attribute, Point):
    """A point as the attribute of a table of points."""

    def __init__(self, form: Any, **facts: Unpack[FactArguments]) -> None:
        self._form = form
        self.facts = Facts(**facts)

    def __set_name__(self, owner: type, name: str) -> None:
        if self.new_name is not None:
            self.old_name = name
        else:
            self.facts.item = name.rstrip("_")
            self.facts.name = self.facts.name or self.facts.item


class ReadOnly(PointAttribute, Decoding[R_co]):
    """A point that can only be read."""

    def __init__(self, form: Decodes[R_co], **facts: Unpack[FactArguments]) -> None:
        super().__init__(form, **facts)

    @overload
    def __get__(self, device: None, owner: object) -> ReadOnly[R_co]: ...
    @overload
    def __get__(self, device: Device, owner: object) -> ReadHandle[R_co]: ...
    @overload
    def __get__(self, device: AsyncDevice, owner: object) -> AsyncReadHandle[R_co]: ...
    def __get__(self, device: Device | AsyncDevice | None, owner: object) -> object:
        self._warn()
        return self if device is None else device.handle(self)


class WriteOnly(PointAttribute, Encoding[W_contra]):
    """A point that can only be written."""

    def __init__(self, form: Encodes[W_contra], **facts: Unpack[FactArguments]) -> None:
        super().__init__(form, **facts)

    @overload
    def __get__(self, device: None, owner: object) -> WriteOnly[W_contra]: ...
    @overload
    def __get__(self, device: Device, owner: object) -> WriteHandle[W_contra]: ...
    @overload
    def __get__(self, device: AsyncDevice, owner: object) -> AsyncWriteHandle[W_contra]: ...
    def __get__(self, device: Device | AsyncDevice | None, owner: object) -> object:
        self._warn()
        return self if device is None else device.handle(self)


class ReadWrite(PointAttribute, Decoding[R_co], Encoding[W_contra]):
    """A point that can be read and written."""

    def __init__(self, form: Form[R_co, W_contra], **facts: Unpack[FactArguments]) -> None:
        super().__init__(form, **facts)

    @overload
    def __get__(self, device: None, owner: object) -> ReadWrite[R_co, W_contra]: ...
    @overload
    def __get__(self, device: Device, owner: object) -> ReadWriteHandle[R_co, W_contra]: ...
    @overload
    def __get__(self, device: AsyncDevice, owner: object) -> AsyncReadWriteHandle[R_co, W_contra]: ...
    def __get__(self, device: Device | AsyncDevice | None, owner: object) -> object:
        self._warn()
        return self if device is None else device.handle(self)


class ByVariant(_Attribute, Generic[P_co]):
    """A point whose facts differ between variants: on a device it is the one of the device's variant."""

    def __init__(self, axis: str, points: Mapping[str, P_co]) -> None:
        self.axis = axis
        self.points = points

    def __set_name__(self, owner: type, name: str) -> None:
        self.old_name = name

    @overload
    def __get__(self, device: None, owner: object) -> ByVariant[P_co]: ...
    @overload
    def __get__(self: ByVariant[ReadWrite[R, W]], device: Device, owner: object) -> ReadWriteHandle[R, W]: ...
    @overload
    def __get__(self: ByVariant[ReadWrite[R, W]], device: AsyncDevice, owner: object) -> AsyncReadWriteHandle[R, W]: ...
    @overload
    def __get__(self: ByVariant[ReadOnly[R]], device: Device, owner: object) -> ReadHandle[R]: ...
    @overload
    def __get__(self: ByVariant[ReadOnly[R]], device: AsyncDevice, owner: object) -> AsyncReadHandle[R]: ...
    @overload
    def __get__(self: ByVariant[WriteOnly[W]], device: Device, owner: object) -> WriteHandle[W]: ...
    @overload
    def __get__(self: ByVariant[WriteOnly[W]], device: AsyncDevice, owner: object) -> AsyncWriteHandle[W]: ...
    def __get__(self, device: Device | AsyncDevice | None, owner: object) -> object:
        self._warn()
        if device is None:
            return self
        chosen = device.variants.get(self.axis)
        if chosen is None:
            raise AccessError(f"{self.old_name} depends on {self.axis}: pass it when the device is made")
        if chosen not in self.points:
            raise AccessError(f"{self.old_name} does not exist for {self.axis} {chosen}")
        return device.handle(self.points[chosen])


Named = TypeVar("Named", bound=_Attribute)


def renamed(attribute: Named, new_name: str) -> Named:
    """The same attribute for its old name; using it warns."""
    alias = copy.copy(attribute)
    alias.new_name = new_name
    return alias
