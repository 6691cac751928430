"""Files as strangers leave them: only regular ones of sane size are read, and nothing that lies there makes a run wait.

A pipe or a device is not even opened. What the system lacks (Windows has no O_NONBLOCK) is left out.
"""

from __future__ import annotations

import os
import stat
from errno import EFBIG, EINVAL, ENOENT
from pathlib import Path
from typing import NamedTuple

State = tuple[int, int, int, int]
"""What tells a touched file from an untouched one: size, inode, and the times of its contents and of its entry."""

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
    """No regular file, or a larger one than is sane; `strerror` says which."""


class Content(NamedTuple):
    """The bytes of a file, and its state when they were read."""

    data: bytes
    state: State


class Inputs:
    """The files that a run has read, with the checksum of the very bytes that it compiled and their state then."""

    def __init__(self) -> None:
        self.digests: dict[Path, str] = {}
        self.states: dict[Path, State] = {}

    def note(self, path: Path, content: Content) -> None:
        """Remember what was read from this file."""
        from hashlib import sha256

        self.digests[path] = sha256(content.data).hexdigest()
        self.states[path] = content.state


def shown_path(path: Path) -> str:
    """The path for people: relative to the working folder if it lies inside that."""
    try:
        return Path(os.path.abspath(path)).relative_to(Path.cwd()).as_posix()
    except ValueError:
        return path.as_posix()


def read_regular(path: str | os.PathLike[str], most: int) -> Content:
    """A regular file of at most that many bytes; a link to one counts. Raises OSError."""
    _refuse(_status(path), path, most)
    with open(os.open(path, _FLAGS), "rb") as stream:
        status = os.fstat(stream.fileno())  # what was opened may be another file by now
        _refuse(status, path, most)
        data = stream.read(most + 1)
    if len(data) > most:
        raise UnfitFileError(EFBIG, _too_large(most), str(path))
    return Content(data, state_of(status))


def state_of(status: os.stat_result) -> State:
    """The state of a file as far as the system tells it."""
    return status.st_size, status.st_ino, status.st_mtime_ns, status.st_ctime_ns


def kind_of(status: os.stat_result) -> str | None:
    """What a file is in words; None if it is a regular one."""
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
