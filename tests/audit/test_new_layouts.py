"""A new text in another layout: no finding where only the layout changed, and each changed fact told all the same."""

from __future__ import annotations

import re
from itertools import pairwise
from typing import TYPE_CHECKING

import pytest
from fieldscribe.audit import Auditor
from fieldscribe.audit.layout import Fingerprint, Relaid
from fieldscribe.diagnostics import Report
from fieldscribe.pipeline import load_analysis
from support.described import group, head, together, write

if TYPE_CHECKING:
    from pathlib import Path

    from fieldscribe.audit import Audit

ROWS = (
    (
        "A001",
        "Base frequency",
        "1001h (4097)",
        "0-4000",
        "0.1 Hz",
        "The frequency at which the motor has its rated voltage.",
    ),
    ("A002", "Acceleration ramp", "1002h (4098)", "1-3000", "0.01 s", "From standstill to the maximum of the output."),
    ("A003", "Deceleration ramp", "1003h (4099)", "1-3000", "0.01 s", "From the maximum of the output to standstill."),
    (
        "A004",
        "Carrier frequency",
        "1004h (4100)",
        "20-140",
        "0.1 kHz",
        "A high one is silent and warms the inverter up.",
    ),
)
TABLE = "| Code | Title | Register | Range | Step | What it does |\n|---|---|---|---|---|---|\n" + "".join(
    f"| {' | '.join(row)} |\n" for row in ROWS
)
MODE = """## 4.2 Mode

Register 2001h (8193)
0 = coasts to a stop when the command goes
1 = brakes along the ramp of deceleration
2 = brakes with direct current for a while
"""
LIMITS = """## 4.3 Limits

The torque is limited in both directions. The register of the limit is 2002h (8194),
and it takes from 0 to 1500, in steps of 0.1 %. A limit of one direction alone is not
possible with this inverter.
"""
WIRING = "## 4.4 Wiring\n\nPin 1 is plus, pin 2 is minus, pin 3 is the shield.\n"
TEXT = f"# Drive protocol\n\n## 4.1 Parameters\n\n{TABLE}\n{MODE}\n{LIMITS}\n{WIRING}"


def _line(words: str) -> int:
    return next(number for number, line in enumerate(TEXT.splitlines(), 1) if words in line)


POINTS = "".join(
    f"- {{code: {code}, name: {title.lower().replace(' ', '_')}, title: {{en: {title}}}, at: {at.split()[0]},"
    f" range: {limits.replace('-', '..')}, scale: value = raw * {step.split()[0]}, unit: {step.split()[1]},"
    f" printed: {{wire: [{', '.join(re.findall('[0-9]+h|[0-9]{4}', at))}]}}, line: {_line(code)}}}\n"
    for code, title, at, limits, step, _ in ROWS
)
POINTS += f"""\
- {{name: mode, title: {{en: Mode}}, at: 2001h, printed: {{wire: [2001h, 8193]}}, section: "4.2", line: {_line("4.2")},
   enum: {{0: {{name: coast, en: coasts to a stop}}, 1: {{name: ramp, en: brakes along the ramp}},
          2: {{name: dc, en: brakes with direct current}}}}}}
- {{name: torque_limit, at: 2002h, printed: {{wire: [2002h, 8194]}}, range: 0..1500, scale: value = raw * 0.1,
   unit: "%", line: {_line("The torque")}}}
"""
HEAD = head(
    documents="{manual: {title: Manual, language: en}}", looked_through=f"[{{lines: {_line('Pin 1')}, why: Pins.}}]"
)


@pytest.fixture(name="auditor", scope="module")
def _auditor(tmp_path_factory: pytest.TempPathFactory) -> Auditor:
    device = together(HEAD, group(POINTS, source="{document: manual, section: Parameters}"))
    subject = load_analysis(write(tmp_path_factory.mktemp("drive"), device), Report())
    assert subject is not None
    return Auditor(subject)


KEPT = Fingerprint.of(TEXT, "0" * 64)


def told(outcome: Audit) -> list[str]:
    """The findings in short."""
    found = [f"{one.subject}: {one.fact} {one.wanted}" for one in outcome.missing]
    found += [f"unused {one.number}" for one in outcome.unused]
    return found + [f"uncited {one.text}" for one in outcome.added]


def _moved(text: str, passage: str, behind: str) -> str:
    return text.replace(passage, "", 1).replace(behind, f"{behind}\n{passage}", 1)


def _on_pages(text: str) -> str:
    """A head and a foot after every few lines, in the middle of tables too."""
    lines = text.splitlines()
    pages = [lines[at : at + 7] for at in range(0, len(lines), 7)]
    return "\n".join(
        "\n".join(["Drive protocol, edition of 2030", *page, f"Page {number}"]) for number, page in enumerate(pages, 1)
    )


