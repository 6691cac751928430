"""Generated Python for USS devices: parameters in RAM and EEPROM, process data, and every way that can fail."""

from __future__ import annotations

import asyncio
import random
import struct
import sys
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.families.uss import of_bus
from fieldscribe.model import Fixed, Variant
from support.python_families import UssDrive, uss_device, word
from support.python_package import Awaited, error, imported, typed_findings, write_package


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_package(uss_device(), tmp_path_factory.mktemp("uss"))


@pytest.fixture(scope="module")
def package(folder: Path) -> Iterator[Any]:
    yield from imported(folder, "sample_uss")


@pytest.fixture
def uss(package: Any) -> Any:
    return sys.modules["fieldscribe_runtime.uss"]


@pytest.fixture
def line() -> UssDrive:
    return UssDrive(pkw=4, pzd=2)


@pytest.fixture
def drive(package: Any, uss: Any, line: UssDrive) -> Any:
    return package.SampleUss(line, 3, link=uss.Link(pkw=4, pzd=2))


def f32(value: float) -> tuple[int, int]:
    """The words of a binary32 number."""
    pattern = struct.pack(">f", value)
    return int.from_bytes(pattern[:2], "big"), int.from_bytes(pattern[2:], "big")


def test_parameters(drive: Any, line: UssDrive) -> None:
    line.ram[1082, 0] = f32(50.0)
    assert drive.maximum_frequency.read() == 50.0
    drive.maximum_frequency.write(40.0)
    assert (line.ram[1082, 0], line.eeprom) == (f32(40.0), {})
    drive.maximum_frequency.write(45.0, keep=True)
    assert line.eeprom == {(1082, 0): f32(45.0)}
    drive.command_source.write(5)
    drive.command_source.write_raw(4, keep=True)
    assert line.eeprom[700, 0] == (4,)
    assert [frame[6:16] for frame in line.log] == ["143a000000", "343a000042", "d43a000042", "22bc000000", "e2bc000000"]
    assert line.log[0] == bytes((2, 14, 3, 0x14, 0x3A, *[0] * 10, 0x21)).hex()
    assert all(frame[22:30] == "00000000" for frame in line.log)  # nothing is commanded meanwhile


def test_factors_that_are_numbers(drive: Any, package: Any, line: UssDrive) -> None:
    setpoint = package.SampleUss.main_setpoint
    fifty = struct.unpack(">I", struct.pack(">f", 50.0))[0]
    raws = {"normalisation": 0, "reference_frequency": fifty}
    assert setpoint.encode(50.0, raws) == setpoint.encode_count(500000, raws) == 0x4000
    third = {**raws, "reference_frequency": struct.unpack(">I", struct.pack(">f", 1 / 3))[0]}
    assert setpoint.encode_count(3333, third) == 16382
    for wrong in (0, 0x80000000, 0x7F800000, 0x7FC00000):
        for function in (setpoint.encode, setpoint.encode_count, package.SampleUss.main_actual_value.decode):
            assert error(function, 1, {**raws, "reference_frequency": wrong}).status == "zero_factor"
    assert error(setpoint.encode, 1e300, raws).status == "out_of_range"
    assert error(setpoint.encode, 50.0, {**raws, "normalisation": 7}).status == "no_case"
    line.ram.update({(2000, 0): f32(50.0), (2009, 0): (0,)})
    drive.main_setpoint.write(25.0)
    line.ram[2000, 0] = f32(100.0)  # at the panel
    drive.main_setpoint.write(25.0)
    assert line.task == (0, 0x1000)
    assert len(line.log) == 6  # both factors were read before each write
    line.answer = (0, 0x4000, 0, 0)
    assert drive.main_actual_value.read() == 100.0
    assert len(line.log) == 7  # they are kept for reading
    drive.command_source.write(1)
    assert drive.main_actual_value.read() == 100.0
    assert len(line.log) == 10  # the one that changes with it was read again


