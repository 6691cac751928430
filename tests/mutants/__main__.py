"""`make mutants`: SEED, COUNT (a language or a room), ONLY and ROOM are taken from the environment."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterable, Iterator
from functools import cache, partial
from hashlib import sha256
from itertools import islice
from pathlib import Path

from mutants.equivalents import is_equivalent
from mutants.judges import JUDGES, ROOT, SURVIVED, Judge, Verdict
from mutants.results import Results
from mutants.rooms import drawn_in, rooms
from mutants.sources import Mutant, drawn
from mutants.table import MARKS, Table

_Judged = Callable[[Iterable[Mutant]], Iterable[tuple[Mutant, Verdict]]]

HERE = Path(__file__).parent
CACHE = ROOT / ".cache/mutants"
OF_A_LANGUAGE, OF_A_ROOM = 300, 100
"""How many mutants are judged if COUNT does not say."""
AT_ONCE = 100
"""How many mutants are judged together."""
PROGRESS = 10.0
"""Seconds between two lines that say how far it is."""


def main() -> int:
    """Measure what was asked for; 1 if a mark is missed."""
    seed, count = os.environ.get("SEED") or "1", int(os.environ.get("COUNT") or 0)
    wanted = (os.environ.get("ONLY") or " ".join(MARKS)).replace(",", " ").split()
    if unknown := set(wanted) - set(MARKS):
        print(f"there is no {', '.join(sorted(unknown))}: ONLY takes {', '.join(MARKS)}", file=sys.stderr)
        return 2
    if "descriptions" in wanted and not Path(os.environ.get("FIELDSCRIBE_MANUALS", "?")).is_dir():
        print("the descriptions need FIELDSCRIBE_MANUALS, the folder of the manuals' texts", file=sys.stderr)
        return 2
    chosen = (os.environ.get("ROOM") or " ".join(rooms())).replace(",", " ").split()
    if unknown := set(chosen) - set(rooms()):
        print(f"there is no room {', '.join(sorted(unknown))}: ROOM takes {', '.join(rooms())}", file=sys.stderr)
        return 2
    tables = []
    for one in wanted:
        if one == "generator":
            tables.append(_generator(chosen, seed, count or OF_A_ROOM))
        else:
            measured = _descriptions if one == "descriptions" else partial(_code, one)
            tables.append(measured(seed, count or OF_A_LANGUAGE))
        print("", *tables[-1].survivor_lines(), "", *tables[-1].lines(), "", sep="\n", flush=True)
    for table in tables if len(tables) > 1 else ():
        print(*table.lines(), "", sep="\n")
    return 0 if all(table.met for table in tables) else 1


def _code(language: str, seed: str, count: int) -> Table:
    """The mutants of one language."""
    work = CACHE / language
    base = _generated(work / "base", language)
    runner = [ROOT / "tests/conformance", *sorted(ROOT.glob("tests/support/vector*.py"))]
    state = _digest([base / language, base / "vectors", *runner, HERE / "judges.py", HERE / "batches.py"])
    results = Results(CACHE / f"{language}-{seed}-{state}.jsonl")

    @cache
    def judge() -> Judge:  # made when the first one is not known yet
        return JUDGES[language](base, work / "work")

    return _measure(Table(language), drawn(language, base, seed), results, count, lambda some: judge().verdicts(some))


def _descriptions(seed: str, count: int) -> Table:
    """The mutants of the descriptions."""
    from mutants.descriptions import DescriptionJudge, drawn_facts

    judge = DescriptionJudge(CACHE / "descriptions")
    parts = [ROOT / "descriptions", ROOT / "generator/fieldscribe", *judge.readings, HERE / "descriptions.py"]
    results = Results(CACHE / f"descriptions-{seed}-{_digest([*parts, judge.manuals])}.jsonl")
    facts = drawn_facts(judge.folder, seed)
    return _measure(Table("descriptions"), facts, results, count, lambda some: ((m, judge.verdict(m)) for m in some))


def _generator(chosen: list[str], seed: str, count: int) -> Table:
    """The mutants of the compiler, the rooms in turn: so many of each room that has them.

    A kill is kept as long as what is compiled is the same, a survivor only until a test changes.
    """
    from mutants.generator import GeneratorJudge
    from mutants.noticing import devices

    inputs = [ROOT / part for part in ("generator/fieldscribe", "templates", "descriptions", "tests/devices")]
    told = [ROOT / "tests/bad", ROOT / "tests/transcripts"]
    tests = _digest([*sorted(ROOT.glob("tests/**/*.py")), *told, HERE / "generator.py"])
    results = Results(CACHE / f"generator-{seed}-{_digest(inputs)}.jsonl")
    files = sorted(ROOT.glob("tests/**/test_*.py"))
    table, judge = Table("generator"), cache(lambda: GeneratorJudge(CACHE / "generator", devices(), files))
    draws = {room: drawn_in(room, rooms()[room], seed) for room in chosen}

    def judged(mutant: Mutant) -> Verdict:
        known = results.get(mutant.key) or results.get(f"{mutant.key} {tests}")
        if known is None:
            known = judge().verdict(mutant)
            results.put(f"{mutant.key} {tests}" if known.outcome == SURVIVED else mutant.key, known)
        return known

    printed = time.monotonic()
    while draws:
        for room, draw in list(draws.items()):
            mutant = next(draw, None) if table.judged_of(room) < count else None
            if mutant is None:
                del draws[room]
                continue
            table.add(mutant, judged(mutant), equivalent=is_equivalent("generator", mutant))
        if time.monotonic() - printed > PROGRESS:
            printed = time.monotonic()
            survived = len(table.survivors)
            print(f"generator: {table.judged} in {len(table.counts)} rooms, {survived} survived", flush=True)
    return table


def _measure(table: Table, mutants: Iterable[Mutant], results: Results, count: int, judged: _Judged) -> Table:
    """Judge until so many count."""
    told, drawing = time.monotonic(), iter(mutants)
    while some := list(islice(drawing, min(count - table.judged, AT_ONCE))):
        unknown = [mutant for mutant in some if results.get(mutant.key) is None]
        for at, (mutant, verdict) in enumerate(judged(unknown) if unknown else (), 1):
            results.put(mutant.key, verdict)
            if time.monotonic() - told > PROGRESS:
                told = time.monotonic()
                more = f"{table.judged} of {count}, {len(table.survivors)} survived"
                print(f"{table.language}: {more}; {at} of {len(unknown)} more are known", flush=True)
        for mutant in some:
            known = results.get(mutant.key)
            assert known is not None
            table.add(mutant, known, equivalent=is_equivalent(table.language, mutant))
    return table


def _generated(folder: Path, language: str) -> Path:
    """What the compiler makes now of the shipped devices and of those that the tests made."""
    shutil.rmtree(folder, ignore_errors=True)
    command = [str(Path(sys.executable).parent / "fieldscribe"), "generate", "descriptions", "tests/devices"]
    subprocess.run([*command, "--out", str(folder)], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    if language == "c":
        from support.c_device import rare_device, write_c

        write_c(rare_device(), folder)  # what no description needs at once, built as a model
    return folder


def _digest(paths: Iterable[Path]) -> str:
    """What is judged, and by what."""
    total = sha256()
    for file in _files(paths):
        total.update(file.name.encode() + b"\0" + file.read_bytes())
    return total.hexdigest()[:16]


def _files(paths: Iterable[Path]) -> Iterator[Path]:
    for path in paths:
        inside = sorted(path.rglob("*")) if path.is_dir() else [path]
        yield from (one for one in inside if one.is_file() and one.suffix not in (".pyc", ".jsonl"))


if __name__ == "__main__":
    sys.exit(main())
