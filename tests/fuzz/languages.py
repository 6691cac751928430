"""The parsers of each language over the same cases, in programs of their own that are built to be watched."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import zip_longest
from pathlib import Path
from random import Random

from fieldscribe.pipeline import outputs
from support.described import made

from fuzz.frames import CASES

HERE = Path(__file__).resolve().parent
DEVICES = {"modbus": "kitchen_sink", "can": "kitchen_can", "uss": "kitchen_uss"}
"""The made device whose messages and tasks the parsers of a family know."""

C = {
    "C (gcc)": ("gcc", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"),
    "C (clang)": ("clang", "-fsanitize=address,undefined,integer,implicit-conversion", "-fno-sanitize-recover=all"),
}
LIMIT = 900
"""Seconds after which a program is taken to hang."""

_MANIFEST = """\
[package]
name = "fuzz"
version = "0.0.0"
edition = "2021"

[dependencies]
fieldscribe_runtime = { path = "../rust/fieldscribe_runtime" }
kitchen_can = { path = "../rust/kitchen_can" }
kitchen_uss = { path = "../rust/kitchen_uss" }

[profile.release]
opt-level = 1
overflow-checks = true
debug-assertions = true
"""


@dataclass(frozen=True)
class Result:
    """What came of one kind of fuzzing; `findings` are texts for people."""

    what: str
    count: int
    findings: tuple[str, ...]
    seconds: float


def generate(work: Path) -> None:
    """The made devices in all languages, and the crate of the programs."""
    for name in DEVICES.values():
        device = made(name)
        for _, path, text in outputs(device, ("c", "python", "rust")):
            (work / path).parent.mkdir(parents=True, exist_ok=True)
            (work / path).write_text(text, "utf-8")
        if device.messages:
            listed = "".join(f"    &{name}_message_{message.name},\n" for message in device.messages if message.roles)
            (work / "c" / "messages.inc").write_text(listed, "utf-8")
    programs = work / "fuzz" / "src" / "bin"
    programs.mkdir(parents=True, exist_ok=True)
    for source in (HERE / "rust").glob("*.rs"):
        lib = source.stem == "cases"
        target = programs / "cases" / "mod.rs" if lib else programs / source.name
        target.parent.mkdir(exist_ok=True)
        target.write_bytes(source.read_bytes())
    (work / "fuzz" / "Cargo.toml").write_text(_MANIFEST, "utf-8")


def build_c(family: str, work: Path, languages: Iterable[str] = tuple(C)) -> dict[str, list[str]]:
    """The commands in C that read cases and print lines, each watched by the sanitizers of its compiler."""
    commands = {}
    for language in languages:
        compiler, *options = C[language]
        program = work / f"{family}-{compiler}"
        includes = (f"-I{work / 'c'}", f"-I{HERE}")
        _run([compiler, "-std=c99", "-g", "-O1", *options, *includes, "-o", str(program), str(HERE / f"{family}.c")])
        commands[language] = [str(program)]
    return commands


def build(family: str, work: Path, c: Iterable[str] = tuple(C)) -> dict[str, list[str]]:
    """The command of each language that reads cases and prints lines, with C by these compilers."""
    cargo = ["cargo", "build", "--quiet", "--release", "--offline", "--jobs", "1", "--bins"]
    _run([*cargo, "--target-dir", str(work / "target")], cwd=work / "fuzz")
    rust = [str(work / "target" / "release" / family)]
    return {**build_c(family, work, c), "Rust": rust, "Python": [sys.executable, str(HERE / "parsers.py"), family]}


def _run(command: list[str], cwd: Path | None = None) -> None:
    subprocess.run(command, cwd=cwd, check=True, timeout=LIMIT)


def fuzz_family(family: str, count: int, seed: int, work: Path, c: Iterable[str] = tuple(C)) -> Iterator[Result]:
    """The same cases through all languages, and what they say of them side by side."""
    commands = build(family, work, c)
    yield from fuzz_programs(commands, family, count, seed, work)
    started = time.perf_counter()
    found = tuple(differences({name: work / f"{family}-{name}.lines" for name in commands}, family, seed, count))
    yield Result(f"{family} frames, all alike", count, found, time.perf_counter() - started)


def fuzz_programs(
    commands: Mapping[str, list[str]], family: str, count: int, seed: int, work: Path
) -> Iterator[Result]:
    """The cases through each program, whose lines are kept."""
    cases = work / f"{family}.cases"
    with cases.open("wb") as file:
        file.writelines(CASES[family](Random(seed), count))
    environment = {**os.environ, "PYTHONPATH": str(work / "python")}
    for language, command in commands.items():
        started = time.perf_counter()
        failure = _failure(command, cases, work / f"{family}-{language}.lines", environment)
        yield Result(f"{family} frames, {language}", count, failure, time.perf_counter() - started)


def _failure(command: list[str], cases: Path, out: Path, environment: Mapping[str, str]) -> tuple[str, ...]:
    """Why a program did not end well: the last that it said."""
    with cases.open("rb") as source, out.open("wb") as lines:
        done = subprocess.run(
            command, stdin=source, stdout=lines, stderr=subprocess.PIPE, env=environment, check=False, timeout=LIMIT
        )
    said = done.stderr.decode("utf-8", "replace")
    return (f"{Path(command[-1]).name} ended with {done.returncode}:\n{said[-3000:]}",) if done.returncode else ()


def differences(lines: Mapping[str, Path], family: str, seed: int, count: int) -> Iterator[str]:
    """The first cases of which languages say different things."""
    texts = {name: path.read_text("utf-8").splitlines() for name, path in lines.items()}
    told = 0
    for place, said in enumerate(zip_longest(*texts.values(), fillvalue="(nothing)")):
        if len(set(said)) > 1 and told < 20:
            told += 1
            if told == 1:
                made = list(CASES[family](Random(seed), count))
            case = made[place].hex() if place < len(made) else "(none)"
            yield f"case {place} ({case}): " + "; ".join(
                f"{name}: {line}" for name, line in zip(texts, said, strict=True)
            )
