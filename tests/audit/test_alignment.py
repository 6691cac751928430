"""Two texts line by line: what changed, was added, removed or moved; and how long that takes for long texts."""

from __future__ import annotations

import time

import pytest
from fieldscribe.audit.alignment import Alignment, changed_words

ROWS = "| A1 | 5 | x |\n| A2 | 6 | y |\n| A3 | 7 | z |"


@pytest.mark.parametrize(
    ("old", "new", "changes"),
    [
        ("a 1\nb 2\nc 3", "a 1\nb 2\nc 3", []),
        ("a  1\n\n| b | 2|", "a 1\n|  b|2 |", []),
        ("a 1\nb 2\nc 3", "a 1\nb 4\nc 3", [("changed", 2, 2)]),
        ("a 1\nb 2", "a 1\nx 7\nb 2", [("added", None, 2)]),
        ("a 1\nx 7\nb 2", "a 1\nb 2", [("removed", 2, None)]),
        ("a b 1\nc d 2\ne f 3\ng h 4", "g h 4\na b 1\nc d 2\ne f 3", [("moved", 4, 1)]),
        (ROWS, ROWS.replace("5", "8").replace("6", "9").replace("7", "0"), [("changed", n, n) for n in (1, 2, 3)]),
        (ROWS, ROWS.replace("| A2 | 6 | y |\n", ""), [("removed", 2, None)]),
        (ROWS, ROWS.replace("| A2 | 6 | y |", "| B9 | 3 | q |"), [("removed", 2, None), ("added", None, 2)]),
        ("x 1\nx 1\nx 1", "x 1\nx 1", [("removed", 3, None)]),
        ("", "a", [("added", None, 1)]),
    ],
)
def test_every_line_that_differs_is_listed(
    old: str, new: str, changes: list[tuple[str, int | None, int | None]]
) -> None:
    assert [tuple(change) for change in Alignment(old.splitlines(), new.splitlines()).changes] == changes


def test_lines_are_found_in_the_other_text() -> None:
    alignment = Alignment(["a 1", "", "b 2", "gone 3", "c 4"], ["new 9", "a 1", "", "b 2", "c 4"])
    assert [alignment.now(line) for line in range(1, 6)] == [2, 3, 4, None, 5]
    assert [alignment.then(line) for line in range(1, 6)] == [None, 1, 2, 3, 5]


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("| H02 | 200-550 |", "| H02 | 200-600 |", [("200-550", "200-600")]),
        ("from 1 to 5 V", "from 1 to 6 mV", [("5 V", "6 mV")]),
        ("a b", "a b c", [("", "c")]),
        ("x " * 2000, "y " * 2000, [(("x " * 2000).strip(), ("y " * 2000).strip())]),
    ],
)
def test_changed_words(old: str, new: str, words: list[tuple[str, str]]) -> None:
    assert changed_words(old, new) == words


LONG = 20_000
TEXTS = [
    ("equal lines", ["x"] * LONG, ["y"] * LONG),
    ("other lines", [f"old {n}" for n in range(LONG)], [f"new {n} of {n}" for n in range(LONG)]),
    ("one more line", [f"r {n % 7} a" for n in range(LONG)], ["r 0 b", *(f"r {n % 7} a" for n in range(LONG))]),
    ("every line changed", [f"P{n} | 1" for n in range(LONG)], ["head", *(f"P{n} | 2" for n in range(LONG))]),
    ("backwards", [f"P{n}" for n in range(LONG)], [f"P{n}" for n in reversed(range(LONG))]),
]


@pytest.mark.full(seconds=0.5)
@pytest.mark.parametrize(("old", "new"), [text[1:] for text in TEXTS], ids=[text[0] for text in TEXTS])
def test_long_texts_end_quickly(old: list[str], new: list[str]) -> None:
    before = time.process_time()
    assert Alignment(old, new).changes
    assert time.process_time() - before < 5
