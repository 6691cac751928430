"""Throws mutated descriptions, frames and words at everything that reads them, and prints what came of it.

    .venv/bin/python tests/fuzz/run.py [--seed 1] [--keep DIR]
        [--mutants 20000] [--frames 1000000] [--lines 3000]

The same seed makes the same cases. Frames go through the parsers in C (with the sanitizers of gcc and clang), Rust
(with overflow checks and debug assertions) and Python, which must all say the same. Cases that went wrong are kept in
DIR; ends with 1 if there are any.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))  # as a program

from collections.abc import Iterator, Sequence

from fuzz.frames import CASES
from fuzz.languages import Result, fuzz_family, generate


def everything(seed: int, keep: Path, *, mutants: int = 0, frames: int = 0, lines: int = 0) -> Iterator[Result]:
    """All kinds, as many cases of each as is said; 0 leaves a kind out."""
    from fuzz.descriptions import fuzz_descriptions
    from fuzz.words import fuzz_words

    keep.mkdir(parents=True, exist_ok=True)
    if mutants:
        yield fuzz_descriptions(mutants, seed, keep)
    if lines:
        yield fuzz_words(lines, seed, keep)
    if frames:
        with tempfile.TemporaryDirectory() as work:
            generate(Path(work))
            for family in CASES:
                yield from kept(fuzz_family(family, frames, seed, Path(work)), family, seed, keep)


def kept(results: Iterator[Result], family: str, seed: int, keep: Path) -> Iterator[Result]:
    """The same, with the findings written to a file."""
    for result in results:
        if result.findings:
            with (keep / f"frames_{family}_{seed}.txt").open("a", encoding="utf-8") as file:
                file.write("\n".join((result.what, *result.findings, "")))
        yield result


def table(results: Iterator[Result], seed: int) -> int:
    """Prints a line for each kind as it comes, with its findings; how many there were."""
    findings = 0
    print(f"{'what':<32} {'how many':>9} {'findings':>8} {'seconds':>8}  seed", flush=True)
    for one in results:
        findings += len(one.findings)
        print(f"{one.what:<32} {one.count:>9,} {len(one.findings):>8} {one.seconds:>8.1f}  {seed}", flush=True)
        for finding in one.findings[:20]:
            print(f"    {finding}")
    return findings


def main(argv: Sequence[str] | None = None) -> int:
    """Print the table; 1 if anything was found."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--mutants", type=int, default=20_000)
    parser.add_argument("--frames", type=int, default=1_000_000)
    parser.add_argument("--lines", type=int, default=3_000)
    parser.add_argument("--keep", type=Path, default=Path(".cache/fuzz"))
    chosen = parser.parse_args(argv)
    keep = chosen.keep.resolve()
    counts = {name: getattr(chosen, name) for name in ("mutants", "frames", "lines")}
    found = table(everything(chosen.seed, keep, **counts), chosen.seed)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
