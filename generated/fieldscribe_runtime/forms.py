# SPDX-License-Identifier: 0BSD
"""What raw numbers mean: one form per kind of point, each turning values into raw numbers and back without any I/O."""

from __future__ import annotations

import enum
import math
import operator
import struct
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Generic, TypeVar, TYPE_CHECKING

from .errors import (
    CodecError,
    NotANumberError,
    NoValueError,
    RangeError,
    UnknownValueError,
)
from .rules import NO_RAWS, Bound, Case, Raws, Rule, chosen, high_end, low_end

if TYPE_CHECKING:
    from collections.abc import Mapping

R = TypeVar("R")
W = TypeVar("W")
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


class Form(ABC, Generic[R_co, W_contra]):
    """What raw numbers mean: R is what decoding gives, W what encoding takes."""

    wire: Type
    needs: tuple[str, ...] = ()
    decimals: int = 0
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
        return self.checked(operator.index(count), allowed, raws)

    def checked(self, raw: int, allowed: Allowed, raws: Raws) -> int | None:
        """The same number; None if it may not be written."""
        fits = any(low_end(low, raws) <= raw <= high_end(high, raws) for low, high in allowed)
        return raw if fits else None

    def shown(self, raw: int, raws: Raws) -> str:
        """The raw number as people read it, in the unit."""
        return str(raw)

    def choices(self) -> str | None:
        """What may be written, in words, where it is not the range that decides."""
        return None

    def name_of(self, raw: int) -> str | None:
        """The name of a raw number, where it has one."""
        return None


class Integer(Form[int, int]):
    """The raw number is the value."""

    def __init__(self, wire: Type) -> None:
        self.wire = wire

    def decode(self, raw: int, raws: Raws) -> int:
        return raw

    def encode(self, value: int, allowed: Allowed, raws: Raws) -> int | None:
        return self.checked(operator.index(value), allowed, raws)


class Bit(Form[bool, bool]):
    """A coil or a single bit."""

    wire = BIT

    def decode(self, raw: int, raws: Raws) -> bool:
        return bool(raw)

    def encode(self, value: bool, allowed: Allowed, raws: Raws) -> int | None:
        return self.checked(operator.index(value), allowed, raws)


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
        try:
            return self.names(raw)
        except ValueError:
            return raw

    def encode(self, value: E | int, allowed: Allowed, raws: Raws) -> int | None:
        return self.checked(operator.index(value), allowed, raws)

    def checked(self, raw: int, allowed: Allowed, raws: Raws) -> int | None:
        if self.closed and not isinstance(self.decode(raw, raws), self.names):
            return None
        return super().checked(raw, allowed, raws)

    def name_of(self, raw: int) -> str | None:
        value = self.decode(raw, NO_RAWS)
        return value.name.lower() if isinstance(value, self.names) else None

    def choices(self) -> str | None:
        named = ", ".join(f"{entry.value} {entry.name.lower()}" for entry in self.names)
        return f"none of {named}" if self.closed else None


class Flags(Form[F, F]):
    """Named bits in a word; bits without a name survive."""

    names: type[F]

    def __init__(self, wire: Type, names: type[F]) -> None:
        self.wire = wire
        self.names = names

    def decode(self, raw: int, raws: Raws) -> F:
        return self.names(raw & (1 << self.wire.bits) - 1)

    def encode(self, value: F, allowed: Allowed, raws: Raws) -> int | None:
        raw = operator.index(value)
        if self.wire.signed and raw >> self.wire.bits == 0:
            raw = self.wire.number(raw, self.wire.bits)
        return self.checked(raw, allowed, raws)


