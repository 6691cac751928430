"""Transports whose other end drips, babbles or never stops."""

from __future__ import annotations

import socket
import threading
import time
from collections.abc import Iterator
from contextlib import suppress
from typing import Any

import can
import pytest
from support.line_ends import pty_end
from support.python_package import error
from support.python_transports import NOISE, behind_a_gateway, transport


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
