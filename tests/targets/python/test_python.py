"""The generated Python package as its users meet it: codecs on the class, reading and writing on a device."""

from __future__ import annotations

import ast
import asyncio
import importlib
import inspect
import math
import pydoc
import subprocess
import sys
from dataclasses import replace
from decimal import Decimal
from functools import partial
from typing import TYPE_CHECKING, Any

import pytest
from fieldscribe.model import Fixed, Flag, Place
from fieldscribe.resources import templates_dir
from fieldscribe.targets import python as target
from fieldscribe.targets.python.identifiers import DEVICE_MEMBERS, HELPERS, WORD_MEMBERS
from fieldscribe.targets.python.namespaces import LIBRARIES
from support.models import HERTZ, STATUS_FLAGS, changed, entry, plain_points, point, sample_device, titles, trip_device
from support.python_families import AsyncCanUnit, AsyncUssDrive, CanUnit, UssDrive
from support.python_package import AsyncSlave, Slave, error, imported, typed_findings, write_package

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_package(sample_device(), tmp_path_factory.mktemp("python"))


@pytest.fixture(scope="module")
def package(folder: Path) -> Iterator[Any]:
    yield from imported(folder, "sample_drive")


@pytest.fixture
def slave() -> Slave:
    return Slave()


@pytest.fixture
def drive(package: Any, slave: Slave) -> Any:
    return package.SampleDrive(slave, unit=5, voltage_class="400V")


def status(function: Any, *arguments: Any) -> tuple[str, str]:
    """The status and message of the error that a call raises."""
    try:
        function(*arguments)
    except Exception as error:
        return getattr(error, "status", ""), str(error)
    return "ok", ""


def test_class_is_a_codec(package: Any) -> None:
    point_ = package.SampleDrive.base_frequency
    assert (point_.encode(50.0), point_.decode(500), point_.encode_count(500), point_.decode_count(500)) == (
        500,
        50.0,
        500,
        500,
    )
    assert (point_.facts.code, point_.facts.unit, point_.facts.at.addresses, point_.facts.default) == (
        "A020",
        "Hz",
        (0x1028,),
        50,
    )
    point_.check(4000)


@pytest.fixture(scope="module")
def trips(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Any]:
    yield from imported(write_package(trip_device(), tmp_path_factory.mktemp("trips")), "trips")


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
        (
            "setpoint",
            1.0,
            {"unit_mode": 3},
            ("no_case", "setpoint: no scale for these raw numbers of unit_mode"),
        ),
        ("float_setpoint", 650.5, {}, ("out_of_range", "float_setpoint: 650.5 Hz is outside 0..650 Hz")),
    ],
)
def test_errors_say_what_is_wrong(
    package: Any, item: str, value: float, raws: dict[str, int], expected: tuple[str, str]
) -> None:
    assert status(package.SampleDrive.POINTS[item].encode, value, raws) == expected


def test_values_of_the_wrong_type_are_refused_by_name(package: Any) -> None:
    for item, label in (
        ("base_frequency", "A020 base_frequency"),
        ("float_setpoint", "float_setpoint"),
        ("frequency_source", "A001 frequency_source"),
        ("voltage_ratio", "voltage_ratio"),
        ("run_command", "run_command"),
    ):
        for value in (None, "40", b"", [1]):
            found, text = status(package.SampleDrive.POINTS[item].encode, value)
            assert (found, text.partition(":")[0]) == ("wrong_type", label), (item, value)
        if item != "run_command":
            taken = "FrequencySource.TERMINAL" if item == "frequency_source" else "a number"
            assert status(package.SampleDrive.POINTS[item].encode, True) == (
                "wrong_type",
                f"{label}: takes {taken}, not True",
            )
    with pytest.raises(TypeError):
        package.SampleDrive.base_frequency.encode(None)
    assert package.SampleDrive.run_command.encode(True) == package.SampleDrive.run_command.encode(1) == 1
    package.SampleDrive.run_command.check(True)
    assert status(package.SampleDrive.base_frequency.check, True)[0] == "wrong_type"


