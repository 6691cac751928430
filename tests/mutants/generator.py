"""Mutants of the compiler: does an output change, or does a test fail?

A parent that has loaded everything but the compiler forks a child for each mutant, which imports the changed module
from memory. The child compiles the devices whose compilation enters the changed function and compares with what the
sound compiler made of them, the small ones first; then it runs the tests that enter it, those that enter little first.
The tests of the mutant's room are asked alone before: most mutants need no more, and the others need not be measured.
"""

from __future__ import annotations

import importlib
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import cached_property
from pathlib import Path
from types import CodeType
from typing import Any

import pytest

from mutants.children import StoppedError, in_child
from mutants.importing import compiled, use
from mutants.judges import KILLED, LEFT_OUT, ROOT, SURVIVED, Verdict
from mutants.noticing import TARGETS, FileOfTests, Witness, compiled_to, measured_output, measured_tests, run_tests
from mutants.rooms import HOUSE, MODULE, place_of
from mutants.sources import Mutant

TESTED = 12.0
"""Seconds of tests for one mutant, by what they took when they were measured."""
BESIDE = 3.0
"""Seconds of tests in a file that do not enter the changed function themselves; they may read what another one made."""
STARTED = 0.3
"""Seconds that a file of tests takes before its first test."""
LIMIT = 45
"""Seconds of a processor after which a mutant is taken to hang."""
_PROGRAM = 'if __name__ == "__main__":'
"""What a module has that others run as a process of its own."""
_LOADED = ("jinja2", "yaml", "hypothesis", "jsonschema")

Codes = dict[str, CodeType]
Output = tuple[Witness, str, str, dict[str, str]]
"""How an output was made, its device and target, and what was made."""

NOBODY, IMPORT = "nobody", "it does not import"


class GeneratorJudge:
    """Knows which outputs and tests enter a function, and runs them against a mutant."""

    def __init__(self, work: Path, compiled_devices: Iterable[str], tests: Iterable[Path]) -> None:
        sys.pycache_prefix = str(work / "python")
        sys.dont_write_bytecode = False
        for name in _LOADED:
            importlib.import_module(name)
        self._measured, self._devices, self._tests = work / "measured", list(compiled_devices), list(tests)
        self._files: dict[Path, FileOfTests] = {}
        self._program, self._programs = work / "program.py", dict[str, str]()
        self.codes = compiled()
        self.sound: dict[str, bool] = {}

    @cached_property
    def outputs(self) -> list[Output]:
        """Each output of each device, with the functions that making it enters."""
        made = [(device, target) for device in self._devices for target in TARGETS]
        found = [(device, target, measured_output(device, target, self._measured)) for device, target in made]
        return [(judge, device, target, texts) for device, target, (judge, texts) in found]

    def files(self, folder: Path) -> list[FileOfTests]:
        """The files of tests in a folder, measured once."""
        paths = [path for path in self._tests if path.is_relative_to(folder)]
        for path in paths:
            if path not in self._files:
                self._files[path] = measured_tests(path, self._measured)
        return [self._files[path] for path in paths]

    def verdict(self, mutant: Mutant) -> Verdict:
        """Return the first output or test that notices the mutant."""
        path = HOUSE / mutant.path
        try:
            code = compile(mutant.text, path, "exec", dont_inherit=True)
        except (SyntaxError, ValueError):
            return Verdict(LEFT_OUT, "it does not compile")
        place, codes = place_of(mutant), {**self.codes, str(path): code}
        if _PROGRAM in mutant.text:
            self._program.write_text(mutant.text, "utf-8")
            self._programs, place = {str(path): str(self._program)}, f"{mutant.path}::{MODULE}"
        of_room = self.files(ROOT / "tests" / mutant.kind)
        by = self._noticed(codes, mutant.path, place, of_room, [])
        if not by:
            others = [file for file in self.files(ROOT / "tests") if file not in of_room]
            by = self._noticed(codes, mutant.path, place, others, self.outputs)
        self._programs = {}
        return Verdict(LEFT_OUT, by) if by == IMPORT else Verdict(KILLED if by else SURVIVED, by)

    def _noticed(
        self, codes: Codes, changed: str, place: str, files: Sequence[FileOfTests], outputs: Sequence[Output]
    ) -> str:
        """Return the name of what notices a changed file, sound tests alone; empty if nothing does."""
        while True:
            by = self._asked(
                codes, changed, self.chosen(place, files), [one for one in outputs if place in one[0].enters]
            )
            if by == NOBODY:
                return ""
            if not by.startswith("tests/") or self._is_sound(by):
                return by

    def _asked(self, codes: Codes, changed: str, tests: dict[Path, list[str]], outputs: Sequence[Output]) -> str:
        """Return the name of what notices a changed file, judged in a child process."""

        def work(tell: Callable[[Any], None]) -> None:
            use(codes, self._programs)
            tell(_import_fails(changed) or _output_that_differs(outputs) or _test_that_fails(tests) or NOBODY)

        try:
            return str(in_child(work, LIMIT)[-1])
        except StoppedError as stopped:
            return str(stopped)

    def chosen(self, place: str, files: Sequence[FileOfTests]) -> dict[Path, list[str]]:
        """Return the tests to run, by file, within the time limit: those that enter few functions first."""
        known = [(file, test) for file in files for test in entering(file, place) if self._may_judge(test)]
        found: dict[Path, list[str]] = {}
        left = TESTED
        for file, test in sorted(known, key=lambda one: (len(one[1].enters), one[1].seconds)):
            cost = test.seconds + (0 if file.path in found else STARTED)
            if cost <= left:
                left -= cost
                found.setdefault(file.path, []).append(test.name)
        for file in files:
            if file.path in found:
                found[file.path] += self._beside(file, set(found[file.path]))
        return found

    def _beside(self, file: FileOfTests, chosen: set[str]) -> Iterator[str]:
        left = BESIDE
        for test in file.tests:
            if test.name not in chosen and test.seconds <= left and self._may_judge(test):
                left -= test.seconds
                yield test.name

    def _may_judge(self, test: Witness) -> bool:
        return self.sound.get(test.name, True)

    def _is_sound(self, name: str) -> bool:
        """Whether a test passes alone without a change: one that does not can tell nothing.

        A file that cannot be read is taken as sound: without a change it was read when it was measured.
        """
        if "::" not in name:
            return True
        if name not in self.sound:

            def work(tell: Callable[[Any], None]) -> None:
                use(self.codes)
                tell(_failing(ROOT / name.partition("::")[0], [name]))

            try:
                self.sound[name] = in_child(work, LIMIT) == [""]
            except StoppedError:
                self.sound[name] = False
            if not self.sound[name]:
                print(f"{name} fails alone without a change, so it is left out")
        return self.sound[name]


