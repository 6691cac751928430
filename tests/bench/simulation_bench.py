"""Measures `fieldscribe simulate` beside a server of pymodbus with the same registers, and a thousand devices.

.venv/bin/python tests/bench/simulation_bench.py [rounds]
"""

from __future__ import annotations

import os
import signal
import socket
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from line_bench import servers
from stream_bench import FIELDSCRIBE, KEEPS_BYTECODE

REQUESTS = 2000
EXCHANGES = (
    ("one register", ("0310280001", "0310280001")),
    ("four registers", ("0310160004", "0310160004")),
    ("writes of two numbers in turn", ("06102801f4", "0610280258")),
)
THOUSAND = """\
lines:
- tcp: 0
  devices: [{device: fronius_datamanager, units: 1..247}]
- tcp: 0
  devices: [{device: eastron_sdm630, units: 1..247}]
- tcp: 0
  devices: [{device: jumo_controller, units: 1..254}]
"""
ALONE = "- tcp: 0\n  devices: [{device: hitachi_l200, units: 1..32}]\n"
MOST_MEBIBYTES = 300


def print_simulation(rounds: int) -> None:
    """The table: the marks are as many requests a second as pymodbus answers, and 300 MiB for 1,000 devices."""
    sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
    print(f"\n{'requests a second, to those of pymodbus':<44} {'ours':>9} {'theirs':>9} {'ratio':>7}")
    with servers() as (theirs, _rtu):
        running = _started("hitachi_l200", "--tcp", "0", "--still")
        ours = int(_line(running).rpartition(":")[2])
        for what, pdus in EXCHANGES:
            requests = [bytes.fromhex(f"00010000000601{each}") for each in pdus]
            pairs = [(_rate(ours, requests), _rate(theirs, requests)) for _ in range(rounds + 1)][1:]
            ratio = statistics.median(mine / other for mine, other in pairs)
            mine, other = (statistics.median(pair[at] for pair in pairs) for at in (0, 1))
            print(f"{what:<44} {mine:9.0f} {other:9.0f} {ratio:7.2f}")
        _ended(running)
    with tempfile.NamedTemporaryFile("w", suffix=".yaml") as bench:
        bench.write(THOUSAND + 8 * ALONE)
        bench.flush()
        start = time.perf_counter()
        running = _started("--bench", bench.name)
        devices = [_line(running) for _ in range(247 + 247 + 254 + 8 * 32)]
        took, mebibytes = time.perf_counter() - start, _ended(running)
    print(f"{len(devices)} devices in one process: {mebibytes:.0f} MiB (mark {MOST_MEBIBYTES}), up after {took:.1f} s")


def _started(*words: str) -> subprocess.Popen[str]:
    environment = {**os.environ, **KEEPS_BYTECODE}
    command = [FIELDSCRIBE, "simulate", *words]
    return subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True, env=environment)


def _line(running: subprocess.Popen[str]) -> str:
    assert running.stdout is not None
    return running.stdout.readline()


def _ended(running: subprocess.Popen[str]) -> float:
    """End it and return the mebibytes that it took at most."""
    running.send_signal(signal.SIGTERM)
    _, status, usage = os.wait4(running.pid, 0)
    running.returncode = os.waitstatus_to_exitcode(status)
    return usage.ru_maxrss / 1024


def _rate(port: int, requests: list[bytes]) -> float:
    """Requests a second on one connection, one after the other, in turn."""
    with socket.create_connection(("127.0.0.1", port)) as line:
        line.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        start = time.perf_counter()
        for place in range(REQUESTS):
            line.sendall(requests[place & 1])
            assert len(line.recv(300)) > 8
        return REQUESTS / (time.perf_counter() - start)


if __name__ == "__main__":
    print_simulation(int(sys.argv[1]) if len(sys.argv) > 1 else 9)
