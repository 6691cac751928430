"""What the Rust templates see: final identifiers, literals, expressions and comment text."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class ConstantView:
    """A constant of special codes that points share."""

    doc: str
    lines: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class PointView:
    """One point: its doc comment, the manual's code to search for (or empty), and its facts."""

    doc: tuple[str, ...]
    alias: str
    name: str
    facts: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class ArgumentsView:
    """A struct of the raw numbers that a point needs; `old_names` is the text of what it was called."""

    doc: str
    name: str
    fields: tuple[tuple[tuple[str, ...], str, str], ...]
    part: str
    part_literal: tuple[str, ...]
    old_names: str


@dataclass(frozen=True, slots=True)
class EntryView:
    """A variant of an enum; `named` and `numbered` are the arms that turn it into its name and its number."""

    doc: str
    name: str
    literal: str
    named: tuple[str, ...]
    numbered: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class EnumView:
    """An enum; `unknown` is the variant that carries a number without a name."""

    doc: str
    name: str
    raw: str
    entries: tuple[EntryView, ...]
    unknown: str


@dataclass(frozen=True, slots=True)
class FlagView:
    """A flag: its mask, its getter and setter, its named numbers (doc, constant).

    `active` says that a single bit is 1 while the flag is true; `meaning` is what its name alone does not say.
    """

    name: str
    doc: str
    meaning: str
    active: bool
    constant: str
    constant_lines: tuple[str, ...]
    getter: str
    setter: tuple[str, ...]
    mask: str
    single: bool
    read: tuple[str, ...]
    full: bool
    placed: str
    when_true: str
    when_false: str
    values: tuple[tuple[str, tuple[str, ...]], ...]


@dataclass(frozen=True, slots=True)
class FlagsView:
    """A word whose bits have names; the bits are held in the unsigned type of the raw number's width.

    `false` is the word in which no flag is true, `shown` the lines that print the word.
    """

    doc: str
    name: str
    raw: str
    bits: str
    false: str
    flags: tuple[FlagView, ...]
    shown: tuple[str, ...]
