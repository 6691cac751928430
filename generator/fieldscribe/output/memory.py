"""The result of a run, and a memory of the last one: a run without changes ends before the compiler is imported.

The user's cache folder records the state and digest of each input and output, and the state of each file of the
compiler. A file is read again only if its state is too new to trust. Any difference means a full run. `generate
--check` does not use the record. The cache holds plain data; nothing in it is executed.
"""

import json
import os
import sys
from collections.abc import Iterable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any
from zlib import crc32

from fieldscribe import __version__
from fieldscribe.resources import compiler_files
from fieldscribe.safe_files import Inputs, State, read_regular, state_of

_MOST_BYTES = 64 << 20
_SETTLED = 2_000_000_000
"""Nanoseconds after which the times of a file are trusted: two changes within one tick of the clock look like one."""


class Result:
    """The result of a run: the relative paths of its outputs, by what happened to them.

    `wanted` are all outputs; `states` and `digests` are those of up-to-date outputs.
    """

    def __init__(self, wanted: Iterable[str] = ()) -> None:
        self.wanted = set(wanted)
        self.written: set[str] = set()
        self.removed: set[str] = set()
        self.stale: set[str] = set()
        self.kept: set[str] = set()
        self.states: dict[str, State] = {}
        self.digests: dict[str, str] = {}

    @property
    def left(self) -> int:
        """The number of files that were up to date; a shared file counts only for the device that wrote it."""
        return len(self.wanted - self.written - self.stale)


class Memory:
    """The record of the last run with these targets, descriptions and output folder."""

    def __init__(self, out: Path, targets: Iterable[str], device_files: Iterable[Path]) -> None:
        self._out = out
        named = [os.path.realpath(out), *targets, *map(os.path.abspath, device_files)]
        self._run = [*map(ascii, named), *_compiler()]
        folder = cache_dir()
        name = crc32(
            "\0".join(named).encode("utf-8", "surrogateescape")
        )  # runs with the same name overwrite each other's record
        self._place = folder and folder / f"{name:08x}.json"

    def outputs(self) -> list[str] | None:
        """Return the outputs of the last run; None if an input or output has changed since."""
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
        """Record inputs and outputs, unless there is no cache folder or the compiler was edited meanwhile."""
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
    """Return True if the state of a file is the recorded one and old enough to trust."""
    state = state_of(os.stat(path))
    return list(state) == left and max(state[2:]) <= settled


def _holds(path: str, digest: str) -> bool:
    from hashlib import sha256

    return sha256(read_regular(path, 512 << 20).data).hexdigest() == digest


def _compiler() -> list[str]:
    """Return the versions and the states of the compiler's files: every edit changes one of them."""
    return [__version__, sys.version, *(f"{path!a} {state_of(os.stat(path))}" for path in compiler_files())]


def cache_dir() -> Path | None:
    """Return the cache folder of the records, created if missing; None unless only this user can write to it."""
    base = os.environ.get("XDG_CACHE_HOME", "")
    if not os.path.isabs(base):  # the XDG specification says to ignore a relative path
        base = os.path.expanduser("~/.cache")
    if not os.path.isabs(base):
        return None  # no home folder
    place = Path(base) / "fieldscribe" / "runs"
    try:
        place.mkdir(mode=0o700, parents=True, exist_ok=True)
        status = place.lstat()
    except OSError:
        return None
    # a record written by others could make stale outputs look unchanged
    private = not hasattr(os, "getuid") or (status.st_uid == os.getuid() and not status.st_mode & 0o022)
    return place if private and os.access(place, os.W_OK) else None