def test_numbers_without_limits(tmp_path: Path) -> None:
    points = (point("anything", 1, "f32", unit=HERTZ), point("everything", 3, "f64"))
    folder = write_package(replace(sample_device(points), errata=(), blocks={}, id="unlimited"), tmp_path)
    for package in imported(folder, "unlimited"):
        anything, everything = package.Unlimited.anything, package.Unlimited.everything
        assert status(anything.encode, math.inf) == ("out_of_range", "anything: inf Hz is no finite binary32")
        assert status(anything.encode, -1e39) == ("out_of_range", "anything: -1e+39 Hz is no finite binary32")
        assert status(anything.check, 0x7F800000) == ("out_of_range", "anything: raw 2139095040 is no finite binary32")
        assert status(everything.encode, 10**400)[1].endswith(" is no finite binary64")
        assert anything.decode(anything.encode(-40.0)) == -40.0


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


def test_flags_read_by_name(package: Any) -> None:
    word = package.SampleDrive.status_word.decode(0x0031)
    assert (word.ready, word.fault, word.mode) == (True, True, package.StatusWordMode.RUN)
    assert package.StatusWord(0x0018).fault is False
    assert package.StatusWord(0x0010).mode == 1
    assert package.StatusWord.mode.place(3) == package.StatusWord.MODE


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
    ruff("check", folder)
    ruff("format", "--diff", folder / "flagged")


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
    ruff("check", folder)
    ruff("format", "--diff", folder / "open_ends")


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
            "forget",
            "layouts",
            "point",
            "read_at",
            "read_many",
            "transport",
            "unit",
            "variants",
            "write_at",
        }


def test_a_factor_that_needs_a_variant_says_so(package: Any, slave: Slave) -> None:
    drive = package.SampleDrive(slave, unit=5)
    assert status(drive.point, "dc_level") == (
        "no_access",
        "dc_level depends on voltage_class: pass it when the device is made",
    )
    assert status(drive.read_many, ["nothing"]) == ("no_access", "nothing is no point of this device")


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


def test_bit_groups_keep_their_neighbours(drive: Any, slave: Slave) -> None:
    slave.words[0x2012] = 0xFFFF
    drive.signed_byte.write(-9)
    assert slave.words[0x2012] == 0xFDFF
    assert (drive.signed_byte.read(), drive.delay_class.read()) == (-9, 3)


def test_swapped_words_and_floats(drive: Any, slave: Slave) -> None:
    slave.words.update({0x2000: 0x5678, 0x2001: 0x1234})
    assert drive.swapped_count.read() == 0x12345678
    drive.float_setpoint.write(1.5)
    assert (slave.words[0x2014], slave.words[0x2015]) == (0, 0x3FC0)
    assert drive.float_setpoint.read() == 1.5
    assert status(type(drive).swapped_count.from_words, (1,))[0] == "wrong_length"


def test_other_points_are_read_as_needed(drive: Any, slave: Slave) -> None:
    slave.words.update({0x200B: 0, 0x200D: 50, 0x200C: 8192})
    assert drive.setpoint.read() == 25.0
    drive.setpoint.write(50.0)
    assert slave.words[0x200C] == 16384
    slave.words[0x105A] = 100
    assert status(drive.upper_limit.write, 5.0)[0] == "out_of_range"
    slave.words[0x105A] = 0  # "inactive" lifts the limit
    drive.upper_limit.write(5.0)
    assert slave.words[0x1059] == 50


