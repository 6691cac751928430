"""The documentation target: valid tables, nothing lost, nothing that escapes its cell."""

from __future__ import annotations

import re
from dataclasses import replace
from dataclasses import replace as replace_record
from fractions import Fraction
from functools import lru_cache
from typing import Any

import pytest
from fieldscribe.families import family
from fieldscribe.model import Allowed, Device, Document, Enum, Fixed, Flag, Interval, Limit, Place, Source, Special
from fieldscribe.resources import render
from fieldscribe.targets.docs import device_tables, outputs
from fieldscribe.targets.docs.cells import MARKDOWN, anchor, link, narrow, target
from support.models import HERTZ, NUMBER, changed, entry, linear, point, sample_device, titles, value_of

HOSTILE = "a | b `c` </td><script>alert(1)</script> [x](http://e) {{ 7*7 }} \\"
DEVICE = sample_device()


@lru_cache(maxsize=1)
def _written() -> dict[str, str]:
    return dict(outputs(DEVICE, render))


def _page(device: Device | None = None) -> str:
    return next(text for path, text in outputs(device or DEVICE, render) if path == "docs/sample_drive.md")


def _cells(line: str) -> list[str]:
    """The cells of a table row, as GitHub counts them: a backslash keeps a border inside its cell."""
    return re.split(r"(?<!\\)(?:\\\\)*\|", line)[1:-1]


def _row(page: str, item: str) -> list[str]:
    found = next(line for line in page.splitlines() if f'<a id="point-{item}"></a>' in line)
    return [one.strip() for one in _cells(found)]


def test_four_files_and_the_same_bytes_each_time() -> None:
    ends = (".md", ".csv", "_meanings.csv", ".html")
    assert list(_written()) == [f"docs/sample_drive{end}" for end in ends]
    assert dict(outputs(sample_device(), render)) == _written()


def test_every_table_is_well_formed() -> None:
    width = 0
    lines = _page().split("\n")
    for number, line in enumerate(lines):
        assert line == line.rstrip(), f"trailing blank in line {number + 1}"
        if not line.startswith("|"):
            width = 0
            continue
        if not width:
            width = len(_cells(line))
            assert lines[number - 1] == "", "a table starts after an empty line"
            assert lines[number + 1] == "| " + " | ".join(["---"] * width) + " |"
        assert len(_cells(line)) == width, line
    assert lines[-1] == ""
    assert lines[-2] != ""


def test_a_write_address_stands_among_the_remarks() -> None:
    made = point("made", 7, "u32", write_place=Place((0x20, 0x21), {"modicon": 33}))
    told = "written at 0020h (32) high, 0021h (33) low, modicon 33"
    assert any(told in cell for cell in _row(_page(sample_device((made,))), "made"))


def test_every_link_has_its_target() -> None:
    page = _page()
    targets = re.findall(r'<a id="([^"]+)"></a>', page)
    assert len(targets) == len(set(targets))
    assert set(re.findall(r"\]\(#([^)]+)\)", page)) <= set(targets)


def test_names_that_only_a_documented_point_uses_are_shown() -> None:
    entries = tuple(entry(number, f"baud_{number}") for number in range(6))
    speeds = Enum("speeds", entries, True)
    page = _page(sample_device((point("baud_rate", 1, enum=speeds, generated=False, reason="not reachable"),)))
    assert "| 0 = baud_0 (" in page
    assert "<br>5 = baud_5 (" in page


def test_a_row_of_the_page() -> None:
    assert _row(_page(), "base_frequency") == [
        "A020",
        '<a id="point-base_frequency"></a>`base_frequency`<br>Base frequency / Basisfrequenz',
        "holding",
        "1028h (4136)",
        "4137 / 404137",
        "u16",
        "rw",
        "0..400<br>default 50",
        "Hz",
        "0..4000",
        "value = raw x 0.1",
        "set 1; kept after [enter](#command-enter); was `main_frequency`; erratum [a020_wire](#erratum-a020_wire)",
        "Gruppe A, line 780",
    ]


@pytest.mark.parametrize(
    ("text", "broken"),
    [
        ("keypad", "keypad"),
        ("motor_speed", "motor_speed"),
        ("max(1, upper_speed_limit)..4000", "max(1, upper_<wbr>speed_<wbr>limit)..<wbr>4000"),
        ("-32768..32767", "-32768..<wbr>32767"),
        ("0..4294967295", "0..<wbr>4294967295"),
        ("0..A061", "0..A061"),
        ("1..A061; while A061.raw is 0: to 400", "1..<wbr>A061; while A061.raw is 0: to 400"),
    ],
)
def test_where_a_narrow_cell_may_be_broken(text: str, broken: str) -> None:
    assert narrow(text) == broken


