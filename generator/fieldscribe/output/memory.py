"""Remembers what the last run read and wrote, so that a run on unchanged input ends before the compiler is imported.

The user's cache folder holds the states and checksums of the inputs as they were compiled, of the outputs as they were
left, and the states of the compiler's own files. A file is read only where its state cannot be trusted. Any difference
means that the run is done in full. `generate --check` never asks it.
"""

from __future__ import annotations

import json
import os
import sys
from contextlib import suppress
from typing import TYPE_CHECKING, Any
from zlib import crc32

from fieldscribe import __version__
from fieldscribe.output.cache import cache_dir
from fieldscribe.resources import compiler_files
from fieldscribe.safe_files import read_regular, state_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from pathlib import Path

    from fieldscribe.safe_files import Inputs, State

_MOST_BYTES = 64 << 20
_SETTLED = 2_000_000_000
"""Nanoseconds after which a file's times are trusted: two changes within one tick of the clock look like one."""


class Memory:
    """The memory of runs with these targets, descriptions and output folder."""

    def __init__(self, out: Path, targets: Iterable[str], device_files: Iterable[Path]) -> None:
        self._out = out
        asked = [os.path.realpath(out), *targets, *map(os.path.abspath, device_files)]
        self._run = [*map(ascii, asked), *_compiler()]
        folder = cache_dir("runs")
        name = crc32("\0".join(asked).encode("utf-8", "surrogateescape"))  # two runs of one name forget each other
        self._place = folder and folder / f"{name:08x}.json"

    def outputs(self) -> list[str] | None:
        """The outputs of the last run, if its inputs are unchanged and no output was touched since; else None."""
        if self._place is None:
            return None
        try:
            content = read_regular(self._place, _MOST_BYTES)
            memory = json.loads(content.data)
            inputs: dict[str, dict[str, Any]] = memory["inputs"]
            outputs: dict[str, dict[str, Any]] = memory["outputs"]
            if memory["run"] != self._run:
                return None
            settled = content.state[2] - _SETTLED
            files = {**inputs, **{os.path.join(self._out, path): left for path, left in outputs.items()}}
            doubtful = [path for path, left in files.items() if not _is_as_left(path, left["state"], settled)]
            if not all(_holds(path, files[path]["sha256"]) for path in doubtful):
                return None
            if doubtful:
                os.utime(self._place)
        except (OSError, ValueError, KeyError, TypeError, AttributeError, IndexError, RecursionError):
            return None
        return list(outputs)

    def keep(self, inputs: Inputs, states: Mapping[str, State], digests: Mapping[str, str]) -> None:
        """Remember inputs and outputs; does nothing without a cache folder, or if the compiler was edited meanwhile."""
        from fieldscribe.output.writing import replace

        compiler = _compiler()
        if self._place is None or compiler != self._run[-len(compiler) :]:
            return
        document = {
            "run": self._run,
            "inputs": {
                os.path.abspath(path): {"state": inputs.states[path], "sha256": digest}
                for path, digest in inputs.digests.items()
            },
            "outputs": {path: {"state": state, "sha256": digests[path]} for path, state in states.items()},
        }
        with suppress(OSError, ValueError):
            replace(self._place, (json.dumps(document).encode(),), f"{self._place.stem}.new")


def _is_as_left(path: str, left: list[int], settled: int) -> bool:
    """Whether a file's state is the remembered one and old enough for its times to be trusted."""
    state = state_of(os.stat(path))
    return list(state) == left and max(state[2:]) <= settled


def _holds(path: str, digest: str) -> bool:
    from hashlib import sha256

    return sha256(read_regular(path, 512 << 20).data).hexdigest() == digest


def _compiler() -> list[str]:
    """The versions and the states of the compiler's files: every edit changes one of them."""
    return [__version__, sys.version, *(f"{path!a} {state_of(os.stat(path))}" for path in compiler_files())]
