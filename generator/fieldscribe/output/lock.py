"""One run at a time writes to an output folder.

The run holds a `flock` on an empty file in that folder. The system releases it when the run ends, in any way. This
run removes the file, or the next run if this one is killed. Without `flock` (Windows, some network file systems)
runs do not exclude each other.
"""

import errno
import os
import signal
import stat
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from types import FrameType
from typing import NoReturn

from fieldscribe.safe_files import UnfitFileError, kind_of

try:
    from fcntl import LOCK_EX, LOCK_NB, flock
except ImportError:
    flock = None  # type: ignore[assignment, unused-ignore]  # Windows


NAME = ".fieldscribe-lock"
PATIENCE = 60.0
"""The most seconds that a run waits for another one."""

_PAUSE = 0.05
_SILENCE = 0.5
"""Seconds before a run says that it waits: most runs are over by then."""
_MOST_MISSES = 5
"""How often in a row the folder may vanish while we open the lock, because another run removes it."""
_FLAGS = os.O_CREAT
for _name in ("O_NOFOLLOW", "O_NONBLOCK", "O_CLOEXEC", "O_BINARY", "O_NOINHERIT"):
    _FLAGS |= getattr(os, _name, 0)


@contextmanager
def only_run(out: Path, waiting: Callable[[], None], patience: float = PATIENCE) -> Iterator[None]:
    """Hold the lock of the folder; `waiting` is called once if another run holds it. Raises OSError."""
    created = not out.is_dir()
    with suppress(FileNotFoundError):  # other runs make and remove the folder
        if not stat.S_ISDIR(os.stat(out).st_mode):
            raise NotADirectoryError(errno.ENOTDIR, "it is a file, not a folder", str(out))
    place = out / NAME
    handle = _acquire(place, waiting, patience)
    try:
        with _exit_on_sigterm():
            yield
    finally:
        with suppress(OSError):
            if _is_at(place, handle):
                place.unlink()
        os.close(handle)
        if created:
            with suppress(OSError):
                out.rmdir()  # succeeds only if nothing was written


def _acquire(place: Path, waiting: Callable[[], None], patience: float) -> int:
    """Return the handle of the lock file once it is locked. Raises TimeoutError and other OSErrors."""
    start, has_reported, misses = time.monotonic(), False, 0
    while True:
        try:
            handle, misses = _try_lock(place), 0
        except (FileNotFoundError, FileExistsError):  # FileExistsError: it vanished between two steps of mkdir
            handle, misses = None, misses + 1
            if misses > _MOST_MISSES:
                raise
        if handle is not None:
            return handle
        waited = time.monotonic() - start
        if waited > patience:
            message = f"another run has been writing there for {patience:.0f} seconds"
            raise TimeoutError(errno.ETIMEDOUT, message, str(place.parent))
        if waited > _SILENCE and not has_reported:
            waiting()
            has_reported = True
        time.sleep(_PAUSE)


def _try_lock(place: Path) -> int | None:
    """Return the handle of the lock file; None if another run holds the lock or has just removed the file."""
    handle, is_ours = _open(place), False
    try:
        is_ours = _flock(handle) and _is_at(place, handle)
    finally:
        if not is_ours:
            os.close(handle)
    return handle if is_ours else None


def _open(place: Path) -> int:
    """Open or create the lock file.

    Raises UnfitFileError for a link or a file that is not a lock, which stays untouched.
    """
    place.parent.mkdir(parents=True, exist_ok=True)
    with suppress(FileNotFoundError):
        status = os.lstat(place)
        reason = kind_of(status) or ("it is not empty, so it is no lock" if status.st_size else None)
        if reason is not None:
            raise UnfitFileError(errno.EEXIST, f"{reason}: move it away", str(place))
    try:
        return os.open(place, _FLAGS | os.O_RDWR, 0o666)
    except PermissionError:
        return os.open(place, _FLAGS)  # to read, another user's file: a lock needs no permission to write


def _flock(handle: int) -> bool:
    """Return True if we hold the lock, or the system has no locks."""
    if flock is None:
        return True
    try:
        flock(handle, LOCK_EX | LOCK_NB)
    except BlockingIOError:
        return False
    except OSError as error:
        if error.errno not in (errno.ENOLCK, errno.EOPNOTSUPP, errno.ENOSYS):
            raise
    return True


def _is_at(place: Path, handle: int) -> bool:
    """Return True if the path still leads to the open file."""
    try:
        return os.path.samestat(os.lstat(place), os.fstat(handle))
    except OSError:
        return False


@contextmanager
def _exit_on_sigterm() -> Iterator[None]:
    """Turn SIGTERM into SystemExit, so that files are cleaned up; an existing handler stays."""
    is_default = signal.getsignal(signal.SIGTERM) == signal.SIG_DFL
    sets_handler = is_default and threading.current_thread() is threading.main_thread()
    if sets_handler:
        signal.signal(signal.SIGTERM, _exit)
    try:
        yield
    finally:
        if sets_handler:
            signal.signal(signal.SIGTERM, signal.SIG_DFL)


def _exit(number: int, _frame: FrameType | None) -> NoReturn:
    raise SystemExit(128 + number)