def _stacked(text: str) -> str:
    """Cells set side by side over several lines: as an extraction writes them that keeps the look of a page."""
    widths = (6, 14, 9, 10, 8, 22)
    lines: list[str] = []
    for row in ROWS:
        cells = [_wrapped(cell, width) for cell, width in zip(row, widths, strict=True)]
        for at in range(max(map(len, cells))):
            pieces = (cell[at] if at < len(cell) else "" for cell in cells)
            lines.append("".join(piece.ljust(width + 3) for piece, width in zip(pieces, widths, strict=True)).rstrip())
        lines.append("")
    return text.replace(TABLE, "\n".join(lines))


def _wrapped(cell: str, width: int) -> list[str]:
    lines = [""]
    for word in cell.split():
        if lines[-1] and len(lines[-1]) + 1 + len(word) > width:
            lines.append("")
        lines[-1] = f"{lines[-1]} {word}".strip()
    return lines


def _two_tables(text: str) -> str:
    """The same head once more, as on a new page."""
    head, rule, *rows = TABLE.splitlines()
    return text.replace(TABLE, "\n".join([head, rule, *rows[:2], "", head, rule, *rows[2:], ""]))


LAYOUTS = {
    "as it was": TEXT,
    "padding": re.sub(r" \| ", "     |   ", TEXT),
    "blank lines": TEXT.replace("\n", "\n\n"),
    "tabs for cells": "\n".join(
        line.strip("| ").replace(" | ", "\t") for line in TEXT.splitlines() if "---" not in line
    ),
    "joined cells": TEXT.replace(" | 0-4000 | 0.1 Hz", " 0-4000 0.1 Hz"),
    "a split cell": TEXT.replace("1003h (4099)", "1003h | (4099)"),
    "a row over three lines": TEXT.replace("1002h (4098) | 1-3000", "1002h\n(4098) |\n1-3000"),
    "a paragraph set narrower": TEXT.replace(LIMITS[15:], LIMITS[15:].replace(". ", ".\n").replace(" of ", "\nof ")),
    "a hyphen": TEXT.replace("limited in both directions", "limited in both direc-\ntions"),
    "a section moved": _moved(TEXT, MODE, LIMITS),
    "a table moved": _moved(TEXT, TABLE, LIMITS),
    "pages": _on_pages(TEXT),
    "two pages of a table": _two_tables(TEXT),
    "cells stacked": _stacked(TEXT),
    "bullets and bold": TEXT.replace("\n0 =", "\n- **0** =")
    .replace("\n1 =", "\n- **1** =")
    .replace("\n2 =", "\n- **2** ="),
    "quotes": TEXT.replace("Pin 1 is plus", "Pin \u201e1\u201c is plus"),
    "a caption": TEXT.replace("0 = coasts", "Figure 17: how it stops\n0 = coasts"),
}


@pytest.mark.parametrize("layout", LAYOUTS.values(), ids=LAYOUTS)
def test_another_layout_is_no_change(layout: str, auditor: Auditor) -> None:
    assert told(auditor.audit("new.txt", layout, same_text=False, kept=KEPT)) == []


CHANGES = [
    ("0-4000", "0-5000", "base_frequency: range 0..4000"),
    ("4098", "4198", "acceleration_ramp: printed wire 4098"),
    ("4099", "4199", "deceleration_ramp: printed wire 4099"),
    ("20-140", "20-160", "carrier_frequency: range 20..140"),
    ("8193", "8195", "mode: printed wire 8193"),
    ("1500", "1800", "torque_limit: range 0..1500"),
    ("brakes along the ramp", "stays as it is", "mode: enum 1 = brakes along the ramp"),
]


@pytest.mark.parametrize("layout", LAYOUTS.values(), ids=LAYOUTS)
@pytest.mark.parametrize(("old", "new", "finding"), CHANGES, ids=[old for old, _, _ in CHANGES])
def test_a_change_is_told_in_any_layout(layout: str, old: str, new: str, finding: str, auditor: Auditor) -> None:
    """At a line that has the new word, whatever else stands there."""
    pattern = r"\s+".join(map(re.escape, old.split()))
    text, count = re.subn(pattern, lambda match: re.sub(r"\S+(?:[ ]\S+)*", "", match[0]) + new, layout)
    assert count == 1
    outcome = auditor.audit("new.txt", text, same_text=False, kept=KEPT)
    assert finding in [f"{one.subject}: {one.fact} {one.wanted}" for one in outcome.missing]


@pytest.mark.parametrize("layout", LAYOUTS.values(), ids=LAYOUTS)
def test_labels_that_changed_places_are_told_in_any_layout(layout: str, auditor: Auditor) -> None:
    one, other = "coasts to a stop when the command goes", "brakes with direct current for a while"
    text = layout.replace(one, "@").replace(other, one).replace("@", other)
    assert text != layout
    assert len(told(auditor.audit("new.txt", text, same_text=False, kept=KEPT))) >= 2


