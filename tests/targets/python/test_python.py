"""The generated Python package as its users meet it: codecs on the class, reading and writing on a device."""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.model import Fixed, Flag
from support.models import entry, point, sample_device, titles, trip_device
from support.python_package import Slave, assert_formatted, imported, status, write_package


@pytest.fixture(scope="module")
def trips(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Any]:
    yield from imported(write_package(trip_device(), tmp_path_factory.mktemp("trips")), "trips")


@pytest.mark.full
@pytest.mark.parametrize("item", [one.item for one in trip_device().points])
def test_every_raw_survives_every_kind_of_rule(trips: Any, item: str) -> None:
    point_ = trips.Trips.POINTS[item]
    low, high = point_.raw_limits
    assert high - low == 65535
    encode, decode, encode_count, decode_count = (
        getattr(point_, name) for name in ("encode", "decode", "encode_count", "decode_count")
    )
    assert all(encode(decode(raw)) == raw for raw in range(low, high + 1))
    assert all(encode_count(decode_count(raw)) == raw for raw in range(low, high + 1))


@pytest.mark.parametrize(
    ("item", "value", "raws", "expected"),
    [
        ("base_frequency", 500.0, {}, ("out_of_range", "A020 base_frequency: 500 Hz is outside 0..400 Hz")),
        ("base_frequency", math.nan, {}, ("not_a_number", "A020 base_frequency: the value is NaN")),
        ("base_frequency", math.inf, {}, ("out_of_range", "A020 base_frequency: inf Hz is outside 0..400 Hz")),
        ("power_factor", 0.0, {}, ("out_of_range", "power_factor: 0 is outside -0.99..-0.7 or 0.7..1")),
        (
            "frequency_source",
            7,
            {},
            ("unknown_value", "A001 frequency_source: 7 is none of 0 keypad, 1 terminal, 10 logic"),
        ),
        (
            "upper_limit",
            5.0,
            {"lower_limit": 60},
            ("out_of_range", "upper_limit: 5 Hz is outside 6..400 Hz (set by lower_limit)"),
        ),
        (
            "upper_limit",
            5.0,
            {},
            ("missing_raw", "upper_limit: needs the raw number of lower_limit: pass raws={'lower_limit': ...}"),
        ),
        ("voltage_setpoint", 1.0, {"voltage_ratio": 0}, ("zero_factor", "voltage_setpoint: voltage_ratio is zero")),
        ("setpoint", 1.0, {"unit_mode": 3}, ("no_case", "setpoint: no scale for these raw numbers of unit_mode")),
        ("float_setpoint", 650.5, {}, ("out_of_range", "float_setpoint: 650.5 Hz is outside 0..650 Hz")),
        ("float_setpoint", 10**39, {}, ("out_of_range", f"float_setpoint: {10**39} Hz is outside 0..650 Hz")),
    ],
)
def test_errors_say_what_is_wrong(
    package: Any, item: str, value: float, raws: dict[str, int], expected: tuple[str, str]
) -> None:
    assert status(package.SampleDrive.POINTS[item].encode, value, raws) == expected


def test_unknown_numbers_survive(package: Any) -> None:
    drive = package.SampleDrive
    assert drive.frequency_source.decode(10) is package.FrequencySource.LOGIC
    assert drive.frequency_source.decode(77) == 77
    assert drive.status_word.decode(0xFF00) == 0xFF00
    assert drive.running.decode(1) is True
    assert str(drive.temperature.decode(0x7FFF)) == "no_sensor"
    assert status(drive.temperature.decode_count, 0x7FFF)[0] == "special"
    assert drive.frequency_source.name_of(1) == "terminal"
    assert drive.frequency_source.name_of(77) is None


