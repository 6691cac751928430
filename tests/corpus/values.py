"""Values of random imported devices in C, Python and Rust, against what their collection's own files say.

So many random files are imported and compiled to all languages. In each language about so many random values are
decoded, and as many encoded; the oracle of the collection says what these give.
"""

from __future__ import annotations

import json
import os
import random
import re
import subprocess
import sys
from collections import Counter
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

from fieldscribe.diagnostics import Report
from fieldscribe.export import export_model
from fieldscribe.importing import compilable
from fieldscribe.importing.readers import UnreadableError
from fieldscribe.pipeline import load_device
from support.files import write_files
from support.places import TESTS
from support.rust_crates import without_registry
from support.rust_workspace import QUICK, RUNTIMES, WORKSPACE

from corpus import writing
from corpus.collection import Collection, Counts
from corpus.dbc import DBC
from corpus.registers import KINDS, UnlikeError
from corpus.sunspec import SUNSPEC
from corpus.wb import WB

COLLECTIONS: tuple[Collection, ...] = (WB, SUNSPEC, DBC)
LANGUAGES = ("c", "python", "rust")


class Compared(NamedTuple):
    """A device: its points, those that the oracle knows, its vectors of both kinds, and what is unlike the oracle."""

    name: str
    file: Path
    points: int
    known: int
    read: int
    written: int
    unlike: Sequence[str]


