# SPDX-License-Identifier: 0BSD
"""The meaning of raw numbers: forms convert values to raw numbers and back, without I/O."""

from __future__ import annotations

import enum
from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from .arguments import integral, shown, whole
from .errors import CodecError, RangeError, UnknownValueError, WrongTypeError
from .fast import checked, chosen, itself, listed, same
from .records import Record
from .rules import Bound, Raws, decimal_text, high_end, low_end
from .special import NO_CODES

if TYPE_CHECKING:
    from collections.abc import Sequence

    from .fast import Way
    from .named import NamedNumber
    from .special import Codes

R_co = TypeVar("R_co", covariant=True)
W_contra = TypeVar("W_contra", contravariant=True)
E = TypeVar("E", bound="NamedNumber")
F = TypeVar("F", bound=enum.IntFlag)
T = TypeVar("T")

Allowed = tuple[tuple[Bound, Bound], ...]
"""The closed intervals of raw numbers that may be written."""


class Type(Record):
    """A wire type: the number of bits, and whether they are two's complement."""

    bits: int
    signed: bool = False
    low_byte_first: bool = False
    coding: str = ""

    def limits(self, width: int) -> tuple[int, int]:
        """Return the smallest and the largest number in `width` bits of this type."""
        return (-(1 << width - 1), (1 << width - 1) - 1) if self.signed else (0, (1 << width) - 1)

    def number(self, pattern: int, width: int) -> int:
        """Return the number in the lowest `width` bits of `pattern`."""
        pattern &= (1 << width) - 1
        if self.coding == "bcd":
            digits = f"{pattern:0{width // 4}x}"
            return int(digits) if digits.isdecimal() else max(pattern, 10 ** (width // 4))
        if self.coding:
            sign = 1 << width - 1
            return sign - pattern if pattern & sign else pattern
        return pattern - (1 << width) if self.signed and pattern >> width - 1 else pattern

    def pattern(self, raw: int, width: int) -> int:
        """Return the bits of a number; the bits above `width` extend its sign."""
        if self.coding == "bcd":
            return int(str(raw), 16) if raw < 10 ** (width // 4) else raw
        if self.coding:
            return abs(raw) & (1 << width - 1) - 1 | (raw < 0) << width - 1
        return raw

    @property
    def plain(self) -> bool:
        """True if the bits are the number, in the order of the wire."""
        return not self.low_byte_first and not self.coding

    def ordered(self, words: Sequence[int]) -> Sequence[int]:
        """Return words with their high byte first from words as on the wire, and back."""
        return [(word & 0xFF) << 8 | word >> 8 for word in words] if self.low_byte_first else words


BIT = Type(1)
U8, U16, U32, U64 = Type(8), Type(16), Type(32), Type(64)
S8, S16, S32, S64 = Type(8, True), Type(16, True), Type(32, True), Type(64, True)
F32, F64 = Type(32), Type(64)


class Decodes(Generic[R_co]):
    """The decoding side of a form, so that type checkers infer R from it alone."""


class Encodes(Generic[W_contra]):
    """The encoding side of a form."""


class Form(Decodes[R_co], Encodes[W_contra], ABC, Generic[R_co, W_contra]):
    """The meaning of raw numbers: decoding returns R, encoding takes W."""

    wire: Type
    needs: tuple[str, ...] = ()
    decimals: int | None = 0
    codes: Codes = NO_CODES
    names: type[enum.IntEnum | enum.IntFlag] | None = None
    refused: type[CodecError] = RangeError

    @abstractmethod
    def decode(self, raw: int, raws: Raws) -> R_co:
        """Return the value of a raw number."""

    @abstractmethod
    def converted(self, value: W_contra, raws: Raws) -> int | None:
        """Return the raw number for a value, even if it may not be written; None if there is none."""

    def quick_decode(self, low: int, high: int, slow: Way) -> Way:
        """Return a function that decodes raw numbers from `low` to `high` itself, and others by `slow`."""
        sure = self.sure_decode(low, high, slow)
        return slow if sure is slow else checked(sure, (low, high), self.needs, slow)

    def sure_decode(self, low: int, high: int, slow: Way) -> Way:
        """Return a decoder for numbers that are known to be in `low` to `high`; it takes `raws` by position."""
        del low, high
        return slow

    def quick_encode(self, allowed: Allowed, slow: Way) -> Way:
        """Return a function that encodes usual values itself, and others by `slow`."""
        del allowed
        return slow

    def encode(self, value: W_contra, allowed: Allowed, raws: Raws) -> int | None:
        """Return the raw number for a value; None if it may not be written."""
        raw = self.converted(value, raws)
        return None if raw is None else self.checked(raw, allowed, raws)

    def decode_count(self, raw: int, raws: Raws) -> int:
        """Return the value as an integer count of 10^-decimals units."""
        return raw

    def converted_count(self, count: int, raws: Raws) -> int:
        """Return the raw number for an integer count of 10^-decimals units, even if it may not be written."""
        return whole(count)

    def encode_count(self, count: int, allowed: Allowed, raws: Raws) -> int | None:
        """Return the raw number for an integer count of 10^-decimals units; None if it may not be written."""
        return self.checked(self.converted_count(count, raws), allowed, raws)

    def checked(self, raw: int, allowed: Allowed, raws: Raws) -> int | None:
        """Return the number; None if it may not be written."""
        ends = [(low_end(low, raws), high_end(high, raws)) for low, high in allowed]  # all: any may raise
        return raw if any(low <= raw <= high for low, high in ends) else None

    def limits(self, width: int) -> tuple[int, int]:
        """Return the least and the greatest number of the form in `width` bits."""
        return self.wire.limits(width)

    def bounds(self, low: int, high: int) -> tuple[float, float] | None:
        """Return the least and the greatest quantity for raw numbers of a range; None if there are none."""
        return None

    def shown(self, raw: int, raws: Raws, display: int | None = None) -> str:
        """Return the value of a raw number as text without the unit; a quantity with `display` decimals, if given."""
        return str(raw) if display is None else decimal_text(raw, 1, display)

    def same(self, raw: int, other: int) -> bool:
        """Return True if two raw numbers mean the same."""
        return raw == other

    def choices(self, unit: str) -> str | None:
        """Return why a value is refused, if not for the range of raw numbers; limits have `unit`."""
        return None

    def name_of(self, raw: int) -> str | None:
        """Return the name of a raw number; None if it has none."""
        return None


def fixed_ends(allowed: Allowed) -> tuple[int, int] | None:
    """Return the ends of the allowed numbers if they are one fixed interval, else None."""
    if len(allowed) != 1:
        return None
    low, high = allowed[0]
    return (low, high) if isinstance(low, int) and isinstance(high, int) else None


class Integer(Form[int, int]):
    """The raw number is the value."""

    def __init__(self, wire: Type) -> None:
        self.wire = wire

    def sure_decode(self, low: int, high: int, slow: Way) -> Way:
        """Return the raw number itself."""
        del low, high, slow
        return itself

    def quick_encode(self, allowed: Allowed, slow: Way) -> Way:
        """Return the value itself."""
        ends = fixed_ends(allowed)
        return same(*ends, slow) if ends else slow

    def decode(self, raw: int, raws: Raws) -> int:
        """Return the raw number itself."""
        return raw

    def converted(self, value: int, raws: Raws) -> int | None:
        """Return the value itself."""
        return integral(value)

    def bounds(self, low: int, high: int) -> tuple[float, float] | None:
        """Return the raw numbers."""
        return low, high


class Bit(Form[bool, bool]):
    """A coil or a single bit."""

    def __init__(self, wire: Type = BIT) -> None:
        self.wire = wire

    def sure_decode(self, low: int, high: int, slow: Way) -> Way:
        """Return a decoder by table."""
        return listed({0: False, 1: True}, slow)

    def quick_encode(self, allowed: Allowed, slow: Way) -> Way:
        """Return an encoder by table, if both states may be written."""
        return chosen(bool, {False: 0, True: 1}, slow) if allowed == ((0, 1),) else slow

    def decode(self, raw: int, raws: Raws) -> bool:
        """Return True if the bit is 1."""
        return bool(raw)

    def converted(self, value: bool, raws: Raws) -> int | None:
        """Return 1 for True."""
        return int(value) if isinstance(value, bool) else integral(value)


class _Members(dict[int, T]):
    """Members of enums by raw number; members for numbers without a name are made on demand."""

    def __init__(self, form: Form[T, Any], low: int, high: int) -> None:
        self._form, self._ends = form, (low, high)

    def __missing__(self, raw: int) -> T:
        if type(raw) is not int or not self._ends[0] <= raw <= self._ends[1]:
            raise KeyError(raw)
        member = self._form.decode(raw, {})
        if len(self) < _REMEMBERED:
            self[raw] = member
        return member


_STATES = 2
"""Up to this many members are all listed in messages."""
_REMEMBERED = 4096
"""The most members without a name that each point remembers."""


class Named(Form[E, E]):
    """An enum; a number without a name is a member too. `closed`: only named numbers may be written."""

    names: type[E]

    def __init__(self, wire: Type, names: type[E], *, closed: bool = False) -> None:
        self.wire = wire
        self.names = names
        self.closed = closed
        self._known = {int(member): member for member in names}
        if closed:
            self.refused = UnknownValueError

    def sure_decode(self, low: int, high: int, slow: Way) -> Way:
        """Return a decoder by a table of members, which remembers numbers without a name."""
        return listed(_Members(self, low, high), slow)

    def quick_encode(self, allowed: Allowed, slow: Way) -> Way:
        """Return an encoder by a table of the members that may be written."""
        ends = fixed_ends(allowed)
        if ends is None:
            return slow
        return chosen(
            self.names, {member: raw for raw, member in self._known.items() if ends[0] <= raw <= ends[1]}, slow
        )

    def decode(self, raw: int, raws: Raws) -> E:
        """Return the member, also for a number without a name."""
        return self.names(raw)

    def converted(self, value: E, raws: Raws) -> int | None:
        """Return the member's number; a member of another enum raises UnknownValueError."""
        if isinstance(value, enum.Enum) and not isinstance(value, self.names):
            raise UnknownValueError(f"{value!r} is no {self.names.__name__}")
        if isinstance(value, (str, bool)):
            raise WrongTypeError(f"takes {self._meant(value)}, not {shown(value)}")
        return whole(value)

    def _meant(self, value: str | bool) -> str:
        """Return the member with a name like this, else an example of a member."""
        named = self.names.__members__
        member = named.get(value.strip().upper()) if isinstance(value, str) else None
        names = [f"{self.names.__name__}.{name}" for name in ([member.name] if member else named)]
        if 0 < len(names) <= _STATES:
            return " or ".join(names)
        return f"a member of {self.names.__name__}" + (f" such as {names[0]}" if names else "")

    def checked(self, raw: int, allowed: Allowed, raws: Raws) -> int | None:
        """Return the number if it is in range, and for a closed enum named."""
        if self.closed and raw not in self._known:
            return None
        return super().checked(raw, allowed, raws)

    def limits(self, width: int) -> tuple[int, int]:
        """Return the least and the greatest number of a closed enum, else of the type."""
        return (min(self._known), max(self._known)) if self.closed else super().limits(width)

    def name_of(self, raw: int) -> str | None:
        """Return the member's name in lower case."""
        member = self._known.get(raw)
        return None if member is None else member.name.lower()

    def choices(self, unit: str) -> str | None:
        """Return the named numbers of a closed enum."""
        named = ", ".join(f"{raw} {member.name.lower()}" for raw, member in self._known.items())
        return f"none of {named}" if self.closed else None


class Flags(Form[F, F]):
    """Named bits in a word; bits without a name are preserved."""

    names: type[F]

    def __init__(self, wire: Type, names: type[F]) -> None:
        self.wire = wire
        self.names = names

    def sure_decode(self, low: int, high: int, slow: Way) -> Way:
        """Return a decoder that remembers earlier words."""
        return listed(_Members(self, low, high), slow)

    def decode(self, raw: int, raws: Raws) -> F:
        """Return all bits of the word."""
        return self.names(raw & (1 << self.wire.bits) - 1)

    def converted(self, value: F, raws: Raws) -> int | None:
        """Return the word as the type holds it; flags of another word raise UnknownValueError."""
        if isinstance(value, enum.Enum) and not isinstance(value, self.names):
            raise UnknownValueError(f"{value!r} is no {self.names.__name__}")
        raw = whole(value)
        if self.wire.signed and raw >> self.wire.bits == 0:
            raw = self.wire.number(raw, self.wire.bits)
        return raw
