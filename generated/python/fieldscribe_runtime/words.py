# SPDX-License-Identifier: 0BSD
"""Flags inside a word: named bits and bit groups of an IntFlag, printed and composed by name."""

from __future__ import annotations

import functools
import operator
from typing import TYPE_CHECKING, Any, Generic, TypeVar, overload

from .arguments import shown, whole
from .errors import RangeError

if TYPE_CHECKING:
    from .named import NamedNumber

N = TypeVar("N", bound=int)
M = TypeVar("M", bound="NamedNumber")


class Flag:
    """One bit of a word; on a word it is True if the bit is `active`."""

    width = 1

    def __init__(self, low: int, *, active: int = 1) -> None:
        self.low = low
        self.active = active

    @overload
    def __get__(self, word: None, owner: object) -> Flag: ...
    @overload
    def __get__(self, word: int, owner: object) -> bool: ...
    def __get__(self, word: int | None, owner: object) -> Flag | bool:
        return self if word is None else self.number(word) == self.active

    def number(self, word: int) -> int:
        """Return the bit as it is in the word, 0 or 1."""
        return word >> self.low & 1

    def place(self, true: bool) -> int:
        """Return the bit at its place, for the name to be true or false."""
        return (self.active if true else 1 - self.active) << self.low

    def told(self, name: str, word: int) -> str:
        """Return the name if it is true in a word, else an empty text."""
        return name if self.number(word) == self.active else ""


class Field(Generic[N]):
    """Several bits of a word; on a word it is their number, as a member of `names` if given."""

    @overload
    def __init__(self: Field[int], low: int, width: int) -> None: ...
    @overload
    def __init__(self: Field[M], low: int, width: int, names: type[M]) -> None: ...
    def __init__(self, low: int, width: int, names: type[Any] | None = None) -> None:
        self.low = low
        self.width = width
        self.names: type[N] | None = names

    @overload
    def __get__(self, word: None, owner: object) -> Field[N]: ...
    @overload
    def __get__(self, word: int, owner: object) -> N: ...
    def __get__(self, word: int | None, owner: object) -> Field[N] | N | int:
        return self if word is None else self._named(word)

    def _named(self, word: int) -> N | int:
        number = self.number(word)
        return number if self.names is None else self.names(number)

    def number(self, word: int) -> int:
        """Return the bits as they are in the word, right-aligned."""
        return word >> self.low & (1 << self.width) - 1

    def place(self, number: int) -> int:
        """Return a number at the field's place, for combining with other flags."""
        plain = whole(number)
        if plain >> self.width:
            raise RangeError(f"{shown(plain)} does not fit into {self.width} bits")
        return plain << self.low

    def told(self, name: str, word: int) -> str:
        """Return the name with its number in a word."""
        return f"{name}={self._named(word)}"


class Word:
    """A word of flags, printed as the names of its true flags."""

    if TYPE_CHECKING:

        def __index__(self) -> int: ...

    @staticmethod
    def _joined(*parts: int) -> int:
        """Return all parts combined into one number."""
        return functools.reduce(operator.or_, parts, 0)

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self}>"

    def __str__(self) -> str:
        number = int(self)
        flags = {name: flag for base in type(self).__mro__ for name, flag in vars(base).items()}
        told = [flag.told(name, number) for name, flag in flags.items() if isinstance(flag, (Flag, Field))]
        names = ", ".join(filter(None, told))
        return f"0x{number:04X} ({names})" if names else f"0x{number:04X}"

    def __format__(self, spec: str) -> str:
        return format(int(self), spec) if spec else str(self)
