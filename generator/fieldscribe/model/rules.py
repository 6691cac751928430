"""Scales and limits: exact linear rules, which may depend on other points."""

from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property


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
    scale is unknown.
    Points with the same limits share one object, so that derived facts are computed once.
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
