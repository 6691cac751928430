"""Texts for both readers of YAML: the plain one gives what PyYAML gives, value for value and place for place."""

from __future__ import annotations

import time
from multiprocessing import get_context
from random import Random
from typing import TYPE_CHECKING

from fieldscribe.diagnostics import Report
from fieldscribe.language.events import load_any
from fieldscribe.language.lines import plain_documents
from fieldscribe.language.nodes import Map, Seq
from fieldscribe.language.source import SourceFile, decoded
from support.places import ROOT, TESTS

from fuzz.descriptions import mutant as mutated_files
from fuzz.languages import Result

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from fieldscribe.language.nodes import Value

FILES = [*sorted((ROOT / "descriptions").rglob("*.yaml")), *sorted(TESTS.rglob("*.yaml"))]
TEXTS = [source.text for file in FILES if (source := decoded(file.name, file.read_bytes(), Report())) is not None]
PIECES = (
    *(" ", "  ", "\n", "\n  ", "\n    ", "\n\n", ": ", ":", ", ", ",", "- ", "-", "#", " # c", "{", "}", "[", "]"),
    *("{}", "[]", '"', "'", '""', "''", '"a: b"', "'a'", '\\"', "\\", "\\n", "---\n", "\n---\n", "...", "?", "? "),
    *("!", "&a ", "*a", "|", ">", "%", "@", "`", "~", "null", "true", "yes", "0", "010", "-1", "+1", ".5", "1.", "1e3"),
    *("0x1F", "1Fh", "0o7", "é", "\u00a0", "\u2028", "\ufeff", "\t", "a", "a b", "a: b", "a:b", "{a: b}", "[1, x]"),
    *("{a: {b: [1, {c: d}]}}", "key:", "- key: 1", "\n- x", "\n  - {a: 1,\n     b: 2}"),
)
"""What a text may be changed by: all that means something to YAML."""


def unlike(plain: Value, other: Value, path: str = "") -> str | None:
    """Where two values differ in content, type or place, and how; none if they are alike."""
    if type(plain) is not type(other):
        return f"{path}: {plain!r} and {other!r}"
    if isinstance(plain, Map) and isinstance(other, Map):
        if (list(plain), plain.at, plain.places) != (list(other), other.at, other.places):
            return f"{path}: {plain.at} {plain.places} and {other.at} {other.places}"
        return next(filter(None, (unlike(plain[key], other[key], f"{path}/{key}") for key in plain)), None)
    if isinstance(plain, Seq) and isinstance(other, Seq):
        if (len(plain), plain.at, plain.item_at) != (len(other), other.at, other.item_at):
            return f"{path}: {plain.at} {plain.item_at} and {other.at} {other.item_at}"
        pairs = enumerate(zip(plain, other, strict=True))
        return next(filter(None, (unlike(*pair, f"{path}/{index}") for index, pair in pairs)), None)
    return None if repr(plain) == repr(other) else f"{path}: {plain!r} and {other!r}"


def difference(text: str) -> str | None:
    """What the plain reader takes otherwise than PyYAML; none if it takes the same, or leaves it to PyYAML."""
    plain = plain_documents(SourceFile("a.yaml", text))
    if plain is None:
        return None
    report = Report()
    other = load_any(SourceFile("a.yaml", text), report)
    if report.findings:
        return f"PyYAML says: {report.findings[0].message}"
    if len(plain) != len(other):
        return f"{len(plain)} documents and {len(other)}"
    return next(filter(None, map(unlike, plain, other)), None)


def changed(random: Random) -> str:
    """A part of a file with a few pieces put in, taken away or moved."""
    lines = random.choice(TEXTS).splitlines(keepends=True)
    start = random.randrange(len(lines))
    text = "".join(lines[start : start + random.randint(1, 60)] if random.random() < 0.7 else lines[:60])
    for _ in range(random.choice((1, 1, 1, 2, 3, 5))):
        place = random.randint(0, len(text))
        kind = random.random()
        if kind < 0.6:
            text = text[:place] + random.choice(PIECES) + text[place + random.choice((0, 0, 1)) :]
        elif kind < 0.8:
            text = text[:place] + text[place + random.randint(1, 6) :]
        else:
            other = random.randint(0, len(text))
            text = text[:place] + text[other : other + random.randint(1, 30)] + text[place:]
    return text


def texts(seed: int, index: int) -> Iterator[str]:
    """The texts of the case of that number: always the same."""
    random = Random(f"reading/{seed}/{index}")
    for _ in range(10):
        yield changed(random)
    if index % 10 == 0:
        yield from mutated_files(seed, index).values()


def _part(job: tuple[int, int, int]) -> list[tuple[int, str, str]]:
    """The cases of one process that went wrong."""
    seed, first, behind = job
    cases = ((index, text) for index in range(first, behind) for text in texts(seed, index))
    report = Report()
    read = ((index, text) for index, text in cases if decoded("a.yaml", text.encode("utf-8", "replace"), report))
    return [(index, text, found) for index, text in read if (found := difference(text)) is not None]


def fuzz_reading(count: int, seed: int, keep: Path) -> Result:
    """So many cases of ten texts and more, in two processes; those that went wrong are kept as files."""
    started = time.perf_counter()
    step = max(1, min(250, count // 2))
    jobs = [(seed, first, min(first + step, count)) for first in range(0, count, step)]
    with get_context("fork").Pool(2) as pool:
        wrong = [one for part in pool.imap_unordered(_part, jobs) for one in part]
    findings = []
    for number, (index, text, found) in enumerate(sorted(wrong)):
        file = keep / f"reading_{seed}_{index}_{number}.yaml"
        file.write_text(text, "utf-8")
        findings.append(f"case {index} of seed {seed}, kept as {file}: {found[:500]}")
    return Result("YAML, read in two ways", count, tuple(findings), time.perf_counter() - started)
