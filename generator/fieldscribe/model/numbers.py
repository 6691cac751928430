"""What raw numbers mean: wire types, names, flags, special codes, characters."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field

Titles = Mapping[str, str]
"""Text for people by language code; `en` is always present."""


@dataclass(frozen=True, slots=True)
class TypeInfo:
    """A wire type: its width in bits, whether it is signed, and whether it is a floating-point pattern."""

    bits: int
    signed: bool
    floating: bool


TYPES: Mapping[str, TypeInfo] = {
    "bit": TypeInfo(1, False, False),
    **{f"{sign}{bits}": TypeInfo(bits, sign == "s", False) for bits in (8, 16, 32, 64) for sign in "us"},
    "f32": TypeInfo(32, False, True),
    "f64": TypeInfo(64, False, True),
    "text": TypeInfo(16, False, False),
}
"""The types that code has. The width of a text is that of one word; `Shape.text` has the number of its characters."""

TYPE_PATTERN = "^(bit|[us]([1-9]|[1-5][0-9]|6[0-4])|f32|f64|text|bytes)$"
"""The names of wire types: those of `TYPES`, bytes, and a sign with any width up to 64 bits."""

NOTATIONS = {"hex": 0, "version": 0, "version of nibbles": 0, "ipv4": 4, "ipv6": 16, "eui48": 6, "eui64": 8}
"""How people write bytes, with the number of bytes; 0 for any."""


def type_info(name: str) -> TypeInfo:
    """Return the facts of a wire type by its name: one of `TYPES`, or a sign and a width (`u24`). Raises KeyError."""
    known = TYPES.get("text" if name == "bytes" else name)
    if known is None and re.search(TYPE_PATTERN, name) is None:
        raise KeyError(name)
    return known or TypeInfo(int(name[1:]), name[0] == "s", False)


def carrier_of(name: str) -> str:
    """Return the type of code that holds a wire type: the type itself, or the next wider one."""
    if name in TYPES:
        return name
    return f"{name[0]}{next(bits for bits in (8, 16, 32, 64) if bits >= int(name[1:]))}"


@dataclass(frozen=True, slots=True)
class Entry:
    """One named number of an enum."""

    raw: int
    name: str
    title: Titles
    quantity: str | None


@dataclass(frozen=True, slots=True)
class Enum:
    """Names of numbers. A closed enum allows only its own numbers.

    `name` is unique in the device. It is empty in a shape if each point has the enum under a name of its own. `was` has
    the names that the enum had when its point had its old names.
    """

    name: str
    entries: tuple[Entry, ...]
    closed: bool
    was: tuple[str, ...] = field(default=(), repr=False)


@dataclass(frozen=True, slots=True)
class Special:
    """A special code: raw numbers low..high that are not a quantity; `no_value` if they mean that there is no value.

    It may be written only if `writable`; it is shown in hexadecimal if the manual prints it so. A `shared` code comes
    from a type, a group or a format, which many points have.
    """

    low: int
    high: int
    name: str
    title: Titles
    no_value: bool
    writable: bool = False
    hexadecimal: bool = False
    shared: bool = False


@dataclass(frozen=True, slots=True)
class DatePart:
    """A part of a date or time: the bits (low bit 0) of a word of the point, the first of which is 0.

    `base` is the year that a 0 means; of a weekday it is the number of Sunday.
    """

    name: str
    word: int
    bits: tuple[int, int]
    base: int = 0

    @property
    def width(self) -> int:
        """Return how many bits it has."""
        return self.bits[0] - self.bits[1] + 1


@dataclass(frozen=True, slots=True)
class Text:
    """The layout of a text in words, the first character in the first word.

    A word has two, the first in its high byte, or one in its low byte; `low_first` swaps the bytes. `padding` fills the
    rest: a blank, or a 0, which ends the text. Plain bytes have their notation as `encoding`, and no rest. A `date`, a
    `time`, or a `date and time` has `parts`, which are decimal digits of four bits each if `bcd`.
    """

    characters: int
    encoding: str
    per_word: int = 2
    padding: int = 0x20
    low_first: bool = False
    parts: tuple[DatePart, ...] = ()
    bcd: bool = False

    @property
    def words(self) -> int:
        """Return how many words the text takes."""
        return -(-self.characters // self.per_word)

    @property
    def kind(self) -> str:
        """Return what it is, in a message: `a text`, `made of bytes`, `a date or time`."""
        return "a date or time" if self.parts else "made of bytes" if self.is_bytes else "a text"

    @property
    def is_bytes(self) -> bool:
        """Return True for plain bytes, which are not characters."""
        return self.encoding in NOTATIONS

    @property
    def is_unicode(self) -> bool:
        """Return True for UTF-8 (each byte counts as a character) and UTF-16 (each 16-bit unit does)."""
        return self.encoding.startswith("utf")

    @property
    def most_bytes(self) -> int:
        """Return how many bytes the text has at most, in code as UTF-8 if it is Unicode."""
        return self.characters * (3 if self.encoding == "utf-16" else 1)

    @property
    def is_plain(self) -> bool:
        """Return True for two characters a word, the first in the high byte, padded with blanks."""
        return self == Text(2 * self.words, self.encoding) and not self.is_unicode


@dataclass(frozen=True, slots=True)
class Digits:
    """A word whose decimal digits have separate meanings; `enum` names the values of a digit."""

    count: int
    enum: Enum


@dataclass(frozen=True, slots=True)
class Fixed:
    """Bits of a word that are always written as a constant: those in `mask`, with the values in `bits`."""

    mask: int
    bits: int


@dataclass(frozen=True, slots=True)
class Flag:
    """One or several bits of a word that are named in the word's description. `low` is the lowest bit, counted from 0.

    `active` is the value of a single bit while its name is true (0 for inverted bits). `values` names the numbers;
    `enum` is the name of the shared enum that has them.
    """

    low: int
    width: int
    name: str
    title: Titles
    active: int
    values: tuple[Entry, ...]
    enum: str = ""
