"""Runs a function in a child process with limits of time and memory, so that no module keeps an earlier mutant."""

from __future__ import annotations

import contextlib
import json
import os
import resource
import signal
import sys
import tempfile
import time
import traceback
from collections.abc import Callable
from typing import Any

MEMORY = 6 << 30
"""What a child may take."""


TIME, BROKE_DOWN = "time", "break-down"


class StoppedError(Exception):
    """A child ended early: TIME or BROKE_DOWN, and its answers so far; its traceback is a note."""

    def __init__(self, why: str, told: list[Any]) -> None:
        super().__init__(why)
        self.told = told


def in_child(work: Callable[[Callable[[Any], None]], None], seconds: int) -> list[Any]:
    """Run `work` in a child and return the JSON values that it passes to its argument. Raises StoppedError.

    The seconds are those of a processor; by the clock it may take four times as long, as machines are shared.
    """
    with tempfile.TemporaryFile() as told, tempfile.TemporaryFile() as complaints:
        sys.stdout.flush()
        process = os.fork()
        if not process:
            _be_child(work, told.fileno(), complaints.fileno(), seconds)
        stopped = _wait(process, time.monotonic() + 4 * seconds)
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(process, signal.SIGKILL)  # what the child started
        told.seek(0)
        complaints.seek(0)
        traceback_of_child = complaints.read().decode(errors="replace")
        answers = [json.loads(line) for line in told.read().splitlines() if line.endswith((b"}", b'"'))]
    if stopped is None or (os.WIFSIGNALED(stopped) and os.WTERMSIG(stopped) in (signal.SIGXCPU, signal.SIGKILL)):
        raise StoppedError(TIME, answers)
    if stopped != 0:
        error = StoppedError(BROKE_DOWN, answers)
        error.add_note(traceback_of_child or f"wait status {stopped}")
        raise error
    return answers


def _wait(process: int, end: float) -> int | None:
    """How the child ended; None if it had to be stopped."""
    pause = 0.001
    while time.monotonic() < end:
        ended, status = os.waitpid(process, os.WNOHANG)
        if ended:
            return status
        time.sleep(pause)
        pause = min(pause * 1.3, 0.05)
    os.killpg(process, signal.SIGKILL)
    os.waitpid(process, 0)
    return None


def _be_child(work: Callable[[Callable[[Any], None]], None], told: int, complaints: int, seconds: int) -> None:
    code = 1
    try:
        os.setsid()
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 5))
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, resource.RLIM_INFINITY))
        silent = os.open(os.devnull, os.O_RDWR)
        for stream in (0, 1, 2):
            os.dup2(silent, stream)
        work(lambda one: _tell(told, one))
        code = 0
    except BaseException:  # whatever ends it, the parent says
        os.write(complaints, traceback.format_exc().encode())
    finally:
        os._exit(code)


def _tell(told: int, one: Any) -> None:
    os.write(told, json.dumps(one).encode() + b"\n")
