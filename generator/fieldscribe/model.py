"""The neutral model of a device: frozen, typed, every record and set expanded. It knows no target and no YAML."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from fractions import Fraction

    from fieldscribe.existence import Condition

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
"""All wire types; of a text the width is that of one word, and `Point.text` says how many characters it has."""


@dataclass(frozen=True, slots=True)
class Source:
    """Where in the manual a fact stands."""

    document: str
    section: str | None
    page: str | None
    line: int | None


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit of measure; the empty symbol is the plain number."""

    symbol: str
    name: str
    quantity: str


@dataclass(frozen=True, slots=True)
class Place:
    """Where a point is: for what purpose, in which space, at which words (the high part first), by which function."""

    purpose: str
    space: str
    addresses: tuple[int, ...]
    function: int | None


@dataclass(frozen=True, slots=True)
class Factor:
    """A run-time factor of a rule: (raw * slope + intercept) of a point to the power of 1 or -1; or ten to that.

    `exponents` are the raw numbers for which ten to it is defined; None before the points are complete.
    """

    point: str
    slope: int
    intercept: int
    power: int
    ten_to: bool
    exponents: tuple[int, int] | None = None


@dataclass(frozen=True, slots=True)
class Linear:
    """An exact linear rule: result = argument * ratio * product(factors) + offset."""

    ratio: Fraction
    offset: Fraction
    factors: tuple[Factor, ...]


@dataclass(frozen=True, slots=True)
class ScaleCase:
    """raw = value by `rule`; holds always (`point` is None) or when the raw number of `point` equals `raw`."""

    point: str | None
    raw: int | None
    rule: Linear


@dataclass(frozen=True, slots=True)
class Limit:
    """A raw limit that other points set: the rule applied to 1, rounded half away from zero.

    It does not apply while a point holds a raw number in one of the bands (low, high) of `unless`; `least` and
    `greatest` bound it always.
    """

    rule: Linear
    unless: tuple[tuple[str, tuple[tuple[int, int], ...]], ...]
    least: int
    greatest: int


Bound = int | Limit


@dataclass(frozen=True, slots=True)
class Interval:
    """A closed interval of raw numbers."""

    low: Bound
    high: Bound


@dataclass(frozen=True, slots=True)
class Allowed:
    """Which raw numbers may be written: a union of intervals in ascending order.

    `listed` says that the author wrote single numbers. For f32 and f64 the numbers are values in the unit, and `units`
    holds them instead.
    """

    intervals: tuple[Interval, ...]
    listed: bool
    units: tuple[tuple[Fraction, Fraction], ...]


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

    def holds(self, raw: int) -> bool:
        """Whether a raw number is this code."""
        return self.low <= raw <= self.high


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


