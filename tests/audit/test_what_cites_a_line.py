"""A changed line belongs to what cites it: only the words of that explain it, and the nearest of them is told first."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from fieldscribe.audit.editions import Edition, compare
from fieldscribe.diagnostics import Report
from fieldscribe.pipeline import load_analysis
from support.described import group, head, together, write

if TYPE_CHECKING:
    from pathlib import Path

    from fieldscribe.audit.editions.findings import Finding
    from fieldscribe.resolve.analysis import Analysis

OLD = """# Heat pump

## 1.1 Flow

Register\t0010h
Range\t0-900

Mode\tMeans
1\tstandby
2\theating

## 1.2 Frames

Write flow\t01 06 00 10 01 95 49 F0\tfree
"""
HEADER = """enums:
  mode: {1: {name: standby, en: standby, line: 9}, 2: {name: heating, en: heating, line: 10}}
  kind: {1: {name: boosted, en: Boosted}}
frames:
- {name: write_flow, line: 14, direction: request, bytes: 01 06 00 10 01 95 49 F0}
"""
POINTS = """- {name: flow, at: 0010h, range: 0..900, line: 3}
- {name: mode, at: 0011h, enum: mode}
- {name: kind, at: 0012h, enum: kind}
"""

LAST = "Fixed choice Bit 2"
CHANGES = {
    # what is changed: who is told first, and whether it is explained
    "a label of an enum elsewhere": ("free", "Boosted", "frame write_flow", False),
    "a row of a table in a section": ("heating", "cooling", "enum mode", False),
    "a row that is added there": ("2\theating", "2\theating\n3\tcooling 4711", "enum mode", False),
}


@pytest.mark.parametrize(("old", "new", "subject", "explained"), CHANGES.values(), ids=CHANGES)
def test_a_change_is_told_of_what_cites_it(old: str, new: str, subject: str, explained: bool, tmp_path: Path) -> None:
    described = load_analysis(
        write(tmp_path / "plant", together(head() + HEADER, group(POINTS, access="rw"))), Report()
    )
    assert described is not None
    [finding] = _findings(described, OLD, OLD.replace(old, new))
    assert (finding.cited_by[0].subject, finding.explained) == (subject, explained)


def test_a_new_section_tells_which_sections_it_counts_anew(tmp_path: Path) -> None:
    points = "".join(
        f"- {{name: {name}, at: {number}, section: '1.{number}', line: {4 * number - 3}}}\n"
        for number, name in enumerate(("flow", "speed", "level"), 1)
    )
    described = load_analysis(write(tmp_path / "plant", together(head(), group(points))), Report())
    old = [f"1.{number} Value of {name}\n\nRegister\t{number}\n" for number, name in enumerate("abc", 1)]
    new = [
        old[0],
        old[1].replace("of b", "of x, new").replace("2\n", "9\n"),
        old[1].replace("1.2", "1.3"),
        old[2].replace("1.3", "1.4"),
    ]
    assert described is not None
    [finding] = _findings(described, "\n".join(old), "\n".join(new))
    reasons = [reason.text for reason in finding.reasons if reason.kind == "missing"]
    assert (finding.kind, reasons) == ("added", ["speed: section 1.2 is not there", "level: section 1.3 is not there"])


def test_labels_that_swapped_their_bits_are_told_whatever_words_they_share(tmp_path: Path) -> None:
    """All words are still there, and a piece of a row seems to have moved to another row."""
    flags = "".join(
        f"    {bit}: {{name: choice_{bit}, title: {{en: {label}}}}}\n"
        for bit, label in enumerate(("Fixed frequency selection Bit 0", "Fixed frequency selection Bit 1", LAST))
    )
    points = f"- name: control\n  at: 0020h\n  line: 1\n  flags:\n{flags}  lines: {{flags: 3..7}}\n"
    described = load_analysis(write(tmp_path / "plant", together(head(), group(points))), Report())
    rows = ["Control word 0020h", "", "Bit 0 Fixed frequency selection Bit 0", ""]
    old = [*rows, "Bit 1 Fixed frequency selection Bit 1", "", f"Bit 2 {LAST}"]
    new = [*rows, f"Bit 1 {LAST}", "", "Bit 2 Fixed frequency selection Bit 1"]
    assert described is not None
    for text, explained in ((old, True), (new, False)):
        outcome, _ = compare(described, Edition("old", "\n".join(old), None), Edition("new", "\n".join(text), None))
        assert outcome.explained == explained


def test_rows_that_change_alike_are_no_feet_of_pages(tmp_path: Path) -> None:
    described = load_analysis(write(tmp_path / "plant", together(head(), group("- {name: flow, at: 1}\n"))), Report())
    old = [f"Words of chapter {name}.\n" * 10 + f"Limit of it\t{number}\n" for number, name in enumerate("abcd", 1)]
    new = [text.replace(f"\t{number}", f"\t{number + 4}") for number, text in enumerate(old, 1)]
    assert described is not None
    assert len(_findings(described, "".join(old), "".join(new))) == len(old)


def _findings(described: Analysis, old: str, new: str) -> list[Finding]:
    return compare(described, Edition("old", old, None), Edition("new", new, None))[0].findings
