"""Generated Python for CAN devices: parameters, texts, digits, telegrams, and every way in which that can fail."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.conversation.decoder import decode
from fieldscribe.families.can.frames import CanFrame, parse
from fieldscribe.families.frame_results import FrameResult, Options
from fieldscribe.model import Message
from support import wrong_bytes
from support.described import made
from support.python_families import CanUnit, can_device
from support.python_package import error, imported, typed_findings, write_package


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


def test_a_frame_of_a_telegram_is_checked_byte_for_byte(kitchen_package: Any) -> None:
    """Constant, unit and checksum of a cyclic message count as they do in an answer."""
    can = importlib.import_module("fieldscribe_runtime.can")
    profile = kitchen_package.KitchenCan.PROFILE
    heartbeat = profile.message("heartbeat")
    receiver = can.Receiver(profile, "heartbeat", wrong_bytes.UNIT)
    frame = partial(can.Frame, wrong_bytes.IDENTIFIER + wrong_bytes.UNIT)
    for reason, data in wrong_bytes.cases():
        assert not receiver.take(frame(data)), reason
        assert error(can.parse, heartbeat, wrong_bytes.UNIT, frame(data)).status == reason
        assert parse(described("heartbeat"), wrong_bytes.UNIT, CanFrame(0x705, data)).status == reason
        assert hear_kitchen(f"705#{data.hex()}").faults, reason
    assert not hear_kitchen(f"705#{wrong_bytes.RIGHT.hex()}").faults
    assert receiver.take(frame(wrong_bytes.RIGHT))
    assert receiver.word(0) == 0x1234


def test_a_unit_of_two_bytes_has_its_high_byte_first(kitchen_package: Any) -> None:
    can = importlib.import_module("fieldscribe_runtime.can")
    profile = kitchen_package.KitchenCan.PROFILE
    stop = profile.message("stop")
    assert can.build(stop, profile, 5).data == bytes((1, 0, 5, 0, 0, 0, 0, 0))
    assert can.parse(stop, 5, can.Frame(0x7FF, bytes((1, 0, 5, 0, 0, 0, 0, 0)))) == (0, 0)
    assert error(can.parse, stop, 5, can.Frame(0x7FF, bytes((1, 5, 5, 0, 0, 0, 0, 0)))).status == "wrong_unit"


def test_units_that_the_device_cannot_have_are_refused(kitchen_package: Any) -> None:
    can = importlib.import_module("fieldscribe_runtime.can")
    profile = kitchen_package.KitchenCan.PROFILE
    for unit in (0, 31, 256, "5"):
        assert error(can.Receiver, profile, "heartbeat", unit).status == "bad_unit"
        assert error(kitchen_package.KitchenCan, CanUnit(can.Frame, 1), unit).status == "bad_unit"
    data = bytes((5, 31, 0, 0, 0, 0, 5, 31))
    assert hear_kitchen(f"71F#{data.hex()}").kind == "other"


def described(name: str) -> Message:
    """A message as the compiler knows it."""
    return next(one for one in made("kitchen_can").messages if one.name == name)


def hear_kitchen(text: str) -> FrameResult:
    """What the command line makes of a frame."""
    return decode(made("kitchen_can"), {}, [text], Options())[0]


def test_points_of_other_variants(package: Any, unit: CanUnit) -> None:
    small = package.SampleCan(unit, 5, size="small")
    assert str(error(getattr, small, "spare")) == "spare exists only for size large"
    unit.parameters[507] = 100
    assert "spare" not in small.read_many("main")
    assert len(unit.log) == len(set(unit.log))  # a word that points share is read once
    assert package.SampleCan(unit, 5, size="large").spare.read() == 0
    assert package.SampleCan(unit, 5).spare.read() == 0
    assert package.SampleCan.spare.facts.only_for == ("size", ("large",))


def test_telegrams_are_listened_to(mpu: Any, unit: CanUnit) -> None:
    unit.waiting = [unit.words(1, 7), unit.words(0, 5000, 25, 0x0200), unit.words(3, 1, 2)]
    assert mpu.frequency.read() == 50.0
    assert mpu.power.read() == 2500.0
    assert len(unit.waiting) == 1
    assert mpu.starts.read() == 1 << 16 | 2
    assert not unit.log
    assert mpu.take(unit.words(0, 100)) is True
    assert mpu.take(unit.frame(0x321, b"")) is False
    assert mpu.read_many(["frequency", "power_exponent"]) == {"frequency": 1.0, "power_exponent": 0}
    assert not hasattr(mpu.frequency, "write")


def test_a_point_without_value_leaves_the_others_of_its_frame(can: Any, package: Any, unit: CanUnit) -> None:
    decoder = can.Decoder(package.SampleCan, "measurements", 5)
    assert decoder.decode(unit.words(0, 5000, 25, 0x7F00)) == {"frequency": 50.0, "power_exponent": 127}
    assert {name: error.status for name, error in decoder.errors.items()} == {"power": "overflow"}
    assert decoder.decode(unit.words(0, 5000, 25, 0x0200))["power"] == 2500.0
    assert not decoder.errors
    with pytest.raises(TypeError):
        decoder.decode(unit.words(0, 5000, 25, 0x0200), raws=5)


def test_a_word_that_nobody_sends_is_the_error_of_its_point(mpu: Any, unit: CanUnit) -> None:
    unit.waiting = [unit.words(0, 5000, 25, 0x0200)]
    values = mpu.read_many(["starts", "frequency"], errors="return")
    assert (values["frequency"], values["starts"].status) == (50.0, "timeout")
    mpu.fresh_for = 0
    assert error(mpu.read_many, ["starts", "frequency"], errors="return").status == "timeout"  # nothing is sent at all


def test_another_answer_is_told_in_the_form_of_the_point(mpu: Any, unit: CanUnit) -> None:
    unit.parameters[507], unit.most[510], unit.most[737] = 200, 5, 1
    failure = error(mpu.voltage_setpoint.write, 100.0)
    assert str(failure) == "voltage_setpoint: 100 V was written, but the device answered 10 V"
    failure = error(mpu.voltage_setpoint.write_raw, 6)
    assert str(failure) == "voltage_setpoint: raw 6 was written, but the device answered raw 5"
    failure = error(mpu.fault_text.write, "Low oil")
    assert (failure.status, failure.point, failure.answered) == ("echo_mismatch", "fault_text", (1,))


TYPED = """
from collections.abc import Sequence
from typing import assert_type
from sample_can import CommandWord, Delay, SampleCan, SampleCanAsync, Switch
from fieldscribe_runtime import Layout, Value
from fieldscribe_runtime.can import CanTransport, Decoder, Frame

