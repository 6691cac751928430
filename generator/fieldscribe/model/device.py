"""A whole device, and its parts other than points: bus, groups, messages, commands, worked examples, errata.

A command may be several requests in order, each with the words that follow from the arguments of the command.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple, Self

from fieldscribe.conditions import Condition
from fieldscribe.model.numbers import Enum, Titles
from fieldscribe.model.point import Point, Source, Variant, message_bits

WHOLE_WORD = 0xFFFF


@dataclass(frozen=True, slots=True)
class Word:
    """A word of a step: constant + factor * argument, modulo 65536. Bits outside `mask` keep what the device holds."""

    constant: int
    factor: int = 0
    argument: str | None = None
    mask: int = WHOLE_WORD

    def __str__(self) -> str:
        """Return the formula: `65535 - unit`."""
        if self.argument is None:
            return str(self.constant)
        product = self.argument if abs(self.factor) == 1 else f"{abs(self.factor)} * {self.argument}"
        sign = "-" if self.factor < 0 else "+"
        return product if sign == "+" and not self.constant else f"{self.constant} {sign} {product}"

    def of(self, arguments: Mapping[str, int]) -> int:
        """Return the word for these arguments; bits outside the mask are 0."""
        return (self.constant + (self.factor * arguments[self.argument] if self.argument else 0)) & self.mask


@dataclass(frozen=True, slots=True)
class Step:
    """One request: it writes words with the function `write`, or reads with `read` until the device holds them.

    With both functions, words are read first, and bits outside the masks are written back unchanged. `within` is the
    time in milliseconds until the words must be there. `says` is the author's text: points with values, or words.
    `base` is the name of what the address counts from; None if that is 0.
    """

    space: str
    address: int
    words: tuple[Word, ...]
    read: int | None
    write: int | None
    within: int | None
    when: Condition | None
    says: str
    base: str | None = None

    def arguments_in(self, words: Sequence[int], ends: Mapping[str, tuple[int, int]]) -> dict[str, int] | None:
        """Return the arguments, within these ends, that produce the words; None if there are none."""
        given: dict[str, int] = {}
        for word, number in zip(self.words, words, strict=True):
            if word.argument is not None and word.argument not in given:
                low, high = ends[word.argument]
                numbers = range(low, high + 1)
                given[word.argument] = next((one for one in numbers if word.of({word.argument: one}) == number), low)
            if word.of(given) != number & word.mask:
                return None
        return given


@dataclass(frozen=True, slots=True)
class SteppedCommand:
    """A command of several requests, in order. `every` is the period in milliseconds, if `run` asks for repetition.

    `arguments` gives the least and the greatest number of each argument, which the caller chooses.
    """

    name: str
    title: Titles
    note: Titles
    run: str
    every: int | None
    arguments: Mapping[str, tuple[int, int]]
    steps: tuple[Step, ...]
    source: Source


@dataclass(frozen=True, slots=True)
class Group:
    """Points that the manual presents together."""

    name: str
    title: Titles
    note: Titles
    source: Source


@dataclass(frozen=True, slots=True)
class Named:
    """The subject of an erratum other than a point: a `frame`, a `function`, ... by its name or number."""

    kind: str
    name: str | int

    def __str__(self) -> str:
        return f"{self.kind}:{self.name}"


About = str | Named
"""The subject of a fact: a point by its name, or another thing."""


@dataclass(frozen=True, slots=True)
class Erratum:
    """A place where the manual is wrong, unclear or silent: what is printed, what was taken, why, and how sure that is.

    `where` is its subject if that is not a point: a thing of the device, or a place in words.
    """

    id: str
    points: tuple[str, ...]
    where: Named | str
    source: Source
    printed: str
    taken: str
    why: str
    certainty: str
    facts: tuple[tuple[str, str], ...] = ()
    """The printed facts by key; empty if the erratum states them in words only."""
    leaves_open: tuple[tuple[str, str], ...] = ()
    """By the key of the fact: the end of a sentence that begins `the manual leaves open`."""


@dataclass(frozen=True, slots=True)
class FamilyFacts:
    """Facts of one family, which its folder defines."""


@dataclass(frozen=True, slots=True)
class Frame:
    """A worked example of the manual. `answers` names the request that a response answers.

    `valid` is False for a misprinted frame; `corrected` is the frame as it should read (the printed bytes of a valid
    one). `meaning` has raw numbers by point name.
    """

    name: str
    framing: str
    direction: str
    answers: str | None
    printed: bytes
    corrected: bytes
    valid: bool
    meaning: Mapping[str, int]
    title: Titles
    source: Source
    errata: tuple[str, ...]
    family_facts: FamilyFacts | None = None


@dataclass(frozen=True, slots=True)
class Role:
    """What one byte of a message carries.

    `kind` is `constant` (`number` is the byte itself), `unit`, `address` or `raw` (`number` is the distance of the byte
    from bit 0), `multiplexer`, `word` (`number` is 2 * word of the frame, plus 1 for its low byte), or `xor` (`number`
    is the mask of the bytes that are combined).
    """

    kind: str
    number: int


@dataclass(frozen=True, slots=True)
class Field:
    """The place of a signal in the bits of a message and in the words of its telegram.

    `start` is its first bit as CAN databases count them: bit 0 of byte 0 is 0, bit 7 of byte 1 is 15. It is the least
    significant bit if the low byte comes first, else the most significant one. `word` is its first word in the
    telegram. `when` has fields of the message with the raw numbers that select the signal: all must fit.
    """

    start: int
    width: int
    low_first: bool
    word: int
    when: tuple[tuple[int, tuple[int, ...]], ...] = ()

    @property
    def words(self) -> int:
        """Return how many words it takes. The high one is first; its unused bits are 0."""
        return -(-self.width // 16)

    @property
    def bits(self) -> tuple[int, ...]:
        """Return its bits in the message, the least significant one first."""
        return message_bits(self.start, self.width, low_first=self.low_first)


@dataclass(frozen=True, slots=True)
class Message:
    """A layout of bytes with an identifier, to which the unit number is added if `adds_unit`.

    A message has `roles` for its bytes, or `length` bytes of signals, whose bits the `fields` give; the words of these
    are a telegram of the same name. `bits` is the length of its identifier if it is not that of the bus; `every` is how
    often it is sent, in milliseconds.
    """

    name: str
    title: Titles
    direction: str
    answers: str | None
    identifier: int
    adds_unit: bool
    roles: tuple[Role, ...]
    source: Source
    length: int = 8
    bits: int | None = None
    every: int | None = None
    fields: tuple[Field, ...] = ()

    @property
    def words(self) -> int:
        """Return how many words of a telegram one frame carries."""
        return sum(role.kind == "word" for role in self.roles) // 2


@dataclass(frozen=True, slots=True)
class Telegram:
    """A cyclic layout of `words` words, carried by frames of a message or by the family's own frames."""

    name: str
    title: Titles
    direction: str
    words: int
    message: str | None
    source: Source


