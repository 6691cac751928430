# SPDX-License-Identifier: 0BSD
"""Forms of words that hold characters or decimal digits instead of a number."""

from __future__ import annotations

import enum
from collections.abc import Sequence
from typing import TYPE_CHECKING, TypeVar

from .arguments import shown, whole
from .errors import MalformedError, UnknownValueError, WrongLengthError, WrongTypeError
from .forms import Form, Type

if TYPE_CHECKING:
    from .forms import Allowed
    from .named import NamedNumber
    from .rules import Raws

E = TypeVar("E", bound="NamedNumber")

_ASCII = frozenset(range(0x20, 0x7F))
_LATIN = _ASCII | frozenset(range(0xA0, 0x100))
_CODECS = {"utf-8": "utf-8", "utf-16": "utf-16-be"}


class Text(Form[str, str]):
    """Characters in words; the raw number is all words, the first one highest.

    A word has two characters, the first in its high byte, or one in its low byte; `low_first` swaps the bytes. The text
    is padded with spaces, or with zeros (`padding`), the first of which ends it. UTF-8 counts bytes as characters,
    UTF-16 counts words.
    """

    def __init__(
        self,
        characters: int,
        encoding: str = "ascii",
        *,
        per_word: int = 2,
        padding: int = 0x20,
        low_first: bool = False,
    ) -> None:
        self.characters = characters
        self.encoding = encoding
        self.per_word = per_word
        self.padding = padding
        self.low_first = low_first
        self.wire = Type(16 * -(-characters // (1 if encoding == "utf-16" else per_word)))
        self._codec = _CODECS.get(encoding, "latin-1")
        self._size = 2 if encoding == "utf-16" else 1
        self._step = 2 if self._size == per_word == 1 else 1

    def decode(self, raw: int, raws: Raws) -> str:
        """Return the characters without trailing spaces; raises MalformedError for invalid Unicode."""
        size, codes = self._size, self._characters_of(raw)
        if not self.padding:
            ends = (at for at in range(0, len(codes), size) if not any(codes[at : at + size]))
            codes = codes[: next(ends, len(codes))]
        try:
            return codes.decode(self._codec).rstrip(" ")
        except UnicodeDecodeError as error:
            raise MalformedError(f"the words are no valid {self.encoding}: {error.reason}") from error

    def converted(self, value: str, raws: Raws) -> int | None:
        """Return the words of a text that fits and has only printable characters."""
        if not isinstance(value, str):
            return None
        try:
            size = len(value.encode(self._codec)) // self._size
            codes = value.rstrip(" ").encode(self._codec)
        except UnicodeEncodeError:
            return None
        if size > self.characters or not self._is_printable(value):
            return None
        return self._words_of(codes, self.padding.to_bytes(self._size, "big"))

    def _characters_of(self, raw: int) -> bytes:
        """Return the bytes of all characters."""
        codes = self._in_order(raw.to_bytes(self.wire.bits // 8, "big"))
        return codes[self._step - 1 :: self._step][: self.characters * self._size]

    def _words_of(self, codes: bytes, fill: bytes) -> int:
        """Return the words of bytes, padded."""
        data = bytearray(self.wire.bits // 8)
        data[self._step - 1 :: self._step] = (codes + fill * len(data))[: len(data) // self._step]
        return int.from_bytes(self._in_order(data), "big")

    def checked(self, raw: int, allowed: Allowed, raws: Raws) -> int | None:
        """Return the words if they hold only printable characters."""
        if not 0 <= raw < 1 << self.wire.bits:
            return None
        try:
            return raw if self._is_printable(self.decode(raw, raws)) else None
        except MalformedError:
            return None

    def _is_printable(self, text: str) -> bool:
        """Return True if every character is one of the encoding, and none a control character."""
        codes = {ord(char) for char in text}
        if self.encoding == "ascii":
            return codes <= _ASCII
        return codes <= _LATIN or (self._codec != "latin-1" and {code for code in codes if code < 0x100} <= _LATIN)

    def _in_order(self, data: bytes | bytearray) -> bytes:
        """Return the bytes; those of each word are swapped if the low one comes first."""
        ordered = bytearray(data)
        if self.low_first:
            ordered[::2], ordered[1::2] = data[1::2], data[::2]
        return bytes(ordered)

    def decode_count(self, raw: int, raws: Raws) -> int:
        """Raises WrongTypeError: a text has no counts."""
        raise WrongTypeError("a text has no counts: use raw numbers or values")

    def converted_count(self, count: int, raws: Raws) -> int:
        """Raises WrongTypeError: a text has no counts."""
        raise WrongTypeError("a text has no counts: use raw numbers or values")

    def shown(self, raw: int, raws: Raws, display: int | None = None) -> str:
        """Return the text itself."""
        return self.decode(raw, raws)

    def choices(self, unit: str) -> str | None:
        """Return what a refused text is."""
        what = {"utf-8": "bytes of utf-8", "utf-16": "words of utf-16"}.get(self.encoding, "")
        held = f"{self.characters} {what}" if what else f"{self.characters} printable {self.encoding} characters"
        return f"no text of at most {held}"


class Digits(Form[tuple[E, ...], Sequence[E]]):
    """A word whose decimal digits, the highest first, are numbers of an enum."""

    names: type[E]
    refused = UnknownValueError

    def __init__(self, wire: Type, names: type[E], *, count: int) -> None:
        self.wire = wire
        self.names = names
        self.count = count
        self._numbers = {int(entry): entry for entry in names}

    def _digits(self, raw: int) -> tuple[int, ...]:
        """Return the digits as numbers; the first one takes the rest of the number."""
        digits = []
        for _ in range(self.count - 1):
            raw, digit = divmod(raw, 10)
            digits.append(digit)
        return (raw, *reversed(digits))

    def decode(self, raw: int, raws: Raws) -> tuple[E, ...]:
        """Return a member for each digit, also for one without a name."""
        return tuple([self.names(digit) for digit in self._digits(raw)])

    def converted(self, value: Sequence[E], raws: Raws) -> int | None:
        """Return the word of these members; a member of another enum raises UnknownValueError."""
        if not isinstance(value, Sequence) or isinstance(value, (str, bytes)):
            raise WrongTypeError(f"takes {self.count} digits, not {shown(value)}")
        if len(value) != self.count:
            raise WrongLengthError(f"takes {self.count} digits, not {len(value)}")
        raw = 0
        for digit in value:
            if isinstance(digit, enum.Enum) and not isinstance(digit, self.names):
                raise UnknownValueError(f"{digit!r} is no {self.names.__name__}")
            if whole(digit) not in self._numbers:
                return None
            raw = raw * 10 + whole(digit)
        return raw if raw < 1 << self.wire.bits else None

    def checked(self, raw: int, allowed: Allowed, raws: Raws) -> int | None:
        """Return the word if every digit is a number of the enum."""
        inside = 0 <= raw < 1 << self.wire.bits
        return raw if inside and self._numbers.keys() >= set(self._digits(raw)) else None

    def name_of(self, raw: int) -> str | None:
        """Return the name of a digit in lower case."""
        entry = self._numbers.get(raw)
        return None if entry is None else entry.name.lower()

    def choices(self, unit: str) -> str | None:
        """Return what a refused word is."""
        named = ", ".join(f"{entry.value} {entry.name.lower()}" for entry in self.names)
        return f"not made of {self.count} digits out of {named}"
