"""The facts that many points share: scales, limits, and all else about raw numbers, without names and addresses.

Scales and limits are exact linear rules, which may depend on other points.
"""

from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property

from fieldscribe.model.numbers import TYPES, Digits, Enum, Fixed, Flag, Special, Text, TypeInfo


@dataclass(frozen=True, slots=True)
class Factor:
    """A run-time factor: (raw * slope + intercept) of a point, or ten to the power of that; `power` is 1 or -1.

    `within` limits the raw numbers of the point (None: no limit); with others, the rule overflows.
    """

    point: str
    slope: int
    intercept: int
    power: int
    ten_to: bool
    within: tuple[int, int] | None = None


@dataclass(frozen=True, slots=True)
class Linear:
    """An exact linear rule: result = argument * ratio * product(factors) + offset."""

    ratio: Fraction
    offset: Fraction
    factors: tuple[Factor, ...]

    def at(self, argument: Fraction) -> Fraction:
        """Return the result of a rule without factors."""
        return argument * self.ratio + self.offset


@dataclass(frozen=True, slots=True)
class ScaleCase:
    """raw = `rule`(value). It holds always if `point` is None, else while the raw number of `point` equals `raw`.

    `written` is the formula as the author wrote it. It is for people and not a fact: equal rules are equal, and points
    whose rules are equal show the text of the first.
    """

    point: str | None
    raw: int | None
    rule: Linear
    written: str = field(default="", compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Limit:
    """A raw limit that depends on other points: the rule applied to 1, rounded half away from zero.

    It is suspended while a point holds a raw number in one of the bands (low, high) of `unless`. It always lies within
    `least` and `greatest`.
    """

    rule: Linear
    unless: tuple[tuple[str, tuple[tuple[int, int], ...]], ...]
    least: int
    greatest: int

    def outermost(self, *, low: bool) -> int:
        """Return the outermost raw number that the limit can be, as the lower or the upper end of an interval."""
        return self.least if low else self.greatest


Bound = int | Limit


@dataclass(frozen=True, slots=True)
class Interval:
    """A closed interval of raw numbers."""

    low: Bound
    high: Bound

    @property
    def outer(self) -> tuple[int, int]:
        """Return the ends, with limits that depend on other points at their widest."""
        low, high = self.low, self.high
        return low if isinstance(low, int) else low.least, high if isinstance(high, int) else high.greatest

    @property
    def fixed(self) -> tuple[int, int] | None:
        """Return the ends; None if one of them depends on other points."""
        return (self.low, self.high) if isinstance(self.low, int) and isinstance(self.high, int) else None


@dataclass(frozen=True)
class Allowed:
    """Which raw numbers may be written: a union of intervals in ascending order.

    `listed` says that the author wrote single numbers. `units` holds limits in the unit, for f32, f64, and where the
    scale is unknown. Points with the same limits share one object, so that derived facts are computed once.
    """

    intervals: tuple[Interval, ...]
    listed: bool
    units: tuple[tuple[Fraction, Fraction], ...]

    @cached_property
    def outer(self) -> tuple[int, int] | None:
        """Return the least and greatest raw number of all intervals; None if there are none."""
        ends = [interval.outer for interval in self.intervals]
        return (min(low for low, _ in ends), max(high for _, high in ends)) if ends else None

    @cached_property
    def fixed(self) -> tuple[tuple[int, int], ...]:
        """Return the intervals that depend on no other point."""
        return tuple(interval.fixed for interval in self.intervals if interval.fixed is not None)

    @property
    def moves(self) -> bool:
        """Return True if a limit depends on other points."""
        return len(self.fixed) < len(self.intervals)

    @cached_property
    def arguments(self) -> tuple[str, ...]:
        """Return the points that the limits need at run time: factors, and points whose codes suspend a limit."""
        names: dict[str, None] = {}
        for interval in self.intervals if self.moves else ():
            for bound in (interval.low, interval.high):
                if isinstance(bound, Limit):
                    names.update(dict.fromkeys(factor.point for factor in bound.rule.factors))
                    names.update(dict.fromkeys(name for name, _ in bound.unless))
        return tuple(names)

    def holds(self, raw: int) -> bool:
        """Return True if a raw number can be allowed, with limits that depend on other points at their widest."""
        return any(low <= raw <= high for low, high in (interval.outer for interval in self.intervals))


@dataclass(frozen=True)
class Shape:
    """What the raw numbers of points are: their type, their meaning, and whether they can be read and written.

    `type` is the type that code uses for the raw number. `width` is the number of its bits: all of the type, or
    those of a bit group or of a narrower wire type. `scale` is None if the raw number is the value. `decimals` k
    fixes the unit of the integer path, 10^-k units; it is None if the counts do not fit 64 bits, and then the point
    has no integer path. `encodes_values` is False if raw numbers or the products of the scale exceed 53 bits: then
    values are only decoded. `most_raw` is the greatest raw number that a run-time scale can compute with, if the
    type holds larger ones: those are an overflow. `specials` are not quantities; `specials_of` names the type, group
    or format of those that the point shares with others. `display` is the number of decimals that people see, None
    if the description gives none; no computation depends on it. `patterns` is True if an enum names floating-point
    numbers: raw numbers are their patterns. `swapped` is True if the low byte of each word comes first.
    `coding` says how the bits hold the raw number if that is neither plain nor two's complement: `bcd` or `sign and
    magnitude`. `epoch` is the date (`1970-01-01`) from which the value counts seconds, empty if it does not.

    Equal shapes are one object, so that the facts derived below are computed once.
    """

    type: str
    width: int
    access: str
    scale: tuple[ScaleCase, ...] | None
    decimals: int | None
    enum: Enum | None
    flags: tuple[Flag, ...]
    specials: tuple[Special, ...]
    specials_of: str = ""
    text: Text | None = None
    digits: Digits | None = None
    fixed: Fixed | None = None
    encodes_values: bool = True
    most_raw: int | None = None
    display: int | None = None
    patterns: bool = False
    swapped: bool = False
    coding: str = ""
    epoch: str = ""

    def __hash__(self) -> int:
        """Hash the facts that usually differ: titles have no hash. Equality compares all facts."""
        enum = () if self.enum is None else (self.enum.name, self.enum.closed)
        names = tuple([flag.name for flag in self.flags]), tuple([special.name for special in self.specials])
        return hash((self.type, self.width, self.access, self.scale, self.decimals, enum, names, self.fixed))

    @cached_property
    def info(self) -> TypeInfo:
        """Return the facts of the wire type."""
        return TYPES[self.type]

    @cached_property
    def words(self) -> int:
        """Return how many 16-bit words (or single bits) a point takes; a bit group lies in one word."""
        return -(-self.width // 16) if self.text is None else self.text.words

    @cached_property
    def wire_type(self) -> str:
        """Return the type on the wire; code may hold it in a wider one (`u24`), or as a pattern (`f32`)."""
        if self.patterns:
            return f"f{self.width}"
        if self.text is not None and self.text.is_bytes:
            return "bytes"
        return f"{self.type[0]}{self.width}" if self.narrow else self.type

    @cached_property
    def narrow(self) -> bool:
        """Return True if the raw number fills whole words, and its type in code is wider."""
        return 16 < self.width < self.info.bits

    @cached_property
    def least(self) -> int:
        """Return the least raw number that the bits can hold."""
        return -(1 << (self.width - 1)) if self.info.signed else 0

    @cached_property
    def greatest(self) -> int:
        """Return the greatest raw number that the bits can hold."""
        return (1 << (self.width - self.info.signed)) - 1

    @cached_property
    def held(self) -> tuple[int, int]:
        """Return the least and greatest number of the wire type; for a bit group, that of its whole word."""
        bits, signed = self.info.bits, self.info.signed
        return (-(1 << (bits - 1)) if signed else 0, (1 << (bits - signed)) - 1)

    @cached_property
    def named_numbers(self) -> Enum | None:
        """Return the enum of the numbers, or of each of their digits."""
        return self.enum if self.digits is None else self.digits.enum

    @cached_property
    def readable(self) -> bool:
        """Return True if the point can be read."""
        return "r" in self.access

    @cached_property
    def writable(self) -> bool:
        """Return True if the point can be written."""
        return "w" in self.access

    @cached_property
    def shared_codes(self) -> str:
        """Return the name of the shared special codes if the point has no others; else an empty text."""
        return "" if any(not code.shared for code in self.specials) else self.specials_of

    @cached_property
    def form(self) -> str:
        """Return the form that users see: `float` (a pattern), `text`, ..., or `integer` (the raw number)."""
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

    @cached_property
    def has_counts(self) -> bool:
        """Return True if integer code counts the value in 10^-decimals units; an f32 point must say in which."""
        return bool(self.decimals) if self.type == "f32" else self.form == "scaled" and self.decimals is not None

    @cached_property
    def fixed_scale(self) -> Linear | None:
        """Return the rule of a scale that depends on no other point; else None."""
        return self.scale[0].rule if self.scale is not None and not self.scale_arguments else None

    @cached_property
    def scale_arguments(self) -> tuple[str, ...]:
        """Return the points that the scale needs at run time."""
        names: dict[str, None] = {}
        for case in self.scale or ():
            if case.point is not None:
                names[case.point] = None
            names.update(dict.fromkeys(factor.point for factor in case.rule.factors))
        return tuple(names)


class Interner:
    """Keeps one object for all equal shapes and limits, so that derived facts are computed once."""

    def __init__(self) -> None:
        self._shapes: dict[Shape, Shape] = {}
        self._allowed: dict[Allowed, Allowed] = {}
        self._intervals: dict[tuple[int, int], Allowed] = {}

    def shape(self, shape: Shape) -> Shape:
        """Return the first shape that is equal."""
        return self._shapes.setdefault(shape, shape)

    def interval(self, low: int, high: int) -> Allowed:
        """Return the limits of a single interval."""
        known = self._intervals.get((low, high))
        if known is None:
            known = self._intervals[low, high] = self.allowed(Allowed((Interval(low, high),), False, ()))
        return known

    def allowed(self, allowed: Allowed) -> Allowed:
        """Return the first limits that are equal."""
        return self._allowed.setdefault(allowed, allowed)
