"""Generated Python for USS devices: parameters in RAM and EEPROM, process data, and every way that can fail."""

from __future__ import annotations

import asyncio
import struct
import sys
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import pytest
from fieldscribe.families.uss import of_bus
from fieldscribe.model import Fixed, Variant
from support.python_families import AsyncUssDrive, UssDrive, uss_device, word
from support.python_package import error, imported, typed_findings, write_package

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path


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
    assert [frame[6:16] for frame in line.log] == [
        "143a000000",
        "343a000042",
        "d43a000042",
        "22bc000000",
        "e2bc000000",
    ]
    assert line.log[0] == bytes((2, 14, 3, 0x14, 0x3A, *[0] * 10, 0x21)).hex()
    assert all(frame[22:30] == "00000000" for frame in line.log)  # nothing is commanded meanwhile


def test_arrays_and_pages(drive: Any, line: UssDrive) -> None:
    drive.baud_rate.write(6)
    drive.baud_rate.write(7, keep=True)
    drive.answer_source.write(0x12345678)
    drive.answer_source.write(5, keep=True)
    assert line.ram == {(2010, 1): (7,), (2016, 3): (0, 5)}
    assert line.eeprom == line.ram
    assert [frame[6:14] for frame in line.log] == ["700a8001", "c00a8001", "80108003", "b0108003"]
    assert drive.baud_rate.read() == 7
    assert drive.answer_source.read_raw() == 5
    assert drive.read_at("parameter", 2016, 3) == (0, 5)
    drive.write_at("parameter", 2016, 1, 2, index=3)
    assert line.ram[2016, 3] == (1, 2)


def test_bits_and_kinds_of_memory(drive: Any, line: UssDrive) -> None:
    line.ram[800, 0] = (0xA5A5,)
    drive.mode.write(3)
    assert line.ram[800, 0] == (0xA535,)
    drive.mode.write(4, keep=True)
    assert line.eeprom[800, 0] == (0xA545,)
    assert error(drive.reaction.write, 5, keep=True).__class__ is TypeError  # the manual says that it is not kept
    drive.unlock.write(5, keep=True)
    assert not hasattr(drive.unlock, "read")


def test_process_data(drive: Any, package: Any, line: UssDrive) -> None:
    line.ram.update({(2000, 0): f32(50.0), (2009, 0): (0,)})
    drive.main_setpoint.write(40.0)
    assert line.task == (0, 0x3333)  # no word counts before a point of it is written, with its constant bits
    drive.control_word.write(package.ControlWord.of(start=True))
    assert line.task == (0x0401, 0x3333)
    line.answer = (0x0401, 0x4000, 0, 0)
    assert drive.status_word.read() == package.StatusWord.START | package.StatusWord.VALID
    assert drive.main_actual_value.read() == 50.0
    assert line.task == (0x0401, 0x3333)
    assert error(drive.control_word.write_raw, 1).status == "out_of_range"
    assert error(drive.energy.read).status == "bad_link"
    assert error(drive.jog.write, 1).status == "bad_link"
    assert line.task == (0x0401, 0x3333)


def test_bits_of_process_data(package: Any, uss: Any) -> None:
    line = UssDrive(pkw=127, pzd=4)
    drive = package.SampleUss(line, 3, uss.Link(127, 4))
    line.answer = (1, 2, 3, 4)
    drive.jog.write(2)
    assert line.task == (0, 0, 4, 0)
    assert drive.energy.read() == 3 << 16 | 4
    line.log.clear()
    line.ram.update({(2000, 0): f32(50.0), (2009, 0): (1,)})
    values = drive.read_many(["status_word", "main_actual_value", "energy", "baud_rate"])
    assert values == {"status_word": 1, "main_actual_value": 0.02, "energy": 3 << 16 | 4, "baud_rate": 0}
    assert len(line.log) == 4  # one telegram for the process data


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


def test_process_data_can_be_dropped(drive: Any, line: UssDrive) -> None:
    drive.control_word.write_raw(0x0401)
    drive.drop_process_data()
    drive.drive_status.read()
    assert line.task == (0, 0)


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


