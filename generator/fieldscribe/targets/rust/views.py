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
    """One point: its doc comment, the manual's code to search for (or empty), its facts, its former names."""

    doc: tuple[str, ...]
    alias: str
    name: str
    facts: tuple[str, ...]
    was: tuple[tuple[str, ...], ...]


@dataclass(frozen=True, slots=True)
class ArgumentsView:
    """A struct of the raw numbers that a point needs."""

    doc: str
    name: str
    fields: tuple[tuple[tuple[str, ...], str, str], ...]
    part: str
    part_literal: tuple[str, ...]


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
    """A flag: its mask, how it is read and set, its named numbers (doc, constant).

    `active` is whether a single bit means the flag while it is 1; `meaning` says what else its name does not.
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
    """A word whose bits have names; the bits are held in the unsigned type beside the raw number's.

    `false` is the word in which nothing is true, `shown` the lines that say how the word is shown.
    """

    doc: str
    name: str
    raw: str
    bits: str
    false: str
    flags: tuple[FlagView, ...]
    shown: tuple[str, ...]
