"""Generated Python for CAN devices: parameters, texts, digits, telegrams, and every way in which that can fail."""

from __future__ import annotations

import importlib
import sys
from functools import partial
from typing import TYPE_CHECKING, Any

import pytest
from fieldscribe.conversation.decoder import decode
from fieldscribe.families.can.frames import CanFrame, parse
from fieldscribe.families.frame_results import Options
from support import wrong_bytes
from support.described import made
from support.python_families import CanUnit, can_device
from support.python_package import error, imported, typed_findings, write_package

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


def test_bits_keep_their_neighbours_and_constants(mpu: Any, package: Any, unit: CanUnit) -> None:
    unit.parameters[19] = 0x3FF6
    mpu.controller.write(package.Switch.ON)
    assert unit.parameters[19] == 0xFFF6
    mpu.slow_ramp.write(True)
    assert unit.parameters[19] == 0xFF0F
    assert mpu.controller.read() is package.Switch.ON
    unit.parameters[19] = 0x4000
    assert mpu.controller.read() == 1  # an undefined pattern survives


def test_constant_bits_of_whole_words(mpu: Any, package: Any, unit: CanUnit) -> None:
    mpu.command_word.write(package.CommandWord.START)
    assert unit.parameters[30] == 0x0406 | 1 & ~0x040F
    assert error(mpu.command_word.write_raw, 1).status == "out_of_range"
    mpu.command_word.write_raw(0x8406)
    assert mpu.command_number.encode(5) == 0x8005
    assert error(mpu.command_number.encode, 0x100).status == "out_of_range"
    assert error(mpu.command_number.check, 5).status == "out_of_range"
    assert mpu.command_number.decode(5) == 5


def test_texts(mpu: Any, unit: CanUnit) -> None:
    mpu.fault_text.write("Low oil")
    assert [unit.parameters[address] for address in (739, 738, 737, 736)] == [0x4C6F, 0x7720, 0x6F69, 0x6C20]
    assert mpu.fault_text.read() == "Low oil"
    unit.parameters.update({740: 0xFF80, 741: 0x0020})
    assert mpu.label.read() == "ÿ\x80\x00"
    mpu.label.write("Ölä")
    assert mpu.label.read() == "Ölä"
    for point, value in (("fault_text", "123456789"), ("fault_text", "Öl"), ("fault_text", "\n"), ("label", "€")):
        assert error(getattr(mpu, point).write, value).status == "out_of_range"
    message = str(error(mpu.fault_text.write, "much too long"))
    assert message == "fault_text: much too long is no text of at most 8 printable ascii characters"
    assert error(mpu.fault_text.write, 5).status == "out_of_range"
    assert error(mpu.fault_text.write_raw, 0).status == "out_of_range"
    assert type(mpu).fault_text.encode("") == 0x2020202020202020
    mpu.fault_text.write_raw(0x4142434445464748)
    assert mpu.fault_text.read() == "ABCDEFGH"
    for raw in (-1, 1 << 64, 0x2020202020202020 | 1 << 64, 0x2020202020202000):
        assert error(mpu.fault_text.check, raw).status == "out_of_range"


def test_digits(mpu: Any, package: Any, unit: CanUnit) -> None:
    unit.parameters[404] = 1257
    assert mpu.delays.read() == (1, 2, 5, 7)
    assert mpu.delays.read()[0] is package.Delay.STEP_1
    mpu.delays.write((5, package.Delay.STEP_0, 1, 2))
    assert unit.parameters[404] == 5012
    assert type(mpu).delays.decode(12345) == (12, 3, 4, 5)
    assert error(mpu.delays.write, (1, 2, 3, 5)).status == "unknown_value"
    assert error(mpu.delays.write, (1, 2, package.Switch.OFF, 5)).status == "unknown_value"
    assert error(mpu.delays.write, (1, 2)).status == "wrong_length"
    assert str(error(mpu.delays.write, None)) == "delays: takes 4 digits, not None"
    assert error(mpu.delays.write, (1, 2, True, 5)).status == "wrong_type"
    assert error(mpu.delays.check, 1234).status == "unknown_value"
    assert mpu.delays.name_of(5) == "step_5"
    unit.parameters[404] = 1
    assert mpu.read_many(["delays", "fault_text"]) == {"delays": (0, 0, 0, 1), "fault_text": "\0" * 8}


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


def test_another_answer_is_told_in_the_form_of_the_point(mpu: Any, unit: CanUnit) -> None:
    unit.parameters[507], unit.most[510], unit.most[737] = 200, 5, 1
    failure = error(mpu.voltage_setpoint.write, 100.0)
    assert str(failure) == "voltage_setpoint: 100 V was written, and the device answered 10 V"
    failure = error(mpu.voltage_setpoint.write_raw, 6)
    assert str(failure) == "voltage_setpoint: raw 6 was written, and the device answered raw 5"
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