class Scaled(Form[float, float]):
    """A quantity: raw = value by a rule, or by the first of several cases that fits."""

    def __init__(self, wire: Type, rule: Rule | tuple[Case, ...], *, decimals: int) -> None:
        self.wire = wire
        self.rule = rule
        self.decimals = decimals
        cases = (Case(None, None, rule),) if isinstance(rule, Rule) else rule
        names = [name for case in cases for name in (case.point, *(factor.point for factor in case.rule.factors))]
        self.needs = tuple(dict.fromkeys(name for name in names if name is not None))

    def _rule(self, raws: Raws) -> Rule:
        return self.rule if isinstance(self.rule, Rule) else chosen(self.rule, raws)

    def decode(self, raw: int, raws: Raws) -> float:
        return self._rule(raws).decode(raw, raws)

    def encode(self, value: float, allowed: Allowed, raws: Raws) -> int | None:
        if math.isnan(value):
            raise NotANumberError("the value is NaN")
        raw = self._rule(raws).encode(value, raws)
        return None if raw is None else self.checked(raw, allowed, raws)

    def decode_count(self, raw: int, raws: Raws) -> int:
        return self._rule(raws).decode_count(raw, self.decimals, raws)

    def encode_count(self, count: int, allowed: Allowed, raws: Raws) -> int | None:
        raw = self._rule(raws).encode_count(operator.index(count), self.decimals, raws)
        return self.checked(raw, allowed, raws)

    def shown(self, raw: int, raws: Raws) -> str:
        return f"{self.decode(raw, raws):.12g}"


class Floating(Form[float, float]):
    """An IEEE 754 number (`F32` or `F64`): the raw number is its bit pattern; limits are in the unit."""

    def __init__(self, wire: Type, *, units: tuple[tuple[float, float], ...] = ()) -> None:
        self.wire = wire
        self.units = units
        self._pack, self._word = ("<f", "<I") if wire.bits == 32 else ("<d", "<Q")

    def decode(self, raw: int, raws: Raws) -> float:
        value: float = struct.unpack(self._pack, struct.pack(self._word, raw))[0]
        return value

    def encode(self, value: float, allowed: Allowed, raws: Raws) -> int | None:
        if not self._fits(value):
            return None
        try:
            pattern: int = struct.unpack(self._word, struct.pack(self._pack, value))[0]
        except OverflowError:
            return None
        return pattern

    def _fits(self, value: float) -> bool:
        if math.isnan(value):
            raise NotANumberError("the value is NaN")
        inside = any(low <= value <= high for low, high in self.units) if self.units else True
        return inside and math.isfinite(value)

    def checked(self, raw: int, allowed: Allowed, raws: Raws) -> int | None:
        inside = 0 <= raw < 1 << self.wire.bits
        return raw if inside and self._fits(self.decode(raw, raws)) else None

    def decode_count(self, raw: int, raws: Raws) -> int:
        raise TypeError("a floating-point pattern has no integer path")

    def encode_count(self, count: int, allowed: Allowed, raws: Raws) -> int | None:
        raise TypeError("a floating-point pattern has no integer path")

    def shown(self, raw: int, raws: Raws) -> str:
        return f"{self.decode(raw, raws):.12g}"

    def choices(self) -> str | None:
        return "outside " + " or ".join(f"{low:.12g}..{high:.12g}" for low, high in self.units) if self.units else None


class OrNone(Form[R | None, W]):
    """Another form in which some raw numbers, by name, mean "there is no value"; those decode to None."""

    def __init__(self, form: Form[R, W], no_value: Mapping[str, tuple[int, int]]) -> None:
        self.form = form
        self.no_value = no_value
        self.wire = form.wire
        self.needs = form.needs
        self.decimals = form.decimals
        self.names = form.names
        self.refused = form.refused

    def _missing(self, raw: int) -> bool:
        return any(low <= raw <= high for low, high in self.no_value.values())

    def decode(self, raw: int, raws: Raws) -> R | None:
        return None if self._missing(raw) else self.form.decode(raw, raws)

    def decode_count(self, raw: int, raws: Raws) -> int:
        """As in the form; raises NoValueError, because a count has no room for "no value"."""
        if self._missing(raw):
            raise NoValueError(f"raw {raw} means that there is no value")
        return self.form.decode_count(raw, raws)

    def encode(self, value: W, allowed: Allowed, raws: Raws) -> int | None:
        return self.form.encode(value, allowed, raws)

    def encode_count(self, count: int, allowed: Allowed, raws: Raws) -> int | None:
        return self.form.encode_count(count, allowed, raws)

    def checked(self, raw: int, allowed: Allowed, raws: Raws) -> int | None:
        return self.form.checked(raw, allowed, raws)

    def shown(self, raw: int, raws: Raws) -> str:
        return self.form.shown(raw, raws)

    def choices(self) -> str | None:
        return self.form.choices()

    def name_of(self, raw: int) -> str | None:
        return self.form.name_of(raw)
