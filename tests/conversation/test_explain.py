"""Finding a point by what a person has at hand, and saying all that is known of it."""

from __future__ import annotations

import json
from dataclasses import replace

import pytest
from fieldscribe.conversation.explanation import explain_other_items, explain_point
from fieldscribe.conversation.lookup import find, near
from fieldscribe.pasted_numbers import number_of
from fieldscribe.text import shortened
from support.described import shipped
from support.models import changed, named, point, sample_device

DEVICE = sample_device()


def _rows(item: str, *, as_documented: bool = False) -> dict[str, str]:
    return dict(explain_point(DEVICE, named(DEVICE, item), as_documented=as_documented).rows)


@pytest.mark.parametrize(
    ("text", "number"),
    [
        ("4136", 4136),
        ("0010", 10),
        ("0x1028", 0x1028),
        ("1028h", 0x1028),
        ("0FFh", 255),
        ("H'1028", 0x1028),
        ("A020", None),
        ("FFh", None),
        ("", None),
        ("-1", None),
        ("１２", None),
        ("9" * 5000, None),
    ],
)
def test_notations(text: str, number: int | None) -> None:
    assert number_of(text) == number


@pytest.mark.parametrize(
    ("what", "found"),
    [
        ("A020", [("code A020", "base_frequency", "")]),
        ("a020", [("code A020", "base_frequency", "")]),
        ("base_frequency", [("name base_frequency", "base_frequency", "")]),
        ("main_frequency", [("old name main_frequency", "base_frequency", "")]),
        ("dc_level_400v", [("name dc_level_400v", "dc_level_400v", "")]),
        ("0x1028", [("wire address 1028h (4136), holding", "base_frequency", "")]),
        ("1028h", [("wire address 1028h (4136), holding", "base_frequency", "")]),
        ("4137", [("modicon 4137", "base_frequency", "")]),
        ("404137", [("reference 404137", "base_frequency", "")]),
        (
            "4116",
            [
                ("wire address 1014h (4116), holding", "acceleration_time", "low word (2 of 2, the high part first)"),
                ("modicon 4116", "acceleration_time", "high word (1 of 2, the high part first)"),
            ],
        ),
        ("modicon:4116", [("modicon 4116", "acceleration_time", "high word (1 of 2, the high part first)")]),
        (
            "wire: 2000h",
            [("wire address 2000h (8192), holding", "swapped_count", "low word (2 of 2, the high part first)")],
        ),
        ("name:A020", []),
        ("code:base_frequency", []),
        ("wire:4137", []),
        ("nonsense:4137", []),
        ("408193", [("reference 408193, computed", "swapped_count", "low word (2 of 2, the high part first)")]),
    ],
)
def test_finding(what: str, found: list[tuple[str, str, str]]) -> None:
    assert [(one.reading, one.point.item, one.word) for one in find(DEVICE, what)] == found


def test_a_code_that_several_points_have() -> None:
    assert [one.point.item for one in find(DEVICE, "b131")] == ["dc_level_200v", "dc_level_400v"]


def test_bit_groups_share_an_address() -> None:
    assert [one.point.item for one in find(DEVICE, "wire:2012h")] == ["delay_class", "signed_byte"]


def test_printed_references_that_are_text() -> None:
    device = sample_device((point("power", 7, references={"parameter": "P1082"}),))
    assert [one.reading for one in find(device, "p1082")] == ["parameter P1082"]
    assert find(device, "P1083") == []


@pytest.mark.parametrize(
    ("what", "names"),
    [
        ("base_frequenzy", ["base_frequency"]),
        ("A02", ["A020"]),
        ("a-20", ["A020"]),
        ("A020[3]", ["A020"]),
        ("A020.1", ["A020"]),
        ("A020 A021", ["A020"]),
        ("404137", []),
        ("name:base_freqency", ["base_frequency"]),
        ("4200", ["lower_limit", "start_frequency"]),
    ],
)
def test_what_is_near(what: str, names: list[str]) -> None:
    assert near(DEVICE, what)[: len(names) or None] == names


@pytest.mark.parametrize(
    ("typed", "shown"),
    [("a" * 60, "a" * 60), ("a" * 61, "a" * 57 + "..."), ("a\x1b[31m\nb", "a[31m b"), ("a" * 9999, "a" * 57 + "...")],
)
def test_what_was_typed_is_repeated_clean_and_short(typed: str, shown: str) -> None:
    assert shortened(typed) == shown


@pytest.mark.parametrize(
    ("what", "readings"),
    [
        ("enter", ["command enter"]),
        ("name:ENTER", ["command enter"]),
        ("code:enter", []),
        ("wire:enter", []),
        ("a020_wire", ["erratum a020_wire"]),
        ("code:a020_wire", []),
        ("wire:900h", ["wire address 0900h (2304), holding"]),
        ("name:900h", []),
        ("402305", ["reference 402305"]),
        ("modicon:2305", ["modicon 2305"]),
    ],
)
def test_what_is_no_point_is_found_by_its_name_or_its_place_alone(what: str, readings: list[str]) -> None:
    found = explain_other_items(DEVICE, what)
    assert [reading for answer, _ in found for reading in answer][: len(readings) or None] == readings