def compare(folder: Path, values: int, devices: int = 40, seed: int = 1, languages: Sequence[str] = LANGUAGES) -> int:
    """Print a line of counts for each collection, and what differs; return how much that is."""
    wrong = [f"wrong in {one}" for one in languages]
    columns = ("collection", "devices", "points", "compared", "decoded in each language", "encoded", *wrong)
    print(f"| {' | '.join(columns)} |\n{'|---' * len(columns)}|", flush=True)
    chance = random.Random(seed)
    with TemporaryDirectory(prefix="fieldscribe-values-") as place:
        out = Path(place)
        made = {
            one: _imported_files(one, files, devices, chance, out)
            for one in COLLECTIONS
            if (files := one.files(folder))
        }
        _compile(out, languages)
        compared = {
            collection: [_asked(collection, one, values // len(imported), chance, out) for one in imported]
            for collection, imported in made.items()
        }
        if "rust" in languages:
            _write_workspace([one.name for each in compared.values() for one in each], out)
        return sum(_compare(collection, each, languages, out) for collection, each in compared.items())


def _imported_files(
    collection: Collection, files: list[Path], devices: int, chance: random.Random, out: Path
) -> list[tuple[str, Path]]:
    """Import random files until there are so many devices; return each one's name and file."""
    chance.shuffle(files)
    made: list[tuple[str, Path]] = []
    with ProcessPoolExecutor(os.cpu_count()) as pool:
        for at in range(0, len(files), 4):
            part = files[at : at + 4]
            texts = zip(part, pool.map(_imported, [collection] * 4, part), strict=True)
            for file, text in [each for each in texts if each[1]][: devices - len(made)]:
                name = f"{collection.name}_{len(made) + 1}"
                place = out / "descriptions" / name / "device.yaml"
                place.parent.mkdir(parents=True)
                place.write_text(re.sub(r"(?m)^device: \w+$", f"device: {name}", text, count=1), "utf-8")
                made.append((name, file))
            if len(made) == devices:
                break
    return made


def _compile(out: Path, languages: Sequence[str]) -> None:
    """Compile all descriptions of a folder to these languages."""
    targets = ("--target", ",".join((*languages, "vectors")))
    command = (sys.executable, "-m", "fieldscribe", "generate", str(out / "descriptions"), "--out", str(out), *targets)
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(done.stdout[-2000:] + done.stderr[-2000:])


def _write_workspace(names: Sequence[str], out: Path) -> None:
    """Make one cargo workspace of the crates of these devices."""
    without_registry(out / "rust")
    crates = [*RUNTIMES, *names, *(f"{name}/conformance" for name in names)]
    texts = {"Cargo.toml": WORKSPACE.replace("@MEMBERS@", json.dumps(crates)), ".cargo/config.toml": QUICK}
    write_files(texts, out / "rust")


def _imported(collection: Collection, file: Path) -> str:
    """Return the description of a file; empty where there is none."""
    try:
        drafted = collection.draft(file)
    except (UnreadableError, ValueError):  # `make corpus` reports it
        return ""
    return "" if drafted is None else compilable(drafted.groups, drafted.head, with_head=True)


def _compare(collection: Collection, compared: Sequence[Compared], languages: Sequence[str], out: Path) -> int:
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        ran = list(pool.map(lambda one: [_run(language, one, out) for language in languages], compared))
    totals = [sum(getattr(one, key) for one in compared) for key in ("points", "known", "read", "written")]
    wrong = Counter({name: sum(counts[at] for counts in ran) for at, name in enumerate(languages)})
    columns = (collection.name, len(compared), *totals, *wrong.values())
    print(f"| {' | '.join(map(str, columns))} |", flush=True)
    for one in compared:
        for text in one.unlike:
            print(f"  {one.file.name}: {text}", flush=True)
    return wrong.total() + sum(len(one.unlike) for one in compared)


def _asked(collection: Collection, made: tuple[str, Path], values: int, chance: random.Random, out: Path) -> Compared:
    """Write the vectors of a device over its own."""
    name, file = made
    device = load_device(out / "descriptions" / name / "device.yaml", Report())
    assert device is not None
    encodes = {point.name: point.encodes_values for point in device.points}
    points = [
        point | {"encodes": encodes[point["name"]]} for point in export_model(device)["points"] if point["generated"]
    ]
    per_point = [-(-values // (2 * max(1, sum(way in point["access"] for point in points)))) for way in "rw"]
    lines: list[str] = []
    counts: Counter[str] = Counter()
    unlike, known = [], 0
    for point, vectors in collection.expected(file, points, chance, Counts(*per_point)):
        lines.append(f"point\t{point}")
        known += 1
        try:
            for line in vectors:
                lines.append(line)
                counts[line.partition("\t")[0]] += 1
        except UnlikeError as error:
            unlike.append(f"{point}: {error}")
    del counts["with"], counts["telegram"]
    place = out / "vectors" / f"{name}.txt"
    head = [line for line in place.read_text("utf-8").split("\n") if line.startswith(("vectors\t", "set\t"))]
    kinds = ["\t".join(("kind", kind, str(count), *KINDS[kind].split())) for kind, count in counts.items()]
    place.write_text("\n".join((*head, *kinds, *lines, "")), "utf-8")
    written = sum(counts[kind] for kind in writing.KINDS)
    return Compared(name, file, len(points), known, counts.total() - written, written, unlike)


def _run(language: str, one: Compared, out: Path) -> int:
    """Return how many vectors a language answers otherwise; all of them where it does not build."""
    vectors, program = out / "vectors" / f"{one.name}.txt", out / one.name
    if language == "c":
        source = out / "c" / "conformance" / f"{one.name}_conformance.c"
        done = _done(out, "clang", "-std=c99", "-O0", "-o", str(program), str(source), "-lm")
        done = _done(out, str(program), str(vectors)) if done.returncode == 0 else done
    elif language == "python":
        done = _done(out, sys.executable, str(TESTS / "conformance"), str(out / "python"), one.name, str(vectors))
    else:
        command = ("cargo", "--offline", "test", "--quiet", "-p", f"{one.name}_conformance", "--test", "conformance")
        done = _done(out / "rust", *command, vectors=vectors)
    counts = {kind: (int(good), int(bad)) for kind, good, bad in re.findall(_COUNTS, done.stdout)}
    passed = sum(good for kind, (good, _) in counts.items() if kind in KINDS)
    wrong = one.read + one.written - passed
    if wrong:
        print(f"  {one.file.name} in {language}: {done.stderr[-3000:]}", flush=True)
    return wrong


_COUNTS = re.compile(r"(?m)^(\w+) (\d+) passed, (\d+) failed")


def _done(folder: Path, *command: str, vectors: Path | None = None) -> subprocess.CompletedProcess[str]:
    environment = os.environ | ({} if vectors is None else {"FIELDSCRIBE_VECTORS": str(vectors)})
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)
