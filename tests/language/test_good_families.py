"""The kitchens of the families can and uss, and rows that stand for several points: against expectations by hand."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import pytest
from fieldscribe.conversation.lookup import find
from fieldscribe.export import export_model
from fieldscribe.families.can import identifier_of
from fieldscribe.families.uss import of_bus, of_frame
from fieldscribe.model import Device, Factor, Fixed, Limit, Linear, Point, Role, ScaleCase, Text
from fieldscribe.wording import default_text
from support.described import compile_in, group, head, made, together


def point(name: str, item: str) -> Point:
    """A point of a kitchen by its item name."""
    return next(one for one in made(name).points if one.item == item)


def described_so(tmp_path: Path, points: str, **said: str) -> Device:
    """A Modbus device whose group says that, and has these points; it has no findings."""
    device, findings = compile_in(tmp_path, together(head(), group(points, **said)))
    assert findings == ()
    assert device is not None
    return device


BY_SETS = "number * 64 + (index - 1) * sets + (set - 1)"
NORD = """\
- {name: alone, at: 601}
- {name: by_set, title: {en: Ramp, de: Rampe}, at: 102, sets: 4, was: [ramp]}
- {name: by_index, at: 607, indices: 2, each: {2: {code: P607b, title: Second, default: 5}}}
- {name: by_both, at: 543, sets: 4, indices: 3, each: {2: {line: 5}, 4/2: {line: 7}}}
- {name: one_element, at: 50, index: 3}
- {name: one_set, at: 103, sets: 4, set: 2, indices: 2}
- {name: from_zero, at: 7, indices: 1..2}
"""


@pytest.mark.parametrize(
    ("item", "address", "number_of_set", "index"),
    [
        ("alone", 601 * 64, None, None),
        ("by_set_set_1", 102 * 64, 1, None),
        ("by_set_set_4", 102 * 64 + 3, 4, None),
        ("by_index_index_2", 607 * 64 + 1, None, 2),
        ("by_both_set_1_index_1", 0x87C0, 1, 1),
        ("by_both_set_2_index_1", 0x87C1, 2, 1),
        ("by_both_set_1_index_2", 0x87C4, 1, 2),
        ("by_both_set_4_index_3", 543 * 64 + 2 * 4 + 3, 4, 3),
        ("one_element", 50 * 64 + 2, None, 3),
        ("one_set_index_2", 103 * 64 + 4 + 1, 2, 2),
        ("from_zero_index_1", 7 * 64, None, 1),
    ],
)
def test_addresses_by_rule(
    tmp_path: Path, item: str, address: int, number_of_set: int | None, index: int | None
) -> None:
    """The four cases of a drive with parameter sets and arrays."""
    found = next(one for one in described_so(tmp_path, NORD, addressing=BY_SETS).points if one.item == item)
    assert (found.address, found.set, found.index) == (address, number_of_set, index)


def test_elements_differ_where_each_says_so(tmp_path: Path) -> None:
    """By index, by set and index; titles, codes and old names say which element it is."""
    points = {one.item: one for one in described_so(tmp_path, NORD, addressing=BY_SETS).points}
    assert len(points) == 1 + 4 + 2 + 12 + 1 + 2 + 2
    assert points["by_index_index_2"].code == "P607b"
    assert points["by_index_index_2"].title == {"en": "Second"}
    assert points["by_index_index_2"].default == 5
    assert points["by_index_index_1"].default is None
    assert points["by_set_set_3"].title == {"en": "Ramp (set 3)", "de": "Rampe (3. Parametersatz)"}
    assert points["by_set_set_3"].was == ("ramp_set_3",)
    assert points["by_both_set_1_index_2"].title == {"en": "By both (set 1, index 2)"}
    lines = [points[f"by_both_set_{one}_index_2"].source.line for one in (1, 2, 4)]
    assert lines == [5, 5, 7]


def test_an_enum_belongs_to_its_row_or_to_the_element_that_states_it(tmp_path: Path) -> None:
    """An element may be named by its set and by both numbers at once: the enum is its own if either states one."""
    each = "{1: {default: 0}, 2: {default: 0}, 2/1: {enum: {0: wait}}, 3/1: {enum: {0: off}}}"
    rows = f"- {{name: mode, at: 10, enum: {{0: stop}}, sets: 3, indices: 2, each: {each}}}\n"
    points = described_so(tmp_path, rows, addressing=BY_SETS).points
    alone = ("mode_set_2_index_1", "mode_set_3_index_1")
    assert [one.enum_names for one in points] == [(one.item if one.item in alone else "mode",) for one in points]


def test_a_rule_is_about_each_number_under_at(tmp_path: Path) -> None:
    """Also in records, in texts whose words run down, and in sets that have rows of their own."""
    rows = """\
