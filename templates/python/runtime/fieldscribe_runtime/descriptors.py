# SPDX-License-Identifier: 0BSD
"""Points as attributes: on the class they only convert, on a device they also read and write."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any, ClassVar, Generic, TypeVar, overload

from .errors import AbsentError, undecided
from .facts import Facts
from .guided import Guided
from .handles import (
    AsyncHandle,
    AsyncReadHandle,
    AsyncReadWriteHandle,
    AsyncWriteHandle,
    Handle,
    ReadHandle,
    ReadWriteHandle,
    WriteHandle,
)
from .points import Decoding, Encoding, Point
from .wrappers import with_fixed

if TYPE_CHECKING:
    from collections.abc import Mapping
    from typing import Never, Self, Unpack

    from .device import AnyAsyncDevice, AnyDevice
    from .facts import FactArguments
    from .forms import Decodes, Encodes, Form

R_co = TypeVar("R_co", covariant=True)
W_contra = TypeVar("W_contra", contravariant=True)
P_co = TypeVar("P_co", bound="PointAttribute[Any, Any]", covariant=True)
H = TypeVar("H")
A = TypeVar("A")
H_co = TypeVar("H_co", covariant=True)
A_co = TypeVar("A_co", covariant=True)


class _Attribute:
    """An attribute of a table of points."""

    name: str
    """The name of the attribute."""

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name

    def __set__(self, device: Any, value: Never) -> None:
        raise AttributeError("a point is not assigned to: use its write method")


class PointAttribute(_Attribute, Point, Generic[H_co, A_co]):
    """A point as the attribute of a table of points: on a device it is a handle (H blocking, A async)."""

    handle: ClassVar[type[Handle]]
    async_handle: ClassVar[type[AsyncHandle]]

    def __init__(self, form: Any, **facts: Unpack[FactArguments]) -> None:
        self.facts = Facts(**facts)
        fixed = self.facts.fixed if self.facts.bits is None else None
        self._form = with_fixed(form, *fixed) if fixed else form

    def __set_name__(self, owner: type, name: str) -> None:
        super().__set_name__(owner, name)
        self.facts.item = name.rstrip("_")
        self.facts.name = self.facts.name or self.facts.item

    @overload
    def __get__(self, device: None, owner: object) -> Self: ...
    @overload
    def __get__(self, device: AnyDevice, owner: object) -> H_co: ...
    @overload
    def __get__(self, device: AnyAsyncDevice, owner: object) -> A_co: ...
    def __get__(self, device: AnyDevice | AnyAsyncDevice | None, owner: object) -> object:
        return self if device is None else device._bound(self)


class ReadOnly(PointAttribute[ReadHandle[R_co], AsyncReadHandle[R_co]], Decoding[R_co]):
    """A point that can only be read."""

    handle = ReadHandle
    async_handle = AsyncReadHandle

    def __init__(self, form: Decodes[R_co], **facts: Unpack[FactArguments]) -> None:
        super().__init__(form, **facts)


class WriteOnly(PointAttribute[WriteHandle[W_contra], AsyncWriteHandle[W_contra]], Encoding[W_contra]):
    """A point that can only be written."""

    handle = WriteHandle
    async_handle = AsyncWriteHandle

    def __init__(self, form: Encodes[W_contra], **facts: Unpack[FactArguments]) -> None:
        super().__init__(form, **facts)


class ReadWrite(
    PointAttribute[ReadWriteHandle[R_co, W_contra], AsyncReadWriteHandle[R_co, W_contra]],
    Decoding[R_co],
    Encoding[W_contra],
):
    """A point that can be read and written."""

    handle = ReadWriteHandle
    async_handle = AsyncReadWriteHandle

    def __init__(self, form: Form[R_co, W_contra], **facts: Unpack[FactArguments]) -> None:
        super().__init__(form, **facts)


class ByVariant(_Attribute, Guided, Generic[P_co]):
    """A point whose facts differ between variants: on a device it is the point of the device's variant."""

    def __init__(self, axis: str, points: Mapping[str, P_co]) -> None:
        self.axis = axis
        self.points = points

    @overload
    def __get__(self, device: None, owner: object) -> ByVariant[P_co]: ...
    @overload
    def __get__(self: ByVariant[PointAttribute[H, A]], device: AnyDevice, owner: object) -> H: ...
    @overload
    def __get__(self: ByVariant[PointAttribute[H, A]], device: AnyAsyncDevice, owner: object) -> A: ...
    def __get__(self, device: AnyDevice | AnyAsyncDevice | None, owner: object) -> object:
        if device is None:
            return self
        chosen = device.variants.get(self.axis)
        if chosen is None:
            raise undecided(AbsentError(f"{self.name} depends on {self.axis}"), self.axis)
        if chosen not in self.points:
            raise AbsentError(f"{self.name} does not exist for {self.axis} {chosen}")
        return device._bound(self.points[chosen])

    def _guide(self) -> str:
        which = "\n".join([f"- {self.axis} {value}: {point.label}" for value, point in self.points.items()])
        text = f"This depends on {self.axis}, which is passed when the device is made; use help() on each:"
        return f"{self.name.rstrip('_')}: {text}\n\n{which}"

    def __repr__(self) -> str:
        items = " or ".join(point.facts.item for point in self.points.values())
        return f"<{type(self).__name__} {self.name}: {items}, by {self.axis}>"


Attribute = TypeVar("Attribute", bound=_Attribute)


class Renamed(_Attribute):
    """The old name of an attribute; using it warns."""

    def __init__(self, attribute: Any, new_name: str) -> None:
        self.attribute = attribute
        self.new_name = new_name

    def __get__(self, device: object, owner: object) -> Any:
        self.warn(stacklevel=3)
        return self.attribute.__get__(device, owner)

    def warn(self, stacklevel: int) -> None:
        """Warn with the new name."""
        text = f"{self.name} is now called {self.new_name}"
        warnings.warn(text, DeprecationWarning, stacklevel=stacklevel)


def renamed(attribute: Attribute, new_name: str) -> Attribute:
    """Return the same attribute for its old name; using it warns."""
    alias: Any = Renamed(attribute, new_name)
    made: Attribute = alias
    return made