def test_flags_are_shown_and_composed_by_meaning(tmp_path: Path) -> None:
    flags = (
        Flag(0, 1, "on", titles("On"), 1, (entry(0, "zero", "off"), entry(1, "one", "on"))),
        Flag(1, 1, "quick_stop", titles("Quick stop"), 0, (entry(0, "zero", "stop"), entry(1, "one", "no stop"))),
        Flag(2, 1, "off2", titles("off2"), 0, ()),
        Flag(3, 1, "class", titles("Class"), 1, ()),
        Flag(4, 2, "set", titles("Set"), 1, (entry(1, "second"),)),
        Flag(6, 2, "of", titles("Of"), 1, ()),
        Flag(10, 1, "valid", titles("Valid"), 1, ()),
    )
    points = (
        point("command", 1, flags=flags, fixed=Fixed(0x0C00, 0x0400)),
        point("status", 2, access="r", flags=flags),
    )
    folder = write_package(replace(sample_device(points), errata=(), blocks={}, id="flagged"), tmp_path)
    text = (folder / "flagged" / "enums.py").read_text("utf-8")
    assert '"""Quick stop (0: stop; 1: no stop). True while the bit is 0."""' in text
    assert '"""off2. True while the bit is 0."""' in text
    assert text.count("def of(") == 1  # nobody makes a word that is only read
    for package in imported(folder, "flagged"):
        word = package.Command
        assert word.of() == 0x0406
        assert word.of(on=True, class_=True, set=package.CommandSet.SECOND, of_=2) == 0x0406 | 0x0001 | 0x0008 | 0x90
        assert word.of(quick_stop=True) == 0x0404
        assert str(word.of(on=True, off2=True)) == "0x0403 (on, off2, set=0, of_=0, valid)"
        assert repr(word(0x0416)) == "<Command 0x0416 (set=second, of_=0, valid)>"
        assert repr(package.Status(0)) == "<Status 0x0000 (quick_stop, off2, set=0, of_=0)>"
        assert f"{word(0x0406):04X} {word(6)}" == "0406 0x0006 (set=0, of_=0)"
        assert package.Flagged.command.encode(word.of(on=True)) == 0x0407
        assert status(package.Flagged.command.encode, package.Status(1))[0] == "unknown_value"
        with pytest.raises(ValueError, match="2 bits"):
            word.of(set=4)
    assert_formatted(folder / "flagged")


def test_points_that_are_only_documented_have_an_address(tmp_path: Path) -> None:
    unsettled: dict[str, Any] = {"generated": False, "reason": "the manual does not settle its type"}
    points = (
        point("known", 1),
        point("ramp", 0x1980, code="P102", **unsettled),
        point("wide", 0x2000, "u32", **unsettled),
        point("reserved", 0x3000, generated=False, reserved=True, reason="reserved by the maker"),
        point("nowhere", None),
    )
    folder = write_package(replace(sample_device(points), errata=(), blocks={}, id="open_ends"), tmp_path)
    for package in imported(folder, "open_ends"):
        lines = sys.modules["open_ends.points"].Points.__doc__.splitlines()
        assert [line.strip() for line in lines if "- " in line] == [
            "- P102 ramp: 'holding', 0x1980",
            "- wide: 'holding', 0x2000, 0x2001",
        ]
        assert any("`read_at` and `write_at`" in line for line in lines)
        assert package.OpenEnds(Slave(), unit=1).read_at("holding", 0x1980) == (0,)
    assert_formatted(folder / "open_ends")


def test_points_may_be_called_like_steps(tmp_path: Path) -> None:
    names = ("get_steps", "put_steps", "read_steps", "taken", "run", "handle", "command", "require", "ask")
    points = tuple(point(name, number) for number, name in enumerate(names, 1))
    folder = write_package(replace(sample_device(points), errata=(), blocks={}, commands=(), id="odd_names"), tmp_path)
    slave = Slave()
    for package in imported(folder, "odd_names"):
        drive = package.OddNames(slave, unit=1)
        for number, name in enumerate(names, 1):
            getattr(drive, name).write(number)
        assert drive.read_many("main") == {name: number for number, name in enumerate(names, 1)}
        own = {name for name in dir(drive) if not name.startswith("_") and name.islower()} - set(names)
        assert own == {
            *(
                "find_blocks",
                "set_base",
                "forget",
                "identify",
                "layouts",
                "point",
                "read_at",
                "read_many",
                "retries",
                "retry_pause",
                "rows",
            ),
            *("traffic", "transport", "unit", "variants", "write_at", "write_together"),
        }


def test_read_and_write(drive: Any, slave: Slave) -> None:
    slave.words[0x1028] = 500
    assert drive.base_frequency.read() == 50.0
    drive.base_frequency.write(60.0)
    drive.run_command.write(True)
    drive.acceleration_time.write(1000.0)
    assert (slave.words[0x1028], slave.coils[0]) == (600, 1)
    assert (slave.words[0x1013], slave.words[0x1014]) == (100000 >> 16, 100000 & 0xFFFF)
    assert [entry[0] for entry in slave.log] == [3, 6, 5, 16]
    drive.base_frequency.write_raw(601)
    assert drive.base_frequency.read_raw() == 601
    assert status(drive.base_frequency.write_raw, 4001)[0] == "out_of_range"
    assert status(drive.base_frequency.write, 400.06)[0] == "out_of_range"


