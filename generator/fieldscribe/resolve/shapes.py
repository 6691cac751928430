"""The shape and the limits of each point: what its raw numbers mean, and which of them may be written.

Points of one kind share their shape, and points with the same limits share these: both are computed once. `FactKeys`
tells the kinds: the points of a kind state the same facts. `Memo` remembers what follows from these.
"""

import re
from collections.abc import Callable, Hashable, Mapping
from dataclasses import replace
from decimal import Decimal
from typing import Generic, NamedTuple, TypeVar

from fieldscribe.diagnostics import Report
from fieldscribe.language.keys import identifying_keys, keys_of
from fieldscribe.language.keys.places import POINT, SOURCE
from fieldscribe.language.nodes import Map, Seq
from fieldscribe.model import Allowed, Enum, Interner, ScaleCase, Shape
from fieldscribe.resolve.addresses import Places
from fieldscribe.resolve.bounds import Bounds
from fieldscribe.resolve.encodings import Encoding
from fieldscribe.resolve.integer_path import asks_limits, paths_of, shows
from fieldscribe.resolve.point_facts import PointFacts
from fieldscribe.resolve.ranges import Ranges
from fieldscribe.resolve.scope import Scope
from fieldscribe.resolve.special_codes import quantities
from fieldscribe.resolve.values import FactError
from fieldscribe.resolve.word_contents import allowed_digits, digits_of, enum_of, epoch_of, fixed_of, flags_of, text_of

Fact = TypeVar("Fact")

_IDENTITY = identifying_keys(POINT) | {*keys_of(SOURCE), "source", "lines", "note", "was", "write_at", "each"}
"""Keys that identify or annotate a point: no shape, scale or limit depends on them."""

_NUMBERS = frozenset(("range", "range_in_units", "default", "default_in_units"))
"""Keys of which only the presence counts, because each point has its own number there."""

_WHOLE = re.compile(r"(-?[0-9]{1,9})\.\.(-?[0-9]{1,9})")
"""An interval of whole numbers in its usual form; the parser of formulas reads all others."""

_NO_QUANTITY = {
    "enum": "a number with names",
    "flags": "a word of flags",
    "digits": "a word of digits",
    "bit": "a single bit",
}
"""The forms of points that are not a quantity, in words."""


class FactKeys:
    """Numbers kinds of points: those of a kind state the same facts, except for identity and numbers of limits."""

    def __init__(self) -> None:
        self._keys: dict[Hashable, int] = {}
        self._layers: dict[int, Hashable] = {}

    def of(self, point: PointFacts) -> int:
        """Return the kind of a point. A point with a variant or with findings is a kind of its own."""
        if point.variant is not None or point.failed:
            stated: Hashable = point
        else:
            first, *others = point.layers
            shared = tuple(map(self._shared, others)) if others else ()
            stated = id(point.group), first is point.node, bool(point.hidden), _stated(first), shared
        return self._keys.setdefault(stated, len(self._keys))

    def _shared(self, layer: Map) -> Hashable:
        """Return what a shared layer states, such as a format."""
        if id(layer) not in self._layers:
            self._layers[id(layer)] = _stated(layer)
        return self._layers[id(layer)]


def _stated(layer: Map) -> Hashable:
    return tuple(
        [
            key if key in _NUMBERS else (key, value if value.__class__ is str else hashable(value))
            for key, value in layer.items()
            if key not in _IDENTITY
        ]
    )


def hashable(value: object) -> Hashable:
    """Return a YAML value as a hashable one, equal for equal texts."""
    if isinstance(value, Map):
        return (*value.broken, *[(key, hashable(inner)) for key, inner in value.items()])
    if isinstance(value, Seq):
        return tuple(map(hashable, value))
    return str(value) if isinstance(value, Decimal) else (value.__class__, value)


class Memo(Generic[Fact]):
    """Remembers a fact by what it follows from. A fact with a finding is computed again for every point."""

    def __init__(self, report: Report) -> None:
        self._report = report
        self._known: dict[Hashable, Fact] = {}

    def of(
        self,
        key: Hashable,
        point: PointFacts,
        work: Callable[[PointFacts], Fact],
        general: Callable[[Fact], bool] = lambda _: True,
    ) -> Fact:
        """Return the fact of a point; `general` says whether it holds for all points with the key."""
        known = self._known.get(key)
        if known is not None:
            return known
        before = self._report.count
        fact = work(point)
        sound = self._report.count == before and not point.failed and not self._report.full
        if sound and general(fact):
            self._known[key] = fact
        return fact


class ShapeAndLimits(NamedTuple):
    """The shape of a point and its limits.

    `raw_alone` says that code computes no values, only raw numbers. `free` says that the shape does not depend on the
    limits: it is the same for any interval that the type holds.
    """

    shape: Shape
    allowed: Allowed
    raw_alone: bool
    free: bool

    @property
    def is_general(self) -> bool:
        """Return True if all points of a kind share this: it depends on no other point."""
        return not self.shape.scale_arguments and not self.allowed.moves


