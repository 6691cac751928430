"""Which raw numbers may be written, as C tests."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.model import Bound, Interval, Limit, Point
from fieldscribe.targets.c.literals import bare, hexadecimal, raw_bounds, unsigned
from fieldscribe.targets.c.rules import limit

if TYPE_CHECKING:
    from collections.abc import Callable

    from fieldscribe.targets.c.scope import Scope

_TABLE = 3
"""So many ranges stand in a table; fewer are a test."""


def known(point: Point, status: str) -> str:
    """What a number outside is called: a closed enum has unknown values, all else a range."""
    closed = point.enum is not None and point.enum.closed
    return f"fieldscribe_known({status})" if closed and status != "FIELDSCRIBE_OK" else status


def refused(point: Point) -> str:
    """The status of a number that may not be written."""
    return f"FIELDSCRIBE_{'UNKNOWN_VALUE' if point.enum is not None and point.enum.closed else 'OUT_OF_RANGE'}"


def is_moving(point: Point) -> bool:
    """Whether other points set a limit."""
    return not all(map(_is_fixed, point.allowed.intervals))


def check(point: Point, scope: Scope) -> str:
    """The status of writing `raw`, an integer that is no special code."""
    status = known(point, _status(point, scope))
    if point.fixed is None or point.bits is not None:
        return status
    bits = f"uint{max(32, point.info.bits)}_t"
    mask, constant = (hexadecimal(number, point.info.bits >> 2) for number in (point.fixed.mask, point.fixed.bits))
    return f"((({bits})raw & {mask}) == {constant}) ? ({status}) : {refused(point)}"


def checked(point: Point, name: str, low: int, high: int) -> str:
    """The status of a number between two limits."""
    if point.type == "u64":
        return f"fieldscribe_check_u64({name}, {unsigned(low)}, {unsigned(high)})"
    name = f"{name} ? 1 : 0" if point.type == "bit" else name
    wide = "_wide" if point.info.bits > 16 else ""
    return f"fieldscribe_check{wide}({name}, {bare(low)}, {bare(high)})"


def _status(point: Point, scope: Scope) -> str:
    intervals = point.allowed.intervals
    if is_moving(point):
        parts = [_between(one, point, scope) for one in intervals]
        status = parts[-1]
        for part in reversed(parts[:-1]):
            status = f"fieldscribe_either({part}, {status})"
        return status
    if len(intervals) == 1:
        low, high = intervals[0].low, intervals[0].high
        assert isinstance(low, int)
        assert isinstance(high, int)
        least, greatest = _bounds_without_codes(point)
        return "FIELDSCRIBE_OK" if low <= least and high >= greatest else checked(point, "raw", low, high)
    table = ranges_table(point, scope)
    if table:
        return f"fieldscribe_check_ranges(raw, {table}, FIELDSCRIBE_COUNT({table}))"
    literal = bare if point.info.signed else unsigned
    bounds = raw_bounds(point)
    test = any_of([interval_test("raw", one.low, one.high, bounds, literal) for one in intervals])
    return f"{bracketed(test)} ? FIELDSCRIBE_OK : FIELDSCRIBE_OUT_OF_RANGE" if test else "FIELDSCRIBE_OK"


def ranges_table(point: Point, scope: Scope) -> str:
    """The name of the table of a point's ranges, which points that have the same share; empty where none is needed."""
    intervals = point.allowed.intervals
    if not point.writable or len(intervals) < _TABLE or point.info.bits > 16 or is_moving(point):
        return ""
    return scope.tables.setdefault(ranges_of(point), f"{scope.prefix}_{point.item}_ranges")


def ranges_of(point: Point) -> tuple[tuple[int, int], ...]:
    """The constant ranges of a point."""
    return tuple(
        (one.low, one.high) for one in point.allowed.intervals if isinstance(one.low, int) and isinstance(one.high, int)
    )


def _bounds_without_codes(point: Point) -> tuple[int, int]:
    """The ends of the raw numbers that are left when the special codes, which are answered first, are gone."""
    low, high = raw_bounds(point)
    for code in sorted(point.specials, key=lambda code: code.low):
        low = code.high + 1 if code.low <= low <= code.high else low
    for code in sorted(point.specials, key=lambda code: -code.high):
        high = code.low - 1 if code.low <= high <= code.high else high
    return low, high


def _between(interval: Interval, point: Point, scope: Scope) -> str:
    """Whether a number lies in an interval whose limits other points may set."""
    ends = [_end(one, scope, is_low=one is interval.low) for one in (interval.low, interval.high)]
    return f"fieldscribe_between({_number(point)}, {', '.join(ends)})"


def _end(bound: Bound, scope: Scope, *, is_low: bool) -> str:
    if isinstance(bound, Limit):
        return limit(bound, scope, is_low=is_low)
    return f"fieldscribe_whole_of({bare(bound)})"


def _number(point: Point) -> str:
    """The raw number as the signed type that limits have: what lies beyond that is beyond all of them."""
    return "(raw > (uint64_t)INT64_MAX) ? INT64_MAX : (int64_t)raw" if point.type == "u64" else "raw"


def _is_fixed(interval: Interval) -> bool:
    return isinstance(interval.low, int) and isinstance(interval.high, int)


def interval_test(
    name: str, low: Bound | str, high: Bound | str, bounds: tuple[int, int], literal: Callable[[int], str]
) -> str:
    """One interval as a test; empty when the type holds nothing else. Comparisons that are always true are left out."""
    if low == high and isinstance(low, int):
        return f"({name} == {literal(low)})"
    parts = []
    if not isinstance(low, int) or low > bounds[0]:
        parts.append(f"({name} >= {literal(low) if isinstance(low, int) else low})")
    if not isinstance(high, int) or high < bounds[1]:
        parts.append(f"({name} <= {literal(high) if isinstance(high, int) else high})")
    return " && ".join(parts)


def any_of(tests: list[str]) -> str:
    """The tests joined by `or`; empty when nothing is refused."""
    if len(tests) < 2:
        return tests[0] if tests else ""
    if not all(tests):
        return ""
    return " || ".join(f"({test})" if " && " in test else test for test in tests)


def bracketed(test: str) -> str:
    """A test in brackets, as what stands before a question mark is."""
    return test if test.startswith("(") and " && " not in test and " || " not in test else f"({test})"
