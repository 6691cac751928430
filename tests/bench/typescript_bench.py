"""Measures decoding in TypeScript beside a hand-written read of a DataView with a scale, in one run of node."""

from __future__ import annotations

import importlib
import json
import shutil
import sys
import tempfile
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))
packages = importlib.import_module("support.typescript_packages")
toolchains = importlib.import_module("support.toolchains")
PROGRAM = Path(__file__).with_suffix(".mjs")


def print_typescript() -> None:
    """Nanoseconds a value, and how many times a hand-written read that is."""
    with tempfile.TemporaryDirectory() as folder:
        packages.install(Path(folder), [packages.SHIPPED / "hitachi_l200"])
        shutil.copy(PROGRAM, folder)
        node = [toolchains.tool("node"), PROGRAM.name]
        found = json.loads(toolchains.succeed(node, cwd=Path(folder)))
    by_hand = found.pop("byHand")
    print(f"TypeScript, a read by hand: {by_hand * 1e9:.2f} ns a value")
    for name, seconds in found.items():
        times = f"{seconds / by_hand:.2f} times a read by hand (at most 1.5)"
        print(f"TypeScript, {name}: {seconds * 1e9:.2f} ns a value, {times}")


if __name__ == "__main__":
    print_typescript()