- {name: label, at: 7..4, type: text, characters: 8}
- {name: trip, record: log, at: 10h}
- {name: ramp, at: 20h, set: 2, sets: {1: {at: 30h}, 3: {at: 30h, index: 5}}}
records: {log: {points: [{name: error, at: base + 2}]}}
"""
    device = described_so(tmp_path, rows, addressing="1000h + number + (index - 1)")
    found = {one.name: (one.addresses, one.set, one.index) for one in device.points}
    assert found == {
        "label": ((0x1007, 0x1006, 0x1005, 0x1004), None, None),
        "trip_error": ((0x1012,), None, None),
        "ramp": ((0x1020,), 2, None),
        "ramp_set_1": ((0x1030,), 1, None),
        "ramp_set_3": ((0x1034,), 3, 5),
    }


def test_defaults_are_raw_named_or_in_units(tmp_path: Path) -> None:
    """Each follows from the other where no other point is needed; the nearer layer decides which of both is said."""
    rows = """\
- {name: first, at: 1, scale: value = raw * 0.1, default: 0200h}
- {name: in_units, at: 2, scale: value = raw * 0.1, default_in_units: 51.2}
- {name: named, at: 3, scale: value = raw * 0.1, special: {7FFFh: idle}, default: idle}
- {name: entry, at: 4, enum: {3: on}, default: "on"}
- {name: moving_raw, at: 5, scale: value = raw * first.raw, default: 4}
- {name: moving_value, at: 6, scale: value = raw * first.raw, default_in_units: 4}
- {name: real, at: 7, type: f32, default_in_units: 0.5}
- name: ramp
  at: 9
  scale: value = raw * 0.1
  default: 5
  sets: {2: {at: 10, default_in_units: 0.7}, 3: {at: 11}}
