"""Simulated USS devices: each parameter through the generated client, the manual's telegrams, refusals, broadcasts."""

from __future__ import annotations

import random
from collections.abc import Iterator
from typing import Any

import pytest
from fieldscribe.arithmetic.words import words_in
from fieldscribe.families.uss.simulation import core_of
from fieldscribe.families.uss.telegrams import Link, Request, broadcast, build, parse, telegram
from fieldscribe.simulation.bench import layout_of, rules_of
from fieldscribe.simulation.device import Clock, SimulatedDevice
from fieldscribe.simulation.line import Fault, Line, Stream
from fieldscribe.simulation.servers import simulated
from support.places import PACKAGES
from support.python_package import imported
from support.simulated_lines import direct_line

VARIANTS = ("model=mm440", "interface=rs485")
LINKS = [(127, 2), (4, 4), (3, 0)]


@pytest.fixture(scope="module")
def package() -> Iterator[Any]:
    """The generated package of the MICROMASTER 4."""
    yield from imported(PACKAGES, "siemens_mm4")


def inverter(unit: int = 1, **options: Any) -> SimulatedDevice:
    """A MICROMASTER 440 whose time stands."""
    return SimulatedDevice(layout_of("siemens_mm4", VARIANTS), unit, clock=Clock(0), **options)


def opened(package: Any, device: SimulatedDevice, pkw: int = 127, pzd: int = 2) -> Any:
    """The generated client of a device, over a link of these lengths."""
    device.values.update({"uss_pkw_length_index_0": pkw, "uss_pzd_length_index_0": pzd})
    return package.SiemensMm4(
        direct_line(device), device.unit, package_link(pkw, pzd), model="mm440", interface="rs485"
    )


def package_link(pkw: int, pzd: int) -> Any:
    """The setting of a link, for clients."""
    from fieldscribe_runtime.uss import Link as RuntimeLink

    return RuntimeLink(pkw, pzd)


@pytest.mark.parametrize(("pkw", "pzd"), LINKS)
def test_every_parameter(package: Any, pkw: int, pzd: int) -> None:
    """Each one is read as it is held, written to RAM and to EEPROM; what was not kept is lost at the next start."""
    device = inverter(seed=pkw)
    drive = opened(package, device, pkw, pzd)
    seen = 0
    for point in device.layout.points.values():
        if not point.generated or point.space != "parameter" or (point.words > 1 and pkw == 3):
            continue
        handle, held = getattr(drive, point.name), device.memory.raw(point.name)
        assert handle.read_raw() == held, point.name
        if point.writable and "length" not in point.name:
            handle.write_raw(held)
            other = min(max(held ^ 1, point.outer[0]), point.outer[1])
            handle.write_raw(other, keep=bool(seen % 2))
            assert device.memory.raw(point.name) == other
            device.restart()
            assert device.memory.raw(point.name) == (other if seen % 2 else held)
        seen += 1
    assert seen > (15 if pkw == 3 else 25)


def answered(device: SimulatedDevice, words: tuple[int, ...]) -> tuple[int, ...] | None:
    """The words of the answer to a telegram with these words; None for none."""
    answer = core_of([device]).answer(telegram(device.unit, words))
    return None if answer is None else words_in(answer.data[3:-1])


def test_telegrams_of_the_manual() -> None:
    """Each printed exchange: the device holds what it is about, and answers as printed."""
    device = inverter(rules=rules_of("siemens_mm4"))
    model = device.device
    frames = {frame.name: frame for frame in model.frames}
    exchanges = [(frames[reply.answers], reply) for reply in model.frames if reply.answers]
    for request, reply in exchanges:
        device.values["reference_frequency"] = 50.0
        pkw = getattr(request.family_facts, "pkw", None)
        device.values["uss_pkw_length_index_0"] = 127 if pkw is None else pkw
        device.conditions = dict.fromkeys(device.conditions, "running" not in reply.name)
        for name, raw in reply.meaning.items():
            if device.layout.points[name].space == "parameter":
                device.memory.put(name, raw)
        pzd = request.framing == "pzd"
        device.values["uss_pzd_length_index_0"] = len(request.corrected) // 2 if pzd else 0
        words = words_in(request.corrected)
        got = answered(device, (0, 0, 0, *words) if pzd else words)
        assert got is not None
        assert (got[3:] if pzd else got) == words_in(reply.corrected), reply.name
    assert len(exchanges) > 8