@dataclass(frozen=True, slots=True)
class Command:
    """A named constant write. `value` is None if any value will do; `wears` is how many writes the memory survives."""

    name: str
    title: Titles
    note: Titles
    space: str
    address: int
    function: int
    value: int | None
    wears: int | None
    busy: str | None
    source: Source


@dataclass(frozen=True, slots=True)
class Identification:
    """What a point holds in this device, or in one variant of it: one of `raws`, or one of `texts` if it is a text."""

    variant: Variant | None
    point: str
    raws: tuple[int, ...]
    texts: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Given:
    """A number that a client is given when it opens the device, such as the slot of a module."""

    name: str
    title: Titles
    low: int
    high: int


@dataclass(frozen=True, slots=True)
class Found:
    """A chain of blocks that a client searches for: `marker` stands at one of `places`, and the first block after it.

    A block starts with its id and its length: the number of words that follow these two. After it stands the next
    block; `end` in place of an id ends the chain.
    """

    name: str
    title: Titles
    space: str
    marker: str
    places: tuple[int, ...]
    end: int

    @property
    def words(self) -> tuple[int, ...]:
        """Return the text of the marker as words."""
        data = self.marker.encode("ascii")
        return tuple(data[at] << 8 | data[at + 1] for at in range(0, len(data), 2))


@dataclass(frozen=True, slots=True)
class Base:
    """The base of the addresses of a group: `offset` plus multiples of given numbers, or a place in a found block.

    `terms` has pairs of a given number and its factor. `block` is the id of the block; the base is `offset` words
    after its start, plus multiples of what `counts` hold: each a point, its address in the block, and its factor.
    """

    name: str
    formula: str
    offset: int
    terms: tuple[tuple[str, int], ...]
    block: int | None
    counts: tuple[tuple[str, int, int], ...] = ()

    @property
    def starts_block(self) -> bool:
        """Return True if this is the start of a found block."""
        return self.block is not None and not self.counts and not self.offset

    @property
    def wanted(self) -> list[str]:
        """Return the names of the numbers that must be given to compute the base."""
        return [name for name, _ in self.terms] if self.block is None else [self.name]

    def at(self, given: Mapping[str, int]) -> int:
        """Return the address for these numbers; that of a found block is given under the name of the base."""
        if self.block is not None:
            return given[self.name]
        return self.offset + sum(given[name] * factor for name, factor in self.terms)


