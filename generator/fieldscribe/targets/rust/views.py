"""What the Rust templates see: final identifiers, literals, expressions and comment text."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class FactorView:
    """One factor of a rule: the raw number it takes, the line and the bounds of an exponent (or empty), the method.

    `pattern` says that the raw number is the pattern of a floating-point number, which the method takes as it is.
    `codes` are conditions of which one holds while what is `held` is a special code.
    """

    raw: str
    pattern: bool
    bounds: str
    line: str
    method: str
    codes: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class RuleView:
    """A rule that holds where a raw number (empty: always) is a code: ratio, offset (or empty), factors."""

    held: str
    code: str
    ratio: str
    offset: str
    factors: tuple[FactorView, ...]


@dataclass(frozen=True, slots=True)
class LimitView:
    """A limit that other points set: a local, what skips it (raw number, codes), its bound then, rule and clamp."""

    local: str
    unless: tuple[tuple[str, str], ...]
    bound: str
    rule: RuleView
    clamp: str


@dataclass(frozen=True, slots=True)
class CheckView:
    """Whether a raw number may be written: conditions of which one has to hold; none if every number may.

    `number` is what the conditions are about, where that is not `raw` itself. `fixed` is a condition that has to hold
    as well (or empty), `call` what is asked instead of conditions (or empty).
    """

    report: str
    raw: str
    parameter: str
    number: str
    conditions: tuple[str, ...]
    limits: tuple[LimitView, ...]
    fixed: str = ""
    call: str = ""


@dataclass(frozen=True, slots=True)
class ReadView:
    """Decoding: types and expressions; `failing` if it can fail, `narrows` if a count has to become an `i64`.

    `beyond` tests for raw numbers that are too large for a scale with factors, or is empty; `by_rule` is the call that
    decodes by such a scale.
    """

    factors: str
    parameter: str
    failing: bool
    narrows: bool
    value: str
    count_type: str
    scaled: str
    count: str
    function: str
    beyond: str
    by_rule: str


@dataclass(frozen=True, slots=True)
class WriteView:
    """Encoding: the check, and how a value (`kind` says by which steps) and a count become a raw number.

    `bounded` says that counts within their bounds need no check, `fixed` is `raw` with its constant bits (or empty).
    """

    arguments: str
    parameter: str
    passed: str
    check: CheckView
    kind: str
    encodes: bool
    bounded: bool
    value: str
    count_type: str
    count_parameter: str
    within: str
    scaled: str
    count: str
    function: str
    address: str
    fixed: str


@dataclass(frozen=True, slots=True)
class ConstantView:
    """A constant of a point of its own: another numbering, or raw numbers that are no quantity."""

    doc: str
    lines: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class BitsView:
    """Where a bit group lies in its word."""

    shift: int
    mask: str
    extract: str


@dataclass(frozen=True, slots=True)
class OrderView:
    """Words whose high part does not come first: how many, their names from the high part on, and by address."""

    count: int
    by_rank: str
    by_address: str


@dataclass(frozen=True, slots=True)
class PointView:
    """One point.

    `scattered`: the words of a text do not come first to last; `traits`: what else it implements; `coded`: it has
    special codes.
    """

    doc: tuple[str, ...]
    alias: str
    name: str
    raw: str
    value: str
    constants: tuple[str, ...]
    order: OrderView | None
    scattered: bool
    bits: BitsView | None
    traits: tuple[tuple[str, ...], ...]
    rules: tuple[RuleView, ...]
    factors: str
    last_rule_holds: bool
    read: ReadView | None
    write: WriteView | None
    own_constants: tuple[ConstantView, ...]
    was: tuple[tuple[str, ...], ...]
    coded: bool


@dataclass(frozen=True, slots=True)
class ArgumentsView:
    """A struct of the raw numbers that a point needs."""

    doc: str
    name: str
    fields: tuple[tuple[str, str, str], ...]
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
