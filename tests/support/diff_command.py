"""Runs `fieldscribe diff` for the tests."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from typing import Any, NamedTuple

import pytest
from fieldscribe.cli import main

from support.described import described, write

POINTS = """\
- {code: P1, name: speed, at: 10h, range: 0..4000, unit: Hz}   # the first one
- name: state     # what it does
  at: 16h
  enum: {0: stop, 1: run}
- {name: ramp, at: 20h, sets: {2: {at: 30h}}}
"""


EDITED = POINTS.replace("at: 10h", "at: 11h").replace("1: run", "1: run, 2: wait")


class Result(NamedTuple):
    """What a run did."""

    code: int
    out: str
    err: str


class Diff:
    """Runs the command in a folder of its own."""

    def __init__(self, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
        self.folder, self._capsys = folder, capsys

    def write(self, name: str, points: str, **said: str) -> Path:
        """A description in a folder of that name; its device.yaml."""
        return write(self.folder / name, described(points, **said))

    def __call__(self, *words: str) -> Result:
        """The command with these arguments."""
        self._capsys.readouterr()
        return Result(main(["diff", *words]), *self._capsys.readouterr())

    def changes(self, *words: str) -> list[dict[str, Any]]:
        """What JSON says."""
        changes: list[dict[str, Any]] = json.loads(self(*words, "--format", "json").out)["changes"]
        return changes


def git(*words: str) -> None:
    """Run git in the working folder."""
    subprocess.run(["git", *words], check=True, capture_output=True)


def commit(message: str) -> None:
    """Commit every change in the working folder."""
    git("add", ".")
    git("-c", "user.name=a", "-c", "user.email=a@b", "-c", "commit.gpgsign=false", "commit", "-q", "-m", message)
