"""Whether the conformance vectors notice a changed file: one command a language, run as users run it."""

from __future__ import annotations

import json
import os
import re
import resource
import shutil
import subprocess
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from mutants.batches import CHOICE, CHOOSES, Variant, blamed, body_around, switched
from mutants.sources import RUNTIME, Mutant

RUN_LIMIT, BUILD_LIMIT = 120, 600
"""Seconds of waiting for a program and for a compiler."""
MEMORY = 4 << 30
"""What a mutant that runs away may take."""

ROOT = Path(__file__).resolve().parents[2]
FAMILIES = ("modbus", "can", "uss")

KILLED, SURVIVED, LEFT_OUT = "killed", "survived", "left out"


Way = tuple[str, tuple[str, ...]]
"""A device and how its program is built."""


class Verdict(NamedTuple):
    """The outcome of a mutant, and what noticed it or why it is left out."""

    outcome: str
    by: str


Command = tuple[object, ...]


class DoesNotBuildError(Exception):
    """The changed file does not compile or import; the second argument holds the compiler's messages."""


class Judge:
    """Runs the vectors of devices against a copy of the output in which one file is changed."""

    language = ""
    builds: tuple[tuple[str, ...], ...] = ((),)
    cpu_limit = 10
    """Seconds of work after which a program is taken to hang."""

    def __init__(self, base: Path, work: Path) -> None:
        self.work = work / self.language
        self.base = base
        shutil.rmtree(self.work, ignore_errors=True)
        for part in (self.language, "vectors"):
            shutil.copytree(base / part, self.work / part)
        sized = sorted((path.stat().st_size, path.name) for path in (base / "vectors").iterdir() if path.is_file())
        self.vectors = {name.partition(".")[0]: self.work / "vectors" / name for _, name in sized}
        self.sound: dict[Way, bool] = {}
        self.prepare()

    def prepare(self) -> None:
        """Prepare what all mutants share."""

    def passes(self, device: str, build: Sequence[str]) -> bool:
        """Whether all vectors of a device pass. Raises DoesNotBuildError."""
        raise NotImplementedError

    def verdicts(self, mutants: Iterable[Mutant]) -> Iterator[tuple[Mutant, Verdict]]:
        """Judge each mutant, in any order."""
        return ((mutant, self.verdict(mutant)) for mutant in mutants)

    def verdict(self, mutant: Mutant) -> Verdict:
        """Run the devices that use the file, the small ones first, until one fails that passes without the change."""
        while True:
            ways = [(device, build) for build in self.builds for device in self.users(mutant, build)]
            found = self._first_failing(mutant, [way for way in ways if self.sound.get(way, True)])
            if found is None:
                return Verdict(SURVIVED, "")
            (device, build), outcome, reason = found
            if self._is_sound(device, build):
                return Verdict(outcome, reason or " ".join((device, *build)))

    def _first_failing(self, mutant: Mutant, ways: Iterable[Way]) -> tuple[Way, str, str] | None:
        """The device and build that do not pass with the change, and how; the file is as it was afterwards."""
        changed = self.work / mutant.path
        changed.write_text(mutant.text, encoding="utf-8")
        try:
            for way in ways:
                try:
                    if not self.passes(*way):
                        return way, KILLED, ""
                except DoesNotBuildError as error:
                    return way, LEFT_OUT, str(error.args[0])
                except subprocess.TimeoutExpired:
                    return way, KILLED, "time"
        finally:
            shutil.copyfile(self.base / mutant.path, changed)
        return None

    def _is_sound(self, device: str, build: tuple[str, ...]) -> bool:
        """Whether the device passes in that build without a change: one that does not can tell nothing."""
        known = self.sound.get((device, build))
        if known is None:
            known = self.sound[device, build] = self.passes(device, build)
            if not known and not build:
                raise SystemExit(f"{self.language}: the vectors of {device} fail without a change; mend that first")
            if not known:
                print(f"{self.language}: {device} fails without a change, so it is left out: {' '.join(build)}")
        return known

    def users(self, mutant: Mutant, build: tuple[str, ...]) -> list[str]:
        """The devices whose vectors run the file in that build."""
        del build
        if mutant.kind != RUNTIME:
            return [mutant.device]
        named = [family for family in FAMILIES if re.search(rf"[/_]{family}\b", mutant.path)]
        return [one for one in self.vectors if not named or (self.base / f"c/{one}_{named[0]}.h").exists()]

    def run(
        self, *words: object, memory: int = MEMORY, slow: bool = False, environment: Mapping[str, object] | None = None
    ) -> subprocess.CompletedProcess[str]:
        """Run a program that may do anything, within limits. Raises TimeoutExpired."""
        return subprocess.run(
            [str(word) for word in words],
            cwd=self.work,
            capture_output=True,
            text=True,
            errors="replace",
            check=False,
            timeout=BUILD_LIMIT if slow else RUN_LIMIT,
            env=os.environ | {name: str(value) for name, value in (environment or {}).items()},
            preexec_fn=lambda: _bound(memory, RUN_LIMIT if slow else self.cpu_limit),
        )

    def compile(self, *words: object, folder: Path | None = None) -> str:
        """Run a compiler and return its messages. Raises DoesNotBuildError."""
        command = [str(word) for word in words]
        done = subprocess.run(
            command, cwd=folder or self.work, capture_output=True, text=True, check=False, timeout=BUILD_LIMIT
        )
        if done.returncode:
            raise DoesNotBuildError("it does not compile", done.stdout + done.stderr)
        return done.stdout + done.stderr


