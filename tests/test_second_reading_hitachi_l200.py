"""The description of the Hitachi L200 agrees with the second reading of its manual."""

from __future__ import annotations

import re
from fractions import Fraction
from typing import TYPE_CHECKING

from second_reading import Row, Seen, assert_same, device, each_row, joined, rows

if TYPE_CHECKING:
    from fieldscribe.model import Interval, Point

NAME = "hitachi_l200"

SETTLED: dict[tuple[int, str], str] = {
    (661, "access"): "blank in the manual; a setpoint must be writable (erratum)",
    (668, "access"): "blank in the manual; a setpoint must be writable (erratum)",
    (674, "range"): "the manual prints 63, five inputs end at 31 (erratum)",
    (676, "step"): "0.01 and the range contradict each other: no scale is taken (erratum)",
    (766, "range"): "the description limits it by A003, the printed 30 is A003's own least (erratum)",
    (767, "range"): "the description limits it by A203, the printed 30 is A203's own least (erratum)",
    (850, "range"): "code 10 is listed, the range says 3: both are allowed (erratum)",
    (1012, "unit"): "the unit stands in the table at the front",
}
"""What the two readings saw differently, by line and fact, and why the description stays."""

PLAIN: dict[str | None, str] = {None: "", "Anzahl": "", "Abtastung": "", "Pol": ""}
"""What a reader noted as a unit and is a plain number here."""


@each_row(NAME, lambda row: f"{row['line']}-{row['code'] or row['wire']}")
def test_the_description_says_what_the_second_reading_says(row: Row) -> None:
    points = points_of(row)
    assert points, f"no point cites line {row['line']}"
    assert_same([facts(point, row) for point in points], row["line"], SETTLED)


def test_what_is_settled_was_read() -> None:
    assert {line for line, _ in SETTLED} <= {row["line"] for row in rows(NAME)}


def test_every_point_was_read_twice() -> None:
    lines = {row["line"] for row in rows(NAME)}
    assert [point.name for point in device(NAME).points if point.source.line not in lines] == []


def points_of(row: Row) -> list[Point]:
    cited = [one for one in device(NAME).points if one.source.line == row["line"] and one.space == row["space"]]
    return [one for one in cited if one.address == row["wire"]] or cited


def facts(point: Point, row: Row) -> Seen:
    seen: Seen = {
        "wire": (point.address, row["wire"]),
        "words": (point.words, row["words"]),
        "code": (point.code, row["code"]),
        "access": (point.access, row["access"]),
        "unit": (point.unit.symbol, PLAIN.get(row["unit"], row["unit"])),
        "step": (step(point), Fraction(row["step"] or 1)),
        "range": (fixed_range(point), printed_range(point, row["raw_range"])),
    }
    if row["enum"] and point.enum:
        seen["enum"] = (sorted(entry.raw for entry in point.enum.entries), row["enum"])
    return seen


def step(point: Point) -> Fraction:
    return Fraction(1) if point.scale is None else 1 / point.scale[0].rule.ratio


def fixed_range(point: Point) -> list[tuple[int, int]] | None:
    """The allowed numbers, or None where other points decide."""
    if not all(isinstance(one.low, int) and isinstance(one.high, int) for one in point.allowed.intervals):
        return None
    return joined((_int(one, 0), _int(one, 1)) for one in point.allowed.intervals)


def _int(one: Interval, end: int) -> int:
    bound = (one.low, one.high)[end]
    assert isinstance(bound, int)
    return bound


def printed_range(point: Point, text: str | None) -> list[tuple[int, int]] | None:
    """The range that the reader noted; where it is none or a formula, what the description has."""
    if text is None:
        return fixed_range(point)
    if found := re.fullmatch(r"(-?\d+)\s*(?:\.\.|-)\s*(-?\d+)", text.strip()):
        return [(int(found[1]), int(found[2]))]
    if re.fullmatch(r"[\d, ]+", text):
        return joined((int(one), int(one)) for one in text.split(","))
    return fixed_range(point)