def test_words_without_a_point(package: Any, uss: Any) -> None:
    line = UssDrive(pkw=127, pzd=4)
    drive = package.SampleUss(line, 3, uss.Link(127, 4))
    drive.write_at("task", 2, 7, 8)
    assert line.task == (0, 0, 7, 8)
    line.answer = (1, 2, 3, 4)
    assert drive.read_at("answer", 3) == (4,)
    assert drive.read_at("task", 3) == (8,)
    assert error(drive.read_at, "answer", 4).status == "bad_link"
    assert error(drive.write_at, "answer", 0, 1).status == "bad_space"
    assert str(error(drive.read_at, "reply", 0)) == "there is no space 'reply', only parameter, task, answer"


def test_process_data_comes_with_refusals(drive: Any, line: UssDrive) -> None:
    line.answer = (0x0FA8, 0x1234, 0, 0)
    line.refuses[700] = 17
    assert error(drive.command_source.write, 1).words == (0x0FA8, 0x1234)
    line.refuses.clear()
    line.change = changed(3, 0x90)
    failure = error(drive.command_source.read)
    assert (failure.status, failure.words) == ("no_rights", (0x0FA8, 0x1234))
    line.change = bytes
    line.late, drive.repeats = 9, 0
    failure = error(drive.command_source.read)
    assert (failure.status, failure.words) == ("no_answer", (0x0FA8, 0x1234))


def test_broadcast(drive: Any, package: Any, uss: Any, line: UssDrive) -> None:
    calls: list[bytes] = []

    def exchange(request: bytes) -> bytes:
        if request[2] != 0x20:
            return UssDrive.exchange(line, request)
        calls.append(request)
        if len(calls) > 1:
            raise TimeoutError
        return b""

    line.exchange = exchange  # type: ignore[method-assign]  # a line that dies
    word = package.ControlWord
    drive.broadcast((6, 0xFFFF, 0, 0), (word.of(start=True), 0x3333))
    assert calls[-1].hex()[6:-2] == "0006ffff" + "00000000" + "04013333"
    drive.control_word.write(word.of(start=True))
    drive.write_at("task", 1, 0x1000)
    drive.broadcast((6, 0x0401, 0, 0))
    assert calls[-1].hex()[6:-2] == "00060401" + "00000000" + "04011000"
    drive.drive_status.read()
    assert line.task == (0, 0)  # what was broadcast, a stop perhaps, is not taken back
    sent = len(calls)
    for mask, words in (
        ((6, 0xFBFF, 0, 0), (0x0401, 0)),  # the constant bit has to count
        ((2, 0xFFFF, 0, 0), (1, 0)),  # and to be there
        ((6, 0xFFFF, 0, 0), None),  # nothing was written
    ):
        assert error(drive.broadcast, mask, words).status == "bad_value"
    assert error(drive.broadcast, (6, 0, 0), (0x0400, 0)).status == "bad_link"
    assert error(drive.broadcast, (6, 0, 0, 0), (0x0400,)).status == "bad_link"
    assert len(calls) == sent

    async def work() -> None:
        other = package.SampleUssAsync(AsyncUssDrive(line), 3, uss.Link(4, 2))
        await other.broadcast((4, 0x0400, 0, 0), (0, 5))

    asyncio.run(work())
    assert calls[-1].hex()[6:-2] == "00040400" + "00000000" + "00000005"


def test_groups_leave_out_what_the_link_does_not_carry(package: Any, uss: Any) -> None:
    def read(group: str, pkw: int, pzd: int) -> dict[str, Any]:
        line = UssDrive(pkw, pzd)
        line.ram.update(dict.fromkeys([(1082, 0), (2000, 0)], f32(50.0)) | {(2016, 3): (0, 0), (731, 0): (0, 0)})
        result: dict[str, Any] = package.SampleUss(line, 3, uss.Link(pkw, pzd)).read_many(group)
        return result

    assert set(read("answer", 4, 2)) == {"status_word", "main_actual_value"}
    assert set(read("answer", 4, 4)) == {"status_word", "main_actual_value", "energy"}
    assert set(read("answer", 0, 2)) == {"status_word"}  # the scale of the other one cannot be read
    assert read("main", 0, 2) == {}
    assert "maximum_frequency" not in read("main", 3, 2)
    assert {"maximum_frequency", "command_source"} <= set(read("main", 4, 0))
    drive = package.SampleUss(UssDrive(4, 2), 3, uss.Link(4, 2))
    assert error(drive.read_many, ["energy"]).status == "bad_link"  # who asks for it by name is told


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
        assert (failure.status, str(failure)) == (
            "bad_link",
            "model small takes 0..2 words of process data, not 4",
        )
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


