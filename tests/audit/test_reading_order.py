"""A text that gives the pieces of its pages in another order says the same; what says something else there is told."""

from __future__ import annotations

import pytest
from fieldscribe.audit.editions.changes import Editions
from fieldscribe.audit.pages import page_lines_of_both

PAGE = """The block of a function
has five fields, as it is shown here.
SlaveAddress
Function
0x10
First word
Count
max. 127
Checksum
CRC16
1 Byte1 Byte2 Bytes
The checksum is sent with its low byte ahead.
8 Bits even
8 Bits odd
110
Bit count
No more than thirty devices may be connec-
H
to one line, whatever it is made of.
ted without a repeater.
1 wrong function
2 wrong address
Legend of all tables
R/Oread only
intInteger of two bytes
End of the page."""
LAYOUT = {
    # what is written otherwise: each text with the one in its place
    "a label that moved": [("Bit count\n", ""), ("8 Bits even", "Bit count\n8 Bits even")],
    "a cell of two lines as one": [("SlaveAddress\n", ""), ("First word", "First word\nSlave-\nAddress")],
    "cells that were joined": [("Checksum\nCRC16\n", ""), ("Function\n0x10", "ChecksumCRC16\nFunction\n0x10")],
    "a number that was joined to the end of a line": [("odd\n110", "odd"), ("even", "even 110")],
    "the halves of a word": [("connec-", "connected"), ("\nted without", "\nwithout")],
    "a line behind a half": [
        ("connec-\nH", "connected @\nH"),
        ("ted without a repeater.\n", ""),
        ("@", "without a repeater."),
    ],
    "a column that moved": [
        ("Function\n0x10\nFirst word\n", ""),
        ("its low byte ahead.", "its low byte ahead.\nFunction\n0x10\nFirst word"),
    ],
    "what was padded and moved": [
        ("R/Oread only\nintInteger of two bytes\n", ""),
        ("The block of a", "R/O read only\nint Integer of two bytes\nThe block of a"),
    ],
    "spaced letters": [("CRC16", "C R C 1 6")],
    "a number beside its label": [("CRC16\n", ""), ("1 wrong", "1wrong"), ("Function\n0x10", "Function\n0x10\nCRC16")],
}  # fmt: skip


def _with(changes: list[tuple[str, str]]) -> str:
    text = PAGE
    for old, new in changes:
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    return text


def _told(old: str, new: str) -> list[tuple[str, list[tuple[str, str]]]]:
    editions = Editions(old, new)
    return [
        (change.kind, [(editions.old.shown(was), editions.new.shown(now)) for was, now in change.gaps])
        for change in editions.changes
    ]


@pytest.mark.parametrize("changes", LAYOUT.values(), ids=LAYOUT)
def test_another_order_is_no_change(changes: list[tuple[str, str]]) -> None:
    assert _told(PAGE, _with(changes)) == []
    assert _told(_with(changes), PAGE) == []


CHANGES = {
    "a number in a line that moved": (
        [("max. 127\n", ""), ("SlaveAddress", "max. 32\nSlaveAddress")],
        [("changed", [("127", "32")])],
    ),
    "a number where a cell beside it moved": (
        [("CRC16\n", ""), ("First", "CRC16\nFirst"), ("max. 127", "max. 125")],
        [("changed", [("127", "125")])],
    ),
    "a row above one that was padded": (
        [("2 wrong address", "3 other value\n2wrong address")],
        [("added", [("", "3 other value")])],
    ),
    "numbers that were exchanged": (
        [("1 wrong function\n2 wrong address", "2 wrong function\n1 wrong address")],
        [("changed", [("1", "2")]), ("changed", [("2", "1")])],
    ),
    "a list's end behind what its last line lost": (
        [(" with its low byte ahead.", "\n3 other value")],
        [("changed", [("with its low byte ahead.", "")]), ("added", [("", "3 other value")])],
    ),
}  # fmt: skip


@pytest.mark.parametrize(("changes", "told"), CHANGES.values(), ids=CHANGES)
def test_what_says_something_else_is_told(changes: list[tuple[str, str]], told: list[object]) -> None:
    assert sorted(map(str, _told(PAGE, _with(changes)))) == sorted(map(str, told))


ENTRIES = "Protocol\n0\nBinary\n1\nText of words\n2\nMaster of all\n3\nOff\nBaud rate\n0\n9600\n1\n4800\nEnd."


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("Text of words", "Off"),
        ("9600", "4800"),
        ("Text of words", "Master of all"),
        ("Binary", "Off"),
        ("Off", "4800"),
    ],
)
def test_labels_and_numbers_that_were_exchanged_are_told(old: str, new: str) -> None:
    text = ENTRIES.replace(old, "@").replace(new, old).replace("@", new)
    assert _told(ENTRIES, text)


