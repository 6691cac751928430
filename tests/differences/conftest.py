"""`fieldscribe diff` in a folder of its own, and in a repository."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest
from support.diff_command import EDITED, POINTS, Diff, commit, git


@pytest.fixture
def diff(tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Diff:
    """The command, with two descriptions in the folder where it is called."""
    monkeypatch.chdir(tmp_path)
    made = Diff(tmp_path, capsys)
    made.write("old", POINTS)
    made.write("new", EDITED)
    return made


@pytest.fixture
def repository(diff: Diff, monkeypatch: pytest.MonkeyPatch) -> Diff:
    """The folder as a git repository, with a commit and a tag; `old` has changed since."""
    for name in [name for name in os.environ if name.startswith("GIT_")]:
        monkeypatch.delenv(name)
    monkeypatch.setenv("GIT_CONFIG_GLOBAL", os.devnull)
    git("init", "-q", "-b", "main")
    shutil.copy("old/device.yaml", "old/second.yml")
    shutil.copytree("old", "far/away/old")
    commit("first")
    git("tag", "v1")
    diff.write("old", EDITED)
    return diff
