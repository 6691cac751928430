"""What the C templates see: final identifiers, literals, masks, expressions and comments, nothing left to decide."""

from __future__ import annotations

from dataclasses import dataclass

Define = tuple[str, str]
"""A macro's name and its literal."""


@dataclass(frozen=True, slots=True)
class EnumView:
    """Enumerators (name, literal, comment) and the function that gives their text."""

    title: str
    entries: tuple[tuple[str, str, str], ...]
    cases: tuple[tuple[str, str], ...]
    fits_int: bool
    function: str
    number_type: str


@dataclass(frozen=True, slots=True)
class Step:
    """One factor of a rule: `kind` is plain, checked (may overflow) or ten.

    `zero` asks for a test before; `beyond` tests whether an exponent is more than its point may hold. `pattern` is the
    raw number of an f32 point, whose mantissa is the factor.
    """

    kind: str
    target: str
    factor: str
    zero: bool
    beyond: str
    pattern: str = ""


@dataclass(frozen=True, slots=True)
class RuleCase:
    """A linear rule whose factors are known at run time; `test` is empty when it always holds.

    `codes` tests whether a factor's point holds a special code, or is empty.
    """

    test: str
    num: str
    den: str
    offset: str
    parts: str
    steps: tuple[Step, ...]
    shifts: bool
    lifts: bool
    codes: str = ""


@dataclass(frozen=True, slots=True)
class LimitView:
    """A limit that other points set.

    `start` stands while the test `applies` fails, and always bounds the limit: `clamp` is that comparison, or empty.
    """

    name: str
    start: str
    applies: str
    zeros: tuple[str, ...]
    number: str
    clamp: str
    rule: RuleCase | None


@dataclass(frozen=True, slots=True)
class CheckView:
    """May a raw number be written? `test` is about `raw`, or about `number` where limits are computed before."""

    limits: tuple[LimitView, ...]
    number_type: str
    test: str
    refused: str
    number: str = "raw"


@dataclass(frozen=True, slots=True)
class PlainView:
    """The raw number is the value; `number` is the raw number where constant bits are put in, else empty."""

    value_type: str
    outside: str
    number: str


@dataclass(frozen=True, slots=True)
class ScaledView:
    """A scale known at compile time."""

    count_type: str
    count_beyond: str
    count_outside: str
    raw_of_count: str
    count_of_raw: str
    real: str
    round: str
    whole_type: str
    scaled: str
    value_of_raw: str


@dataclass(frozen=True, slots=True)
class RuledView:
    """A scale that other points decide at run time; `beyond` tests for raw numbers too large for it, or is empty.

    `parts` are the sign and the size of a raw number that only a division of 128 bits decodes.
    """

    cases: tuple[RuleCase, ...]
    total: bool
    tens: str
    pass_scale: str
    beyond: str
    parts: tuple[str, str] | None


@dataclass(frozen=True, slots=True)
class FloatView:
    """The raw number is the bit pattern of a floating-point number.

    `nan` and `inside` are tests of `order`, an integer of `order_type` that orders patterns as the numbers are ordered.
    """

    real: str
    bits: int
    order_type: str
    nan: str
    inside: str


@dataclass(frozen=True, slots=True)
class TextView:
    """Characters, two a word; `refused` tests whether `character` is none of the encoding."""

    words: int
    characters: int
    refused: str
    addresses: str


@dataclass(frozen=True, slots=True)
class DigitsView:
    """Decimal digits, the highest first; `known` tests whether `digit` is one of the named numbers."""

    count: int
    digit_type: str
    known: str


Codec = PlainView | ScaledView | RuledView | FloatView | TextView | DigitsView


@dataclass(frozen=True, slots=True)
class WordsView:
    """How raw lies in words, in address order; `bits` is the unsigned type to shift in, empty for a single word."""

    count: int
    bits: str
    to_words: tuple[tuple[int, str], ...]
    from_words: str


@dataclass(frozen=True, slots=True)
class BitsView:
    """How raw lies inside a word that others share."""

    extract: str
    insert: str


@dataclass(frozen=True, slots=True)
class FlagView:
    """A number of several bits inside the raw number."""

    function: str
    number_type: str
    number: str


@dataclass(frozen=True, slots=True)
class CodesView:
    """A set of special codes: their macros where several points share them, tests of `raw`, and (test, name)."""

    comment: str
    defines: tuple[Define, ...]
    name: str
    raw_type: str
    special: str
    no_value: str
    names: tuple[tuple[str, str], ...]


@dataclass(frozen=True, slots=True)
class SpecialView:
    """The special codes of a point.

    `codes` is None where they are shared and stand before; `test` is the function that knows them, `written` a test of
    `raw` for those that may be written. `aliases` call the functions of shared codes by the point's name.
    """

    codes: CodesView | None
    test: str
    written: str
    aliases: tuple[Define, ...]


@dataclass(frozen=True, slots=True)
class PointView:
    """One generated point."""

    function: str
    macro: str
    item: str
    comment: tuple[str, ...]
    defines: tuple[Define, ...]
    enum: EnumView | None
    shape: str
    codec: Codec
    raw_type: str
    from_whole: str
    from_value: str
    counts: bool
    encodes: bool
    readable: bool
    writable: bool
    check: CheckView | None
    recheck: bool
    special: SpecialView | None
    encode_min: str
    encode_max: str
    scale_arguments: tuple[str, ...]
    limit_arguments: tuple[str, ...]
    declare_all: str
    declare_scale: str
    declare_limits: str
    pass_limits: str
    words: WordsView | None
    bits: BitsView | None
    flags: tuple[FlagView, ...]


@dataclass(frozen=True, slots=True)
class RemarkView:
    """A point that is not generated: why, and where it is if firmware may reach it by its raw words."""

    item: str
    comment: tuple[str, ...]
    defines: tuple[Define, ...]


@dataclass(frozen=True, slots=True)
class GroupView:
    """A section of the header: generated points, and remarks on those that are not."""

    title: str
    entries: tuple[tuple[PointView | None, RemarkView], ...]


@dataclass(frozen=True, slots=True)
class Needs:
    """Which shared helpers the header holds.

    `computes` says that some function takes or gives a floating-point number, `double` that it is never a float.
    """

    signed: bool
    signed32: bool
    signed64: bool
    divide: bool
    divide_wide: bool
    real: bool
    times: bool
    times_wide: bool
    round: bool
    round_wide: bool
    f32: bool
    f64: bool
    f32_encodes: bool
    f64_encodes: bool
    quotient: bool
    rules_wide: bool
    f32_order: bool
    f64_order: bool
    rules: bool
    tens: bool
    shifts: bool
    lifts: bool
    floats: bool
    computes: bool
    double: bool


@dataclass(frozen=True, slots=True)
class TelegramView:
    """A telegram: the enumerator that names it, its number, and the macro that says how many words it has."""

    title: str
    name: str
    number: int
    words_name: str
    words: int


@dataclass(frozen=True, slots=True)
class AliasView:
    """An old name of something that belongs to a renamed point; `sort` tells numbers, texts and functions apart."""

    old_item: str
    item: str
    old: str
    new: str
    sort: str


@dataclass(frozen=True, slots=True)
class DeviceView:
    """The header of a device."""

    head: tuple[str, ...]
    title: str
    file: str
    guard: str
    prefix: str
    upper: str
    version: str
    digest: str
    spaces: tuple[tuple[str, int], ...]
    telegrams: tuple[TelegramView, ...]
    groups: tuple[GroupView, ...]
    aliases: tuple[AliasView, ...]
    needs: Needs
