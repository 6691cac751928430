"""Reads regular files up to a size limit; never blocks on pipes or devices, which are not even opened.

Flags that the system lacks (Windows has no O_NONBLOCK) are left out.
"""

import os
import stat
from errno import EFBIG, EINVAL, ENOENT
from pathlib import Path
from typing import NamedTuple

State = tuple[int, int, int, int]
"""Size, inode, mtime and ctime: they differ if a file was touched."""

_FLAGS = os.O_RDONLY
for _name in ("O_NONBLOCK", "O_NOCTTY", "O_CLOEXEC", "O_BINARY", "O_NOINHERIT"):
    _FLAGS |= getattr(os, _name, 0)

_KINDS = (
    (stat.S_ISDIR, "it is a folder"),
    (stat.S_ISFIFO, "it is a pipe"),
    (stat.S_ISSOCK, "it is a socket"),
    (stat.S_ISLNK, "it is a link"),
)


class UnfitFileError(OSError):
    """The file is no regular one, or larger than the limit; `strerror` says which."""


class UnsafePathError(Exception):
    """A path leads out of its folder."""


class Content(NamedTuple):
    """The bytes of a file, and its state when they were read."""

    data: bytes
    state: State


class Inputs:
    """The files that a run has read, with the checksum of the bytes that it compiled, and their state at that time."""

    def __init__(self) -> None:
        self.digests: dict[Path, str] = {}
        self.states: dict[Path, State] = {}

    def note(self, path: Path, content: Content) -> None:
        """Note what was read from a file."""
        from hashlib import sha256

        self.digests[path] = sha256(content.data).hexdigest()
        self.states[path] = content.state


def path_text(path: Path) -> str:
    """Return the path for messages: relative to the working folder if it lies below that."""
    try:
        return Path(os.path.abspath(path)).relative_to(Path.cwd()).as_posix()
    except ValueError:
        return path.as_posix()


def read_regular(path: str | os.PathLike[str], most: int) -> Content:
    """Return the content of a regular file, or of a link to one, of at most `most` bytes. Raises OSError."""
    _refuse(_status(path), path, most)
    with open(os.open(path, _FLAGS), "rb") as stream:
        status = os.fstat(stream.fileno())  # what was opened may be another file by now
        _refuse(status, path, most)
        data = stream.read(most + 1)
    if len(data) > most:
        raise UnfitFileError(EFBIG, _too_large(most), str(path))
    return Content(data, state_of(status))


def inside(out: Path, path: str) -> Path:
    """Return the full path of an output in the folder `out`. Raises UnsafePathError if it lies outside."""
    place, root = out / path, os.path.realpath(out)
    folder = os.path.realpath(place.parent)
    if place.name == ".." or not f"{folder}{os.sep}".startswith(f"{root.rstrip(os.sep)}{os.sep}"):
        raise UnsafePathError(f"it leads out of the folder {out}")
    return place


def state_of(status: os.stat_result) -> State:
    """Return the state of a file."""
    return status.st_size, status.st_ino, status.st_mtime_ns, status.st_ctime_ns


def state_at(path: str | os.PathLike[str]) -> State | None:
    """Return the state of the file at a path; None if it cannot be read."""
    try:
        return state_of(os.stat(path))
    except OSError:
        return None


def kind_of(status: os.stat_result) -> str | None:
    """Return what a file is, in words; None if it is a regular one."""
    if stat.S_ISREG(status.st_mode):
        return None
    return next((words for test, words in _KINDS if test(status.st_mode)), "it is a device")


def _status(path: str | os.PathLike[str]) -> os.stat_result:
    try:
        return os.stat(path)
    except FileNotFoundError:
        if os.path.islink(path):
            raise UnfitFileError(ENOENT, "it is a link that leads nowhere", str(path)) from None
        raise


def _refuse(status: os.stat_result, path: str | os.PathLike[str], most: int) -> None:
    kind = kind_of(status)
    if kind is not None:
        raise UnfitFileError(EINVAL, kind, str(path))
    if status.st_size > most:
        raise UnfitFileError(EFBIG, _too_large(most), str(path))


def _too_large(most: int) -> str:
    return f"it is larger than {most >> 20} MiB"