def test_variants(package: Any, drive: Any, slave: Slave) -> None:
    assert drive.dc_level.encode(700) == 700
    assert status(drive.dc_level.encode, 350)[0] == "out_of_range"
    assert package.SampleDrive.dc_level_200v.encode(350) == 350
    assert package.SampleDrive.dc_level.points["400V"].encode(700) == 700
    assert status(lambda: drive.dc_level_200v) == ("no_access", "b131 dc_level_200v exists only for voltage_class 200V")
    unsaid = package.SampleDrive(slave, unit=1)
    assert status(lambda: unsaid.dc_level)[0] == "no_access"
    unsaid.dc_level_200v.write(350)
    assert slave.words[0x10F5] == 350


def test_read_many(drive: Any, slave: Slave, caplog: pytest.LogCaptureFixture) -> None:
    slave.words.update({0x2007: 400, 0x2008: 230, 0x200A: 5, 0x2009: 2, 0x2010: 1})
    values = drive.read_many(["voltage_setpoint", drive.power, type(drive).status_word, "dc_level"])
    assert values == {"voltage_setpoint": 230.0, "power": 500.0, "status_word": 1, "dc_level": 0}
    assert slave.log == [(3, 0x10F5, 1), (3, 0x2007, 4), (3, 0x2010, 1)]
    slave.log.clear()
    slave.words[0x200D] = 50  # the setpoint is divided by it
    everything = drive.read_many("main")
    assert len(everything) == len({one.name for one in sample_device().points if one.generated and one.readable})
    assert all(count <= (32 if function == 1 else 4) for function, _, count in slave.log)
    assert status(drive.read_many, "no_such_group")[0] == "no_access"
    assert drive.read_many("main", errors="return") == everything
    slave.words[0x2009] = 200  # an exponent that no float holds
    assert status(drive.read_many, ["power", "dc_level"])[0] == "overflow"
    kept = drive.read_many(["power", "dc_level"], errors="return")
    assert (kept["power"].status, kept["dc_level"]) == ("overflow", 0)
    assert status(partial(drive.read_many, "main", errors="ignore"))[0] == "bad_errors"
    other = type(drive)(slave, unit=drive.unit)
    refused = status(drive.read_many, [other.power])
    assert refused[0] == "no_access"
    assert "is a point of another device" in refused[1]
    slave.refuses = {0x2007: 2}
    assert drive.read_many(["voltage_ratio", "power"], errors="return")["voltage_ratio"].code == 2
    (message,) = caplog.messages  # of the point, not of its block
    assert message.endswith("exception 02h (illegal_data_address) (voltage_ratio)")


REFUSED = [  # the point that is refused, the exception, and what a later round requests
    ("power", 2, [(0x2007, 3), (0x2010, 1)]),
    ("power_exponent", 3, [(0x2007, 2), (0x200A, 1), (0x2010, 1)]),
    ("power", 4, [(0x2007, 4), (0x2008, 1), (0x200A, 1), (0x2007, 1), (0x2009, 1), (0x2010, 1)]),
]


@pytest.mark.parametrize(("name", "code", "later"), REFUSED)
def test_a_refused_point_costs_no_group(
    drive: Any, slave: Slave, name: str, code: int, later: list[tuple[int, int]]
) -> None:
    wanted, at = ["voltage_setpoint", "power", "status_word", "zzz", "absent"], drive.point(name).facts.at.address
    slave.words.update({0x2007: 400, 0x2008: 230})
    slave.refuses[at] = code
    for _ in range(2):
        slave.log.clear()
        values = drive.read_many(wanted, errors="return")
        assert [one for one in wanted if isinstance(values[one], Exception)] == ["power", "zzz", "absent"]
        assert (values["power"].code, values["power"].point, values["voltage_setpoint"]) == (code, "power", 230.0)
    assert [(address, count) for _, address, count in slave.log] == later
    slave.refuses.clear()
    drive.point(name).read()
    assert drive.read_many(wanted[:3], errors="return")["power"] == 0
    slave.refuses[at] = code
    drive.read_many(wanted, errors="return")
    drive.forget()
    slave.refuses = {at: 0x0B}  # a gateway whose unit does not answer
    assert status(partial(drive.read_many, wanted, errors="return"))[0] == "exception"
    slave.refuses = {0x2008: 2}  # between the points of a read
    for _ in range(2):
        slave.log.clear()
        assert drive.read_many(["voltage_ratio", "power"], errors="return")["power"] == 0
    assert [(address, count) for _, address, count in slave.log] == [(0x2007, 1), (0x2009, 2)]


def test_what_is_documented_only_is_said_once(package: Any, folder: Path) -> None:
    text = (folder / "sample_drive" / "points.py").read_text("utf-8")
    for name in package.SampleDrive.DOCUMENTED:
        assert text.count(f'"{name}": Documented(') == 1
        assert f"# {name}" not in text
