"""How right a draft is: its points beside those of our own description, fact by fact."""

from __future__ import annotations

from collections import Counter
from hashlib import sha256
from typing import TYPE_CHECKING

from fieldscribe.diagnostics import Report
from fieldscribe.importing import Wishes, draft
from fieldscribe.importing.draft_text import Head, draft_text
from fieldscribe.importing.reading import read_tables
from fieldscribe.model.rules import Interval
from fieldscribe.pipeline import load_device

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from fieldscribe.model import Device, Point
    from fieldscribe.model.rules import Bound

FACTS = ("address", "range", "unit", "step")


def imported(manual: Path, folder: Path, space: str | None = None) -> Device | None:
    """The device that a draft from the manual's text makes, without a look at what is open in it.

    The bus of a draft is Modbus, whatever the device speaks: only that family has one to start with.
    """
    drafted = draft(read_tables(manual), Wishes(space=space))
    if not drafted.groups:
        return None
    (folder / "device.yaml").write_text(
        draft_text(drafted, Head("drafted", manual.name, sha256(manual.read_bytes()).hexdigest(), "modbus")), "utf-8"
    )
    report = Report()
    device = load_device(folder / "device.yaml", report)
    assert device is not None, report.findings
    return device


def accuracy(truth: Device, drafted: Device | None) -> tuple[dict[str, tuple[int, int]], list[str]]:
    """For each kind of fact how many are right of how many, and what is wrong or missing."""
    right, wrong = Counter[str](), list[str]()
    points = () if drafted is None else drafted.points
    codes = {point.code: point for point in points if point.code}
    places = {_place(point): point for point in points if point.addresses}
    ours, theirs = _codes(truth.points), _codes(points)
    for point in truth.points:
        other = codes.get(point.code) if point.code and point.record is None else None
        other = other or places.get(_place(point))
        told = {
            "address": other is not None and other.addresses == point.addresses,
            "range": other is not None and _range(other, theirs) == _range(point, ours),
            "unit": other is not None and other.unit.symbol == point.unit.symbol,
            "step": other is not None and _step(other) == _step(point),
        }
        right.update(fact for fact, is_right in told.items() if is_right)
        missing = [fact for fact, is_right in told.items() if not is_right]
        if missing:
            wrong.append(f"{point.code or point.name}: {', '.join(missing) if other else 'not imported'}")
    return {fact: (right[fact], len(truth.points)) for fact in FACTS}, wrong


def _place(point: Point) -> tuple[str, int | None, tuple[int, int] | None]:
    return point.telegram or ("bit" if point.type == "bit" else "word"), point.address, point.bits


def _codes(points: Sequence[Point]) -> dict[str, str]:
    return {point.name: point.code or point.name for point in points}


def _range(point: Point, codes: dict[str, str]) -> object:
    """The raw numbers that may be written; limits of other points by their codes."""
    return tuple((_end(interval.low, codes), _end(interval.high, codes)) for interval in _joined(point))


def _joined(point: Point) -> list[Interval]:
    """The intervals; those that touch are one."""
    joined: list[Interval] = []
    for interval in point.allowed.intervals:
        last = joined[-1] if joined else None
        if last is not None and isinstance(last.high, int) and last.high + 1 == interval.low:
            joined[-1] = Interval(last.low, interval.high)
        else:
            joined.append(interval)
    return joined


def _end(end: Bound, codes: dict[str, str]) -> object:
    if isinstance(end, int):
        return end
    factors = [(codes[factor.point], factor.slope, factor.intercept, factor.power) for factor in end.rule.factors]
    return end.rule.ratio, end.rule.offset, tuple(factors)


def _step(point: Point) -> object:
    if not point.generated and not point.reserved and point.access != "none":
        return "open" if point.scale is None and point.raw_only else point.fixed_scale and point.fixed_scale.ratio
    return None if point.scale is None else point.fixed_scale and (point.fixed_scale.ratio, point.fixed_scale.offset)
