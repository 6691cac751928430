"""Measures the compiler, generated Python and C on Cortex-M0 beside cantools, pymodbus and C by hand: medians.

.venv/bin/python tests/bench/bench.py [--runs 5]

A ratio to cantools of the same run travels between machines; a time does not.
"""

from __future__ import annotations

import argparse
import os
import shutil
import statistics
import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

from fieldscribe.simulation import simulated
from line_bench import print_lines
from m0_bench import print_m0
from python_bench import print_python
from simulation_bench import print_simulation
from stream_bench import CANTOOLS, FIELDSCRIBE, KEEPS_BYTECODE, print_listening, print_streams
from synthetic import write_dbc, write_device
from typescript_bench import print_typescript

ROOT = Path(__file__).resolve().parents[2]
MANY, FEW = 10_000, 1_000
STREAMED = 50_000
CODE = "c,python,rust"
ALL = "c,python,rust,docs,vectors"
SIX = "c,python,rust,typescript,docs,vectors"
MOST_MEBIBYTES = 125


@dataclass
class Command:
    """A command line, what is done before each run of it, and what its runs took."""

    words: list[str]
    cache: Path
    before: Callable[[], None] = lambda: None
    seconds: list[float] = field(default_factory=list)
    mebibytes: list[float] = field(default_factory=list)

    def run(self, *, counts: bool) -> None:
        """Run it once; the first run of a command only warms up."""
        self.before()
        start = time.perf_counter()
        environment = {**os.environ, **KEEPS_BYTECODE, "XDG_CACHE_HOME": str(self.cache)}
        silent = [(os.POSIX_SPAWN_OPEN, 1, os.devnull, os.O_WRONLY, 0)]
        process = os.posix_spawn(self.words[0], self.words, environment, file_actions=silent)
        _, status, usage = os.wait4(process, 0)
        took = time.perf_counter() - start
        if status != 0:
            raise SystemExit(f"{' '.join(self.words)} ended with {os.waitstatus_to_exitcode(status)}")
        if counts:
            self.seconds.append(took)
            self.mebibytes.append(usage.ru_maxrss / 1024)

    @property
    def median(self) -> float:
        """Seconds."""
        return statistics.median(self.seconds)


@dataclass(frozen=True)
class Row:
    """A command held against another one, and the most that the ratio may be."""

    what: str
    command: Command
    peer: Command
    mark: float
    share: float = 1.0
    """How much of the peer's work the command has."""


SHIPPED = ("hitachi_l200", "jumo_controller", "nord_sk5xxe", "siemens_mm4", "woodward_mpu2s")
"""The devices whose figures the marks are about."""


