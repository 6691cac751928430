"""Carries out a plan, and writes the dependency file for make and ninja: the outputs depend on inputs and compiler.

Each file is replaced atomically, and at every moment a manifest records which files are ours. Make and ninja compare
times. An unchanged output would stay older than a changed input and be built again each time, so outputs older than
an input are touched. Each input has an empty rule, so that a build continues after an input was removed.
"""

from __future__ import annotations

import os
from collections.abc import Iterable
from errno import EINVAL
from pathlib import Path
from time import time_ns
from typing import TYPE_CHECKING

from fieldscribe.resources import compiler_files
from fieldscribe.safe_files import State, UnfitFileError, inside, kind_of, state_of

if TYPE_CHECKING:
    from fieldscribe.output.files import Manifests
    from fieldscribe.output.plan import Plan

_NEW = ".fieldscribe-new"
_FLAGS = os.O_WRONLY | os.O_CREAT | os.O_EXCL
for _name in ("O_NOFOLLOW", "O_CLOEXEC", "O_BINARY", "O_NOINHERIT"):
    _FLAGS |= getattr(os, _name, 0)

_BREAK = " \\\n  "
"""Between the inputs of a rule."""


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


def carry_out(out: Path, manifests: Manifests, plan: Plan) -> dict[str, State]:
    """Write and remove files according to the plan; return the final state of each file. Raises OSError."""
    for folder in {(out / path).parent for path in (*plan.unchanged, *plan.write)}:
        (folder / _NEW).unlink(missing_ok=True)  # left by a killed run
    states = dict(plan.unchanged)
    if plan.record in plan.write:
        replace(inside(out, plan.record), (plan.pending,))
    for path, contents in plan.write.items():  # the manifest comes last
        states[path] = replace(inside(out, path), contents.pieces())
    for path in plan.remove:
        inside(out, path).unlink(missing_ok=True)
    manifests.settle(plan.device, plan.targets)
    return states


def replace(place: Path, pieces: Iterable[bytes], temporary: str = _NEW, *, mode: int | None = None) -> State:
    """Replace a file atomically through a temporary file beside it, and return its state. Raises OSError.

    `mode` is the mode of the file; by default the umask decides.
    """
    place.parent.mkdir(parents=True, exist_ok=True)
    new = place.parent / temporary
    new.unlink(missing_ok=True)
    try:
        with open(os.open(new, _FLAGS, 0o666), "wb") as stream:
            stream.writelines(pieces)
        if mode is not None:
            os.chmod(new, mode)
        os.replace(new, place)
    except BaseException:
        new.unlink(missing_ok=True)
        raise
    return state_of(os.lstat(place))


def update_depfile(place: Path, outputs: Iterable[Path], inputs: Iterable[Path]) -> None:
    """Write the file, and touch outputs that are older than an input. Raises OSError.

    Outputs keep the paths that the user gave, because a build uses these.
    """
    made = list(outputs)
    sources = [*inputs, *map(Path, compiler_files())]
    needed = [Path(os.path.abspath(source)) for source in sources]  # a build may run in another folder
    write_depfile(place, made, needed)
    newest = max(path.stat().st_mtime_ns for path in needed)
    for path in made:
        if path.stat().st_mtime_ns < newest:
            now = max(newest, time_ns())  # an input may be from the future
            os.utime(path, ns=(now, now))


def write_depfile(place: Path, outputs: Iterable[Path], inputs: Iterable[Path]) -> None:
    """Write the file atomically. Raises OSError."""
    names = list(dict.fromkeys(map(_escaped, inputs)))
    rules = [f"{' '.join(map(_escaped, outputs))}: {_BREAK.join(names)}", *(f"{name}:" for name in names)]
    _put(Path(os.path.realpath(place)), ("\n".join(rules) + "\n").encode("utf-8", "surrogateescape"))


def _escaped(path: Path) -> str:
    """Return the path with blanks, `#` and `$` escaped. Raises UnfitFileError for control characters."""
    text = str(path)
    if any(ord(char) < 0x20 or char == "\x7f" for char in text):
        raise UnfitFileError(EINVAL, f"make cannot name the path {text!a}: rename it")
    return text.replace("\\", "/").replace("$", "$$").replace("#", "\\#").replace(" ", "\\ ")


def _put(place: Path, data: bytes) -> None:
    if place.is_char_device():
        place.write_bytes(data)  # a device such as /dev/null cannot be replaced
        return
    if place.exists() and (kind := kind_of(place.stat())) is not None:
        raise UnfitFileError(EINVAL, kind, str(place))
    replace(place, (data,), f".{place.name}.new")
