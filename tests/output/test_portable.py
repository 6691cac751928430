"""Nothing needs fork, flock or links: what Windows, macOS or a poor file system lacks is taken away here.

This is no run on these systems; the README says what was tested where.
"""

from __future__ import annotations

import errno
import os
import subprocess
import sys
import time
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import pytest
from fieldscribe.output import lock
from fieldscribe.output.lock import NAME, only_run
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
        "c",
        "docs",
        "manifest",
        "python",
        "rust",
        "vectors",
    ]


def test_a_second_process_is_never_forked(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from fieldscribe.cli import main

    def forked() -> int:
        raise AssertionError("the run was parted in two")

    monkeypatch.setattr(os, "fork", forked)
    hitachi = ROOT / "descriptions/hitachi_l200"  # large enough to have been parted once
    assert main(["generate", str(hitachi), "--target", "c,docs", "--out", str(tmp_path / "made")]) == 0


def other() -> None:
    raise AssertionError("nobody else has the lock")


def excludes(out: Path) -> None:
    """One run has the lock, a second does not get it, and afterwards nothing is left."""
    with only_run(out, other):
        assert (out / NAME).exists()
        with pytest.raises(TimeoutError), only_run(out, lambda: None, 0.1):
            raise AssertionError("two runs at once")
    assert not (out / NAME).exists()
    with only_run(out, other):
        pass


def test_without_locks_of_the_system_who_creates_the_file_has_the_lock(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "fcntl", None)
    monkeypatch.setitem(sys.modules, "msvcrt", None)
    excludes(tmp_path)
    (tmp_path / NAME).touch()
    for age in (0, 590):  # a run may take minutes
        os.utime(tmp_path / NAME, (time.time() - age, time.time() - age))
        with pytest.raises(TimeoutError), only_run(tmp_path, lambda: None, 0.1):
            raise AssertionError("somebody else's")
    old = time.time() - 610
    os.utime(tmp_path / NAME, (old, old))
    with only_run(tmp_path, other):
        assert time.time() - (tmp_path / NAME).stat().st_mtime < 600
    assert not (tmp_path / NAME).exists()


@pytest.mark.parametrize("number", [errno.ENOLCK, errno.EOPNOTSUPP, errno.ENOSYS])
def test_a_file_system_that_cannot_lock(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, number: int) -> None:
    import fcntl

    def cannot(*_: object) -> None:
        raise OSError(number, os.strerror(number))

    monkeypatch.setattr(fcntl, "flock", cannot)
    excludes(tmp_path)


@pytest.mark.parametrize(("system", "waits"), [("nt", True), ("posix", False)])
def test_who_may_not_open_the_lock_waits_on_windows_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, system: str, waits: bool
) -> None:
    """There a file that is being removed cannot be opened for a while; elsewhere no patience helps."""
    (tmp_path / NAME).touch()

    def refused(place: Path, flags: int, *_: object) -> int:
        raise (FileExistsError if flags & os.O_EXCL else PermissionError)(errno.EACCES, "Permission denied")

    monkeypatch.setattr(lock, "os", SimpleNamespace(**{**vars(os), "name": system, "open": refused}))
    with pytest.raises(TimeoutError if waits else PermissionError), only_run(tmp_path, lambda: None, 0.0):
        raise AssertionError("locked")


def test_a_lock_that_others_keep_removing_is_tried_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each of many short runs may be gone between our two looks."""
    tries = iter(range(20))
    opened = os.open

    def crowded(place: Path, flags: int, *more: int) -> int:
        if flags & os.O_EXCL and next(tries) < 10:
            raise FileExistsError(errno.EEXIST, "File exists")
        return opened(place, flags, *more)

    monkeypatch.setattr(lock, "os", SimpleNamespace(**{**vars(os), "open": crowded}))
    monkeypatch.setattr(lock, "_PAUSE", 0.0)
    with only_run(tmp_path, lambda: None):
        assert (tmp_path / NAME).exists()


def test_locks_as_on_windows(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A stand-in for msvcrt, and a file that cannot be removed while it is open."""
    import fcntl

    stand_in: Any = ModuleType("msvcrt")
    stand_in.LK_NBLCK = 2
    held: dict[int, tuple[int, int]] = {}

    def locking(handle: int, mode: int, count: int) -> None:
        assert (mode, count) == (2, 1)
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise PermissionError(errno.EACCES, "Permission denied") from None
        status = os.fstat(handle)
        held[handle] = status.st_dev, status.st_ino

    close, unlink = os.close, Path.unlink

    def closing(handle: int) -> None:
        held.pop(handle, None)
        close(handle)

    def removing(place: Path, missing_ok: bool = False) -> None:
        if place.exists() and (place.stat().st_dev, place.stat().st_ino) in held.values():
            raise PermissionError(errno.EACCES, "The process cannot access the file")
        unlink(place, missing_ok)

    stand_in.locking = locking
    monkeypatch.setitem(sys.modules, "msvcrt", stand_in)
    monkeypatch.setitem(sys.modules, "fcntl", None)
    monkeypatch.setattr(os, "close", closing)
    monkeypatch.setattr(Path, "unlink", removing)
    excludes(tmp_path)
