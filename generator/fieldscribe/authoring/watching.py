"""Compiles devices whenever a file of theirs is saved: only those that changed, and those with errors again.

The states of files are asked for a few times a second: that works on every file system and needs no library, and a
folder of five devices costs a thousandth of a processor.
"""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from pathlib import Path
from time import monotonic
from typing import TYPE_CHECKING

from fieldscribe.diagnostics import Report
from fieldscribe.output.generation import Generation
from fieldscribe.pipeline import find_devices
from fieldscribe.safe_files import state_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from fieldscribe.output.writing import Result
    from fieldscribe.safe_files import State

INTERVAL, SETTLING = 0.25, 0.08
"""Seconds between two looks at the files, and between two looks at files that are being saved."""
_MOST_LOOKS = 25
_PARTS = (".yaml", ".yml")

States = dict[Path, dict[str, "State | None"]]
"""By device: the states of the files that may belong to it; None for one that cannot be looked at."""


@dataclass(slots=True)
class Outcome:
    """What one run did: the devices that it compiled, those that are gone, and how it ended."""

    devices: list[str]
    gone: list[str]
    report: Report
    result: Result
    seconds: float
    trouble: OSError | None = None
    """Why nothing could be written."""


@dataclass(slots=True)
class Watch:
    """The devices below some paths, and what is made of them where."""

    paths: list[Path]
    out: Path
    targets: tuple[str, ...]
    debug: Callable[[BaseException], None]
    waiting: Callable[[], None]
    """Called when another run writes to the same folder."""
    states: States = field(default_factory=dict)
    known: dict[str, Path] = field(default_factory=dict)
    """The devices by id, so that two descriptions of one device are noticed."""
    failed: set[Path] = field(default_factory=set)
    """What the last run could not compile or write."""

    def outcomes(self, stopped: Callable[[float], bool]) -> Iterator[Outcome]:
        """An outcome at the start and after each change, until `stopped`, which waits that many seconds, says so."""
        states = self._look()
        while True:
            changed = [file for file, state in states.items() if self.states.get(file) != state]
            gone = [file for file in self.states if file not in states]
            self.states = states
            yield self._run([file for file in states if file in changed or file in self.failed], gone)
            while states == self.states:
                if stopped(INTERVAL):
                    return
                states = self._settled(stopped)

    def _settled(self, stopped: Callable[[float], bool]) -> States:
        """The states, as soon as nobody is writing: a file that is half saved is not worth a finding."""
        states = self._look()
        for _ in range(_MOST_LOOKS if states != self.states else 0):
            if stopped(SETTLING):
                return self.states
            before, states = states, self._look()
            if states == before:
                break
        return states

    def _look(self) -> States:
        return {file: _files_beside(file) for file in find_devices(self.paths, Report())}

    def _run(self, device_files: list[Path], gone: list[Path]) -> Outcome:
        start = monotonic()
        report = Report()
        find_devices(self.paths, report)  # for what it finds wrong with the paths
        left = {*device_files, *gone}
        self.known = {device: file for device, file in self.known.items() if file not in left}
        generation = Generation(self.out, self.targets, report, self.debug, self.known)
        generation.load(device_files)
        loaded = {file for file, _ in generation.devices.values()}
        wrong = _errors(report)
        trouble = None
        try:
            generation.write(self.waiting, None, force=False)
        except OSError as error:
            trouble = error
        self.failed = set(device_files) - (set() if trouble or _errors(report) > wrong else loaded)
        names, lost = ([_name(file) for file in files] for files in (device_files, gone))
        return Outcome(names, lost, report, generation.result, monotonic() - start, trouble)


def _errors(report: Report) -> int:
    return sum(finding.severity == "error" for finding in report.findings)


def _name(device_file: Path) -> str:
    return Path(os.path.abspath(device_file)).parent.name


def _files_beside(device_file: Path) -> dict[str, State | None]:
    folder = device_file.parent
    try:
        names = [name for name in os.listdir(folder) if name.endswith(_PARTS)]
    except OSError:
        names = []
    return {name: _state(folder / name) for name in {device_file.name, *names}}


def _state(file: Path) -> State | None:
    try:
        return state_of(os.stat(file))
    except OSError:
        return None