LEVELS = Enum("levels", tuple(entry(number, f"level_{number}") for number in range(6)), True)
EVENTS = Enum("events", tuple(entry(number, f"event_{number}") for number in range(40)), True)


def test_a_list_of_names_stands_once_a_group_beside_its_first_point() -> None:
    users = [point(f"user_{place}", place, enum=enum) for place, enum in enumerate((LEVELS, EVENTS, LEVELS, EVENTS))]
    page = _page(sample_device(tuple(users)))
    levels = "<br>".join(f"{number} = level_{number} (level_{number})" for number in range(6))
    said = [_row(page, user.name)[-2].removesuffix("; lost when switched off") for user in users]
    below = "[numbers below](#numbers-user_1)"
    assert said == [levels, below, "numbers as of [user_0](#point-user_0)", below]
    assert '<a id="numbers-user_1"></a>Numbers of [`user_1`](#point-user_1), [`user_3`](#point-user_3):' in page
    assert page.count("| 39 | `event_39` | event_39 |") == 1


@pytest.mark.parametrize(
    ("note", "errata", "in_row", "below"),
    [
        ("Short.", ("a",), "Short; erratum [a](#erratum-a)", ""),
        ("Long " * 30, (), "[more below](#more-speed)", "Long " * 30),
        ("", ("a" * 50, "b" * 80), "[more below](#more-speed)", f"errata [`{'a' * 50}`](#erratum-{'a' * 50}), [`"),
        ("", (), "", ""),
    ],
)
def test_a_long_remark_stands_below_the_table(note: str, errata: tuple[str, ...], in_row: str, below: str) -> None:
    page = _page(sample_device((point("speed", 1, note=titles(note) if note else {}, errata=errata),)))
    assert _row(page, "speed")[-2] == in_row
    said = page.partition('\n- <a id="more-speed"></a>`speed`: ')[2]
    assert said.startswith(below.strip())
    assert bool(said) == bool(below)


def _flag(low: int, width: int, name: str, active: int = 1, values: tuple[str, ...] = ()) -> Flag:
    entries = tuple(entry(number, ("zero", "one")[number], text) for number, text in enumerate(values))
    return Flag(low, width, name, titles(name.capitalize()), active, entries)


WORDS: list[tuple[dict[str, Any], list[str]]] = [
    ({"flags": (_flag(0, 1, "ready"), _flag(4, 2, "mode"))}, ["| 15..6 | 5..4 | 3..1 | 0 |", "|  | mode |  | ready |"]),
    (
        {"flags": (_flag(0, 1, "run"), _flag(10, 1, "valid")), "fixed": Fixed(0xC400, 0x8400)},
        ["| 15..14 | 13..11 | 10 | 9..1 | 0 |", "| always 10 |  | valid<br>always 1 |  | run |"],
    ),
    (
        {"type": "u32", "flags": (_flag(16, 16, "source"), _flag(0, 16, "bit"))},
        ["| 31..16 | 15..0 |", "| source | bit |"],
    ),
    (
        {"flags": tuple(_flag(bit, 1, f"b{bit}") for bit in range(16))},
        ["| " + " | ".join(str(bit) for bit in range(15, -1, -1)) + " |", "| b15 | b14 | b13 |"],
    ),
    (
        {"flags": tuple(_flag(bit, 1, f"operational_{bit}") for bit in range(16))},
        [
            "| 15 | 14 | 13 | 12 | 11 | 10 | 9 | 8 |",
            "| operational_<wbr>15 | ",
            "| **7** | **6** | **5** | **4** | **3** | **2** | **1** | **0** |",
        ],
    ),
    (
        {
            "flags": (_flag(6, 4, "ready_for_operation" * 3), *(_flag(bit, 1, "long" * 30) for bit in range(6))),
            "fixed": Fixed(0xF000, 0xA000),
        },
        [
            "| 15 | 14 | 13 | 12 | 11 | 10 | 9 | 8 |",
            f"| always 1 | always 0 | always 1 | always 0 |  |  | {'ready_<wbr>for_<wbr>operation' * 3} | ← |",
            f"| {'ready_<wbr>for_<wbr>operation' * 3} | ← | {'long' * 30} |",
        ],
    ),
    (
        {"bits": (7, 4), "width": 4, "flags": (_flag(0, 1, "low"), _flag(3, 1, "high"))},
        ["| 7 | 6..5 | 4 |", "| high |  | low |"],
    ),
    (
        {"flags": (_flag(3, 1, "fault", 0, ("a fault", "no fault")), _flag(0, 1, "on", 1, ("off",)))},
        ["| 3 | `fault` | Fault | 0 | a fault | no fault |", "| 0 | `on` | On | 1 | off |  |"],
    ),
]


