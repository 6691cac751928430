"""Two runs on one output folder exclude each other; a run that ends, however it ends, leaves no lock behind."""

from __future__ import annotations

import errno
import os
import shutil
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.output import lock
from fieldscribe.output.lock import NAME, only_run
from fieldscribe.safe_files import UnfitFileError
from support.places import TESTS

DEVICES = TESTS / "devices"
SMALL = "kitchen_can"

HOLD = """
import sys
from pathlib import Path
from fieldscribe.output.lock import only_run
with only_run(Path(sys.argv[1]), lambda: None):
    print("held", flush=True)
    sys.stdin.read()
"""


def holder(out: Path) -> subprocess.Popen[str]:
    """Another process that has the lock until its input ends."""
    process = subprocess.Popen(
        [sys.executable, "-c", HOLD, str(out)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    assert process.stdout is not None
    assert process.stdout.readline() == "held\n"
    return process


def nobody() -> None:
    raise AssertionError("nobody else has the lock")


def test_who_waits_is_told_within_a_second(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """But not at once: most runs are over before anybody has read that."""
    printed: list[float] = []
    hours = iter(at / 4 for at in range(1000))
    monkeypatch.setattr(time, "monotonic", lambda: next(hours))
    monkeypatch.setattr(time, "sleep", lambda _: None)
    monkeypatch.setattr(lock, "_try_lock", lambda _: None)
    with (
        pytest.raises(TimeoutError, match=r"\] another run has been writing there for 60 seconds: "),
        only_run(tmp_path, lambda: printed.append(next(hours)), 60.0),
    ):
        raise AssertionError("locked")
    assert len(printed) == 1
    assert 0.5 < printed[0] <= 1.25


def test_a_second_run_waits_says_so_and_gives_up(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(lock, "_SILENCE", 0.0)
    process, printed = holder(tmp_path), []
    with pytest.raises(TimeoutError, match="another run"), only_run(tmp_path, lambda: printed.append(1), 0.2):
        raise AssertionError("two runs at once")
    assert printed == [1]
    process.communicate("")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("end", [signal.SIGTERM, signal.SIGKILL])
def test_a_killed_run_leaves_no_lock_behind(tmp_path: Path, end: signal.Signals) -> None:
    process = holder(tmp_path)
    process.send_signal(end)
    process.communicate()
    if end == signal.SIGTERM:
        assert process.returncode == 128 + signal.SIGTERM
        assert list(tmp_path.iterdir()) == []
    with only_run(tmp_path, nobody, 0.0):
        assert [path.name for path in tmp_path.iterdir()] == [NAME]
    assert list(tmp_path.iterdir()) == []


def test_many_runs_one_after_the_other(tmp_path: Path) -> None:
    """Threads open the file on their own, so they exclude each other as processes do."""
    inside, most = [], []

    def run() -> None:
        for _ in range(20):
            with only_run(tmp_path / "out", lambda: None):
                inside.append(1)
                most.append(len(inside))
                time.sleep(0)
                inside.pop()

    threads = [threading.Thread(target=run) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(60)
    assert len(most) == 80
    assert max(most) == 1
    assert list((tmp_path / "out").glob("*")) == []  # at most the empty folder


def test_the_lock_of_another_user_that_was_killed_can_be_taken(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its file cannot be written to, but it can be locked."""
    (tmp_path / NAME).touch()
    opened = os.open

    def denied(path: Any, flags: int, mode: int = 0o777) -> int:
        if Path(path).name == NAME and flags & os.O_RDWR:
            raise PermissionError(13, "Permission denied", str(path))
        return opened(path, flags, mode)

    monkeypatch.setattr(os, "open", denied)
    with only_run(tmp_path, nobody, 1.0):
        pass
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_takes_no_files_is_no_other_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As below /proc: the folder is there, and what is created in it is not found."""

    def lost(path: str, *_: object) -> int:
        raise FileNotFoundError(2, "No such file or directory", str(path))

    monkeypatch.setattr(os, "open", lost)
    with pytest.raises(FileNotFoundError), only_run(tmp_path, pytest.fail, 30.0):
        raise AssertionError("locked")


@pytest.mark.parametrize("misses", [1, 5])
def test_a_folder_that_vanishes_between_two_steps_of_mkdir_is_made_again(
    misses: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Another run makes it, so ours finds it there, and removes it before ours can look at it."""
    made, left = os.mkdir, [*range(misses)]

    def mkdir(path: Any, mode: int = 0o777) -> None:
        if left:
            left.pop()
            raise FileExistsError(17, "File exists", str(path))
        made(path, mode)

    monkeypatch.setattr(os, "mkdir", mkdir)
    with only_run(tmp_path / "out", nobody, 30.0):
        assert not left


@pytest.mark.parametrize(
    "put",
    [
        lambda place: place.write_text("precious"),
        lambda place: place.mkdir(),
        os.mkfifo,
        lambda place: place.symlink_to("elsewhere"),
    ],
    ids=["text", "folder", "pipe", "link"],
)
def test_what_is_no_lock_is_refused_and_left(tmp_path: Path, put: Callable[[Path], object]) -> None:
    put(tmp_path / NAME)
    with pytest.raises(UnfitFileError, match="move it away") as refused, only_run(tmp_path, nobody, 1.0):
        raise AssertionError("taken for a lock")
    assert (refused.value.errno, refused.value.filename) == (errno.EEXIST, str(tmp_path / NAME))
    assert os.path.lexists(tmp_path / NAME)


def test_a_lock_that_was_removed_before_it_was_held_is_none(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The other run ends between opening and locking: what it removed guards nothing, so the lock is made anew."""
    held, left = lock._flock, [True]

    def flock(handle: int) -> bool:
        if left.pop() if left else False:
            (tmp_path / NAME).unlink()
        return held(handle)

    monkeypatch.setattr(lock, "_flock", flock)
    with only_run(tmp_path, nobody, 1.0):
        assert (tmp_path / NAME).exists()
    assert not left


def test_a_lock_that_another_run_made_meanwhile_is_left_to_it(tmp_path: Path) -> None:
    """Somebody removed the folder during a run, so another one has begun there: its lock is not ours to remove."""
    with only_run(tmp_path / "made", nobody, 1.0):
        shutil.rmtree(tmp_path / "made")
        (tmp_path / "made").mkdir()
        (tmp_path / "made" / NAME).touch()
    assert (tmp_path / "made" / NAME).exists()


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    for version in ("1.0.0", "2.0.0"):
        shutil.copytree(DEVICES / SMALL, tmp_path / version)
        text = (tmp_path / version / "device.yaml").read_text("utf-8")
        changed = text.replace("version: 1.0.0", f"version: {version}", 1)
        (tmp_path / version / "device.yaml").write_text(changed, "utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def contents(out: Path) -> dict[str, bytes]:
    return {path.relative_to(out).as_posix(): path.read_bytes() for path in out.rglob("*") if path.is_file()}


@pytest.mark.full(seconds=2)
def test_two_runs_with_different_input_leave_no_mixture(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """While one run writes its first file another starts: it has to wait, and the folder is then wholly its own."""
    from fieldscribe.cli import main

    others: list[subprocess.Popen[str]] = []
    replace = os.replace

    def meddled(source: Any, place: Any) -> None:
        replace(source, place)
        if not others:
            command = [sys.executable, "-m", "fieldscribe", "generate", "2.0.0", "--out", "made"]
            others.append(subprocess.Popen(command, stderr=subprocess.PIPE, text=True))
            stderr = others[0].stderr
            assert stderr is not None
            assert "waiting for another run" in stderr.readline()

    monkeypatch.setattr(os, "replace", meddled)
    assert main(["generate", "1.0.0", "--out", "made"]) == 0
    monkeypatch.undo()
    others[0].communicate(timeout=60)
    assert others[0].returncode == 0
    monkeypatch.chdir(folder)
    assert main(["generate", "2.0.0", "--out", "alone"]) == 0
    assert contents(folder / "made") == contents(folder / "alone")
    assert main(["generate", "2.0.0", "--out", "made", "--check"]) == 0
    assert main(["generate", "1.0.0", "--out", "made", "--check"]) == 1


@pytest.mark.full(seconds=1)
def test_check_calls_no_mixture_current(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What was current when it was read, but was written since, is not current."""
    from fieldscribe.cli import main
    from fieldscribe.output import generation, writing

    assert main(["generate", "1.0.0", "--out", "made"]) == 0
    changed_since, done = writing.changed_since, []

    def meddled(*arguments: Any) -> Any:
        done.append(main(["generate", "2.0.0", "--out", "made", "--target", "docs"]))
        return changed_since(*arguments)

    monkeypatch.setattr(generation, "changed_since", meddled)
    assert main(["generate", "1.0.0", "--out", "made", "--check"]) == 1
    assert done == [0]


@pytest.mark.full(seconds=1)
def test_check_writes_nothing_and_needs_no_lock(folder: Path) -> None:
    from fieldscribe.cli import main

    assert main(["generate", "1.0.0", "--out", "made", "--target", "docs"]) == 0
    process = holder(folder / "made")
    assert main(["generate", "1.0.0", "--out", "made", "--target", "docs", "--check"]) == 0
    process.communicate("")
    assert main(["generate", "1.0.0", "--out", "never", "--check"]) == 1
    assert not (folder / "never").exists()