def test_remembered_until_forgotten(tmp_path: Path) -> None:
    points = tuple(
        changed(one, changes="rarely") if one.name == "voltage_ratio" else one for one in sample_device().points
    )
    folder = write_package(replace(sample_device(points), id="keeping_drive"), tmp_path)
    slave = Slave()
    slave.words.update({0x2007: 400, 0x2008: 230})
    for package in imported(folder, "keeping_drive"):
        drive = package.KeepingDrive(slave, unit=1)
        asked = 0
        for action, count in (
            (drive.voltage_setpoint.read, 2),
            (drive.voltage_setpoint.read, 1),
            (partial(drive.voltage_setpoint.write, 1.0), 2),  # what is written must not follow from old numbers
            (drive.voltage_setpoint.read, 1),
            (drive.forget, 0),
            (drive.voltage_setpoint.read, 2),
            (partial(drive.voltage_ratio.write, 200), 1),
            (drive.voltage_setpoint.read, 2),
        ):
            action()
            assert len(slave.log) == asked + count
            asked = len(slave.log)


def test_variants(package: Any, drive: Any, slave: Slave) -> None:
    assert drive.dc_level.encode(700) == 700
    assert status(drive.dc_level.encode, 350)[0] == "out_of_range"
    assert package.SampleDrive.dc_level_200v.encode(350) == 350
    assert package.SampleDrive.dc_level.points["400V"].encode(700) == 700
    assert status(lambda: drive.dc_level_200v) == (
        "no_access",
        "b131 dc_level_200v exists only for voltage_class 200V",
    )
    unsaid = package.SampleDrive(slave, unit=1)
    assert status(lambda: unsaid.dc_level)[0] == "no_access"
    unsaid.dc_level_200v.write(350)
    assert slave.words[0x10F5] == 350


def test_read_many(drive: Any, slave: Slave) -> None:
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
    other = type(drive)(slave, unit=drive.unit)
    refused = status(drive.read_many, [other.power])
    assert refused[0] == "no_access"
    assert "is a point of another device" in refused[1]


def test_async_twin(package: Any, slave: Slave) -> None:
    async def work() -> tuple[Any, ...]:
        drive = package.SampleDriveAsync(AsyncSlave(slave), unit=5, voltage_class="200V")
        await drive.base_frequency.write(50.0)
        await drive.signed_byte.write_raw(1)
        await drive.enter.send()
        await drive.write_at("holding", 0x3000, 7)
        both = await asyncio.gather(drive.base_frequency.read(), drive.dc_level.read_raw())
        many = await drive.read_many(["base_frequency"])
        return (*both, many, await drive.read_at("holding", 0x3000))

    assert asyncio.run(work()) == (50.0, 0, {"base_frequency": 50.0}, (7,))


def test_tcp_commands_and_refusals(package: Any) -> None:
    slave = Slave("tcp")
    drive = package.SampleDrive(slave, unit=5)
    drive.enter.send()
    assert slave.log == [(6, 0x900, 1)]
    assert slave.words[0x900] == 1  # any number does; it is the same in all languages
    slave.refuses[0x1028] = 0x21
    assert status(drive.base_frequency.read) == (
        "exception",
        "A020 base_frequency: the device answered exception 21h (value_out_of_range)",
    )
    with pytest.raises(AttributeError):
        drive.base_frequency = 5
    with pytest.raises(ValueError, match="the device speaks rtu and tcp"):
        package.SampleDrive(Slave("ascii"), unit=5)


def test_broadcast_writes_wait_for_nobody(package: Any, slave: Slave) -> None:
    everyone = package.SampleDrive(slave, unit=0)
    everyone.base_frequency.write(50.0)
    assert slave.words[0x1028] == 500
    assert status(everyone.base_frequency.read)[0] == "bad_unit"


def test_old_names_warn(package: Any, drive: Any) -> None:
    with pytest.warns(DeprecationWarning, match="main_frequency is now called base_frequency") as caught:
        assert drive.main_frequency.encode(50.0) == 500
    assert caught[0].filename == __file__
    assert "main_frequency" not in package.SampleDrive.POINTS