@pytest.mark.parametrize(("end", "cell"), [("127", "500"), ("127h", "500"), ("1.27", "500"), ("slow", "fast")])
def test_the_end_of_a_line_and_the_cell_below_that_were_exchanged_are_told(end: str, cell: str) -> None:
    was = PAGE.replace("max. 127", f"max. {end}\n{cell}")
    now = PAGE.replace("max. 127", f"max. {cell}\n{end}")
    assert _told(was, now)
    assert _told(now, was)


def test_rows_that_differ_in_numbers_stay_in_their_places() -> None:
    was = "Inputs\nBit 5R/WInput 8 (=0x0040)\nBit 5R/WInput 7 (=0x0080)\nThe end of it."
    now = "Inputs\nBit 6R/WInput 7 (=0x0040)\nBit 7R/WInput 8 (=0x0080)\nThe end of it."
    assert [words for _, gaps in _told(was, now) for words in gaps] == [
        ("5R", "6R"),
        ("8", "7"),
        ("5R", "7R"),
        ("7", "8"),
    ]


TEXT = ["Words of this page, and many of them.", "More of them follow, and then some more.", *"abcdefg"]


def _pages(last: list[str], moved: dict[int, str], first: int) -> list[str]:
    """Pages with a foot, the last lines of two of them, and bare numbers that stand elsewhere."""
    lines = []
    for page in range(first, first + 6):
        foot = [f"Page {page}"] if page - first not in moved else []
        lines += [*TEXT, *(last if page - first in (2, 3) else [f"End {page}, as it is."]), str(page - 1), *foot]
    return lines


def test_what_two_pages_end_with_is_text_where_the_other_edition_has_it_as_text() -> None:
    old, new = _pages(["Byte1234"], {}, 7), _pages(["Byte1234", "And so on it goes."], {}, 7)
    was, now = page_lines_of_both(old, new)
    assert "Byte1234" not in {old[line - 1] for line in was} | {new[line - 1] for line in now}


def test_the_bare_number_of_a_page_that_is_not_named_is_a_page_number() -> None:
    old, new = _pages([], {3: ""}, 10), _pages([], {3: ""}, 12)
    assert all(str(page) in {old[line - 1] for line in page_lines_of_both(old, new)[0]} for page in range(9, 15))


def test_a_hyphen_that_parts_a_word_is_not_that_of_another() -> None:
    was = "First line.\nOf all datawords the one at 755 (ASCII-code of it) is sent.\nA second line.\nAnd the last."
    now = "First line.\nOf all data-\nA second line.\nwords the one at 755 (ASCII-code of it) is sent.\nAnd the last."
    assert _told(was, now) == _told(now, was) == []


CUT = """| Code | Title | Meaning | Register | Range |
|------|-------|---------|----------|-------|
| A001 | Source of frequency | Choices:<br>00 .. dial<br>01 .. input | 1019h/1018h | 0-3 |
| A201 | Source of frequency (set 2) | 02 .. panel<br>03 .. bus | 150Ah/1509h | 0-3 |
| A002 | Start and stop | Choices: | 101Ah/1019h | 1-3 |
"""
WHOLE = CUT.replace("02 .. panel<br>03 .. bus", "").replace("01 .. input", "01 .. input<br>02 .. panel<br>03 .. bus")


def test_a_cell_of_two_rows_may_be_cut_between_them() -> None:
    assert _told(CUT, WHOLE) == _told(WHOLE, CUT) == []


@pytest.mark.parametrize(
    ("was", "now", "words"),
    [
        ("panel", "remote", [("panel", "remote")]),
        ("02 ..", "04 ..", [("02", "04")]),
        ("<br>02 .. panel", "", [("02 .. panel", "")]),
        ("1509h", "150Bh", [("1509h", "150Bh")]),
    ],
)
def test_a_change_in_rows_whose_cell_is_whole_now_is_told(was: str, now: str, words: list[tuple[str, str]]) -> None:
    told = _told(CUT, WHOLE.replace(was, now))
    assert [pair for _, gaps in told for pair in gaps] == words


@pytest.mark.parametrize(
    ("was", "now"),
    [
        (("0-3 |\n| A201", "1-2 |\n| A201"), ("-", "-")),  # a range
        (("0-3 |\n| A201", "|\n| A201"), ("-", "-")),
        (("01 .. input", "01 .. input<br>02 .. panel"), ("02 .. panel<br>", "")),  # a label of the other row
    ],
)
def test_cells_of_their_own_rows_are_no_cut_ones(was: tuple[str, str], now: tuple[str, str]) -> None:
    assert _told(CUT, CUT.replace(*now).replace(*was))