NO_FLOAT, FLOAT32 = ("-DFIELDSCRIBE_NO_FLOAT",), ("-DFIELDSCRIBE_FLOAT32",)


def _bound(memory: int, seconds: int) -> None:
    resource.setrlimit(resource.RLIMIT_AS, (memory, resource.RLIM_INFINITY))
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))


SANITIZED = ("-fsanitize=address,undefined", "-fno-sanitize-recover=all")


class OfCompiled(Judge):
    """A program a device, in which many mutants are built at once where their functions can choose when they run."""

    cpu_limit = 3

    def built(self, device: str, build: Sequence[str]) -> Command:
        """Build the program of a device and return its command. Raises DoesNotBuildError."""
        raise NotImplementedError

    def passes(self, device: str, build: Sequence[str]) -> bool:
        """Compile and run."""
        return self._runs(self.built(device, build), build)

    def _runs(self, command: Command, build: Sequence[str], number: int = 0) -> bool:
        memory = resource.RLIM_INFINITY if build == SANITIZED else MEMORY
        try:
            return self.run(*command, memory=memory, environment={CHOICE: number}).returncode == 0
        except subprocess.TimeoutExpired:
            return False

    def verdicts(self, mutants: Iterable[Mutant]) -> Iterator[tuple[Mutant, Verdict]]:
        """Judge those that change a function's body together, then the others and those that do not compile."""
        left = dict(enumerate(mutants, 1))
        apart = [left.pop(number) for number, one in list(left.items()) if not self._can_choose(one)]
        for build in self.builds:
            for device in self.vectors:
                tried = {number: one for number, one in left.items() if device in self.users(one, build)}
                if not tried or not self.sound.get((device, build), True):
                    continue
                command, held = self._built_with(device, build, tried)
                if not self._runs(command, build):
                    if not self._is_sound(device, build):
                        continue
                    held = set()
                for number in tried:
                    if number not in held:
                        apart.append(left.pop(number))
                    elif not self._runs(command, build, number):
                        yield left.pop(number), Verdict(KILLED, " ".join((device, *build)))
        yield from ((mutant, Verdict(SURVIVED, "")) for mutant in left.values())
        yield from super().verdicts(apart)

    def _can_choose(self, mutant: Mutant) -> bool:
        return body_around(self.language, (self.base / mutant.path).read_text("utf-8"), mutant) is not None

    def _built_with(self, device: str, build: Sequence[str], mutants: dict[int, Mutant]) -> tuple[Command, set[int]]:
        """Build one program of all mutants that compile; return its command and their numbers."""
        held = set(mutants)
        while True:
            variants = self._write([(number, mutants[number]) for number in sorted(held)])
            try:
                return self.built(device, build), held
            except DoesNotBuildError as error:
                if not held:
                    raise
                held -= set(blamed(self.language, error.args[1], variants)) or set(held)
            finally:
                for path in variants:
                    shutil.copyfile(self.base / path, self.work / path)

    def _write(self, mutants: Sequence[tuple[int, Mutant]]) -> dict[str, list[Variant]]:
        """Write the files that choose a mutant; return the lines of each mutant, by file."""
        found = {}
        for path in {mutant.path for _, mutant in mutants}:
            inside = {number: mutant for number, mutant in mutants if mutant.path == path}
            text, found[path] = switched(self.language, (self.base / path).read_text("utf-8"), path, inside)
            (self.work / path).write_text(text, encoding="utf-8")
        return found


