"""The generated Python package as a user sees it: its names, types, help and errors, and what it refuses."""

from __future__ import annotations

import ast
import importlib
import inspect
import pydoc
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.model import Place
from fieldscribe.resources import templates_dir
from fieldscribe.targets import python as target
from fieldscribe.targets.python import LIBRARIES
from fieldscribe.targets.python.syntax import DEVICE_MEMBERS, HELPERS, WORD_MEMBERS
from support.models import STATUS_FLAGS, changed, doubts, plain_points, point, sample_device, titles
from support.python_families import CanUnit, UssDrive
from support.python_package import Awaited, Slave, assert_formatted, error, imported, typed_findings, write_package


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
        *(runtime.Device(Slave(), 1), runtime.AsyncDevice(Awaited(Slave()), 1)),
        *(can.CanDevice(CanUnit(can.Frame, 1), 1), can.AsyncCanDevice(Awaited(CanUnit(can.Frame, 1)), 1)),
        *(uss.UssDevice(UssDrive(), 1, link), uss.AsyncUssDevice(Awaited(UssDrive()), 1, link)),
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
        sample_device(
            tuple(replace(one, title=titles(evil), code=quoteless, errata=("doubt",)) for one in sample_device().points)
        ),
        errata=doubts(evil, "base_frequency"),
        title=titles(evil),
        vendor=evil,
        version="1.0.0",  # the language takes no other, nor does pip
    )
    folder = write_package(hostile, tmp_path)
    for package in imported(folder, "sample_drive"):
        assert package.SampleDrive.base_frequency.encode(50.0) == 500
    assert_formatted(folder / "sample_drive")


def test_generated_code_is_formatted(folder: Path) -> None:
    assert_formatted(folder / "sample_drive")


MISUSE = """
from sample_drive import FrequencySource, SampleDrive, SampleDriveAsync
from typing import Literal, assert_type
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
    kept = drive.temperature.read()
    assert_type(kept, float | Special[Literal["no_sensor"]])
    typo = not isinstance(kept, float) and kept.name == "no_senser"  # E: comparison-overlap
    if isinstance(temperature, Special):
        reason = str(temperature)
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
    drive.read_many(["A020", drive.base_frequency])
    drive.read_many(name for group in drive.GROUPS for name in drive.read_many(group))
    drive.read_many("mian")  # E: call-overload
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


@pytest.mark.full(seconds=3)
def test_types_are_strict_and_reject_misuse(folder: Path, tmp_path: Path) -> None:
    assert typed_findings(MISUSE, folder, "sample_drive", tmp_path) == ""


def test_what_a_point_cannot_do_is_said(package: Any) -> None:
    drive = package.SampleDrive(Slave(), 5)
    for asked, words in (
        (lambda: drive.running.write, "running is only read: it has no write"),
        (lambda: package.SampleDrive.base_frequency.read, "make a device, and call device.base_frequency.read(...)"),
        (lambda: drive.base_frequency.send, "object has no attribute 'send'"),
    ):
        refused = error(asked)
        assert isinstance(refused, AttributeError)
        assert words in str(refused)
    assert not hasattr(drive.running, "write")


def test_names_are_suggested_as_they_look(l200: Any) -> None:
    drive = l200.HitachiL200(Slave(), 1)
    for asked, words in (
        (lambda: drive.base_freqency, "did you mean base_frequency or "),
        (lambda: drive.point("A02O"), "did you mean A020 or A021 or A022?"),
        (lambda: drive.read_many(["A02"]), "did you mean A002 or A020 or "),
    ):
        assert words in str(error(asked))


def test_misspelt_points_are_not_assigned_to(package: Any) -> None:
    drive = package.SampleDrive(Slave(), 5)
    with pytest.raises(AttributeError, match="did you mean base_frequency"):
        drive.base_frequncy = 50.0
    with pytest.raises(AttributeError, match="write method"):
        drive.base_frequency = 50.0
    with pytest.raises(AttributeError, match="in your class, as in `zzz: object`"):
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
    assert "takes a member of FrequencySource such as " in str(error(drive.frequency_source.write, True))
    slave.exchange = lambda request: bytes(8)  # type: ignore[method-assign]  # noise
    assert error(drive.base_frequency.read).lost


def test_help_and_repr_say_what_there_is(package: Any) -> None:
    uss = importlib.import_module("fieldscribe_runtime.uss")
    assert str(inspect.signature(uss.Link)) == "(pkw, pzd, single_first=False)"
    assert "unit='Hz'" in repr(package.SampleDrive.base_frequency.facts)


def test_long_names_of_words_are_formatted(tmp_path: Path) -> None:
    word = point("a_word_with_an_unusually_long_name_of_its_own", 1, flags=STATUS_FLAGS)
    folder = write_package(replace(sample_device((word,)), errata=(), blocks={}), tmp_path)
    assert_formatted(folder / "sample_drive")


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
        assert "follows the protocol `AsyncTransport` of `fieldscribe_runtime`" in awaited.__doc__
        told = pydoc.plain(pydoc.render_doc(drive))
        assert all(f"Place: {point_.facts.where}." in told for point_ in drive.POINTS.values())
        assert "What may be written: 0..400 Hz." in pydoc.plain(pydoc.render_doc(drive.base_frequency))
        assert "a command: it writes any number (1 if none is given)" in drive.enter.__doc__
    assert_formatted(folder / "sample_drive")


def test_devices_without_points_have_help_too(tmp_path: Path) -> None:
    folder = write_package(replace(sample_device((point("nowhere", None),)), errata=(), blocks={}, id="bare"), tmp_path)
    for package in imported(folder, "bare"):
        assert package.__doc__.splitlines()[2].startswith("A transport sends bytes")
        assert package.Bare.__doc__.strip() == "Acme S1 over a transport: `drive.point.read()`."
    assert_formatted(folder / "bare")


def test_no_device_may_have_the_name_of_a_library_that_the_runtime_imports() -> None:
    imported_names: set[str] = set()
    for file in (templates_dir() / "python/runtime/fieldscribe_runtime").rglob("*.py"):
        for node in ast.walk(ast.parse(file.read_text("utf-8"))):
            if isinstance(node, ast.Import):
                imported_names.update(alias.name.split(".")[0] for alias in node.names)
            elif isinstance(node, ast.ImportFrom) and node.module is not None and node.level == 0:
                imported_names.add(node.module.split(".")[0])
    assert imported_names - sys.stdlib_module_names - {"fieldscribe_runtime"} == LIBRARIES
