"""Measures the compiler as whole processes, and generated Python beside cantools: medians of several runs.

.venv/bin/python tests/bench/bench.py [--runs 5] [--sizes 100,1000,10000]
"""

from __future__ import annotations

import argparse
import os
import shutil
import statistics
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from python_bench import print_python
from synthetic import write_device

if TYPE_CHECKING:
    from collections.abc import Callable

ROOT = Path(__file__).resolve().parents[2]
FIELDSCRIBE = [str(Path(sys.executable).with_name("fieldscribe"))]


@dataclass(frozen=True)
class Figures:
    """Medians of several runs of one command."""

    seconds: float
    mebibytes: float


def measure(
    command: list[str], runs: int, before: Callable[[], None] = lambda: None, *, environment: dict[str, str]
) -> Figures:
    """Run a command once to warm up, then `runs` times; `before` restores what each run needs."""
    seconds, peaks = [], []
    for number in range(runs + 1):
        before()
        start = time.perf_counter()
        process = os.posix_spawn(
            command[0], command, environment, file_actions=[(os.POSIX_SPAWN_OPEN, 1, os.devnull, os.O_WRONLY, 0)]
        )
        _, status, usage = os.wait4(process, 0)
        took = time.perf_counter() - start
        if status != 0:
            raise SystemExit(f"{' '.join(command)} ended with {os.waitstatus_to_exitcode(status)}")
        if number:
            seconds.append(took)
            peaks.append(usage.ru_maxrss / 1024)
    return Figures(statistics.median(seconds), statistics.median(peaks))


def row(what: str, points: int | None, figures: Figures) -> None:
    """One line of the table."""
    rate = f"{points / figures.seconds:12,.0f}" if points else f"{'':12}"
    print(f"{what:<44} {points or '':>7} {figures.seconds:9.3f} s {figures.mebibytes:8.0f} MiB {rate}")


def bench_device(name: str, description: Path, points: int, runs: int, scratch: Path) -> None:
    """check, cold generate of all targets, and generate and its --check on unchanged input, for one description."""
    out = scratch / "out" / name
    environment = {**os.environ, "XDG_CACHE_HOME": str(scratch / "cache")}

    def forget() -> None:
        shutil.rmtree(out, ignore_errors=True)
        shutil.rmtree(scratch / "cache", ignore_errors=True)

    row(f"check {name}", points, measure([*FIELDSCRIBE, "check", str(description)], runs, environment=environment))
    generate = [*FIELDSCRIBE, "generate", str(description), "--out", str(out)]
    row(f"generate {name}, cold, all targets", points, measure(generate, runs, forget, environment=environment))
    row(f"generate {name}, unchanged", points, measure(generate, runs, environment=environment))
    row(f"generate --check {name}", points, measure([*generate, "--check"], runs, environment=environment))


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--sizes", default="100,1000,10000")
    arguments = parser.parse_args()
    print(f"{'what':<44} {'points':>7} {'wall':>11} {'peak':>12} {'points/s':>12}")
    row("--help", None, measure([*FIELDSCRIBE, "--help"], arguments.runs, environment=dict(os.environ)))
    with tempfile.TemporaryDirectory() as folder:
        scratch = Path(folder)
        counts = {one.parent: _points(one) for one in sorted(ROOT.glob("descriptions/*/device.yaml"))}
        for description, points in counts.items():
            bench_device(description.name, description, points, arguments.runs, scratch)
        bench_device("all devices", ROOT / "descriptions", sum(counts.values()), arguments.runs, scratch)
        for size in map(int, arguments.sizes.split(",")):
            bench_device(f"synthetic_{size}", write_device(scratch, size), size, arguments.runs, scratch)
    print_python(3 * arguments.runs)


def _points(description: Path) -> int:
    from fieldscribe.diagnostics import Report
    from fieldscribe.pipeline import load_device

    device = load_device(description, Report())
    return 0 if device is None else len(device.points)


if __name__ == "__main__":
    main()
