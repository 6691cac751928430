# SPDX-License-Identifier: 0BSD
"""The enums of generated devices: they have the manual's names, and hold any other number too."""

from __future__ import annotations

import enum
import warnings
from typing import TYPE_CHECKING, Any, Self

if TYPE_CHECKING:
    from collections.abc import Callable


class NamedNumber(enum.IntEnum):
    """An open enum: `RunSource(77)` is a `RunSource` even if the manual has no name for 77.

    So a received number keeps its type. A member compares and hashes as its number.
    """

    @classmethod
    def _missing_(cls, value: object) -> Self | None:
        """Return a member for a number without a name; iterating over the enum does not yield it."""
        if not isinstance(value, int):
            return None
        member = int.__new__(cls, value)
        member._name_ = f"{cls.__name__}({value})"
        member._value_ = int(value)
        return member

    def __reduce_ex__(self, protocol: object) -> tuple[type[Self], tuple[int]]:
        """Copy and pickle by number: Python 3.11.2 uses the name, which some members do not have."""
        return type(self), (int(self),)

    @property
    def is_named(self) -> bool:
        """True if the manual names this number."""
        return self._name_ in type(self).__members__

    def __repr__(self) -> str:
        return super().__repr__() if self.is_named else self._name_

    def __str__(self) -> str:
        return self._name_.lower() if self.is_named else str(int(self))

    def __format__(self, spec: str) -> str:
        return format(int(self), spec) if spec else str(self)


def renamed_classes(module: str, **classes: type) -> Callable[[str], Any]:
    """Return a module's `__getattr__` that finds renamed classes by their old names, with a DeprecationWarning."""

    def renamed_class(name: str) -> Any:
        if name not in classes:
            raise AttributeError(f"module {module!r} has no attribute {name!r}", name=name)
        text = f"{name} is now called {classes[name].__name__}"
        warnings.warn(text, DeprecationWarning, stacklevel=2)
        return classes[name]

    return renamed_class
