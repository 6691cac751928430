"""Special codes: raw numbers that are no quantity never look like one, in any language, page or answer."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.cli import main
from fieldscribe.conversation.meanings import Meanings
from fieldscribe.model import Device, Special
from fieldscribe.resources import render
from fieldscribe.targets import c, docs, python, rust
from support.described import DEVICES, kitchen_sink, loaded_in, made
from support.models import named
from support.python_package import error, imported, typed_findings, write_package

CODES = str(DEVICES / "kitchen_codes" / "device.yaml")


@lru_cache(maxsize=1)
def device() -> Device:
    """The made device that has a code of every form."""
    return made("kitchen_codes")


def codes_of(item: str) -> dict[str, tuple[int, int]]:
    """The codes of a point by name."""
    return {one.name: (one.low, one.high) for one in named(device(), item).specials}


def test_short_form_mapping_and_band() -> None:
    voltage = named(device(), "voltage")
    assert codes_of("voltage")["transducer_fault"] == (0xFFF4, 0xFFF4)
    assert codes_of("voltage")["reserved"] == (0xFFF8, 0xFFFF)
    assert voltage.special(0xFFFB) == Special(
        0xFFF8, 0xFFFF, "reserved", {"en": "Reserved"}, no_value=False, hexadecimal=True, shared=True
    )
    fitted = {one.name: one.no_value for one in named(device(), "level").specials}
    assert fitted == {"not_fitted": True, "transducer_fault": False, "out_of_order": False}


@pytest.mark.parametrize(
    ("item", "names", "of"),
    [
        ("current", {"reserved", "out_of_order"}, "measured_u16"),  # of the group by type, of the device
        ("voltage", {"transducer_fault", "reserved", "out_of_order"}, ""),  # and its own
        ("temperature", {"not_available", "out_of_order"}, "s16"),
        ("outside_temperature", {"sensor_open", "out_of_order"}, ""),  # took one away
        ("level", {"not_fitted", "transducer_fault", "out_of_order"}, "percent_u16"),
        ("second_level", {"not_fitted", "transducer_fault", "out_of_order"}, "percent_u16"),
        ("ratio", {"not_available", "fault", "below_range"}, "f32"),
        ("setpoint", {"released", "fault", "below_range"}, ""),  # its own name for a code of the type
        ("gear", {"unknown", "none"}, ""),  # bits of a word have their own codes alone
    ],
)
def test_codes_are_inherited_and_the_nearer_wins(item: str, names: set[str], of: str) -> None:
    assert set(codes_of(item)) == names
    assert named(device(), item).shared_codes == of


def test_signed_codes_as_patterns_and_as_numbers() -> None:
    """8000h of a signed word is the pattern that manuals print, as in `pairs`."""
    assert codes_of("temperature")["not_available"] == (-0x8000, -0x8000)
    assert codes_of("power")["reserved"] == (0x7FFFFFF0, 0x7FFFFFFF)
    assert codes_of("outside_temperature")["sensor_open"] == (-2000, -2000)


def test_ranges_leave_codes_out() -> None:
    def ranges(item: str) -> list[tuple[object, object]]:
        return [(one.low, one.high) for one in named(device(), item).allowed.intervals]

    assert ranges("delay") == [(1, 4999), (5001, 10000)]
    assert ranges("source") == [(1, 4), (6, 10)]
    assert ranges("offset") == [(-0x7FFF, 0x7FFD), (0x7FFF, 0x7FFF)]
    assert ranges("second_level") == [(0, 1000)]


def test_limits_of_others_do_not_apply_while_a_code_is_held() -> None:
    limit = named(device(), "lower_limit").allowed.intervals[0].high
    assert not isinstance(limit, int)
    assert limit.unless == (("upper_limit", ((0, 0), (0x7FFE, 0x7FFE))),)


# ---- What people read ----


def page() -> str:
    """The Markdown page."""
    return dict(docs.outputs(device(), render))["docs/kitchen_codes.md"]


def test_page_has_shared_codes_once_and_in_the_manuals_notation() -> None:
    text = page().replace("<wbr>", "")
    assert text.count("transducer_fault (Transducer fault)") == 1  # voltage alone has it as its own
    assert text.count("| 7FFEh | `out_of_order` |") == 4  # once a type, beside s32 and u64 in their widths
    assert "| 8000h | `not_available` | Not available / Nicht verfügbar | no value |" in text
    row = next(line for line in text.split("\n") if 'id="point-current"' in line)
    assert "[measured_u16](#codes-measured_u16)" in row
    assert "FFF8h" not in row
    row = next(line for line in text.split("\n") if 'id="point-upper_limit"' in line)
    assert "<br>default inactive |" in row
    assert "0 = inactive (Inactive / Inaktiv), may be written" in row


def run(capsys: Any, *words: str) -> tuple[int, str]:
    """Exit code, and what the command line says."""
    code = main(list(words))
    said = capsys.readouterr()
    return code, said.out + said.err


def test_explain_and_decode_name_codes(capsys: Any) -> None:
    assert "Raw 7FC00001h..7FC000FFh  fault (Fault)" in run(capsys, "explain", CODES, "ratio")[1]
    for item, raw, text in (
        ("voltage", 0xFFF4, "transducer_fault (Transducer fault)"),
        ("ratio", 0x7FC00000, "not_available (Not available), no value"),
        ("alarms", 0xFFFF, "reserved (Reserved)"),
        ("ages", 0xFFFF, "reserved (Reserved)"),
        ("gear", 14, "none (None), no value"),
    ):
        meaning = Meanings(device(), named(device(), item)).of(raw, {})
        assert (meaning.text, meaning.value) == (text, None)
    _, said = run(capsys, "decode", CODES, "01 04 02 FF F4 F9 47", "--request", "01 04 00 00 00 01 31 CA")
    assert "transducer_fault" in said
    assert "6552.4" not in said


@pytest.mark.parametrize(
    ("words", "code", "said"),
    [
        ("upper_limit 0", 1, "0 Hz would be 0, the special code `inactive`"),
        ("upper_limit inactive", 0, "raw 0 = 0000h"),
        ("upper_limit.raw 0", 0, "inactive (Inactive / Inaktiv)"),
        ("level 6553.3", 1, "would be FFFDh, the special code `not_fitted`"),
        ("level not_fitted", 1, "FFFDh is the special code `not_fitted` (Not fitted), which is only read"),
        ("lower_limit by_input", 2, "`by_input` is all of 4100..4103"),
        ("lower_limit.raw 4101", 0, "by_input (By input)"),
        ("lower_limit 10 --with upper_limit=inactive", 0, "raw 100"),
        ("lower_limit 10 --with upper_limit=0", 2, "the special code `inactive`"),
        ("mode unchanged", 0, "raw 0 = 0000h"),
        ("mode unknown", 1, "only read"),
        ("outputs not_set", 0, "raw 65535 = FFFFh"),
        ("input_delays not_set", 1, "only read"),
        ("control released", 0, "raw 0 = 0000h"),
        ("control start", 0, "raw 1025 = 0401h"),
        ("setpoint released", 0, "raw 2143289344 = 7FC00000h"),
        ("amplified 5 --with gain=10", 0, "amplified = 5"),
        ("amplified 5 --with gain=out_of_order", 1, "gain is zero or no quantity"),
        ("offset -32768", 1, "8000h, the special code `not_available`"),
    ],
)
def test_encode_takes_codes_by_name_only_where_they_may_be_written(
    capsys: Any, words: str, code: int, said: str
) -> None:
    found, text = run(capsys, "encode", CODES, *words.split())
    assert said in text
    assert found == code


def test_a_real_drive_is_switched_off_by_name(capsys: Any) -> None:
    """A061 = 0 of the L200 is no 0 Hz."""
    drive = str(DEVICES.parents[1] / "descriptions" / "hitachi_l200")
    assert "raw 0" in run(capsys, "encode", drive, "A061", "inactive")[1]
    found, text = run(capsys, "encode", drive, "A061", "0", "--with", "A062=inactive", "--with", "A004=50")
    assert (found, "special code `inactive`" in text) == (1, True)


# ---- Generated code ----


def test_c_has_shared_codes_once() -> None:
    header = dict(c.outputs(device(), render))["c/kitchen_codes.h"]
    assert header.count("kitchen_codes_measured_u16_is_special(uint16_t raw)") == 1
    assert header.count("#define KITCHEN_CODES_MEASURED_U16_RESERVED_FIRST 0xFFF8U") == 1
    assert "#define kitchen_codes_current_special_name kitchen_codes_measured_u16_special_name" in header


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The generated Python package."""
    write_package(kitchen_sink(), out := tmp_path_factory.mktemp("special"))
    return write_package(device(), out)


