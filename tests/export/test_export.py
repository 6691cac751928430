"""The exported model: its schema, and single points held against expectations written by hand."""

from __future__ import annotations

import json
from dataclasses import replace
from fractions import Fraction
from functools import lru_cache
from pathlib import Path
from typing import Any

import fieldscribe
import pytest
from fieldscribe.export import export_model, schema_text
from fieldscribe.facts.point_values import bound_of, use_of, word_order_view
from fieldscribe.model import Factor, Flag, Limit, Point, Special
from jsonschema import Draft202012Validator
from support.described import described, loaded_in, made
from support.models import allowed, linear, point, sample_device, scaled, titles, value_of

DEVICE = sample_device()
SCHEMA: dict[str, Any] = json.loads((Path(fieldscribe.__file__).parent / "export/schema.json").read_text("utf-8"))
EXPECTED: dict[str, Any] = json.loads(Path(__file__).with_name("sample_drive.json").read_text("utf-8"))
"""What is written by hand of the exported sample; `base_frequency` has all keys of format 7.

Another key, or one less, is another format.
"""
TOP_KEYS = (
    *("format", "device", "version", "family", "vendor", "model", "title", "note", "documents", "variants", "limits"),
    *("groups", "points", "commands", "stepped_commands", "identifications", "given", "found", "bases"),
    *("messages", "telegrams", "frames", "codes", "errata"),
)


@lru_cache(maxsize=1)
def _model() -> dict[str, Any]:
    loaded: dict[str, Any] = json.loads(json.dumps(export_model(DEVICE)))
    return loaded


def _point(name: str) -> dict[str, Any]:
    found: dict[str, Any] = next(one for one in _model()["points"] if one["name"] == name)
    return found


def test_the_schema_is_valid_and_the_model_follows_it() -> None:
    Draft202012Validator.check_schema(SCHEMA)
    assert [error.message for error in Draft202012Validator(SCHEMA).iter_errors(_model())] == []


def test_the_committed_schema_is_current() -> None:
    """`make keys` writes it."""
    assert (Path(fieldscribe.__file__).parent / "export/schema.json").read_text("utf-8") == schema_text()


def test_the_schema_describes_every_key_and_refuses_others() -> None:
    def walk(node: Any) -> None:
        if isinstance(node, dict):
            if "properties" in node:
                assert node["additionalProperties"] is False
                assert sorted(node["required"]) == sorted(node["properties"])
                assert all(one.get("description") for one in node["properties"].values())
            for child in node.values():
                walk(child)
        elif isinstance(node, list):
            for child in node:
                walk(child)

    walk(SCHEMA)
    strange = {**_model(), "x_more": 1}
    assert list(Draft202012Validator(SCHEMA).iter_errors(strange))


def test_keys_are_those_of_the_schema_in_its_order() -> None:
    assert list(_model()) == list(TOP_KEYS) == list(SCHEMA["properties"])
    keys = list(SCHEMA["$defs"]["point"]["properties"])
    assert all(list(one) == keys for one in _model()["points"])
    assert set(keys) == set(EXPECTED["points"]["base_frequency"])


@pytest.mark.parametrize("name", EXPECTED["points"])
def test_a_point(name: str) -> None:
    """`base_frequency` with all its keys, and others with those that it has not."""
    expected, exported = EXPECTED["points"][name], _point(name)
    assert {key: exported[key] for key in expected} == expected


def test_documents_commands_and_frames() -> None:
    for key in ("documents", "commands", "frames"):
        assert _model()[key] == EXPECTED[key]


def test_names_of_numbers() -> None:
    keypad = {"name": "keypad", "title": {"en": "Keypad", "de": "Bedienfeld"}, "quantity": None}
    assert _point("frequency_source")["enum"]["0"] == keypad
    assert _point("analog_filter")["enum"]["17"]["quantity"] == "500 ms"


def test_no_value_and_a_span_of_special_codes() -> None:
    no_value = Special(0x8000, 0x8000, "no_value", titles("No value"), True)
    errors = Special(0xFF00, 0xFFFF, "error", titles("Error"), False)
    exported: Any = export_model(sample_device((point("level", 1, specials=(no_value, errors)),)))
    assert exported["points"][0]["special"] == [
        {"raw": [32768, 32768], "name": "no_value", "title": {"en": "No value"}, "no_value": True, "writable": False},
        {"raw": [65280, 65535], "name": "error", "title": {"en": "Error"}, "no_value": False, "writable": False},
    ]
    assert exported["format"] == 7
    assert not list(Draft202012Validator(SCHEMA).iter_errors(exported))


