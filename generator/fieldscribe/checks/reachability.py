"""Reports points that no frame of the device can read or write."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from fieldscribe.model import Point
from fieldscribe.resolve.analysis import Analysis
from fieldscribe.resolve.telegrams import KEY_OF

Needs = Callable[["Analysis", list["Point"]], Iterable[tuple[int, str, str, str]]]
"""Yields what the device lacks: how many points need it, what it is, the key under `bus` that gives it, and a hint."""


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
