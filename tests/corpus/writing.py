"""What is sent for a value, and what is refused: an oracle in exact fractions that knows nothing of the compiler.

A value becomes the nearest raw number, halves away from zero; then its limits decide. Where only the rounding of
binary64 decides between two raw numbers, there is no vector.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from random import Random
from typing import Any

KINDS = {
    "encode": "value:real status:word raw:int",
    "encode_count": "count:int status:word raw:int",
    "check": "raw:int status:word",
    "text_encode": "text:bytes status:word words:ints",
}
"""The kinds of vectors that this oracle writes, with their fields."""
_WRONG = ((math.nan, "not_a_number"), (math.inf, "out_of_range"), (-math.inf, "out_of_range"), (1e300, "out_of_range"))
_PRINTABLE = range(0x20, 0x7F)


def real(value: float) -> str:
    """Return a number as vectors have it: its pattern without zeros at the end."""
    return struct.pack(">d", value).hex().rstrip("0") or "0"


def nearest(value: Fraction) -> float:
    """Return the binary64 nearest to a number."""
    return value.numerator / value.denominator


@dataclass(frozen=True, slots=True)
class Written:
    """A number that is written: value = raw * ratio + offset, where raw numbers from `least` to `greatest` fit.

    Of these only those within `limits` may be written, or only the named ones if it is `closed`, and no code.
    """

    least: int
    greatest: int
    ratio: Fraction
    offset: Fraction
    limits: tuple[int, int]
    named: Collection[int]
    closed: bool
    codes: Collection[int]
    no_numbers: Collection[int] = ()
    """Raw numbers whose patterns are none, as where digits are decimal: a code, too."""

    def vectors(self, point: Mapping[str, Any], chance: Random) -> Iterator[str]:
        """Yield vectors for a random number, for a point of the export."""
        raw = self._raw(chance)
        if self.least <= raw <= self.greatest:
            yield f"check\t{raw}\t{self._status(raw)}"
        is_plain = self.ratio == 1 and not self.offset and not point["scale"]
        step = Fraction(chance.choice((-1, 0, 0, 1)), chance.choice((2, 3, 4))) if not is_plain else 0
        if point["decimals"] is not None:
            yield from self._count(raw + step, 10 ** point["decimals"], is_plain)
        if point["encodes"] and not is_plain:
            yield from self._value(nearest((raw + step) * self.ratio + self.offset))
            if chance.random() < 0.05:
                value, status = chance.choice(_WRONG)
                yield f"encode\t{real(value)}\t{status}"

    def _raw(self, chance: Random) -> int:
        """Return a number, more often one beside which something changes."""
        choice = chance.random()
        if choice < 0.5:
            return chance.randint(*self.limits)
        if choice < 0.7:
            return chance.randint(self.least, self.greatest)
        edges = (*self.limits, self.least, self.greatest, 0, *self.codes, *self.named)
        return chance.choice(edges) + chance.choice((-1, 0, 1))

    def _status(self, raw: int) -> str:
        if raw in self.codes or raw in self.no_numbers:
            return "special"
        if self.closed:
            return "ok" if raw in self.named else "unknown_value"
        return "ok" if self.limits[0] <= raw <= self.limits[1] else "out_of_range"

    def _line(self, start: str, raw: int) -> str:
        status = self._status(raw)
        return f"{start}\t{status}\t{raw}" if status == "ok" else f"{start}\t{status}"

    def _count(self, raw: Fraction | int, power: int, is_plain: bool) -> Iterator[str]:
        """Yield the vector of a count, as far as the integer type for counts has it."""
        ends = [(end * self.ratio + self.offset) * power for end in (self.least, self.greatest)]
        narrow = self.greatest - self.least < 1 << 16 if is_plain else all(abs(2 * end + 1) < 1 << 32 for end in ends)
        most = 1 << (31 if narrow else 63)
        count = round((raw * self.ratio + self.offset) * power)
        if -most <= count < most:
            yield self._line(f"encode_count\t{count}", _half_away((Fraction(count, power) - self.offset) / self.ratio))

    def _value(self, value: float) -> Iterator[str]:
        """Yield the vector of a value, unless roundings of binary64 on the way decide."""
        scaled, offset = Fraction(value) / self.ratio, -self.offset / self.ratio
        exact = scaled + offset
        to_half = abs(exact - math.floor(exact) - Fraction(1, 2))
        steps = Fraction(value) * self.ratio.denominator, scaled, offset, exact
        if to_half * (1 << 49) > abs(scaled) + abs(offset) + 1 or (not to_half and all(map(_is_binary64, steps))):
            yield self._line(f"encode\t{real(value)}", _half_away(exact))


@dataclass(frozen=True, slots=True)
class WrittenFloat:
    """A floating-point number that is written, of so many bits, between limits; no code is."""

    width: int
    limits: tuple[float, float] | None
    codes: Collection[int]

    def vectors(self, chance: Random) -> Iterator[str]:
        """Yield a vector for a random value: the nearest number of the type is held against the limits."""
        choice, ends = chance.random(), self.limits or (-1e6, 1e6)
        if choice < 0.05:
            value, status = chance.choice(_WRONG if self.width == 32 else _WRONG[:-1])
            yield f"encode\t{real(value)}\t{status}"
            return
        value = chance.uniform(*ends) if choice < 0.6 else chance.choice((*ends, self._middle(chance), _any(chance)))
        pattern = self._pattern(value)
        if pattern is None:
            yield f"encode\t{real(value)}\tout_of_range"
            return
        number = self._number(pattern)
        status = "ok"
        if pattern in self.codes:
            status = "special"
        elif self.limits and not self._typed(self.limits[0]) <= number <= self._typed(self.limits[1]):
            status = "out_of_range"
        yield f"check\t{pattern}\t{status}"
        yield f"encode\t{real(value)}\t{status}" + (f"\t{pattern}" if status == "ok" else "")

    def _middle(self, chance: Random) -> float:
        """Return the middle of two neighbours of binary32: exact in binary64, where it ends in the even one."""
        pattern = chance.randrange(0x7F7F_FFFF) | chance.randrange(2) << 31
        low, high = (struct.unpack(">f", (pattern + more).to_bytes(4, "big"))[0] for more in (0, 1))
        return float(low + high) / 2

    def _pattern(self, value: float) -> int | None:
        """Return the pattern of the nearest number, ties to even; None if it is none."""
        try:
            return int.from_bytes(struct.pack(">f" if self.width == 32 else ">d", value), "big")
        except OverflowError:
            return None

    def _number(self, pattern: int) -> float:
        number: float = struct.unpack(">f" if self.width == 32 else ">d", pattern.to_bytes(self.width // 8, "big"))[0]
        return number

    def _typed(self, value: float) -> float:
        pattern = self._pattern(value)
        return value if pattern is None else self._number(pattern)


def written_text(words: int, per_word: int, chance: Random) -> str:
    """Return a vector for a random text that may be too long, or have what is no character of ASCII."""
    room = words * per_word
    text = bytes(chance.choice(_PRINTABLE) for _ in range(chance.randrange(room + 2)))
    if chance.random() < 0.1:
        text += bytes((chance.randrange(256),))
    start = f"text_encode\t{text.hex() or '-'}"
    if len(text) > room or any(char not in _PRINTABLE for char in text):
        return f"{start}\tout_of_range"
    data = text.rstrip(b" ").ljust(room, b"\0")
    numbers = [int.from_bytes(data[at : at + per_word], "big") for at in range(0, room, per_word)]
    return f"{start}\tok\t{','.join(map(str, numbers))}"


def _half_away(number: Fraction) -> int:
    """Return the nearest integer; of two, the one away from zero."""
    return math.floor(number + Fraction(1, 2)) if number >= 0 else math.ceil(number - Fraction(1, 2))


def _is_binary64(number: Fraction) -> bool:
    return Fraction(nearest(number)) == number


def _any(chance: Random) -> float:
    """Return a random binary64, of any size."""
    while True:
        value: float = struct.unpack(">d", chance.randbytes(8))[0]
        if math.isfinite(value):
            return value