@pytest.mark.parametrize("layout", LAYOUTS.values(), ids=LAYOUTS)
def test_lines_are_those_of_the_new_text(layout: str, auditor: Auditor) -> None:
    """A finding names the line of the new text, and where cited lines stand now."""
    text = layout.replace("8193", "8195")
    outcome = auditor.audit("new.txt", text, same_text=False, kept=KEPT)
    lines = text.splitlines()
    for unused in outcome.unused:
        assert lines[unused.line - 1][unused.column - 1 :].startswith(unused.number)
    [missing] = outcome.missing
    assert any("8195" in line for line in lines[missing.line - 1 : missing.last])
    assert all(place.line != place.now for place in outcome.moved)
    for place in outcome.moved:
        if place.subject == "mode":
            assert "Mode" in lines[place.now - 1]


def test_a_description_may_count_the_lines_of_the_new_text_already(tmp_path: Path) -> None:
    """As `--renumber` leaves it, while the fingerprint is still that of the old text."""
    points = re.sub(r"line: ([0-9]+)", lambda match: f"line: {int(match[1]) + 4}", POINTS)
    device = together(
        head(documents="{manual: {title: Manual, language: en}}"),
        group(points, source="{document: manual, section: Parameters}"),
    )
    subject = load_analysis(write(tmp_path, device), Report())
    assert subject is not None
    outcome = Auditor(subject).audit("new.txt", "\n\n\n\n" + TEXT, same_text=False, kept=KEPT)
    assert (told(outcome), outcome.moved) == ([], [])


def test_a_fingerprint_lays_its_own_text_out_as_it_was() -> None:
    relaid = Relaid(KEPT, TEXT)
    assert len(relaid.lines) == len(TEXT.splitlines())
    assert [line.split() for line in relaid.lines if "---" not in line] == [
        line.split() for line in TEXT.splitlines() if "---" not in line
    ]
    assert all(below == above + 1 for above, below in pairwise(map(relaid.now, range(1, len(relaid.lines) + 1))))


def test_a_fingerprint_holds_no_word_of_its_text() -> None:
    """One of 64 signs for each word: no number of the text, and no word of three letters or more."""
    kept = Fingerprint.of(TEXT, "0" * 64).written().split("\n", 1)[1]
    assert not [
        word for word in re.findall(r"[A-Za-z]{3,}|[0-9]{2,}", TEXT) if re.search(rf"(?<!\w){word}(?!\w)", kept)
    ]
    assert len(kept) < len(TEXT) / 2


EXCHANGED = {
    "codes of two rows": (TEXT, "A002", "A003"),
    "codes of rows with one cell for all": (TEXT.replace("| 1-3000 | 0.01 s |", "| 1-3000 | |"), "A002", "A003"),
    "headings": (TEXT, "4.2 Mode", "4.3 Limits"),
    "numbers of headings": (TEXT, "4.2", "4.3"),
    "registers": (TEXT, "2001h (8193)", "2002h (8194)"),
    "limits of two rows": (TEXT, "0-4000", "20-140"),
}


@pytest.mark.parametrize(("text", "one", "other"), EXCHANGED.values(), ids=EXCHANGED)
def test_what_was_exchanged_is_told(text: str, one: str, other: str, auditor: Auditor) -> None:
    """It stands where its like stood, and no layout may bring it back."""
    new = text.replace(one, "@").replace(other, one).replace("@", other)
    assert told(auditor.audit("new.txt", new, same_text=False, kept=Fingerprint.of(text, "0" * 64))) != []


ADDED = {
    "a row like one above": (
        "| A004",
        "| A003 | Deceleration ramp | 1009h (4105) | 1-3000 | 0.01 s | From the maximum. |\n| A004",
    ),
    "the same row again": ("| A004", f"| {' | '.join(ROWS[2])} |\n| A004"),
    "a sentence of numbers": ("possible with", "possible below 17 Hz with"),
    "a number in a line that was broken": ("limited in both directions", "limited\nto 217 in both directions"),
}


@pytest.mark.parametrize(("old", "new"), ADDED.values(), ids=ADDED)
def test_what_was_added_is_told(old: str, new: str, auditor: Auditor) -> None:
    outcome = auditor.audit("new.txt", TEXT.replace(old, new, 1), same_text=False, kept=KEPT)
    assert told(outcome) != []


def test_a_line_that_went_elsewhere_alone_has_moved(auditor: Auditor) -> None:
    """Not back to its old place, for it may have changed places with another: it is told where it stands."""
    line = next(line for line in TEXT.splitlines() if line.startswith("The torque")) + "\n"
    text = TEXT.replace(line, "") + f"\n{line}"
    outcome = auditor.audit("new.txt", text, same_text=False, kept=KEPT)
    assert [(place.subject, place.now) for place in outcome.moved] == [("torque_limit", len(text.splitlines()))]
    assert not [one for one in outcome.missing if "printed wire" in one.fact]