class Bench:
    """All commands, in one scratch folder."""

    def __init__(self, scratch: Path, port: int) -> None:
        self.scratch = scratch
        self.many = self._cantools(MANY)
        self.few = self._cantools(FEW)
        alike, varied = write_device(scratch, MANY), write_device(scratch, MANY, "varied", varied=True)
        for name in SHIPPED:
            shutil.copytree(ROOT / "descriptions" / name, scratch / "five" / name)
        shipped = scratch / "five"
        explain, line = self._about("explain"), f"tcp://127.0.0.1:{port}"
        cold, thousand = self._generate(alike, ALL), self._generate(write_device(scratch, FEW), ALL)
        self.rows = [
            Row("10,000 points of ten shapes: C, Python, Rust", self._generate(alike, CODE), self.many, 1.25),
            Row("  C alone, which is what cantools makes", self._generate(alike, "c"), self.many, 0.8),
            Row("  the five targets", cold, self.many, 1.6),
            Row("  the six targets, with TypeScript", self._generate(alike, SIX), self.many, 1.7),
            Row("10,000 varied points: C, Python, Rust", self._generate(varied, CODE), self.many, 1.45),
            Row("  the five targets", self._generate(varied, ALL), self.many, 2.0),
            Row("five devices, the five targets, to its 1,000", self._generate(shipped, ALL), self.few, 1.2),
            Row("check of 25 points", self._check(write_device(scratch, 25)), self.many, 0.12),
            Row("check of 10,000 points", self._check(alike), self.many, 0.4),
            Row("10,000 unchanged", self._generate(alike, ALL, kept=True), self.many, 0.025),
            Row("five devices unchanged", self._generate(shipped, ALL, kept=True), self.many, 0.025),
            Row("a point edited among 10,000, to the cold run", self._edited(), cold, 0.6),
            Row("time of a point, 10,000 to 1,000", cold, thousand, 1.0, MANY / FEW),
            Row(
                "read of a point, to explain of it",
                self._about("read", "--line", line),
                explain,
                1.5,
            ),
        ]

    def _cantools(self, count: int) -> Command:
        file = write_dbc(self.scratch, count)
        out = self.scratch / f"cantools_{count}"
        words = [CANTOOLS, "generate_c_source", str(file), "-o", str(out)]
        return Command(words, self.scratch, lambda: shutil.rmtree(out, ignore_errors=True))

    def _check(self, description: Path) -> Command:
        return Command([FIELDSCRIBE, "check", str(description)], self.scratch)

    def _about(self, command: str, *options: str) -> Command:
        return Command([FIELDSCRIBE, command, "hitachi_l200", "A020", *options], self.scratch)

    def _generate(self, description: Path, targets: str, *, kept: bool = False) -> Command:
        """With an empty output folder and an empty cache, or on what the same command left there."""
        folder = self.scratch / f"{description.name}-{targets}-{'kept' if kept else 'cold'}"
        words = [FIELDSCRIBE, "generate", str(description), "--target", targets, "--out", str(folder / "out")]
        forget = partial(shutil.rmtree, folder, ignore_errors=True)
        return Command(words, folder / "cache") if kept else Command(words, folder / "cache", forget)

    def _edited(self) -> Command:
        """A limit of one point changes before each run."""
        place = write_device(self.scratch, MANY, "edited")
        part = place / "group_7.yaml"
        text = part.read_text("utf-8")
        limits: Iterator[int] = iter(range(1_000, 4_000))

        def edit() -> None:
            part.write_text(text.replace("range: 0..4000", f"range: 0..{next(limits)}", 1), "utf-8")

        command = self._generate(place, ALL, kept=True)
        command.before = edit
        return command

    def run(self, runs: int) -> None:
        """All commands in turn, so that a busy moment meets them all."""
        commands = [self.many, self.few, *(row.command for row in self.rows), *(row.peer for row in self.rows)]
        different = {id(command): command for command in commands}.values()
        for number in range(runs + 1):
            for command in different:
                command.run(counts=number > 0)

    def table(self) -> Iterator[str]:
        """One line a row, the peers first."""
        yield f"{'what':<48} {'seconds':>8} {'MiB':>5} {'ratio':>7} {'mark':>6}"
        for what, command in (("cantools, 10,000 signals", self.many), ("cantools, 1,000 signals", self.few)):
            yield f"{what:<48} {command.median:8.3f} {max(command.mebibytes):5.0f}"
        for row in self.rows:
            ratio = row.command.median / row.peer.median / row.share
            figures = f"{row.command.median:8.3f} {max(row.command.mebibytes):5.0f} {ratio:7.3f} {row.mark:6.3f}"
            yield f"{row.what:<48} {figures}{'' if ratio <= row.mark else '  over'}"
        peak = max(max(row.command.mebibytes) for row in self.rows)
        yield f"{'peak':<48} {'':8} {peak:5.0f} {'':7} {MOST_MEBIBYTES:6}{'' if peak <= MOST_MEBIBYTES else '  over'}"


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--runs", type=int, default=5)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder, simulated("hitachi_l200") as drive:
        bench = Bench(Path(folder), drive.port)
        bench.run(arguments.runs)
        print(*bench.table(), sep="\n", flush=True)
    print_lines(3 * arguments.runs)
    print_simulation(3 * arguments.runs)
    print_python(3 * arguments.runs)
    print_typescript()
    print_streams(STREAMED)
    print_listening(STREAMED)
    print_m0()


if __name__ == "__main__":
    main()
