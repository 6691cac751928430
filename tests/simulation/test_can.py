"""Simulated CAN devices: each parameter and telegram value through the generated client and cantools, and refusals."""

from __future__ import annotations

import asyncio
import os
import random
import re
import select
import subprocess
import sys
import threading
import tty
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import can
import cantools
import pytest
from fieldscribe.diagnostics import UnclearError
from fieldscribe.families.can.dbc import export
from fieldscribe.families.can.simulation import core_of
from fieldscribe.simulation.bench import Bench, layout_of
from fieldscribe.simulation.device import Clock, SimulatedDevice
from fieldscribe.simulation.line import Fault
from fieldscribe.simulation.servers import serve, simulated
from support.places import PACKAGES, TESTS
from support.python_package import imported
from support.simulated_lines import DirectBus

VARIANT = "voltage=400V"
KITCHEN = str(TESTS / "devices/kitchen_can")
EXTENDED = 1 << 31


@pytest.fixture(scope="module")
def package() -> Iterator[Any]:
    """The generated package of the MPU2-S."""
    yield from imported(PACKAGES, "woodward_mpu2s")


def genset(unit: int = 3, **options: Any) -> SimulatedDevice:
    """An MPU2-S whose time stands."""
    return SimulatedDevice(layout_of("woodward_mpu2s", (VARIANT,)), unit, clock=Clock(0), **options)


def test_every_point(package: Any) -> None:
    """Each parameter is read, written and read again; each value of the telegram comes as the device holds it."""
    device = genset(seed=5)
    client = package.WoodwardMpu2s(DirectBus(device), device.unit, voltage="400V")
    seen = {"parameter": 0, "telegram": 0}
    for point in device.layout.points.values():
        if not point.generated or point.text is not None:
            continue
        handle, raw = getattr(client, point.name), device.memory.raw(point.name)
        assert handle.read_raw() == raw, point.name
        if point.writable and point.name != "password_level_2":
            other = next((new for new in (*point.outer, raw) if takes(device, point.name, new)), raw)
            handle.write_raw(other)
            assert device.memory.raw(point.name) == other, point.name
        seen[point.space] += 1
    assert seen["parameter"] > 150
    assert seen["telegram"] > 40
    client.fault_text_terminal_62.write("OIL PRESSURE")
    assert device.values["fault_text_terminal_62"] == client.fault_text_terminal_62.read() == "OIL PRESSURE"


def takes(device: SimulatedDevice, name: str, raw: int) -> bool:
    """Whether a point may be written so."""
    from fieldscribe.arithmetic import codec

    try:
        codec.check(device.layout.points[name], raw, device.memory.settings)
    except codec.CodecError:
        return False
    return True


def frames_of(core: Any, clock: Clock, count: int) -> list[bytes]:
    """So many frames that devices send by themselves."""
    frames: list[bytes] = []
    while len(frames) < count:
        sent, after = core.due(clock.now())
        frames += sent
        clock.advance(max(0.001, after - clock.now()))
    return frames


@pytest.mark.parametrize(("name", "unit", "count", "names"), [("woodward_mpu2s", 3, 23, 60), (KITCHEN, 5, 400, 30)])
def test_cantools_reads_what_is_sent(name: str, unit: int, count: int, names: int) -> None:
    """With the exported database: all parts of telegrams, signals and their pages, J1939, a frame of CAN FD."""
    device = SimulatedDevice(layout_of(name), unit, clock=Clock(0), seed=9)
    database = cantools.database.load_string(export(device.device, unit).decode("latin-1"), "dbc", strict=False)
    assert isinstance(database, cantools.database.can.Database)
    seen: dict[str, set[int]] = {}
    pages = {name for point in device.layout.points.values() for name in (point.when.names if point.when else ())}
    for frame in frames_of(core_of([device]), device.clock, count):
        number = int.from_bytes(frame[:4], "big")
        message = next(
            m
            for m in database.messages
            if m.frame_id == number & ~EXTENDED and m.is_extended_frame == bool(number & EXTENDED)
        )
        got = message.decode(frame[4:], decode_choices=False, scaling=False, allow_truncated=True)
        assert isinstance(got, dict)
        for signal, raw in got.items():
            point = device.layout.points.get(signal)
            base, _, half = signal.rpartition("_")
            if point is not None and signal not in pages and not point.info.floating:
                assert raw == device.memory.raw(signal), signal
            elif half in ("high", "low") and base in device.layout.points:
                word = device.memory.raw(base) >> (16 if half == "high" else 0) & 0xFFFF
                assert raw == word, signal
            seen.setdefault(signal, set()).add(int(raw))  # type: ignore[arg-type]  # a number: choices stay numbers
    assert len(seen) >= names
    assert all(len(seen[page]) > 1 for page in pages & {*seen})


def test_messages_of_the_master_are_taken() -> None:
    """The signals of a frame that cantools makes are what the device holds then; one out of range is not."""
    device = SimulatedDevice(layout_of(KITCHEN), 5, clock=Clock(0))
    database: Any = cantools.database.load_string(export(device.device, 5).decode("latin-1"), "dbc", strict=False)
    message = database.get_message_by_name("limits")
    core = core_of([device])
    for raws, expected in [((1234, 1, -7), (1234, 1, -7)), ((12000, 0, 21), (1234, 0, -7))]:
        signals = dict(zip(("speed_setpoint", "run_command", "trim_setpoint"), raws, strict=True))
        data = message.encode(signals, scaling=False, strict=False)
        answer = core.answer((message.frame_id | EXTENDED).to_bytes(4, "big") + data)
        assert answer is not None
        assert answer.data == b""
        assert bool(answer.refused) == (raws != expected)
        assert tuple(device.memory.raw(name) for name in signals) == expected