@dataclass(frozen=True, slots=True)
class Code:
    """A number of the protocol with a name: a function or an exception.

    `most` is the largest count of items in one request. `broadcast` says whether a function may be sent to all units at
    once; None means that the protocol decides. `answers` has the positive responses of a request, or the requests that
    a response or an error may answer; `refusals` has the negative responses of a request. `line` is its line in the
    manual.
    """

    number: int
    name: str
    title: Titles
    most: int | None
    broadcast: bool | None = None
    answers: tuple[int, ...] = ()
    refusals: tuple[int, ...] = ()
    line: int | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Block:
    """One read of consecutive addresses that covers `points`, within the limits and without touching a gap."""

    space: str
    function: int
    address: int
    count: int
    points: tuple[str, ...]
    base: str | None = None


@dataclass(frozen=True, slots=True)
class Bus:
    """What the frames need to know about the device; `family_facts` belong to its family alone.

    `line_numbers` are the times and settings under `timing` and `serial` that programs compute with.
    """

    framings: tuple[str, ...]
    units: tuple[int, int]
    broadcast: int | None
    functions: tuple[Code, ...]
    exceptions: tuple[Code, ...]
    gaps: Mapping[str, tuple[tuple[int, int], ...]]
    timing: Mapping[str, str]
    serial: Mapping[str, Mapping[str, str]]
    note: Titles
    family_facts: FamilyFacts | None = None
    line_numbers: Mapping[str, int] = field(default_factory=dict)

    def codes(self, section: str) -> tuple[Code, ...]:
        """Return the numbered codes under a key of `bus`; a key of another family gives none."""
        codes: tuple[Code, ...] = getattr(self if hasattr(self, section) else self.family_facts, section, ())
        return codes

    @property
    def usual_unit(self) -> int:
        """Return the unit number for examples: 1, or the lowest that the device may have."""
        low, high = self.units
        return 1 if low <= 1 <= high else low


@dataclass(frozen=True, slots=True)
class Document:
    """A manual that facts were taken from."""

    id: str
    title: str
    language: str
    file: str | None
    sha256: str | None


@dataclass(frozen=True, slots=True)
class Device:
    """One product with one register map. `digest` covers the facts that generated code depends on, and no others.

    Two attributes are no facts: `command` is the command line that writes the output, if that is not `fieldscribe
    generate`, and `left_out` are the points that only variants have that were not chosen.
    """

    id: str
    version: str
    vendor: str
    model: str
    title: Titles
    note: Titles
    family: str
    documents: tuple[Document, ...]
    variants: Mapping[str, tuple[str, ...]]
    bus: Bus
    groups: tuple[Group, ...]
    points: tuple[Point, ...]
    enums: tuple[Enum, ...]
    blocks: Mapping[str, tuple[Block, ...]]
    commands: tuple[Command, ...]
    frames: tuple[Frame, ...]
    errata: tuple[Erratum, ...]
    digest: str
    messages: tuple[Message, ...] = ()
    telegrams: tuple[Telegram, ...] = ()
    identifications: tuple[Identification, ...] = ()
    given: tuple[Given, ...] = ()
    found: Found | None = None
    bases: tuple[Base, ...] = ()
    stepped_commands: tuple[SteppedCommand, ...] = ()
    command: tuple[str, ...] = field(default=(), repr=False)
    left_out: tuple[Point, ...] = field(default=(), repr=False)

    def base_of(self, point: Point) -> Base | None:
        """Return the base of a point's addresses; None if they count from 0."""
        return next((base for base in self.bases if base.name == point.terms.base), None)

    @property
    def all_commands(self) -> tuple[Command | SteppedCommand, ...]:
        """The commands, those with steps last."""
        return *self.commands, *self.stepped_commands

    def selections(self, point: Point) -> Iterator[tuple[Point, int]]:
        """Yield the points that select a point, those of its variant, with the raw numbers that they must hold."""
        for name, raw in point.selects:
            others = (other for other in self.points if other.name == name)
            yield min(others, key=lambda other: other.variant != point.variant), raw

    @property
    def selecting(self) -> frozenset[str]:
        """The names of the points that select what addresses mean."""
        return frozenset(name for point in self.points for name, _ in point.selects)

    @property
    def doubts(self) -> tuple[Erratum, ...]:
        """The errata that leave something open other than a fact of a point."""
        return tuple(erratum for erratum in self.errata if erratum.leaves_open and not erratum.points)


class Version(NamedTuple):
    """`1.2.3`: a breaking change raises the first number, a new feature the second, any other change the third."""

    major: int
    minor: int
    patch: int

    @classmethod
    def of(cls, text: str) -> Self:
        """Return the version that such a text gives."""
        return cls(*map(int, text.split(".")))

    @property
    def number(self) -> int:
        """Return one number that grows with the version; the schema's form of versions keeps it below 2 ** 32."""
        return (self.major * 1000 + self.minor) * 1000 + self.patch