@pytest.mark.parametrize("to_all", [False, True])
def test_a_master_that_falls_silent(to_all: bool) -> None:
    """The drive trips when the off time has run out behind the last telegram that it takes, and never before one."""
    device = inverter(rules=rules_of("siemens_mm4"))
    core, quiet = core_of([device]), (0x047E, 0)
    device.values["uss_telegram_off_time_index_0"] = 500

    def passed(seconds: float) -> object:
        device.clock.advance(seconds)
        return device.values["ZSW"]

    def sent(words: tuple[int, ...]) -> None:
        core.answer(telegram(32 if to_all else device.unit, words))

    assert passed(9) == 0xFA31
    for _ in range(3):
        sent((6, 0xFFFF, 0, 0, *quiet) if to_all else (0, 0, 0, *quiet))
        assert passed(0.45) == 0xFA31
    sent((1, 2, 3))  # no telegram of this link
    assert passed(0.1) == 0xFA78
    device.values["uss_telegram_off_time_index_0"] = 0
    sent((6, 0xFFFF, 0, 0, 0x04FE, 0) if to_all else (0, 0, 0, 0x04FE, 0))
    assert passed(9) == 0xFA31


P1082, P0700, P2010, R0052, P0003 = 1082, 700, 2010, 52, 3
REFUSED = [
    ((1, 1999), 0),
    ((2, P1082, 0, 1, 5), 5),  # a word for a parameter of two
    ((3, P0700, 0, 2, 5), 5),
    ((2, R0052, 0, 1, 5), 1),
    ((6, P2010, 7), 3),
    ((7, P2010, 7, 1, 3), 3),
    ((6, P0700, 2), 4),
    ((2, 2009, 0, 1, 9), 104),  # 0 and 1 have names, others none
    ((14, 2013, 1, 1, 5), 104),
    ((2, 2012, 0, 1, 9), 2),
    ((5, P0700), 106),
    ((10, P0700), 106),
    ((15, P0700), 106),
    ((4, P0700), 0),
]


@pytest.mark.parametrize(("asked", "error"), REFUSED)
def test_refusals(asked: tuple[int, ...], error: int) -> None:
    """Each task that the device does not carry out has the error that the manual has for it."""
    device, link = inverter(), Link(127, 2)
    task, parameter, index, width, value = (*asked, 0, 0, 0)[:5]
    request = Request(device.unit, task, parameter, index, width, value, words=(0, 0))
    status, data = build(device.device.bus, link, request)
    answer = core_of([device]).answer(data)
    assert (status, answer is not None) == ("ok", True)
    assert answer is not None
    reply = parse(device.device.bus, link, request, answer.data)
    assert (reply.status, reply.error) == ("refused", error)
    assert answer.refused


def test_elements_and_their_number() -> None:
    """An element, all of them, and how many there are; a parameter that is no array has the elements 0 and 1."""
    device = inverter()
    device.memory.put("uss_baud_rate_index_0", 6)
    device.memory.put("uss_baud_rate_index_1", 9)
    for words, expected in [
        ((0x600A, 0x8001, 0, 0), (0x400A, 0x8001, 9)),
        ((0x600A, 0x80FF, 0, 0), (0x400A, 0x80FF, 6, 9)),
        ((0x900A, 0x8000, 0, 0), (0x600A, 0x8000, 2)),
        ((0x62BC, 0x0001, 0, 0), (0x42BC, 0x0001, device.memory.raw("command_source"))),
        ((0x18BC | 0x0200, 0, 0, 0), (0x12BC, 0, device.memory.raw("command_source"))),  # bit 11 is not supported
        ((0, 0, 0, 0), (0, 0, 0)),
        ((0x17FF, 0, 0, 0), (0x77FF, 0, 0)),  # a page has 2000 numbers
    ]:
        got = answered(device, (*words, 0x0400, 0))
        assert got is not None
        assert got[:-2] == expected, f"{words[0]:04X}"
    assert answered(device, (0x12BC, 0)) is None
    device.values["uss_pkw_length_index_0"] = 4
    assert answered(device, (0x12BC, 0, 0, 0x0400, 0)) is None, "not the length that is set"
    assert answered(device, (0x600A, 0x80FF, 0, 0, 0x0400, 0)) == (0x700A, 0x80FF, 3, 0, *device_answer(device))


def device_answer(device: SimulatedDevice) -> tuple[int, int]:
    """The first two words that the device sends."""
    return device.memory.raw("status_word"), device.memory.raw("main_actual_value")