def test_bits_bring_the_constants_of_their_word(tmp_path: Path) -> None:
    fixed = word("task", "command", 0, access="w", fixed=Fixed(0x0400, 0x0400))
    part = word("task", "part", 0, type_name="u8", access="w", bits=(2, 1))
    device = replace(uss_device(), id="two_in_one")
    points = (*(one for one in device.points if one.telegram != "task"), fixed, part)
    folder = write_package(replace(device, points=points), tmp_path)
    for package in imported(folder, "two_in_one"):
        line = UssDrive(pkw=4, pzd=2)
        drive = package.TwoInOne(line, 3, sys.modules["fieldscribe_runtime.uss"].Link(4, 2))
        drive.part.write(2)
        assert line.task == (0x0404, 0)


def test_the_link_is_held_against_the_variant(tmp_path: Path) -> None:
    device = replace(uss_device(), id="sizes", variants={"model": ("small", "large")})
    own = of_bus(device.bus)
    bus = replace(
        device.bus,
        family_facts=replace(
            own, variant_pzd=((Variant("model", "small"), 2), (Variant("model", "large"), own.pzd[1]))
        ),
    )
    folder = write_package(replace(device, bus=bus), tmp_path)
    for package in imported(folder, "sizes"):
        link = sys.modules["fieldscribe_runtime.uss"].Link
        assert package.Sizes.PROFILE.variant_pzd == {("model", "small"): (0, 2)}
        failure = error(package.Sizes, UssDrive(4, 4), 3, link(4, 4), model="small")
        assert (failure.status, str(failure)) == ("bad_link", "model small takes 0..2 words of process data, not 4")
        assert package.Sizes(UssDrive(4, 2), 3, link(4, 2), model="small").status_word.read() == 0
        for model in ("large", None):
            assert package.Sizes(UssDrive(4, 4), 3, link(4, 4), model=model).status_word.read() == 0


def test_needs_that_depend_on_a_variant(tmp_path: Path) -> None:
    device = uss_device()
    points = [one for one in device.points if one.name != "normalisation"]
    found = next(one for one in device.points if one.name == "normalisation")
    points += [replace(found, variant=Variant("interface", one), index=at) for at, one in enumerate(("rs485", "rs232"))]
    device = replace(device, points=tuple(points), id="faces", variants={"interface": ("rs485", "rs232")})
    folder = write_package(device, tmp_path)
    for package in imported(folder, "faces"):
        link = sys.modules["fieldscribe_runtime.uss"].Link
        drive = package.Faces(UssDrive(4, 2), 3, link(4, 2))
        failure = error(drive.main_setpoint.write, 1.0)
        text = "main_setpoint needs normalisation, which depends on interface: pass it when the device is made"
        assert (failure.status, str(failure)) == ("no_access", text)
        assert str(error(drive.read_many, ["main_actual_value"])).startswith("main_actual_value needs normalisation")


def test_requests_that_are_of_no_device(package: Any, uss: Any) -> None:
    """A task that the device has not, and a link of one word, end in errors of ours."""
    profile = package.SampleUss.PROFILE
    body = bytes((2, 8, 3, 0x10, 0, 0, 0, 0, 0))
    answer = body + bytes((2 ^ 8 ^ 3 ^ 0x10,))
    unknown = error(uss.parse, uss.Request(3, 15), answer, profile, uss.Link(pkw=3, pzd=0))
    assert unknown.status == "wrong_response"
    short = bytes((2, 4, 3, 0x10, 0, 2 ^ 4 ^ 3 ^ 0x10))
    for task in (0, 1):
        assert error(uss.parse, uss.Request(3, task), short, profile, uss.Link(pkw=1, pzd=0)).status == "wrong_length"


def test_the_example_of_the_class_says_what_a_link_is(package: Any, uss: Any) -> None:
    for kind in (package.SampleUss, package.SampleUssAsync):
        said = [line.strip() for line in kind.__doc__.splitlines()]
        assert "from fieldscribe_runtime.uss import Link" in said
        [made] = [line for line in said if line.startswith(f"drive = {kind.__name__}(")]
        link = eval(made[made.index("Link(") : made.index(")") + 1], {"Link": uss.Link})
        assert kind(UssDrive(), 3, link).link == link


