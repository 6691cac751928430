# SPDX-License-Identifier: 0BSD
"""What raw numbers mean: forms turn values into raw numbers and back without any I/O."""

from __future__ import annotations

import enum
import operator
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import TYPE_CHECKING, Generic, TypeVar

from .errors import (
    CodecError,
    RangeError,
    UnknownValueError,
    WrongTypeError,
)
from .rules import NO_RAWS, Bound, Raws, high_end, low_end

if TYPE_CHECKING:
    from collections.abc import Mapping

R_co = TypeVar("R_co", covariant=True)
W_contra = TypeVar("W_contra", contravariant=True)
E = TypeVar("E", bound=enum.IntEnum)
F = TypeVar("F", bound=enum.IntFlag)

Allowed = tuple[tuple[Bound, Bound], ...]
"""Closed intervals of raw numbers that may be written."""


@dataclass(frozen=True, slots=True)
class Type:
    """A wire type: how many bits, and whether they are two's complement."""

    bits: int
    signed: bool = False

    def limits(self, width: int) -> tuple[int, int]:
        """The smallest and the largest number in `width` bits of this type."""
        return (-(1 << width - 1), (1 << width - 1) - 1) if self.signed else (0, (1 << width) - 1)

    def number(self, pattern: int, width: int) -> int:
        """The number that the lowest `width` bits of `pattern` hold."""
        pattern &= (1 << width) - 1
        return pattern - (1 << width) if self.signed and pattern >> width - 1 else pattern


BIT = Type(1)
U8, U16, U32, U64 = Type(8), Type(16), Type(32), Type(64)
S8, S16, S32, S64 = Type(8, True), Type(16, True), Type(32, True), Type(64, True)
F32, F64 = Type(32), Type(64)


def whole(number: int) -> int:
    """The number itself as a plain int.

    Raises RangeError for a number that is no integer, and WrongTypeError for what is no number: a bool too, since True
    for a number is a mistake more often than a 1.
    """
    if isinstance(number, bool):
        raise WrongTypeError(f"takes a number, not {number}")
    try:
        return operator.index(number)
    except TypeError:
        if hasattr(number, "__float__"):
            raise RangeError(f"{number!r} is no integer") from None
        raise WrongTypeError(f"takes an integer, not {number!r}") from None


class Decodes(Generic[R_co]):
    """A form by what decoding gives alone, so that type checkers infer it from that alone."""


class Encodes(Generic[W_contra]):
    """A form by what encoding takes alone."""


class Form(Decodes[R_co], Encodes[W_contra], ABC, Generic[R_co, W_contra]):
    """What raw numbers mean: R is what decoding gives, W what encoding takes."""

    wire: Type
    needs: tuple[str, ...] = ()
    decimals: int | None = 0
    no_value: Mapping[str, tuple[int, int]] = {}
    names: type[enum.IntEnum | enum.IntFlag] | None = None
    refused: type[CodecError] = RangeError

    @abstractmethod
    def decode(self, raw: int, raws: Raws) -> R_co:
        """The value that a raw number means."""

    @abstractmethod
    def encode(self, value: W_contra, allowed: Allowed, raws: Raws) -> int | None:
        """The raw number for a value; None if it may not be written."""

    def decode_count(self, raw: int, raws: Raws) -> int:
        """The value as an integer count of 10^-decimals units."""
        return raw

    def encode_count(self, count: int, allowed: Allowed, raws: Raws) -> int | None:
        """The raw number for an integer count of 10^-decimals units; None if it may not be written."""
        return self.checked(whole(count), allowed, raws)

    def checked(self, raw: int, allowed: Allowed, raws: Raws) -> int | None:
        """The same number; None if it may not be written."""
        ends = [(low_end(low, raws), high_end(high, raws)) for low, high in allowed]  # all, whichever holds
        return raw if any(low <= raw <= high for low, high in ends) else None

    def limits(self, width: int) -> tuple[int, int]:
        """The least and the greatest number of `width` bits that the form knows, where nothing else bounds them."""
        return self.wire.limits(width)

    def shown(self, raw: int, raws: Raws) -> str:
        """The raw number as people read it, in the unit."""
        return str(raw)

    def same(self, raw: int, other: int) -> bool:
        """Whether two raw numbers mean the same."""
        return raw == other

    def choices(self, unit: str) -> str | None:
        """What may be written, in words, where it is not the range of raw numbers that decides; limits with `unit`."""
        return None

    def name_of(self, raw: int) -> str | None:
        """The name of a raw number, where it has one."""
        return None