class Shapes:
    """Resolves the shapes and limits of all points."""

    def __init__(self, scope: Scope, encodings: Mapping[PointFacts, Encoding], ranges: Ranges, places: Places) -> None:
        self._scope, self._encodings, self._ranges, self._places = scope, encodings, ranges, places
        self._interner = Interner()
        self._memo: Memo[ShapeAndLimits] = Memo(scope.report)
        self._free: dict[int, ShapeAndLimits] = {}

    def of(self, facts: PointFacts, kind: int) -> ShapeAndLimits:
        """Return the shape of a point and its limits; `kind` is the same for points that differ in numbers only."""
        limits, free = facts.get("range"), self._free.get(kind)
        if free is not None and (ends := _plain_ends(limits, self._encodings[facts].holds)) is not None:
            return ShapeAndLimits(free.shape, self._interner.interval(*ends), free.raw_alone, free=True)
        whole = kind, hashable(limits), hashable(facts.get("range_in_units"))
        found = self._memo.of(whole, facts, self._shape_of, lambda new: new.is_general)
        if found.free and found.is_general:
            self._free.setdefault(kind, found)
        return found

    def _shape_of(self, facts: PointFacts) -> ShapeAndLimits:
        scope, bounds, encoding = self._scope, self._ranges.bounds, self._encodings[facts]
        access = self._places.access(facts, encoding.space)
        text, digits = text_of(scope, facts), digits_of(scope, facts)
        ranged = facts.layer("range") is not None or facts.layer("range_in_units") is not None
        stated_open = bool(facts.get("open", False))
        enum = None if facts.text else enum_of(scope, facts, closed=not ranged and not stated_open)
        allowed = self._ranges.allowed(facts, enum)
        if digits is not None and not ranged:
            allowed = allowed_digits(scope, facts, digits, encoding.holds[1])
        if encoding.specials:
            allowed = quantities(scope, facts, allowed, encoding.specials)
        if enum is not None and not stated_open and _all_named(allowed, enum):
            enum = enum_of(scope, facts, closed=True)
        cases = _cases(facts, bounds)
        paths = paths_of(facts, cases, bounds)
        if cases is not None and paths.in_ranges:
            cases = tuple([replace(case, rule=bounds.with_ranges(case.rule)) for case in cases])
        shape = Shape(
            type=encoding.type,
            width=encoding.width,
            access=access,
            scale=cases,
            decimals=paths.decimals,
            encodes_values=paths.encodes_values,
            most_raw=paths.most_raw,
            enum=enum,
            flags=flags_of(scope, facts, encoding.bits, encoding.width),
            specials=encoding.specials,
            specials_of=encoding.specials_of,
            text=text,
            digits=digits,
            patterns=facts.pattern_bits > 0,
            swapped=encoding.swapped and facts.untyped is None,
            coding=encoding.coding,
            fixed=fixed_of(scope, facts, encoding.bits, encoding.width) if "w" in access else None,
        )
        display, epoch = _display_of(facts, shape, bounds), epoch_of(scope, facts, shape)
        shape = self._interner.shape(replace(shape, display=display, epoch=epoch))
        free = ranged and _is_free(facts, shape, encoding)
        return ShapeAndLimits(shape, self._interner.allowed(allowed), paths.raw_alone, free)


def _plain_ends(limits: object, holds: tuple[int, int]) -> tuple[int, int] | None:
    """Return the ends of an interval of whole numbers that the type holds; None for anything else."""
    match = _WHOLE.fullmatch(limits) if isinstance(limits, str) else None
    if match is None:
        return None
    low, high = int(match[1]), int(match[2])
    return (low, high) if holds[0] <= low <= high <= holds[1] else None


def _is_free(facts: PointFacts, shape: Shape, encoding: Encoding) -> bool:
    """Return True if the shape is the same for any interval of whole numbers as limits."""
    named = shape.enum is not None or shape.digits is not None or bool(encoding.specials)
    other = facts.floating or facts.text or facts.layer("range_in_units") is not None
    return not (named or other or (shape.scale is not None and asks_limits(encoding.holds)))


def _cases(facts: PointFacts, bounds: Bounds) -> tuple[ScaleCase, ...] | None:
    """Return the cases of the point's scale; None without a scale, or if an exponent in it is too large (a finding)."""
    cases = None if facts.floating else bounds.scales.cases(facts)
    if cases is None or not any(case.rule.factors for case in cases):
        return cases
    try:
        return tuple([replace(case, rule=bounds.with_exponents(case.rule, facts.span("scale"))) for case in cases])
    except FactError as error:
        error.report(bounds.scales.scope.report)
        facts.failed.add("scale")
        return None


def _all_named(allowed: Allowed, enum: Enum) -> bool:
    """Return True if every number that may be written has a name."""
    numbers = {entry.raw for entry in enum.entries}
    return not allowed.moves and all(
        high - low < len(numbers) and numbers.issuperset(range(low, high + 1)) for low, high in allowed.fixed
    )


def _display_of(facts: PointFacts, shape: Shape, bounds: Bounds) -> int | None:
    """Return the decimals of `display`; report a point without a value to show with them."""
    display = facts.get("display")
    if display is None:
        return None
    decimals: int = display["decimals"]
    what = _NO_QUANTITY.get(shape.form) if shape.text is None else shape.text.kind
    report = bounds.scales.scope.report
    if what is not None:
        if facts.layer("display") is not facts.group:  # a group's `display` is for its quantities
            message = f"`{facts.name}` is {what}, which has no value to show with decimals"
            report.error("display-fact", message, facts.span("display"), "leave `display` out")
        return None
    counted = shape.decimals is not None
    exact = [
        count
        for count in range(decimals + 1)
        if shape.scale is None or shows(facts, shape.scale, bounds, count, counted=counted)
    ]
    if decimals not in exact:
        message = f"`decimals: {decimals}` needs integers that are wider than code computes with"
        hint = f"write `decimals: {exact[-1]}`" if exact else "leave `display` out: no decimals of this scale are exact"
        report.error("display-fact", message, display.span("decimals"), hint)
        return None
    return decimals
