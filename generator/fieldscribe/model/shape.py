"""The facts that many points share: everything about their raw numbers, without names and addresses."""

from dataclasses import dataclass
from functools import cached_property

from fieldscribe.model.numbers import (
    TYPES,
    Allowed,
    Digits,
    Enum,
    Fixed,
    Flag,
    Interval,
    Linear,
    ScaleCase,
    Special,
    Text,
    TypeInfo,
)


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
