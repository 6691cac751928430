"""Registers as a collection describes them, and what words in them mean: an oracle that knows nothing of the compiler.

It writes vectors of conformance, so that what runs them is the code of each language.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from random import Random
from typing import Any

from corpus import writing
from corpus.collection import Counts
from corpus.writing import Written, WrittenFloat, nearest, real, written_text

KINDS = {
    "decode": "raw:int status:word value:real special:word",
    "decode_count": "raw:int status:word count:int special:word",
    "name": "raw:int name:text",
    "flag": "flag:text raw:int number:int truth:int",
    "bits": "word:int raw:int replaced:int result:int",
    "words": "raw:int words:ints",
    "text_decode": "words:ints text:bytes",
    "can_signal": "id:int bytes:bytes status:word raw:int packed:bytes",
    **writing.KINDS,
}
"""The kinds of vectors that oracles write, with their fields."""


class UnlikeError(ValueError):
    """A point has another form than its register."""


@dataclass(slots=True)
class Register:
    """A register: `kind` is u, s, b (decimal digits), f or t (text), `bits` are the first and the number of them.

    `names` are the titles of raw numbers, or of bits if it `has_flags`; `codes` are patterns that are no number. What
    may be written is between the `ends`, which are values, or what has a name if it is `closed`.
    """

    kind: str
    width: int = 16
    bits: tuple[int, int] | None = None
    address: int | None = None
    low_word_first: bool = False
    low_byte_first: bool = False
    ratio: Fraction = Fraction(1)
    offset: Fraction = Fraction(0)
    factor: str = ""
    most_exponent: int = 10
    names: Mapping[int, str] = field(default_factory=dict)
    has_flags: bool = False
    codes: Mapping[int, str] = field(default_factory=dict)
    per_word: int = 2
    clears: bool = False
    """Whether the bits beside its own are written as 0, if it is written."""
    ends: tuple[Fraction | None, Fraction | None] = None, None
    closed: bool = False
    access: str = "r"

    def vectors(self, point: Mapping[str, Any], chance: Random, counts: Counts) -> Iterator[str]:
        """Yield vectors for so many random contents, for a point of the export. Raises UnlikeError."""
        words, self.clears = -(-self.width // 16), self.clears and "w" in self.access
        place = words, self.address or point["address"], self.access
        if place != (point["words"], point["address"], point["access"]):
            raise UnlikeError(f"{point['words']} words at {point['address']} {point['access']}, not {place}")
        given = names_of(point, self.names, self.has_flags)
        for _ in range(counts.read if "r" in self.access else 0):
            if self.kind == "t":
                yield self._text(chance)
            else:
                yield from self._number(chance, given)
        yield from self.written(point, chance, counts.written if "w" in self.access else 0)

    def written(self, point: Mapping[str, Any], chance: Random, count: int) -> Iterator[str]:
        """Yield vectors for so many random contents that are written."""
        for _ in range(count):
            if self.kind == "t":
                yield written_text(self.width // 16, self.per_word, chance)
            elif self.kind == "f":
                yield from self._written_float().vectors(chance)
            else:
                exponent = self._exponent(chance)
                if self.factor:
                    yield f"with\t{self.factor}={exponent}"
                yield from self._written(exponent).vectors(point, chance)

    def _written_float(self) -> WrittenFloat:
        low, high = self.ends
        limits = None if low is None or high is None else (nearest(low), nearest(high))
        return WrittenFloat(self.width, limits, self.codes)

    def _written(self, exponent: int) -> Written:
        """Return what may be written; an end between two raw numbers leaves out the one beyond."""
        width, ratio = self.bits[1] if self.bits else self.width, self.ratio * Fraction(10) ** exponent
        least, greatest = (-(1 << width - 1), (1 << width - 1) - 1) if self.kind == "s" else (0, (1 << width) - 1)
        if self.kind == "b":
            greatest = 10 ** (width // 4) - 1
        stated = [None if end is None else (end - self.offset) / ratio for end in self.ends]
        low, high = stated if ratio > 0 else stated[::-1]
        limits = (
            least if low is None else min(max(math.ceil(low), least), greatest),
            greatest if high is None else max(min(math.floor(high), greatest), least),
        )
        codes = {self._raw(code, width) for code in self.codes if self.kind != "b" or f"{code:x}".isdecimal()}
        named = () if self.has_flags else tuple(self.names)
        no_numbers = range(greatest + 1, 1 << width) if self.kind == "b" else ()
        return Written(least, greatest, ratio, self.offset, limits, named, self.closed, codes, no_numbers)

    def _exponent(self, chance: Random) -> int:
        return chance.randint(-self.most_exponent, self.most_exponent) if self.factor else 0

    def _text(self, chance: Random) -> str:
        room = self.width // 16 * self.per_word
        text = bytes(chance.randrange(32, 127) for _ in range(chance.randrange(room + 1))).rstrip(b" ")
        behind = b"\0" + chance.randbytes(room) if chance.random() < 0.2 else bytes(room)
        data = (text + behind)[:room]
        words = [int.from_bytes(data[at : at + self.per_word], "big") for at in range(0, room, self.per_word)]
        return "\t".join(("text_decode", ",".join(map(str, words)), text.hex() or "-")).removesuffix("\t-")

    def _number(self, chance: Random, names: Mapping[int, str]) -> Iterator[str]:
        width = self.bits[1] if self.bits else self.width
        pattern = self._pattern(chance, width)
        raw = self._raw(pattern, width)
        if self.bits:
            low, ones = self.bits[0], (1 << width) - 1
            word = chance.randrange(1 << 16) & ~(ones << low) | pattern << low
            other = chance.randrange(1 << width)
            result = (0 if self.clears else word & ~(ones << low)) | other << low
            yield f"bits\t{word}\t{raw}\t{self._raw(other, width)}\t{result}"
        elif self.width > 16 or self.kind in "sbf" or self.low_byte_first:
            yield f"words\t{raw}\t{','.join(map(str, self._words(pattern)))}"
        yield from self._meaning(raw, pattern, chance, names)

    def _pattern(self, chance: Random, width: int) -> int:
        """Return the bits of a random number, more often of one that is at an end or has a name."""
        ends = (0, 1, (1 << width) - 1, 1 << width - 1, (1 << width - 1) - 1, *self.codes)
        named = [raw & (1 << width) - 1 for raw in self.names if not self.has_flags]
        choice = chance.random()
        if self.kind == "b":
            return int("".join(chance.choice("0123456789") for _ in range(width // 4)), 16)
        if choice < 0.2 and (choice < 0.1 or not named):
            pattern = chance.choice(ends)
        else:
            pattern = chance.choice(named) if named and choice < 0.6 else chance.randrange(1 << width)
        if self.kind == "f" and not math.isfinite(self._real(pattern)) and pattern not in self.codes:
            return 0
        return pattern

    def _raw(self, pattern: int, width: int) -> int:
        if self.kind == "b":
            return int(f"{pattern:x}")
        return pattern - (1 << width) if self.kind == "s" and pattern >> width - 1 else pattern

    def _real(self, pattern: int) -> float:
        number: float = struct.unpack(">f" if self.width == 32 else ">d", pattern.to_bytes(self.width // 8, "big"))[0]
        return number

    def _words(self, pattern: int) -> list[int]:
        """Return the words in the order of their addresses."""
        data = pattern.to_bytes(-(-self.width // 16) * 2, "big")
        words = [
            int.from_bytes(data[at : at + 2], "little" if self.low_byte_first else "big")
            for at in range(0, len(data), 2)
        ]
        return words[::-1] if self.low_word_first else words

    def _meaning(self, raw: int, pattern: int, chance: Random, names: Mapping[int, str]) -> Iterator[str]:
        is_plain = self.ratio == 1 and not self.offset and not self.factor and self.kind != "f"
        kind = "decode_count" if is_plain else "decode"
        exponent = self._exponent(chance)
        if self.factor:
            yield f"with\t{self.factor}={exponent}"
        if pattern in self.codes:
            yield f"{kind}\t{raw}\tspecial\t-\t{self.codes[pattern]}"
        elif is_plain and raw < 1 << 63:
            yield f"decode_count\t{raw}\tok\t{raw}"
        elif not is_plain:
            found = self._real(pattern) if self.kind == "f" else raw
            number = Fraction(found) * self.ratio * Fraction(10) ** exponent + self.offset
            yield f"decode\t{raw}\tok\t{real(nearest(number) if number or found else found)}"
        if self.has_flags:
            for bit in self.names:
                yield f"flag\t{names[bit]}\t{raw}\t{pattern >> bit & 1}\t{pattern >> bit & 1}"
        elif self.names:
            yield f"name\t{raw}\t{names[raw]}" if raw in self.names else f"name\t{raw}"


def names_of(point: Mapping[str, Any], titles: Mapping[int, str], has_flags: bool = False) -> Mapping[int, str]:
    """Return the names of numbers or bits that have these titles. Raises UnlikeError where one means something else."""
    entries = {one["bits"][1]: one for one in point["flags"]} if has_flags else point["enum"] or {}
    given = {int(raw): one for raw, one in entries.items()}
    for raw, title in titles.items():
        one = given.get(raw)
        if one is None or not _alike(title, one):
            raise UnlikeError(f"{raw} is not {title}")
    return {raw: one["name"] for raw, one in given.items()}


def _alike(title: str, one: Mapping[str, Any]) -> bool:
    """Return True if an entry has a title, or its name begins as the title does: names are short."""
    wanted, name = _letters(title), _letters(one["name"])
    return _letters(one["title"]["en"]) == wanted or wanted.startswith(name) or name.startswith(wanted)


def _letters(text: str) -> str:
    return "".join(filter(str.isalnum, text.casefold()))
