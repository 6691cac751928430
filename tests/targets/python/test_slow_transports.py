"""Transports whose other end drips, babbles or never stops."""

from __future__ import annotations

import asyncio
import socket
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from typing import Any

import can
import pytest
from support.line_ends import pty_end
from support.python_package import error
from support.python_transports import NOISE, behind_a_gateway, socket_end, transport, with_word


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


def foreign_frame() -> bytes:
    return with_word(b"\x09\x03", 1)


@pytest.mark.parametrize(
    ("piece", "told"), [(lambda: b"\x55", "bytes came (55 55 55"), (foreign_frame, "unit 9 answered")]
)
def test_noise_without_end_is_a_frame_error(piece: Callable[[], bytes], told: str, l200: Any) -> None:
    def noise(request: bytes) -> Iterator[bytes]:
        del request
        while True:
            yield piece()
            time.sleep(0.002)

    with pty_end(noise) as port:
        drive = l200.HitachiL200(transport("serial").SerialLine(port, 115200, timeout=0.2), unit=1)
        failure = error(drive.base_frequency.read)
        assert failure.lost
        assert told in str(failure)


def test_a_flood_of_bytes_ends_on_sockets_too(l200: Any) -> None:
    with socket_end(lambda _: b"\x55" * 100_000) as port:
        line = transport("tcp").TcpLine("127.0.0.1", port, framing="rtu")
        assert error(l200.HitachiL200(line, unit=1).base_frequency.read).status == "long_frame"

        async def asynchronous() -> Any:
            line = transport("tcp").AsyncTcpLine("127.0.0.1", port, framing="rtu")
            try:
                await l200.HitachiL200Async(line, unit=1).base_frequency.read()
            except Exception as raised:
                return raised

        assert asyncio.run(asynchronous()).status == "long_frame"


def test_an_async_exchange_gives_other_tasks_a_turn(l200: Any) -> None:
    async def asynchronous(port: int) -> None:
        drive = l200.HitachiL200Async(transport("tcp").AsyncTcpLine("127.0.0.1", port, framing="rtu"), unit=1)
        assert await drive.read_at("holding", 2) == (7,)
        with pytest.raises(TimeoutError):
            async with asyncio.timeout(0):
                await drive.read_at("holding", 2)

    with socket_end(lambda request: with_word(request, 7)) as port:
        asyncio.run(asynchronous(port))


def test_a_dead_unit_holds_up_no_other(l200: Any) -> None:
    """Unit 2 is dead at first: unit 1 is asked at once, and unit 2 again when its late reply would have come."""
    asked: list[int] = []

    def reply(request: bytes) -> Iterator[bytes]:
        asked.append(request[0])
        if asked != [2]:
            yield with_word(b"\x02" + request[1:], 5)  # of the dead unit, too late
            yield with_word(request, request[0])

    with pty_end(reply) as port, transport("serial").SerialLine(port, timeout=0.3) as line:
        alive, dead = (l200.HitachiL200(line, unit=unit) for unit in (1, 2))
        before = time.monotonic()
        failure = error(dead.read_at, "holding", 2)
        assert (failure.status, str(failure)) == (
            "timeout",
            "holding 0x0002: unit 2 did not reply to function 03h: no byte came",
        )
        assert alive.read_at("holding", 2) == (1,)
        assert line._late is not None
        assert line._late[1] > before + 2 * line.timeout
        assert asked == [2, 1]


def test_a_broadcast_waits_for_nothing(l200: Any) -> None:
    """The line rests before the next request."""
    rests: list[float] = []
    with pty_end(lambda _: iter(())) as port, transport("serial").SerialLine(port, timeout=60) as line:
        line.turnaround = 0.01
        l200.HitachiL200(line, unit=0).base_frequency.write(50.0)
        rests.append(line._rests_until - time.monotonic())
        assert line._late is None
    assert rests[0] < 1


@pytest.mark.usefixtures("mpu2s")
def test_a_flood_of_what_is_no_frame_ends(bus: tuple[can.BusABC, can.BusABC], monkeypatch: pytest.MonkeyPatch) -> None:
    near, _ = bus
    monkeypatch.setattr(near, "recv", lambda timeout=None: NOISE)
    with transport("can").CanLine(near, timeout=0.05) as line:
        assert isinstance(error(line.receive), TimeoutError)
        assert line.receive_waiting() is None