@dataclass(frozen=True, slots=True)
class Point:
    """One addressable datum.

    `name` is unique but for variants: points of one name differ in `variant` ("axis=value"). `places` is empty when the
    manual prints no address. `scale` is None where the raw number is the value. `decimals` k fixes the unit of the
    integer path, 10^-k units; it is None where no 64-bit integer holds the counts, and there are none then.
    `encodes_values` is False where raw numbers, or what a scale multiplies them to, exceed 53 bits: values are decoded
    only. `most_raw` is how large a raw number may be for a scale that other points decide, where the type goes beyond:
    larger ones overflow. `default` is the factory setting in the unit, `default_raw` as it travels: each is None where
    only other points tell; a floating-point number has the first alone. `specials` are never computed with;
    `specials_of` names what gives those that are not the point's own to many points (a type, a group, a format).
    `steps` gives (from raw, step in raw). `generated` is False for what is only documented; `reason` says why.
    """

    name: str
    variant: str | None
    code: str | None
    group: str
    space: str
    places: tuple[Place, ...]
    references: Mapping[str, int | str]
    type: str
    bits: tuple[int, int] | None
    access: str
    title: Titles
    note: Titles
    unit: Unit
    scale: tuple[ScaleCase, ...] | None
    decimals: int | None
    allowed: Allowed
    default: Fraction | None
    default_raw: int | None
    steps: tuple[tuple[int, int], ...]
    enum: Enum | None
    flags: tuple[Flag, ...]
    specials: tuple[Special, ...]
    record: str | None
    set: int | None
    changes: str | None
    keeps: str | None
    conditions: tuple[str, ...]
    when: Condition | None
    since: str | None
    until: str | None
    was: tuple[str, ...]
    reserved: bool
    source: Source
    errata: tuple[str, ...]
    generated: bool
    reason: str | None
    telegram: str | None = None
    index: int | None = None
    text: Text | None = None
    digits: Digits | None = None
    fixed: Fixed | None = None
    changes_with: tuple[str, ...] = ()
    specials_of: str = ""
    encodes_values: bool = True
    most_raw: int | None = None
    untyped: str | None = None
    """What stands in place of a type: the manual's words for what no type says; empty where it does not settle it."""

    @property
    def raw_only(self) -> bool:
        """Whether nobody says what the words mean, but where they are: they are reached raw, by their address."""
        return not (self.generated or self.reserved) and self.access != "none" and bool(self.places)

    @property
    def info(self) -> TypeInfo:
        """What the point's wire type is."""
        return TYPES[self.type]

    @property
    def words(self) -> int:
        """How many 16-bit words (or single bits) the point takes; a bit group lies in one word."""
        if self.text is not None:
            return self.text.characters // 2
        if self.untyped is not None:
            return max(1, len(self.addresses))
        return 1 if self.bits else max(1, self.info.bits // 16)

    @property
    def width(self) -> int:
        """How many bits the raw number has."""
        return self.bits[0] - self.bits[1] + 1 if self.bits else self.info.bits

    @property
    def least(self) -> int:
        """The smallest raw number that the bits can hold."""
        return -(1 << (self.width - 1)) if self.info.signed else 0

    @property
    def greatest(self) -> int:
        """The largest raw number that the bits can hold."""
        return (1 << (self.width - self.info.signed)) - 1

    @property
    def outer(self) -> tuple[int, int]:
        """The least and greatest raw number that may ever be written; what the bits hold where nothing is said."""
        lows = [one.low if isinstance(one.low, int) else one.low.least for one in self.allowed.intervals]
        highs = [one.high if isinstance(one.high, int) else one.high.greatest for one in self.allowed.intervals]
        return max(min(lows, default=self.least), self.least), min(max(highs, default=self.greatest), self.greatest)

    @property
    def addresses(self) -> tuple[int, ...]:
        """The words where the point is read (or, if it cannot be read, written), the high part first; may be empty."""
        return self.places[0].addresses if self.places else ()

    @property
    def address(self) -> int | None:
        """The lowest address, which a request names; None when the manual prints none."""
        return min(self.addresses) if self.addresses else None

    @property
    def readable(self) -> bool:
        """Whether the device answers with the point."""
        return "r" in self.access

    @property
    def writable(self) -> bool:
        """Whether the device takes the point."""
        return "w" in self.access

    def special(self, raw: int) -> Special | None:
        """The special code that a raw number is, if it is one."""
        return next((one for one in self.specials if one.low <= raw <= one.high), None)

    @property
    def shared_codes(self) -> str:
        """What gives all special codes of the point to many points; empty where some are its own."""
        return "" if any(one.own for one in self.specials) else self.specials_of

    @property
    def form(self) -> str:
        """What a user sees: `float` (a pattern) `text digits enum flags bit scaled integer` (raw is the value)."""
        forms = (
            (self.info.floating, "float"),
            (self.text is not None, "text"),
            (self.digits is not None, "digits"),
            (self.enum is not None, "enum"),
            (bool(self.flags), "flags"),
            (self.type == "bit", "bit"),
            (self.scale is not None, "scaled"),
        )
        return next((form for holds, form in forms if holds), "integer")

    @property
    def item(self) -> str:
        """The name of generated items: the name, with the variant's value behind it."""
        return self.name if self.variant is None else f"{self.name}_{self.variant.partition('=')[2].lower()}"

    @property
    def arguments(self) -> tuple[str, ...]:
        """The points whose raw numbers encoding, decoding or checking needs, in a fixed order."""
        return tuple(dict.fromkeys((*self.scale_arguments, *self.limit_arguments)))

    @property
    def scale_arguments(self) -> tuple[str, ...]:
        """The points that the scale needs at run time."""
        names: dict[str, None] = {}
        for case in self.scale or ():
            if case.point is not None:
                names[case.point] = None
            names.update(dict.fromkeys(factor.point for factor in case.rule.factors))
        return tuple(names)

    @property
    def limit_arguments(self) -> tuple[str, ...]:
        """The points that the limits need at run time: their factors, and those whose codes lift them."""
        names: dict[str, None] = {}
        for interval in self.allowed.intervals:
            for bound in (interval.low, interval.high):
                if isinstance(bound, Limit):
                    names.update(dict.fromkeys(factor.point for factor in bound.rule.factors))
                    names.update(dict.fromkeys(name for name, codes in bound.unless if codes))
        return tuple(names)


@dataclass(frozen=True, slots=True)
class Group:
    """Points that the manual presents together."""

    name: str
    title: Titles
    note: Titles
    source: Source


@dataclass(frozen=True, slots=True)
class Erratum:
    """A place where the manual is wrong, unclear or silent: what is printed, what was taken, why, how sure that is."""

    id: str
    points: tuple[str, ...]
    where: str
    source: Source
    printed: str
    taken: str
    why: str
    certainty: str
    facts: tuple[str, ...] = ()
    """The keys of what is printed, where that is given as facts and not in words alone."""


@dataclass(frozen=True, slots=True)
class Frame:
    """A worked example of the manual. `answers` names the request that a response answers.

    `valid` is False when it is misprinted; `corrected` is the frame as it should read (the printed bytes when valid).
    `meaning` gives raw numbers by point name.
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
    pkw: int | None = None
    """USS: the words of the parameter part, as set for the link; 127 is variable."""
    can_id: int | None = None


@dataclass(frozen=True, slots=True)
class Role:
    """What one byte of a message carries.

    `constant` (number: the byte itself), `unit`, `address` and `raw` (number: how far the byte lies above bit 0),
    `multiplexer`, `word` (number: 2 * word of the frame, and 1 more for its low byte), `xor` (number: a mask of the
    bytes of the message that are combined).
    """

    kind: str
    number: int


@dataclass(frozen=True, slots=True)
class Message:
    """A layout of bytes with an identifier: `can_id`, plus the unit number if `adds_unit`."""

    name: str
    title: Titles
    direction: str
    answers: str | None
    can_id: int
    adds_unit: bool
    roles: tuple[Role, ...]
    source: Source

    @property
    def words(self) -> int:
        """How many words of a telegram one frame carries."""
        return sum(role.kind == "word" for role in self.roles) // 2


@dataclass(frozen=True, slots=True)
class Telegram:
    """A cyclic layout of `words` words, carried by frames of a message, or by the family's own frames."""

    name: str
    title: Titles
    direction: str
    words: int
    message: str | None
    source: Source


@dataclass(frozen=True, slots=True)
class Command:
    """A named constant write. `value` is None where any value does; `wears` is how many writes the memory stands."""

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
class Code:
    """A number of the protocol with a name: a function or an exception.

    `most` is the largest count of items in one request. `broadcast` says whether a function may be sent to all units at
    once; None is what the protocol says. `answers` are the codes of the other kind that belong to it: of a USS task its
    positive responses, of a response or an error the tasks that may get it; `refusals` the negative responses.
    """

    number: int
    name: str
    title: Titles
    most: int | None
    broadcast: bool | None = None
    answers: tuple[int, ...] = ()
    refusals: tuple[int, ...] = ()


@dataclass(frozen=True, slots=True)
class Block:
    """A read of consecutive addresses that respects limits and holes: `points` are the points that it brings."""

    space: str
    function: int
    address: int
    count: int
    points: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Bus:
    """What the family's frames need to know of this device."""

    framings: tuple[str, ...]
    units: tuple[int, int]
    broadcast: int | None
    functions: tuple[Code, ...]
    exceptions: tuple[Code, ...]
    gaps: Mapping[str, tuple[tuple[int, int], ...]]
    pad_coil_bytes: str | None
    timing: Mapping[str, str]
    serial: Mapping[str, Mapping[str, str]]
    note: Titles
    responses: tuple[Code, ...] = ()
    """USS: the response ids."""
    pkw: tuple[int, ...] = ()
    """USS: the lengths in words that the parameter part may have; 127 is variable."""
    pzd: tuple[int, int] = (0, 0)
    """USS: how many words of process data there may be."""
    variant_pzd: tuple[tuple[str, int], ...] = ()
    """USS: variants ("axis=value") that take at most so many words of process data."""
    bitrate: int | None = None
    identifier_bits: int | None = None


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
    """One product with one register map. `digest` covers what matters to code, and nothing else."""

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