class Silent:
    def send(self, frame: Frame) -> None: ...
    def receive(self) -> Frame:
        raise TimeoutError

def use(transport: CanTransport) -> None:
    mpu = SampleCan(transport, 5, voltage="400V")
    assert_type(mpu.fault_text.read(), str)
    mpu.fault_text.write("Oil")
    assert_type(mpu.delays.read(), tuple[Delay, ...])
    mpu.delays.write((Delay(1), Delay.STEP_2, Delay(5), Delay(0)))
    mpu.delays.write((1, Delay.STEP_2, 5, 0))  # E: arg-type
    assert_type(Decoder(SampleCan, "measurements", 5).decode(Frame(0x325, bytes(8))), dict[str, Value])
    assert_type(SampleCan.layouts("measurements"), tuple[Layout, ...])
    assert_type(mpu.level.read(), int)
    assert_type(mpu.frequency.read(), float)
    assert_type(mpu.take(Frame(0x325, bytes(8))), bool)
    mpu.controller.write(Switch.ON)
    mpu.command_word.write(CommandWord.of())
    CommandWord.of(start=True)  # E: call-arg
    mpu.frequency.write(5.0)  # E: attr-defined
    mpu.fault_text.write(5)  # E: arg-type
    mpu.fault_text.write("Oil", keep=True)  # E: call-arg
    SampleCan(transport, 5, voltage="200V")  # E: arg-type
    SampleCan(Silent(), 5)

async def use_async(mpu: SampleCanAsync) -> None:
    assert_type(await mpu.fault_text.read(), str)
    assert_type(await mpu.level.read(), int)
"""


@pytest.mark.full
def test_types_are_strict_and_reject_misuse(folder: Path, tmp_path: Path) -> None:
    assert typed_findings(TYPED, folder, "sample_can", tmp_path) == ""


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
