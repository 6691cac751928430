"""Which raw numbers may be written, as C tests."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.model import Bound, Interval, Limit, Point
from fieldscribe.targets.c.literals import bare, hexadecimal, unsigned
from fieldscribe.targets.c.rules import limit

if TYPE_CHECKING:
    from collections.abc import Callable

    from fieldscribe.targets.c.scope import HeaderScope
    from fieldscribe.targets.c.words import Words

_TABLE = 3
"""From so many ranges on a table is used; fewer are tested one by one."""


def known(point: Point, status: str) -> str:
    """The status expression, changed so that a closed enum reports an unknown value for a refused number."""
    closed = point.enum is not None and point.enum.closed
    return f"fieldscribe_known({status})" if closed and status != "FIELDSCRIBE_OK" else status


def refused(point: Point) -> str:
    """The status of a number that may not be written."""
    return f"FIELDSCRIBE_{'UNKNOWN_VALUE' if point.enum is not None and point.enum.closed else 'OUT_OF_RANGE'}"


def check(point: Point, words: Words, scope: HeaderScope) -> str:
    """The status of writing `raw`, an integer that is no special code."""
    status = known(point, _status(point, words, scope))
    if point.fixed is None or point.bits is not None:
        return status
    bits = f"uint{max(32, point.info.bits)}_t"
    mask, constant = (hexadecimal(number, point.info.bits >> 2) for number in (point.fixed.mask, point.fixed.bits))
    return f"((({bits})raw & {mask}) == {constant}) ? ({status}) : {refused(point)}"


def _checked(point: Point, words: Words, low: int, high: int) -> str:
    """The status of `raw` between two limits."""
    if point.type == "u64":
        return f"fieldscribe_check_u64(raw, {unsigned(low)}, {unsigned(high)})"
    wide = "_wide" if point.info.bits > 16 else ""
    return f"fieldscribe_check{wide}({'raw ? 1 : 0' if point.type == 'bit' else 'raw'}, {words.low}, {words.high})"


def _status(point: Point, words: Words, scope: HeaderScope) -> str:
    intervals = point.allowed.intervals
    if point.allowed.moves:
        parts = [_between(interval, point, scope) for interval in intervals]
        status = parts[-1]
        for part in reversed(parts[:-1]):
            status = f"fieldscribe_either({part}, {status})"
        return status
    if len(intervals) == 1:
        low, high = point.allowed.fixed[0]
        least, greatest = _bounds_without_codes(point)
        return "FIELDSCRIBE_OK" if low <= least and high >= greatest else _checked(point, words, low, high)
    table = ranges_table(point, scope)
    if table:
        return f"fieldscribe_check_ranges(raw, {table}, FIELDSCRIBE_COUNT({table}))"
    literal = bare if point.info.signed else unsigned
    bounds = point.held
    test = any_of([interval_test("raw", *ends, bounds, literal) for ends in point.allowed.fixed])
    return f"{bracketed(test)} ? FIELDSCRIBE_OK : FIELDSCRIBE_OUT_OF_RANGE" if test else "FIELDSCRIBE_OK"


def has_ranges_table(point: Point) -> bool:
    """Whether the point has so many ranges that a table has them."""
    many = len(point.allowed.intervals) >= _TABLE and not point.allowed.moves
    return many and point.writable and point.info.bits <= 16


def ranges_table(point: Point, scope: HeaderScope) -> str:
    """The table of a point's ranges, which points that have the same share; empty where none is needed."""
    return scope.by_content("ranges", repr(point.allowed.fixed)) if has_ranges_table(point) else ""


def _bounds_without_codes(point: Point) -> tuple[int, int]:
    """The least and greatest raw number without special codes at the ends, which are tested first."""
    low, high = point.held
    for code in sorted(point.specials, key=lambda code: code.low):
        low = code.high + 1 if code.low <= low <= code.high else low
    for code in sorted(point.specials, key=lambda code: -code.high):
        high = code.low - 1 if code.low <= high <= code.high else high
    return low, high


def _between(interval: Interval, point: Point, scope: HeaderScope) -> str:
    """A test whether the number lies in an interval; its limits may depend on other points."""
    ends = [_end(end, scope, is_low=end is interval.low) for end in (interval.low, interval.high)]
    return f"fieldscribe_between({_number(point)}, {', '.join(ends)})"


def _end(bound: Bound, scope: HeaderScope, *, is_low: bool) -> str:
    if isinstance(bound, Limit):
        return limit(bound, scope, is_low=is_low)
    return f"fieldscribe_whole_of({bare(bound)})"


def _number(point: Point) -> str:
    """The raw number in the signed type of limits; larger numbers become its greatest, which no limit exceeds."""
    return "(raw > (uint64_t)INT64_MAX) ? INT64_MAX : (int64_t)raw" if point.type == "u64" else "raw"


def interval_test(name: str, low: int, high: int, bounds: tuple[int, int], literal: Callable[[int], str]) -> str:
    """A test of one interval, without comparisons that are always true; empty if all of the type is inside."""
    if low == high:
        return f"({name} == {literal(low)})"
    parts = [f"({name} >= {literal(low)})"] if low > bounds[0] else []
    return " && ".join([*parts, f"({name} <= {literal(high)})"] if high < bounds[1] else parts)


def any_of(tests: list[str]) -> str:
    """The tests joined by `or`; empty when nothing is refused."""
    if len(tests) < 2:
        return tests[0] if tests else ""
    if not all(tests):
        return ""
    return " || ".join(f"({test})" if " && " in test else test for test in tests)


def bracketed(test: str) -> str:
    """A test in brackets if it needs them in front of a question mark."""
    return test if test.startswith("(") and " && " not in test and " || " not in test else f"({test})"
