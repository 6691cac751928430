"""Mutated descriptions: each ends in findings or in a device with files, within bounds, never in an exception."""

from __future__ import annotations

import json
import re
import resource
import signal
import tempfile
import time
import traceback
from collections.abc import Iterator
from contextlib import contextmanager
from multiprocessing import get_context
from pathlib import Path
from random import Random
from typing import Any

from fieldscribe.diagnostics import Report
from fieldscribe.pipeline import load_device, outputs
from fieldscribe.targets import TARGETS
from support.described import DEVICES
from support.descriptions_as_values import BAD, HOSTILE, WHOLES, as_texts, changed, nodes, rewrite

from fuzz.languages import Result

SECONDS, BYTES = 20, 2 << 30
"""What one mutant may take at most, in time and in memory."""
COMPILED = 10
"""Of so many mutants that are fine, one is compiled for all targets."""

PATHS = [sorted(nodes(whole), key=str) for whole in WHOLES]
FOLDERS = [
    {path.name: path.read_text("utf-8") for path in sorted(folder.glob("*.yaml"))}
    for folder in sorted(DEVICES.iterdir())
]
SMALL = [path.read_text("utf-8", "replace") for path in sorted(BAD.glob("*.yaml"))]
_WITHOUT_BLANKS = """
    ~ null true yes no 0 -1 -0 1 256 1..2 2..1 1.. ..1 0..65535 1.5 1e400 1e-9 4E20 0x FFFFh 0FFh -1h 0b11
    raw a.raw 1/0 f32 f64 u64 s64 bit s8 u8 text latin-1 none r w rw holding coil parameter telegram unit address
    P2000 P0731 1..15 739..732 multiplexer words name class self status always never request * *a ' " [ { # ---
"""
WORDS = (
    *("", " ", "value = raw", "raw = value * speed", "value = raw * 10 ** power_exponent", "0 | speed..1"),
    *("mode == 0", "mode == 0 and mode == 1", "mode in (0, 1)", "voltage == 230V", "320h + unit", "low first"),
    *("value = -raw", "value = raw / 65536", "[1, 2]", "{a: b}", "&a x", "!!int 3", "<<: {}", "- ", "9" * 64),
    *("high first", "xor 0..5"),
    *_WITHOUT_BLANKS.split(),
    *HOSTILE,
)
VALUES: tuple[Any, ...] = (
    *(..., None, True, -1, 5, 8, 16, 255, 65536, 70000, -(1 << 63), 1 << 64, 10**70, [], {}, [1, 2], ["1..3"]),
    *({"en": "x"}, {"0": "a"}, {"0": "a", "1": "b"}, {"3..0": 5}, {"name": "x"}, {"number": 5, "sets": 2}),
    *({"number": 731, "indices": "0..1"}, {"count": 4, "enum": "switch2"}),
    *WORDS,
)


def mutant(seed: int, index: int) -> dict[str, str]:
    """The files of the mutant of that number: always the same texts."""
    random = Random(f"{seed}/{index}")
    kind = random.random()
    if kind < 0.4:
        return _of_structure(random)
    if kind < 0.8:
        return {"device.yaml": _of_text(random, random.choice(SMALL))}
    files = random.choice(FOLDERS)
    name = random.choice(sorted(files))
    return {**files, name: _of_text(random, files[name])}


def _of_structure(random: Random) -> dict[str, str]:
    """A made device, now and then with some of its parts alone, with other values at a few places."""
    place = random.randrange(len(WHOLES))
    device: dict[str, Any] = WHOLES[place]
    for _ in range(random.randint(1, 3)):
        path, source = random.choice(PATHS[place]), random.choice(PATHS[place])
        try:
            new = random.choice(VALUES) if random.random() < 0.5 else _value_at(WHOLES[place], source)
            device = changed(device, path, str(new) if isinstance(new, int) and random.random() < 0.2 else new)
        except (KeyError, IndexError, TypeError, ValueError, AttributeError):
            continue  # an earlier change took the place away
    documents = device.get("device.yaml")
    if random.random() < 0.3 and isinstance(documents, list) and isinstance(documents[0], dict):
        device = _of_one_file(random, device, documents[0])
    return as_texts(json.loads(json.dumps(device)))


def _value_at(value: Any, path: tuple[Any, ...]) -> Any:
    for key in path:
        value = value[key]
    return value


def _of_one_file(random: Random, device: dict[str, Any], header: dict[str, Any]) -> dict[str, Any]:
    """The same device as documents of one file, some of its parts alone."""
    head = {key: value for key, value in header.items() if key != "parts"}
    files = [documents for name, documents in device.items() if name != "device.yaml"]
    parts = [part for documents in files for part in (documents if isinstance(documents, list) else [documents])]
    return {"device.yaml": [head, *random.sample(parts, min(len(parts), random.randint(1, 4)))]}


