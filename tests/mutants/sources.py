"""The generated files and runtimes of all devices, their kinds, and the mutants that are drawn from them."""

from __future__ import annotations

import random
import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from hashlib import sha256
from pathlib import Path

from mutants.changes import Change, Places, places_of

RUNTIME = "runtime"

KINDS: dict[str, dict[str, str]] = {
    "c": {
        "points header": r"c/(?P<device>\w+)\.h",
        "frames header": r"c/(?P<device>\w+)_(?:modbus|can|uss)\.h",
        RUNTIME: r"c/fieldscribe\w*\.h",
    },
    "python": {
        "points": r"python/(?P<device>\w+)/points\.py",
        "enums": r"python/(?P<device>\w+)/enums\.py",
        "device": r"python/(?P<device>\w+)/(?:__init__|device|\w*commands\w*)\.py",
        RUNTIME: r"python/fieldscribe_runtime/.*\.py",
    },
    "rust": {
        "points": r"rust/(?P<device>\w+)/src/(?:points|with)\.rs",
        "enums": r"rust/(?P<device>\w+)/src/enums\.rs",
        "flags": r"rust/(?P<device>\w+)/src/flags\.rs",
        "lib": r"rust/(?P<device>\w+)/src/(?!points|with|enums|flags)\w+\.rs",
        RUNTIME: r"rust/fieldscribe_runtime/src/(?!transports/).*\.rs",  # those have tests of their own
    },
    "typescript": {
        "points": r"typescript/(?P<device>\w+)/points\.js",
        "enums": r"typescript/(?P<device>\w+)/enums\.js",
        "device": r"typescript/(?P<device>\w+)/index\.js",
        RUNTIME: r"typescript/fieldscribe-runtime/(?!tcp|serialport|modbus-serial|stream-line|index|types)[\w-]+\.js",
    },
}
"""The kinds of files of each language, by their path; the programs that run the vectors are of no kind."""


@dataclass(frozen=True, slots=True)
class Source:
    """One file of a kind; the device is empty for a runtime."""

    language: str
    kind: str
    device: str
    path: str
    text: str


@dataclass(frozen=True, slots=True)
class Mutant:
    """One change of one file. `key` is the same in every run on the same text."""

    kind: str
    device: str
    path: str
    line: int
    before: str
    after: str
    what: str
    text: str

    @property
    def key(self) -> str:
        """What tells it from all others."""
        return sha256(f"{self.path}\n{self.text}".encode()).hexdigest()[:24]


def sources_of(language: str, base: Path) -> list[Source]:
    """All files of a language that may be changed."""
    devices = {path.parent.name for path in base.glob("python/*/points.py")} - {"fieldscribe_runtime"}
    found = []
    for path in sorted((base / language).rglob("*")):
        name = path.relative_to(base).as_posix()
        for kind, pattern in KINDS[language].items():
            match = re.fullmatch(pattern, name)
            device = match.groupdict().get("device", "") if match else ""
            if match and ((kind == RUNTIME and "conformance" not in name) or device in devices):
                found.append(Source(language, kind, device, name, path.read_text("utf-8")))
    return found


def drawn(language: str, base: Path, seed: str) -> Iterator[Mutant]:
    """Different mutants without end, or until there are no more: the kinds in turn.

    In a kind the devices, the files of a runtime and the sorts of changes are chosen by the root of how much there is
    of each, so that neither a large device nor the many numbers outweigh all else.
    """
    sources = sources_of(language, base)
    draws = [
        of_kind([one for one in sources if one.kind == kind], random.Random(f"{seed} {language} {kind}"))
        for kind in KINDS[language]
    ]
    while draws:
        for draw in list(draws):
            mutant = next(draw, None)
            if mutant is None:
                draws.remove(draw)
            else:
                yield mutant


TRIES = 300
"""Draws in a row that bring nothing new: then a kind is taken to be used up."""


def of_kind(sources: list[Source], chance: random.Random) -> Iterator[Mutant]:
    """Mutants of these files without end, or until there are no more."""
    seen: set[str] = set()
    known = [(one, places) for one in sources if (places := _places(one.language, one.text))]
    weights = [sum(map(len, places.values())) ** 0.5 for _, places in known]
    tries = 0
    while known and tries < TRIES:
        source, places = chance.choices(known, weights)[0]
        what = chance.choices(list(places), [len(some) ** 0.5 for some in places.values()])[0]
        mutant = mutant_of(source, chance.choice(chance.choice(places[what])))
        tries += 1
        if mutant.key not in seen:
            seen.add(mutant.key)
            tries = 0
            yield mutant


@cache
def _places(language: str, text: str) -> Places:
    return places_of(language, text)


def mutant_of(source: Source, change: Change) -> Mutant:
    """The changed file, with the lines that differ."""
    text = change.applied(source.text)
    first = source.text.rfind("\n", 0, change.start) + 1
    last = source.text.find("\n", change.end)
    last = len(source.text) if last < 0 else last
    before, after = source.text[first:last], text[first : last + len(text) - len(source.text)]
    line = source.text.count("\n", 0, change.start) + 1
    return Mutant(source.kind, source.device, source.path, line, _one_line(before), _one_line(after), change.what, text)


def changed(before: str, after: str) -> tuple[int, int]:
    """Where a text differs from a later one: what stands before and behind is the same."""
    start = _alike(before, after)
    return start, len(before) - _alike(before[start:][::-1], after[start:][::-1])


def _alike(one: str, other: str) -> int:
    """How many characters two texts have in common at their start."""
    both = enumerate(zip(one, other, strict=False))
    return next((at for at, (here, there) in both if here != there), min(len(one), len(other)))


def _one_line(text: str) -> str:
    return " / ".join(line.strip() for line in text.splitlines())