def test_errata_are_ids_of_those_that_change_a_fact(tmp_path: Path) -> None:
    device = sample_device()
    wire = replace(device.errata[0], facts=(("wire", "4137"),))
    points = (point("one", 1, errata=("a020_wire", "note")), point("two", 2, errata=("note",)))
    made = replace(sample_device(points), errata=(wire, replace(wire, id="note", facts=())), blocks={}, id="erred")
    text = (write_package(made, tmp_path) / "erred" / "points.py").read_text("utf-8")
    assert text.count("Errata:") == 1
    assert '\n\n    Errata: a020_wire.\n    """' in text
    assert "Hex is right" not in text
    assert "wire 4137" not in text


def test_what_is_documented_only_is_said_once(package: Any, folder: Path) -> None:
    text = (folder / "sample_drive" / "points.py").read_text("utf-8")
    for name in package.SampleDrive.DOCUMENTED:
        assert text.count(f'"{name}": Documented(') == 1
        assert f"# {name}" not in text


def test_names_that_are_taken(tmp_path: Path) -> None:
    taken = sorted(DEVICE_MEMBERS | HELPERS | {"class", "def", "print_", "match"} - {"print_"})
    points = [point(name, number) for number, name in enumerate(taken)]
    word = tuple(replace(STATUS_FLAGS[0], low=low, name=name) for low, name in enumerate(("value", "class", "real")))
    points.append(point("word", 0x100, flags=word))
    folder = write_package(replace(sample_device(tuple(points)), errata=(), blocks={}, id="class"), tmp_path)
    assert not (folder / "class").exists()
    for package in imported(folder, "class_"):
        drive = package.Class(Slave(), unit=1)
        for name in taken:
            assert getattr(drive, f"{name}_" if name != "match" else name, None) or drive.POINTS[name]
            assert drive.POINTS[name].facts.name == name
        assert package.WordFlags(2).class_ is True
        assert package.WordFlags.value_.number(1) == 1


def test_tables_of_taken_names_are_complete(package: Any) -> None:
    runtime = sys.modules["fieldscribe_runtime"]
    can, uss = (importlib.import_module(f"fieldscribe_runtime.{family}") for family in ("can", "uss"))
    can.CanSession.PROFILE = can.Profile((0, 1), 11, ())
    runtime.Device.PROFILE = runtime.AsyncDevice.PROFILE = package.SampleDrive.PROFILE
    uss.UssSession.PROFILE = uss.Profile((0, 1), (4,), (0, 2), {})
    link = uss.Link(4, 2)
    devices = (
        *(runtime.Device(Slave(), 1), runtime.AsyncDevice(AsyncSlave(Slave()), 1)),
        *(can.CanDevice(CanUnit(can.Frame, 1), 1), can.AsyncCanDevice(AsyncCanUnit(CanUnit(can.Frame, 1)), 1)),
        *(uss.UssDevice(UssDrive(), 1, link), uss.AsyncUssDevice(AsyncUssDrive(UssDrive()), 1, link)),
    )
    public = {name for device in devices for name in dir(device) if not name.startswith("_") and name.islower()}
    assert public == DEVICE_MEMBERS
    assert {name for name in dir(package.StatusWord(1)) if not name.startswith("_") and name.islower()} - {
        "ready",
        "fault",
        "mode",
    } <= WORD_MEMBERS


def test_the_whole_runtime_is_copied() -> None:
    copied = dict(target.runtime(sample_device()))
    root = templates_dir() / "python/runtime"
    files = {path.relative_to(templates_dir()).as_posix() for path in root.rglob("*") if path.is_file()}
    assert {source for source in files if "__pycache__" not in source} == set(copied.values())
    assert all(out == f"python/{source.removeprefix('python/runtime/')}" for out, source in copied.items())


def test_hostile_text_stays_text(tmp_path: Path) -> None:
    evil = '"""; import os\n# noqa # type: ignore {{ 7 }} \\'
    quoteless = evil.replace('"', "'")  # a formatter would choose the quotes of a literal by its contents
    hostile = replace(
        sample_device(tuple(replace(one, title=titles(evil), code=quoteless) for one in sample_device().points)),
        title=titles(evil),
        vendor=evil,
        version="1.0.0",  # the language takes no other, nor does pip
    )
    folder = write_package(hostile, tmp_path)
    for package in imported(folder, "sample_drive"):
        assert package.SampleDrive.base_frequency.encode(50.0) == 500
    ruff("check", folder)
    ruff("format", "--diff", folder / "sample_drive")


