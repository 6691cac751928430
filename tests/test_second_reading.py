"""Each description agrees with a second reading of the same manual, made by other eyes from the manual alone.

`readings/<device>.jsonl` holds that reading, one row of the manual a line. Where the two differ it was settled against
the manual; SETTLED says how. A row that agrees now and differs later is a slip in the description.
"""

from __future__ import annotations

import json
import re
from fractions import Fraction
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from fieldscribe.diagnostics import Report
from fieldscribe.pipeline import load_device

if TYPE_CHECKING:
    from fieldscribe.model import Device, Interval, Point

ROOT = Path(__file__).resolve().parents[1]
READINGS = sorted(
    path for path in (ROOT / "tests/readings").glob("*.jsonl") if (ROOT / "descriptions" / path.stem).is_dir()
)

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


@lru_cache
def device(name: str) -> Device:
    report = Report()
    found = load_device(ROOT / "descriptions" / name / "device.yaml", report)
    assert found is not None, report.findings
    return found


def rows() -> list[Any]:
    read = [(path.stem, json.loads(line)) for path in READINGS for line in path.read_text("utf-8").splitlines()]
    return [pytest.param(name, row, id=f"{name}-{row['line']}-{row['code'] or row['wire']}") for name, row in read]


def points_of(name: str, row: dict[str, Any]) -> list[Point]:
    cited = [one for one in device(name).points if one.source.line == row["line"] and one.space == row["space"]]
    return [one for one in cited if one.address == row["wire"]] or cited


@pytest.mark.parametrize(("name", "row"), rows())
def test_the_description_says_what_the_second_reading_says(name: str, row: dict[str, Any]) -> None:
    points = points_of(name, row)
    assert points, f"no point cites line {row['line']}"
    for point in points:
        seen: dict[str, tuple[object, object]] = {
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
        for fact, (ours, theirs) in seen.items():
            if (row["line"], fact) not in SETTLED:
                assert ours == theirs, f"{point.name}: {fact}"


def step(point: Point) -> Fraction:
    return Fraction(1) if point.scale is None else 1 / point.scale[0].rule.ratio


def fixed_range(point: Point) -> list[tuple[int, int]] | None:
    """The allowed numbers, or None where other points decide."""
    if not all(isinstance(one.low, int) and isinstance(one.high, int) for one in point.allowed.intervals):
        return None
    return joined([(_int(one, 0), _int(one, 1)) for one in point.allowed.intervals])


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
        return joined([(int(one), int(one)) for one in text.split(",")])
    return fixed_range(point)


def joined(pairs: list[tuple[int, int]]) -> list[tuple[int, int]]:
    result: list[tuple[int, int]] = []
    for low, high in sorted(pairs):
        if result and low == result[-1][1] + 1:
            result[-1] = (result[-1][0], high)
        else:
            result.append((low, high))
    return result


@pytest.mark.parametrize("path", READINGS, ids=lambda path: path.stem)
def test_every_point_was_read_twice(path: Path) -> None:
    lines = {json.loads(line)["line"] for line in path.read_text("utf-8").splitlines()}
    missing = [point.name for point in device(path.stem).points if point.source.line not in lines]
    assert missing == []