class OfC(OfCompiled):
    """The conformance program, built by one call of the compiler; the branches that defines choose are builds too."""

    language = "c"
    builds = ((), NO_FLOAT, FLOAT32, SANITIZED)

    def users(self, mutant: Mutant, build: tuple[str, ...]) -> list[str]:
        """All in the plain build, and in those that switch the changed branch; one small one with sanitizers."""
        found = super().users(mutant, build)
        if build in (NO_FLOAT, FLOAT32):
            switched = any("FLOAT" in condition for condition in conditions_around(mutant.text, mutant.line))
            return found if switched else []
        return found[:1] if build else found

    def prepare(self) -> None:
        """Write what chooses a mutant, which every program begins with."""
        self.chooses = self.work / "chooses.h"
        self.chooses.write_text(CHOOSES["c"], encoding="utf-8")

    def built(self, device: str, build: Sequence[str]) -> Command:
        """Call the compiler."""
        program, source = self.work / "program", self.work / f"c/conformance/{device}_conformance.c"
        start = ("gcc", "-O0", "-w", "-include", self.chooses, "-I", self.work / "c")
        self.compile(*start, *build, "-o", program, source)
        return program, self.vectors[device]


def conditions_around(text: str, line: int) -> list[str]:
    """The `#if` lines that decide whether a line of C is compiled."""
    opened: list[str] = []
    for one in text.splitlines()[: line - 1]:
        if one.startswith("#if"):
            opened.append(one)
        elif one.startswith("#endif"):
            opened.pop()
    return opened


SESSIONS, TRANSPORTS = "sessions", "transports"
"""What judges a runtime beside the vectors: the tests that ask devices, or write what people do; those of a line."""
_OF_PYTHON = {
    SESSIONS: (
        *("python", "python_bases", "python_can", "python_conditions", "python_dates", "python_frames"),
        *("python_notations", "python_selections", "python_uss", "written_together", "long_texts"),
    ),
    TRANSPORTS: ("transports", "slow_transports"),
}
"""The files of tests that judge the runtime of Python."""


class OfPython(Judge):
    """The runner of the tests on a copy of the packages."""

    language = "python"

    def users(self, mutant: Mutant, build: tuple[str, ...]) -> list[str]:
        """The devices, and for a runtime what its tests do; for a transport its tests, as vectors reach no line."""
        if f"/{TRANSPORTS}/" in mutant.path:
            return [TRANSPORTS]
        return [*super().users(mutant, build), *([SESSIONS] if mutant.kind == RUNTIME else [])]

    def passes(self, device: str, build: Sequence[str]) -> bool:
        """Run it; a package that cannot be imported tells nothing."""
        del build
        folder = self.work / "python"
        if device in _OF_PYTHON:
            files = [ROOT / f"tests/targets/python/test_{each}.py" for each in _OF_PYTHON[device]]
            options = ("-q", "-x", "-p", "no:cacheprovider", "-m", "not full" if device == SESSIONS else "")
            words = (sys.executable, "-B", "-m", "pytest", *options, *files)
            return self.run(*words, environment={"FIELDSCRIBE_PACKAGES": folder}, slow=True).returncode == 0
        done = self.run(sys.executable, "-B", ROOT / "tests/conformance", folder, device, self.vectors[device])
        if done.returncode and not done.stdout.strip():
            program = f"import sys; sys.path.insert(0, {str(folder)!r}); import {device}"
            if self.run(sys.executable, "-B", "-c", program).returncode:
                raise DoesNotBuildError("it does not import")
        return done.returncode == 0


