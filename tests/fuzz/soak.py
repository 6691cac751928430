"""Reads over a socket whose other end spoils some replies: none may be lost, and no memory may grow.

PYTHONPATH=tests .venv/bin/python tests/fuzz/soak.py [--requests 100000] [--faults 0.05] [--seed 1]
"""

from __future__ import annotations

import argparse
import gc
import importlib
import random
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from support.places import PACKAGES
from support.python_transports import behind_a_gateway, socket_end, with_word

TIMEOUT = 0.02
KINDS = ("missing", "late", "cut", "broken", "doubled", "foreign", "closed")
MOST_GROWTH = 512
"""Kibibytes, of the second half of the requests."""


class Other:
    """The other end: the word at an address is the address with all bits turned over."""

    def __init__(self, faults: float, seed: int) -> None:
        self._faults, self._draw = faults, random.Random(seed)
        self.spoiled = dict.fromkeys(KINDS, 0)

    def answer(self, request: bytes) -> Iterator[bytes]:
        """Return the reply, or what became of it."""
        draw, is_tcp = self._draw, len(request) == 12
        word = 0xFFFF - int.from_bytes(request[8:10] if is_tcp else request[2:4], "big")
        reply = request[:4] + b"\0\5" + request[6:8] + b"\2" + word.to_bytes(2, "big")
        if not is_tcp:
            body = request[:2] + b"\2" + word.to_bytes(2, "big")
            reply = body + self._crc(body).to_bytes(2, "little")
        if draw.random() >= self._faults:
            yield reply
            return
        kind = draw.choice(KINDS)
        self.spoiled[kind] += 1
        at = draw.randrange(9 if is_tcp else len(reply))  # TCP has no check of the words
        if kind == "late":
            time.sleep(1.5 * TIMEOUT)
            yield reply
        elif kind == "closed":
            raise OSError
        elif kind in ("cut", "broken"):
            yield reply[:at]
            yield b"" if kind == "cut" else bytes((reply[at] ^ 1 << draw.randrange(8),)) + reply[at + 1 :]
        elif kind == "doubled":
            yield reply + reply
        elif kind == "foreign":
            yield (bytes((reply[0] ^ 0x55,)) + reply[1:] if is_tcp else with_word(b"\x09\x03", 1)) + reply

    def _crc(self, body: bytes) -> int:
        crc: int = importlib.import_module("fieldscribe_runtime.modbus").crc(body)
        return crc


def soak(requests: int, faults: float, seed: int) -> bool:
    """Run and report; True if nothing was lost and nothing grew."""
    sys.path.insert(0, str(PACKAGES))
    device = behind_a_gateway(importlib.import_module("hitachi_l200").HitachiL200)
    tcp = importlib.import_module("fieldscribe_runtime.transports.tcp")
    fine = True
    for framing in ("tcp", "rtu"):
        other, lost, kept = Other(faults, seed), 0, [0, 0]
        with socket_end(other.answer) as port, tcp.TcpLine("127.0.0.1", port, framing=framing, timeout=TIMEOUT) as line:
            drive: Any = device(line, unit=1)
            drive.retries = 8
            before = time.monotonic()
            for number in range(requests):
                if number in (requests // 2, requests - 1):
                    gc.collect()
                    kept[number == requests - 1] = resident()
                address = number * 7 & 0xFFFF
                lost += drive.read_at("holding", address) != (0xFFFF - address,)
            took = time.monotonic() - before
        grown = kept[1] - kept[0]
        print(f"{framing}: {requests} reads in {took:.0f} s, {lost} lost, {grown} KiB more in the second half")
        print(f"  spoiled {other.spoiled}\n  {drive.traffic}", flush=True)
        fine = fine and not lost and grown <= MOST_GROWTH
    return fine


def resident() -> int:
    """Kibibytes of this process in memory."""
    return int(Path("/proc/self/statm").read_text("utf-8").split()[1]) * 4


def main() -> None:
    """Run with the arguments of the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--requests", type=int, default=100_000)
    parser.add_argument("--faults", type=float, default=0.05)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    sys.exit(0 if soak(arguments.requests, arguments.faults, arguments.seed) else "something was lost, or memory grew")


if __name__ == "__main__":
    main()