def test_process_data_and_broadcast(package: Any) -> None:
    """A control word counts with its bit 10 alone; a broadcast changes what its masks select, on every unit."""
    units = [inverter(unit, rules=rules_of("siemens_mm4"), strict=True) for unit in (1, 2)]
    core = core_of(units)
    for device in units:
        core.answer(telegram(device.unit, (0, 0, 0, 0x047F, 0x4000)))
        device.clock.advance(2)
        assert device.values["main_actual_value"] == pytest.approx(10, abs=0.01)
    bus, link = units[0].device.bus, Link(127, 2)
    for mask, words, held in [
        ((0x0002, 0xFFFF, 0, 0), (0x047E, 0x1111), (0x047E, 0x4000)),
        ((0x0006, 0x0401, 0, 0), (0x0401, 0x2000), (0x047F, 0x2000)),
        ((0x0006, 0x0001, 0, 0), (0x0000, 0x1000), (0x047F, 0x1000)),  # bit 10 is not in the mask
        ((0x0006, 0xFFFF, 0, 0), (0x007E, 0x0800), (0x047F, 0x0800)),
    ]:
        status, data = broadcast(bus, link, mask, words)
        answer = core.answer(data)
        assert (status, answer is not None and answer.data) == ("ok", b"")
        assert [(d.memory.raw("control_word"), d.memory.raw("main_setpoint")) for d in units] == [held, held]
    assert {complaint.rule for complaint in units[1].complaints} == {"constant bits"}
    drive = opened(package, inverter(rules=rules_of("siemens_mm4")))
    assert drive.status_word.read() & 1


def test_each_fault_at_each_byte(package: Any) -> None:
    """A client never takes a spoiled answer for a good one, and its next request works."""
    device = inverter()
    drive = opened(package, device)
    device.memory.put("uss_baud_rate_index_0", 6)
    drive.retries = drive.repeats = 0
    places = [f"{kind} {at}" for kind in ("cut", "damaged", "noise") for at in range(14)]
    for fault in ("silent", "check", "unit", "function", "exception", *places):
        drive.transport.line.faults.waiting.append(Fault.of(f"{fault} x1"))
        with pytest.raises(Exception, match=r"reply|answer|refus|telegram|unit|byte|error"):
            drive.uss_baud_rate_index_0.read_raw()
        assert drive.uss_baud_rate_index_0.read_raw() == 6, fault


def test_any_bytes_are_safe() -> None:
    """Noise costs no telegram behind it; cut or wrong telegrams are not answered."""
    dice, device = random.Random(7), inverter()
    sound = telegram(1, (0x12BC, 0, 0, 0, 0x047E, 0))
    for _ in range(600):
        line = Stream(Line(core_of([device]), device.clock))
        noise = dice.randbytes(dice.randrange(40))
        data = bytearray(noise + sound)
        answers = [line.received(bytes((byte,))) for byte in data]
        assert sum(map(len, answers)) >= 1, noise
        data[dice.randrange(len(noise), len(data))] ^= 1 << dice.randrange(8)
        line.received(bytes(data))
        line.received(b"", quiet=True)
        assert line.received(sound)


def test_over_a_pseudo_terminal(package: Any) -> None:
    """The same over a serial line: it starts, ramps, trips and is reset, and a fault of the line is noticed."""
    from fieldscribe_runtime.transports.serial import UssLine

    with (
        simulated("siemens_mm4", on="serial", variants=VARIANTS, behaviour=True, time_scale=0) as served,
        UssLine(served.path, 9600, timeout=0.3) as line,
    ):
        drive = package.SiemensMm4(line, served.unit, package_link(127, 2), model="mm440", interface="rs485")
        drive.main_setpoint.write(40.0)
        drive.control_word.write_raw(0x047F)
        served.advance(4)
        assert drive.main_actual_value.read() == pytest.approx(20, abs=0.01)
        served.values["short_circuit"] = 1
        assert drive.status_word.read_raw() & 8
        served.values["short_circuit"] = 0
        drive.control_word.write_raw(0x04FE)
        assert drive.status_word.read_raw() == 0xFA31
        served.fault("check x1")
        drive.retries = 0
        with pytest.raises(Exception, match=r"no telegram|wrong|did not reply"):
            drive.status_word.read_raw()
        assert drive.status_word.read_raw() == 0xFA31
