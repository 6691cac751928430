"""Measures reads over a socket beside pymodbus by hand: the same server in a process of its own, turn by turn.

.venv/bin/python tests/bench/line_bench.py [rounds]
"""

from __future__ import annotations

import importlib
import multiprocessing
import statistics
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Any

from pymodbus import FramerType
from pymodbus.client import ModbusTcpClient

ROOT = Path(__file__).resolve().parents[2]
READS = 200
"""So many of each in one go."""
MARKS = 1.05, 1.1
"""The most of the wall clock and of the processor that a read may take, to pymodbus by hand."""


def _serve(connection: Any) -> None:
    """Serve until the parent ends."""
    support = importlib.import_module("support.modbus_server")
    with support.server(FramerType.SOCKET) as tcp, support.server(FramerType.RTU) as rtu:
        connection.send((tcp, rtu))
        connection.recv()


@contextmanager
def servers() -> Iterator[tuple[int, int]]:
    """Ports of a server of pymodbus, TCP and RTU."""
    near, far = multiprocessing.get_context("spawn").Pipe()
    process = multiprocessing.get_context("spawn").Process(target=_serve, args=(far,), daemon=True)
    process.start()
    yield near.recv()
    near.send(None)
    process.join(10)


def print_lines(rounds: int) -> None:
    """The table, with the marks behind the figures."""
    sys.path[:0] = [str(ROOT / "generated/python"), str(ROOT / "tests")]
    device = importlib.import_module("hitachi_l200").HitachiL200
    gateway = type("Gateway", (device,), {"PROFILE": device.PROFILE.replaced(framings=("tcp", "rtu"))})
    tcp_line = importlib.import_module("fieldscribe_runtime.transports.tcp").TcpLine
    serial_line = importlib.import_module("fieldscribe_runtime.transports.serial").SerialLine
    what = "reads over a socket, to pymodbus by hand"
    print(f"\n{what:<44} {'wall us':>9} {'CPU us':>9} {'wall':>7} {'mark':>6} {'CPU':>7} {'mark':>6}")
    with servers() as (tcp, rtu):
        for what, port, framer, line in (
            ("TcpLine", tcp, FramerType.SOCKET, tcp_line("127.0.0.1", tcp)),
            ("TcpLine, RTU", rtu, FramerType.RTU, tcp_line("127.0.0.1", rtu, framing="rtu")),
            ("SerialLine, socket://", rtu, FramerType.RTU, serial_line(f"socket://127.0.0.1:{rtu}")),
        ):
            client: Any = ModbusTcpClient("127.0.0.1", port=port, framer=framer)
            client.connect()
            ours = gateway(line, unit=1).base_frequency.read
            theirs = partial(_by_hand, client)
            assert ours() == theirs() == 0.7
            rows = [(*_timed(ours), *_timed(theirs)) for _ in range(rounds + 1)][1:]
            wall, cpu = (statistics.median(row[at] for row in rows) * 1e6 for at in (0, 1))
            ratios = [statistics.median(row[at] / row[at + 2] for row in rows) for at in (0, 1)]
            told = " ".join([f"{ratio:7.2f} {mark:6}" for ratio, mark in zip(ratios, MARKS, strict=True)])
            over = "" if ratios[0] <= MARKS[0] and ratios[1] <= MARKS[1] else "  over"
            print(f"{what:<44} {wall:9.1f} {cpu:9.1f} {told}{over}")
            client.close()
            line.close()


def _by_hand(client: Any) -> float:
    """The same read as people write it for pymodbus."""
    registers = client.read_holding_registers(0x1028, count=1, device_id=1).registers
    return float(registers[0] / 10)


def _timed(function: Callable[[], object]) -> tuple[float, float]:
    """Seconds and seconds of the processor for one call, out of many."""
    wall, cpu = time.perf_counter(), time.process_time()
    for _ in range(READS):
        function()
    return (time.perf_counter() - wall) / READS, (time.process_time() - cpu) / READS


if __name__ == "__main__":
    print_lines(int(sys.argv[1]) if len(sys.argv) > 1 else 15)
