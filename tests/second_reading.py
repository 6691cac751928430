"""What the comparisons of the descriptions with their second readings share.

A description is transcribed from its manual once, and the manual is read a second time by other eyes that do not see
the description: `readings/<device>.jsonl`, one fact a line. Each device has a `test_second_reading_<device>.py` that
says how a row of its reading and a point show the same facts. Where the two differ it was settled against the manual;
SETTLED there says why the description stays. A row that agrees now and differs later is a slip in the description.
"""

from __future__ import annotations

import json
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from fieldscribe.diagnostics import Report
from fieldscribe.pipeline import load_device

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from fieldscribe.model import Device

ROOT = Path(__file__).resolve().parents[1]

Row = dict[str, Any]
"""One fact of a reading, as its reader wrote it down."""
Seen = dict[str, tuple[object, object]]
"""What the description and the reading say, by kind of fact."""


@lru_cache
def device(name: str) -> Device:
    """The described device."""
    report = Report()
    found = load_device(ROOT / "descriptions" / name / "device.yaml", report)
    assert found is not None, report.findings
    return found


@lru_cache
def rows(name: str) -> tuple[Row, ...]:
    """All rows of a reading."""
    path = ROOT / f"tests/readings/{name}.jsonl"
    return tuple(json.loads(line) for line in path.read_text("utf-8").splitlines())


def each_row(name: str, key: Callable[[Row], object]) -> pytest.MarkDecorator:
    """A test of each row, called by what tells the row from the others."""
    return pytest.mark.parametrize("row", [pytest.param(row, id=str(key(row))) for row in rows(name)])


def assert_same(found: Iterable[Seen], key: object, settled: Mapping[tuple[Any, str], str]) -> None:
    """Both readings of a row agree, but for what is settled; what is settled does differ."""
    differing = {fact: pair for seen in found for fact, pair in seen.items() if pair[0] != pair[1]}
    told = {fact for of, fact in settled if of == key}
    opened = {fact: pair for fact, pair in differing.items() if fact not in told}
    assert not opened, f"{key}: the description and the reading (fact: description, reading) differ: {opened}"
    assert told <= differing.keys(), f"{key}: settled, but no longer different: {sorted(told - differing.keys())}"


def joined(pairs: Iterable[tuple[int, int]]) -> list[tuple[int, int]]:
    """Spans of whole numbers in ascending order, those that touch made one."""
    result: list[tuple[int, int]] = []
    for low, high in sorted(pairs):
        if result and low <= result[-1][1] + 1:
            result[-1] = (result[-1][0], max(high, result[-1][1]))
        else:
            result.append((low, high))
    return result