@pytest.mark.parametrize(("facts", "lines"), WORDS)
def test_a_word_of_bits_is_drawn(facts: dict[str, Any], lines: list[str]) -> None:
    word = point("word", 1, **facts)
    page = _page(sample_device((word, changed(word, name="same"))))
    assert page.count("Bits of ") == 1
    drawn = page.partition('Bits of <a id="bits-word"></a>`word`, <a id="bits-same"></a>`same`:')[2]
    assert [line for line in lines if f"\n{line}" not in drawn] == []


def test_the_map_of_each_space_is_sorted_by_address() -> None:
    points = (
        point("late", 9, place=Place((9,), {"modicon": 10})),
        point("coil", 3, "bit", space="coil"),
        point("high", 2, "u8", bits=(15, 8), width=8),
        point("wide", 4, "u32", place=Place((5, 4), {"modicon": 5}), code="A1"),
        point("low", 2, "u8", bits=(7, 0), width=8),
        point("nowhere", 0, place=Place((), {}), generated=False, reason="no address"),
    )
    page = _page(sample_device(points))
    _, _, maps = page.partition("## Address map")
    rows = [_cells(line) for line in maps.splitlines() if line.startswith("| 0")]
    assert [[cell.strip() for cell in row if cell.strip()][-1] for row in rows] == [
        *[f"[`{name}`](#point-{name})" for name in ("high", "low", "wide", "late")],
        "[`enter`](#command-enter)<br>write any number",
        "[`coil`](#point-coil)",
    ]
    wide = "| 0004h (4)<br>2 words, low word first | 5 / 400005 | u32 | rw | A1 | [`wide`](#point-wide) |"
    assert wide in maps
    assert "| 0900h (2304) | 2305 / 402305 | command | w |" in maps
    assert maps.index("### Holding") < maps.index("### Coil")


def test_rules_call_points_by_codes_that_are_theirs_alone() -> None:
    limit = Limit(linear(1, 0, value_of("upper")), (), 0, 65535)
    limited = Allowed((Interval(1, limit),), False, ())
    upper = point("upper", 1, code="A061")
    points = (upper, point("lower", 2, allowed=limited), point("other", 3, code="A061"))
    assert "1..upper" in _row(_page(sample_device(points)), "lower")
    assert "1..A061" in _row(_page(sample_device(points[:2])), "lower")


def test_the_page_names_what_is_not_generated_and_why() -> None:
    missing = _page().partition("## Not generated")[2]
    assert "the manual prints no address" in missing
    assert "not reachable over the bus" in missing


def test_frames_show_printed_and_corrected_bytes_and_their_meaning() -> None:
    line = next(one for one in _page().splitlines() if '<a id="frame-write_base"></a>' in one)
    frames = "`05 06 10 28 01 F4 A8 54`<br>correct: `05 06 10 28 01 F4 0C 91`"
    assert f"{frames} | `base_frequency` = 500 (50 Hz)" in line


def test_errata_lead_to_their_points_and_frames() -> None:
    page = _page()
    assert "<br>[base_<wbr>frequency](#point-base_frequency) | wire 4137 | wire 4136 |" in page
    assert "<br>frame [`write_base`](#frame-write_base) | crc A8 54 | crc 0C 91 |" in page


@pytest.mark.parametrize(
    ("facts", "in_page"),
    [
        ({}, ""),
        ({"default_raw": 7}, "raw 7"),
        ({"default_raw": 7, "default": Fraction(7, 10), "unit": HERTZ}, "0.7"),
        ({"default": Fraction(1, 3)}, "1/3"),
        ({"default_raw": 0x3402, "flags": (_flag(0, 8, "bit"), _flag(8, 8, "of"))}, "of 52, bit 2"),
    ],
)
def test_a_factory_setting(facts: dict[str, Any], in_page: str) -> None:
    """In the unit, or as a raw number where only that is known."""
    device = sample_device((point("setting", 1, **facts),))
    page = _page(device)
    heads = next(line for line in page.splitlines() if line.startswith("| Name | Wire"))
    cells = dict(zip((head.strip() for head in _cells(heads)), _row(page, "setting"), strict=True))
    span = "" if "flags" in facts else "0..65535"
    assert cells["Range"].split("<br>") == [part for part in (span, in_page and f"default {in_page}") if part]