@pytest.fixture
def points(folder: Path) -> Iterator[Any]:
    """The points of the package as pure codecs."""
    for package in imported(folder, "kitchen_codes"):
        yield package.KitchenCodes


def test_python_gives_a_value_of_its_own_type(points: Any) -> None:
    fault = points.voltage.decode(0xFFF4)
    assert (str(fault), fault.raw, fault.no_value) == ("transducer_fault", 0xFFF4, False)
    assert not isinstance(fault, (int, float, str))
    assert f"it says {points.ratio.decode(0x7FC00000)}" == "it says not_available"
    assert points.ratio.decode(0x7FC00000).no_value
    for item in ("alarms", "ages", "state", "input_delays", "outputs"):
        assert type(getattr(points, item).decode(0xFFFF)).__name__ == "Special"
    assert error(points.voltage.decode_count, 0xFFF4).status == "special"
    assert points.voltage.told(0xFFF4) == "transducer_fault"


def test_python_writes_codes_only_where_they_may_be(points: Any) -> None:
    limit = points.upper_limit
    assert limit.encode(limit.special.inactive) == 0
    assert limit.encode(limit.special["inactive"]) == 0
    refused = error(limit.encode, 0.0)
    assert (refused.status, refused.special) == ("special", "inactive")
    assert error(limit.encode, limit.special.out_of_order).status == "special"
    assert error(points.delay.encode, limit.special.inactive).status == "unknown_value"
    assert points.lower_limit.encode(points.lower_limit.special(4102), {"upper_limit": 0}) == 4102
    assert "4100..4103" in str(error(getattr, points.lower_limit.special, "by_input"))
    assert error(points.level.encode, 6553.3).special == "not_fitted"


