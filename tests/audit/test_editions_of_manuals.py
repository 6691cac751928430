"""Plausible editions of the real manuals: another layout is no change, and a single changed fact is reported."""

from __future__ import annotations

import os
import random
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from fieldscribe.audit.editions import Edition, compare, renumber
from fieldscribe.audit.editions.changes import Editions
from fieldscribe.audit.manual import Manual
from fieldscribe.diagnostics import Report
from fieldscribe.pipeline import load_analysis
from fieldscribe.resources import descriptions_dir

if TYPE_CHECKING:
    from fieldscribe.resolve.analysis import Analysis

DEVICES = sorted(path.parent.name for path in descriptions_dir().glob("*/device.yaml"))
SEEDED = 8
"""How many facts of each manual are changed, one at a time."""

pytestmark = pytest.mark.skipif(
    "FIELDSCRIBE_MANUALS" not in os.environ, reason="set FIELDSCRIBE_MANUALS to the folder with the manuals' texts"
)


@cache
def _described(device: str) -> tuple[Analysis, str]:
    subject = load_analysis(descriptions_dir() / device / "device.yaml", Report())
    assert subject is not None
    document = next(iter(subject.scope.documents.values()))
    return subject, (Path(os.environ["FIELDSCRIBE_MANUALS"]) / str(document.file)).read_text("utf-8-sig")


def _reflowed(lines: list[str]) -> list[str]:
    """Tables with tabs or wide cells, long sentences over two lines, other dashes, more empty lines."""
    new: list[str] = []
    for number, line in enumerate(lines):
        if line.startswith("|"):
            cells = line.strip().strip("|").split("|")
            new.append("\t".join(map(str.strip, cells)) if number % 2 else line.replace("|", "   |  "))
        elif len(line) > 60 and not line.startswith("#") and (at := line.rfind(" ", 0, 40)) > 0:
            new += [line[:at], line[at + 1 :]]
        else:
            new.append(line)
        new += [""] if number % 7 == 0 else []
    return new


def _with_a_section_moved(lines: list[str]) -> list[str]:
    first, middle = len(lines) // 3, len(lines) // 2
    return [*lines[:first], *lines[middle : middle + 100], *lines[first:middle], *lines[middle + 100 :]]


def _with_five_lines_more(lines: list[str]) -> list[str]:
    return [*[""] * 5, *lines]


LAYOUTS = {
    "reflowed": _reflowed,
    "moved": _with_a_section_moved,
    "five lines more": _with_five_lines_more,
}


@pytest.mark.full(seconds=3)
@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("device", DEVICES)
def test_another_layout_is_no_change(device: str, layout: str) -> None:
    subject, text = _described(device)
    new = "\n".join(LAYOUTS[layout](text.splitlines()))
    outcome, citations = compare(subject, Edition("old", text, None), Edition("new", new, None))
    assert outcome.explained, (outcome.elsewhere[:3], outcome.void[:3])
    result = renumber(subject.scope.files, next(iter(subject.scope.documents)), citations)
    assert result.count > 0
    assert result.hindrances == []


@pytest.mark.full(seconds=12)
@pytest.mark.parametrize("device", DEVICES)
def test_a_changed_fact_is_reported_with_its_place(device: str) -> None:
    subject, text = _described(device)
    chance = random.Random(7)
    edition = Edition("old", text, None)
    _, citations = compare(subject, edition, edition)
    words = citations.editions.old
    trace = citations.in_old().trace(Manual(text), words)
    numbers = {
        word: token.text for line in trace.manual.tokens for token in line for word in trace.words_of_token(token)
    }
    facts = [claim for claim in citations.claims if claim.in_order or claim.is_address or claim.fact == "bits"]
    borne = sorted({word for claim in facts for word in trace.borne.get(claim, ()) if word in numbers})
    borne = [word for word in borne if any(map(str.isdigit, words.texts[word]))]
    lines = text.splitlines()
    missed = []
    for word in chance.sample(borne, min(SEEDED, len(borne))):
        line, column = words.line_of[word], words.column_of[word]
        old = words.texts[word]
        new = "".join(str((int(char) + 3) % 10) if char.isdigit() else char for char in old)
        changed = lines[line - 1][: column - 1] + new + lines[line - 1][column - 1 + len(old) :]
        other = "\n".join([*lines[: line - 1], changed, *lines[line:]])
        outcome, _ = compare(subject, edition, Edition("new", other, None))
        found = [finding for finding in outcome.findings if not finding.explained]
        places = [cite.place for finding in found for cite in finding.cited_by]
        places += [reason.place for finding in found for reason in finding.reasons]
        places += [reason.place for reason in outcome.elsewhere]  # the number of a section is a heading's layout
        if not any(".yaml:" in place for place in places):
            missed.append((line, old, new))
    assert missed == []


@pytest.mark.full(seconds=5)
def test_ten_thousand_lines_take_seconds() -> None:
    _, text = _described("woodward_mpu2s")
    old = text * 4
    editions = Editions(old, old.replace("5", "6", 40))
    assert sum(editions.counts().values()) > 0