def _of_text(random: Random, text: str) -> str:
    """A file with lines, words or characters changed."""
    lines = text.split("\n")
    for _ in range(random.choice((1, 1, 2, 4))):
        place = random.randrange(len(lines))
        lines[place : place + 1] = random.choice(CHANGES)(random, lines[place], lines)
        lines = lines or [""]
    return "\n".join(lines)


def _no_line(random: Random, line: str, lines: list[str]) -> list[str]:
    return []


def _foreign_line(random: Random, line: str, lines: list[str]) -> list[str]:
    return [line, random.choice(random.choice(SMALL).split("\n"))]


def _line_of_its_own(random: Random, line: str, lines: list[str]) -> list[str]:
    return [line, random.choice(lines)]


def _word(random: Random, line: str, lines: list[str]) -> list[str]:
    words = re.split(r"([ ,\[\]{}]+)", line)
    words[random.randrange(len(words)) // 2 * 2] = random.choice(WORDS)
    return ["".join(words)]


def _word_of_its_own(random: Random, line: str, lines: list[str]) -> list[str]:
    words = re.split(r"([ ,\[\]{}]+)", line)
    words[random.randrange(len(words)) // 2 * 2] = random.choice(re.split(r"[ ,\[\]{}]+", random.choice(lines)))
    return ["".join(words)]


def _character(random: Random, line: str, lines: list[str]) -> list[str]:
    at = random.randint(0, len(line))
    return [line[:at] + random.choice("\0\t\n\"':[{,&*\u2028é0") + line[at + 1 :]]


def _alias(random: Random, line: str, lines: list[str]) -> list[str]:
    """A value used again behind an alias, in place of another."""
    place = random.choice([at.end() for at in re.finditer(r": (?=[\[{\w])", line)] or [0])
    other = random.choice(lines)
    values = [at.span() for at in re.finditer(r"(?<=: )([^,{}\[\]]+|{[^{}]*}|\[[^\[\]]*\])", other)]
    if not place or not values:
        return [line]
    start, end = random.choice(values)
    return [line[:place] + "&m " + line[place:], other[:start] + "*m" + other[end:]]


CHANGES = (_no_line, _foreign_line, _line_of_its_own, _word, _word, _word_of_its_own, _character, _alias)


@contextmanager
def _bounded() -> Iterator[None]:
    """Raises when a mutant takes too much time of a processor."""

    def too_long(number: int, frame: Any) -> None:
        raise TimeoutError(f"longer than {SECONDS} seconds of a processor")

    signal.signal(signal.SIGPROF, too_long)
    signal.setitimer(signal.ITIMER_PROF, SECONDS)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)


def trial(file: Path, *, compiled: bool) -> str | None:
    """What is wrong with how the compiler takes a description; none if nothing is."""
    try:
        with _bounded():
            report = Report()
            device = load_device(file, report)
            if (device is None) != report.has_errors:
                return "a device with errors, or none without"
            for one in report.findings:
                if not one.message.isprintable() or not one.hint:
                    return f"a finding that nobody can print, or without a hint: {one.rule}"
            if device is not None and compiled:
                for _ in outputs(device, TARGETS):
                    pass
    except Exception:
        return traceback.format_exc()
    return None


def _part(job: tuple[int, int, int]) -> list[tuple[int, str]]:
    """The mutants of one process that went wrong."""
    seed, first, behind = job
    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (BYTES, hard))
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        for index in range(first, behind):
            file = rewrite(Path(folder) / "device", mutant(seed, index))
            failed = trial(file, compiled=index % COMPILED == 0)
            if failed is not None:
                wrong.append((index, failed))
    return wrong


def fuzz_descriptions(count: int, seed: int, keep: Path) -> Result:
    """So many mutants, in two processes; those that went wrong are kept as files."""
    started = time.perf_counter()
    step = max(1, min(250, count // 2))
    jobs = [(seed, first, min(first + step, count)) for first in range(0, count, step)]
    with get_context("spawn").Pool(2) as pool:
        wrong = [one for part in pool.imap_unordered(_part, jobs) for one in part]
    findings = []
    for index, failed in sorted(wrong):
        file = rewrite(keep / f"mutant_{seed}_{index}", mutant(seed, index))
        findings.append(f"mutant {index} of seed {seed}, kept as {file}:\n{failed[-1500:]}")
    return Result("descriptions, mutated", count, tuple(findings), time.perf_counter() - started)
