"""Carries out a plan: replaces each file atomically; at every moment a manifest records which files are ours."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from fieldscribe.safe_files import State, inside, state_of

if TYPE_CHECKING:
    from fieldscribe.output.manifests import Manifests
    from fieldscribe.output.plan import Plan

_NEW = ".fieldscribe-new"
_FLAGS = os.O_WRONLY | os.O_CREAT | os.O_EXCL
for _name in ("O_NOFOLLOW", "O_CLOEXEC", "O_BINARY", "O_NOINHERIT"):
    _FLAGS |= getattr(os, _name, 0)


class Result:
    """What a run did: the relative paths of its outputs by what happened to them.

    `wanted` are all outputs; `states` and `digests` belong to those that are up to date.
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
        """The number of files that were up to date; a shared file that one device wrote does not count for another."""
        return len(self.wanted - self.written - self.stale)


def carry_out(out: Path, manifests: Manifests, plan: Plan) -> dict[str, State]:
    """Write and remove what the plan says, and return the final state of each file. Raises OSError."""
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

    `mode` is the file's mode; without it the user's umask decides.
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