class Integer(Form[int, int]):
    """The raw number is the value."""

    def __init__(self, wire: Type) -> None:
        self.wire = wire

    def decode(self, raw: int, raws: Raws) -> int:
        """The raw number itself."""
        return raw

    def encode(self, value: int, allowed: Allowed, raws: Raws) -> int | None:
        """The value itself."""
        return self.checked(whole(value), allowed, raws)


class Bit(Form[bool, bool]):
    """A coil or a single bit."""

    wire = BIT

    def decode(self, raw: int, raws: Raws) -> bool:
        """Whether the bit is 1."""
        return bool(raw)

    def encode(self, value: bool, allowed: Allowed, raws: Raws) -> int | None:
        """1 for True."""
        return self.checked(int(value) if isinstance(value, bool) else whole(value), allowed, raws)


class Named(Form[E | int, E | int]):
    """An enum; numbers without a name survive as they are. `closed`: only its own numbers may be written."""

    names: type[E]

    def __init__(self, wire: Type, names: type[E], *, closed: bool = False) -> None:
        self.wire = wire
        self.names = names
        self.closed = closed
        if closed:
            self.refused = UnknownValueError

    def decode(self, raw: int, raws: Raws) -> E | int:
        """The member, or the bare number where there is none."""
        try:
            return self.names(raw)
        except ValueError:
            return raw

    def encode(self, value: E | int, allowed: Allowed, raws: Raws) -> int | None:
        """The member's number; a member of another enum raises UnknownValueError."""
        if isinstance(value, enum.Enum) and not isinstance(value, self.names):
            raise UnknownValueError(f"{value!r} is no {self.names.__name__}")
        return self.checked(whole(value), allowed, raws)

    def checked(self, raw: int, allowed: Allowed, raws: Raws) -> int | None:
        """The same number if it is named (for a closed enum) and in range."""
        if self.closed and not isinstance(self.decode(raw, raws), self.names):
            return None
        return super().checked(raw, allowed, raws)

    def limits(self, width: int) -> tuple[int, int]:
        """The ends of a closed enum, else of the type."""
        return (min(self.names).value, max(self.names).value) if self.closed else super().limits(width)

    def name_of(self, raw: int) -> str | None:
        """The member's name in lower case."""
        value = self.decode(raw, NO_RAWS)
        return value.name.lower() if isinstance(value, self.names) else None

    def choices(self, unit: str) -> str | None:
        """The named numbers of a closed enum."""
        named = ", ".join(f"{entry.value} {entry.name.lower()}" for entry in self.names)
        return f"none of {named}" if self.closed else None


class Flags(Form[F, F]):
    """Named bits in a word; bits without a name survive."""

    names: type[F]

    def __init__(self, wire: Type, names: type[F]) -> None:
        self.wire = wire
        self.names = names

    def decode(self, raw: int, raws: Raws) -> F:
        """All bits of the word."""
        return self.names(raw & (1 << self.wire.bits) - 1)

    def encode(self, value: F, allowed: Allowed, raws: Raws) -> int | None:
        """The word as the type holds it; flags of another word raise UnknownValueError."""
        if isinstance(value, enum.Enum) and not isinstance(value, self.names):
            raise UnknownValueError(f"{value!r} is no {self.names.__name__}")
        raw = whole(value)
        if self.wire.signed and raw >> self.wire.bits == 0:
            raw = self.wire.number(raw, self.wire.bits)
        return self.checked(raw, allowed, raws)
