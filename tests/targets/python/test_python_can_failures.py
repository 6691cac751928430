"""CAN devices in Python when answers are late, wrong or missing."""

from __future__ import annotations

import asyncio
import sys
from typing import TYPE_CHECKING, Any

import pytest
from fieldscribe.conversation.decoder import decode
from fieldscribe.user_errors import Options
from support.described import made
from support.python_families import AsyncCanUnit, CanUnit, can_device
from support.python_package import error, imported, write_package

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from fieldscribe.families.frame_results import FrameResult
    from fieldscribe.model import Message


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_package(can_device(), tmp_path_factory.mktemp("can"))


@pytest.fixture(scope="module")
def package(folder: Path) -> Iterator[Any]:
    yield from imported(folder, "sample_can")


@pytest.fixture
def can(package: Any) -> Any:
    return sys.modules["fieldscribe_runtime.can"]


@pytest.fixture
def unit(can: Any) -> CanUnit:
    return CanUnit(can.Frame, 5)


@pytest.fixture
def mpu(package: Any, unit: CanUnit) -> Any:
    return package.SampleCan(unit, 5, voltage="400V")


@pytest.fixture(scope="module")
def kitchen_package(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Any]:
    folder = write_package(made("kitchen_can"), tmp_path_factory.mktemp("kitchen"))
    yield from imported(folder, "kitchen_can")


def described(name: str) -> Message:
    """A message as the compiler knows it."""
    return next(one for one in made("kitchen_can").messages if one.name == name)


def hear_kitchen(text: str) -> FrameResult:
    """What the command line makes of a frame."""
    return decode(made("kitchen_can"), {}, [text], Options())[0]


def test_failures_say_what_they_are(mpu: Any, package: Any, unit: CanUnit) -> None:
    unit.silent = True
    failure = error(mpu.transformer.read)
    assert (failure.status, str(failure)) == ("timeout", "transformer: read_answer for 508 did not come")
    assert isinstance(failure, TimeoutError)
    unit.silent = False
    unit.spoils = 1
    failure = error(mpu.transformer.read)
    assert (failure.status, failure.__cause__.status) == ("timeout", "wrong_check")
    assert mpu.transformer.read() == 0  # and the device goes on
    unit.most[508] = 9
    failure = error(mpu.transformer.write, 10)
    assert (failure.status, failure.written, failure.answered) == ("echo_mismatch", (10,), (9,))
    assert str(failure) == "transformer: 10 was written, and the device answered 9"
    unit.parameters[507], unit.most[510] = 200, 5
    failure = error(mpu.voltage_setpoint.write, 100.0)
    assert str(failure) == "voltage_setpoint: 100 V was written, and the device answered 10 V"
    failure = error(mpu.voltage_setpoint.write_raw, 6)
    assert str(failure) == "voltage_setpoint: raw 6 was written, and the device answered raw 5"
    unit.most[19] = 0x00FF
    assert error(mpu.controller.write, 3).status == "echo_mismatch"
    unit.most[737] = 1
    failure = error(mpu.fault_text.write, "Low oil")
    assert (failure.status, failure.point, failure.answered) == ("echo_mismatch", "fault_text", (1,))
    assert error(mpu.frequency.read).status == "timeout"
    assert error(package.SampleCan, unit, 31).status == "bad_unit"
    mpu.patience = -1.0
    failure = error(mpu.transformer.read)
    text = "transformer: read_answer for 508 did not come within -1 s"
    assert (failure.status, str(failure)) == ("timeout", text)


class LateUnit(CanUnit):
    """A unit whose answers come only after the master gave up, while `late`."""

    late: Any = None

    def receive(self) -> Any:
        """The next frame, unless it is held back."""
        if self.late is not None:
            self.late += self.waiting
            self.waiting = []
        return super().receive()


class WaitingUnit(CanUnit):
    """A unit behind a transport that tells what has come already."""

    def receive_waiting(self) -> Any:
        """The next frame that is there."""
        return self.waiting.pop(0) if self.waiting else None


def test_late_answers_are_no_answers(package: Any, can: Any) -> None:
    unit = LateUnit(can.Frame, 5)
    mpu = package.SampleCan(unit, 5)
    unit.parameters[508], unit.late = 3, []
    assert error(mpu.transformer.read).status == "timeout"
    (unit.waiting, unit.late), unit.parameters[508] = (unit.late, None), 4
    unit.waiting.append(unit.words(0, 5000))
    assert mpu.transformer.read() == 4
    assert mpu.frequency.read() == 50.0  # what else came meanwhile counts
    unit.late = []
    assert error(mpu.transformer.write, 7).status == "timeout"
    (unit.waiting, unit.late) = (unit.late, None)
    mpu.transformer.write(8)
    assert unit.parameters[508] == 8


def test_the_queue_is_cleared_before_a_request(package: Any, can: Any) -> None:
    unit = WaitingUnit(can.Frame, 5)
    mpu = package.SampleCan(unit, 5)
    assert isinstance(unit, can.WaitingCanTransport)
    unit.parameters[508] = 9
    unit.waiting = [can.Frame(0x325, bytes.fromhex("ff0501fc0001fef8")), unit.words(0, 4000)]
    assert can.parse(mpu.PROFILE.message("read_answer"), 5, unit.waiting[0]) == (508, 1)
    assert mpu.transformer.read() == 9
    assert mpu.frequency.read() == 40.0

    class AsyncWaitingUnit(AsyncCanUnit):
        def receive_waiting(self) -> Any:
            return unit.receive_waiting()

    async def work() -> Any:
        unit.waiting = [can.Frame(0x325, bytes.fromhex("ff0501fc0001fef8"))]
        return await package.SampleCanAsync(AsyncWaitingUnit(unit), 5).transformer.read()

    assert asyncio.run(work()) == 9


def test_any_bytes_are_safe(can: Any, package: Any) -> None:
    profile = package.SampleCan.PROFILE
    for message in profile.messages:
        for size in range(10):
            for byte in (0x00, 0xDD, 0xEE, 0xFF):
                frame = can.Frame(message.identifier(5), bytes((byte,)) * size)
                if (message.name, size, byte) == ("measurements", 8, 0xDD):
                    assert can.parse(message, 5, frame) == (0, 0)
                else:
                    failure = error(can.parse, message, 5, frame)
                    assert failure.status in ("wrong_length", "wrong_constant", "wrong_unit", "wrong_check")