@pytest.mark.parametrize(
    ("name", "found"),
    [("speed_2-a", "point-speed_2-a"), ("Speed", "point-speed"), ("Über .x", "point--ber--x"), ("a.b", "point-a-b")],
)
def test_an_anchor_has_only_what_every_reader_of_markdown_keeps(name: str, found: str) -> None:
    """GitHub and others change large letters and drop signs; link and target go through the same function."""
    assert anchor("point", name) == found
    assert link("point", name).endswith(f"](#{found})")
    assert target("point", name).startswith(f'<a id="{found}"></a>')


def test_documents_with_and_without_a_file() -> None:
    documents = (DEVICE.documents[0], Document("errata", "Errata", "en", "errata.pdf", "ab" * 32))
    lines = _page(replace(DEVICE, documents=documents)).splitlines()
    at = lines.index("| Document | Title | Language | File | SHA-256 |")
    assert lines[at + 2] == "| `manual` | Sample manual | de |  |  |"
    assert lines[at + 3] == f"| `errata` | Errata | en | errata.pdf | `{'ab' * 32}` |"


@pytest.mark.parametrize(
    ("source", "facts"),
    [
        (Source("manual", None, None, None), "1 point; space holding"),
        (Source("manual", "4.1", "7", None), "1 point; space holding; source: 4.1, page 7"),
    ],
)
def test_the_facts_of_a_group(source: Source, facts: str) -> None:
    groups = tuple(replace(group, source=source) for group in DEVICE.groups)
    page = _page(replace(sample_device((point("speed", 1),)), groups=groups))
    assert f"Group `main`: {facts}." in page.splitlines()


def test_a_family_that_adds_nothing_has_the_facts_of_every_bus(monkeypatch: pytest.MonkeyPatch) -> None:
    bare = replace_record(family("modbus"), name="bare", folder="support")
    monkeypatch.setattr(device_tables, "family", lambda _: bare)
    view = device_tables.bus_view(DEVICE, MARKDOWN)
    assert "| Unit numbers | 1..32 |" in view.facts
    assert "padded" not in view.facts
    assert "Functions" in dict(view.sections)


def _hostile() -> Device:
    titles = {"en": HOSTILE, "de": "=cmd()|'x'\r\nnew"}
    special = Special(9, 9, "odd", titles, False)
    bad = point("bad", 1, title=titles, note=titles, code=HOSTILE, specials=(special,), conditions=(HOSTILE,))
    unit = replace(NUMBER, symbol="|<b>")
    group = replace(DEVICE.groups[0], title=titles, note={"en": "1. one"})
    enum = replace(DEVICE.enums[0], entries=(entry(0, "zero", HOSTILE),))
    errata = (replace(DEVICE.errata[0], printed=HOSTILE, why=HOSTILE, points=("bad",), leaves_open=(("at", HOSTILE),)),)
    made = sample_device((bad, changed(bad, name="worse", unit=unit, enum=enum)))
    return replace(made, title=titles, note=titles, groups=(group,), enums=(enum,), errata=errata, vendor=HOSTILE)


def test_hostile_text_stays_in_its_cell() -> None:
    page = _page(_hostile())
    assert len(_row(page, "bad")) == len(_row(page, "worse"))
    assert "<script" not in page
    assert "<b>" not in page
    assert "</td>" not in page
    assert "\r" not in page
    assert "](http" not in page.replace("\\]\\(http", "")
    assert "1\\. one" in page


def test_hostile_text_is_plain_html_for_a_real_parser() -> None:
    parser = pytest.importorskip("markdown_it").MarkdownIt("commonmark").enable("table")
    page = _page(_hostile())
    html = parser.render(page)
    assert "<script" not in html
    assert 'href="http' not in html
    assert "<li>one" not in html
    columns = {len(re.findall("<t[dh]", row)) for row in re.findall(r"<tr>.*?</tr>", html, re.DOTALL) if "bad" in row}
    assert columns
    assert html.count("<table>") == page.count("\n| ---")
