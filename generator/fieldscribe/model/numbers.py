"""What raw numbers mean: wire types, names, flags, special codes, characters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

Titles = Mapping[str, str]
"""Text for people by language code; `en` is always there."""


@dataclass(frozen=True, slots=True)
class TypeInfo:
    """What a wire type is: its width in bits, whether it is signed, whether it is a floating-point pattern."""

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
"""All wire types; of a text the width is that of one word, and `Shape.text` says how many characters it has."""


@dataclass(frozen=True, slots=True)
class Entry:
    """One named number of an enum."""

    raw: int
    name: str
    title: Titles
    quantity: str | None


@dataclass(frozen=True, slots=True)
class Enum:
    """Names of numbers. `name` is unique in the device; a closed enum allows only its own numbers."""

    name: str
    title: Titles
    entries: tuple[Entry, ...]
    closed: bool


@dataclass(frozen=True, slots=True)
class Special:
    """A special code: raw numbers low..high that are no quantity; with `no_value` they say that there is none.

    It is written only if `writable`; `hexadecimal` says that the manual writes it so. `own` is False for a code that a
    type, a group or a format gives to many points.
    """

    low: int
    high: int
    name: str
    title: Titles
    no_value: bool
    writable: bool = False
    hexadecimal: bool = False
    own: bool = True


@dataclass(frozen=True, slots=True)
class Text:
    """Characters in words, two a word, the first in the high byte of the first word; padded with spaces."""

    characters: int
    encoding: str


@dataclass(frozen=True, slots=True)
class Digits:
    """A word whose decimal digits each mean something; `enum` names the numbers that a digit may be."""

    count: int
    enum: Enum


@dataclass(frozen=True, slots=True)
class Fixed:
    """Bits of a word that are written as a constant, always: those in `mask` get their value from `bits`."""

    mask: int
    bits: int


@dataclass(frozen=True, slots=True)
class Flag:
    """A bit, or several, inside a word, named in the word's description. `low` is the lowest bit; bits count from 0.

    `active` is the value of a single bit that means the name is true (0 for inverted bits). `values` names the numbers.
    """

    low: int
    width: int
    name: str
    title: Titles
    active: int
    values: tuple[Entry, ...]
