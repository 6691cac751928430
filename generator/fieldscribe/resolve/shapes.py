"""What the raw numbers of points are, and which may be written: once for all points that are alike."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

from fieldscribe.arithmetic.words import ends_of
from fieldscribe.language.nodes import Map
from fieldscribe.model import TYPES, Allowed, Enum, Interner, Shape
from fieldscribe.resolve.alike import Once, frozen
from fieldscribe.resolve.display import display_of
from fieldscribe.resolve.enums import enum_of, flags_of
from fieldscribe.resolve.integer_path import asks_limits, paths_of
from fieldscribe.resolve.scales import UnknownError
from fieldscribe.resolve.scope import humanised
from fieldscribe.resolve.special_codes import SpecialCodes, quantities
from fieldscribe.resolve.symbols import bits_of, space_of, type_of
from fieldscribe.resolve.word_contents import allowed_digits, digits_of, fixed_of, text_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fieldscribe.model import ScaleCase, Special
    from fieldscribe.resolve.addresses import Places
    from fieldscribe.resolve.bounds import Bounds
    from fieldscribe.resolve.point_facts import PointFacts
    from fieldscribe.resolve.ranges import Ranges
    from fieldscribe.resolve.scope import Scope

_WHOLE = re.compile(r"(-?[0-9]{1,9})\.\.(-?[0-9]{1,9})")
"""An interval of whole numbers as most manuals write it; all others are for the parser of formulas."""


class Word(NamedTuple):
    """What is known of a point before any formula is read: its space, type, bits of the word and special codes.

    `width` is how many bits the raw number has, `holds` the least and greatest raw number.
    """

    space: str
    type: str
    bits: tuple[int, int] | None
    width: int
    holds: tuple[int, int]
    specials: tuple[Special, ...]
    specials_of: str


class Meaning(NamedTuple):
    """The shape of a point, its limits, and whether only raw numbers can be computed.

    `free` says that the shape does not depend on the limits: any interval that the type holds may stand in their place.
    """

    shape: Shape
    allowed: Allowed
    raw_alone: bool
    free: bool


class Words:
    """The words of all points."""

    def __init__(self, scope: Scope) -> None:
        self._scope = scope
        self._codes = SpecialCodes(scope)
        self._codes.check_types()
        self._once: Once[Word] = Once(scope.report)

    def of(self, facts: PointFacts, kind: int) -> Word:
        """The word of a point."""
        return self._once.of(kind, facts, self._word, _always)

    def _word(self, facts: PointFacts) -> Word:
        space = space_of(self._scope, facts)
        bits = bits_of(self._scope, facts, space)
        name = type_of(self._scope, facts, space, bits)
        width = TYPES[name].bits if bits is None else bits[0] - bits[1] + 1
        holds = ends_of(width, signed=TYPES[name].signed)
        return Word(space, name, bits, width, holds, *self._codes.of(facts, name, bits))


class Meanings:
    """The shapes and limits of all points."""

    def __init__(self, scope: Scope, words: Mapping[PointFacts, Word], ranges: Ranges, places: Places) -> None:
        self._scope, self._words, self._ranges, self._places = scope, words, ranges, places
        self._interner = Interner()
        self._once: Once[Meaning] = Once(scope.report)
        self._free: dict[int, Meaning] = {}

    def of(self, facts: PointFacts, kind: int) -> tuple[Meaning, Allowed]:
        """The meaning of a point, which is its kind's, and limits of its own."""
        limits, free = facts.get("range"), self._free.get(kind)
        if free is not None and (ends := _plain_ends(limits, self._words[facts].holds)) is not None:
            return free, self._interner.interval(*ends)
        whole = kind, frozen(limits), frozen(facts.get("range_in_units"))
        meaning = self._once.of(whole, facts, self._computed, _is_general)
        if meaning.free and _is_general(meaning):
            self._free.setdefault(kind, meaning)
        return self._with_own_enum(facts, meaning), meaning.allowed

    def _computed(self, facts: PointFacts) -> Meaning:
        word = self._words[facts]
        meaning = _meaning(self._scope, facts, word, self._places.access(facts, word.space), self._ranges)
        shape, allowed = self._interner.shape(meaning.shape), self._interner.allowed(meaning.allowed)
        return meaning._replace(shape=shape, allowed=allowed)

    def _with_own_enum(self, facts: PointFacts, meaning: Meaning) -> Meaning:
        """The meaning with the names of numbers called after this point, if they stand in its row."""
        shape, name = meaning.shape, facts.enum_name
        enum = shape.enum
        if enum is None or enum.name == name or not isinstance(facts.get("enum"), Map):
            return meaning
        own = Enum(name, {"en": humanised(name)}, enum.entries, enum.closed, facts.old_enum_names)
        return meaning._replace(shape=self._interner.shape(replace(shape, enum=own)))


