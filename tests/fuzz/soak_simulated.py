"""Reads a simulated drive over TCP whose answers are spoiled in all ways: each read ends as its fault explains.

A timeout that no fault explains is told from a slow machine by two witnesses: when the drive gave its answer, and a
thread that should run every few milliseconds. Only where one of them was late is a timeout put down to the machine.

PYTHONPATH=tests .venv/bin/python tests/fuzz/soak_simulated.py [--requests 200000] [--faults 0.05] [--seed 1]
"""

from __future__ import annotations

import argparse
import gc
import json
import sys
import threading
import time
from collections import Counter
from collections.abc import Iterator
from typing import Any, NamedTuple, Self

from fieldscribe.simulation import Simulated, simulated
from fieldscribe.simulation.line import KINDS
from support.places import PACKAGES
from support.python_package import imported
from support.python_transports import behind_a_gateway, transport

from fuzz.soak import MOST_GROWTH, resident

TIMEOUT = 0.1
"""Seconds for an answer."""
PATIENCE = 5.0
"""Seconds after which a request that has not come to the drive is lost."""
HEAD = 9
"""The bytes of an answer that are not the number itself, which nothing guards over TCP."""
GARBLED = {"timeout", "wrong_transaction", "bad_protocol", "long_frame", "short_frame", "wrong_unit", "wrong_function"}
GARBLED |= {"bad_byte_count", "exception"}
EXPLAINED = {
    "": {"ok"},
    "silent": {"timeout"},
    "late": {"timeout"},
    "cut": {"timeout"},
    "doubled": {"ok"},
    "check": {"wrong_transaction"},
    "unit": {"wrong_unit"},
    "function": {"wrong_function"},
    "exception": {"exception"},
    "damaged": GARBLED,
    "noise": GARBLED,
    "drop": {"line"},
}
"""How a read may end by each fault of its answer."""
POINTS = ("base_frequency", "acceleration_time", "output_frequency", "trip_count", "motor_current")


class Outcome(NamedTuple):
    """What came of a soak: reads by fault and end, those that nothing explains, and timeouts of a slow machine.

    `memory` has the kibibytes after a tenth, at the half and at the end.
    """

    ends: Counter[tuple[str, str]]
    findings: list[str]
    slow: int
    memory: tuple[int, int, int]

    @property
    def growth(self) -> int:
        """The kibibytes that the second half took."""
        return self.memory[2] - self.memory[1]


class Beats:
    """A thread that runs every few milliseconds as long as the context lasts, and notes when it could not."""

    def __init__(self) -> None:
        self._last, self._missed, self._ends = time.monotonic(), 0.0, threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._ends.set()
        self._thread.join()

    def _run(self) -> None:
        while not self._ends.wait(0.005):
            now = time.monotonic()
            self._missed, self._last = max(self._missed, now - self._last), now

    def longest(self) -> float:
        """Return the longest time without a beat since the last call."""
        longest, self._missed = max(self._missed, time.monotonic() - self._last), 0.0
        return longest


def faults(share: float, timeout: float) -> Iterator[str]:
    """Yield faults of all kinds, each as often as the others, at all bytes where a place matters."""
    for kind in KINDS:
        end = HEAD - 1 if kind == "noise" else HEAD  # it may be a count, and the next of it a number
        places: tuple[object, ...] = (*range(end),) if kind in ("cut", "damaged", "noise", "drop") else ("",)
        for place in (3 * timeout,) if kind == "late" else places:
            yield f"{kind} {place} {100 * share / len(KINDS) / len(places):.6f}%"


def soak(requests: int, share: float, seed: int, timeout: float = TIMEOUT) -> Outcome:
    """Read the points of a drive in turn, so many times, while a share of the answers is spoiled."""
    struck: list[tuple[float, str]] = []
    ends, findings = Counter[tuple[str, str]](), list[str]()
    slow, start = 0, resident()
    half = start
    spoils = [*faults(share, timeout)]

    def note(entry: str) -> None:
        struck.append((time.monotonic(), entry))

    with Beats() as beats, simulated("hitachi_l200", on="tcp", seed=seed, trace=note, faults=spoils) as drive:
        right = {name: drive.values[name] for name in POINTS}
        for client in clients(drive, timeout):
            for number in range(requests):
                if number == requests // 10:
                    start = resident()
                if number == requests // 2:
                    gc.collect()
                    half = resident()
                name = POINTS[number % len(POINTS)]
                struck.clear()
                beats.longest()
                began = time.monotonic()
                end = read(client, name, right[name])
                stalled = beats.longest()
                answered, fault = struck_by(struck)
                ends[fault, end] += 1
                if end in EXPLAINED.get(fault, ()):
                    continue
                is_slow = max(answered - began, stalled) > timeout / 4
                if fault in EXPLAINED and is_slow and (end == "timeout" or (fault, end) == ("late", "ok")):
                    slow += 1
                else:
                    findings.append(f"read {number} of {name}: {end} by {fault or 'no fault'}")
            gc.collect()
    return Outcome(ends, findings, slow, (start, half, resident()))


def struck_by(struck: list[tuple[float, str]]) -> tuple[float, str]:
    """Return when the one answer since a read began was given, and its fault."""
    end = time.monotonic() + PATIENCE
    while not struck and time.monotonic() < end:
        time.sleep(0.001)  # the request is still on its way
    if len(struck) != 1:
        return end, f"{len(struck)} requests"
    at, entry = struck[0]
    return at, json.loads(entry)["fault"] or ""


def clients(drive: Simulated, timeout: float) -> Iterator[Any]:
    """Yield the generated class on the line of the drive; it never repeats a request."""
    for package in imported(PACKAGES, "hitachi_l200"):
        with transport("tcp").TcpLine("127.0.0.1", drive.port, timeout=timeout) as line:
            client = behind_a_gateway(package.HitachiL200)(line, unit=drive.unit)
            client.retries = 0
            yield client


def read(client: Any, name: str, right: object) -> str:
    """Return the status with which a read ends."""
    try:
        value = getattr(client, name).read()
    except Exception as error:  # of this copy of the runtime
        return getattr(error, "status", repr(error))
    return "ok" if value == right else f"the wrong value {value!r}"


def main() -> None:
    """Run with the arguments of the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--requests", type=int, default=200_000)
    parser.add_argument("--faults", type=float, default=0.05)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--timeout", type=float, default=TIMEOUT)
    arguments = parser.parse_args()
    outcome = soak(arguments.requests, arguments.faults, arguments.seed, arguments.timeout)
    for (fault, end), count in sorted(outcome.ends.items()):
        print(f"{count:>9,}  {fault or 'no fault':<10} {end}")
    spoiled = sum(count for (fault, _), count in outcome.ends.items() if fault)
    print(f"{arguments.requests:,} reads, {spoiled:,} faults, {outcome.slow:,} timeouts of a slow machine")
    print(
        f"{len(outcome.findings)} that nothing explains; KiB after a tenth, at the half, at the end: {outcome.memory}"
    )
    print(*outcome.findings[:20], sep="\n")
    sys.exit("a read was lost, or memory grew" if outcome.findings or outcome.growth > MOST_GROWTH else 0)


if __name__ == "__main__":
    main()
