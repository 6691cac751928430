"""A server of pymodbus, in a thread of its own: somebody else's other end."""

from __future__ import annotations

import asyncio
import socket
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from pymodbus import FramerType
from pymodbus.server import ModbusTcpServer
from pymodbus.simulator import DataType, SimData, SimDevice


@contextmanager
def server(
    framer: FramerType = FramerType.SOCKET, *, word: int = 7, addresses: int = 0x1400, action: Any = None
) -> Iterator[int]:
    """A server of pymodbus in a thread of its own, of units 1 and 2, with that number in each register; its port.

    The action is what pymodbus calls before it answers a request.
    """
    words = [SimData(0, count=addresses, values=word, datatype=DataType.REGISTERS)]
    bits = [SimData(0, count=64, values=False, datatype=DataType.BITS)]
    devices = [SimDevice(id=unit, simdata=(bits, bits, words, words), action=action) for unit in (1, 2)]
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    loop = asyncio.new_event_loop()
    ready = threading.Event()
    made: list[ModbusTcpServer] = []

    async def serve() -> None:
        made.append(ModbusTcpServer(devices, framer=framer, address=("127.0.0.1", port)))
        await made[0].serve_forever(background=True)
        ready.set()

    async def stop() -> None:
        await made[0].shutdown()  # type: ignore[no-untyped-call]  # pymodbus says no types here

    thread = threading.Thread(target=loop.run_forever, daemon=True)
    thread.start()
    asyncio.run_coroutine_threadsafe(serve(), loop).result(5)
    assert ready.wait(5)
    try:
        yield port
    finally:
        asyncio.run_coroutine_threadsafe(stop(), loop).result(5)
        loop.call_soon_threadsafe(loop.stop)
        thread.join(5)
        loop.close()
