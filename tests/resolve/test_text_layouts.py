"""How texts stand in words: by their own keys, their format, their group, or `types` of group or device."""

from __future__ import annotations

from pathlib import Path

import pytest
from fieldscribe.arithmetic.texts import fits, pattern_of_text, text_of
from fieldscribe.model import Text
from support.described import group, head, loaded_in, together

POINTS = """\
- {name: plain, at: 1, type: text, characters: 4}
- {name: own, at: 30, type: text, characters: 3, padding: 20h, per_word: 2}
- {name: formatted, at: 50, format: code}
- {name: number, at: 70, type: u32}
"""


def test_the_nearest_place_decides(tmp_path: Path) -> None:
    types, formats = "{text: {padding: 00h, encoding: latin-1}}", "{code: {type: text, characters: 2, per_word: 1}}"
    first = group(POINTS)
    second = POINTS.replace("name: ", "name: b_").replace(" at: ", " at: 1")
    facts = {"per_word": "1", "bytes": "low first", "types": "{text: {padding: 20h}}"}
    device = loaded_in(tmp_path, together(head(types=types, formats=formats), first, group(second, group="b", **facts)))
    assert {point.name: point.text for point in device.points} == {
        "plain": Text(4, "latin-1", 2, 0),
        "own": Text(3, "latin-1", 2, 0x20),
        "formatted": Text(2, "latin-1", 1, 0),
        "number": None,
        "b_plain": Text(4, "latin-1", 1, 0x20, low_first=True),
        "b_own": Text(3, "latin-1", 2, 0x20, low_first=True),
        "b_formatted": Text(2, "latin-1", 1, 0x20, low_first=True),
        "b_number": None,
    }
    assert [point.words for point in device.points] == [2, 2, 2, 2, 4, 2, 2, 2]


@pytest.mark.parametrize("order", ["low first", "{text: low first}"])
def test_the_bus_may_have_an_order(tmp_path: Path, order: str) -> None:
    """Listed addresses stand as they are listed."""
    orders = f"bytes: {order}, words: low first"
    bus = f"{{framings: [rtu], units: 1..247, {orders}, functions: {{03h: read, 06h: write, 10h: write_many}}}}"
    whole = head(bus=bus, formats="{code: {type: text, characters: 2}}")
    rows = POINTS + "- {name: listed, at: [90, 95], type: u32, access: r}\n"
    points = {point.name: point for point in loaded_in(tmp_path, together(whole, group(rows))).points}
    assert points["plain"].text == Text(4, "ascii", low_first=True)
    assert [points[name].addresses for name in ("number", "listed")] == [(71, 70), (90, 95)]


@pytest.mark.parametrize(
    ("layout", "text", "pattern"),
    [
        (Text(3, "ascii"), "AB", 0x41422020),
        (Text(3, "ascii", padding=0), "AB", 0x41420000),
        (Text(3, "ascii", low_first=True), "ABC", 0x42412043),
        (Text(2, "ascii", per_word=1), "A", 0x00410020),
        (Text(2, "ascii", per_word=1, padding=0, low_first=True), "A", 0x41000000),
        (Text(3, "utf-8"), "\u20ac", 0xE282AC20),
        (Text(3, "utf-8", per_word=1, padding=0), "\u00e4", 0x00C300A40000),
        (Text(3, "utf-16", per_word=1), "\u00e4", 0x00E400200020),
        (Text(3, "utf-16", per_word=1, padding=0, low_first=True), "\U0001d11e", 0x34D81EDD0000),
    ],
)
def test_words(layout: Text, text: str, pattern: int) -> None:
    assert (pattern_of_text(layout, text), text_of(layout, pattern)) == (pattern, text)


@pytest.mark.parametrize(
    ("layout", "pattern", "text"),
    [
        (Text(4, "ascii", padding=0), 0x41004243, "A"),
        (Text(4, "ascii"), 0x41004220, "A\0B"),
        (Text(4, "ascii", padding=0), 0x41202000, "A"),
        (Text(3, "ascii"), 0x41424399, "ABC"),
        (Text(2, "ascii", per_word=1), 0x99419942, "AB"),
        (Text(4, "utf-8", padding=0), 0x410080FF, "A"),
        (Text(2, "utf-16", per_word=1), 0x00410000, "A\0"),
    ],
)
def test_what_is_read_and_never_written(layout: Text, pattern: int, text: str) -> None:
    assert text_of(layout, pattern) == text


def test_room() -> None:
    assert [fits(Text(4, "utf-8"), text) for text in ("abcd", "\u00e4\u00e4", "\u00e4\u00e4a", "\ud800")] == [
        True,
        True,
        False,
        False,
    ]
    assert [fits(Text(2, "utf-16", 1), text) for text in ("ab", "\U0001d11e", "a\U0001d11e")] == [True, True, False]
    with pytest.raises(UnicodeDecodeError):
        text_of(Text(2, "utf-8"), 0xE282)
