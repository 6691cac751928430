"""Measures which outputs and tests enter a function of the compiler: only those can notice a change of it.

A measurement stays good while the functions of the compiler have the same names and the test file is the same: what
changes inside of a function rarely changes who enters it.
"""

from __future__ import annotations

import json
import os
import shutil
import time
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from mutants.children import StoppedError, in_child
from mutants.importing import SEEN, telling, use
from mutants.judges import ROOT
from mutants.rooms import MODULE, functions, rooms

if TYPE_CHECKING:  # a mutant of the compiler is judged in a process that has not loaded it
    from fieldscribe.model import Device

TESTS = ROOT / "tests"
TARGETS = ("c", "python", "rust", "typescript", "docs", "vectors")
_TOLD = {"test_bad.py": "bad", "test_transcripts.py": "transcripts"}
"""Files whose tests stand in a folder beside them."""
MEASURED = 120
"""Seconds of a processor for which a file of tests is measured; what comes later is no judge."""


@dataclass(frozen=True, slots=True)
class Witness:
    """A test, or the output of a device for a target: the functions it enters, and its seconds."""

    name: str
    seconds: float
    enters: frozenset[str]


@dataclass(frozen=True, slots=True)
class FileOfTests:
    """The tests of a file, in its order, and what they enter together, imports among it."""

    path: Path
    tests: tuple[Witness, ...]
    enters: frozenset[str]


def devices() -> dict[str, Path]:
    """The made devices, then the shipped ones, each with the small ones first."""
    found: dict[str, Path] = {}
    for folder in (TESTS / "devices", ROOT / "descriptions"):
        found |= {path.parent.name: path for path in sorted(folder.glob("*/device.yaml"), key=_size_with_parts)}
    return found


def _size_with_parts(device_file: Path) -> int:
    return sum(part.stat().st_size for part in device_file.parent.iterdir())


def compiled_to(device: str, target: str) -> dict[str, str]:
    """The outputs of a device by their paths, as digests, and what was found in it."""
    from fieldscribe.pipeline import outputs

    made, findings = _loaded(device)
    found = {"findings": findings}
    if made is not None:
        found |= {path: sha256(text.encode()).hexdigest() for _, path, text in outputs(made, (target,))}
    return found


@cache
def _loaded(device: str) -> tuple[Device | None, str]:
    from fieldscribe.diagnostics import Report
    from fieldscribe.pipeline import load_device

    report = Report()
    made = load_device(devices()[device], report)
    return made, repr(report.findings)


def measured_output(device: str, target: str, folder: Path) -> tuple[Witness, dict[str, str]]:
    """Return the functions that compiling a device to a target enters, and the output."""

    def work(tell: Callable[[Any], None]) -> None:
        use(telling())
        start = time.process_time()
        made = compiled_to(device, target)
        tell({"made": made, "seconds": time.process_time() - start, "enters": sorted(SEEN)})

    inputs = [ROOT / "generator/fieldscribe", ROOT / "templates", devices()[device].parent]
    file = folder / f"{device}-{target}-{_digest(inputs)}.json"
    ((data),) = _kept(file, lambda: in_child(work, MEASURED))
    return Witness(f"{target} of {device}", data["seconds"], frozenset(data["enters"])), data["made"]


def measured_tests(path: Path, folder: Path) -> FileOfTests:
    """Return the functions that the passing core tests of a file enter."""
    shared = [*TESTS.glob("*.py"), *(TESTS / "support").glob("*.py")]
    told = _TOLD.get(path.name)
    file = folder / f"{path.stem}-{_digest([path, *shared, *([TESTS / told] if told else [])], _names())}.json"
    rows = _kept(file, lambda: _measured(path))
    tests = [Witness(row["name"], row["seconds"], frozenset(row["enters"])) for row in rows if row.get("name")]
    return FileOfTests(path, tuple(tests), frozenset(one for row in rows for one in row["enters"]))


def _measured(path: Path) -> list[Any]:
    """A line for each test, and one for what was entered before the first."""

    def work(tell: Callable[[Any], None]) -> None:
        use(telling())
        run_tests([path], Measuring(tell))

    try:
        return in_child(work, MEASURED)
    except StoppedError as stopped:
        print(f"{path.name} is measured in part: {stopped}", flush=True)
        return stopped.told


def run_tests(paths: Iterable[Path], plugin: object, *more: str) -> int:
    """Run tests of the core suite in this process."""
    scratch = ROOT / ".cache/mutants/scratch"
    options = ["-q", "-p", "no:cacheprovider", "-p", "no:xdist", "-m", "not full", "--rootdir", str(ROOT)]
    base = scratch / str(os.getpid())
    scratch.mkdir(parents=True, exist_ok=True)
    os.chdir(ROOT)
    try:
        return pytest.main([*options, *more, "--basetemp", str(base), *map(str, paths)], plugins=[plugin])
    finally:
        shutil.rmtree(base, ignore_errors=True)


class Measuring:
    """Tells of each test that passes what it entered and how long it took."""

    def __init__(self, tell: Callable[[Any], None]) -> None:
        self._tell = tell
        self._failed = False

    def pytest_collection_finish(self) -> None:
        """What importing the tests entered."""
        self._tell({"enters": sorted(SEEN)})
        SEEN.clear()

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Iterator[None]:
        """Measure one test."""
        self._failed, start = False, _spent()
        result = yield
        if not self._failed:
            self._tell({"name": item.nodeid, "seconds": _spent() - start, "enters": sorted(SEEN)})
        SEEN.clear()
        return result

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Take note of what does not pass."""
        self._failed |= report.outcome != "passed"


def _spent() -> float:
    """Seconds of a processor, those of ended children among them."""
    return sum(os.times()[:4])


@cache
def _names() -> str:
    """The names of all functions."""
    sources = [source for room in rooms().values() for source in room]
    return "\n".join(
        f"{source.path}::{name}" for source in sources for *_, name in [*functions(source), (0, 0, MODULE)]
    )


def _kept(file: Path, measure: Callable[[], list[Any]]) -> list[Any]:
    """Return the stored measurement, or measure now and store it; the file lists each function once."""
    if file.exists():
        names, rows = json.loads(file.read_text("utf-8"))
        return [row | {"enters": [names[number] for number in row["enters"]]} for row in rows]
    rows = measure()
    numbers: dict[str, int] = {}
    for row in rows:
        for name in row["enters"]:
            numbers.setdefault(name, len(numbers))
    file.parent.mkdir(parents=True, exist_ok=True)
    for old in file.parent.glob(f"{file.stem.rpartition('-')[0]}-*.json"):
        old.unlink()
    short = [row | {"enters": [numbers[name] for name in row["enters"]]} for row in rows]
    file.write_text(json.dumps([list(numbers), short]), encoding="utf-8")
    return rows


def _digest(paths: Iterable[Path], more: str = "") -> str:
    total = sha256(more.encode())
    for path in paths:
        for file in sorted(path.rglob("*")) if path.is_dir() else [path]:
            if file.is_file() and file.suffix != ".pyc":
                total.update(file.name.encode() + b"\0" + file.read_bytes())
    return total.hexdigest()[:16]
