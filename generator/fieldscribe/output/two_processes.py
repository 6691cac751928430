"""Work that halves well, done in two processes where the machine lets a process be copied cheaply."""

from __future__ import annotations

import os
import pickle
import threading
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

T = TypeVar("T")
R = TypeVar("R")


def halved(items: Iterable[T], weight: Callable[[T], float]) -> tuple[list[T], list[T]]:
    """The items in two lists of about the same weight, each in the given order."""
    numbered = list(enumerate(items))
    lists: tuple[list[tuple[int, T]], list[tuple[int, T]]] = ([], [])
    sums = [0.0, 0.0]
    for place, item in sorted(numbered, key=lambda one: -weight(one[1])):
        lighter = 0 if sums[0] <= sums[1] else 1
        lists[lighter].append((place, item))
        sums[lighter] += weight(item)
    first, second = (sorted(one, key=lambda pair: pair[0]) for one in lists)
    return [item for _, item in first], [item for _, item in second]


def both(here: Callable[[], R], there: Callable[[], R]) -> tuple[R, R]:
    """The results of both; `there` runs in a copy of this process, or after `here` where there can be none.

    Its result has to be picklable. An exception of either is raised here, once both have ended.
    """
    if not _may_copy():
        return here(), there()
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        _work(there, writing)
    os.close(writing)
    try:
        mine = here()
    finally:
        with os.fdopen(reading, "rb") as stream:
            data = stream.read()
        os.waitpid(child, 0)
    if not data:
        raise ChildProcessError("a second process that compiled ended early; is there enough memory?")
    result, error = pickle.loads(data)  # noqa: S301 - our own child wrote it
    if error is not None:
        raise error
    return mine, result


def _may_copy() -> bool:
    """Whether a copy helps and is safe: a second processor, and no thread that would hold a lock in the copy."""
    processors = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else 1
    return hasattr(os, "fork") and processors > 1 and threading.active_count() == 1


def _work(there: Callable[[], Any], writing: int) -> None:
    """The copy: it says what came out, and ends without running what its original will run."""
    code = 1
    try:
        try:
            said: tuple[Any, BaseException | None] = (there(), None)
        except Exception as error:
            said = (None, error)
        with os.fdopen(writing, "wb") as stream:
            pickle.dump(said, stream)
        code = 0
    finally:
        os._exit(code)
