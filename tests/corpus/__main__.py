"""`make corpus FOLDER=...`: a line of marks for each collection in the folder, and what its drafts do not carry.

With `VALUES=1000000` it decodes and encodes so many values of 40 random devices of each in all languages, instead, and
compares them with an oracle.
"""

from __future__ import annotations

import os
import re
import sys
import time
from collections import Counter
from collections.abc import Mapping
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import NamedTuple

from fieldscribe.importing import compilable
from fieldscribe.importing.readers import UnreadableError

from corpus.values import COLLECTIONS, compare


class Measured(NamedTuple):
    """What became of one file: an error, or how many points it has, how many are whole, and what is not carried."""

    error: str
    points: int
    whole: int
    lost: Mapping[str, int]
    seconds: float


def main(folder: Path) -> int:
    """Print the marks of all collections in the folder; 1 if there is none."""
    found = [(collection, collection.files(folder)) for collection in COLLECTIONS]
    print(
        "| collection | files | compile | with every fact | points | whole | seconds |\n|---|---|---|---|---|---|---|"
    )
    with ProcessPoolExecutor(os.cpu_count()) as pool:
        for number, (collection, files) in enumerate(found):
            if files:
                measured = list(pool.map(_measured, [number] * len(files), files, chunksize=2))
                _print(collection.name, files, measured)
    return int(not any(files for _, files in found))


def _measured(number: int, file: Path) -> Measured | None:
    """Return what becomes of a file; None if its collection leaves it out."""
    start = time.monotonic()
    try:
        drafted = COLLECTIONS[number].draft(file)
        if drafted is None:
            return None
        compilable(drafted.groups, drafted.head, with_head=True)
    except UnreadableError as error:
        return Measured(error.message, 0, 0, {}, 0.0)
    except Exception as error:  # an importer must not fail, so this is a finding
        return Measured(repr(error), 0, 0, {}, 0.0)
    points = [point for group in drafted.groups for point in group.points]
    texts = [text for group in drafted.groups for text in group.comments]
    texts += [text for point in points for text in point.questions]
    texts += [text for block in drafted.head.blocks for text in block.questions]
    lost = Counter(text.removeprefix("not carried: ").partition(":")[0] for text in texts)
    counts = [(_count(point.facts.get("indices", "1")), not point.questions) for point in points]
    whole = sum(count for count, is_whole in counts if is_whole)
    return Measured("", sum(count for count, _ in counts), whole, lost, time.monotonic() - start)


def _count(indices: str) -> int:
    """Return how many points a row has."""
    ends = re.fullmatch(r"(\d+)\.\.(\d+)", indices)
    return int(ends[2]) - int(ends[1]) + 1 if ends else int(indices) if indices.isdigit() else 1


def _print(name: str, files: list[Path], measured: list[Measured | None]) -> None:
    results = [(file, each) for file, each in zip(files, measured, strict=True) if each is not None]
    fine = [each for _, each in results if not each.error]
    points, whole = sum(each.points for each in fine), sum(each.whole for each in fine)
    every = sum(not each.lost for each in fine)
    share = f"{whole / points:.2%}" if points else ""
    seconds = f"{sum(each.seconds for each in fine):.0f}"
    print(f"| {name} | {len(results)} | {len(fine)} | {every} | {points} | {share} | {seconds} |")
    for file, each in results:
        if each.error:
            print(f"  {file.name}: {each.error}")
    for key in sorted({key for each in fine for key in each.lost}):
        having = [each for each in fine if key in each.lost]
        times, alone = sum(each.lost[key] for each in having), sum(len(each.lost) == 1 for each in having)
        print(f"  not carried: {key}: {times} in {len(having)} files, alone in {alone}")


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3) or not Path(sys.argv[1]).is_dir():
        sys.exit(
            "make corpus FOLDER=...: the folder of a collection, templates of wb-mqtt-serial, models of SunSpec, DBC"
        )
    if len(sys.argv) > 2:
        sys.exit(compare(Path(sys.argv[1]), int(sys.argv[2])) > 0)
    sys.exit(main(Path(sys.argv[1])))