def test_nothing_is_computed_with_a_code_of_another_point(points: Any) -> None:
    refused = error(points.amplified.decode, 50, {"gain": 0x7FFE})
    assert (refused.status, "special code" in str(refused)) == ("zero_factor", True)
    assert points.amplified.decode(50, {"gain": 0x7FFD}) != 0


@pytest.mark.parametrize(
    ("item", "raw"),
    [
        ("temperature", 0x8000),
        ("voltage", -12),
        ("voltage", 0x1FFF4),
        ("gear", 0x2F),
        ("ratio", -1),
        ("alarms", 0x1FFFF),
    ],
)
def test_what_the_point_cannot_hold_is_no_quantity(points: Any, item: str, raw: int) -> None:
    """8000h of an s16 is -32768: taken for 32768 it would pass by the code `not_available` as 3276.8 degrees."""
    refused = error(getattr(points, item).decode, raw)
    assert (refused.status, "no raw number" in str(refused)) == ("out_of_range", True)
    if item not in {"ratio", "alarms"}:
        assert error(getattr(points, item).decode_count, raw).status == "out_of_range"


def test_refusals_say_how_a_code_is_written(points: Any) -> None:
    assert "write special.inactive" in str(error(points.upper_limit.encode, 0))
    assert "write special(4101)" in str(error(points.lower_limit.encode, 410.1, {"upper_limit": 0}))
    assert "as in special.inactive, not 'inactive'" in str(error(points.upper_limit.encode, "inactive"))


