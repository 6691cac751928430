"""Transports of the runtime against real ends: a server of pymodbus in the network and behind a serial line, a bus of
python-can, ends that fall silent."""

from __future__ import annotations

import asyncio
import importlib
import os
import socket
import threading
import time
import tty
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import can
import pytest
from fieldscribe import __version__
from pymodbus import FramerType
from pymodbus.client import AsyncModbusTcpClient, ModbusTcpClient
from support.modbus_server import server
from support.places import ROOT
from support.python_package import error, imported

if TYPE_CHECKING:
    from collections.abc import Iterator

GENERATED = ROOT / "generated/python"
FREQUENCY, STATUS = 0x1028, 0x0002


@pytest.fixture
def l200() -> Iterator[Any]:
    yield from imported(GENERATED, "hitachi_l200")


def transport(name: str) -> Any:
    """A module of transports, of the same copy of the runtime as the device."""
    return importlib.import_module(f"fieldscribe_runtime.transports.{name}")


def use(drive: Any) -> None:
    """What every line has to carry: registers, coils, a group in blocks."""
    drive.base_frequency.write(51.5)
    assert drive.base_frequency.read() == 51.5
    drive.run_command.write(1)
    assert drive.run_command.read() == 1
    assert len(drive.read_many("status")) > 2


async def use_async(drive: Any) -> None:
    await drive.base_frequency.write(52.5)
    assert await drive.base_frequency.read() == 52.5
    assert len(await drive.read_many("status")) > 2


def behind_a_gateway(device: Any) -> Any:
    """The drive speaks RTU; behind a gateway it is reached by TCP."""
    return type("Gateway", (device,), {"PROFILE": device.PROFILE.replaced(framings=("rtu", "tcp"))})


@pytest.mark.parametrize("framing", ["tcp", "rtu"])
def test_a_socket(framing: str, l200: Any) -> None:
    with server(FramerType.SOCKET if framing == "tcp" else FramerType.RTU) as port:
        with transport("tcp").TcpLine("127.0.0.1", port, framing=framing) as line:
            use(behind_a_gateway(l200.HitachiL200)(line, unit=1))

        async def asynchronous() -> None:
            async with transport("tcp").AsyncTcpLine("127.0.0.1", port, framing=framing) as line:
                await use_async(behind_a_gateway(l200.HitachiL200Async)(line, unit=1))

        asyncio.run(asynchronous())


@pytest.mark.full(seconds=1)
def test_a_client_of_pymodbus(l200: Any) -> None:
    with server() as port:
        with transport("pymodbus").PymodbusLine(ModbusTcpClient("127.0.0.1", port=port)) as line:
            drive = behind_a_gateway(l200.HitachiL200)(line, unit=1)
            use(drive)
            refused = error(drive.read_at, "holding", 0x4000)
            assert (refused.status, refused.code) == ("exception", 2)

        async def asynchronous() -> None:
            client = AsyncModbusTcpClient("127.0.0.1", port=port)
            async with transport("pymodbus").AsyncPymodbusLine(client) as line:
                await use_async(behind_a_gateway(l200.HitachiL200Async)(line, unit=1))

        asyncio.run(asynchronous())


@pytest.mark.full(seconds=1)
def test_a_serial_line_by_url(l200: Any) -> None:
    serial = transport("serial")
    with server(FramerType.RTU) as port:
        url = f"socket://127.0.0.1:{port}"
        with serial.SerialLine(url, 19200, timeout=2.0) as line:
            use(l200.HitachiL200(line, unit=1))

        async def asynchronous() -> None:
            async with serial.AsyncSerialLine(serial.SerialLine(url, timeout=2.0)) as line:
                await use_async(l200.HitachiL200Async(line, unit=1))

        asyncio.run(asynchronous())


@contextmanager
def pty_end(answer: Any) -> Iterator[str]:
    """The port of a line whose other end answers each request by a function; None is silence."""
    near, far = os.openpty()
    for end in (near, far):
        tty.setraw(end)

    def serve() -> None:
        while True:
            try:
                request = os.read(near, 256)
            except OSError:
                return
            for reply in answer(request):
                os.write(near, reply)

    thread = threading.Thread(target=serve, daemon=True)
    thread.start()
    try:
        yield os.ttyname(far)
    finally:
        os.close(far)
        os.close(near)


def test_what_came_too_late_is_not_the_next_answer(l200: Any) -> None:
    """The first answer is late; the line is silent again before the next request is sent."""
    frames = importlib.import_module("fieldscribe_runtime.modbus")
    answers = iter((7, 9))

    def reply(request: bytes) -> Iterator[bytes]:
        number = next(answers)
        if number == 7:
            time.sleep(0.35)
        body = request[:2] + bytes((2, 0, number))
        yield body + frames.crc(body).to_bytes(2, "little")

    with pty_end(reply) as port, transport("serial").SerialLine(port, timeout=0.25) as line:
        drive = l200.HitachiL200(line, unit=1)
        assert error(drive.read_at, "holding", STATUS).status == "timeout"
        assert drive.read_at("holding", STATUS) == (9,)


def test_an_adapter_that_echoes(l200: Any) -> None:
    frames = importlib.import_module("fieldscribe_runtime.modbus")

    def reply(request: bytes) -> Iterator[bytes]:
        body = request[:2] + bytes((2, 0, 3))
        yield request
        yield body + frames.crc(body).to_bytes(2, "little")

    with pty_end(reply) as port, transport("serial").SerialLine(port, echo=True) as line:
        assert l200.HitachiL200(line, unit=1).read_at("holding", STATUS) == (3,)