def test_nothing_is_near_nonsense() -> None:
    assert near(DEVICE, "zzzzzz") == []
    assert near(DEVICE, "x" * 100000) == []


def test_a_scaled_point_with_its_requests() -> None:
    rows = _rows("base_frequency")
    assert rows["Wire address"] == "1028h (4136), space holding"
    assert rows["Modicon"] == "4137 (1029h)"
    assert rows["Reference"] == "404137"
    assert rows["Read"] == "function 03h, 1 word; request to unit 1 (rtu): 01 03 10 28 00 01 00 C2"
    assert rows["Write"] == (
        "function 06h; for example 50 Hz is raw 500; request to unit 1 (rtu): 01 06 10 28 01 F4 0D 15"
    )
    assert (rows["Range"], rows["Raw range"]) == ("0..400 Hz", "0..4000")
    assert rows["Erratum"] == ("a020_wire (certain): the manual prints: wire 4137. Taken: wire 4136. Hex is right.")
    assert rows["Source"] == "Sample manual, Gruppe A, line 780 of its text"


def test_requests_of_other_kinds() -> None:
    assert _rows("run_command")["Write"].endswith("01 05 00 00 00 00 CD CA")
    assert _rows("running")["Read"].endswith("01 01 00 0D 00 01 6C 09")
    assert "01 10 10 13 00 02 04 00 00 00 01" in _rows("acceleration_time")["Write"]
    assert "01 10 20 14 00 02 04 00 00 00 00" in _rows("float_setpoint")["Write"]
    assert "read the word first" in _rows("delay_class")["Write"]
    assert "Write" not in _rows("running")
    assert "Read" not in _rows("setpoint_display")


def test_what_a_point_needs_and_names() -> None:
    assert _rows("voltage_setpoint")["Scale needs"] == "voltage_ratio (read it first)"
    assert _rows("lower_limit")["Limits need"] == "start_frequency, upper_limit (read them first)"
    assert _rows("frequency_source")["Raw 0"] == "keypad (Keypad / Bedienfeld)"
    assert _rows("temperature")["Raw 32767"] == "no_sensor (No sensor), no value"
    assert _rows("status_word")["Bits 5..4"] == "mode (Mode): 0 = stop (stop), 3 = run (run)"
    assert _rows("analog_filter")["Write only when"] == "stopped"
    assert _rows("baud_rate")["Not generated"] == "not reachable over the bus"


def test_as_documented_shows_what_is_printed() -> None:
    rows = _rows("base_frequency", as_documented=True)
    assert rows["Wire address"] == "4137 (as printed; a020_wire)"
    assert "Erratum" not in rows
    assert "Read" not in rows
    assert _rows("setpoint_display", as_documented=True)["The manual says"] == "No address. (as printed; f001_address)"
    assert "Read" in _rows("third", as_documented=True)


def test_several_printed_facts_in_one_erratum() -> None:
    erratum = replace(
        DEVICE.errata[0], facts=(("modicon", "4370"), ("wire", "4369"), ("range_in_units", "0.00..99900"))
    )
    device = replace(DEVICE, errata=(erratum,))
    rows = dict(explain_point(device, named(device, "base_frequency"), as_documented=True).rows)
    assert rows["Modicon"].startswith("4370 (as printed")
    assert rows["Wire address"].startswith("4369 (as printed")
    assert rows["Range"].startswith("0.00..99900 (as printed")


def test_text_and_data_hold_no_control_characters() -> None:
    hostile = changed(named(DEVICE, "third"), title={"en": "a\x1b[31m\nb\u202ec"}, reason="x\x00y", generated=False)
    explained = explain_point(sample_device((hostile,)), hostile)
    assert explained.heading == "third: a[31m bc"
    assert not {"\x1b", "\x00", "\u202e", "\n"} & set("".join(text for row in explained.rows for text in row))
    assert json.loads(json.dumps(explained.as_data()))["rows"][0] == {"label": "Group", "text": "main: Main / Haupt"}


def test_every_point_can_be_explained() -> None:
    for one in DEVICE.points:
        assert explain_point(DEVICE, one).rows
        assert explain_point(DEVICE, one, as_documented=True).rows


@pytest.mark.parametrize(
    ("name", "volts", "raw", "is_doubted"),
    [
        ("acceleration_time", None, 500, False),
        ("acceleration_time", None, 0, True),
        ("overvoltage_deceleration_level", "200V", 350, False),
        ("overvoltage_deceleration_level", "200V", 700, True),
        ("overvoltage_deceleration_level", "400V", 700, False),
    ],
)
def test_only_a_number_out_of_the_range_of_this_variant_is_doubted(
    name: str, volts: str | None, raw: int, is_doubted: bool
) -> None:
    device = shipped("hitachi_l200")
    wanted = [one for one in device.points if one.name == name and (one.variant and one.variant.value) == volts]
    rows = explain_point(device, wanted[0], raw=raw).rows
    assert ("Doubt" in dict(rows)) is is_doubted
