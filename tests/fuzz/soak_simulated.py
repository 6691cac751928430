"""Reads a simulated drive over TCP whose answers are spoiled in all ways: each read ends as its fault explains.

PYTHONPATH=tests .venv/bin/python tests/fuzz/soak_simulated.py [--requests 200000] [--faults 0.05] [--seed 1]
"""

from __future__ import annotations

import argparse
import gc
import json
import sys
import time
from collections import Counter
from collections.abc import Iterator
from typing import Any, NamedTuple

from fieldscribe.simulation import Simulated, simulated
from fieldscribe.simulation.faults import KINDS
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
    "busy": {"timeout", "ok"},
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
"""How a read may end by each fault of its answer; `busy` is a machine that was slow to give an answer without one."""
POINTS = ("base_frequency", "acceleration_time", "output_frequency", "trip_count", "motor_current")


class Outcome(NamedTuple):
    """What came of a soak: reads by fault and end, those that nothing explains, and kibibytes of the second half."""

    ends: Counter[tuple[str, str]]
    findings: list[str]
    growth: int


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
    kept = resident()
    outcome = Outcome(Counter(), [], 0)
    spoils = [*faults(share, timeout)]

    def note(entry: str) -> None:
        struck.append((time.monotonic(), entry))

    with simulated("hitachi_l200", on="tcp", seed=seed, trace=note, faults=spoils) as drive:
        right = {name: drive.values[name] for name in POINTS}
        for client in clients(drive, timeout):
            for number in range(requests):
                if number == requests // 2:
                    gc.collect()
                    kept = resident()
                name = POINTS[number % len(POINTS)]
                struck.clear()
                began = time.monotonic()
                end = read(client, name, right[name])
                fault = struck_by(struck, began + timeout / 2)
                outcome.ends[fault, end] += 1
                if end not in EXPLAINED.get(fault, ()):
                    outcome.findings.append(f"read {number} of {name}: {end} by {fault or 'no fault'}")
            gc.collect()
    return outcome._replace(growth=resident() - kept)


def struck_by(struck: list[tuple[float, str]], busy: float) -> str:
    """Return the fault of the one answer since a read began; `busy` is the time after which any answer is late."""
    end = time.monotonic() + PATIENCE
    while not struck and time.monotonic() < end:
        time.sleep(0.001)  # the request is still on its way
    if len(struck) != 1:
        return f"{len(struck)} requests"
    at, entry = struck[0]
    return json.loads(entry)["fault"] or ("busy" if at > busy else "")


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
    arguments = parser.parse_args()
    outcome = soak(arguments.requests, arguments.faults, arguments.seed)
    for (fault, end), count in sorted(outcome.ends.items()):
        print(f"{count:>9,}  {fault or 'no fault':<10} {end}")
    print(f"{arguments.requests:,} reads, {len(outcome.findings)} that nothing explains, {outcome.growth} KiB more")
    print(*outcome.findings[:20], sep="\n")
    sys.exit("a read was lost, or memory grew" if outcome.findings or outcome.growth > MOST_GROWTH else 0)


if __name__ == "__main__":
    main()
