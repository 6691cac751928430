"""Compiles devices whenever one of their files is saved: changed ones, and those that failed before.

The files are polled a few times a second. That works on every file system and without a library; five devices cost a
thousandth of a processor.
"""

import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from time import monotonic

from fieldscribe.diagnostics import Report
from fieldscribe.output.generation import Generation
from fieldscribe.output.memory import Result
from fieldscribe.pipeline import find_devices
from fieldscribe.safe_files import State, state_at

INTERVAL, SETTLING = 0.25, 0.08
"""Seconds between two polls, and between two polls while files are being saved."""
_MOST_POLLS = 25
_PARTS = (".yaml", ".yml")

States = dict[Path, dict[str, "State | None"]]
"""By device the states of its possible files; None for a file that cannot be read."""


@dataclass(slots=True)
class Outcome:
    """The result of one run: the compiled devices, the removed ones, and its findings and files."""

    devices: list[str]
    gone: list[str]
    report: Report
    result: Result
    seconds: float
    trouble: OSError | None = None
    """The reason why nothing could be written."""


@dataclass(slots=True)
class Watch:
    """Watches the devices below some paths and compiles them into a folder."""

    paths: list[Path]
    out: Path
    targets: tuple[str, ...]
    waiting: Callable[[], None]
    """Called when another run writes to the same folder."""
    states: States = field(default_factory=dict)
    known: dict[str, Path] = field(default_factory=dict)
    """The devices by id, to detect two descriptions of one device."""
    failed: set[Path] = field(default_factory=set)
    """The devices that the last run could not compile or write."""

    def outcomes(self, stopped: Callable[[float], bool]) -> Iterator[Outcome]:
        """Yield an outcome at the start and after each change.

        `stopped` waits for a number of seconds and returns True to end.
        """
        states = self._poll()
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
        """Return the states once nobody is writing, so that no partly saved file is compiled."""
        states = self._poll()
        for _ in range(_MOST_POLLS if states != self.states else 0):
            if stopped(SETTLING):
                return self.states
            before, states = states, self._poll()
            if states == before:
                break
        return states

    def _poll(self) -> States:
        return {file: _files_beside(file) for file in find_devices(self.paths, Report())}

    def _run(self, device_files: list[Path], gone: list[Path]) -> Outcome:
        start = monotonic()
        report = Report()
        find_devices(self.paths, report)  # reports errors of the paths
        left = {*device_files, *gone}
        self.known = {device: file for device, file in self.known.items() if file not in left}
        generation = Generation(self.out, self.targets, report, self.known)
        generation.load(device_files)
        loaded = {file for file, _ in generation.devices.values()}
        wrong = report.count_of("error")
        trouble = None
        try:
            generation.write(self.waiting, None, force=False)
        except OSError as error:
            trouble = error
        self.failed = set(device_files) - (set() if trouble or report.count_of("error") > wrong else loaded)
        names, lost = ([_name(file) for file in files] for files in (device_files, gone))
        return Outcome(names, lost, report, generation.result, monotonic() - start, trouble)


def _name(device_file: Path) -> str:
    return Path(os.path.abspath(device_file)).parent.name


def _files_beside(device_file: Path) -> dict[str, State | None]:
    folder = device_file.parent
    try:
        names = [name for name in os.listdir(folder) if name.endswith(_PARTS)]
    except OSError:
        names = []
    return {name: state_at(folder / name) for name in {device_file.name, *names}}
