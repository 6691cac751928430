"""Points with equal facts are resolved once, and mean what each would mean if it were resolved by itself."""

from __future__ import annotations

from collections.abc import Hashable
from functools import cache
from itertools import count
from pathlib import Path

import pytest
from fieldscribe.resolve import shapes
from fieldscribe.resolve.point_facts import PointFacts
from fieldscribe.resources import descriptions_dir
from support.described import DEVICES, compiled, described, loaded_in
from support.expectations import expected, findings_of, wording
from support.places import TESTS

GOOD = sorted(file for folder in (DEVICES, descriptions_dir()) for file in folder.glob("*/device.yaml"))
BAD = sorted(path for path in (TESTS / "bad").iterdir() if path.is_dir() or path.suffix == ".yaml")

ROWS = """
- {name: first, at: 1, line: 1, range: 0..10, scale: "value = raw * 0.1", unit: Hz}
- {name: second, at: 2, line: 2, range: 5..4000, scale: "value = raw * 0.1", unit: Hz, default_in_units: 1.0}
- {name: third, at: 3, line: 3, range: -1..40, scale: "value = raw * 0.1", unit: Hz}
- {name: mode, at: 4, line: 4, enum: {0: off, 1: slow}}
- {name: other_mode, at: 5, line: 5, enum: {0: off, 1: slow}}
- {name: open_mode, at: 6, line: 6, range: 0..7, enum: {0: off, 1: slow}}
- {name: closed_mode, at: 7, line: 7, range: 0..1, enum: {0: off, 1: slow}}
- {name: small, at: 8, line: 8, type: u64, range: 0..1000, scale: "value = raw * 0.1"}
- {name: large, at: 12, line: 9, type: u64, range: 0..90000000000000000, scale: "value = raw * 0.1"}
"""
"""Rows that differ in little: limits outside the type, names of numbers, limits that decide about the shape."""


class Unshared(shapes.FactKeys):
    """Gives every point a key of its own."""

    def __init__(self) -> None:
        super().__init__()
        self._numbers = count()

    def of(self, point: PointFacts) -> int:
        return next(self._numbers)


@cache
def models() -> list[object]:
    """Return the models of the good descriptions."""
    return [compiled(file) for file in GOOD]


@pytest.mark.full
@pytest.mark.parametrize("file", GOOD, ids=lambda file: file.parent.name)
def test_sharing_facts_changes_no_model(file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    together = compiled(file)
    monkeypatch.setattr("fieldscribe.resolve.points.FactKeys", Unshared)
    assert compiled(file) == together


@pytest.mark.full(seconds=0.1)
@pytest.mark.parametrize("case", BAD, ids=lambda case: case.stem)
def test_sharing_facts_changes_no_finding(case: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """They are those of the case, which test_bad.py finds with shared facts."""
    monkeypatch.setattr("fieldscribe.resolve.points.FactKeys", Unshared)
    assert wording(case, findings_of(case)) == expected(case)


def test_limits_decide_for_each_point(tmp_path: Path) -> None:
    text = described(ROWS.replace("-1..40", "1..40"))
    points = {point.name: point for point in loaded_in(tmp_path, text).points}
    assert points["first"].shape is points["second"].shape is points["third"].shape
    assert [points[name].outer for name in ("first", "second", "third")] == [(0, 10), (5, 4000), (1, 40)]
    assert (points["second"].default_raw, points["first"].default) == (10, None)
    enums = {name: enum for name, point in points.items() if (enum := point.named_numbers) is not None}
    assert {name: enum.name for name, enum in enums.items()} == {name: name for name in enums}
    assert [name for name, enum in enums.items() if enum.closed] == ["mode", "other_mode", "closed_mode"]
    assert points["mode"].shape is points["other_mode"].shape
    assert (points["small"].encodes_values, points["large"].encodes_values) == (True, False)


def test_a_wrong_fact_is_reported_at_every_point(tmp_path: Path) -> None:
    points = "".join(
        f"- {{name: p_{at}, at: {at}, line: 1, type: s16, range: 0..40000, unit: Hz}}\n" for at in range(3)
    )
    (tmp_path / "device.yaml").write_text(described(points), "utf-8")
    device, findings = compiled(tmp_path / "device.yaml")
    assert device is None
    assert [(finding.rule, finding.span.line) for finding in findings] == [
        ("range-outside-type", line) for line in range(findings[0].span.line, findings[0].span.line + 3)
    ]


@pytest.mark.full(seconds=0.5)
@pytest.mark.parametrize("key", ["scale", "unit", "access", "type", "enum", "keeps", "special"])
def test_a_fact_that_is_forgotten_is_noticed(key: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """If points that differ in one fact share a key, some device means something else, or is refused."""
    right = models()
    monkeypatch.setattr(shapes, "_IDENTITY", shapes._IDENTITY | {key})
    assert any(compiled(file) != model for file, model in zip(GOOD, right, strict=True))


def test_limits_count_where_the_shape_depends_on_them(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    text = described(ROWS.replace("-1..40", "1..40"))
    right = loaded_in(tmp_path, text)

    def forgetful(_: object) -> Hashable:
        return 0

    monkeypatch.setattr("fieldscribe.resolve.shapes.hashable", forgetful)
    assert loaded_in(tmp_path, text) != right
