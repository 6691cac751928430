"""Which raw numbers may be written, as C tests."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from fieldscribe.model import Bound, Interval, Limit, Point
from fieldscribe.targets.c.literals import INT32, bare, raw_bounds, unsigned
from fieldscribe.targets.c.rules import limit_is_wide, limit_view
from fieldscribe.targets.c.views import CheckView, LimitView

if TYPE_CHECKING:
    from collections.abc import Callable

    from fieldscribe.targets.c.scope import Scope

_WIDTH = 100
"""How long a line of a test may grow."""


def refused_status(point: Point) -> str:
    """What a number outside is called: a closed enum has unknown values, all else a range."""
    return "UNKNOWN_VALUE" if point.enum is not None and point.enum.closed else "OUT_OF_RANGE"


def check_view(point: Point, macro: str, scope: Scope, arguments: tuple[str, ...]) -> CheckView:
    """The check of a point whose raw number is an integer; `arguments` are the points that its limits need."""
    check = _limits_check(point, macro, scope, arguments)
    if point.fixed is None or point.bits is not None:
        return check
    bits = f"uint{max(32, point.info.bits)}_t"
    constant = f"(({bits})raw & {macro}_FIXED_MASK) == {macro}_FIXED_BITS"
    test = f"({check.test})" if " || " in check.test else check.test
    return replace(check, test=f"{constant} && {test}" if test else constant)


def _limits_check(point: Point, macro: str, scope: Scope, arguments: tuple[str, ...]) -> CheckView:
    refused = f"{scope.upper}_{refused_status(point)}"
    bounds = raw_bounds(point)
    if arguments or not all(map(_is_fixed, point.allowed.intervals)):
        return _moving(point, scope, refused)
    intervals = point.allowed.intervals
    if len(intervals) == 1:
        limits = intervals[0].low, intervals[0].high
        return CheckView((), "", _named_test("raw", macro, limits, _bounds_without_codes(point)), refused)
    literal = bare if point.info.signed else unsigned
    tests = [interval_test("raw", one.low, one.high, bounds, literal) for one in intervals]
    return CheckView((), "", any_of(tests), refused)


def _bounds_without_codes(point: Point) -> tuple[int, int]:
    """The ends of the raw numbers that are left when the special codes, which are answered first, are gone."""
    low, high = raw_bounds(point)
    for code in sorted(point.specials, key=lambda code: code.low):
        low = code.high + 1 if code.low <= low <= code.high else low
    for code in sorted(point.specials, key=lambda code: -code.high):
        high = code.low - 1 if code.low <= high <= code.high else high
    return low, high


def _named_test(name: str, macro: str, limits: tuple[Bound, Bound], bounds: tuple[int, int]) -> str:
    """Whether a number lies within RAW_MIN and RAW_MAX, as far as its type holds more."""
    low, high = limits
    tests = [f"{name} >= {macro}_RAW_MIN"] if not isinstance(low, int) or low > bounds[0] else []
    tests += [f"{name} <= {macro}_RAW_MAX"] if not isinstance(high, int) or high < bounds[1] else []
    return " && ".join(tests)


def _moving(point: Point, scope: Scope, refused: str) -> CheckView:
    """A check with limits that other points set: each becomes a variable."""
    intervals = point.allowed.intervals
    moving = [bound for one in intervals for bound in (one.low, one.high) if isinstance(bound, Limit)]
    wide = raw_bounds(point)[1] > INT32[1] or any(limit_is_wide(bound, scope) for bound in moving)
    several = sum(not _is_fixed(one) for one in intervals) > 1
    limits: list[LimitView] = []
    tests = []
    for index, one in enumerate(intervals, 1):
        ends: list[int | str] = []
        for bound, side in ((one.low, "low"), (one.high, "high")):
            if isinstance(bound, Limit):
                name = f"{side}_{index}" if several else side
                limits.append(limit_view(bound, name, side == "low", scope))
                ends.append(name)
            else:
                ends.append(bound)
        tests.append(interval_test("number", ends[0], ends[1], raw_bounds(point), bare))
    return CheckView(tuple(limits), "int64_t" if wide else "int32_t", any_of(tests), refused, _number(point))


def _number(point: Point) -> str:
    """The raw number as the signed type that limits have: what lies beyond that is beyond all of them."""
    return "raw > (uint64_t)INT64_MAX ? INT64_MAX : (int64_t)raw" if point.type == "u64" else "raw"


def _is_fixed(interval: Interval) -> bool:
    return isinstance(interval.low, int) and isinstance(interval.high, int)


def interval_test(
    name: str, low: Bound | str, high: Bound | str, bounds: tuple[int, int], literal: Callable[[int], str]
) -> str:
    """One interval as a test; empty when the type holds nothing else. Comparisons that are always true are left out."""
    if low == high and isinstance(low, int):
        return f"{name} == {literal(low)}"
    parts = []
    if not isinstance(low, int) or low > bounds[0]:
        parts.append(f"{name} >= {literal(low) if isinstance(low, int) else low}")
    if not isinstance(high, int) or high < bounds[1]:
        parts.append(f"{name} <= {literal(high) if isinstance(high, int) else high}")
    return " && ".join(parts)


def any_of(tests: list[str]) -> str:
    """The tests joined by `or`, in lines of a bearable length; empty when nothing is refused."""
    if len(tests) < 2:
        return tests[0] if tests else ""
    if not all(tests):
        return ""
    lines, current = [], ""
    for test in tests:
        part = f"({test})" if " && " in test else test
        if current and len(current) + len(part) > _WIDTH:
            lines.append(current)
            current = part
        else:
            current = f"{current} || {part}" if current else part
    return " ||\n           ".join([*lines, current])
