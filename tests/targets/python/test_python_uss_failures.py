"""USS devices in Python when the line fails: what is repeated, what is not, and what a bad answer is."""

from __future__ import annotations

import asyncio
import random
import struct
import sys
from contextlib import suppress
from typing import TYPE_CHECKING, Any

import pytest
from support.python_families import AsyncUssDrive, UssDrive, uss_device
from support.python_package import error, imported, write_package

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


def lost(reply: bytes) -> bytes:
    """The drive has taken the telegram, but its answer does not come."""
    raise TimeoutError


def broken(reply: bytes) -> bytes:
    """An answer with a wrong check."""
    return reply[:-1] + b"\xff"


@pytest.mark.parametrize("failure", [lost, broken])
@pytest.mark.parametrize(("before", "after"), [(0x0401, 0x0400), (0x0400, 0x0401)])
def test_after_a_failure_no_command_is_repeated(
    drive: Any, line: UssDrive, failure: Any, before: int, after: int
) -> None:
    drive.control_word.write_raw(before)
    line.change = failure
    assert error(drive.control_word.write_raw, after).status in ("timeout", "wrong_check")
    assert line.task == (after, 0)
    line.change = bytes
    assert drive.drive_status.read() == 0
    assert line.task == (0, 0)  # neither the new command nor the old one
    drive.status_word.read()
    assert line.task == (0, 0)
    drive.control_word.write_raw(before)
    drive.drive_status.read()
    assert line.task == (before, 0)


def test_what_was_not_sent_changes_nothing(drive: Any, line: UssDrive) -> None:
    drive.control_word.write_raw(0x0401)
    for failure in (
        error(drive.write_at, "task", 0, 0x10000),
        error(drive.jog.write, 1),
        error(drive.write_at, "task", 0, 1, 2, 3),
        error(drive.write_at, "task", 0),
    ):
        assert failure.status in ("bad_value", "bad_link", "bad_count")
    line.change = lost
    assert error(drive.drive_status.read).status == "timeout"  # no word was changed
    line.change = bytes
    drive.drive_status.read()
    assert line.task == (0x0401, 0)


def test_a_cancelled_command_is_not_repeated(package: Any, uss: Any, line: UssDrive) -> None:
    class Slow(AsyncUssDrive):
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


def test_writes_are_held_against_the_answer(drive: Any, package: Any, uss: Any, line: UssDrive) -> None:
    line.keeps = {700: (0,), 1082: f32(40.0), 800: (0xFF00,)}
    failure = error(drive.command_source.write, 4)
    assert (failure.status, failure.written, failure.answered) == ("echo_mismatch", (4,), (0,))
    assert str(failure) == "P0700 command_source: 4 was written, and the device answered 0"
    assert isinstance(failure, sys.modules["fieldscribe_runtime"].EchoError)
    assert isinstance(failure, sys.modules["fieldscribe_runtime"].FrameError)
    failure = error(drive.maximum_frequency.write, 40.25)  # it took effect, but rounded
    assert str(failure) == "maximum_frequency: 40.25 Hz was written, and the device answered 40 Hz"
    assert failure.answered == f32(40.0)
    drive.maximum_frequency.write(40.0)
    line.keeps[1082] = f32(0.0)
    drive.maximum_frequency.write(-0.0)  # the same number
    assert str(error(drive.mode.write, 3)) == "mode: 48 was written to 800, and the device answered 65280"
    assert str(error(drive.write_at, "parameter", 700, 5)) == "5 was written to 700, and the device answered 0"


def test_a_task_is_repeated_until_it_is_answered(drive: Any, line: UssDrive) -> None:
    line.ram[700, 0], line.late = (2,), 3
    assert drive.command_source.read() == 2
    assert len(line.log) == 4
    assert len(set(line.log)) == 1
    line.late = 3
    drive.command_source.write(3)
    assert line.ram[700, 0] == (3,)
    line.late, drive.repeats = 3, 2
    assert error(drive.command_source.read).status == "no_answer"


def changed(at: int, bits: int) -> Any:
    """A reply with some bits of a byte turned, and the right check."""

    def change(reply: bytes) -> bytes:
        data = bytearray(reply)
        data[at] ^= bits
        data[-1] ^= bits
        return bytes(data)

    return change


@pytest.mark.parametrize(
    ("change", "status"),
    [
        (lambda reply: b"", "wrong_start"),
        (lambda reply: b"\x03" + reply[1:], "wrong_start"),
        (lambda reply: reply[:-1], "wrong_length"),
        (lambda reply: reply + b"\0", "wrong_length"),
        (lambda reply: reply[:-1] + b"\xff", "wrong_check"),
        (changed(2, 1), "wrong_unit"),
        (changed(4, 1), "wrong_parameter"),
        (changed(3, 0x08), "wrong_parameter"),
        (changed(6, 1), "wrong_parameter"),
        (changed(3, 0x10), "no_answer"),
        (changed(3, 0x90), "no_rights"),
        (changed(3, 0x20), "wrong_response"),
    ],
)
def test_bad_replies(drive: Any, line: UssDrive, change: Any, status: str) -> None:
    line.change = change
    assert error(drive.command_source.read).status == status
    line.change = bytes
    assert drive.command_source.read() == 0


def test_other_failures(drive: Any, package: Any, uss: Any, line: UssDrive) -> None:
    line.refuses[700] = 17
    failure = error(drive.command_source.write, 1)
    assert (failure.status, failure.code, failure.name) == ("refused", 17, "not_now")
    assert str(failure) == "P0700 command_source: the device refused the task: error 17 (not_now)"
    line.ram[1082, 0] = (5,)
    assert error(drive.maximum_frequency.read).status == "wrong_length"  # one word where two belong

    def silent(reply: bytes) -> bytes:
        raise TimeoutError("no reply within 1 s")

    line.change = silent
    failure = error(drive.drive_status.read)
    assert (failure.status, str(failure)) == ("timeout", "drive_status: unit 3 did not reply to task 1 for 52")
    assert isinstance(failure, TimeoutError)
    line.change = bytes
    assert error(package.SampleUss, line, 32, uss.Link(4, 2)).status == "bad_unit"
    for link in ((5, 2), (4, 5)):
        assert error(package.SampleUss, line, 3, uss.Link(*link)).status == "bad_link"
    short = package.SampleUss(UssDrive(3, 0), 3, uss.Link(3, 0))
    assert error(short.maximum_frequency.write, 1.0).status == "bad_value"
    none = package.SampleUss(UssDrive(0, 2), 3, uss.Link(0, 2))
    assert error(none.command_source.read).status == "bad_task"
    assert none.status_word.read() == 0
    assert error(drive.read_at, "holding", 1).status == "bad_space"
    assert error(drive.write_at, "parameter", 1, 1, 2, 3).status == "bad_value"
    assert error(drive.read_at, "parameter", 32000).status == "bad_parameter"
    assert error(drive.read_at, "parameter", 1, 256).status == "bad_index"


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