def test_scales_with_offset_factors_and_cases() -> None:
    assert _point("temperature")["scale"][0]["offset"] == "5/2"
    assert (_point("third")["scale"][0]["num"], _point("third")["scale"][0]["den"]) == ("3", "7")
    assert _point("power")["scale"][0]["uses"] == [{"point": "power_exponent", "part": "raw", "ten_to": -1}]
    assert [case["when"] for case in _point("setpoint")["scale"]] == [
        {"point": "unit_mode", "raw": 0},
        {"point": "unit_mode", "raw": 1},
    ]


def test_a_computed_end() -> None:
    assert _point("lower_limit")["raw"]["ranges"][0] == [
        "max(5, start_frequency.raw)",
        "4000 if upper_limit.raw == 0 else min(4000, upper_limit.raw)",
    ]


def test_variants_errata_limits_and_codes() -> None:
    variants = [one["variant"] for one in _model()["points"] if one["name"] == "dc_level"]
    assert variants == ["voltage_class=200V", "voltage_class=400V"]
    assert [one["point"] for one in _model()["errata"]] == ["base_frequency", "setpoint_display", None]
    assert _model()["limits"]["most"]["3"] == 4
    assert _model()["codes"]["exceptions"]["33"]["name"] == "value_out_of_range"


LINEAR = point("other", 1, "s16", scale=scaled(10, 5))
HALVED = point("other", 1, scale=scaled("1/2", "1/4"))
PLAIN, DOUBLED, FLOATING = point("other", 1), point("other", 1, scale=scaled("1/2", 0)), point("other", 1, "f32")


def use(part: str, kind: str, sign: int, **numbers: int) -> dict[str, object]:
    return {"point": "other", "part": part, **numbers, kind: sign}


@pytest.mark.parametrize(
    ("other", "factor", "constant", "uses"),
    [
        (LINEAR, value_of("other"), 1, [use("raw", "power", 1)]),
        (LINEAR, value_of("other", -1), 1, [use("raw", "power", -1)]),
        (LINEAR, value_of("other", slope=1, intercept=-5), 10, [use("value", "power", 1)]),
        (LINEAR, value_of("other", -1, slope=3, intercept=-15), Fraction(1, 30), [use("value", "power", -1)]),
        (LINEAR, value_of("other", -1, slope=4), Fraction(1, 4), [use("raw", "power", -1)]),
        (LINEAR, value_of("other", ten_to=True), 1, [use("raw", "ten_to", 1)]),
        (LINEAR, value_of("other", -1, slope=-1, ten_to=True), 1, [use("raw", "ten_to", 1)]),
        (LINEAR, value_of("other", intercept=3, ten_to=True), 1000, [use("raw", "ten_to", 1)]),
        (LINEAR, value_of("other", -1, intercept=3, ten_to=True), Fraction(1, 1000), [use("raw", "ten_to", -1)]),
        (LINEAR, value_of("other", slope=2, ten_to=True), 1, [use("raw", "ten_to", 1)] * 2),
        (DOUBLED, value_of("other", slope=2, intercept=1, ten_to=True), 10, [use("value", "ten_to", 1)]),
        (HALVED, value_of("other", slope=2, intercept=1, ten_to=True), 10, [use("raw", "ten_to", 1)] * 2),
        (
            point("other", 1, "s16", scale=scaled(-1)),
            value_of("other", slope=-1, ten_to=True),
            1,
            [use("raw", "ten_to", -1)],
        ),
        (FLOATING, value_of("other", -1), 1, [use("value", "power", -1)]),
        (PLAIN, value_of("other", intercept=5), 1, [use("raw", "power", 1, times=1, plus=5)]),
        (PLAIN, value_of("other", -1, slope=99, ten_to=True), 1, [use("raw", "ten_to", -1, times=99, plus=0)]),
        (PLAIN, value_of("other", intercept=2000, ten_to=True), 1, [use("raw", "ten_to", 1, times=1, plus=2000)]),
    ],
)
def test_factors_keep_their_meaning(
    other: Point, factor: Factor, constant: Fraction, uses: list[dict[str, object]]
) -> None:
    assert use_of(factor, other) == (constant, uses)


@pytest.mark.parametrize(("last", "listed"), [(4095, True), (4096, False)])
def test_a_long_list_of_numbers_is_exported_as_ranges_alone(last: int, listed: bool) -> None:
    """4096 numbers one by one, and no more."""
    numbers = allowed((0, last - 10), (60000, 60009), listed=True)
    exported: Any = export_model(sample_device((point("level", 1, allowed=numbers),)))
    raw = exported["points"][0]["raw"]
    assert raw["ranges"] == [[0, last - 10], [60000, 60009]]
    assert (raw["values"] or [])[-1:] == ([60009] if listed else [])
    assert len(raw["values"] or ()) == (4096 if listed else 0)


