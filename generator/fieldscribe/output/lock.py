"""One run at a time writes to an output folder.

An empty file in that folder is locked, because all runs see it whatever their caches are. The system releases the lock
when a run ends, however it ends; the file is removed by this run, or by the next if this one is killed.
Where the system cannot lock files, creating the file takes the lock, and a file older than ten minutes is abandoned.
"""

from __future__ import annotations

import errno
import os
import signal
import time
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, NoReturn

from fieldscribe.safe_files import UnfitFileError, kind_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path
    from types import FrameType

NAME = ".fieldscribe-lock"
PATIENCE = 60.0
"""How many seconds a run waits for another."""

_PAUSE = 0.05
_TELL_AFTER = 0.5
_LEFT_BEHIND = 600.0
_VANISHED = 5
"""How often another run may remove the folder before we can use it; after that we give up."""
_BUSY = (errno.EACCES, errno.EAGAIN, errno.EDEADLK, getattr(errno, "EDEADLOCK", errno.EDEADLK))
_FLAGS = os.O_RDWR
for _name in ("O_NOFOLLOW", "O_NONBLOCK", "O_CLOEXEC", "O_BINARY", "O_NOINHERIT"):
    _FLAGS |= getattr(os, _name, 0)


@contextmanager
def only_run(out: Path, waiting: Callable[[], None], patience: float = PATIENCE) -> Iterator[None]:
    """Hold the lock of the folder; `waiting` is called once if another run has it. Raises OSError."""
    created = not out.is_dir()
    place = out / NAME
    handle = _acquired(place, waiting, patience)
    try:
        with _ending_in_order():
            yield
    finally:
        _release(place, handle)
        if created:
            with suppress(OSError):
                out.rmdir()  # succeeds only if nothing was written


def _acquired(place: Path, waiting: Callable[[], None], patience: float) -> int:
    start, has_told, vanished = time.monotonic(), False, 0
    while True:
        try:
            handle = _tried(place)
        except (FileNotFoundError, FileExistsError):  # another run has removed the folder that it had made
            handle, vanished = None, vanished + 1
            if vanished > _VANISHED:
                raise
        if handle is not None:
            return handle
        waited = time.monotonic() - start
        if waited > patience:
            message = f"another run has been writing there for {patience:.0f} seconds"
            raise TimeoutError(errno.ETIMEDOUT, message, str(place.parent))
        if waited > _TELL_AFTER and not has_told:
            waiting()
            has_told = True
        time.sleep(_PAUSE)


def _tried(place: Path) -> int | None:
    """The open lock file if we got its lock, else None."""
    handle, created = _opened(place)
    if handle is None:
        return None
    try:
        held = _locked(handle)
        if held is None:
            held = created or _left_behind(place, handle)
        if held and _is_there(place, handle):
            return handle
    except BaseException:
        os.close(handle)
        raise
    os.close(handle)
    return None


def _opened(place: Path) -> tuple[int | None, bool]:
    """The open lock file, and whether we created it; None if it vanished. Raises OSError for any other file."""
    place.parent.mkdir(parents=True, exist_ok=True)
    try:
        return os.open(place, _FLAGS | os.O_CREAT | os.O_EXCL, 0o666), True
    except FileExistsError:
        return _existing(place), False


def _existing(place: Path) -> int | None:
    try:
        status = os.lstat(place)
        kind = kind_of(status) or ("it is not empty, so it is no lock" if status.st_size else None)
        if kind is not None:
            raise UnfitFileError(errno.EEXIST, f"{kind}: move it away", str(place))
        with suppress(PermissionError):
            return os.open(place, _FLAGS)
        return os.open(place, _FLAGS & ~os.O_RDWR)  # of another user: a lock needs no right to write
    except (FileNotFoundError, PermissionError) as error:
        if isinstance(error, PermissionError) and os.name != "nt":
            raise
        return None  # on Windows a file that is being removed cannot be opened


def _locked(handle: int) -> bool | None:
    """Whether we got the lock; None if the system cannot lock this file."""
    try:
        import fcntl
    except ImportError:
        return _locked_as_on_windows(handle)
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        return False if error.errno in _BUSY else None
    return True


def _locked_as_on_windows(handle: int) -> bool | None:
    try:
        import msvcrt
    except ImportError:
        return None
    try:
        msvcrt.locking(handle, msvcrt.LK_NBLCK, 1)  # type: ignore[attr-defined, unused-ignore]  # Windows only
    except OSError as error:
        return False if error.errno in _BUSY else None
    return True


def _left_behind(place: Path, handle: int) -> bool:
    """Without system locks: remove an abandoned file, so that the next try can create it."""
    if time.time() - os.fstat(handle).st_mtime > _LEFT_BEHIND:
        with suppress(OSError):
            place.unlink()
    return False


def _is_there(place: Path, handle: int) -> bool:
    """Whether the path still leads to the file that we opened."""
    try:
        return os.path.samestat(os.lstat(place), os.fstat(handle))
    except OSError:
        return False


def _release(place: Path, handle: int) -> None:
    try:
        removed = not _is_there(place, handle)
        if not removed:
            place.unlink()
            removed = True
    except OSError:
        removed = False  # Windows cannot remove an open file
    os.close(handle)
    if not removed:
        with suppress(OSError):
            place.unlink()


@contextmanager
def _ending_in_order() -> Iterator[None]:
    """Turn SIGTERM into an exception, so that the lock and half-written files are cleaned up.

    Whoever handles it already goes on doing so.
    """
    if signal.getsignal(signal.SIGTERM) != signal.SIG_DFL:
        yield
        return
    try:
        signal.signal(signal.SIGTERM, _stop)
    except ValueError:  # not in the main thread
        yield
        return
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, signal.SIG_DFL)


def _stop(number: int, _frame: FrameType | None) -> NoReturn:
    raise SystemExit(128 + number)