TYPED = """
from typing import assert_type
from sample_uss import ControlWord, SampleUss, SampleUssAsync, StatusWord
from fieldscribe_runtime.uss import Link, Stored, UssTransport

def use(transport: UssTransport) -> None:
    drive = SampleUss(transport, 3, link=Link(pkw=4, pzd=2))
    assert_type(SampleUss.maximum_frequency, Stored[float, float])
    assert_type(drive.maximum_frequency.read(), float)
    drive.maximum_frequency.write(40.0, keep=True)
    drive.main_setpoint.write(40.0)
    drive.control_word.write(ControlWord.START | ControlWord.VALID)
    drive.control_word.write(ControlWord.of(start=True))
    drive.control_word.write(StatusWord.START)  # E: arg-type
    drive.control_word.write(5)  # E: arg-type
    drive.control_word.write_raw(0x0401)
    assert_type(ControlWord.of(), ControlWord)
    ControlWord.of(begin=True)  # E: call-arg
    ControlWord.of(start="yes")  # E: arg-type
    ControlWord.of(True)  # E: call-arg
    drive.broadcast((6, 0xFFFF, 0, 0), (ControlWord.of(start=True), 0))
    drive.broadcast((6, 0xFFFF), (0, 0))  # E: arg-type
    assert_type(drive.status_word.read(), StatusWord)
    drive.unlock.write(5, keep=True)
    drive.main_setpoint.write(40.0, keep=True)  # E: call-arg
    drive.reaction.write(1, keep=True)  # E: call-arg
    drive.maximum_frequency.write(40.0, True)  # E: call-arg
    drive.control_word.read()  # E: attr-defined
    drive.status_word.write(StatusWord.START)  # E: attr-defined
    drive.maximum_frequency = 5  # E: assignment
    SampleUss(transport, 3)  # E: call-arg

async def use_async(drive: SampleUssAsync) -> None:
    assert_type(await drive.maximum_frequency.read(), float)
    await drive.maximum_frequency.write(40.0, keep=True)
    await drive.main_setpoint.write(40.0)
"""


@pytest.mark.full
def test_types_are_strict_and_reject_misuse(folder: Path, tmp_path: Path) -> None:
    assert typed_findings(TYPED, folder, "sample_uss", tmp_path) == ""


def test_a_cancelled_command_is_not_repeated(package: Any, uss: Any, line: UssDrive) -> None:
    class Slow(Awaited):
        slow = False

        async def exchange(self, request: bytes) -> bytes:
            reply = await super().exchange(request)
            if self.slow:
                await asyncio.sleep(60)
            return reply

    async def work() -> None:
        transport = Slow(line)
        drive = package.SampleUssAsync(transport, 3, uss.Link(4, 2))
        await drive.control_word.write_raw(0x0401)
        transport.slow = True
        with suppress(asyncio.TimeoutError):
            await asyncio.wait_for(drive.control_word.write_raw(0x0400), 0.01)
        transport.slow = False
        await drive.drive_status.read()

    asyncio.run(work())
    assert line.task == (0, 0)


def test_any_bytes_are_safe(package: Any, uss: Any) -> None:
    rng = random.Random(1)
    profile = package.SampleUss.PROFILE
    failure = sys.modules["fieldscribe_runtime"].FrameError
    for _ in range(3000):
        link = uss.Link(rng.choice((0, 3, 4, 127)), rng.randint(0, 4), rng.random() < 0.2)
        request = uss.Request(3, rng.choice(list(profile.tasks)), rng.choice((0, 700, 2010)))
        reply = bytearray(rng.randbytes(rng.randint(0, 24)))
        if len(reply) > 3 and rng.random() < 0.9:
            reply[:3] = (2, len(reply) - 2, 3)
            reply[-1] = 0
            for byte in bytes(reply[:-1]):
                reply[-1] ^= byte
        with suppress(failure):
            uss.parse(request, bytes(reply), profile, link)
