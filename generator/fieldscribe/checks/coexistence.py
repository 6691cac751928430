"""Tells which points share a word, which can exist together, and which no frame of the device can read or write."""

from collections.abc import Callable, Iterable, Iterator
from functools import cached_property

from fieldscribe.conditions import ANY, Clause, Comparison, Domain, ends_before, possible
from fieldscribe.grouping import grouped
from fieldscribe.model import Point
from fieldscribe.resolve.analysis import Analysis
from fieldscribe.resolve.bus import KEY_OF
from fieldscribe.resolve.points import ResolvedPoint

WordKey = tuple[str, str | None, int, int]
"""Space, telegram or base, index (0 where addresses of the space have no index) and address."""


def word_key(analysis: Analysis, point: Point, address: int) -> WordKey:
    """Return a key that identifies the word of a point at an address among all words of the device."""
    terms = point.terms
    index = point.index if point.index and terms.space in analysis.scope.family.indexed else 0
    return terms.space, terms.telegram or terms.base, index, address


class Coexistence:
    """Decides whether conditions can be true together, and whether points can exist together, in one device."""

    def __init__(self, analysis: Analysis) -> None:
        self.axes = {axis: tuple(entry["values"]) for axis, entry in analysis.scope.axes.items()}
        self._resolved = analysis.resolved
        self._domains: dict[str, Domain] = {}

    @cached_property
    def points(self) -> dict[str, list[Point]]:
        """Return the points by name (in all variants) and by item."""
        points = [resolved.point for resolved in self._resolved]
        return grouped((name, point) for point in points for name in {point.name, point.item})

    def domain(self, name: str) -> Domain:
        """Return the values of an axis, or the raw numbers that a point may hold."""
        if name not in self._domains:
            self._domains[name] = self.axes.get(name) or _numbers(self.points.get(name, []))
        return self._domains[name]

    def possible(self, clause: Clause) -> bool:
        """Return True if all comparisons of a clause can be true at once."""
        return possible(clause, self.domain)

    def exclude(self, resolved: ResolvedPoint, other: ResolvedPoint) -> bool:
        """Return True if no device can have both points."""
        if "when" in resolved.facts.failed or "when" in other.facts.failed:
            return True  # the condition could not be read, and has a finding
        mine, theirs = resolved.point, other.point
        if ends_before(mine.until, theirs.since) or ends_before(theirs.until, mine.since):
            return True
        if not (mine.variant or mine.when) or not (theirs.variant or theirs.when):
            return False
        return not any(self.possible(first + second) for first in clauses(mine) for second in clauses(theirs))


def clauses(point: Point) -> tuple[Clause, ...]:
    """Return the clauses of which one must be true for the point to exist; each includes its variant."""
    variant_clause: Clause = ()
    if point.variant is not None:
        variant_clause = (Comparison(point.variant.axis, "==", (point.variant.value,)),)
    return (variant_clause,) if point.when is None else tuple(variant_clause + clause for clause in point.when.clauses)


def _numbers(points: list[Point]) -> Domain:
    return tuple(dict.fromkeys(band for point in points for band in _bands(point))) or ANY


def _bands(point: Point) -> Iterator[tuple[int, int]]:
    """Yield the raw numbers of a point: entries of its enum, its range unless the enum is closed, its special codes."""
    if point.enum is not None:
        yield from ((entry.raw, entry.raw) for entry in point.enum.entries)
    if point.enum is None or not point.enum.closed:
        for interval in point.allowed.intervals:
            yield interval.outer
    yield from ((special.low, special.high) for special in point.specials)


Needs = Callable[["Analysis", list["Point"]], Iterable[tuple[int, str, str, str]]]
"""Yields what the device lacks: how many points need it, what it is, the key under `bus` that adds it, and a hint."""


def report_missing(analysis: Analysis, needs: Needs) -> None:
    """Report each missing way to read or write points outside telegrams."""
    if not analysis.bus_is_whole or analysis.scope.bus is None:
        return
    sound = [
        resolved.point
        for resolved in analysis.resolved
        if resolved.point.generated and "type" not in resolved.facts.failed
    ]
    for count, message, key, hint in needs(analysis, [point for point in sound if point.space not in KEY_OF]):
        if count:
            needed = f"{count} point{'s need' if count > 1 else ' needs'} it"
            analysis.report.error("no-function", f"{message}, and {needed}", analysis.scope.bus.key_span(key), hint)
