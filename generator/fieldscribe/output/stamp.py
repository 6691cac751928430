"""Remembers what the last run read and wrote, so that a run on unchanged input ends before anything heavy is imported.

The memory lies in the user's cache folder. It holds checksums of the inputs, of the compiler itself and of the outputs
as they were left; any difference, also in an output, means that the run is done in full.
"""

from __future__ import annotations

import json
import os
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING

from fieldscribe import __version__
from fieldscribe.output.cache import cache_dir
from fieldscribe.resources import templates_dir

if TYPE_CHECKING:
    from collections.abc import Iterable

PACKAGE = Path(__file__).resolve().parents[1]
"""The compiler itself: every file below it counts as input."""


def digest_of(inputs: Iterable[Path], words: Iterable[str]) -> str:
    """A checksum of the contents of the inputs, of the compiler, and of what was asked for."""
    summed = sha256(__version__.encode())
    for word in words:
        summed.update(b"\0" + word.encode())
    for path in inputs:
        data = path.read_bytes()
        summed.update(f"\0{path}\0{len(data)}\0".encode())
        summed.update(data)
    for root in (PACKAGE, templates_dir()):
        _add_tree(summed.update, root)
    return summed.hexdigest()


def remembered(out: Path, digest: str) -> list[str] | None:
    """The outputs of the last run, if it had this digest and none of them was touched since; else None."""
    place = _place(out)
    if place is None:
        return None
    try:
        memory = json.loads(place.read_bytes())
        if memory["digest"] != digest:
            return None
        outputs: dict[str, list[int]] = memory["outputs"]
        for path, left in outputs.items():
            status = os.stat(out / path)
            if [status.st_size, status.st_mtime_ns] != left:
                return None
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return None
    return list(outputs)


def remember(out: Path, digest: str, outputs: Iterable[str]) -> None:
    """Keep the digest and the state of the outputs; quietly does nothing where there is no place for it."""
    place = _place(out)
    if place is None:
        return
    try:
        left = {path: [status.st_size, status.st_mtime_ns] for path in outputs for status in (os.stat(out / path),)}
        temporary = place.with_suffix(f".{os.getpid()}")
        temporary.write_text(json.dumps({"digest": digest, "outputs": left}), "utf-8")
        temporary.replace(place)
    except OSError:
        return


def _place(out: Path) -> Path | None:
    folder = cache_dir("runs")
    return folder and folder / f"{sha256(str(out.resolve()).encode()).hexdigest()[:24]}.json"


def _add_tree(update: object, root: Path) -> None:
    """The compiler's files by size and time: they are not edited between two runs without either changing."""
    assert callable(update)
    for folder, folders, files in os.walk(root):
        folders[:] = sorted(name for name in folders if name != "__pycache__")
        for name in sorted(files):
            status = os.stat(os.path.join(folder, name))
            update(f"{folder}/{name}\0{status.st_size}\0{status.st_mtime_ns}\0".encode())
