"""Layout that a new edition may have otherwise: no change, whatever it sets anew."""

from __future__ import annotations

import pytest
from fieldscribe.audit.editions.changes import Editions

TABLE = "| Code | Title | Note |\n|------|-------|------|\n"
SAME = {
    "closed numbers": ("| 0 1 h | 8 1 h |\n| 0 F h | 8 F h |", "| 01h | 81h |\n| 0Fh | 8Fh |"),
    "blanks that hold together": ("| 0 1 h | 2 ms |", "| 0 1\u00a0h | 2\u202fms |"),
    "marks of hexadecimal numbers": ("| 05h | 1aH | 0x0F |", "| 05 h | 0x1A | 0Fh |"),
    "commas of decimals": ("from 0,5 to 10,25", "from 0.5 to 10.25"),
    "groups of thousands": ("| 1-300000 | 0-65535 |", "| 1-300 000 | 0-65 535 |"),
    "a list in a cell": ("| 22h | No.<br>• Busy<br>• On |", "| 22h | No. <ul><li>• Busy</li> <li>• On</li></ul>"),
    "styles of a list": ("| 22h | • Busy<br>• On |", '| 22h | <ul style="x"> <li>• Busy</li><li>• On</li></ul> |'),
    "marks of entries": ("- one\n- two\n\nText", "* one\n\u2022 two\n\nText"),
    "numbers of entries": ("Text.\n\n- one\n- two\n\nText", "Text.\n\n1. one\n2. two\n\nText"),
    "an entry without its number": ("1. one\n2. two", "- one\n- two"),
    "bold": ("**Request:**\n\n| 1 |", "#### Request:\n\n| **1** |"),
    "marks below a mark": ("- one\n  - o two 1\n\nText", "- one\n  - two 1\n\nText"),
    "hexadecimal numbers without digits": ("| 0xFC | 0xC4 |", "| FCh | C4h |"),
    "a first cell for both rows": ("0\t0\toff\n\t1\ton\n1\t0\tslow", "0\t0\toff\n0\t1\ton\n1\t0\tslow"),
    "one for three, with lines": ("| 7 | a |\n| | c |\n| | e |", "| 7 | a |\n| 7 | c |\n| 7 | e |"),
    "blanks in a list of numbers": ("one of 0,3,4 and 127", "one of 0, 3, 4 and 127"),
    "a row over two pages": ("9\tan error or a stop\t2, 3 or 11", "9\tan error\t2, 3\n\n\tor a stop\tor 11"),
    "italics by tags": ("The <i>ramp</i> is free", "The ramp is free"),
}  # fmt: skip


@pytest.mark.parametrize(("old", "new"), SAME.values(), ids=SAME)
def test_what_sets_words_is_no_change(old: str, new: str) -> None:
    assert [Editions(*texts).changes for texts in ((old, new), (new, old))] == [(), ()]


CHANGES = {
    "two numbers": ("| 1 2 h | 3 |", "| 1 3 h | 3 |", ("1 2 h", "1 3 h")),
    "a number in place of two": ("bits 1 2 of it", "bits 12 of it", ("1 2", "12")),
    "an ordinal": ("Step 1. Press it", "Step 2. Press it", ("1", "2")),
    "a number before a line": ("one\n\ntwo", "one\n\n7. two", ("", "7.")),
    "a place of the thousands": ("from 1 000 on", "from 10 000 on", ("1", "10")),
    "a digit of a hexadecimal number": ("at 0x1A", "at 1Bh", ("0x1A", "1Bh")),
    "signs behind a number": ("0.... off", "0: off", ("....", ":")),
    "an entry of a cell": (
        "| 05 .. 96 bps<br>06 .. 192 bps |",
        "| 05 .. 96 bps<br>06 .. 192 bps<br>07 .. 9 bps |",
        ("", "07 .. 9 bps"),
    ),
    "a hexadecimal number without digits": ("| of 0xFC |", "| of FDh |", ("0xFC", "FDh")),
    "the first cell of another row": ("0\t0\toff\n\t1\ton\n1\t0\tslow", "0\t0\toff\n1\t1\ton\n1\t0\tslow", ("", "1")),
    "a first cell in a row that had one": ("0\t0\toff\n1\t1\ton", "0\t0\toff\n0\t1\ton", ("1", "0")),
    "an entry with a letter": ("- one\n- p two", "- one\n- two", ("p", "")),
    "a number that is none of a list": ("one of 0,3 or 4", "one of 0, 3 or 4", ("0,3", ",")),
    "a misspelt row below a cell over two lines": (
        "Bits\tone value = two values for others\twhere the value of P13 is 3, for words\n\tthre numbers\tif 127",
        "Bits\tone value\twhere the value of P13 is 3, for words\n\t= two values for others\n\tthree numbers\tif 127",
        ("thre", "three"),
    ),
    "what is no tag": ("<STX> and <LGE>", "<STX> and", ("<LGE>", "")),
}


@pytest.mark.parametrize(("old", "new", "words"), CHANGES.values(), ids=CHANGES)
def test_what_says_something_else_is_one(old: str, new: str, words: tuple[str, str]) -> None:
    editions = Editions(old, new)
    pairs = [
        (editions.old.shown(editions.old.whole(was)), editions.new.shown(editions.new.whole(now)))
        for change in editions.changes
        for was, now in change.gaps
    ]
    assert pairs == [words]


def test_a_row_that_a_page_break_passed_has_moved() -> None:
    head = f"\n{TABLE}| (hex) | in words | |\n"
    rows = [
        f"| {number:04}h | {number:05} | ({word}) |\n" for number, word in enumerate(["Reserved"] * 5 + ["Alarm"], 11)
    ]
    old, new = (TABLE + "".join(rows[:cut]) + head + "".join(rows[cut:]) for cut in (5, 4))
    editions = Editions(old, new)
    assert (editions.changes, [(move.first, move.now) for move in editions.moves]) == ((), [(7, 11)])


def test_a_cell_that_changed_beside_a_row_over_two_pages_is_told() -> None:
    editions = Editions("9\tan error or a stop\t2, 3 or 11", "9\tan error\t2, 4\n\n\tor a stop\tor 11")
    assert [change.kind for change in editions.changes] == ["changed"]


def test_a_row_may_stand_where_text_stood() -> None:
    """Its words are matched with those of a line that has no cells."""
    editions = Editions("Bit 0 first input\nBit 1 second one\n", "|Bit 0|first input is here|\n|Bit 1|second one|\n")
    assert [change.kind for change in editions.changes] == ["changed"]