def test_refused_requests_stay_without_an_answer(package: Any) -> None:
    """An unknown parameter, a value out of range, a wrong checksum, another unit, no password: silence."""
    device = genset()
    client = package.WoodwardMpu2s(line := DirectBus(device), device.unit, voltage="400V")
    client.retries, client.patience = 0, 0.05
    sound = bytes.fromhex("0000033F FF03000B0000FCF4")  # 4.2.2 of the manual, for unit 3
    head, body = sound[:4], bytearray(sound[4:12])
    for place, byte in [(3, 0xEE), (7, 0), (1, 4)]:
        wrong = bytearray(body)
        wrong[place] = byte
        assert not [outcome for outcome in line.line.answer(head + bytes(wrong)) if outcome.data], place
    device.conditions["password"] = False
    with pytest.raises(Exception, match="answer"):
        client.generator_power_setpoint_1.write_raw(7)
    client.password_level_2.write_raw(device.memory.raw("password_level_2"))
    client.generator_power_setpoint_1.write_raw(7)
    assert device.values["generator_power_setpoint_1"] == 7


def test_each_fault_at_each_byte(package: Any) -> None:
    """A client never takes a spoiled answer for a good one, and its next request works."""
    device = genset()
    client = package.WoodwardMpu2s(line := DirectBus(device, silent=True), device.unit, voltage="400V")
    client.retries, client.patience = 0, 0.02
    device.memory.put("generator_rated_power", 200)
    places = [f"{kind} {at}" for kind in ("cut", "damaged", "noise") for at in range(12)]
    for fault in ("silent", "check", "unit", "function", *places):
        line.line.faults.waiting.append(Fault.of(f"{fault} x1"))
        with pytest.raises(Exception, match="answer"):
            client.generator_rated_power.read_raw()
        assert client.generator_rated_power.read_raw() == 200, fault


def test_any_frames_are_safe() -> None:
    """Random identifiers and data change nothing but what a whole request asks for."""
    dice, device = random.Random(3), genset(strict=True)
    core = core_of([device])
    for _ in range(20_000):
        identifier = dice.choice((0x33F, 0x323, dice.getrandbits(32)))
        core.answer(identifier.to_bytes(4, "big") + dice.randbytes(dice.randrange(9)))


def test_over_a_virtual_bus(package: Any) -> None:
    """A genset starts, synchronises and takes load, as its client sees it on a bus of python-can."""
    from fieldscribe_runtime.transports.can import CanLine

    with (
        simulated("woodward_mpu2s", variants=(VARIANT,), behaviour=True, time_scale=40.0) as served,
        CanLine(can.Bus("woodward_mpu2s", interface="virtual"), timeout=2.0) as line,
    ):
        client = package.WoodwardMpu2s(line, served.unit, voltage="400V")
        client.fresh_for = 0.0
        assert client.generator_state.read().name == "ABSENT"
        served.values.update({"run_engine": 1, "synchronise": 1, "breaker_enable": 1})
        client.generator_power_setpoint_1.write(90)
        served.advance(30)
        assert client.generator_frequency.read() == 50
        assert client.generator_active_power.read() == 90_000
        assert client.control_register_2.read().generator_breaker_closed


@pytest.mark.parametrize(("line", "options"), [({}, ""), ({"speed": 250000}, ", 'bitrate': 250000")])
def test_a_bus_without_a_speed_opens_at_what_python_can_is_set_up_for(
    line: dict[str, Any], options: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(channel: str, **given: Any) -> None:
        raise OSError(f"{channel} {given}")

    monkeypatch.setattr(can, "Bus", refuse)
    devices = [{"device": "woodward_mpu2s", "variant": {"voltage": "400V"}}]
    (made,) = Bench({"lines": [{"can": "pcan:one", "devices": devices, **line}]}).lines
    with pytest.raises(UnclearError, match=re.escape(f"one {{'interface': 'pcan'{options}}}")):
        asyncio.run(serve(made))


@pytest.mark.full(seconds=8)
def test_between_processes(package: Any) -> None:
    """`fieldscribe simulate --can` at one end of a serial line with slcan, the generated client at the other."""
    from fieldscribe_runtime.transports.can import CanLine

    with null_modem() as (ours, theirs):
        command = [sys.executable, "-m", "fieldscribe", "simulate", "woodward_mpu2s@7", "--can", f"slcan:{theirs}"]
        served = subprocess.Popen([*command, "--variant", VARIANT, "--still"], stdout=subprocess.PIPE, text=True)
        try:
            assert served.stdout is not None
            assert "answers as unit 7" in served.stdout.readline()
            with CanLine(can.Bus(ours, interface="slcan", sleep_after_open=0.1), timeout=5.0) as line:
                client = package.WoodwardMpu2s(line, 7, voltage="400V")
                client.generator_power_setpoint_1.write(-1234)
                assert client.generator_power_setpoint_1.read() == -1234
                assert client.battery_voltage.read() > 0
        finally:
            served.terminate()
            assert served.wait(10) == 0


@contextmanager
def null_modem() -> Iterator[tuple[str, str]]:
    """The names of two serial ports that are joined."""
    ends = [os.openpty(), os.openpty()]
    for end in ends:
        for descriptor in end:
            tty.setraw(descriptor)
    masters, done = [master for master, _ in ends], threading.Event()

    def carry() -> None:
        while not done.is_set():
            for master in select.select(masters, (), (), 0.05)[0]:
                os.write(masters[1 - masters.index(master)], os.read(master, 4096))

    thread = threading.Thread(target=carry)
    thread.start()
    try:
        yield os.ttyname(ends[0][1]), os.ttyname(ends[1][1])
    finally:
        done.set()
        thread.join()
        for end in ends:
            for descriptor in end:
                os.close(descriptor)