def test_only_a_single_bit_has_a_number_that_makes_it_true() -> None:
    flags = (Flag(0, 1, "low", titles("Low"), 0, ()), Flag(1, 3, "mode", titles("Mode"), 1, ()))
    exported: Any = export_model(sample_device((point("state", 1, flags=flags),)))
    low, mode = exported["points"][0]["flags"]
    assert low["values"] == {"0": {"name": "low", "title": {"en": "Low"}}}
    assert (mode["bits"], mode["values"]) == ([3, 1], {})


def test_an_erratum_names_its_points() -> None:
    several = replace(DEVICE.errata[0], points=("base_frequency", "ready"))
    exported: Any = export_model(replace(DEVICE, errata=(several,)))
    assert exported["errata"][0]["point"] == ["base_frequency", "ready"]


def test_the_limits_of_frames_are_empty_where_another_family_has_them() -> None:
    expected = {
        "framings": ["rtu", "tcp"],
        "units": [1, 32],
        "broadcast": 0,
        "most": {"1": 32, "3": 4, "5": 1, "6": 1, "15": 32, "16": 4},
        "gaps": {"holding": [[0x30, 0x8FF]]},
        "timing": {"silent_characters": "3.5"},
        "pad_coil_bytes": "even",
        "pzd": [0, 0],
    }
    assert {key: value for key, value in _model()["limits"].items() if value or key in expected} == expected
    of_can: Any = export_model(made("kitchen_can"))
    assert of_can["limits"]["pad_coil_bytes"] is None
    assert list(of_can["limits"]) == list(_model()["limits"])


def test_tasks_and_process_data_of_a_drive() -> None:
    """Of a drive over USS: what answers and what refuses a task, and which way a word travels."""
    exported: Any = export_model(made("kitchen_uss"))
    assert exported["codes"]["functions"]["2"] == {
        "name": "write_word",
        "title": {"en": "Write word"},
        "answers": [1],
        "refusals": [7, 8],
        "broadcast": None,
    }
    travels = {one["name"]: (one["telegram"], one["direction"]) for one in exported["points"] if one["telegram"]}
    assert travels["control_word"] == ("task", "request")
    assert travels["status_word"] == ("answer", "response")
    assert {one["direction"] for one in exported["points"] if one["name"] not in travels} == {None}


def test_the_layout_of_a_message() -> None:
    exported: Any = export_model(made("kitchen_can"))
    read = next(one for one in exported["messages"] if one["name"] == "read_request")
    head = ["name", "title", "direction", "answers", "identifier", "adds_unit", "layout", "length", "bits", "every"]
    assert list(read) == [*head, "source"]
    assert len(read["layout"]) == 8
    assert read["layout"][0] == {"holds": "constant", "number": 0xFF}


@pytest.mark.parametrize(("addresses", "order"), [([4, 5], None), ([5, 4], "low first"), ([6, 7, 4, 5], [2, 3, 0, 1])])
def test_the_order_of_words_counts_from_the_lowest(addresses: list[int], order: object) -> None:
    assert word_order_view({"addresses": addresses}) == order


def test_computed_ends_as_expressions() -> None:
    limited = point("limited", 1, "s16")
    rule = linear("10/4", "-1/2", value_of("a", slope=2, intercept=-1), value_of("b", -1))
    assert bound_of(Limit(rule, (), -32768, 32767), True, limited) == "(a.raw * 2 - 1) * 5 / b.raw / 2 - 1 / 2"
    power = linear(3, 0, value_of("c", -1, ten_to=True))
    assert bound_of(Limit(power, (), -32768, 100), False, limited) == "min(100, 3 / 10 ** c.raw)"
    moved = linear(1, "1/2", value_of("d", intercept=3), value_of("e", -1, intercept=-2, ten_to=True))
    assert bound_of(Limit(moved, (), -32768, 32767), True, limited) == "(d.raw + 3) / 10 ** (e.raw - 2) + 1 / 2"
    alone = linear("1/3", 4, value_of("f", -1, slope=5))
    assert bound_of(Limit(alone, (), -32768, 32767), True, limited) == "1 / (f.raw * 5) / 3 + 4"


@pytest.mark.parametrize(
    ("written", "values"),
    [("0, 1, 2, 5", [0, 1, 2, 5]), ("0, 1, b", None), ("0, 1, 5..7", None), ("0..7", None), ("0 | 5..7", None)],
)
def test_numbers_that_the_author_listed(written: str, values: list[int] | None, tmp_path: Path) -> None:
    """One by one, where they are numbers; else the intervals alone say them."""
    points = f"- {{name: a, at: 0, range: '{written}'}}\n- {{name: b, at: 1, range: 5..100}}\n"
    exported: Any = export_model(loaded_in(tmp_path, described(points)))
    assert exported["points"][0]["raw"]["values"] == values
