"""Pieces of text in two layouts that say the same, and beside each the nearest change that must not pass for layout."""

from __future__ import annotations

import pytest
from fieldscribe.audit.editions.changes import Editions
from fieldscribe.audit.manual import tokens_of

TITLES = ("1 Bus", "1.1 Frames", "1.2 Errors", "2 Points")
TEXT = "\n".join(f"{title}\n\nWords of it, {'and more ' * number}.\n" for number, title in enumerate(TITLES))

NAMES = ("first", "other", "third", "fourth", "fifth", "sixth", "seventh", "eighth")

SAME = {
    # two layouts of one text
    "formula in pieces": (r"value = t [s] · 50 · $\frac{1}{s}$", r"$value = t [s] \cdot 50 \cdot \frac{1}{\text{s}}$"),
    "names of a formula upright": (r"$\text{value} = f[\text{Hz}] \cdot 256$", r"value = $f [Hz] \cdot 256$"),
    "fraction in one line": (r"step $\frac{256}{\text{Hz}}$", "step 256 / Hz"),
    "signs of formulas": (r"20 $^{\circ}$C, 5 $\mu$s, 2 $\Omega$, 3 \%", "20 °C, 5 µs, 2 Ω, 3 %"),
    "contents with other pages and leaders": (
        "\n".join(f"{title}.....\t{page}" for page, title in enumerate(TITLES, 5)) + f"\n\n{TEXT}",
        "\n".join(f"{title}\t{page}" for page, title in enumerate(TITLES, 6)) + f"\n\n{TEXT}",
    ),
    "long titles of the contents in two lines": (
        "1.1 Frames\t5\n1.2 Errors of IEC 255 and others\t6\n2 Points\t7\n" + TEXT,
        "1.1 Frames\t6\n1.2 Errors of IEC 255\nand others\t7\n2 Points\t8\n" + TEXT,
    ),
    "contents in a table": (
        "\n".join(f"| {title} ..... | {page} |" for page, title in enumerate(TITLES, 5)) + f"\n\n{TEXT}",
        "\n".join(f"| {title}.. | {page} |" for page, title in enumerate(TITLES, 9)) + f"\n\n{TEXT}",
    ),
    "thousands apart": ("from 3840 to 17920 s", "from 3 840 to 17\u202f920 s"),
    "cells over two lines": (
        "1\tstop\tnone\n2\tflow temperature of circuit 2\tdegrees Celsius\tread only",
        "1\tstop\tnone\n2\tflow temperature\tdegrees\tread only\n\tof circuit 2\tCelsius\t",
    ),
    "cells over three lines": (
        "| 2 | flow temperature of 2 | degrees Celsius | always |\n| 3 | stop | none | |",
        "| 2 | flow | degrees | always |\n|  | temperature | Cel- | |\n| | of 2 | sius | |\n| 3 | stop | none | |",
    ),
}
CHANGED = {
    # what is said otherwise: the words
    "number of a formula": (r"$t \cdot 50 \cdot \frac{1}{s}$", r"$t \cdot 20 \cdot \frac{1}{s}$", [("50", "20")]),
    "unit of a formula": (r"$\frac{256}{\text{Hz}}$", r"$\frac{256}{\text{kHz}}$", [("Hz", "kHz")]),
    "numbers that stand apart": ("bytes 1 200 100 300", "bytes 1200 100 300", [("1 200", "1200")]),
    "fraction": (r"$\frac{1}{10}$ V", r"$\frac{1}{100}$ V", [("10", "100")]),
    "title in the contents": (
        "\n".join(f"{title}.....\t{page}" for page, title in enumerate(TITLES, 5)) + f"\n\n{TEXT}",
        "\n".join(f"{title}.....\t{page}" for page, title in enumerate((*TITLES[:3], "2 Words"), 5)) + f"\n\n{TEXT}",
        [("Points", "Words")],
    ),
    "number in cells over two lines": (
        "2\tflow temperature of circuit 2\tdegrees 100 Celsius\tread only",
        "2\tflow temperature\tdegrees\tread only\n\tof circuit 2\t150 Celsius\t",
        None,
    ),
    "values that changed their cells": (
        "2\tflow\t10\t900\n\tat night\t20\t",
        "2\tflow\t900\t10\n\tat night\t20\t",
        None,
    ),
    "rows that end with a number": (
        "1 Mode ..... 3\n2 Speed ..... 5\n3 Delay ..... 8",
        "1 Mode ..... 3\n2 Speed ..... 6\n3 Delay ..... 8",
        [("5", "6")],
    ),
}


@pytest.mark.parametrize(("old", "new"), SAME.values(), ids=SAME)
def test_another_layout_changes_nothing(old: str, new: str) -> None:
    assert _words(old, new) == _words(new, old) == []


@pytest.mark.parametrize(("old", "new", "words"), CHANGED.values(), ids=CHANGED)
def test_what_says_something_else_is_a_change(old: str, new: str, words: list[tuple[str, str]] | None) -> None:
    changed = _words(old, new)
    assert changed if words is None else changed == words


@pytest.mark.parametrize(
    ("text", "numbers"),
    [
        ("to 17 920 s", ["17 920"]),
        ("to 1 000 000", ["1 000 000"]),
        ("1 200 100 30", ["1", "200", "100", "30"]),
        ("0 100", ["0", "100"]),
    ],
)
def test_thousands_are_one_number_where_no_others_stand_beside(text: str, numbers: list[str]) -> None:
    assert [token.text for token in tokens_of(text, 1)] == numbers


def _words(old: str, new: str) -> list[tuple[str, str]]:
    """What was changed, old and new."""
    editions = Editions(old, new)
    gaps = [gap for change in editions.changes for gap in change.gaps]
    return [(editions.old.shown(was), editions.new.shown(now)) for was, now in gaps]


def test_sections_that_moved_take_all_words_of_their_headings_along() -> None:
    titles = [f"4.2.{100 + number} Threshold {name}" for number, name in enumerate(NAMES)]
    sections = [f"{title}\n\n{title[-5:]} is the threshold of it, as said.\nID\t{title[4:7]}\n" for title in titles]
    now = [*sections[:2], *sections[4:6], *sections[2:4], *sections[6:]]
    editions = Editions("\n".join(sections), "\n".join(now))
    assert [editions.now(5 * number + 1) for number in (2, 4, 6)] == [(21, 21), (11, 11), (31, 31)]