def ruff(*arguments: object) -> None:
    """Runs ruff with its own defaults; the narrow line length is the harder one."""
    command = [sys.executable, "-m", "ruff", *map(str, arguments), "--isolated", "--no-cache", "--config"]
    done = subprocess.run([*command, "line-length=88"], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def test_generated_code_is_formatted(folder: Path) -> None:
    ruff("check", folder)
    ruff("format", "--diff", folder / "sample_drive")


MISUSE = """
from sample_drive import FrequencySource, SampleDrive, SampleDriveAsync
from typing import assert_type
from fieldscribe_runtime import Field, ReadOnly, ReadWrite, Special, Transport
from sample_drive import StatusWord, StatusWordMode

def words() -> None:
    assert_type(SampleDrive.status_word, ReadOnly[StatusWord])
    assert_type(SampleDrive.status_word.decode(1), StatusWord)
    assert_type(StatusWord(1).ready, bool)
    assert_type(StatusWord(1).mode, StatusWordMode)
    assert_type(Field(2, 3).__get__(StatusWord(1), None), int)
    wrong: str = StatusWord(1).ready  # E: assignment

def enums(drive: SampleDrive) -> None:
    assert_type(SampleDrive.frequency_source, ReadWrite[FrequencySource, FrequencySource])
    assert_type(SampleDrive.frequency_source.decode(77), FrequencySource)
    assert_type(drive.frequency_source.read(), FrequencySource)
    assert_type(drive.frequency_source.read().is_named, bool)
    drive.frequency_source.write(FrequencySource.KEYPAD)
    drive.frequency_source.write(FrequencySource(77))
    drive.frequency_source.write_raw(77)
    drive.frequency_source.write(77)  # E: arg-type
    drive.frequency_source.write(StatusWordMode.STOP)  # E: arg-type
    SampleDrive.frequency_source.encode(1)  # E: arg-type
    drive.frequency_source.write_raw("keypad")  # E: arg-type
    level: int = drive.frequency_source.read()
    mode: StatusWordMode = drive.frequency_source.read()  # E: assignment

def names(drive: SampleDrive) -> None:
    drive.point("A020").write(drive.point("base_frequency").read())
    data: bytes = SampleDrive.layouts("main")[0].encode(SampleDrive.layouts("main")[0].decode(b""))
    drive.point(0x1028)  # E: arg-type

def use(transport: Transport) -> None:
    drive = SampleDrive(transport, unit=5, voltage_class="400V")
    frequency: float = drive.base_frequency.read()
    drive.base_frequency.write(frequency)
    temperature: float | Special = drive.temperature.read()
    if isinstance(temperature, Special):
        reason: str = temperature.name
    else:
        frequency = temperature
    drive.upper_limit.write(drive.upper_limit.special.inactive)
    drive.temperature.write(drive.temperature.special.no_sensor)  # E: arg-type
    level: int = drive.dc_level.read()
    mode: int = drive.status_word.read().mode
    ready: bool = SampleDrive.status_word.decode(1).ready
    drive.running.write(True)  # E: attr-defined
    SampleDrive.running.encode(True)  # E: attr-defined
    drive.base_frequency.write("50")  # E: arg-type
    drive.base_frequency = 5  # E: assignment
    SampleDrive(transport, unit=5, voltage_class="100V")  # E: arg-type
    wrong: float = drive.temperature.read()  # E: assignment

async def use_async(drive: SampleDriveAsync) -> None:
    frequency: float = await drive.base_frequency.read()
    level: int = await drive.dc_level.read()
    source: FrequencySource = await drive.frequency_source.read()
    await drive.frequency_source.write(1)  # E: arg-type
    await drive.point("A020").write(await drive.point("A020").read())
    await drive.running.write(True)  # E: attr-defined
"""


def test_types_are_strict_and_reject_misuse(folder: Path, tmp_path: Path) -> None:
    assert typed_findings(MISUSE, folder, "sample_drive", tmp_path) == ""


def test_writes_go_only_to_spaces_that_can_be_written(drive: Any, slave: Slave) -> None:
    for space in ("discrete", "input", "holdings"):
        assert status(drive.write_at, space, 1, 1)[0] == "bad_space"
    assert status(drive.read_at, "holdings", 1)[0] == "bad_space"
    assert not slave.log
    drive.write_at("coil", 1, 1)
    drive.write_at("holding", 1, 7)
    assert slave.log == [(5, 1, 1), (6, 1, 1)]


def test_unknown_variants_are_refused(package: Any) -> None:
    with pytest.raises(ValueError, match="voltage_class is one of 200V, 400V, not '100V'"):
        package.SampleDrive(Slave(), unit=1, voltage_class="100V")
    bare = type("Bare", (sys.modules["fieldscribe_runtime"].Device,), {"PROFILE": package.SampleDrive.PROFILE})
    with pytest.raises(ValueError, match="no variants by 'colour'"):
        bare(Slave(), 1, {"colour": "red"})


def test_what_a_point_cannot_do_is_said(package: Any) -> None:
    drive = package.SampleDrive(Slave(), 5)
    for asked, words in (
        (lambda: drive.running.write, "running is only read: it has no write"),
        (lambda: package.SampleDrive.base_frequency.read, "make a device, and say device.base_frequency.read(...)"),
        (lambda: drive.base_frequency.send, "object has no attribute 'send'"),
    ):
        refused = error(asked)
        assert type(refused) is AttributeError
        assert words in str(refused)
    assert not hasattr(drive.running, "write")


def test_misspelt_points_are_not_assigned_to(package: Any) -> None:
    drive = package.SampleDrive(Slave(), 5)
    with pytest.raises(AttributeError, match="did you mean base_frequency"):
        drive.base_frequncy = 50.0
    with pytest.raises(AttributeError, match="write method"):
        drive.base_frequency = 50.0
    with pytest.raises(AttributeError, match="declared in your class, as in `zzz: object`"):
        drive.zzz = 1

    class Own(package.SampleDrive):  # type: ignore[misc]  # a class that is imported at run time
        name: str
        asked = 0

        def __init__(self, name: str) -> None:
            super().__init__(Slave(), 5)
            self.name, self._log = name, [name]
            self.asked += 1

    own = Own("first")
    own.unit = 6
    assert (own.name, own.asked, own._log, repr(own)) == ("first", 1, ["first"], "<Own unit 6>")


def test_errors_tell_what_to_do_next(package: Any) -> None:
    slave = Slave()
    drive = package.SampleDrive(slave, 5)
    failure = error(drive.base_frequency.write, 500.0)
    assert failure.point == "A020 base_frequency"
    assert drive.point(failure.point).facts is drive.base_frequency.facts
    assert error(drive.point, "A999 base_frequency").status == "no_access"
    assert error(drive.write_at, "holding", 1, [5]).status == "bad_value"
    slave.refuses = {0x4000: 2, package.SampleDrive.enter.at.address: 1}
    failure = error(drive.read_at, "holding", 0x4000)
    assert (failure.point, failure.lost) == ("holding 0x4000", False)
    assert error(drive.enter.send).point == "enter"
    assert str(error(drive.frequency_source.write, "terminal")).endswith(
        "takes FrequencySource.TERMINAL, not 'terminal'"
    )
    slave.exchange = lambda request: bytes(8)  # type: ignore[method-assign]  # noise
    assert error(drive.base_frequency.read).lost


def test_help_and_repr_say_what_there_is(package: Any) -> None:
    uss = importlib.import_module("fieldscribe_runtime.uss")
    assert str(inspect.signature(uss.Link)) == "(pkw, pzd, single_first=False)"
    assert "unit='Hz'" in repr(package.SampleDrive.base_frequency.facts)


def test_units_and_framings_that_the_device_cannot_have_are_refused(package: Any) -> None:
    for made in (package.SampleDrive, package.SampleDriveAsync):
        for unit in (33, -1, 256, "5", None):
            failure = error(made, Slave(), unit)
            assert (failure.status, str(failure)) == ("bad_unit", f"the device can be unit 1 to 32, not {unit!r}")
        assert made(Slave(), 0).unit == 0  # all units
        assert error(made, Slave("ascii"), 5).status == "bad_framing"
        limited = type("Limited", (made,), {"PROFILE": made.PROFILE.replaced(framings=("rtu",))})
        failure = error(limited, Slave("tcp"), 5)
        assert (failure.status, str(failure).partition(";")[0]) == ("bad_framing", "the device speaks rtu, not 'tcp'")
        assert limited(Slave(), 5).unit == 5
    limited = type("Limited", (package.SampleDrive,), {"PROFILE": package.SampleDrive.PROFILE.replaced(framings=())})
    slave = Slave("pdu")  # whose transport frames as it likes
    drive = limited(slave, 5)
    drive.base_frequency.write(50.0)
    assert drive.base_frequency.read() == 50.0
    slave.refuses = dict.fromkeys(slave.words, 2)
    assert error(drive.base_frequency.read).code == 2


def test_nothing_is_cut_off_silently(package: Any) -> None:
    drive = package.SampleDrive
    for function, number, expected in (
        (drive.base_frequency.to_words, 65536, "out_of_range"),
        (drive.signed_one.to_words, 32768, "out_of_range"),
        (drive.signed_byte.to_words, -129, "out_of_range"),
        (drive.base_frequency.from_words, (65536,), "out_of_range"),
        (drive.base_frequency.from_words, (-1,), "out_of_range"),
        (drive.base_frequency.from_words, (1.5,), "out_of_range"),
        (drive.base_frequency.check, 12.5, "out_of_range"),
        (drive.base_frequency.encode_count, 12.5, "out_of_range"),
        (drive.voltage_ratio.encode, 60.5, "out_of_range"),
        (drive.base_frequency.encode, 10**400, "out_of_range"),
        (drive.base_frequency.encode, 10**5000, "out_of_range"),
        (drive.base_frequency.check, 10**5000, "out_of_range"),
        (drive.float_setpoint.encode, 10**400, "out_of_range"),
        (drive.base_frequency.encode, Decimal("sNaN"), "not_a_number"),
        (drive.float_setpoint.encode, Decimal("sNaN"), "not_a_number"),
    ):
        assert status(function, number)[0] == expected, (function, number)


def test_members_of_other_enums_are_refused(package: Any) -> None:
    point_ = package.SampleDrive.frequency_source
    assert status(point_.encode, package.StatusWordMode.STOP)[0] == "unknown_value"
    assert point_.encode(package.FrequencySource.TERMINAL) == point_.encode(1) == 1


def test_long_names_of_words_are_formatted(tmp_path: Path) -> None:
    word = point("a_word_with_an_unusually_long_name_of_its_own", 1, flags=STATUS_FLAGS)
    folder = write_package(replace(sample_device((word,)), errata=(), blocks={}), tmp_path)
    ruff("check", folder)
    ruff("format", "--diff", folder / "sample_drive")


def test_separate_places(tmp_path: Path) -> None:
    apart = replace(plain_points()[2], place=Place((7,), {}), write_place=Place((9,), {}), errata=())
    device = sample_device((apart, changed(plain_points()[1], access="w")))
    folder = write_package(replace(device, blocks={}, id="placed"), tmp_path)
    text = (folder / "placed" / "points.py").read_text("utf-8")
    assert "at=holding(0x0007)," in text
    assert "write_at=holding(0x0009)," in text
    slave = Slave()
    for package in imported(folder, "placed"):
        drive = package.Placed(slave, unit=1)
        drive.base_frequency.write(1.0)
        drive.running.write(False)
        assert slave.log == [(6, 9, 1), (5, 13, 1)]
        assert not hasattr(drive.running, "read")


@pytest.mark.filterwarnings("ignore:main_frequency is now called")
def test_help_shows_how_a_device_is_used(folder: Path) -> None:
    for package in imported(folder, "sample_drive"):
        drive, awaited = package.SampleDrive, package.SampleDriveAsync
        for text in (package.__doc__, drive.__doc__):
            lines = [line.strip() for line in text.splitlines()]
            assert lines[2:11] == [
                "from fieldscribe_runtime.transports.serial import SerialLine",
                "",
                "with SerialLine('/dev/ttyUSB0', 9600) as line:",
                "drive = SampleDrive(line, 1, voltage_class='200V')",
                "print(drive.acceleration_time.read())",
                "drive.acceleration_time.write(value)",
                "drive.read_many('main')",
                "SampleDrive.acceleration_time.decode(raw)",
                "help(SampleDrive.acceleration_time)",
            ]
        assert "await drive.acceleration_time.read()" in awaited.__doc__
        assert "as `AsyncTransport` says; `fieldscribe_runtime` has that class" in awaited.__doc__
        told = pydoc.plain(pydoc.render_doc(drive))
        assert all(f"Place: {point_.facts.where}." in told for point_ in drive.POINTS.values())
        assert "What may be written: 0..400 Hz." in pydoc.plain(pydoc.render_doc(drive.base_frequency))
        assert "a command: it writes any number (1 if none is given)" in drive.enter.__doc__
    ruff("check", folder)


def test_devices_without_points_have_help_too(tmp_path: Path) -> None:
    folder = write_package(replace(sample_device((point("nowhere", None),)), errata=(), blocks={}, id="bare"), tmp_path)
    for package in imported(folder, "bare"):
        assert package.__doc__.splitlines()[2].startswith("A transport carries bytes")
        assert package.Bare.__doc__.strip() == "Acme S1 over a transport: `drive.point.read()`."
    ruff("check", folder)
    ruff("format", "--diff", folder / "bare")


def test_documented_points_are_found_by_code(package: Any, drive: Any) -> None:
    documented = {name: facts.code for name, facts in package.SampleDrive.DOCUMENTED.items() if facts.code}
    assert documented
    for name, code in documented.items():
        assert status(drive.point, code)[1].startswith(f"{code} is documented only, as {name}: ")
        assert status(drive.point, name)[1].startswith(f"{name} is documented only: ")


def test_an_async_device_works_in_one_loop_after_the_other(package: Any, slave: Slave) -> None:
    slave.words[0x1028] = 500
    drive = package.SampleDriveAsync(AsyncSlave(slave), unit=5, voltage_class="200V")

    async def both() -> list[float]:
        return [*await asyncio.gather(drive.base_frequency.read(), drive.base_frequency.read())]

    assert [asyncio.run(both()) for _ in range(2)] == [[50.0, 50.0]] * 2


def test_reads_of_groups_say_what_failed(drive: Any, slave: Slave) -> None:
    slave.refuses[0x1028] = 2
    failure = error(drive.read_many, "main")
    assert (failure.group, failure.status) == ("main", "exception")
    assert "A020 base_frequency" in failure.point
    assert str(failure).startswith(f"group main: {failure.point}: the device answered exception 02h")


def test_no_device_may_have_the_name_of_a_library_that_the_runtime_imports() -> None:
    imported_names: set[str] = set()
    for file in (templates_dir() / "python/runtime/fieldscribe_runtime").rglob("*.py"):
        for node in ast.walk(ast.parse(file.read_text("utf-8"))):
            if isinstance(node, ast.Import):
                imported_names.update(alias.name.split(".")[0] for alias in node.names)
            elif isinstance(node, ast.ImportFrom) and node.module is not None and node.level == 0:
                imported_names.add(node.module.split(".")[0])
    assert imported_names - sys.stdlib_module_names - {"fieldscribe_runtime"} == LIBRARIES