def entering(file: FileOfTests, place: str) -> Sequence[Witness]:
    """The tests of a file that enter a function; of what runs at import, those that enter anything of the module."""
    direct = [test for test in file.tests if place in test.enters]
    module, _, function = place.partition("::")
    if (function and direct) or place not in file.enters:
        return direct
    using = [test for test in file.tests if any(one.startswith(f"{module}::") for one in test.enters)]
    return using or file.tests


def _output_that_differs(outputs: Iterable[Output]) -> str:
    """Return the first output that differs; the devices of the tests come first."""
    return next((judge.name for judge, device, target, made in outputs if _differs(device, target, made)), "")


def _test_that_fails(tests: dict[Path, list[str]]) -> str:
    return next((failing for path, names in tests.items() if (failing := _failing(path, names))), "")


def _import_fails(changed: str) -> str:
    name = changed.removesuffix(".py").removesuffix("/__init__").replace("/", ".")
    try:
        importlib.import_module(name)
    except Exception:  # whatever a mutant does
        return IMPORT
    return ""


def _differs(device: str, target: str, made: dict[str, str]) -> bool:
    try:
        return compiled_to(device, target) != made
    except Exception:  # whatever a mutant does
        return True


def _failing(path: Path, names: list[str]) -> str:
    """Return the first of these tests that fails, or the file if it cannot be imported."""
    chosen = Chosen(names)
    code = run_tests([path], chosen, "-x")
    return chosen.failing or (path.relative_to(ROOT).as_posix() if code else "")


class Chosen:
    """Some tests of a file, in a given order, until one fails."""

    def __init__(self, names: list[str]) -> None:
        self._order = {name: at for at, name in enumerate(names)}
        self.failing = ""

    @pytest.hookimpl(trylast=True)
    def pytest_collection_modifyitems(self, items: list[pytest.Item]) -> None:
        """Leave out the others."""
        items[:] = sorted((one for one in items if one.nodeid in self._order), key=lambda one: self._order[one.nodeid])

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Take note of the first that fails."""
        if report.failed and not self.failing:
            self.failing = report.nodeid