def changed(at: int, bits: int) -> Any:
    """A reply with some bits of a byte turned, and the right check."""

    def change(reply: bytes) -> bytes:
        data = bytearray(reply)
        data[at] ^= bits
        data[-1] ^= bits
        return bytes(data)

    return change


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


def test_printed_examples(package: Any, uss: Any) -> None:
    """Whole telegrams as the MICROMASTER 4's manual prints their parts."""
    profile = package.SampleUss.PROFILE
    link = uss.Link(127, 2)
    sent = uss.build(uss.Request(3, 1, 700, words=(0x047F, 0x3333)), profile, link)
    assert sent.hex() == "020e0312bc000000000000047f3333da"
    reply = uss.parse(uss.Request(3, 1, 700), bytes.fromhex("020c0312bc00000002fa3100006a"), profile, link)
    assert (reply.response, reply.width, reply.value, reply.words) == (1, 1, 2, (0xFA31, 0))
    all_units = uss.broadcast((6, 0xFFFF, 0, 0), (0x047F, 0x3333), profile, link)
    assert all_units.hex() == "020e200006ffff00000000047f333351"
    assert uss.reply_size(all_units[:2]) == len(all_units)
    assert uss.reply_size(b"\x02") is None
    assert error(uss.broadcast, (6, 0, 0), (1, 2), profile, link).status == "bad_link"
    assert error(uss.broadcast, (6, 0, 0, 0), (1,), profile, link).status == "bad_link"
    assert error(uss.broadcast, (6, 0, 0, 0x10000), (1, 2), profile, link).status == "bad_value"


def test_the_example_of_the_class_says_what_a_link_is(package: Any, uss: Any) -> None:
    for kind in (package.SampleUss, package.SampleUssAsync):
        said = [line.strip() for line in kind.__doc__.splitlines()]
        assert "from fieldscribe_runtime.uss import Link" in said
        [made] = [line for line in said if line.startswith(f"drive = {kind.__name__}(")]
        link = eval(made[made.index("Link(") : made.index(")") + 1], {"Link": uss.Link})
        assert kind(UssDrive(), 3, link).link == link


def test_single_words_first(package: Any, uss: Any) -> None:
    profile, request = package.SampleUss.PROFILE, uss.Request(3, 2, 700, 0, 1, 5)
    assert uss.build(request, profile, uss.Link(4, 0)).hex()[6:-2] == "22bc000000000005"
    assert uss.build(request, profile, uss.Link(4, 0, single_first=True)).hex()[6:-2] == "22bc000000050000"
    assert uss.build(request, profile, uss.Link(3, 0)).hex()[6:-2] == "22bc00000005"


def test_async_twin(package: Any, uss: Any, line: UssDrive) -> None:
    async def work() -> tuple[Any, ...]:
        drive = package.SampleUssAsync(AsyncUssDrive(line), 3, uss.Link(4, 2))
        await drive.maximum_frequency.write(40.0, keep=True)
        await drive.unlock.write_raw(5, keep=True)
        await drive.control_word.write_raw(0x0400)
        await drive.write_at("parameter", 700, 3)
        both = await asyncio.gather(drive.maximum_frequency.read(), drive.command_source.read())
        line.refuses[52] = 0
        refused: Any = (await asyncio.gather(drive.drive_status.read(), return_exceptions=True))[0]
        return (*both, await drive.read_at("parameter", 700), refused.status)

    assert asyncio.run(work()) == (40.0, 3, (3,), "refused")
    assert line.eeprom == {(1082, 0): f32(40.0), (900, 0): (5,)}


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


def test_types_are_strict_and_reject_misuse(folder: Path, tmp_path: Path) -> None:
    assert typed_findings(TYPED, folder, "sample_uss", tmp_path) == ""
