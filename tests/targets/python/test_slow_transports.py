"""Transports whose other end drips, babbles or never stops."""

from __future__ import annotations

import importlib
import socket
import threading
import time
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any

import can
import pytest
from support.line_ends import pty_end
from support.places import ROOT
from support.python_package import error, imported

if TYPE_CHECKING:
    from collections.abc import Iterator


GENERATED = ROOT / "generated/python"


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


def behind_a_gateway(device: Any) -> Any:
    """The drive speaks RTU; behind a gateway it is reached by TCP."""
    return type("Gateway", (device,), {"PROFILE": device.PROFILE.replaced(framings=("rtu", "tcp"))})


@contextmanager
def socket_end(answer: Any) -> Iterator[int]:
    """The port of an end in the network which answers each request of each connection by a function."""

    def serve(line: socket.socket) -> None:
        with line, suppress(OSError):
            while request := line.recv(256):
                line.sendall(answer(request))

    def listen() -> None:
        with suppress(OSError):
            while True:
                threading.Thread(target=serve, args=(listening.accept()[0],), daemon=True).start()

    with socket.create_server(("127.0.0.1", 0)) as listening:
        threading.Thread(target=listen, daemon=True).start()
        yield listening.getsockname()[1]
        listening.shutdown(socket.SHUT_RDWR)


def with_word(request: bytes, word: int) -> bytes:
    """An RTU answer to a request of one register."""
    body = request[:2] + bytes((2, 0, word))
    crc: int = importlib.import_module("fieldscribe_runtime.modbus").crc(body)
    return body + crc.to_bytes(2, "little")


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


def drip(listening: socket.socket, gap: float, data: bytes) -> None:
    """Answer the first connection a byte at a time."""
    with suppress(OSError):
        connection = listening.accept()[0]
        connection.recv(256)
        for number in data:
            connection.sendall(bytes((number,)))
            time.sleep(gap)


def test_a_reply_that_drips_takes_no_longer_than_the_timeout(l200: Any) -> None:
    with socket.socket() as listening:
        listening.bind(("127.0.0.1", 0))
        listening.listen()
        threading.Thread(target=drip, args=(listening, 0.1, bytes(200)), daemon=True).start()
        line = transport("tcp").TcpLine("127.0.0.1", listening.getsockname()[1], timeout=0.3)
        before = time.monotonic()
        assert error(behind_a_gateway(l200.HitachiL200)(line, unit=1).base_frequency.read).status == "timeout"
        assert time.monotonic() - before < 5  # far from the 20 s that 200 bytes take


@pytest.mark.full(seconds=0.2)
def test_a_line_that_babbles_holds_up_nobody(l200: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(transport("serial"), "_BABBLE", 0.2)

    def babble(request: bytes) -> Iterator[bytes]:
        del request
        for _ in range(300):
            yield b"\x01\x03\xff"
            time.sleep(0.01)

    with pty_end(babble) as port:
        drive = l200.HitachiL200(transport("serial").SerialLine(port, timeout=0.1), unit=1)
        assert isinstance(error(drive.base_frequency.read), Exception)


@pytest.mark.usefixtures("mpu2s")
def test_a_flood_of_what_is_no_frame_ends(bus: tuple[can.BusABC, can.BusABC], monkeypatch: pytest.MonkeyPatch) -> None:
    near, _ = bus
    monkeypatch.setattr(near, "recv", lambda timeout=None: NOISE)
    with transport("can").CanLine(near, timeout=0.05) as line:
        assert isinstance(error(line.receive), TimeoutError)
        assert line.receive_waiting() is None
