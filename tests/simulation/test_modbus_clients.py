"""The five Modbus devices, simulated: every point by pymodbus and by the generated client, over TCP and a pty."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pytest
from fieldscribe.families.modbus import SPACES, profile_of
from fieldscribe.model import Point
from fieldscribe.simulation import Simulated, simulated
from pymodbus import FramerType
from pymodbus.client import ModbusSerialClient, ModbusTcpClient
from support.places import ROOT
from support.python_package import imported
from support.python_transports import behind_a_gateway, transport

DEVICES = {
    "eastron_sdm630": "EastronSdm630",
    "fronius_datamanager": "FroniusDatamanager",
    "hitachi_l200": "HitachiL200",
    "jumo_controller": "JumoController",
    "nord_sk5xxe": "NordSk5xxe",
}
LINES = ("tcp", "serial")


@contextmanager
def foreign(device: Simulated) -> Iterator[Any]:
    """A client of pymodbus on the line of a device."""
    client: Any = (
        ModbusTcpClient("127.0.0.1", port=device.port)
        if device.port
        else ModbusSerialClient(device.path, framer=FramerType.RTU)
    )
    assert client.connect()
    try:
        yield client
    finally:
        client.close()


@contextmanager
def own(device: Simulated, timeout: float = 1.0) -> Iterator[Any]:
    """The generated device on the line of a simulated one."""
    name = device.device.device.id
    for package in imported(ROOT / "generated/python", name):
        line: Any = (
            transport("tcp").TcpLine("127.0.0.1", device.port, timeout=timeout)
            if device.port
            else transport("serial").SerialLine(device.path, 19200, timeout=timeout)
        )
        with line:
            yield behind_a_gateway(getattr(package, DEVICES[name]))(
                line, unit=device.unit, **device.device.layout.variants
            )


def registers(reply: Any, point: Point) -> list[int]:
    """The words, or the bit, in a reply of pymodbus."""
    assert not reply.isError(), (point.name, reply)
    return [int(reply.bits[0])] if SPACES[point.space].read in (1, 2) else list(reply.registers)


def existing(device: Simulated) -> list[Point]:
    memory, layout = device.device.memory, device.device.layout
    return [point for point in layout.points.values() if point.place.addresses and memory.exists(point)]


@pytest.mark.full(seconds=6)
@pytest.mark.parametrize("on", LINES)
@pytest.mark.parametrize("name", DEVICES)
def test_pymodbus_reads_every_point_and_is_refused_what_the_manual_refuses(name: str, on: str) -> None:
    with simulated(name, on=on) as device, foreign(device) as client:
        layout, memory = device.device.layout, device.device.memory
        read = {"coil": client.read_coils, "discrete": client.read_discrete_inputs}
        read |= {"holding": client.read_holding_registers, "input": client.read_input_registers}
        points = existing(device)
        for point in points:
            cells = layout.cells[point.name]
            reply = read[point.space](min(cells.addresses), count=len(cells.addresses), device_id=device.unit)
            if point.access == "w":
                assert reply.isError()
                continue
            words = dict(zip(sorted(cells.addresses), registers(reply, point), strict=True))
            assert words == {address: memory.areas[cells.area][address] for address in cells.addresses}
        assert device.requests == len(points)
        profile = profile_of(device.device.device.bus)
        codes = {exception.number for exception in device.device.device.bus.exceptions} or {1, 2, 3, 4}
        space, most = points[-1].space, profile.most[SPACES[points[-1].space].read]
        first = layout.cells[points[-1].name].addresses[0]
        for address, count in ((first, min(most + 1, 125)), (0xFFF0, 1), (0xFFFF, 2)):
            reply = read[space](address, count=count, device_id=device.unit)
            assert reply.isError(), (address, count)
            assert reply.exception_code in codes


@pytest.mark.full(seconds=10)
@pytest.mark.parametrize("on", LINES)
@pytest.mark.parametrize("name", DEVICES)
def test_the_generated_client_reads_and_writes_every_point(name: str, on: str) -> None:
    with simulated(name, on=on, strict=True) as device, own(device) as client:
        memory, wrong = device.device.memory, []
        for point in existing(device):
            if not point.generated or not (point.readable or point.writable):
                continue
            bound = client.point(point.name)
            before = memory.raw(point.name)
            if point.readable and point.text is None and bound.read_raw() != before:
                wrong.append(point.name)
            if point.readable:
                bound.read()
            if point.writable and point.text is None:
                bound.write_raw(before)
                assert memory.raw(point.name) == before
        assert wrong == []
        for group in client.GROUPS:
            if any(point.readable and point.generated and point.group == group for point in existing(device)):
                assert client.read_many(group, errors="return")


LOST = {"timeout", "wrong_transaction", "bad_protocol", "long_frame", "short_frame", "wrong_unit", "wrong_function"}
LOST |= {"bad_byte_count", "bad_crc"}
SIZES = {"tcp": 11, "serial": 7}


@pytest.mark.full(seconds=30)
@pytest.mark.parametrize("on", LINES)
def test_each_fault_at_each_byte_is_the_right_error_and_the_next_request_works(on: str) -> None:
    whole = {"silent": "timeout", "late 0.3": "timeout", "exception": "exception", "doubled": "ok"}
    whole |= {"check": "wrong_transaction" if on == "tcp" else "bad_crc", "unit": "wrong_unit"}
    whole |= {"function": "wrong_function" if on == "tcp" else "timeout"}
    places = [f"{kind} {at}" for kind in ("cut", "damaged", "noise", "drop") for at in range(SIZES[on])]
    with simulated("hitachi_l200", on=on) as device, own(device, 0.1) as client:
        for fault in (*whole, *places):
            device.fault(f"{fault} x1")
            status, value = "ok", None
            try:
                value = client.base_frequency.read()
            except Exception as error:  # of this copy of the runtime
                status = getattr(error, "status", repr(error))
            kind, _, at = fault.partition(" ")
            if fault in whole:
                assert status == whole[fault], fault
            elif kind == "cut" or (kind == "drop" and on == "serial"):
                assert status == "timeout", fault
            elif kind == "drop":
                assert status == "line", fault
            elif on == "tcp" and int(at) > 8:  # no checksum guards the number itself
                assert (status, kind) == ("ok", kind), fault
                assert value != 50
            else:
                assert status in LOST, fault
            assert client.base_frequency.read() == 50, fault
