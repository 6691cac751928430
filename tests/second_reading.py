"""What the comparisons of the descriptions with their second readings share.

A description is transcribed from its manual once, and the manual is read a second time by other eyes that do not see
the description: `readings/<device>.jsonl`, one fact a line. Each device has a `test_second_reading_<device>.py` that
says how a row of its reading and a point show the same facts. Where the two differ it was settled against the manual;
SETTLED there says why the description stays. A row that agrees now and differs later is a slip in the description.
"""

from __future__ import annotations

import json
import re
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from fieldscribe.diagnostics import Report
from fieldscribe.pipeline import load_device, load_subject

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from fieldscribe.model import Device
    from fieldscribe.resolve.drafts import Draft

ROOT = Path(__file__).resolve().parents[1]

Row = dict[str, Any]
"""One fact of a reading, as its reader wrote it down."""
Seen = dict[str, tuple[object, object]]
"""What the description and the reading say, by kind of fact."""


def device(name: str) -> Device:
    """The described device."""
    found, report = _loaded(name)
    assert found is not None, report.findings
    return found


@lru_cache
def _loaded(name: str) -> tuple[Device | None, Report]:
    report = Report()
    return load_device(ROOT / "descriptions" / name / "device.yaml", report), report


@lru_cache
def drafts(name: str) -> Mapping[str, Draft]:
    """What the author wrote of each point, by its item: what is printed is no part of the model."""
    subject = load_subject(ROOT / "descriptions" / name / "device.yaml", Report())
    assert subject is not None
    return {one.point.item: one.draft for one in subject.resolved}


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


def numbered_findings(name: str) -> list[int]:
    """The numbers of what the second reader found wrong in the manual."""
    text = (ROOT / f"tests/readings/{name}_findings.md").read_text("utf-8")
    return [int(number) for number in re.findall(r"(?m)^(\d+)\. ", text)]


def assert_answered(name: str, answers: Mapping[int, tuple[str, ...] | str]) -> None:
    """Each finding has its errata, or the reason why there is none; and the description has these errata."""
    assert sorted(answers) == numbered_findings(name)
    named = {one for answer in answers.values() if isinstance(answer, tuple) for one in answer}
    assert named <= {one.id for one in device(name).errata}
