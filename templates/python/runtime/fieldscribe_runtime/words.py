# SPDX-License-Identifier: 0BSD
"""Flags inside a word: named bits and bit groups of an IntFlag."""

from __future__ import annotations

import enum
from typing import Generic, Never, TypeVar, overload

E = TypeVar("E", bound=enum.IntEnum)


class Flag:
    """One bit of a word; on a word it is True when the name is true (`active` is the bit that means so)."""

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
        """The bit as it is in the word, 0 or 1."""
        return word >> self.low & 1


class Field(Generic[E]):
    """Several bits of a word; on a word it is their number, by name where it has one."""

    @overload
    def __init__(self: Field[Never], low: int, width: int) -> None: ...
    @overload
    def __init__(self, low: int, width: int, names: type[E]) -> None: ...
    def __init__(self, low: int, width: int, names: type[E] | None = None) -> None:
        self.low = low
        self.width = width
        self.names = names

    @overload
    def __get__(self, word: None, owner: object) -> Field[E]: ...
    @overload
    def __get__(self, word: int, owner: object) -> E | int: ...
    def __get__(self, word: int | None, owner: object) -> Field[E] | E | int:
        if word is None:
            return self
        number = self.number(word)
        try:
            return number if self.names is None else self.names(number)
        except ValueError:
            return number

    def number(self, word: int) -> int:
        """The bits as they are in the word, right-aligned."""
        return word >> self.low & (1 << self.width) - 1

    def place(self, number: int) -> int:
        """A number at the field's place, for combining with other flags."""
        if number >> self.width:
            raise ValueError(f"{number} does not fit into {self.width} bits")
        return int(number) << self.low
