"""Remembers what the last run read and wrote, so that a run on unchanged input ends before the compiler is imported.

The user's cache folder holds checksums of the inputs as they were compiled and of the compiler, and the state of the
outputs as they were left. Any difference means that the run is done in full. `generate --check` never asks it.
"""

from __future__ import annotations

import json
import os
import sys
from contextlib import suppress
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fieldscribe import __version__
from fieldscribe.output.cache import cache_dir
from fieldscribe.reading import read_regular, state_of
from fieldscribe.resources import templates_dir

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from fieldscribe.reading import Inputs, State

PACKAGE = Path(__file__).resolve().parents[1]
"""The compiler itself; every file below counts as an input."""

_MOST_BYTES = 64 << 20
_SETTLED = 2_000_000_000
"""Nanoseconds after which a file's times are trusted: two changes within one tick of the clock look like one."""


class Memory:
    """The memory of runs with these targets, descriptions and output folder."""

    def __init__(self, out: Path, targets: Iterable[str], device_files: Iterable[Path]) -> None:
        self._out = out
        asked = [os.path.realpath(out), *targets, *map(os.path.abspath, device_files)]
        folder = cache_dir("runs")
        name = sha256("\0".join(asked).encode("utf-8", "surrogateescape")).hexdigest()[:24]
        self._place = folder and folder / f"{name}.json"
        self._compiler = _compiler()

    def outputs(self) -> list[str] | None:
        """The outputs of the last run, if its inputs are unchanged and no output was touched since; else None."""
        if self._place is None:
            return None
        try:
            content = read_regular(self._place, _MOST_BYTES)
            memory = json.loads(content.data)
            inputs: dict[str, str] = memory["inputs"]
            outputs: dict[str, Any] = memory["outputs"]
            if memory["compiler"] != self._compiler or not all(_holds(*entry) for entry in inputs.items()):
                return None
            young = [path for path, left in outputs.items() if self._changed(path, left["state"], content.state[2])]
            if not all(_holds(self._out / path, outputs[path]["sha256"]) for path in young):
                return None
            if young:
                os.utime(self._place)
        except (OSError, ValueError, KeyError, TypeError, AttributeError, IndexError, RecursionError, _TouchedError):
            return None
        return list(outputs)

    def keep(self, inputs: Inputs, states: Mapping[str, State], digests: Mapping[str, str]) -> None:
        """Remember the inputs and the state of the outputs; does nothing without a cache folder."""
        if self._place is None or _compiler() != self._compiler:
            return
        from fieldscribe.output.writing import replace

        document = {
            "compiler": self._compiler,
            "inputs": {os.path.abspath(path): digest for path, digest in inputs.digests.items()},
            "outputs": {path: {"state": state, "sha256": digests[path]} for path, state in states.items()},
        }
        with suppress(OSError, ValueError):
            replace(self._place, json.dumps(document).encode(), f"{self._place.stem}.new")

    def _changed(self, path: str, left: list[int], remembered: int) -> bool:
        """Whether an output is too young for its times to be trusted. Raises _TouchedError if it was touched."""
        state = state_of(os.stat(self._out / path))
        if list(state) != left:
            raise _TouchedError
        return max(state[2:]) > remembered - _SETTLED


class _TouchedError(Exception):
    """An output was changed since the last run."""


def _holds(path: str | Path, digest: str) -> bool:
    return sha256(read_regular(path, 512 << 20).data).hexdigest() == digest


def _compiler() -> str:
    """A checksum over the states of the compiler's files: every edit changes one of them."""
    summed = sha256(f"{__version__}\0{sys.version}\0".encode())
    for root in (PACKAGE, templates_dir()):
        for folder, folders, files in os.walk(root):
            folders[:] = sorted(name for name in folders if name != "__pycache__")
            for name in sorted(files):
                state = state_of(os.stat(os.path.join(folder, name)))
                summed.update(f"{folder}/{name}\0{state}\0".encode("utf-8", "surrogateescape"))
    return summed.hexdigest()
