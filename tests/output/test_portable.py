"""Nothing needs fork, flock or links: what Windows, macOS or a poor file system lacks is taken away here.

This is no run on these systems; the README says what was tested where.
"""

from __future__ import annotations

import errno
import os
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest
from fieldscribe.output import lock
from fieldscribe.output.lock import NAME, only_run
from fieldscribe.targets import TARGETS
from support.places import ROOT, TESTS

DEVICE = TESTS / "devices/kitchen_can"

WITHOUT = """
import os, sys
for name in ("fcntl", "msvcrt", "grp", "pwd", "termios", "resource", "_posixsubprocess"):
    sys.modules[name] = None
for name in ("fork", "forkpty", "posix_spawn", "link", "symlink", "readlink", "mkfifo", "getuid", "geteuid", "chown",
             "sched_getaffinity", "O_NONBLOCK", "O_NOFOLLOW", "O_CLOEXEC", "O_NOCTTY", "O_DIRECTORY"):
    if hasattr(os, name):
        delattr(os, name)
from fieldscribe.cli import main
sys.exit(main())
"""


@pytest.mark.full(seconds=2)
def test_every_step_works_without_what_other_systems_lack(tmp_path: Path) -> None:
    def run(*words: str) -> str:
        command = [sys.executable, "-c", WITHOUT, *words]
        environment = {**os.environ, "XDG_CACHE_HOME": str(tmp_path / "cache")}
        done = subprocess.run(
            command, cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=60, check=False
        )
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout

    device = str(DEVICE)
    assert "kitchen_can" in run("check", device)
    assert " 0 removed, 0 unchanged" in run("generate", device, "--out", "made", "--depfile", "made.d")
    assert "0 written" in run("generate", device, "--out", "made")
    assert "0 stale" in run("generate", device, "--out", "made", "--check")
    (tmp_path / "made/c/kitchen_can.h").unlink()
    assert "1 written" in run("generate", device, "--out", "made")
    assert sorted(path.name for path in (tmp_path / "made").iterdir()) == [
        *sorted((*TARGETS, "manifest")),
    ]


def test_a_second_process_is_never_forked(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from fieldscribe.cli import main

    def forked() -> int:
        raise AssertionError("the run was parted in two")

    monkeypatch.setattr(os, "fork", forked)
    hitachi = ROOT / "descriptions/hitachi_l200"  # large enough to have been parted once
    assert main(["generate", str(hitachi), "--target", "c,docs", "--out", str(tmp_path / "made")]) == 0


@pytest.mark.parametrize("number", [errno.ENOLCK, errno.EOPNOTSUPP, errno.ENOSYS])
def test_a_file_system_without_locks_is_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, number: int) -> None:
    def cannot(*_: object) -> None:
        raise OSError(number, os.strerror(number))

    monkeypatch.setattr(lock, "flock", cannot)
    with only_run(tmp_path, pytest.fail, 0.0):
        assert (tmp_path / NAME).exists()
    assert not (tmp_path / NAME).exists()


def test_other_failures_of_a_lock_are_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def cannot(*_: object) -> None:
        raise OSError(errno.EIO, os.strerror(errno.EIO))

    monkeypatch.setattr(lock, "flock", cannot)
    with pytest.raises(OSError, match="Input/output error"), only_run(tmp_path, pytest.fail, 0.0):
        raise AssertionError("locked")


def test_a_folder_that_others_keep_removing_is_tried_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each of many short runs may have removed the folder between our two looks."""
    tries, opened = iter(range(20)), os.open

    def crowded(place: Path, flags: int, *more: int) -> int:
        if next(tries) < 5:
            raise FileNotFoundError(errno.ENOENT, "No such file or directory")
        return opened(place, flags, *more)

    monkeypatch.setattr(lock, "os", SimpleNamespace(**{**vars(os), "open": crowded}))
    monkeypatch.setattr(lock, "_PAUSE", 0.0)
    with only_run(tmp_path, lambda: None):
        assert (tmp_path / NAME).exists()
