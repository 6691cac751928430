"""Transports of the runtime against real ends: a server of pymodbus in the network and behind a serial line, a bus of
python-can, ends that fall silent."""

from __future__ import annotations

import asyncio
import importlib
import os
import socket
import threading
import tomllib
from collections.abc import Iterator
from typing import Any

import can
import pytest
from fieldscribe import __version__
from pymodbus import FramerType
from pymodbus.client import AsyncModbusTcpClient, ModbusTcpClient
from support.line_ends import pty_end
from support.modbus_server import server
from support.places import PACKAGES, ROOT
from support.python_package import error, imported
from support.python_transports import NOISE, behind_a_gateway, parameters_on, socket_end, transport, with_word

FREQUENCY, STATUS = 0x1028, 0x0002


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


@pytest.mark.parametrize("framing", ["tcp", "rtu"])
def test_a_socket(framing: str, l200: Any) -> None:
    with server(FramerType.SOCKET if framing == "tcp" else FramerType.RTU) as port:
        with transport("tcp").TcpLine("127.0.0.1", port, framing=framing) as line:
            use(behind_a_gateway(l200.HitachiL200)(line, unit=1))
            assert line._connection.socket.getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY)

        async def asynchronous() -> None:
            async with transport("tcp").AsyncTcpLine("127.0.0.1", port, framing=framing) as line:
                await use_async(behind_a_gateway(l200.HitachiL200Async)(line, unit=1))

        asyncio.run(asynchronous())


