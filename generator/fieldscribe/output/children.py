"""Runs a function in a child process during the run, if the system can fork."""

import os
import pickle
import threading
from collections.abc import Callable, Iterable, Iterator
from tempfile import TemporaryFile
from typing import TypeVar

T = TypeVar("T")


def may_have_children() -> bool:
    """Return True if there are several processors and a fork is safe for threads."""
    return hasattr(os, "sched_getaffinity") and len(os.sched_getaffinity(0)) > 1 and threading.active_count() == 1


def results_of_child(make: Callable[[], Iterable[T]]) -> Iterator[T]:
    """Start a child that makes results; return an iterator over them, which waits until all are made.

    The iterator raises ChildProcessError if the child is killed.
    """
    file = TemporaryFile()  # noqa: SIM115 - closed by the iterator
    child = os.fork()
    if not child:
        status = 1
        try:
            for result in make():
                pickle.dump(result, file)
            file.close()
            status = 0
        finally:
            os._exit(status)

    def results() -> Iterator[T]:
        with file:
            if os.waitpid(child, 0)[1]:
                raise ChildProcessError(
                    "a process that made files broke off: is there enough memory, and room for temporary files?"
                )
            size = file.seek(0, os.SEEK_END)
            file.seek(0)
            while file.tell() < size:
                yield pickle.load(file)  # noqa: S301 - written by our own child to a file without a name

    return results()