def test_uss_on_a_serial_line() -> None:
    for package in imported(GENERATED, "siemens_mm4"):
        uss, serial = importlib.import_module("fieldscribe_runtime.uss"), transport("serial")
        answer = bytes.fromhex("020e01") + bytes.fromhex("143a 0000 4220 0000 0000 0000".replace(" ", ""))
        bcc = 0
        for byte in answer:
            bcc ^= byte

        def reply(_: bytes, whole: bytes = answer + bytes((bcc,))) -> Iterator[bytes]:
            yield whole[:3]
            yield whole[3:]

        with pty_end(reply) as port, serial.UssLine(port, 9600, "8N1") as line:
            drive = package.SiemensMm4(line, 1, uss.Link(4, 2))
            assert line.exchange(b"\x02") == answer + bytes((bcc,))
            assert drive.transport is line


def hang_up(listening: socket.socket) -> None:
    """Close the next two connections at once."""
    for _ in range(2):
        listening.accept()[0].close()


@pytest.mark.parametrize("kind", ["closed", "nobody", "silent"])
def test_ends_that_fail(kind: str, l200: Any) -> None:
    tcp = transport("tcp")
    with socket.socket() as listening:
        listening.bind(("127.0.0.1", 0))
        port = listening.getsockname()[1]
        if kind != "nobody":
            listening.listen()
        if kind == "closed":
            threading.Thread(target=hang_up, args=(listening,), daemon=True).start()
        expected = "timeout" if kind == "silent" else "line"
        drive = behind_a_gateway(l200.HitachiL200)(tcp.TcpLine("127.0.0.1", port, timeout=0.2), unit=1)
        failure = error(drive.base_frequency.read)
        assert failure.status == expected, failure
        assert "A020" in str(failure)

        async def asynchronous() -> Any:
            line = tcp.AsyncTcpLine("127.0.0.1", port, timeout=0.2)
            try:
                await behind_a_gateway(l200.HitachiL200Async)(line, unit=1).base_frequency.read()
            except Exception as raised:
                return raised
            return None

        assert asyncio.run(asynchronous()).status == expected


def test_a_connection_comes_back(l200: Any) -> None:
    with server() as port:
        line = transport("tcp").TcpLine("127.0.0.1", port)
        drive = behind_a_gateway(l200.HitachiL200)(line, unit=1)
        assert drive.read_at("holding", STATUS) == (7,)
        line._socket.shutdown(socket.SHUT_RDWR)
        assert error(drive.read_at, "holding", STATUS).status == "line"
        assert drive.read_at("holding", STATUS) == (7,)
        line.close()


def test_a_port_that_is_none(l200: Any) -> None:
    line = transport("serial").SerialLine("/dev/there_is_none")
    assert error(l200.HitachiL200(line, unit=1).base_frequency.read).status == "line"
    for mode in ("8X1", "8n1", "9N1", "8N"):
        assert error(transport("serial").SerialLine, "x", 9600, mode).status == "bad_mode"
    assert error(transport("tcp").TcpLine, "127.0.0.1", framing="ascii").status == "bad_framing"


@pytest.fixture
def mpu2s() -> Iterator[Any]:
    yield from imported(GENERATED, "woodward_mpu2s")


@pytest.fixture
def bus() -> Iterator[tuple[can.BusABC, can.BusABC]]:
    """Both ends of a bus."""
    far = can.Bus("line", interface="virtual")
    yield can.Bus("line", interface="virtual"), far
    far.shutdown()


NOISE = can.Message(arbitration_id=1, is_remote_frame=True, is_extended_id=False)
BACK = can.Message(arbitration_id=0x346, data=b"\x01\x02", is_extended_id=False)


@pytest.mark.full(seconds=1)
@pytest.mark.usefixtures("mpu2s")
def test_a_can_bus(bus: tuple[can.BusABC, can.BusABC]) -> None:
    frames, (near, far) = importlib.import_module("fieldscribe_runtime.can"), bus
    with transport("can").CanLine(near, timeout=0.5) as line:
        line.send(frames.Frame(0x345, bytes(range(8))))
        heard = far.recv(1)
        assert heard is not None
        assert (heard.arbitration_id, bytes(heard.data)) == (0x345, bytes(range(8)))
        assert line.receive_waiting() is None
        far.send(NOISE)
        far.send(BACK)
        assert line.receive() == frames.Frame(0x346, b"\x01\x02")
        assert isinstance(error(line.receive), TimeoutError)


@pytest.mark.full(seconds=2)
@pytest.mark.usefixtures("mpu2s")
def test_a_can_bus_without_blocking(bus: tuple[can.BusABC, can.BusABC]) -> None:
    frames, (near, far) = importlib.import_module("fieldscribe_runtime.can"), bus

    async def asynchronous() -> None:
        with pytest.raises(ConnectionError, match="nobody listens yet"):
            await transport("can").AsyncCanLine(near).receive()
        async with transport("can").AsyncCanLine(near, timeout=0.5) as line:
            await line.send(frames.Frame(0x345, bytes(range(8))))
            assert await asyncio.to_thread(far.recv, 1) is not None
            assert line.receive_waiting() is None
            far.send(NOISE)
            far.send(BACK)
            assert await line.receive() == frames.Frame(0x346, b"\x01\x02")
            with pytest.raises(TimeoutError):
                await line.receive()

    asyncio.run(asynchronous())


def test_the_runtime_has_the_version_of_the_compiler() -> None:
    project = (ROOT / "templates/python/runtime/fieldscribe_runtime/pyproject.toml").read_text("utf-8")
    assert f'version = "{__version__}"' in project
