"""Files that others left: only regular ones of sane size are read, and what tools leave in a runtime is not shipped."""

from __future__ import annotations

import errno
import os
from collections.abc import Callable
from importlib.util import find_spec, module_from_spec
from pathlib import Path
from typing import Any

import pytest
from fieldscribe import resources, safe_files
from fieldscribe.safe_files import State, UnfitFileError, read_regular
from support.files import write_files


def noted(monkeypatch: pytest.MonkeyPatch, without: int = 0) -> list[int]:
    """How files are opened from now on; the system itself does not get to see the flags of `without`."""
    flags: list[int] = []
    opened = os.open

    def noting(path: Any, how: int, *more: Any) -> int:
        flags.append(how)
        return opened(path, how & ~without, *more)

    monkeypatch.setattr(os, "open", noting)
    return flags


def test_a_file_is_read_with_its_state(tmp_path: Path) -> None:
    path = tmp_path / "a"
    path.write_bytes(b"12345")
    seen = path.stat()
    state: State = (5, seen.st_ino, seen.st_mtime_ns, seen.st_ctime_ns)
    assert read_regular(path, 5) == (b"12345", state)


def test_a_file_is_opened_so_that_nothing_hangs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A pipe does not wait for a writer, a terminal does not take over, and no child inherits the file."""
    (tmp_path / "a").write_bytes(b"1")
    flags = noted(monkeypatch)
    assert read_regular(tmp_path / "a", 1).data == b"1"
    assert flags == [os.O_RDONLY | os.O_NONBLOCK | os.O_NOCTTY | os.O_CLOEXEC]


WINDOWS = {"O_BINARY": 1 << 28, "O_NOINHERIT": 1 << 29}
"""What opens a file as it is, and keeps it from children, where no O_CLOEXEC is known."""


@pytest.mark.parametrize(
    ("module", "use"),
    [
        ("safe_files", lambda module, path: module.read_regular(path, 9)),
        ("output.writing", lambda module, path: module.replace(path, (b"new",))),
        ("output.lock", lambda module, path: module.only_run(path.parent, None).__enter__()),
    ],
    ids=["read", "written", "locked"],
)
def test_files_are_opened_as_windows_needs_it(
    module: str, use: Callable[[Any, Path], object], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Line ends stay as they are, also where the system would change them."""
    (tmp_path / "a").write_bytes(b"1")
    both = sum(WINDOWS.values())
    for name, bit in WINDOWS.items():
        monkeypatch.setattr(os, name, bit, raising=False)
    spec = find_spec(f"fieldscribe.{module}")
    assert spec is not None
    assert spec.loader is not None
    fresh = module_from_spec(spec)
    spec.loader.exec_module(fresh)
    flags = noted(monkeypatch, without=both)
    use(fresh, tmp_path / "a")
    assert flags
    assert all(how & both == both for how in flags)


@pytest.mark.parametrize(
    ("put", "number", "says"),
    [
        (os.mkfifo, errno.EINVAL, "it is a pipe"),
        (lambda path: path.write_bytes(b"12345678"), errno.EFBIG, "it is larger than 0 MiB"),
    ],
    ids=["pipe", "large file"],
)
def test_what_takes_the_place_of_a_file_once_it_was_looked_at_is_refused(
    put: Callable[[Path], object], number: int, says: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Without waiting for whoever may write to a pipe, and before anything is read."""
    (tmp_path / "small").write_bytes(b"1")
    put(tmp_path / "other")
    monkeypatch.setattr(safe_files, "_status", lambda _: os.stat(tmp_path / "small"))
    with pytest.raises(UnfitFileError, match=says) as refused:
        read_regular(tmp_path / "other", 7)
    assert (refused.value.errno, refused.value.filename) == (number, str(tmp_path / "other"))


def test_a_runtime_is_shipped_without_what_tools_leave_in_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of Python, Cargo, mypy and ruff, at any depth."""
    left = ("__pycache__/a.pyc", "target/debug/a", "src/.mypy_cache/3.12/a.json", ".ruff_cache/0.1/b", "Cargo.lock")
    write_files(dict.fromkeys(("c/b.h", "c/src/a.c", *(f"c/{path}" for path in left)), ""), tmp_path)
    monkeypatch.setattr(resources, "templates_dir", lambda: tmp_path)
    assert resources.runtime_files("c") == ("b.h", "src/a.c")