WORKSPACE = """\
[workspace]
resolver = "2"
members = [{members}]

[profile.dev]
debug = 0
incremental = true
"""


class OfRust(OfCompiled):
    """The conformance test of each crate in one workspace, whose build stays warm from mutant to mutant."""

    language = "rust"

    def prepare(self) -> None:
        """One workspace of all crates."""
        from support.rust_crates import without_registry

        root = self.work / "rust"
        with (root / "fieldscribe_runtime/src/transports/mod.rs").open("a", encoding="utf-8") as never_changed:
            never_changed.write(CHOOSES["rust"])
        without_registry(root)
        crates = sorted(str(path.parent.relative_to(root)) for path in root.glob("*/**/Cargo.toml"))
        members = ", ".join(f'"{crate}"' for crate in crates)
        (self.work / "rust/Cargo.toml").write_text(WORKSPACE.format(members=members), encoding="utf-8")
        self.target = self.work.parent / "target"
        self.cargo("test", "--no-run", "--test", "conformance")

    def cargo(self, *words: str) -> str:
        """Run cargo offline; the first failure is tried again with the network."""
        command = ("cargo", *words, "-j1", "--target-dir", self.target)
        try:
            return self.compile(*command, "--offline", folder=self.work / "rust")
        except DoesNotBuildError:
            if self.builds_once:
                raise
            self.builds_once = True
            return self.compile(*command, folder=self.work / "rust")

    builds_once = False

    def built(self, device: str, build: Sequence[str]) -> Command:
        """Compile the test."""
        del build
        said = self.cargo("test", "--no-run", "--test", "conformance", "--package", f"{device}_conformance")
        found = re.search(r"Executable .*\((.*)\)", said)
        assert found is not None, said
        return (self.work / "rust" / found[1],)


_OF_TYPESCRIPT = "codecs", "errors", "notations", "bases", "selections", "sessions", "lines"
"""The files of tests that judge the runtime of TypeScript beside the vectors."""


class OfTypeScript(Judge):
    """The runner of vectors on a copy of the packages, as npm lays them out."""

    language = "typescript"

    def prepare(self) -> None:
        """Lay out the packages beside those that run the vectors."""
        root = self.work / "typescript"
        shutil.copytree(ROOT / "templates/typescript/runtime/fieldscribe-conformance", root / "fieldscribe-conformance")
        (root / "node_modules").mkdir()
        for package in [path for path in root.iterdir() if (path / "package.json").exists()]:
            (root / "node_modules" / package.name.replace("_", "-")).symlink_to(package)
        (root / "node_modules/fieldscribe-conformance").symlink_to(root / "fieldscribe-conformance")

    def users(self, mutant: Mutant, build: tuple[str, ...]) -> list[str]:
        """The devices, and for a runtime what its tests do with simulated devices."""
        return [*super().users(mutant, build), *([SESSIONS] if mutant.kind == RUNTIME else [])]

    def passes(self, device: str, build: Sequence[str]) -> bool:
        """Run it; a module that cannot be parsed tells nothing."""
        del build
        if device == SESSIONS:
            files = [ROOT / f"tests/targets/typescript/test_typescript_{each}.py" for each in _OF_TYPESCRIPT]
            words = (sys.executable, "-B", "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", *files)
            packages = {"FIELDSCRIBE_PACKAGES": self.work / "typescript"}
            return self.run(*words, environment=packages, memory=resource.RLIM_INFINITY, slow=True).returncode == 0
        modules, runner = self.work / "typescript/node_modules", ROOT / "tests/support/run_vectors.mjs"
        words = ("node", runner, modules, device.replace("_", "-"), self.vectors[device])
        done = self.run(*words, memory=resource.RLIM_INFINITY)  # node reserves more than it uses
        if "SyntaxError" in done.stderr:
            raise DoesNotBuildError("it cannot be parsed")
        return done.returncode == 0 and not json.loads(done.stdout)["failed"]


JUDGES: dict[str, type[Judge]] = {"c": OfC, "python": OfPython, "rust": OfRust, "typescript": OfTypeScript}
