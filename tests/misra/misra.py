"""Counts what cppcheck's MISRA addon says of the made devices' headers, and holds it against README.md here.

    .venv/bin/python tests/misra/misra.py [--accept]

Ends with 1 when the table is not what is found; `--accept` writes the counts into it. A rule that has no reason there
is always a finding.
"""

from __future__ import annotations

import re
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

from fieldscribe.diagnostics import Report
from fieldscribe.pipeline import load_device
from fieldscribe.resources import render, templates_dir
from fieldscribe.targets import c

HERE = Path(__file__).resolve().parent
DEVICES = HERE.parent / "devices"
TABLE = HERE / "README.md"
MADE = ("kitchen_sink", "kitchen_codes", "kitchen_blocks", "kitchen_can", "kitchen_uss")
ROW = re.compile(r"^\| ([0-9.]+) \| +([0-9]+) \|", re.MULTILINE)
DEFINED = ("FLT_RADIX=2", "FLT_MANT_DIG=24", "DBL_MANT_DIG=53", "FLT_EVAL_METHOD=0", "FIELDSCRIBE_NAMES")
"""What float.h would define, without which cppcheck skips all floating point, and what the most lines ask for."""
COMMAND = (
    *("cppcheck", "--addon=misra", "--std=c99", "--platform=unix32", "--enable=style", "-q"),
    *(f"-D{name}" for name in DEFINED),
)


def found(folder: Path) -> Counter[str]:
    """How often each rule is broken in the headers of points and frames, and in what they are made of."""
    frames = []
    for name in MADE:
        device = load_device(DEVICES / name / "device.yaml", Report())
        assert device is not None
        texts = {Path(path).name: text for path, text in c.outputs(device, render) if "conformance" not in path}
        copied = {Path(path).name: source for path, source in c.runtime(device) if "conformance" not in path}
        texts |= {path: (templates_dir() / source).read_text("utf-8") for path, source in copied.items()}
        for path, text in texts.items():
            (folder / path).write_text(text, "utf-8")
        frames.append(f"{name}_{device.family}.h")
    source = folder / "all.c"
    includes = "".join(f'#include "{path}"\n' for path in frames)
    source.write_text(f"#define FIELDSCRIBE_IMPLEMENTATION\n{includes}", "utf-8")
    done = subprocess.run([*COMMAND, f"-I{folder}", source], capture_output=True, text=True, check=False)
    return Counter(re.findall(r"\[misra-c2012-([0-9.]+)\]", done.stderr))


def written() -> dict[str, int]:
    """The counts of the table, by rule."""
    return {rule: int(count) for rule, count in ROW.findall(TABLE.read_text("utf-8"))}


def differences(seen: Counter[str]) -> Iterator[str]:
    """What the table says wrongly."""
    known = written()
    for rule in sorted({*seen, *known}):
        if seen[rule] != known.get(rule, 0):
            yield f"rule {rule}: found {seen[rule]} times, the table says {known.get(rule, 'nothing')}"


def main() -> int:
    """Print what differs; 1 when something does."""
    with tempfile.TemporaryDirectory() as folder:
        seen = found(Path(folder))
    if "--accept" in sys.argv:
        text = ROW.sub(lambda row: row[0].replace(f" {row[2]} |", f" {seen[row[1]]} |", 1), TABLE.read_text("utf-8"))
        TABLE.write_text(text, "utf-8")
    wrong = list(differences(seen))
    print(*(wrong or ["the table is true"]), sep="\n")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