def test_a_socket_where_there_is_no_poll(l200: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """Windows has select alone."""
    tcp = transport("tcp")
    monkeypatch.delattr(tcp.select, "poll")
    with socket_end(lambda request: with_word(request, 7)) as port:
        line = tcp.TcpLine("127.0.0.1", port, framing="rtu", timeout=0.1)
        drive = l200.HitachiL200(line, unit=1)
        assert drive.read_at("holding", STATUS) == drive.read_at("holding", STATUS) == (7,)
        line.close()
    with socket_end(lambda _: b"") as port:
        line = tcp.TcpLine("127.0.0.1", port, framing="rtu", timeout=0.1)
        assert error(l200.HitachiL200(line, unit=1).read_at, "holding", STATUS).status == "timeout"


@pytest.mark.full(seconds=1)
def test_a_client_of_pymodbus(l200: Any) -> None:
    with server(FramerType.RTU) as port:
        client = ModbusTcpClient("127.0.0.1", port=port, framer=FramerType.RTU)
        with transport("pymodbus").PymodbusLine(client) as line:
            drive = l200.HitachiL200(line, unit=1)  # which speaks RTU alone: the client frames what it is handed
            use(drive)
            refused = error(drive.read_at, "holding", 0x4000)
            assert (refused.status, refused.code) == ("exception", 2)

        async def asynchronous() -> None:
            client = AsyncModbusTcpClient("127.0.0.1", port=port, framer=FramerType.RTU)
            async with transport("pymodbus").AsyncPymodbusLine(client) as line:
                await use_async(l200.HitachiL200Async(line, unit=1))

        asyncio.run(asynchronous())


def test_a_client_of_pymodbus_without_a_server(l200: Any) -> None:
    """Nothing was sent, so the request may be sent again."""
    with socket.create_server(("127.0.0.1", 0)) as unused:
        port = unused.getsockname()[1]
    client = ModbusTcpClient("127.0.0.1", port=port, retries=0)
    failure = error(l200.HitachiL200(transport("pymodbus").PymodbusLine(client), unit=1).read_at, "holding", STATUS)
    assert (failure.status, failure.unsent) == ("line", True)

    async def asynchronous() -> None:
        client = AsyncModbusTcpClient("127.0.0.1", port=port, retries=0, reconnect_delay=0)
        drive = l200.HitachiL200Async(transport("pymodbus").AsyncPymodbusLine(client), unit=1)
        with pytest.raises(type(failure), match="the client cannot connect"):
            await drive.read_at("holding", STATUS)

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


def test_an_adapter_that_echoes(l200: Any) -> None:
    frames = importlib.import_module("fieldscribe_runtime.modbus")

    def reply(request: bytes) -> Iterator[bytes]:
        body = request[:2] + bytes((2, 0, 3))
        yield request
        yield body + frames.crc(body).to_bytes(2, "little")

    with pty_end(reply) as port, transport("serial").SerialLine(port, echo=True) as line:
        assert l200.HitachiL200(line, unit=1).read_at("holding", STATUS) == (3,)
    with socket_end(lambda request: request + with_word(request, 4)) as number:  # the echo and the reply in one piece
        line = transport("serial").SerialLine(f"socket://127.0.0.1:{number}", echo=True)
        assert l200.HitachiL200(line, unit=1).read_at("holding", STATUS) == (4,)
        line.close()


def test_uss_on_a_serial_line() -> None:
    for package in imported(PACKAGES, "siemens_mm4"):
        uss, serial = importlib.import_module("fieldscribe_runtime.uss"), transport("serial")
        answer = bytes.fromhex("020e01") + bytes.fromhex("143a 0000 4220 0000 0000 0000".replace(" ", ""))
        bcc = 0
        for byte in answer:
            bcc ^= byte

        def reply(_: bytes, whole: bytes = answer + bytes((bcc,))) -> Iterator[bytes]:
            yield whole[:3]
            yield whole[3:]

        with pty_end(reply) as port:
            for _ in range(2):  # a pseudo terminal refuses its second user's parity
                with serial.UssLine(port, 9600) as line:
                    drive = package.SiemensMm4(line, 1, uss.Link(4, 2))
                    assert line.exchange(b"\x02") == answer + bytes((bcc,))
                    assert drive.transport is line


def hang_up(listening: socket.socket) -> None:
    """Close the next two connections at once."""
    for _ in range(2):
        listening.accept()[0].close()


@pytest.mark.parametrize("kind", ["closed", "nobody", "silent", "full"])
def test_ends_that_fail(kind: str, l200: Any) -> None:
    tcp = transport("tcp")
    with socket.socket() as listening:
        listening.bind(("127.0.0.1", 0))
        port = listening.getsockname()[1]
        if kind != "nobody":
            listening.listen(0 if kind == "full" else 8)
        waiting = [socket.socket() for _ in range(4 if kind == "full" else 0)]
        for one in waiting:
            one.setblocking(False)
            one.connect_ex(listening.getsockname())
        if kind == "closed":
            threading.Thread(target=hang_up, args=(listening,), daemon=True).start()
        expected = "timeout" if kind == "silent" else "line"
        drive = behind_a_gateway(l200.HitachiL200)(tcp.TcpLine("127.0.0.1", port, timeout=0.2), unit=1)
        failure = error(drive.base_frequency.read)
        assert failure.status == expected, failure
        assert "A020" in str(failure)
        is_sent = kind in ("closed", "silent")
        assert (drive.traffic.requests, getattr(failure, "unsent", False)) == (is_sent, not is_sent)

        async def asynchronous() -> Any:
            drive = behind_a_gateway(l200.HitachiL200Async)(tcp.AsyncTcpLine("127.0.0.1", port, timeout=0.2), unit=1)
            drive.retries, drive.retry_pause = int(kind == "nobody"), 0.01
            try:
                await drive.base_frequency.read()
            except Exception as raised:
                return raised
            return None

        failure = asyncio.run(asynchronous())
        assert (failure.status, getattr(failure, "unsent", False)) == (expected, not is_sent)
        for one in waiting:
            one.close()


def test_a_connection_comes_back(l200: Any) -> None:
    with server() as port:
        line = transport("tcp").TcpLine("127.0.0.1", port)
        drive = behind_a_gateway(l200.HitachiL200)(line, unit=1)
        assert drive.read_at("holding", STATUS) == (7,)
        line._connection.socket.shutdown(socket.SHUT_RDWR)
        assert drive.read_at("holding", STATUS) == (7,), "it was closed before the request, so the line connects anew"
        line.close()


def test_a_port_that_is_none(l200: Any) -> None:
    line = transport("serial").SerialLine("/dev/there_is_none")
    assert error(l200.HitachiL200(line, unit=1).base_frequency.read).status == "line"
    for mode in ("8X1", "8n1", "9N1", "8N", (8, "N", 1)):
        assert error(transport("serial").SerialLine, "x", 9600, mode).status == "bad_mode"
    assert error(transport("tcp").TcpLine, "127.0.0.1", framing="ascii").status == "bad_framing"


def test_an_adapter_that_is_pulled(l200: Any) -> None:
    near, far = os.openpty()
    line = transport("serial").SerialLine(os.ttyname(far), timeout=0.05)
    drive = l200.HitachiL200(line, unit=1)
    assert error(drive.base_frequency.read).status == "timeout"
    os.close(far)
    os.close(near)
    assert error(drive.base_frequency.read).status == "line"
    assert error(drive.base_frequency.read).status == "line", "nor can it be opened again"


WRONG: tuple[tuple[str, str, tuple[Any, ...], dict[str, Any], str], ...] = (
    ("serial", "SerialLine", (3,), {}, "a port is a device such as '/dev/ttyUSB0'"),
    ("serial", "SerialLine", ("socket://127.0.0.1",), {}, "socket://192.168.0.20:4001"),
    ("serial", "SerialLine", ("x", "9600"), {}, "a baud rate is a number from 1"),
    ("serial", "SerialLine", ("x", 0), {}, "a baud rate"),
    ("serial", "SerialLine", ("x",), {"timeout": -1}, "a timeout is a number of seconds above 0, not -1"),
    ("serial", "SerialLine", ("x",), {"timeout": None}, "a timeout"),
    ("serial", "AsyncSerialLine", ("/dev/ttyUSB0",), {}, "AsyncSerialLine(SerialLine("),
    ("tcp", "TcpLine", (5,), {}, "the host is a name or an address"),
    ("tcp", "TcpLine", ("127.0.0.1:502",), {}, "the port another argument"),
    ("tcp", "TcpLine", ("127.0.0.1", "502"), {}, "the port is a number from 1 to 65535"),
    ("tcp", "AsyncTcpLine", ("127.0.0.1",), {"timeout": "1"}, "a timeout"),
    ("can", "CanLine", ("can0",), {}, "the bus is one of python-can"),
    ("can", "AsyncCanLine", ("can0",), {}, "the bus is one of python-can"),
    ("pymodbus", "PymodbusLine", ("127.0.0.1",), {}, "the client is one of pymodbus that blocks"),
    ("pymodbus", "AsyncPymodbusLine", (ModbusTcpClient("x"),), {}, "the client is one of pymodbus that is awaited"),
)


@pytest.mark.usefixtures("l200")
def test_what_a_line_is_not_made_with() -> None:
    for module, name, given, named, words in WRONG:
        refused = error(getattr(transport(module), name), *given, **named)
        assert refused.status == "bad_transport", (name, given, named)
        assert words in str(refused)


def test_a_url_that_pyserial_does_not_know(l200: Any) -> None:
    refused = error(l200.HitachiL200(transport("serial").SerialLine("tcp://x:5"), unit=1).base_frequency.read)
    assert refused.status == "bad_transport", "not `line`: trying again is of no use"
    assert "socket://" in str(refused)


def test_framings_that_do_not_fit(l200: Any) -> None:
    told = str(error(l200.HitachiL200, transport("tcp").TcpLine("127.0.0.1"), 1))
    assert "framing='rtu'" in told
    assert "PROFILE.replaced(framings=('tcp',))" in told
    for package in imported(PACKAGES, "siemens_mm4"):
        link, serial = importlib.import_module("fieldscribe_runtime.uss").Link(4, 2), transport("serial")
        refused = error(package.SiemensMm4, serial.SerialLine("x"), 1, link)
        assert refused.status == "bad_framing"
        assert "UssLine" in str(refused)
        refused = error(l200.HitachiL200, serial.UssLine("x"), 1)
        assert "for a serial line take a SerialLine" in str(refused)
        package.SiemensMm4Async(serial.AsyncSerialLine(serial.UssLine("x")), 1, link)


def test_a_reply_that_comes_twice(l200: Any) -> None:
    words = iter(range(1, 9))

    def twice(request: bytes) -> bytes:
        return with_word(request, next(words)) * 2

    with socket_end(twice) as port:
        for line in (
            transport("tcp").TcpLine("127.0.0.1", port, framing="rtu"),
            transport("serial").SerialLine(f"socket://127.0.0.1:{port}"),
        ):
            drive = l200.HitachiL200(line, unit=1)
            first, second = [drive.read_at("holding", STATUS)[0] for _ in range(2)]
            assert second == first + 1
            line.close()
        line = transport("tcp").AsyncTcpLine("127.0.0.1", port, framing="rtu")
        drives = [l200.HitachiL200Async(line, unit=1) for _ in range(2)]

        async def both() -> Any:
            return await asyncio.gather(*(drive.read_at("holding", STATUS) for drive in drives))

        assert asyncio.run(both()) == [(5,), (6,)]
        assert asyncio.run(both()) == [(7,), (8,)], "in the next event loop, too"
        line.close()


BACK = can.Message(arbitration_id=0x346, data=b"\x01\x02", is_extended_id=False)


@pytest.mark.full(seconds=1)
@pytest.mark.usefixtures("mpu2s")
def test_a_can_bus(bus: tuple[can.BusABC, can.BusABC]) -> None:
    frames, (near, far) = importlib.import_module("fieldscribe_runtime.can"), bus
    with transport("can").CanLine(near, timeout=0.5) as line:
        line.send(frames.Frame(0x345, bytes(range(8))))
        heard = far.recv(1)
        assert heard is not None
        assert (heard.arbitration_id, bytes(heard.data), heard.is_fd) == (0x345, bytes(range(8)), False)
        line.send(frames.Frame(0x345, bytes(range(64))))
        heard = far.recv(1)
        assert heard is not None
        assert (bytes(heard.data), heard.is_fd) == (bytes(range(64)), True)
        far.send(heard)
        assert line.receive() == frames.Frame(0x345, bytes(range(64)))
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


ROUNDS = 15


def test_devices_share_a_can_line(mpu2s: Any) -> None:
    wrong: list[object] = []

    def work(drive: Any, value: float) -> None:
        drive.patience = 0.5
        for step in range(ROUNDS):
            try:
                drive.generator_frequency_setpoint.write(value + step / 4)
                if drive.generator_frequency_setpoint.read() != value + step / 4:
                    wrong.append(step)
            except Exception as raised:
                wrong.append(raised)
                return

    with parameters_on("shared"), transport("can").CanLine(can.Bus("shared", interface="virtual")) as line:
        drives = [mpu2s.WoodwardMpu2s(line, unit=unit) for unit in (1, 2)]
        threads = [threading.Thread(target=work, args=pair) for pair in zip(drives, (45.0, 55.0), strict=True)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join(10)
        assert not wrong
        assert line.receive().data[0] == 0xDD, "who asks the line hears telegrams, too"


def test_async_devices_share_a_can_line(mpu2s: Any) -> None:
    async def work(drive: Any, value: float) -> None:
        drive.patience = 0.5
        for step in range(ROUNDS):
            await drive.generator_frequency_setpoint.write(value + step / 4)
            assert await drive.generator_frequency_setpoint.read() == value + step / 4

    async def both() -> None:
        async with transport("can").AsyncCanLine(can.Bus("async", interface="virtual")) as line:
            drives = [mpu2s.WoodwardMpu2sAsync(line, unit=unit) for unit in (1, 2)]
            await asyncio.gather(*(work(*pair) for pair in zip(drives, (45.0, 55.0), strict=True)))

    with parameters_on("async"):
        asyncio.run(both())


def test_the_runtime_has_the_version_of_the_compiler() -> None:
    project = (ROOT / "templates/python/runtime/fieldscribe_runtime/pyproject.toml").read_text("utf-8")
    assert f'version = "{__version__}"' in project
    own = tomllib.loads(project)["project"]["optional-dependencies"]
    passed_on = tomllib.loads((PACKAGES / "hitachi_l200/pyproject.toml").read_text("utf-8"))["project"]
    expected = {name: [f"fieldscribe-runtime[{name}]=={__version__}"] for name in own}
    assert passed_on["optional-dependencies"] == expected