MISUSE = """
from typing import Literal, assert_type
from fieldscribe_runtime import Special
from kitchen_codes import KitchenCodes
from kitchen_codes.points import Points
from kitchen_sink.points import Points as Others

assert_type(Points.voltage.decode(1), float | Special[Literal["transducer_fault", "reserved", "out_of_order"]])
assert_type(Others.third.decode(1), float)
wrong: float = Points.voltage.decode(1)  # E: assignment


def read(device: KitchenCodes) -> None:
    many: float = device.read_many("measured")["voltage"]  # E: assignment


Points.upper_limit.encode(Points.upper_limit.special.inactive)
Points.level.encode(Points.upper_limit.special.inactive)  # E: arg-type
"""


@pytest.mark.full(seconds=4)
def test_mypy_does_not_let_a_code_pass_for_a_float(folder: Path, tmp_path: Path) -> None:
    assert typed_findings(MISUSE, folder, "kitchen_codes", tmp_path) == ""


def test_python_and_rust_have_shared_codes_once() -> None:
    text = dict(python.outputs(device(), render))["python/kitchen_codes/points.py"]
    assert text.count('"reserved": (0xFFF8, 0xFFFF)') == 3  # of the group; voltage and state have it beside their own
    files = dict(rust.outputs(device(), render))
    assert files["rust/kitchen_codes/src/special.rs"].count("0xFFF8") == 1
    assert "special::MeasuredU16::CODES" in files["rust/kitchen_codes/src/points.rs"]
    assert "=> reading f64 as scaled(10, 1);" in files["rust/kitchen_codes/src/points.rs"]


def test_a_point_without_codes_has_nothing_of_them() -> None:
    text = dict(python.outputs(kitchen_sink(), render))["python/kitchen_sink/points.py"]
    third = text[text.index("    third = ") :]
    assert "Codes" not in third[: third.index("    )")]
    header = dict(c.outputs(kitchen_sink(), render))["c/kitchen_sink.h"]
    assert "kitchen_sink_third_is_special" not in header


def test_what_stands_above_a_point_names_its_codes_and_which_may_be_written() -> None:
    for target, file, mark in (
        (c, "c/kitchen_codes.h", ""),
        (python, "python/kitchen_codes/points.py", ""),
        (rust, "rust/kitchen_codes/src/points.rs", "`"),
    ):
        said = " ".join(dict(target.outputs(device(), render))[file].replace(" * ", "").split())
        for sentence in (
            f"Special codes: {mark}0{mark} {mark}inactive{mark} (may be written), {mark}7FFEh{mark} {mark}out_",
            f"Special codes: {mark}Fh{mark} {mark}unknown{mark}, {mark}Eh{mark} {mark}none{mark}",
            f"Special code: {mark}7FF8000000000000h{mark} {mark}not_available{mark}",
        ):
            assert sentence in said, (file, sentence)


def test_a_code_within_an_inherited_band_takes_the_band_away_and_names_the_rest(tmp_path: Path) -> None:
    """All patterns of NaN are one code of the type, and one of them means something else at one point."""
    text = (DEVICES / "kitchen_codes" / "device.yaml").read_text(encoding="utf-8")
    mended = text.replace(
        "special: {7FC00000h: {name: released, writable: yes}}",
        "special: {7FC00000h: released, 7FC00001h..7FC000FFh: ~, 7FC00080h: other, 7FC00081h..7FC000FFh: fault}",
    )
    assert mended != text
    found = loaded_in(tmp_path, mended)
    codes = {one.name: (one.low, one.high) for one in named(found, "setpoint").specials}
    assert codes["other"] == (0x7FC00080, 0x7FC00080)
    assert codes["fault"] == (0x7FC00081, 0x7FC000FF)
