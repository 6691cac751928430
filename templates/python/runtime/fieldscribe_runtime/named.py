# SPDX-License-Identifier: 0BSD
"""Numbers that a manual names, and all others beside them: the enums of generated devices."""

from __future__ import annotations

import enum
import warnings
from typing import TYPE_CHECKING, Any, Self

if TYPE_CHECKING:
    from collections.abc import Callable


class NamedNumber(enum.IntEnum):
    """An enum that is open: `RunSource(77)` is a `RunSource` too, though no manual names it.

    So what a device sends keeps its type and its number. It compares and hashes as that number.
    """

    @classmethod
    def _missing_(cls, value: object) -> Self | None:
        """A member for a number without a name; it is in no list of members."""
        if not isinstance(value, int):
            return None
        member = int.__new__(cls, value)
        member._name_ = f"{cls.__name__}({value})"
        member._value_ = int(value)
        return member

    @property
    def is_named(self) -> bool:
        """Whether the manual names this number."""
        return self._name_ in type(self).__members__

    def __repr__(self) -> str:
        return super().__repr__() if self.is_named else self._name_

    def __str__(self) -> str:
        return self._name_.lower() if self.is_named else str(int(self))

    def __format__(self, spec: str) -> str:
        return format(int(self), spec) if spec else str(self)


def renamed_classes(module: str, **classes: type) -> Callable[[str], Any]:
    """What a module does for a name that it lacks: the classes by their old names, with a warning."""

    def renamed_class(name: str) -> Any:
        if name not in classes:
            raise AttributeError(f"module {module!r} has no attribute {name!r}", name=name)
        text = f"{name} is now called {classes[name].__name__}"
        warnings.warn(text, DeprecationWarning, stacklevel=2)
        return classes[name]

    return renamed_class