def _always(_: Word) -> bool:
    return True


def _is_general(meaning: Meaning) -> bool:
    """Whether alike points mean the same: no other point comes in, nor the point's own name in that of digits."""
    return meaning.shape.digits is None and not meaning.shape.scale_arguments and not meaning.allowed.moves


def _plain_ends(limits: object, holds: tuple[int, int]) -> tuple[int, int] | None:
    """The ends of an interval of whole numbers that the type holds; None for anything else."""
    match = _WHOLE.fullmatch(limits) if isinstance(limits, str) else None
    if match is None:
        return None
    low, high = int(match[1]), int(match[2])
    return (low, high) if holds[0] <= low <= high <= holds[1] else None


def _meaning(scope: Scope, facts: PointFacts, word: Word, access: str, ranges: Ranges) -> Meaning:
    """What the raw numbers of a point are and which may be written."""
    text, digits = text_of(scope, facts), digits_of(scope, facts)
    ranged = facts.layer("range") is not None or facts.layer("range_in_units") is not None
    said_open = bool(facts.get("open", False))
    enum = None if facts.text else enum_of(scope, facts, closed=not ranged and not said_open)
    allowed = ranges.allowed(facts, enum)
    if digits is not None and not ranged:
        allowed = allowed_digits(scope, facts, digits, word.holds[1])
    if word.specials:
        allowed = quantities(scope, facts, allowed, word.specials)
    if enum is not None and not said_open and _all_named(allowed, enum):
        enum = enum_of(scope, facts, closed=True)
    cases = _cases(facts, ranges.bounds)
    paths = paths_of(facts, cases, ranges.bounds)
    shape = Shape(
        type=word.type,
        width=word.width,
        access=access,
        scale=cases,
        decimals=paths.decimals,
        encodes_values=paths.encodes_values,
        most_raw=paths.most_raw,
        enum=enum,
        flags=flags_of(scope, facts, word.bits, word.width),
        specials=word.specials,
        specials_of=word.specials_of,
        text=text,
        digits=digits,
        fixed=fixed_of(scope, facts, word.bits, word.width) if "w" in access else None,
    )
    shown = display_of(facts, shape, ranges.bounds)
    shape = shape if shown is None else replace(shape, display=shown)
    return Meaning(shape, allowed, paths.raw_alone, ranged and _is_free(facts, shape, word))


def _is_free(facts: PointFacts, shape: Shape, word: Word) -> bool:
    """Whether any interval of whole numbers could stand in place of the limits, and the shape would be the same."""
    named = shape.enum is not None or shape.digits is not None or bool(word.specials)
    other = facts.floating or facts.text or facts.layer("range_in_units") is not None
    return not (named or other or (shape.scale is not None and asks_limits(word.holds)))


def _cases(facts: PointFacts, bounds: Bounds) -> tuple[ScaleCase, ...] | None:
    """The cases of the point's scale; None without a scale, or if an exponent in it is too large (a finding)."""
    cases = None if facts.floating else bounds.scales.cases(facts)
    if cases is None or not any(case.rule.factors for case in cases):
        return cases
    try:
        return tuple([replace(case, rule=bounds.with_exponents(case.rule, facts.span("scale"))) for case in cases])
    except UnknownError:
        facts.failed.add("scale")
        return None


def _all_named(allowed: Allowed, enum: Enum) -> bool:
    """Whether every number that may be written has a name."""
    numbers = {entry.raw for entry in enum.entries}
    return not allowed.moves and all(
        high - low < len(numbers) and numbers.issuperset(range(low, high + 1)) for low, high in allowed.fixed
    )
