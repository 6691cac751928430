"""Points as they are drafted: facts as YAML writes them, and what a person must settle."""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass(slots=True)
class DraftErratum:
    """A misprint that other printed numbers show; without a `fact`, what is printed and taken are sentences."""

    fact: str
    printed: str
    taken: str
    why: str


@dataclass(slots=True)
class DraftPoint:
    """One point of the draft. `at` is None where no address is certain; None elsewhere means that nothing is said."""

    line: int
    space: str
    title: str = ""
    code: str = ""
    name: str = ""
    section: str = ""
    at: int | None = None
    shown: str = "~"
    index: int | None = None
    type: str | None = None
    length: int | None = None
    words: str | None = None
    bits: str | None = None
    access: str | None = None
    range: str | None = None
    range_in_units: str | None = None
    scale: str | None = None
    unit: str = ""
    default: str | None = None
    default_in_units: str | None = None
    labels: dict[int, str] = field(default_factory=dict)
    rest: dict[int, str] = field(default_factory=dict)
    """Names of numbers that may belong to the row above, too."""
    special: dict[int, str] = field(default_factory=dict)
    flags: dict[str, str] = field(default_factory=dict)
    reserved: bool = False
    note: str = ""
    printed: dict[str, list[str]] = field(default_factory=dict)
    errata: list[DraftErratum] = field(default_factory=list)
    questions: list[str] = field(default_factory=list)
    lines: dict[str, list[int]] = field(default_factory=dict)
    """Where facts stand that are not in the row itself."""
    half: str = ""
    """`high` or `low` if the row is one word of two, by what it prints."""


@dataclass(slots=True)
class DraftGroup:
    """Points that stand under one heading, in one space."""

    title: str
    space: str
    section: str
    numberings: dict[str, int] = field(default_factory=dict)
    """By name how far a printed numbering is from the wire address."""
    points: list[DraftPoint] = field(default_factory=list)
    name: str = ""