"""
    found = {one.name: (one.default, one.default_raw, default_text(one)) for one in described_so(tmp_path, rows).points}
    assert found == {
        "first": (Fraction("51.2"), 512, "51.2"),
        "in_units": (Fraction("51.2"), 512, "51.2"),
        "named": (Fraction("3276.7"), 0x7FFF, "idle"),
        "entry": (3, 3, "3"),
        "moving_raw": (None, 4, "raw 4"),
        "moving_value": (4, None, "4"),
        "real": (Fraction(1, 2), None, "0.5"),
        "ramp": (Fraction(1, 2), 5, "0.5"),
        "ramp_set_2": (Fraction("0.7"), 7, "0.7"),
        "ramp_set_3": (Fraction(1, 2), 5, "0.5"),
    }


def test_pairs_of_low_first_words_are_printed_by_their_first_word(tmp_path: Path) -> None:
    """`wire` is the address that a request names; `high_wire` is that of the word behind it."""
    row = "- {name: a, at: 77h, type: f32, words: low first, printed: {wire: 0x77, low_wire: 0x77, high_wire: 0x78}}\n"
    assert described_so(tmp_path, row).points[0].addresses == (0x78, 0x77)


def test_an_unsettled_type_is_documented_only() -> None:
    """And the export has no type."""
    found = point("kitchen_can", "unclear")
    assert (found.generated, found.reason) == (False, "the manual does not settle its type")
    exported = export_model(made("kitchen_can"))["points"]
    assert isinstance(exported, list)
    assert next(one for one in exported if one["name"] == "unclear")["type"] is None


@pytest.mark.parametrize(
    ("item", "addresses", "text"),
    [
        ("fault_text_1", tuple(range(739, 731, -1)), Text(16, "ascii")),
        ("fault_text_2", (740, 741, 742), Text(6, "latin-1")),
        ("display", (13,), Text(2, "ascii")),
    ],
)
def test_texts(item: str, addresses: tuple[int, ...], text: Text) -> None:
    """Words in reading order."""
    found = point("kitchen_can", item)
    assert (found.form, found.addresses, found.text) == ("text", addresses, text)


def test_digits() -> None:
    """The range is from all lowest to all highest digits."""
    found = point("kitchen_can", "input_delays")
    assert found.digits is not None
    assert (found.form, found.digits.count, found.digits.enum.name) == ("digits", 4, "input_delay")
    assert [(one.low, one.high) for one in found.allowed.intervals] == [(0, 5555)]
    assert {"input_delay", "input_classes"} <= {one.name for one in made("kitchen_can").enums}


@pytest.mark.parametrize(
    ("device", "item", "fixed"),
    [
        ("kitchen_can", "slow_ramp", Fixed(0xF1, 0x01)),
        ("kitchen_can", "command_word", Fixed(0x40F, 0x406)),
        ("kitchen_can", "command_number", Fixed(0x8000, 0x8000)),
        ("kitchen_uss", "control_word", Fixed(0x400, 0x400)),
        ("kitchen_uss", "jog_choice", Fixed(0xFF00, 0)),
        ("kitchen_uss", "status_word", None),
    ],
)
def test_fixed_bits(device: str, item: str, fixed: Fixed | None) -> None:
    """In bits of the word, also where the point takes only some of them."""
    assert point(device, item).fixed == fixed


def test_flags_of_a_bit_group_count_from_its_lowest_bit() -> None:
    """The description numbers them by the word."""
    flags = [(one.name, one.low, one.width) for one in point("kitchen_can", "relay_flags").flags]
    assert flags == [("horn", 3, 1), ("mode", 0, 2), ("lamp", 2, 1)]
    target = next(one for one in point("kitchen_can", "command_word").flags if one.name == "target")
    assert [(one.raw, one.name) for one in target.values] == [(0, "off"), (3, "on")]


def test_errata_about_flags() -> None:
    """They reach the point, and say which flag."""
    assert point("kitchen_can", "relay_flags").errata == ("relay_horn",)
    assert next(one.where for one in made("kitchen_can").errata if one.id == "relay_horn") == "the flag horn"


def test_limits_in_units_beside_a_factor() -> None:
    """25..125 V become limits in raw numbers by the rule."""
    factor = Factor("transformer_secondary", 1, 0, 1, False)
    [interval] = point("kitchen_can", "voltage_setpoint_100v").allowed.intervals
    assert isinstance(interval.high, Limit)
    assert interval.high.rule == Linear(Fraction(125, 400), Fraction(0), (factor,))
    [interval] = point("kitchen_can", "voltage_limit").allowed.intervals
    assert isinstance(interval.low, Limit)
    assert interval.low.rule == Linear(Fraction(20, 400), Fraction(0), (factor,))
    assert point("kitchen_can", "transformer_secondary").changes_with == ("transformer_choice",)


@pytest.mark.parametrize(
    ("item", "addresses", "references", "access"),
    [
        ("frequency", (0,), {"nr": 1, "mux": 0, "word": 1}, "r"),
        ("operating_hours", (5, 6), {"nr": 6, "mux": 1, "word": 3}, "r"),
        ("power_exponent", (2,), {"nr": 3, "mux": 0, "word": 3}, "r"),
        ("nothing", (), {}, "r"),
    ],
)
def test_words_of_a_telegram(item: str, addresses: tuple[int, ...], references: dict[str, int], access: str) -> None:
    """Multiplexer and word follow from the message; what the device sends is read only."""
    found = point("kitchen_can", item)
    assert (found.telegram, found.addresses, found.access) == ("measurements", addresses, access)
    assert found.references == references


def test_messages() -> None:
    """The role of each byte."""
    messages = {one.name: one for one in made("kitchen_can").messages}
    read = messages["read_request"]
    assert (read.identifier, read.adds_unit, read.direction, read.answers) == (0x33F, False, "request", None)
    assert read.roles == (
        *(Role("constant", 0xFF), Role("unit", 0), Role("address", 8), Role("address", 0)),
        *(Role("constant", 0), Role("constant", 0), Role("xor", 0b010101), Role("xor", 0b101010)),
    )
    answer = messages["write_answer"]
    assert (answer.identifier, answer.adds_unit, answer.answers) == (0x320, True, "write_request")
    assert answer.roles[4:6] == (Role("raw", 8), Role("raw", 0))
    values = messages["measurements"]
    assert values.roles[1:] == (Role("multiplexer", 0), *(Role("word", number) for number in range(6)))
    assert values.words == 3
    telegram = made("kitchen_can").telegrams[0]
    assert (telegram.name, telegram.words, telegram.message, telegram.direction) == (
        "measurements",
        16,
        "measurements",
        "cyclic",
    )


def test_can_frames() -> None:
    """Their meaning, and a checksum put right."""
    frames = {one.name: one for one in made("kitchen_can").frames}
    assert frames["read_voltage_answer"].meaning == {"transformer_secondary": 400}
    assert frames["first_words"].meaning == {"frequency": 5000, "power_exponent": -1, "voltage_exponent": 2}
    wrong = frames["write_limit_answer"]
    assert (wrong.valid, wrong.corrected.hex(), identifier_of(wrong)) == (False, "ee05000b2d00c30e", 0x325)


@pytest.mark.parametrize(
    ("item", "addresses", "index", "words"),
    [
        ("command_source", (700,), None, 1),
        ("maximum_frequency", (1082,), None, 2),
        ("baud_rate_index_0", (2010,), 0, 1),
        ("answer_source_index_3", (2016,), 3, 2),
        ("normalisation_rs232", (2009,), 1, 1),
        ("main_setpoint", (1,), None, 1),
        ("total_energy", (2, 3), None, 2),
    ],
)
def test_uss_parameters_have_one_address(item: str, addresses: tuple[int, ...], index: int | None, words: int) -> None:
    """Whatever their width; the index lies beside it."""
    found = point("kitchen_uss", item)
    assert (found.addresses, found.index, found.words) == (addresses, index, words)


def test_a_floating_point_factor() -> None:
    """Its value enters; a point that differs by variant only in its place is named without the variant."""
    reference = Factor("reference_frequency", 1, 0, -1, False)
    assert point("kitchen_uss", "main_setpoint").scale == (
        ScaleCase("normalisation", 0, Linear(Fraction(0x4000), Fraction(0), (reference,))),
        ScaleCase("normalisation", 1, Linear(Fraction(100), Fraction(0), ())),
    )
    assert point("kitchen_uss", "main_setpoint").decimals == 5


def test_uss_frames() -> None:
    """Parameter parts, process data, broadcasts and whole telegrams, with what other points hold."""
    frames = {one.name: one for one in made("kitchen_uss").frames}
    assert {one.framing for one in frames.values()} == {"pkw", "pzd", "broadcast", "uss"}
    assert frames["read_maximum_answer"].meaning == {"maximum_frequency": 0x42480000}
    assert frames["read_baud_rate_answer"].meaning == {"baud_rate_index_1": 6}
    assert frames["run_40"].meaning == {"control_word": 0x47F, "main_setpoint": 0x3333}
    assert [of_frame(frames[name]).pkw for name in ("read_700", "write_fixed", "run_40", "no_parameter")] == [
        127,
        4,
        None,
        0,
    ]
    wrong = frames["whole_answer"]
    assert (wrong.valid, wrong.corrected[-1]) == (False, 0x6A)


def test_uss_codes() -> None:
    """Tasks, responses and errors name each other."""
    bus = made("kitchen_uss").bus
    tasks = {one.number: one for one in bus.functions}
    assert (tasks[1].answers, tasks[1].refusals, tasks[4].answers) == ((1, 2), (7,), (3,))
    assert next(one for one in bus.codes("responses") if one.number == 7).answers == (
        1,
        2,
        3,
        4,
        6,
        7,
        8,
        11,
        12,
        13,
        14,
    )
    assert (of_bus(bus).pkw, of_bus(bus).pzd, bus.units, bus.broadcast) == ((0, 3, 4, 127), (0, 4), (0, 31), 32)


def test_places_of_uss_parameters_in_the_export() -> None:
    """One for each task that reads or writes them."""
    exported = export_model(made("kitchen_uss"))["points"]
    assert isinstance(exported, list)
    places = {one["name"]: [(two["for"], two["function"]) for two in one["places"]] for one in exported}
    assert places["command_source"] == [("read", 1), ("ram", 2), ("write", 14)]
    assert places["maximum_frequency"] == [("read", 1), ("ram", 3), ("write", 13)]
    assert places["answer_source_index_0"] == [("read", 1), ("ram", 8), ("write", 11)]
    assert places["baud_rate_index_1"] == [("read", 1), ("ram", 7), ("write", 12)]
    assert places["reaction"] == [("read", 1), ("ram", 2)]
    assert places["drive_status"] == [("read", 1)]
    assert places["control_word"] == [("write", None)]
    repeats = {one["name"]: one["repeat"] for one in exported}
    assert (repeats["baud_rate_index_1"], repeats["command_source"]) == ("baud_rate", None)


@pytest.mark.parametrize(
    ("device", "what", "items"),
    [
        ("kitchen_can", "507", ["transformer_secondary"]),
        ("kitchen_can", "nr:6", ["operating_hours"]),
        ("kitchen_can", "mux:0", ["frequency", "power", "power_exponent", "voltage_exponent"]),
        ("kitchen_can", "735", ["fault_text_1"]),
        ("kitchen_uss", "P2010", ["baud_rate_index_0", "baud_rate_index_1"]),
        ("kitchen_uss", "1082", ["maximum_frequency"]),
    ],
)
def test_points_are_found(device: str, what: str, items: list[str]) -> None:
    """By address, index and printed number."""
    found = dict.fromkeys(match.point.item for match in find(made(device), what))
    assert list(found) == items


def test_the_nearer_word_about_keeping_holds(tmp_path: Path) -> None:
    """Whether it is yes or no, or the name of a command."""
    rows = """\
- {name: by_command, at: 1, keep_with: enter}
- {name: by_itself, at: 2}
commands:
- {name: enter, at: 25, function: 06h, value: any}
"""
    assert [one.keeps for one in described_so(tmp_path, rows, keeps="yes").points] == ["enter", "yes"]
    rows = rows.replace("at: 1, keep_with: enter", "at: 1, keeps: no")
    assert [one.keeps for one in described_so(tmp_path, rows, keep_with="enter").points] == ["no", "enter"]
